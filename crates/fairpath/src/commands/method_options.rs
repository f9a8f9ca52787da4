//! The options of whichever method was asked for.

use anyhow::{Result, bail};
use fairpath_fit::{
    CurvatureSpaceOptions, Fit, FitError, FitOptions, Observer, Stages, Stroke, fit_curvature_space, fit_observed,
};
use serde_json::Value;

use crate::args::{FitArgs, Method};
use crate::parameters::{self, Parameter};

/// A method with its options.
#[derive(Clone, Debug)]
pub(crate) enum MethodOptions {
    ShortestPath(Box<FitOptions>),
    CurvatureSpace(CurvatureSpaceOptions),
}

impl MethodOptions {
    /// What the arguments ask for, for strokes whose file says so of its pixels.
    ///
    /// # Errors
    /// When a parameter is unknown or out of its range.
    pub(crate) fn asked(args: &FitArgs, pixel_size_of_file: Option<f64>) -> Result<Self> {
        if let Some(size) = args.pixel_size
            && !(size.is_finite() && size > 0.0)
        {
            bail!("--pixel-size {size}: expected a number above 0, the size of a screen's pixel in the strokes' unit");
        }
        let pixel_size = args.pixel_size.or(pixel_size_of_file);
        let options = match args.method {
            Method::ShortestPath => {
                let mut options = FitOptions::preset(args.preset);
                options.closed = args.closed.unwrap_or(options.closed);
                options.pixel_size = pixel_size.unwrap_or(options.pixel_size);
                Self::ShortestPath(Box::new(parameters::apply(&options, &args.set)?))
            }
            Method::CurvatureSpace => {
                let mut options = CurvatureSpaceOptions::default();
                options.closed = args.closed.unwrap_or(options.closed);
                options.pixel_size = pixel_size.unwrap_or(options.pixel_size);
                Self::CurvatureSpace(parameters::apply(&options, &args.set)?)
            }
        };
        // Any stroke shows an option that is out of range; a short one is cheap.
        let probe = Stroke::new("probe", vec![(0.0, 0.0).into(), (1.0, 0.0).into()]);
        match options.fit(&probe, &mut (), None) {
            Err(error @ FitError::BadOption { .. }) => bail!("{error}"),
            _ => Ok(options),
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
    ) -> Result<Fit, FitError> {
        match self {
            Self::ShortestPath(options) => fit_observed(stroke, options, observer, stages),
            Self::CurvatureSpace(options) => fit_curvature_space(stroke, options),
        }
    }

    /// Distance from its stroke that a curve should keep, in the stroke's unit.
    pub(crate) fn largest_deviation(&self) -> f64 {
        match self {
            Self::ShortestPath(options) => options.max_error * options.pixel_size,
            Self::CurvatureSpace(options) => options.max_error * options.pixel_size,
        }
    }

    /// The parameters and the values that they have.
    pub(crate) fn listed(&self) -> (Vec<Parameter>, Value) {
        match self {
            Self::ShortestPath(options) => (parameters::all::<FitOptions>(), values(options.as_ref())),
            Self::CurvatureSpace(options) => (parameters::all::<CurvatureSpaceOptions>(), values(options)),
        }
    }
}

fn values(options: &impl serde::Serialize) -> Value {
    serde_json::to_value(options).unwrap_or(Value::Null)
}
