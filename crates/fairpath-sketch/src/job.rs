//! Work that is done away from the interface: a job comes in, its answer goes out. The same function serves a thread and, with both as text, a
//! worker of a browser.

use crate::curve::Pin;
use crate::neatening::Neatening;
use fairpath_curve::{Point, Spline};
use fairpath_fit::{
    EditError, Fit, FitError, OversketchError, OversketchOptions, Report, Stroke, TemplateSet, Warning,
    interpolate_all, measure, oversketch,
};
use fairpath_io::UsedTemplates;
use fairpath_shape::{InflateError, InflateOptions, Mesh, inflate};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Something to compute.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case")]
pub enum Job {
    /// The curve of a stroke.
    Fit {
        /// The stroke.
        stroke: Stroke,
        /// How.
        neatening: Neatening,
        /// With which French curves, if the method needs some.
        templates: Option<Arc<TemplateSet>>,
        /// Places through which the curve is held.
        pins: Vec<Pin>,
    },
    /// A curve that is there already, held through places.
    Hold {
        /// The curve as it is without that.
        spline: Spline,
        /// The stroke that it comes from, for its figures.
        stroke: Stroke,
        /// The places.
        pins: Vec<Pin>,
        /// Size of a pixel of the screen on which it was drawn, in the unit of the curve.
        pixel_size: f64,
    },
    /// A curve with a stroke drawn over it.
    Oversketch {
        /// The curve.
        spline: Spline,
        /// The stroke.
        stroke: Stroke,
        /// How.
        options: Box<OversketchOptions>,
    },
    /// The surface of a closed curve.
    Inflate {
        /// The curve.
        spline: Spline,
        /// How.
        options: InflateOptions,
    },
}

/// A curve as a job found it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fitted {
    /// The curve.
    pub spline: Spline,
    /// Figures about it.
    pub report: Report,
    /// What was done differently from what was asked.
    pub warnings: Vec<Warning>,
    /// Which French curves it is made of.
    pub templates: Option<UsedTemplates>,
    /// For a curve that is held through places, what it was before.
    pub unpinned: Option<Spline>,
    /// For a stroke drawn over a curve, the points to which the new part was fitted; else empty.
    pub drawn: Vec<Point>,
}

/// Why a job has no result.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Trouble {
    /// A fixed word for programs.
    pub code: String,
    /// A sentence for people.
    pub text: String,
}

/// What a job gives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "is", rename_all = "kebab-case")]
pub enum Answer {
    /// A curve.
    Curve(Box<Fitted>),
    /// A surface.
    Surface(Mesh),
    /// Nothing, and why.
    Failed(Trouble),
}

/// Does a job.
#[must_use]
pub fn run(job: &Job) -> Answer {
    let done = match job {
        Job::Fit { stroke, neatening, templates, pins } => fitted(stroke, neatening, templates.as_deref(), pins),
        Job::Hold { spline, stroke, pins, pixel_size } => {
            let report = measure(spline, stroke, *pixel_size);
            let free = Fitted {
                spline: spline.clone(),
                report,
                warnings: Vec::new(),
                templates: None,
                unpinned: None,
                drawn: Vec::new(),
            };
            Ok(held(free, stroke, pins, *pixel_size).into())
        }
        Job::Oversketch { spline, stroke, options } => {
            oversketch(spline, stroke, options).map_err(Trouble::from).map(|done| {
                let (report, warnings, drawn) = (done.report, done.warnings, done.integrated);
                Fitted { spline: done.spline, report, warnings, templates: None, unpinned: None, drawn }.into()
            })
        }
        Job::Inflate { spline, options } => {
            inflate(spline, options).map_err(Trouble::from).map(|inflated| Answer::Surface(inflated.mesh))
        }
    };
    done.unwrap_or_else(Answer::Failed)
}

/// Does a job that is given as JSON, and gives its answer so: for a worker that shares no memory with the interface.
#[must_use]
pub fn run_encoded_job(job: &str) -> String {
    let answer = match serde_json::from_str(job) {
        Ok(job) => run(&job),
        Err(error) => Answer::Failed(Trouble { code: "bad-job".into(), text: format!("the job is no job: {error}") }),
    };
    serde_json::to_string(&answer).unwrap_or_else(|error| {
        // An answer holds finite numbers and words, which can always be written.
        let text = format!("the answer cannot be written: {error}");
        serde_json::json!({"is": "failed", "code": "bad-answer", "text": text}).to_string()
    })
}

fn fitted(
    stroke: &Stroke,
    neatening: &Neatening,
    templates: Option<&TemplateSet>,
    pins: &[Pin],
) -> Result<Answer, Trouble> {
    let settings =
        neatening.settings().map_err(|error| Trouble { code: "bad-option".into(), text: error.to_string() })?;
    let (fit, templates) = settings.fit(stroke, templates, &mut ())?;
    let Fit { spline, report, warnings } = fit;
    let free = Fitted { spline, report, warnings, templates, unpinned: None, drawn: Vec::new() };
    Ok(held(free, stroke, pins, neatening.pixel_size).into())
}

/// A curve held through places, if there are any. If it cannot be, it stays as it is, with a warning.
fn held(free: Fitted, stroke: &Stroke, pins: &[Pin], pixel_size: f64) -> Fitted {
    if pins.is_empty() {
        return free;
    }
    let Fitted { spline, report, mut warnings, templates, drawn, .. } = free;
    let (report, held) = match passed(&spline, pins, PIN_REACH * pixel_size) {
        Ok(held) => (measured(&held, stroke, &report, pixel_size), held),
        Err(error) => {
            warnings.push(Warning { code: NOT_HELD.into(), text: error.to_string() });
            (report, spline.clone())
        }
    };
    Fitted { spline: held, report, warnings, templates, unpinned: Some(spline), drawn }
}

/// The word for a curve that could not be held through its places.
pub(crate) const NOT_HELD: &str = "not-held";

/// The figures of a curve that was changed after it was fitted; how it was found stays as told.
pub(crate) fn measured(spline: &Spline, stroke: &Stroke, fit: &Report, pixel_size: f64) -> Report {
    let Report { max_deviation, rms_deviation, inflections, pieces, .. } = measure(spline, stroke, pixel_size);
    Report { max_deviation, rms_deviation, inflections, pieces, ..fit.clone() }
}

/// How far a curve changes to both sides of a place through which it is held, px.
const PIN_REACH: f64 = 80.0;

fn passed(spline: &Spline, pins: &[Pin], reach: f64) -> Result<Spline, EditError> {
    let length = spline.length();
    let constraints: Vec<_> = pins.iter().map(|pin| pin.constraint(length)).collect();
    interpolate_all(spline, &constraints, reach)
}

impl From<Fitted> for Answer {
    fn from(fitted: Fitted) -> Self {
        Self::Curve(Box::new(fitted))
    }
}

/// Names the errors of the library.
macro_rules! trouble {
    ($error:ty) => {
        impl From<$error> for Trouble {
            fn from(error: $error) -> Self {
                Self { code: error.code().into(), text: error.to_string() }
            }
        }
    };
}

trouble!(FitError);
trouble!(OversketchError);
trouble!(EditError);
trouble!(InflateError);
