//! The options of whichever method was asked for.

use std::sync::Arc;

use anyhow::{Result, bail};
use fairpath_fit::{
    Closing, CurvatureSpaceOptions, Fit, FitError, FitOptions, FrenchCurveOptions, Observer, Stages, Stroke,
    TemplateSet, fit_curvature_space, fit_french_curve, fit_observed,
};
use fairpath_io::UsedTemplates;
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::args::{FitArgs, Method};
use crate::parameters::{self, Parameter};

/// What the command line must know of the options of a method; a method more is an implementation more.
trait Options: JsonSchema + Serialize + DeserializeOwned + Default + Clone + Send + Sync + 'static {
    /// Size of a pixel in the stroke's unit, and whether strokes are closed: for what has arguments of its own.
    fn stroke(&mut self) -> (&mut f64, &mut Closing);

    /// Distance from its stroke that a curve should keep, in the stroke's unit; infinite for a method that keeps none.
    fn largest_deviation(&self) -> f64;
}

impl Options for FitOptions {
    fn stroke(&mut self) -> (&mut f64, &mut Closing) {
        (&mut self.pixel_size, &mut self.closed)
    }

    fn largest_deviation(&self) -> f64 {
        self.max_error * self.pixel_size
    }
}

impl Options for CurvatureSpaceOptions {
    fn stroke(&mut self) -> (&mut f64, &mut Closing) {
        (&mut self.stroke.pixel_size, &mut self.stroke.closed)
    }

    fn largest_deviation(&self) -> f64 {
        self.max_error * self.stroke.pixel_size
    }
}

impl Options for FrenchCurveOptions {
    fn stroke(&mut self) -> (&mut f64, &mut Closing) {
        (&mut self.stroke.pixel_size, &mut self.stroke.closed)
    }

    fn largest_deviation(&self) -> f64 {
        self.max_error * self.stroke.pixel_size
    }
}

/// A fitted stroke, and for a method of French curves which of them it was drawn with.
pub(crate) struct Fitted {
    pub(crate) fit: Fit,
    pub(crate) templates: Option<UsedTemplates>,
}

impl From<Fit> for Fitted {
    fn from(fit: Fit) -> Self {
        Self { fit, templates: None }
    }
}

type Outcome = std::result::Result<Fitted, FitError>;

/// The options of one of the methods with the method itself.
struct Chosen<T, F> {
    options: T,
    fit: F,
}

/// A method that can be run, whatever its options are.
trait Runnable: Send + Sync {
    fn largest_deviation(&self) -> f64;
    fn fit(&self, stroke: &Stroke, observer: &mut dyn Observer, stages: Option<&mut Stages>) -> Outcome;
    fn listed(&self) -> (Vec<Parameter>, Value);
}

impl<T: Options, F> Runnable for Chosen<T, F>
where
    F: Fn(&T, &Stroke, &mut dyn Observer, Option<&mut Stages>) -> Outcome + Send + Sync,
{
    fn largest_deviation(&self) -> f64 {
        self.options.largest_deviation()
    }

    fn fit(&self, stroke: &Stroke, observer: &mut dyn Observer, stages: Option<&mut Stages>) -> Outcome {
        (self.fit)(&self.options, stroke, observer, stages)
    }

    fn listed(&self) -> (Vec<Parameter>, Value) {
        (parameters::all::<T>(), serde_json::to_value(&self.options).unwrap_or(Value::Null))
    }
}

/// A method with its options.
#[derive(Clone)]
pub(crate) struct MethodOptions(Arc<dyn Runnable>);

impl MethodOptions {
    /// What the arguments ask for, for strokes whose file says so of its pixels. `templates` are for the method that draws with them.
    ///
    /// # Errors
    /// When a parameter is unknown or out of its range.
    pub(crate) fn asked(args: &FitArgs, templates: &Arc<TemplateSet>, pixel_size_of_file: Option<f64>) -> Result<Self> {
        if let Some(size) = args.pixel_size
            && !(size.is_finite() && size > 0.0)
        {
            bail!("--pixel-size {size}: expected a number above 0, the size of a screen's pixel in the strokes' unit");
        }
        let pixel_size = args.pixel_size.or(pixel_size_of_file);
        let method: Arc<dyn Runnable> = match args.method {
            Method::ShortestPath => Arc::new(Chosen {
                options: set(FitOptions::preset(args.preset), args, pixel_size)?,
                fit: |options: &FitOptions,
                      stroke: &Stroke,
                      observer: &mut dyn Observer,
                      stages: Option<&mut Stages>| {
                    fit_observed(stroke, options, observer, stages).map(Fitted::from)
                },
            }),
            Method::CurvatureSpace => Arc::new(Chosen {
                options: set(CurvatureSpaceOptions::default(), args, pixel_size)?,
                fit: |options: &CurvatureSpaceOptions,
                      stroke: &Stroke,
                      _: &mut dyn Observer,
                      _: Option<&mut Stages>| {
                    fit_curvature_space(stroke, options).map(Fitted::from)
                },
            }),
            Method::FrenchCurve => {
                let templates = Arc::clone(templates);
                Arc::new(Chosen {
                    options: set(FrenchCurveOptions::default(), args, pixel_size)?,
                    fit: move |options: &FrenchCurveOptions,
                               stroke: &Stroke,
                               _: &mut dyn Observer,
                               _: Option<&mut Stages>| {
                        let found = fit_french_curve(stroke, &templates, options)?;
                        let used = UsedTemplates::new(&templates, &found.pieces);
                        Ok(Fitted { fit: found.fit, templates: Some(used) })
                    },
                })
            }
        };
        // Any stroke shows an option that is out of range; a short one is cheap.
        let probe = Stroke::new("probe", vec![(0.0, 0.0).into(), (1.0, 0.0).into()]);
        match method.fit(&probe, &mut (), None) {
            Err(error @ FitError::BadOption { .. }) => bail!("{error}"),
            _ => Ok(Self(method)),
        }
    }

    /// Fits a stroke. Only the method of shortest paths has stages, and only it tells `observer` of its steps.
    ///
    /// # Errors
    /// As the method.
    pub(crate) fn fit(
        &self,
        stroke: &Stroke,
        observer: &mut dyn Observer,
        stages: Option<&mut Stages>,
    ) -> std::result::Result<Fitted, FitError> {
        self.0.fit(stroke, observer, stages)
    }

    /// Distance from its stroke that a curve should keep, in the stroke's unit.
    pub(crate) fn largest_deviation(&self) -> f64 {
        self.0.largest_deviation()
    }

    /// The parameters and the values that they have.
    pub(crate) fn listed(&self) -> (Vec<Parameter>, Value) {
        self.0.listed()
    }
}

/// Options with what the arguments change about them.
fn set<T: Options>(mut options: T, args: &FitArgs, pixel_size: Option<f64>) -> Result<T> {
    let (size, closed) = options.stroke();
    *size = pixel_size.unwrap_or(*size);
    *closed = args.closed.unwrap_or(*closed);
    parameters::apply(&options, &args.set)
}
