//! Inflated shapes against surfaces that are known, and against what every surface must keep.

#[path = "common/shapes.rs"]
mod shapes;

use fairpath_curve::{Continuity, Point, Segment, Similarity, Spline};
use fairpath_fit::{FitOptions, Stroke, fit};
use fairpath_shape::{InflateError, InflateOptions, Inflated, Mesh, inflate};
use proptest::prelude::*;
use std::f64::consts::PI;
use std::path::Path;

fn with(triangles: u32) -> InflateOptions {
    InflateOptions { triangles, ..InflateOptions::default() }
}

#[track_caller]
fn surface(spline: &Spline, options: &InflateOptions) -> Mesh {
    inflate(spline, options).expect("it can be inflated").mesh
}

/// Ends the test unless the surface is closed, oriented outwards and like a sphere.
#[track_caller]
fn assert_sound(mesh: &Mesh, what: &str) {
    let faults = mesh.faults();
    assert!(faults.is_empty(), "{what}: {} faults, first {}", faults.len(), faults[0]);
    assert_eq!(mesh.euler_characteristic(), 2, "{what}");
    assert!(mesh.volume() > 0.0, "{what}: volume {}", mesh.volume());
}

/// Largest difference from 1 of the length that an ellipsoid's own measure gives its vertices, and largest angle of a normal, radians.
fn off_ellipsoid(mesh: &Mesh, axes: [f64; 3], turned: f64) -> (f64, f64) {
    let (sin, cos) = turned.sin_cos();
    let mut worst = (0.0_f64, 0.0_f64);
    for (v, n) in mesh.vertices.iter().zip(&mesh.normals) {
        let turn = |v: &[f64; 3]| [cos * v[0] + sin * v[1], cos * v[1] - sin * v[0], v[2]];
        let (v, n) = (turn(v), turn(n));
        let measure: f64 = (0..3).map(|k| (v[k] / axes[k]).powi(2)).sum();
        worst.0 = worst.0.max((measure.sqrt() - 1.0).abs());
        let exact = [0, 1, 2].map(|k| v[k] / (axes[k] * axes[k]));
        let length = exact.iter().map(|x| x * x).sum::<f64>().sqrt();
        let cosine: f64 = (0..3).map(|k| n[k] * exact[k] / length).sum();
        worst.1 = worst.1.max(cosine.clamp(-1.0, 1.0).acos());
    }
    worst
}

#[test]
fn a_circle_becomes_its_sphere() {
    let radius = 30.0;
    let mesh = surface(&shapes::circle((0.0, 0.0), radius), &InflateOptions::default());
    assert_sound(&mesh, "circle");
    let (off, angle) = off_ellipsoid(&mesh, [radius; 3], 0.0);
    assert!(off < 1e-3 && angle < 0.02, "{off:e} of the radius, normals {angle:e} rad");
    let exact = 4.0 / 3.0 * PI * radius.powi(3);
    assert!((mesh.volume() / exact - 1.0).abs() < 1.5e-3, "volume {} of {exact}", mesh.volume());
    assert!((mesh.area() / (4.0 * PI * radius * radius) - 1.0).abs() < 1.5e-3, "area {}", mesh.area());
    assert!(mesh.least_angle().to_degrees() > 15.0, "{}", mesh.least_angle().to_degrees());
}

#[test]
fn an_ellipse_becomes_its_ellipsoid_and_nearer_with_more_triangles() {
    // Δu = −4 on an ellipse has the solution c² (1 − x²/a² − y²/b²) with c² = 2 / (1/a² + 1/b²).
    for (a, b, turned) in [(3.0, 2.0, 0.4), (3.0, 1.0, -1.1)] {
        let c = (2.0_f64 / (1.0 / (a * a) + 1.0 / (b * b))).sqrt();
        let spline = shapes::ellipse(a, b, turned);
        let errors = [1_000, 4_000, 16_000].map(|triangles| {
            let mesh = surface(&spline, &with(triangles));
            let (off, angle) = off_ellipsoid(&mesh, [a, b, c], turned);
            let volume = (mesh.volume() / (4.0 / 3.0 * PI * a * b * c) - 1.0).abs();
            assert!(angle < 0.25, "{a}:{b} with {triangles}: normals are {angle} rad off");
            [off, volume]
        });
        // Four times the triangles are half the edges: errors of the second order are a quarter.
        assert!(errors[2][0] < 0.2 * errors[0][0] && errors[2][0] < 5e-3, "{a}:{b} {errors:?}");
        assert!(errors[2][1] < 0.2 * errors[0][1] && errors[2][1] < 5e-3, "{a}:{b} {errors:?}");
    }
}

#[test]
fn the_rim_lies_on_the_curve_within_the_accuracy_and_its_normals_are_level() {
    let spline = shapes::flower(5, 0.3);
    let options = InflateOptions { accuracy: 1e-4, ..with(5_000) };
    let inflated = inflate(&spline, &options).unwrap();
    let size = spline.bounding_box().width().max(spline.bounding_box().height());
    assert_eq!(inflated.rims.len(), 1);
    let count = inflated.rims[0].end;
    let rim: Vec<Point> = inflated.mesh.vertices[..count].iter().map(|v| Point::new(v[0], v[1])).collect();
    for (i, p) in rim.iter().enumerate() {
        assert!(spline.nearest(*p).distance < 1e-9 * size);
        let middle = p.midpoint(rim[(i + 1) % rim.len()]);
        let off = spline.nearest(middle).distance;
        assert!(off < 1.2 * options.accuracy * size, "edge {i} is {off:e} off");
        assert!(inflated.mesh.vertices[i][2] == 0.0 && inflated.mesh.normals[i][2] == 0.0);
    }
    assert!(inflated.mesh.vertices[count..].iter().all(|v| v[2] != 0.0), "front and back meet on the rim only");
}

#[test]
fn height_scales_the_surface_across_and_nothing_else() {
    let spline = shapes::ellipse(2.0, 1.0, 0.0);
    let (plain, high) =
        (surface(&spline, &with(3_000)), surface(&spline, &InflateOptions { height: 2.5, ..with(3_000) }));
    assert_sound(&high, "high");
    for (a, b) in plain.vertices.iter().zip(&high.vertices) {
        assert!(a[0] == b[0] && a[1] == b[1] && (2.5 * a[2] - b[2]).abs() < 1e-12);
    }
    let flat = surface(&spline, &InflateOptions { height: 0.01, ..with(3_000) });
    assert_sound(&flat, "flat");
}

#[test]
fn about_as_many_triangles_come_as_were_asked_for() {
    for spline in [shapes::circle((0.0, 0.0), 1.0), shapes::ellipse(3.0, 1.0, 0.2), shapes::flower(5, 0.3)] {
        for asked in [5_000, 20_000, 80_000] {
            let count = surface(&spline, &with(asked)).triangles.len() as f64;
            assert!((0.8..1.25).contains(&(count / f64::from(asked))), "{count} for {asked}");
        }
    }
}

#[test]
fn turning_moving_scaling_and_reversing_change_the_measures_by_little() {
    let spline = shapes::flower(4, 0.25);
    let measures = |mesh: &Mesh, scale: f64| [mesh.volume() / scale.powi(3), mesh.area() / (scale * scale)];
    let original = measures(&surface(&spline, &with(10_000)), 1.0);
    for (angle, scale, offset) in
        [(0.3, 1.0, 0.0), (1.1, 1.0, 7.0), (2.5, 1e-9, 0.0), (-0.7, 1e9, 1e9), (0.0, 123.0, -4e4)]
    {
        let mut by = Similarity::between(
            spline.start_pose(),
            fairpath_curve::Pose { point: Point::new(offset, offset), heading: angle, curvature: 0.0 },
            scale,
        );
        let moved = spline.transformed(&by);
        by = by.inverse();
        assert!((moved.transformed(&by).start_pose().point - spline.start_pose().point).hypot() < 1e-6);
        for spline in [moved.clone(), moved.reversed()] {
            let mesh = surface(&spline, &with(10_000));
            assert_sound(&mesh, "moved");
            for (a, b) in original.iter().zip(measures(&mesh, scale)) {
                assert!((b / a - 1.0).abs() < 2e-3, "turned by {angle}, scaled by {scale}: {a} became {b}");
            }
        }
    }
}

#[test]
fn a_surface_has_the_same_bits_every_time() {
    // The triangulator keeps hash tables, whose order differs from one to the next: nothing may depend on it.
    let spline = shapes::flower(6, 0.4);
    let first = surface(&spline, &with(8_000));
    for _ in 0..3 {
        assert!(surface(&spline, &with(8_000)) == first);
    }
}

#[test]
fn every_closed_synthetic_stroke_becomes_a_sound_surface() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/strokes/synthetic.json");
    if !file.is_file() {
        assert!(std::env::var_os("CI").is_none(), "the synthetic strokes are not at {}", file.display());
        eprintln!("skipped: the synthetic strokes are not at {}", file.display());
        return;
    }
    let value: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
    let (mut sound, mut of_parts) = (0, 0);
    for stroke in value["strokes"].as_array().unwrap() {
        let name = stroke["name"].as_str().unwrap();
        let points = stroke["points"].as_array().unwrap().iter();
        let points = points.map(|p| Point::new(p[0].as_f64().unwrap(), p[1].as_f64().unwrap())).collect();
        let fitted = fit(&Stroke::new(name, points), &FitOptions::default()).unwrap();
        match inflate(&fitted.spline, &with(6_000)) {
            Ok(inflated) => {
                assert_sound_parts(&inflated, name);
                sound += 1;
                of_parts += usize::from(inflated.rims.len() > 1);
            }
            Err(InflateError::Open) => assert!(!fitted.spline.is_closed(), "{name}"),
            Err(error) => panic!("{name}: {error}"),
        }
    }
    assert!(sound >= 12 && of_parts >= 1, "{sound} surfaces, {of_parts} of several parts");
}

#[test]
fn an_eight_becomes_two_drops_of_equal_volume() {
    let bow = shapes::polygon(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]);
    let inflated = inflate(&bow, &with(6_000)).unwrap();
    assert_sound_parts(&inflated, "bow tie");
    assert_eq!(inflated.rims.len(), 2);
    let half = shapes::polygon(&[(0.0, 0.0), (1.0, 1.0), (0.0, 2.0)]);
    let alone = inflate(&half, &with(3_000)).unwrap().mesh.volume();
    assert!((inflated.mesh.volume() / (2.0 * alone) - 1.0).abs() < 0.02, "{} {alone}", inflated.mesh.volume());
}

/// As [`assert_sound`], with a sphere's Euler characteristic for each part.
fn assert_sound_parts(inflated: &Inflated, name: &str) {
    let faults = inflated.mesh.faults();
    assert!(faults.is_empty(), "{name}: {:?}", &faults[..faults.len().min(5)]);
    assert_eq!(inflated.mesh.euler_characteristic(), 2 * inflated.rims.len() as i64, "{name}");
}

/// Star-shaped polygons: corners of any angle, spikes and notches among them.
fn spiky() -> impl Strategy<Value = Spline> {
    prop::collection::vec(0.15..1.0_f64, 3..9).prop_map(|radii| {
        let step = 2.0 * PI / radii.len() as f64;
        let points: Vec<_> = radii
            .iter()
            .enumerate()
            .map(|(i, r)| ((step * i as f64 + 0.3).cos() * r, (step * i as f64 + 0.3).sin() * r))
            .collect();
        shapes::polygon(&points)
    })
}

fn shapes_of_all_kinds() -> impl Strategy<Value = Spline> {
    prop_oneof![
        spiky(),
        (1.0..300.0_f64, -3.0..3.0_f64).prop_map(|(a, turned)| shapes::ellipse(a, 1.0, turned)),
        (2..9_u32, 0.0..0.6_f64).prop_map(|(lobes, depth)| shapes::flower(lobes, depth)),
        // A needle: two arcs that meet at small angles.
        (0.02..1.5_f64).prop_map(|half| {
            let radius = 0.5 / half.sin();
            let arc =
                |x: f64, heading: f64| Segment::arc(Point::new(x, 0.0), heading, 2.0 * half * radius, 1.0 / radius);
            Spline::new(vec![arc(-0.5, -half), arc(0.5, PI - half)], vec![Continuity::G0; 2], true).unwrap()
        }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn any_simple_shape_becomes_a_sound_surface(
        spline in shapes_of_all_kinds(),
        size in -12.0..12.0_f64,
        triangles in 100..4_000_u32,
        height in 0.05..3.0_f64,
    ) {
        let scaled = spline.transformed(&Similarity::between(
            spline.start_pose(),
            fairpath_curve::Pose { point: Point::new(3.0, -2.0) , heading: 0.2, curvature: 0.0 },
            10.0_f64.powf(size).max(1e-7),
        ));
        let options = InflateOptions { height, ..with(triangles) };
        let mesh = inflate(&scaled, &options).expect("it can be inflated").mesh;
        let faults = mesh.faults();
        prop_assert!(faults.is_empty(), "{} faults, first {}", faults.len(), faults[0]);
        prop_assert_eq!(mesh.euler_characteristic(), 2);
        prop_assert!(mesh.volume() > 0.0);
    }
}

#[test]
fn an_open_curve_is_refused() {
    let line = Spline::new(vec![Segment::line(Point::ORIGIN, 0.0, 1.0)], vec![], false).unwrap();
    assert_eq!(inflate(&line, &InflateOptions::default()), Err(InflateError::Open));
}

#[test]
fn a_curve_that_touches_or_retraces_itself_is_refused_with_the_place() {
    let retraced = shapes::polygon(&[(0.0, 0.0), (1.0, 0.0)]);
    assert!(inflate(&retraced, &InflateOptions::default()).is_err());
    // A slit that is closed: the curve runs along itself.
    let slit = shapes::polygon(&[(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (2.0, 2.0), (2.0, 1.0), (2.0, 2.0), (0.0, 2.0)]);
    match inflate(&slit, &InflateOptions::default()) {
        Err(error @ InflateError::MeetsItself { x, y, .. }) => {
            assert!((x - 2.0).abs() < 1e-9 && (1.0..=2.0).contains(&y));
            let text = error.to_string();
            assert!(text.contains("meets itself") && error.code() == "meets-itself", "{text}");
        }
        other => panic!("{:?}", other.map(|i| i.mesh.triangles.len())),
    }
}

#[test]
fn what_is_beyond_all_measure_is_refused() {
    let none = InflateOptions::default();
    assert!(matches!(inflate(&shapes::circle((0.0, 0.0), 1e70), &none), Err(InflateError::TooLarge { .. })));
    assert!(matches!(inflate(&shapes::circle((0.0, 0.0), 1e-70), &none), Err(InflateError::TooSmall { .. })));
    assert!(matches!(inflate(&shapes::circle((1e12, 0.0), 1.0), &none), Err(InflateError::TooSmall { .. })));
    let needle = shapes::polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1e-7), (0.0, 1e-7)]);
    let refused = inflate(&needle, &none);
    assert!(
        matches!(
            refused,
            Err(InflateError::TooManyTriangles { .. }
                | InflateError::TooNarrow { .. }
                | InflateError::MeetsItself { .. })
        ),
        "{:?}",
        refused.map(|i| i.mesh.triangles.len())
    );
}

#[test]
fn options_out_of_range_are_refused_by_name() {
    let circle = shapes::circle((0.0, 0.0), 1.0);
    let plain = InflateOptions::default;
    for (options, wanted) in [
        (with(0), "triangles"),
        (with(99), "triangles"),
        (with(1_000_001), "triangles"),
        (InflateOptions { accuracy: 0.0, ..plain() }, "accuracy"),
        (InflateOptions { accuracy: f64::NAN, ..plain() }, "accuracy"),
        (InflateOptions { height: -1.0, ..plain() }, "height"),
        (InflateOptions { height: f64::INFINITY, ..plain() }, "height"),
    ] {
        match inflate(&circle, &options) {
            Err(InflateError::BadOption { name, .. }) => assert_eq!(name, wanted),
            other => panic!("{wanted}: {:?}", other.map(|i| i.rims)),
        }
    }
}
