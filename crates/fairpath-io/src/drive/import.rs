//! Lines of a file as sketches: a file of strokes or of GeoJSON and the terrain's place on the globe come in, commands go out.

use crate::error::{Error, Fault};
use crate::input::{label, open, read_all, text};
use crate::limits::ReadOptions;
use crate::strokes::{StrokeFormat, read_strokes};
use crate::strokes_geojson;
use crate::terrain::Projector;
use fairpath_curve::{Point, Vec2};
use fairpath_drive::{Command, GeoReference, Heightfield, SketchAs};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Sketches every line of a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "do", rename = "import", deny_unknown_fields)]
pub struct Import {
    /// The file, beside the script: GeoJSON, put in its place by the terrain's georeference, or any other file of strokes, taken as metres in the terrain's frame.
    pub file: String,
    /// Only the lines of this name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub only: Option<String>,
    /// The name of the path that the first line becomes; else all get names of their layer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Whether the lines close on themselves.
    #[serde(default)]
    pub closed: bool,
    /// By how much lines that are in metres are moved, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub offset_m: Option<[f64; 2]>,
    /// The layer on which the lines lie.
    #[serde(default = "road")]
    pub layer: String,
    /// The cross-section, by name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<String>,
    /// Size of a pixel of a stroke on the map, m.
    #[serde(default = "one")]
    pub pixel_m: f64,
    /// No bend is tighter, m; else as the cross-section has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_radius_m: Option<f64>,
    /// Lines that are shorter stay out, m.
    #[serde(default)]
    pub shortest_m: f64,
    /// No more lines than this are taken, the first ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub most: Option<usize>,
}

fn road() -> String {
    "road".to_owned()
}

fn one() -> f64 {
    1.0
}

impl Import {
    /// The sketches of the lines of a file that lie on the terrain; a line that leaves it is cut there. How many were left out is told in the second value.
    ///
    /// # Errors
    /// When the file cannot be read, or is in longitudes and latitudes and the terrain lies nowhere.
    pub fn sketches(
        &self,
        folder: &Path,
        field: &Heightfield,
        georeference: Option<&GeoReference>,
    ) -> Result<(Vec<Command>, usize), Error> {
        let path = folder.join(&self.file);
        let lines = lines(&path, georeference)?;
        let mut commands = Vec::new();
        let mut left_out = 0;
        for (name, mut points) in lines {
            if self.only.as_ref().is_some_and(|only| *only != name) {
                continue;
            }
            if let (Some([x, y]), false) = (self.offset_m, is_global(&path)) {
                points.iter_mut().for_each(|p| *p += Vec2::new(x, y));
            }
            let runs = on_terrain(field, &points);
            left_out += usize::from(runs.is_empty());
            for run in runs {
                let length: f64 = run.windows(2).map(|p| (p[1] - p[0]).hypot2().sqrt()).sum();
                if length < self.shortest_m || run.len() < 2 || self.most.is_some_and(|most| commands.len() >= most) {
                    left_out += 1;
                    continue;
                }
                let name = self.name.clone().filter(|_| commands.is_empty());
                commands.push(self.sketch(name, &run));
            }
        }
        Ok((commands, left_out))
    }

    fn sketch(&self, name: Option<String>, points: &[Point]) -> Command {
        Command::Sketch {
            points_m: points.iter().map(|p| [p.x, p.y]).collect(),
            layer: self.layer.clone(),
            name,
            section: self.section.clone(),
            sketch_as: SketchAs::New,
            closed: self.closed,
            pixel_m: self.pixel_m,
            min_radius_m: self.min_radius_m,
        }
    }
}

/// Whether a file's places are longitudes and latitudes.
fn is_global(path: &Path) -> bool {
    StrokeFormat::from_path(path) == Some(StrokeFormat::GeoJson)
}

/// The lines of a file in the terrain's metres, with their names.
fn lines(path: &Path, georeference: Option<&GeoReference>) -> Result<Vec<(String, Vec<Point>)>, Error> {
    let options = ReadOptions::default();
    if !is_global(path) {
        let file = read_strokes(path, &options)?;
        return Ok(file.strokes.into_iter().map(|s| (s.name, s.points)).collect());
    }
    let name = label(path);
    let in_file = |fault: Fault| fault.in_file(&name);
    let georeference = georeference.ok_or_else(|| {
        in_file(Fault::new(
            "the file as a whole",
            "it is in longitude and latitude, and the terrain lies nowhere on the globe",
        ))
    })?;
    let projector =
        Projector::new(georeference).map_err(|e| in_file(Fault::new("the terrain's georeference", e.to_string())))?;
    let bytes = read_all(open(path)?, &options.limits).map_err(in_file)?;
    let (file, places) = text(&bytes).and_then(|t| strokes_geojson::read_places(t, &options)).map_err(in_file)?;
    let mut lines = Vec::with_capacity(places.len());
    for (stroke, places) in file.strokes.into_iter().zip(places) {
        let points: Result<Vec<Point>, _> = places.iter().map(|p| projector.point([p.longitude, p.latitude])).collect();
        let points = points.map_err(|e| in_file(Fault::new(format_args!("line {:?}", stroke.name), e.to_string())))?;
        lines.push((stroke.name, points));
    }
    Ok(lines)
}

/// Runs of points on the terrain, a cell away from its edge.
fn on_terrain(field: &Heightfield, points: &[Point]) -> Vec<Vec<Point>> {
    let (low, high, spacing) = (field.corner(), field.far_corner(), field.spacing_m());
    let inside = |p: &&Point| {
        (low.x + spacing.x..=high.x - spacing.x).contains(&p.x)
            && (low.y + spacing.y..=high.y - spacing.y).contains(&p.y)
    };
    points.split(|p| !inside(&p)).filter(|run| run.len() > 1).map(<[Point]>::to_vec).collect()
}
