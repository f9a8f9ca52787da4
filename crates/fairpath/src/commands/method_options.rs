//! The options of whichever method was asked for.

use std::fmt::Debug;
use std::sync::Arc;

use anyhow::{Result, bail};
use fairpath_fit::{
    Closing, CubicOptions, CurvatureSpaceOptions, Fit, FitError, FitOptions, LaplacianOptions, MvcOptions, Observer,
    Stages, Stroke, fit_cubic, fit_curvature_space, fit_laplacian, fit_mvc, fit_observed,
};
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::args::{FitArgs, Method};
use crate::parameters::{self, Parameter};

/// What the command line must know of the options of a method; a method more is an implementation more.
trait Options: JsonSchema + Serialize + DeserializeOwned + Default + Clone + Debug + Send + Sync + 'static {
    /// Size of a pixel in the stroke's unit, and whether strokes are closed: for what has arguments of its own.
    fn stroke(&mut self) -> (&mut f64, &mut Closing);

    /// Distance from its stroke that a curve should keep, in the stroke's unit; infinite for a method that keeps none.
    fn largest_deviation(&self) -> f64;

    /// Fits a stroke. Only the method of shortest paths has stages, and only it tells `observer` of its steps.
    fn fit(
        &self,
        stroke: &Stroke,
        observer: &mut dyn Observer,
        stages: Option<&mut Stages>,
    ) -> std::result::Result<Fit, FitError>;
}

impl Options for FitOptions {
    fn stroke(&mut self) -> (&mut f64, &mut Closing) {
        (&mut self.pixel_size, &mut self.closed)
    }

    fn largest_deviation(&self) -> f64 {
        self.max_error * self.pixel_size
    }

    fn fit(
        &self,
        stroke: &Stroke,
        observer: &mut dyn Observer,
        stages: Option<&mut Stages>,
    ) -> std::result::Result<Fit, FitError> {
        fit_observed(stroke, self, observer, stages)
    }
}

/// Implements [`Options`] for methods that have the options of strokes in `stroke` and are called by a function.
macro_rules! plain_method {
    ($options:ty, $fit:path, |$this:ident| $largest_deviation:expr) => {
        impl Options for $options {
            fn stroke(&mut self) -> (&mut f64, &mut Closing) {
                (&mut self.stroke.pixel_size, &mut self.stroke.closed)
            }

            fn largest_deviation(&self) -> f64 {
                let $this = self;
                $largest_deviation * self.stroke.pixel_size
            }

            fn fit(
                &self,
                stroke: &Stroke,
                _observer: &mut dyn Observer,
                _stages: Option<&mut Stages>,
            ) -> std::result::Result<Fit, FitError> {
                $fit(stroke, self)
            }
        }
    };
}

plain_method!(CurvatureSpaceOptions, fit_curvature_space, |o| o.max_error);
plain_method!(LaplacianOptions, fit_laplacian, |_o| f64::INFINITY);
plain_method!(CubicOptions, fit_cubic, |o| o.max_error);
plain_method!(MvcOptions, fit_mvc, |o| o.max_error);

/// The options of one of the methods, which it is.
trait Chosen: Debug + Send + Sync {
    fn largest_deviation(&self) -> f64;
    fn fit(
        &self,
        stroke: &Stroke,
        observer: &mut dyn Observer,
        stages: Option<&mut Stages>,
    ) -> std::result::Result<Fit, FitError>;
    fn listed(&self) -> (Vec<Parameter>, Value);
}

impl<T: Options> Chosen for T {
    fn largest_deviation(&self) -> f64 {
        Options::largest_deviation(self)
    }

    fn fit(
        &self,
        stroke: &Stroke,
        observer: &mut dyn Observer,
        stages: Option<&mut Stages>,
    ) -> std::result::Result<Fit, FitError> {
        Options::fit(self, stroke, observer, stages)
    }

    fn listed(&self) -> (Vec<Parameter>, Value) {
        (parameters::all::<T>(), serde_json::to_value(self).unwrap_or(Value::Null))
    }
}

/// A method with its options.
#[derive(Clone, Debug)]
pub(crate) struct MethodOptions(Arc<dyn Chosen>);

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
            Method::ShortestPath => set(FitOptions::preset(args.preset), args, pixel_size)?,
            Method::CurvatureSpace => set(CurvatureSpaceOptions::default(), args, pixel_size)?,
            Method::Laplacian => set(LaplacianOptions::default(), args, pixel_size)?,
            Method::Cubic => set(CubicOptions::default(), args, pixel_size)?,
            Method::Mvc => set(MvcOptions::default(), args, pixel_size)?,
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
    ) -> std::result::Result<Fit, FitError> {
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
fn set<T: Options>(mut options: T, args: &FitArgs, pixel_size: Option<f64>) -> Result<MethodOptions> {
    let (size, closed) = options.stroke();
    *size = pixel_size.unwrap_or(*size);
    *closed = args.closed.unwrap_or(*closed);
    Ok(MethodOptions(Arc::new(parameters::apply(&options, &args.set)?)))
}
