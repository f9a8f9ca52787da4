//! The methods by name, each with its options: a stroke comes in, a fitted curve goes out.

use fairpath_curve::{Continuity, Segment, Spline, Vec2, trig};
use fairpath_fit::{
    Closing, CubicOptions, CurvatureSpaceOptions, Fit, FitError, FitOptions, FrenchCurveOptions, LaplacianOptions,
    MvcOptions, Preset, Report, Stroke, TemplateSet, fit, fit_cubic, fit_curvature_space, fit_french_curve,
    fit_laplacian, fit_mvc,
};
use fairpath_io::UsedTemplates;
use serde::{Deserialize, Serialize};

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

    /// Fits a stroke. `templates` are for the method that draws with them; without any it cannot.
    ///
    /// # Errors
    /// As the method; without templates [`FitError::Unfittable`].
    pub fn fit(
        &self,
        stroke: &Stroke,
        templates: Option<&TemplateSet>,
    ) -> Result<(Fit, Option<UsedTemplates>), FitError> {
        let plain = match self {
            Self::Raw => raw(stroke),
            Self::ShortestPath(options) => fit(stroke, options),
            Self::CurvatureSpace(options) => fit_curvature_space(stroke, options),
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
