//! Surfaces as Wavefront OBJ: `v`, `vn` and `f` with a group for each surface, in the file's unit, y up.
//!
//! Numbers are f64 in the shortest form that reads back to the same bits. Reference: Wavefront, "Object Files (.obj)", Advanced Visualizer
//! manual, appendix B1.

use crate::surfaces::{SurfaceFile, upright};
use std::fmt::Write;

pub(crate) fn write(file: &SurfaceFile) -> Vec<u8> {
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = writeln!(text, "# fairpath\n# unit: {}; y up, z towards the viewer", file.unit);
    let mut first = 1;
    for entry in &file.surfaces {
        let _ = writeln!(text, "g {}", group(&entry.name));
        for (word, vectors) in [("v", &entry.mesh.vertices), ("vn", &entry.mesh.normals)] {
            for &vector in vectors {
                // Adding zero makes a plain zero of a negative one.
                let [x, y, z] = upright(vector, file.y).map(|x| x + 0.0);
                let _ = writeln!(text, "{word} {x} {y} {z}");
            }
        }
        for triangle in &entry.mesh.triangles {
            let [a, b, c] = triangle.map(|i| first + u64::from(i));
            let _ = writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}");
        }
        first += entry.mesh.vertices.len() as u64;
    }
    text.into_bytes()
}

/// A name without blanks, which would part it, and without what would end the line or the number sign of a comment.
fn group(name: &str) -> String {
    let plain = |c: char| if c.is_whitespace() || c.is_control() || c == '#' || c == '\\' { '_' } else { c };
    let name: String = name.chars().map(plain).collect();
    if name.is_empty() { "surface".into() } else { name }
}
