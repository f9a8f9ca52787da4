//! The options of whichever method was asked for.

use std::sync::Arc;

use anyhow::{Result, bail};
use fairpath_fit::{
    Closing, CubicOptions, CurvatureSpaceOptions, CurvatureStages, Fit, FitError, FitOptions, FrenchCurveOptions,
    LaplacianOptions, MvcOptions, Observer, Preset, Stages, Stroke, TemplateSet, fit_cubic,
    fit_curvature_space_observed, fit_french_curve, fit_laplacian, fit_mvc, fit_observed,
};
use fairpath_io::{UsedTemplates, YAxis};
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::args::{FitArgs, Method};
use crate::parameters::{self, Parameter};
use crate::pictures;

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

/// Implements [`Options`] for options that have those of strokes in `stroke`.
macro_rules! options_with_stroke {
    ($options:ty, |$this:ident| $largest_deviation:expr) => {
        impl Options for $options {
            fn stroke(&mut self) -> (&mut f64, &mut Closing) {
                (&mut self.stroke.pixel_size, &mut self.stroke.closed)
            }

            fn largest_deviation(&self) -> f64 {
                let $this = self;
                $largest_deviation * self.stroke.pixel_size
            }
        }
    };
}

options_with_stroke!(CurvatureSpaceOptions, |options| options.max_error);
options_with_stroke!(FrenchCurveOptions, |options| options.max_error);
options_with_stroke!(CubicOptions, |options| options.max_error);
options_with_stroke!(MvcOptions, |options| options.max_error);
options_with_stroke!(LaplacianOptions, |_options| f64::INFINITY);

/// Pictures of the steps of a fit: a word for each and its SVG.
pub(crate) type Steps = Vec<(String, Vec<u8>)>;

/// A fitted stroke, for a method of French curves which of them it was drawn with, and pictures of the steps if asked for.
pub(crate) struct Fitted {
    pub(crate) fit: Fit,
    pub(crate) templates: Option<UsedTemplates>,
    pub(crate) steps: Steps,
}

impl From<Fit> for Fitted {
    fn from(fit: Fit) -> Self {
        Self { fit, templates: None, steps: Steps::new() }
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
    fn fit(&self, stroke: &Stroke, observer: &mut dyn Observer, draw: Option<YAxis>) -> Outcome;
    fn listed(&self) -> (Vec<Parameter>, Value);
}

impl<T: Options, F> Runnable for Chosen<T, F>
where
    F: Fn(&T, &Stroke, &mut dyn Observer, Option<YAxis>) -> Outcome + Send + Sync,
{
    fn largest_deviation(&self) -> f64 {
        self.options.largest_deviation()
    }

    fn fit(&self, stroke: &Stroke, observer: &mut dyn Observer, draw: Option<YAxis>) -> Outcome {
        (self.fit)(&self.options, stroke, observer, draw)
    }

    fn listed(&self) -> (Vec<Parameter>, Value) {
        (parameters::all::<T>(), serde_json::to_value(&self.options).unwrap_or(Value::Null))
    }
}

/// What can be asked of a method.
#[derive(Clone, Debug)]
pub(crate) struct Asked<'a> {
    pub(crate) method: Method,
    /// Of meaning to shortest paths only.
    pub(crate) preset: Preset,
    /// Parameters as `key=value`.
    pub(crate) set: &'a [String],
    pub(crate) closed: Option<Closing>,
    /// Size of a pixel in the strokes' unit.
    pub(crate) pixel_size: Option<f64>,
}

impl<'a> From<&'a FitArgs> for Asked<'a> {
    fn from(args: &'a FitArgs) -> Self {
        let FitArgs { method, preset, ref set, closed, pixel_size, .. } = *args;
        Self { method, preset, set, closed, pixel_size }
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
    pub(crate) fn asked(
        asked: &Asked<'_>,
        templates: &Arc<TemplateSet>,
        pixel_size_of_file: Option<f64>,
    ) -> Result<Self> {
        if let Some(size) = asked.pixel_size
            && !(size.is_finite() && size > 0.0)
        {
            bail!("--pixel-size {size}: expected a number above 0, the size of a screen's pixel in the strokes' unit");
        }
        let pixel_size = asked.pixel_size.or(pixel_size_of_file);
        let method: Arc<dyn Runnable> = match asked.method {
            Method::ShortestPath => Arc::new(Chosen {
                options: set(FitOptions::preset(asked.preset), asked, pixel_size)?,
                fit: |options: &FitOptions, stroke: &Stroke, observer: &mut dyn Observer, draw: Option<YAxis>| {
                    let mut stages = draw.map(|_| Stages::default());
                    let fit = fit_observed(stroke, options, observer, stages.as_mut())?;
                    let drawn = draw.zip(stages).map(|(y, stages)| pictures::steps(stroke, &stages, &fit.spline, y));
                    Ok(Fitted { steps: drawn.unwrap_or_default(), ..Fitted::from(fit) })
                },
            }),
            Method::FrenchCurve => {
                let templates = Arc::clone(templates);
                Arc::new(Chosen {
                    options: set(FrenchCurveOptions::default(), asked, pixel_size)?,
                    fit: move |options: &FrenchCurveOptions,
                               stroke: &Stroke,
                               _: &mut dyn Observer,
                               _: Option<YAxis>| {
                        let found = fit_french_curve(stroke, &templates, options)?;
                        let used = UsedTemplates::new(&templates, &found.pieces);
                        Ok(Fitted { fit: found.fit, templates: Some(used), steps: Steps::new() })
                    },
                })
            }
            Method::CurvatureSpace => Arc::new(Chosen {
                options: set(CurvatureSpaceOptions::default(), asked, pixel_size)?,
                fit: |options: &CurvatureSpaceOptions,
                      stroke: &Stroke,
                      observer: &mut dyn Observer,
                      draw: Option<YAxis>| {
                    let mut stages = draw.map(|_| CurvatureStages::default());
                    let fit = fit_curvature_space_observed(stroke, options, observer, stages.as_mut())?;
                    let drawn =
                        draw.zip(stages).map(|(y, stages)| pictures::curvature_steps(stroke, &stages, &fit.spline, y));
                    Ok(Fitted { steps: drawn.unwrap_or_default(), ..Fitted::from(fit) })
                },
            }),
            Method::Laplacian => plain(fit_laplacian, asked, pixel_size)?,
            Method::Cubic => plain(fit_cubic, asked, pixel_size)?,
            Method::Mvc => plain(fit_mvc, asked, pixel_size)?,
        };
        // Any stroke shows an option that is out of range; a short one is cheap.
        let probe = Stroke::new("probe", vec![(0.0, 0.0).into(), (1.0, 0.0).into()]);
        match method.fit(&probe, &mut (), None) {
            Err(error @ FitError::BadOption { .. }) => bail!("{error}"),
            _ => Ok(Self(method)),
        }
    }

    /// Fits a stroke, telling `observer` of the steps if it has any; and draws them, if asked to.
    ///
    /// # Errors
    /// As the method.
    pub(crate) fn fit(
        &self,
        stroke: &Stroke,
        observer: &mut dyn Observer,
        draw: Option<YAxis>,
    ) -> std::result::Result<Fitted, FitError> {
        self.0.fit(stroke, observer, draw)
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

/// A method that is nothing but a function of stroke and options.
fn plain<T: Options>(
    fit: fn(&Stroke, &T) -> std::result::Result<Fit, FitError>,
    asked: &Asked<'_>,
    pixel_size: Option<f64>,
) -> Result<Arc<dyn Runnable>> {
    let run = move |options: &T, stroke: &Stroke, _: &mut dyn Observer, _: Option<YAxis>| {
        fit(stroke, options).map(Fitted::from)
    };
    Ok(Arc::new(Chosen { options: set(T::default(), asked, pixel_size)?, fit: run }))
}

/// Options with what the arguments change about them.
fn set<T: Options>(mut options: T, asked: &Asked<'_>, pixel_size: Option<f64>) -> Result<T> {
    let (size, closed) = options.stroke();
    *size = pixel_size.unwrap_or(*size);
    *closed = asked.closed.unwrap_or(*closed);
    parameters::apply(&options, asked.set)
}
