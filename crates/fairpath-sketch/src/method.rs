//! The methods by name, each with its options: a stroke comes in, a fitted curve goes out.

use crate::parameters::{Parameter, SettingError, parameters_of, with_parameter};
use fairpath_curve::{Continuity, Segment, Spline, Vec2, trig};
use fairpath_fit::{
    Closing, CubicOptions, CurvatureSpaceOptions, Fit, FitError, FitOptions, FrenchCurveOptions, LaplacianOptions,
    MvcOptions, Observer, Preset, Report, Stroke, TemplateSet, fit_cubic, fit_curvature_space_observed,
    fit_french_curve, fit_laplacian, fit_mvc, fit_observed,
};
use fairpath_io::UsedTemplates;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// How a stroke becomes a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Lines, arcs and clothoids by shortest paths (Baran, Lehtinen and Popović 2010).
    #[default]
    ShortestPath,
    /// Clothoids by pieces of linear curvature (McCrae and Singh 2008).
    CurvatureSpace,
    /// Parts of French curves (McCrae and Singh 2011).
    FrenchCurve,
    /// For comparison: each point towards the middle of its neighbours.
    Laplacian,
    /// For comparison: least-squares cubic Béziers (Schneider 1990).
    Cubic,
    /// For comparison: minimum variation of curvature (Moreton 1992).
    Mvc,
}

impl Method {
    /// All methods.
    pub const ALL: [Self; 6] =
        [Self::ShortestPath, Self::CurvatureSpace, Self::FrenchCurve, Self::Laplacian, Self::Cubic, Self::Mvc];

    /// Its name in files and on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::ShortestPath => "shortest-path",
            Self::CurvatureSpace => "curvature-space",
            Self::FrenchCurve => "french-curve",
            Self::Laplacian => "laplacian",
            Self::Cubic => "cubic",
            Self::Mvc => "mvc",
        }
    }

    /// What it is, in a phrase for people.
    #[must_use]
    pub const fn about(self) -> &'static str {
        match self {
            Self::ShortestPath => "Lines, arcs and clothoids by shortest paths (Baran, Lehtinen and Popović 2010)",
            Self::CurvatureSpace => "Clothoids by pieces of linear curvature (McCrae and Singh 2008)",
            Self::FrenchCurve => "Parts of French curves (McCrae and Singh 2011)",
            Self::Laplacian => "For comparison: each point towards the middle of its neighbours",
            Self::Cubic => "For comparison: least-squares cubic Béziers (Schneider 1990)",
            Self::Mvc => "For comparison: minimum variation of curvature (Moreton 1992)",
        }
    }

    /// The method of that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.name() == name)
    }
}

/// A method with everything that can be set about it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "method", content = "options", rename_all = "kebab-case")]
pub enum Settings {
    /// The points as they were drawn, joined by lines.
    Raw,
    /// See [`Method::ShortestPath`].
    ShortestPath(FitOptions),
    /// See [`Method::CurvatureSpace`].
    CurvatureSpace(CurvatureSpaceOptions),
    /// See [`Method::FrenchCurve`].
    FrenchCurve(FrenchCurveOptions),
    /// See [`Method::Laplacian`].
    Laplacian(LaplacianOptions),
    /// See [`Method::Cubic`].
    Cubic(CubicOptions),
    /// See [`Method::Mvc`].
    Mvc(MvcOptions),
}

impl Settings {
    /// The usual options of a method; those of a preset where it has some.
    #[must_use]
    pub fn of(method: Method, preset: Preset) -> Self {
        match method {
            Method::ShortestPath => Self::ShortestPath(FitOptions::preset(preset)),
            Method::CurvatureSpace => Self::CurvatureSpace(CurvatureSpaceOptions::default()),
            Method::FrenchCurve => Self::FrenchCurve(FrenchCurveOptions::default()),
            Method::Laplacian => Self::Laplacian(LaplacianOptions::default()),
            Method::Cubic => Self::Cubic(CubicOptions::default()),
            Method::Mvc => Self::Mvc(MvcOptions::default()),
        }
    }

    /// Size of a pixel in the stroke's unit, and whether strokes are closed; nothing where points stay as they are.
    pub fn stroke(&mut self) -> Option<(&mut f64, &mut Closing)> {
        let stroke = match self {
            Self::Raw => return None,
            Self::ShortestPath(options) => return Some((&mut options.pixel_size, &mut options.closed)),
            Self::CurvatureSpace(options) => &mut options.stroke,
            Self::FrenchCurve(options) => &mut options.stroke,
            Self::Laplacian(options) => &mut options.stroke,
            Self::Cubic(options) => &mut options.stroke,
            Self::Mvc(options) => &mut options.stroke,
        };
        Some((&mut stroke.pixel_size, &mut stroke.closed))
    }

    /// Distance from its stroke that a curve should keep, in the stroke's unit; infinite for a method that keeps none.
    #[must_use]
    pub fn largest_deviation(&self) -> f64 {
        match self {
            Self::Raw => 0.0,
            Self::ShortestPath(options) => options.max_error * options.pixel_size,
            Self::CurvatureSpace(options) => options.max_error * options.stroke.pixel_size,
            Self::FrenchCurve(options) => options.max_error * options.stroke.pixel_size,
            Self::Laplacian(_) => f64::INFINITY,
            Self::Cubic(options) => options.max_error * options.stroke.pixel_size,
            Self::Mvc(options) => options.max_error * options.stroke.pixel_size,
        }
    }

    /// Everything that can be set, for a form; nothing where points stay as they are.
    #[must_use]
    pub fn parameters(&self) -> Vec<Parameter> {
        match self {
            Self::Raw => Vec::new(),
            Self::ShortestPath(_) => parameters_of::<FitOptions>(),
            Self::CurvatureSpace(_) => parameters_of::<CurvatureSpaceOptions>(),
            Self::FrenchCurve(_) => parameters_of::<FrenchCurveOptions>(),
            Self::Laplacian(_) => parameters_of::<LaplacianOptions>(),
            Self::Cubic(_) => parameters_of::<CubicOptions>(),
            Self::Mvc(_) => parameters_of::<MvcOptions>(),
        }
    }

    /// The values that the parameters have: an object with a member for each.
    #[must_use]
    pub fn values(&self) -> Value {
        let written = match self {
            Self::Raw => Ok(Value::Object(serde_json::Map::new())),
            Self::ShortestPath(options) => serde_json::to_value(options),
            Self::CurvatureSpace(options) => serde_json::to_value(options),
            Self::FrenchCurve(options) => serde_json::to_value(options),
            Self::Laplacian(options) => serde_json::to_value(options),
            Self::Cubic(options) => serde_json::to_value(options),
            Self::Mvc(options) => serde_json::to_value(options),
        };
        // Numbers and words can always be written.
        written.unwrap_or_default()
    }

    /// The same with one parameter changed.
    ///
    /// # Errors
    /// When there is no such parameter, or the value is of the wrong kind; [`check`](Self::check) tells one that is out of its range.
    pub fn with(&self, name: &str, value: &Value) -> Result<Self, SettingError> {
        Ok(match self {
            Self::Raw => return Err(SettingError::Unknown { name: name.into(), near: Vec::new() }),
            Self::ShortestPath(options) => Self::ShortestPath(with_parameter(options, name, value)?),
            Self::CurvatureSpace(options) => Self::CurvatureSpace(with_parameter(options, name, value)?),
            Self::FrenchCurve(options) => Self::FrenchCurve(with_parameter(options, name, value)?),
            Self::Laplacian(options) => Self::Laplacian(with_parameter(options, name, value)?),
            Self::Cubic(options) => Self::Cubic(with_parameter(options, name, value)?),
            Self::Mvc(options) => Self::Mvc(with_parameter(options, name, value)?),
        })
    }

    /// Whether every option makes sense.
    ///
    /// # Errors
    /// [`FitError::BadOption`] for the first that does not.
    pub fn check(&self) -> Result<(), FitError> {
        match self {
            Self::Raw => Ok(()),
            Self::ShortestPath(options) => options.validate(),
            Self::CurvatureSpace(options) => options.validate(),
            Self::FrenchCurve(options) => options.validate(),
            Self::Laplacian(options) => options.validate(),
            Self::Cubic(options) => options.validate(),
            Self::Mvc(options) => options.validate(),
        }
    }

    /// Fits a stroke, telling `observer` of the steps if the method has any. `templates` are for the method that draws with them; without any it cannot.
    ///
    /// # Errors
    /// As the method; without templates [`FitError::Unfittable`].
    pub fn fit(
        &self,
        stroke: &Stroke,
        templates: Option<&TemplateSet>,
        observer: &mut dyn Observer,
    ) -> Result<(Fit, Option<UsedTemplates>), FitError> {
        let plain = match self {
            Self::Raw => raw(stroke),
            Self::ShortestPath(options) => fit_observed(stroke, options, observer, None),
            Self::CurvatureSpace(options) => fit_curvature_space_observed(stroke, options, observer, None),
            Self::FrenchCurve(options) => {
                let set = templates.ok_or(FitError::Unfittable { points: stroke.points.len() })?;
                let found = fit_french_curve(stroke, set, options)?;
                let used = UsedTemplates::new(set, &found.pieces);
                return Ok((found.fit, Some(used)));
            }
            Self::Laplacian(options) => fit_laplacian(stroke, options),
            Self::Cubic(options) => fit_cubic(stroke, options),
            Self::Mvc(options) => fit_mvc(stroke, options),
        };
        plain.map(|fit| (fit, None))
    }
}

/// The stroke itself: a line from each point to the next that differs from it.
fn raw(stroke: &Stroke) -> Result<Fit, FitError> {
    if let Some(index) = stroke.points.iter().position(|p| !p.is_finite()) {
        return Err(FitError::NotFinite { index });
    }
    let points = stroke.points.len();
    let mut segments = Vec::with_capacity(points);
    let mut from = stroke.points.first().copied().unwrap_or_default();
    for &to in stroke.points.iter().skip(1) {
        let step: Vec2 = to - from;
        let line = Segment::line(from, trig::angle_of(step), step.hypot());
        if line.is_valid() {
            segments.push(line);
            from = to;
        }
    }
    let joins = vec![Continuity::G0; segments.len().saturating_sub(1)];
    let spline = Spline::new(segments, joins, false).map_err(|_| FitError::TooShort { points, extent: 0.0 })?;
    let report = Report { points, pieces: spline.segments().len(), ..Report::default() };
    Ok(Fit { spline, report, warnings: Vec::new() })
}
