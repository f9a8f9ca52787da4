//! A curve of a drawing with the stroke that it comes from.

use crate::carry::carried;
use crate::method::Settings;
use crate::neatening::Neatening;
use fairpath_curve::{Point, Similarity, Spline, Vec2};
use fairpath_fit::{Closing, Constraint, Fit, FitError, Report, Stroke, Warning, measure};
use fairpath_io::UsedTemplates;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Names a curve for as long as the drawing is open; never used twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct CurveId(pub u64);

/// A place through which a curve is held (McCrae and Singh 2008, section 5.3).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pin {
    /// Which place of the curve was taken, as a share of its length.
    pub share: f64,
    /// Where it is held, in the drawing's unit.
    pub point: Point,
}

impl Pin {
    /// The same for a curve of that length.
    #[must_use]
    pub fn constraint(&self, length: f64) -> Constraint {
        Constraint::moved(self.share * length, self.point)
    }
}

/// A curve of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its identity.
    pub id: CurveId,
    /// Its name in files.
    pub name: String,
    /// What it is fitted to: the stroke as it was drawn, and where the curve was changed since, the change.
    pub stroke: Stroke,
    /// How it is fitted.
    pub neatening: Neatening,
    /// Places through which it is held.
    pub pins: Vec<Pin>,
    /// The curve as it was before it was held through its pins; nothing if it has none, or is first to be fitted.
    pub unpinned: Option<Arc<Spline>>,
    /// Whether the curve is what stroke, neatening and pins give, or an edit of that; else it is to be fitted.
    pub fitted: bool,
    /// The curve.
    pub spline: Spline,
    /// Figures of the last fit.
    pub report: Report,
    /// What the fit had to say.
    pub warnings: Vec<Warning>,
    /// Which French curves it is made of.
    pub templates: Option<UsedTemplates>,
}

impl Curve {
    /// A curve that is to be fitted to a stroke; until then the stroke itself stands for it.
    ///
    /// # Errors
    /// When the stroke is a dot, or has coordinates that are not finite.
    pub fn drawn(id: CurveId, stroke: Stroke, neatening: Neatening) -> Result<Self, FitError> {
        let (raw, _) = Settings::Raw.fit(&stroke, None, &mut ())?;
        let name = stroke.name.clone();
        let Fit { spline, report, warnings } = raw;
        let (pins, unpinned, templates) = (Vec::new(), None, None);
        Ok(Self { id, name, stroke, neatening, pins, unpinned, fitted: false, spline, report, warnings, templates })
    }

    /// The curve with another shape, which an edit gave it. `drawn` is what was drawn for it, if anything; see [`carried`]. Where it was held through
    /// places it stays, but is held no more: the edit has made that shape its own.
    #[must_use]
    pub fn edited(&self, spline: Spline, drawn: &[Point]) -> Self {
        let stroke = carried(&[self.source()], &spline, drawn, self.neatening.pixel_size);
        self.reshaped(spline, stroke)
    }

    /// The stroke, and the curve that was fitted to it.
    pub(crate) fn source(&self) -> (&Stroke, &Spline) {
        (&self.stroke, self.unpinned.as_deref().unwrap_or(&self.spline))
    }

    /// The curve with another shape and a stroke that fits it.
    pub(crate) fn reshaped(&self, spline: Spline, stroke: Stroke) -> Self {
        let fitted = self.fitted || self.unpinned.is_some();
        let report = if fitted && self.neatening.fairness > 0.0 {
            measure(&spline, &stroke, self.neatening.pixel_size)
        } else {
            // The points themselves stand for the curve, a hundred thousand perhaps, and nobody wants to know how far it is from them.
            Report { points: stroke.points.len(), pieces: spline.segments().len(), ..Report::default() }
        };
        let closed = if spline.is_closed() { Closing::Yes } else { Closing::No };
        Self {
            stroke,
            spline,
            report,
            neatening: Neatening { closed, ..self.neatening.clone() },
            pins: Vec::new(),
            unpinned: None,
            warnings: Vec::new(),
            templates: None,
            // What was changed before it was fitted is still to be fitted, to the stroke with the change.
            fitted,
            ..self.clone()
        }
    }

    /// The curve elsewhere.
    #[must_use]
    pub fn moved(&self, by: Vec2) -> Self {
        self.transformed(&Similarity::translate(by))
    }

    /// The curve with all that belongs to it moved, turned, scaled or mirrored.
    #[must_use]
    pub fn transformed(&self, by: &Similarity) -> Self {
        let mut new = self.clone();
        new.spline = self.spline.transformed(by);
        new.unpinned = self.unpinned.as_ref().map(|spline| Arc::new(spline.transformed(by)));
        new.stroke.points.iter_mut().for_each(|point| *point = by.point(*point));
        new.pins.iter_mut().for_each(|pin| pin.point = by.point(pin.point));
        new.neatening.pixel_size *= by.scale;
        new.report.max_deviation *= by.scale;
        new.report.rms_deviation *= by.scale;
        for piece in new.templates.iter_mut().flat_map(|used| &mut used.pieces) {
            piece.transform = piece.transform.then(by);
            piece.span = piece.span.map(|s| s * by.scale);
            piece.turned_over ^= by.mirror;
        }
        new
    }
}
