//! One slider from as drawn to fairest: options of a method and a place on the slider come in, options go out.
//!
//! In the middle a method is what its preset says. To the sides, what deviation costs and how much of it is allowed are multiplied by factors that lie
//! on a smooth scale through the values that the presets *accurate* (a quarter) and *loose* (three quarters) of the shortest-path method have.

use crate::method::Settings;

/// The middle of the slider, where options are those of the preset.
pub(crate) const MIDDLE: f64 = 0.5;

/// Factors at 0, a quarter, the middle, three quarters and 1 of the slider.
type Scale = [f64; 5];

/// Of what deviation costs.
const ERROR_COST: Scale = [12.0, 3.0, 1.0, 0.2, 0.03];
/// Of the deviation at which a candidate is given up.
const MAX_ERROR: Scale = [0.6, 0.8, 1.0, 1.6, 3.0];
/// Of the deviation that costs nothing.
const FREE_ERROR: Scale = [0.3, 0.55, 1.0, 1.0, 1.6];
/// Of samples on a circle.
const SAMPLING: Scale = [1.4, 1.2, 1.0, 1.0, 1.0];
/// Of a deviation to be aimed at.
const TARGET: Scale = [0.3, 0.55, 1.0, 1.8, 3.5];
/// Of what a piece costs, in units of curvature.
const PIECE_COST: Scale = [0.2, 0.5, 1.0, 2.5, 8.0];
/// Of how far a stroke is blurred.
const BLUR: Scale = [0.25, 0.5, 1.0, 2.0, 5.0];

/// Options for a place on the slider, from 0 (nearest to the stroke) to 1 (fairest).
pub(crate) fn at(settings: Settings, place: f64) -> Settings {
    // The factors of the middle are 1, but options that nobody moved shall not even be rounded.
    if place == MIDDLE {
        return settings;
    }
    let by = |scale: Scale| factor(scale, place);
    match settings {
        Settings::Raw => Settings::Raw,
        Settings::ShortestPath(mut options) => {
            options.error_cost *= by(ERROR_COST);
            options.max_error *= by(MAX_ERROR);
            options.free_error *= by(FREE_ERROR);
            options.points_per_circle *= by(SAMPLING);
            Settings::ShortestPath(options)
        }
        Settings::CurvatureSpace(mut options) => {
            options.target_error = options.target_error.map(|error| error * by(TARGET));
            options.max_error *= by(MAX_ERROR);
            options.piece_cost *= by(PIECE_COST);
            Settings::CurvatureSpace(options)
        }
        Settings::FrenchCurve(mut options) => {
            options.piece_cost *= by(PIECE_COST);
            options.greedy_error *= by(PIECE_COST);
            options.end_threshold = options.end_threshold.map(|error| error * by(TARGET));
            options.max_error *= by(MAX_ERROR);
            Settings::FrenchCurve(options)
        }
        Settings::Laplacian(mut options) => {
            // The blur grows with the root of their number.
            let times = by(BLUR) * by(BLUR);
            options.iterations = (f64::from(options.iterations) * times).round().max(1.0) as u32;
            Settings::Laplacian(options)
        }
        Settings::Cubic(mut options) => {
            options.tolerance *= by(TARGET);
            options.max_error *= by(TARGET);
            Settings::Cubic(options)
        }
        Settings::Mvc(mut options) => {
            options.smoothing_length *= by(BLUR);
            options.max_error *= by(TARGET);
            Settings::Mvc(options)
        }
    }
}

/// The factor at a place: logarithms run straight between the given ones.
fn factor(scale: Scale, place: f64) -> f64 {
    let u = place.clamp(0.0, 1.0) * 4.0;
    let i = (u as usize).min(3);
    // The platform's logarithm may differ in the last bit from place to place; the same slider shall give the same curve.
    let (a, b) = (libm::log(scale[i]), libm::log(scale[i + 1]));
    libm::exp(a + (b - a) * (u - i as f64))
}
