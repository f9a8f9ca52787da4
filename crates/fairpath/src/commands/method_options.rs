//! The options of whichever method was asked for.

use std::sync::Arc;

use anyhow::{Result, bail};
use fairpath_fit::{
    Closing, CurvatureStages, Fit, FitError, Observer, Preset, Stages, Stroke, TemplateSet,
    fit_curvature_space_observed, fit_observed,
};
use fairpath_io::{UsedTemplates, YAxis};
use fairpath_sketch::{Method, Parameter, Settings};
use serde_json::Value;

use crate::args::FitArgs;
use crate::{pictures, settings};

/// Pictures of the steps of a fit: a word for each and its SVG.
pub(crate) type Steps = Vec<(String, Vec<u8>)>;

/// A fitted stroke, for a method of French curves which of them it was drawn with, and pictures of the steps if asked for.
pub(crate) struct Fitted {
    pub(crate) fit: Fit,
    pub(crate) templates: Option<UsedTemplates>,
    pub(crate) steps: Steps,
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
pub(crate) struct MethodOptions {
    settings: Arc<Settings>,
    templates: Arc<TemplateSet>,
}

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
        let mut usual = Settings::of(asked.method, asked.preset);
        if let Some((size, closed)) = usual.stroke() {
            *size = asked.pixel_size.or(pixel_size_of_file).unwrap_or(*size);
            *closed = asked.closed.unwrap_or(*closed);
        }
        let settings = settings::apply_by(&usual, asked.set, Settings::with)?;
        settings.check()?;
        Ok(Self { settings: Arc::new(settings), templates: Arc::clone(templates) })
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
        let drawn = |fit: Fit, steps: Steps| Fitted { fit, templates: None, steps };
        match (&*self.settings, draw) {
            (Settings::ShortestPath(options), Some(y)) => {
                let mut stages = Stages::default();
                let fit = fit_observed(stroke, options, observer, Some(&mut stages))?;
                let steps = pictures::steps(stroke, &stages, &fit.spline, y);
                Ok(drawn(fit, steps))
            }
            (Settings::CurvatureSpace(options), Some(y)) => {
                let mut stages = CurvatureStages::default();
                let fit = fit_curvature_space_observed(stroke, options, observer, Some(&mut stages))?;
                let steps = pictures::curvature_steps(stroke, &stages, &fit.spline, y);
                Ok(drawn(fit, steps))
            }
            // The other methods have no steps to show.
            (settings, _) => {
                let (fit, templates) = settings.fit(stroke, Some(&self.templates), observer)?;
                Ok(Fitted { fit, templates, steps: Steps::new() })
            }
        }
    }

    /// Distance from its stroke that a curve should keep, in the stroke's unit.
    pub(crate) fn largest_deviation(&self) -> f64 {
        self.settings.largest_deviation()
    }

    /// The parameters and the values that they have.
    pub(crate) fn listed(&self) -> (Vec<Parameter>, Value) {
        (self.settings.parameters(), self.settings.values())
    }
}
