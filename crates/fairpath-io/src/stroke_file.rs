//! Strokes of one file with what the file says about all of them.

use crate::unit::{Unit, YAxis};
use fairpath_fit::{Stroke, Warning};
use std::collections::HashSet;

/// A file of strokes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StrokeFile {
    /// Unit of all coordinates.
    pub unit: Unit,
    /// Pixels to the inch, where the file says.
    pub dpi: Option<f64>,
    /// Where the y axis of the coordinates points.
    pub y: YAxis,
    /// The strokes in the file's order; names are unique.
    pub strokes: Vec<Stroke>,
    /// What the reader had to change or leave out.
    pub warnings: Vec<Warning>,
}

impl StrokeFile {
    /// A file of `strokes` in pixels, y down. Names that repeat get a suffix: `a`, `a#2`, `a#3`; each with a warning.
    #[must_use]
    pub fn new(strokes: Vec<Stroke>) -> Self {
        let mut file = Self { strokes, ..Self::default() };
        file.make_names_unique();
        file
    }

    /// The stroke of that name.
    #[must_use]
    pub fn stroke(&self, name: &str) -> Option<&Stroke> {
        self.strokes.iter().find(|s| s.name == name)
    }

    /// Number of points of all strokes.
    #[must_use]
    pub fn points(&self) -> usize {
        self.strokes.iter().map(|s| s.points.len()).sum()
    }

    /// Gives repeated names the suffix `#2`, `#3`, … in the file's order, skipping names that the file has already.
    pub(crate) fn make_names_unique(&mut self) {
        let mut taken: HashSet<String> = self.strokes.iter().map(|s| s.name.clone()).collect();
        if taken.len() == self.strokes.len() {
            return;
        }
        let mut seen: std::collections::HashMap<String, usize> = std::collections::HashMap::new();
        for stroke in &mut self.strokes {
            let count = seen.entry(stroke.name.clone()).or_insert(0);
            *count += 1;
            if *count == 1 {
                continue;
            }
            let mut name = format!("{}#{count}", stroke.name);
            while taken.contains(&name) {
                *count += 1;
                name = format!("{}#{count}", stroke.name);
            }
            self.warnings.push(Warning {
                code: "renamed".into(),
                text: format!("a second stroke named {:?} is called {name:?} here", stroke.name),
            });
            taken.insert(name.clone());
            stroke.name = name;
        }
    }
}
