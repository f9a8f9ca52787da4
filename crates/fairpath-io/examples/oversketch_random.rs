//! Corrections at random of fitted strokes: how many fail, how far the new curves are from what was drawn, how well they meet what stays, and
//! how long it takes. `cargo run --release -p fairpath-io --example oversketch_random -- COUNT PICTURE.png STROKES.json…`; the picture shows those
//! that came with warnings and the farthest of the others.

use fairpath_curve::{Point, Spline, Vec2};
use fairpath_fit::{FitOptions, OversketchOptions, Oversketched, Stroke, fit, oversketch, oversketch_region};
use fairpath_io::picture::{Comb, Correction, PictureOptions, draw_corrections};
use fairpath_io::{ReadOptions, YAxis, read_strokes, write_whole};
use std::path::Path;
use std::time::Instant;

/// Numbers that look random and are the same on every run.
struct Lcg(u64);

impl Lcg {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// A stroke along a random part of a curve, bent away from it and shaken, perhaps past an end, perhaps against the curve.
fn over(spline: &Spline, random: &mut Lcg) -> Stroke {
    let length = spline.length();
    let span = random.between(0.08, 0.5) * length;
    let from =
        if spline.is_closed() { random.between(0.0, length) } else { random.between(-0.1, 1.0) * (length - span) };
    let height = random.between(-0.35, 0.35) * span;
    let off = Vec2::new(random.between(-6.0, 6.0), random.between(-6.0, 6.0));
    let count = (span / random.between(3.0, 9.0)).ceil().max(4.0) as usize;
    let at = |u: f64| {
        let s = from + u * span;
        let inside = if spline.is_closed() { s } else { s.clamp(0.0, length) };
        let (pose, tangent) = (spline.pose_at(inside), spline.tangent_at(inside));
        let bump = (std::f64::consts::PI * u).sin();
        pose.point + tangent * (s - inside) + Vec2::new(-tangent.y, tangent.x) * (height * bump * bump) + off
    };
    let mut points: Vec<Point> = Vec::new();
    for i in 0..=count {
        let tremor = Vec2::new(random.between(-0.5, 0.5), random.between(-0.5, 0.5));
        points.push(at(i as f64 / count as f64) + tremor);
    }
    if random.unit() < 0.5 {
        points.reverse();
    }
    Stroke::new("over", points)
}

/// Segments of the result that are, to the bit, segments of the old curve.
fn kept(old: &Spline, done: &Oversketched) -> usize {
    let bits =
        |s: &fairpath_curve::Segment| [s.start.x, s.start.y, s.heading, s.length, s.kappa0, s.kappa1].map(f64::to_bits);
    let before: Vec<_> = old.segments().iter().map(bits).collect();
    let outside = done.spline.segments().iter().enumerate().filter(|(i, _)| !done.new.contains(i));
    outside.filter(|(_, s)| before.contains(&bits(s))).count()
}

fn main() {
    let mut args = std::env::args().skip(1);
    let usage = "usage: oversketch_random COUNT PICTURE.png STROKES.json…";
    let count: usize = args.next().and_then(|n| n.parse().ok()).expect(usage);
    let picture = args.next().expect(usage);
    let read = |path: String| read_strokes(Path::new(&path), &ReadOptions::default()).expect("strokes").strokes;
    let strokes: Vec<Stroke> = args.flat_map(read).collect();
    let mut shown: Vec<(String, Spline, Stroke, Oversketched)> = Vec::new();
    let options = OversketchOptions::default();
    let mut random = Lcg(7);
    let (mut done, mut failed, mut warned) = (0, 0, 0);
    let (mut ms, mut deviations, mut jumps, mut region_us) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut pieces = Vec::new();
    while done + failed < count {
        let stroke = &strokes[(random.unit() * strokes.len() as f64) as usize % strokes.len()];
        let Ok(old) = fit(stroke, &FitOptions::default()) else { continue };
        let old = old.spline;
        if old.length() < 60.0 {
            continue;
        }
        let sketch = over(&old, &mut random);
        let begin = Instant::now();
        let region = oversketch_region(&old, &sketch, &options);
        region_us.push(begin.elapsed().as_secs_f64() * 1e6);
        let begin = Instant::now();
        match oversketch(&old, &sketch, &options) {
            Ok(result) => {
                ms.push(begin.elapsed().as_secs_f64() * 1e3);
                done += 1;
                deviations.push(result.report.max_deviation);
                jumps.push(jump(&result));
                pieces.push(result.new.len() as f64);
                assert!(region.is_ok_and(|r| r == result.region), "the preview tells what will be done");
                let outside = result.spline.segments().len() - result.new.len();
                assert!(kept(&old, &result) + 2 >= outside, "{}: what stays has changed", stroke.name);
                let codes: Vec<&str> = result.warnings.iter().map(|w| w.code.as_str()).collect();
                let off = result.report.max_deviation;
                let title = format!("{} {done}: {} {off:.2} PX OFF", stroke.name, codes.join(" "));
                warned += usize::from(!codes.is_empty());
                shown.push((title, old, sketch, result));
            }
            Err(error) => {
                failed += 1;
                println!("{}: {error}", stroke.name);
            }
        }
    }
    println!("{done} corrected, {failed} failed, {warned} with warnings");
    shown.sort_by(|a, b| {
        let badness = |s: &Oversketched| s.report.max_deviation + 1e3 * s.warnings.len() as f64;
        badness(&b.3).total_cmp(&badness(&a.3))
    });
    let worst = |s: &(String, Spline, Stroke, Oversketched)| !s.3.warnings.is_empty();
    let rows = shown.iter().filter(|s| worst(s)).count().max(12).min(shown.len());
    let corrections: Vec<Correction<'_>> = shown[..rows]
        .iter()
        .map(|(name, before, stroke, result)| Correction { name, before, stroke, result })
        .collect();
    let mut drawn = PictureOptions::default();
    drawn.comb = Comb::Auto;
    let sheet = draw_corrections(&corrections, YAxis::Down, &drawn);
    write_whole(Path::new(&picture), &sheet.to_png().expect("a picture")).expect("the picture is written");
    print("time, ms", &mut ms);
    print("preview, µs", &mut region_us);
    print("largest deviation from the integrated stroke, px", &mut deviations);
    print("segments of the new part", &mut pieces);
    print("largest jump of curvature at G2 joins of the new part, 1/px", &mut jumps);
}

/// The largest jump of curvature at what are said to be G2 joins.
fn jump(result: &Oversketched) -> f64 {
    let s = result.spline.segments();
    let joins = result.spline.joins().iter().enumerate().filter(|(_, j)| **j >= fairpath_curve::Continuity::G2);
    joins.map(|(i, _)| (s[i].kappa1 - s[(i + 1) % s.len()].kappa0).abs()).fold(0.0, f64::max)
}

fn print(what: &str, values: &mut [f64]) {
    values.sort_by(f64::total_cmp);
    let at = |q: f64| values.get((q * (values.len() - 1) as f64) as usize).copied().unwrap_or(f64::NAN);
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    println!(
        "{what}: mean {mean:.3e}, median {:.3e}, 90 % {:.3e}, 99 % {:.3e}, most {:.3e}",
        at(0.5),
        at(0.9),
        at(0.99),
        at(1.0)
    );
}
