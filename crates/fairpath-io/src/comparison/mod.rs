//! Several methods on the same strokes, side by side: a summary in figures, and one page of HTML that needs nothing else.

mod data;
mod page;
mod summary;

pub use summary::MethodSummary;

use crate::spline_file::{Failure, SplineEntry, SplineFile};
use crate::stroke_file::StrokeFile;

/// What several methods made of the same strokes.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The strokes.
    pub strokes: StrokeFile,
    /// The methods in the order in which they are shown.
    pub methods: Vec<ComparedMethod>,
}

/// What one method made of the strokes.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedMethod {
    /// Its name, such as `shortest-path`.
    pub name: String,
    /// What it is, in a line.
    pub about: String,
    /// A spline or a failure for each stroke, by its name.
    pub results: SplineFile,
}

impl ComparedMethod {
    /// What became of a stroke.
    fn result(&self, stroke: &str) -> Option<Result<&SplineEntry, &Failure>> {
        let fitted = self.results.splines.iter().find(|entry| entry.name == stroke).map(Ok);
        fitted.or_else(|| self.results.failures.iter().find(|failure| failure.name == stroke).map(Err))
    }
}

impl Comparison {
    /// The figures of each method over all strokes, in the order of the methods.
    #[must_use]
    pub fn summary(&self) -> Vec<MethodSummary> {
        summary::of(self)
    }

    /// A page that shows every method on every stroke, overlaid and alone, with curvature combs, curvature plots and figures; a reader can
    /// choose what to see. It is one file without references to others.
    #[must_use]
    pub fn to_html(&self) -> String {
        page::html(self)
    }
}
