//! The options of whichever method was asked for.

use std::fmt::Debug;
use std::sync::Arc;

use anyhow::{Result, bail};
use fairpath_fit::{
    Closing, CurvatureSpaceOptions, CurvatureStages, Fit, FitError, FitOptions, Observer, Stages, Stroke,
    fit_curvature_space_observed, fit_observed,
};
use fairpath_io::YAxis;
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::args::{FitArgs, Method};
use crate::parameters::{self, Parameter};
use crate::pictures;

/// A fit, and pictures of its steps: a word for each and its SVG.
pub(crate) type Drawn = (Fit, Vec<(String, Vec<u8>)>);

/// What the command line must know of the options of a method; a method more is an implementation more.
trait Options: JsonSchema + Serialize + DeserializeOwned + Default + Clone + Debug + Send + Sync + 'static {
    /// Size of a pixel in the stroke's unit, and whether strokes are closed: for what has arguments of its own.
    fn stroke(&mut self) -> (&mut f64, &mut Closing);

    /// Distance from its stroke that a curve should keep, in the stroke's unit; infinite for a method that keeps none.
    fn largest_deviation(&self) -> f64;

    /// Fits a stroke, telling `observer` of the steps; and draws them, if asked to.
    fn fit(
        &self,
        stroke: &Stroke,
        observer: &mut dyn Observer,
        draw: Option<YAxis>,
    ) -> std::result::Result<Drawn, FitError>;
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
        draw: Option<YAxis>,
    ) -> std::result::Result<Drawn, FitError> {
        let mut stages = draw.map(|_| Stages::default());
        let fit = fit_observed(stroke, self, observer, stages.as_mut())?;
        let pictures = draw.zip(stages).map(|(y, stages)| pictures::steps(stroke, &stages, &fit.spline, y));
        Ok((fit, pictures.unwrap_or_default()))
    }
}

impl Options for CurvatureSpaceOptions {
    fn stroke(&mut self) -> (&mut f64, &mut Closing) {
        (&mut self.stroke.pixel_size, &mut self.stroke.closed)
    }

    fn largest_deviation(&self) -> f64 {
        self.max_error * self.stroke.pixel_size
    }

    fn fit(
        &self,
        stroke: &Stroke,
        observer: &mut dyn Observer,
        draw: Option<YAxis>,
    ) -> std::result::Result<Drawn, FitError> {
        let mut stages = draw.map(|_| CurvatureStages::default());
        let fit = fit_curvature_space_observed(stroke, self, observer, stages.as_mut())?;
        let pictures = draw.zip(stages).map(|(y, stages)| pictures::curvature_steps(stroke, &stages, &fit.spline, y));
        Ok((fit, pictures.unwrap_or_default()))
    }
}

/// The options of one of the methods, which it is.
trait Chosen: Debug + Send + Sync {
    fn largest_deviation(&self) -> f64;
    fn fit(
        &self,
        stroke: &Stroke,
        observer: &mut dyn Observer,
        draw: Option<YAxis>,
    ) -> std::result::Result<Drawn, FitError>;
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
        draw: Option<YAxis>,
    ) -> std::result::Result<Drawn, FitError> {
        Options::fit(self, stroke, observer, draw)
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
        };
        // Any stroke shows an option that is out of range; a short one is cheap.
        let probe = Stroke::new("probe", vec![(0.0, 0.0).into(), (1.0, 0.0).into()]);
        match options.fit(&probe, &mut (), None) {
            Err(error @ FitError::BadOption { .. }) => bail!("{error}"),
            _ => Ok(options),
        }
    }

    /// Fits a stroke, telling `observer` of the steps; and draws them, if asked to.
    ///
    /// # Errors
    /// As the method.
    pub(crate) fn fit(
        &self,
        stroke: &Stroke,
        observer: &mut dyn Observer,
        draw: Option<YAxis>,
    ) -> std::result::Result<Drawn, FitError> {
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

/// Options with what the arguments change about them.
fn set<T: Options>(mut options: T, args: &FitArgs, pixel_size: Option<f64>) -> Result<MethodOptions> {
    let (size, closed) = options.stroke();
    *size = pixel_size.unwrap_or(*size);
    *closed = args.closed.unwrap_or(*closed);
    Ok(MethodOptions(Arc::new(parameters::apply(&options, &args.set)?)))
}
