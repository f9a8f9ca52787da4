//! Time of a picture: `cargo run --release -p fairpath-render --example frame_time [SOFTWARE]`.
//!
//! Draws a ball of about 50,000 triangles from changing sides, waits for the device each time, and prints the milliseconds of a picture and of what comes
//! before the first.

use fairpath_curve::{Continuity, Point, Segment, Spline};
use fairpath_render::{Adapter, Camera, Finish, Look, Offscreen, RenderError, YAxis, Zebra};
use fairpath_shape::{InflateOptions, inflate};
use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::time::Instant;

/// Triangles asked for.
const TRIANGLES: u32 = 50_000;
/// Pictures of which the median is taken.
const PICTURES: usize = 60;
/// What the surface is turned by from one picture to the next, radians.
const TURN_RAD: f64 = 0.1;

fn main() -> Result<(), Box<dyn Error>> {
    let adapter = if std::env::args().len() > 1 { Adapter::Software } else { Adapter::Best };
    let circle = Segment::arc(Point::new(1.0, 0.0), PI / 2.0, TAU, 1.0);
    let spline = Spline::new(vec![circle], vec![Continuity::G1], true)?;
    let mesh = inflate(&spline, &InflateOptions { triangles: TRIANGLES, ..InflateOptions::default() })?.mesh;

    let begun = Instant::now();
    let mut offscreen = Offscreen::new(adapter)?;
    println!("device      {:8.2} ms  {}", ms(begun), offscreen.adapter());
    let begun = Instant::now();
    let uploaded = offscreen.upload(&[&mesh], YAxis::Up)?;
    println!("upload      {:8.2} ms  {} triangles", ms(begun), mesh.triangles.len());

    let clay = Look::light();
    let zebra = Look { finish: Finish::Zebra(Zebra::default()), ..clay };
    for (name, look) in [("clay", clay), ("zebra", zebra)] {
        for size_px in [[400, 300], [800, 600], [1600, 1200]] {
            let camera = Camera::default().fitted_to(&uploaded.bounds(), f64::from(size_px[0]) / f64::from(size_px[1]));
            let mut times = (0..PICTURES)
                .map(|i| {
                    let camera = camera.orbited(TURN_RAD * i as f64, 0.0);
                    let begun = Instant::now();
                    offscreen.draw(&uploaded, &camera, size_px, &look)?;
                    Ok(ms(begun))
                })
                .collect::<Result<Vec<f64>, RenderError>>()?;
            let first = times[0];
            times.sort_by(f64::total_cmp);
            let [width, height] = size_px;
            println!("{name:<6} {width:>4} × {height:<4} {:8.2} ms  the first {first:.2} ms", times[PICTURES / 2]);
        }
    }
    Ok(())
}

fn ms(begun: Instant) -> f64 {
    begun.elapsed().as_secs_f64() * 1e3
}
