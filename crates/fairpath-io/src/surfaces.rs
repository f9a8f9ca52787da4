//! Surfaces to files of any format.

use crate::atomic::write_whole;
use crate::error::Error;
use crate::input::{extension, label};
use crate::picture::draw_shaded;
use crate::unit::{Unit, YAxis};
use crate::{mesh_gltf, mesh_obj};
use fairpath_shape::Mesh;
use std::path::Path;

/// Surfaces that belong together, in the unit and frame of the splines that they come from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceFile {
    /// Unit of all coordinates.
    pub unit: Unit,
    /// Where the y axis of the coordinates points. Every format here has it up, so surfaces with it down are turned about their x axis by
    /// half a turn: then nothing is mirrored, and who looks against z sees the drawing as it was drawn.
    pub y: YAxis,
    /// The surfaces in the order of their splines.
    pub surfaces: Vec<SurfaceEntry>,
}

/// A surface with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceEntry {
    /// The spline's name.
    pub name: String,
    /// Its triangles.
    pub mesh: Mesh,
}

/// The formats of surfaces. They are only written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SurfaceFormat {
    /// glTF 2.0 in one binary file: metres, y up, z towards the viewer.
    Glb,
    /// Wavefront OBJ: the file's unit, y up, z towards the viewer.
    Obj,
    /// A shaded picture.
    Png,
}

impl SurfaceFormat {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Glb, Self::Obj, Self::Png];

    /// The extension of the format's files.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Glb => "glb",
            Self::Obj => "obj",
            Self::Png => "png",
        }
    }

    /// The format of a file of that name, if its extension is one of ours.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        let extension = extension(path);
        Self::ALL.into_iter().find(|f| f.extension() == extension)
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Glb => "glTF",
            Self::Obj => "OBJ",
            Self::Png => "PNG",
        }
    }
}

/// `file` in a format.
///
/// # Errors
/// [`Error::Unwritable`] when there is no surface, a mesh has numbers or triangles that no file should have, or the format cannot hold it.
pub fn encode_surfaces(file: &SurfaceFile, format: SurfaceFormat) -> Result<Vec<u8>, Error> {
    check(file, format.name())?;
    match format {
        SurfaceFormat::Glb => mesh_gltf::write(file),
        SurfaceFormat::Obj => Ok(mesh_obj::write(file)),
        SurfaceFormat::Png => draw_shaded(file),
    }
}

/// Writes surfaces to a file, whole or not at all, in the format of its extension.
///
/// # Errors
/// As [`encode_surfaces`]; [`Error::UnknownFormat`] when the extension tells no format, [`Error::Write`] when the file cannot be written.
pub fn write_surfaces(path: &Path, file: &SurfaceFile) -> Result<(), Error> {
    let Some(format) = SurfaceFormat::from_path(path) else {
        return Err(Error::UnknownFormat {
            file: label(path),
            problem: "the extension tells no format".into(),
            expected: "a name that ends in .glb, .obj or .png",
        });
    };
    write_whole(path, &encode_surfaces(file, format)?)
}

/// A vector of the file's frame with y up.
pub(crate) fn upright(v: [f64; 3], y: YAxis) -> [f64; 3] {
    match y {
        YAxis::Up => v,
        YAxis::Down => [v[0], -v[1], -v[2]],
    }
}

/// Every number is finite, every normal of length one, and every triangle has vertices.
fn check(file: &SurfaceFile, format: &'static str) -> Result<(), Error> {
    let fail = |place: String, problem: &str| Err(Error::Unwritable { format, place, problem: problem.into() });
    if file.surfaces.is_empty() {
        return fail("the file".into(), "there is no surface to write; inflate a closed spline first");
    }
    for entry in &file.surfaces {
        let mesh = &entry.mesh;
        let place = format!("surface {:?}", entry.name);
        if mesh.triangles.is_empty() {
            return fail(place, "it has no triangle");
        }
        if mesh.normals.len() != mesh.vertices.len() {
            return fail(place, "it has not as many normals as vertices");
        }
        if !mesh.vertices.iter().flatten().all(|x| x.is_finite()) {
            return fail(place, "a coordinate is not finite");
        }
        let unit = |n: &[f64; 3]| ((n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt() - 1.0).abs() < 1e-4;
        if !mesh.normals.iter().all(unit) {
            return fail(place, "a normal has not the length one");
        }
        if mesh.triangles.iter().flatten().any(|&i| i as usize >= mesh.vertices.len()) {
            return fail(place, "a triangle names a vertex that does not exist");
        }
    }
    Ok(())
}
