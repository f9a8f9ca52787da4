//! How the time of inflating grows with the number of triangles.
//!
//! `cargo run --release -p fairpath-shape --example growth`

#[path = "../tests/common/shapes.rs"]
mod shapes;

use fairpath_shape::{InflateOptions, inflate};
use std::time::Instant;

fn main() {
    println!("shape                asked  triangles  rim   ms      µs/triangle  volume     least angle");
    let star: Vec<(f64, f64)> = (0..10)
        .map(|i| {
            let (t, r) = (f64::from(i) * std::f64::consts::PI / 5.0, if i % 2 == 0 { 1.0 } else { 0.45 });
            (r * t.cos(), r * t.sin())
        })
        .collect();
    let cases = [
        ("circle", shapes::circle((0.0, 0.0), 1.0)),
        ("ellipse 3:1", shapes::ellipse(3.0, 1.0, 0.3)),
        ("ellipse 100:1", shapes::ellipse(100.0, 1.0, 0.3)),
        ("flower", shapes::flower(5, 0.3)),
        ("square", shapes::polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])),
        ("star", shapes::polygon(&star)),
    ];
    for (name, spline) in &cases {
        for triangles in [500, 5_000, 20_000, 50_000, 200_000] {
            let options = InflateOptions { triangles, ..InflateOptions::default() };
            let begun = Instant::now();
            let inflated = match inflate(spline, &options) {
                Ok(inflated) => inflated,
                Err(error) => {
                    println!("{name:<20} {triangles:>6}  {error}");
                    continue;
                }
            };
            let ms = begun.elapsed().as_secs_f64() * 1e3;
            let mesh = &inflated.mesh;
            let count = mesh.triangles.len();
            let faults = mesh.faults();
            let mut angles: Vec<f64> = mesh.triangles.iter().map(|&t| mesh.least_angle_of(t).to_degrees()).collect();
            angles.sort_by(f64::total_cmp);
            let low = angles.iter().filter(|a| **a < 20.0).count() as f64 / angles.len() as f64;
            println!(
                "{name:<20} {triangles:>6}  {count:>8}  {:>5}  {ms:>7.1}  {:>6.2}  {:.6}  {:.1}° {:.1}° {:.1}° {low:.4}  {}",
                inflated.rims.iter().map(|rim| rim.len()).sum::<usize>(),
                ms * 1e3 / count as f64,
                mesh.volume(),
                angles[0],
                angles[angles.len() / 100],
                angles[angles.len() / 2],
                faults.first().map_or_else(|| "sound".to_owned(), |f| format!("{} faults: {f}", faults.len())),
            );
        }
    }
}
