//! A rough stroke in, a fair curve out.
//!
//! `cargo run -p fairpath-fit --example hello_fit`

use fairpath_curve::Point;
use fairpath_fit::{FitError, FitOptions, Stroke, fit};

fn main() -> Result<(), FitError> {
    // A wave as a shaky hand draws it, in pixels.
    let points = (0..80).map(f64::from).map(|i| {
        let tremor = 0.6 * (2.1 * i).sin();
        Point::new(4.0 * i, 100.0 + 50.0 * (0.08 * i).sin() + tremor)
    });
    let stroke = Stroke::new("wave", points.collect());

    let fit = fit(&stroke, &FitOptions::default())?;

    for (i, segment) in fit.spline.segments().iter().enumerate() {
        println!(
            "{:?} of {:.1} px from ({:.1}, {:.1}), curvature {:.4} to {:.4} per px",
            segment.kind(),
            segment.length,
            segment.start.x,
            segment.start.y,
            segment.kappa0,
            segment.kappa1,
        );
        if let Some(join) = fit.spline.joins().get(i) {
            println!("  {join:?}");
        }
    }
    println!("at most {:.2} px from the {} points", fit.report.max_deviation, fit.report.points);
    for warning in &fit.warnings {
        println!("{}: {}", warning.code, warning.text);
    }
    Ok(())
}
