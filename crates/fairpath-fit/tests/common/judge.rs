//! What must be true of the fit of any stroke whatever, judged without the help of the code that made it.

use fairpath_curve::{Continuity, Point, Segment, Spline, trig};
use fairpath_fit::{Fit, FitError, FitOptions, Stroke, fit};

/// The words for programs that a failure may carry.
const CODES: [&str; 5] = ["too-short", "too-large", "not-finite", "unfittable", "bad-option"];

/// What a gap at a join may be: in position relative to the drawing's extent, in heading in radians, in curvature relative to
/// one over a pixel.
const EXACT: f64 = 1e-9;

/// Fits and asserts everything that holds for any stroke; the fit, or the word for what failed.
pub(crate) fn judged(stroke: &Stroke, options: &FitOptions) -> Result<Fit, &'static str> {
    match fit(stroke, options) {
        Ok(fit) => {
            assert_sound(&fit, stroke, options);
            Ok(fit)
        }
        Err(e) => {
            assert!(CODES.contains(&e.code()), "{e}");
            if let FitError::NotFinite { index } = e {
                let first = stroke.points.iter().position(|p| !(p.x.is_finite() && p.y.is_finite()));
                assert_eq!(first, Some(index));
            }
            Err(e.code())
        }
    }
}

/// As [`judged`] where there must be a fit.
pub(crate) fn fitted(stroke: &Stroke, options: &FitOptions) -> Fit {
    judged(stroke, options).unwrap_or_else(|code| panic!("{}: {code}", stroke.name))
}

fn assert_sound(fit: &Fit, stroke: &Stroke, options: &FitOptions) {
    let name = &stroke.name;
    let spline = &fit.spline;
    let again = Spline::new(spline.segments().to_vec(), spline.joins().to_vec(), spline.is_closed());
    assert_eq!(again.as_ref(), Ok(spline), "{name}");
    let size = extent(&stroke.points).max(options.pixel_size);
    let n = spline.segments().len();
    for (i, join) in spline.joins().iter().enumerate() {
        let (a, b) = (&spline.segments()[i], &spline.segments()[(i + 1) % n]);
        let end = a.end_pose();
        let apart = (end.point - b.start).hypot();
        // Positions near coordinate x are known to x times 1e-16 only.
        let rounding = 1e-14 * (a.start.x.abs() + a.start.y.abs());
        assert!(apart <= EXACT * size + rounding, "{name}: join {i} is open by {apart:e}");
        if *join >= Continuity::G1 {
            let turn = trig::wrap_angle(end.heading - b.heading).abs();
            assert!(turn <= EXACT, "{name}: join {i} turns by {turn:e}");
        }
        if *join >= Continuity::G2 {
            let bend = (end.curvature - b.kappa0).abs() * options.pixel_size;
            assert!(bend <= EXACT, "{name}: curvature jumps by {bend:e} per px at join {i}");
        }
    }
    assert_eq!(fit.report.points, stroke.points.len(), "{name}");
    assert_eq!(fit.report.inflections, inflections(spline, options), "{name}: inflections");
    let (largest, rms, sagitta) = deviation(spline, &stroke.points);
    // Points far from the origin are not known better than to the rounding of their coordinates.
    let away = stroke.points.iter().fold(0.0_f64, |m, p| m.max(p.x.abs()).max(p.y.abs()));
    let tolerance = sagitta + 1e-9 * size + 1e-14 * away;
    let report = &fit.report;
    assert!((report.max_deviation - largest).abs() <= tolerance, "{name}: {} but {largest}", report.max_deviation);
    assert!((report.rms_deviation - rms).abs() <= tolerance, "{name}: {} but {rms}", report.rms_deviation);
    if report.max_deviation > 1.5 * options.max_error * options.pixel_size {
        assert!(!fit.warnings.is_empty(), "{name}: {} away from the stroke without a word", report.max_deviation);
    }
}

/// Sign changes of the curvature, what bends less than 1e-9 radians per px counted as straight.
fn inflections(spline: &Spline, options: &FitOptions) -> usize {
    let bends = spline.segments().iter().flat_map(|s| [s.kappa0, s.kappa1]);
    let signs: Vec<bool> = bends.filter(|k| k.abs() * options.pixel_size > 1e-9).map(|k| k > 0.0).collect();
    signs.windows(2).filter(|s| s[0] != s[1]).count()
}

/// The longer side of the box around the points.
pub(crate) fn extent(points: &[Point]) -> f64 {
    let range = |f: fn(&Point) -> f64| {
        let values = points.iter().map(f);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    range(|p| p.x).max(range(|p| p.y))
}

/// Radians that one chord may span.
const STEP: f64 = 0.02;

/// Number of chords of a segment of at most [`STEP`] radians, and a bound of how far it is from them.
fn chords(s: &Segment) -> (usize, f64) {
    let turning = s.kappa0.abs().max(s.kappa1.abs()) * s.length;
    let n = ((turning / STEP).ceil() as usize).clamp(1, 100_000);
    (n, 0.13 * s.length * turning / (n * n) as f64)
}

/// Largest and root mean square distance of the points to chords of the spline, and how far the chords may be from it.
fn deviation(spline: &Spline, points: &[Point]) -> (f64, f64, f64) {
    let mut nearest = vec![f64::INFINITY; points.len()];
    let mut off = 0.0_f64;
    for s in spline.segments() {
        let (n, sagitta) = chords(s);
        off = off.max(sagitta);
        let mut a = s.start;
        for k in 1..=n {
            let b = s.point_at(s.length * k as f64 / n as f64);
            for (p, d) in points.iter().zip(&mut nearest) {
                *d = d.min(to_chord(*p, a, b));
            }
            a = b;
        }
    }
    let squares: f64 = nearest.iter().map(|d| d * d).sum();
    (nearest.iter().fold(0.0, |m, d| m.max(*d)), (squares / points.len() as f64).sqrt(), off)
}

fn to_chord(p: Point, a: Point, b: Point) -> f64 {
    let v = b - a;
    let u = if v.hypot2() > 0.0 { ((p - a).dot(v) / v.hypot2()).clamp(0.0, 1.0) } else { 0.0 };
    (p - (a + v * u)).hypot()
}
