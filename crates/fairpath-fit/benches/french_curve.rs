//! Times of fits with French curves over the number of points, as figure 10 of McCrae and Singh (2011) shows them, asserted on what they time: by the
//! optimal search and by the greedy one; and the longest time that a point takes of a stroke that is neatened while it is drawn.
//!
//! `cargo bench -p fairpath-fit --bench french_curve`

#[path = "../tests/common/templates.rs"]
#[expect(dead_code, reason = "the tests use more templates")]
mod templates;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fairpath_curve::Point;
use fairpath_fit::{FrenchCurveOptions, FrenchCurveStream, PieceSearch, Stroke, TemplateSet, fit_french_curve};
use std::hint::black_box;
use std::time::Instant;

/// Bends of changing size, a point every 5 px, shaken by about half a pixel: the same on every run.
fn stroke(points: usize) -> Stroke {
    let tremor = |i: f64| 0.4 * (1.7 * i).sin() + 0.3 * (5.3 * i).sin();
    let mut heading = 0.0_f64;
    let mut at = Point::ORIGIN;
    let points = (0..points)
        .map(|i| {
            let s = 5.0 * i as f64;
            heading += 5.0 * (0.012 * (s / 90.0).sin() + 0.008 * (s / 37.0).cos());
            at += fairpath_curve::Vec2::new(heading.cos(), heading.sin()) * 5.0;
            at + fairpath_curve::Vec2::new(tremor(i as f64), tremor(i as f64 + 7.5))
        })
        .collect();
    Stroke::new("bends", points)
}

const SIZES: [usize; 6] = [50, 100, 200, 500, 1000, 2000];

fn options(search: PieceSearch) -> FrenchCurveOptions {
    FrenchCurveOptions { search, ..FrenchCurveOptions::default() }
}

fn checked(stroke: &Stroke, set: &TemplateSet, search: PieceSearch) -> usize {
    let fit = fit_french_curve(stroke, set, &options(search)).expect("it is a curve");
    assert!(fit.fit.report.rms_deviation < 3.0, "{:?}", fit.fit.report);
    assert!(fit.pieces.len() > stroke.points.len() / 60, "{} pieces", fit.pieces.len());
    fit.pieces.len()
}

fn fits(c: &mut Criterion) {
    let set = templates::burmester();
    for search in [PieceSearch::Optimal, PieceSearch::Greedy] {
        let mut rows = Vec::new();
        let mut group = c.benchmark_group(format!("french curves, {search:?}"));
        for points in SIZES {
            let stroke = stroke(points);
            let pieces = checked(&stroke, &set, search);
            let options = options(search);
            let time = || {
                let begin = Instant::now();
                black_box(fit_french_curve(black_box(&stroke), &set, &options)).expect("it is a curve");
                begin.elapsed().as_secs_f64() * 1e3
            };
            rows.push((points, pieces, (0..5).map(|_| time()).fold(f64::INFINITY, f64::min)));
            group.throughput(Throughput::Elements(points as u64)).sample_size(10);
            group.bench_function(BenchmarkId::from_parameter(points), |b| {
                b.iter(|| fit_french_curve(black_box(&stroke), &set, &options));
            });
        }
        group.finish();
        println!("{search:?}: points, pieces, ms");
        rows.iter().for_each(|(points, pieces, ms)| println!("{points:6} {pieces:4} {ms:9.2}"));
        let (a, b) = (rows[2], rows[5]);
        println!(
            "growth from {} to {} points: exponent {:.2}",
            a.0,
            b.0,
            (b.2 / a.2).ln() / (b.0 as f64 / a.0 as f64).ln()
        );
    }
}

fn stream(c: &mut Criterion) {
    let set = templates::burmester();
    let stroke = stroke(2000);
    let options = options(PieceSearch::Greedy);
    let mut longest = f64::INFINITY;
    for _ in 0..5 {
        let mut stream = FrenchCurveStream::new(&set, &options).expect("the options are good");
        let (mut slowest, mut settled) = (0.0_f64, 0);
        for &point in &stroke.points {
            let begin = Instant::now();
            settled += stream.push(point).len();
            slowest = slowest.max(begin.elapsed().as_secs_f64() * 1e3);
        }
        assert!(settled > 30, "{settled} pieces were settled");
        longest = longest.min(slowest);
    }
    println!("longest time of one of 2000 points: {longest:.2} ms");
    assert!(longest < 50.0, "a point took {longest} ms");
    c.bench_function("french curves, 2000 points as they come", |b| {
        b.iter(|| {
            let mut stream = FrenchCurveStream::new(&set, &options).expect("the options are good");
            stroke.points.iter().map(|&p| stream.push(p).len()).sum::<usize>()
        });
    });
}

criterion_group!(benches, fits, stream);
criterion_main!(benches);
