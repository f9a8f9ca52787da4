//! What holds of cameras wherever they stand.

use fairpath_render::{Bounds, Camera, DVec3};
use proptest::prelude::*;
use std::f64::consts::PI;

/// Angles, among them those next to where they wrap and end.
fn angle() -> impl Strategy<Value = f64> {
    let edge = prop::sample::select(vec![0.0, PI, -PI, PI / 2.0, -PI / 2.0, 89.0_f64.to_radians()]);
    prop_oneof![-7.0..7.0, (edge, -1e-9..1e-9).prop_map(|(at, by)| at + by)]
}

fn bounds() -> impl Strategy<Value = Bounds> {
    let place = || prop_oneof![Just(0.0), -1e6..1e6];
    (place(), place(), place(), -6.0..6.0)
        .prop_map(|(x, y, z, power)| Bounds { centre: DVec3::new(x, y, z), radius: 10_f64.powf(power) })
}

/// Cameras after a while of use, on what they look at.
fn used() -> impl Strategy<Value = (Camera, Bounds, f64)> {
    let moves = ((angle(), angle()), (0.01..100.0), (-2.0..2.0, -2.0..2.0));
    (bounds(), -3.0..3.0, moves).prop_map(|(bounds, power, ((a, e), zoom, (right, down)))| {
        let aspect = 10_f64.powf(power * 0.4);
        let camera = Camera::default().fitted_to(&bounds, aspect).seen_from(a, e).zoomed(zoom).panned(right, down);
        (camera, bounds, aspect)
    })
}

/// Where a point about the centre of the bounds, in radii, appears: right and up from −1 to 1, and depth from 1 to 0.
fn seen(camera: &Camera, bounds: &Bounds, aspect: f64, local: DVec3) -> DVec3 {
    (camera.clip_from_view(bounds, aspect) * camera.view_from_local(bounds)).project_point3(local)
}

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * (1.0 + a.abs().max(b.abs()))
}

/// Directions all around.
fn sphere() -> impl Iterator<Item = DVec3> {
    (0..24)
        .flat_map(|i| (0..13).map(move |j| (f64::from(i) * PI / 12.0, f64::from(j) * PI / 12.0 - PI / 2.0)))
        .map(|(a, e)| DVec3::new(a.sin() * e.cos(), e.sin(), a.cos() * e.cos()))
}

proptest! {
    #[test]
    fn axes_are_at_right_angles_and_right_handed_and_up_is_never_down((camera, _, _) in used()) {
        let [x, y, z] = camera.axes();
        for axis in [x, y, z] {
            prop_assert!((axis.length() - 1.0).abs() < 1e-12);
        }
        prop_assert!(x.dot(y).abs() < 1e-12 && (x.cross(y) - z).length() < 1e-12);
        prop_assert!(x.y == 0.0 && y.y > 0.017, "the horizon is level, and up is up");
    }

    #[test]
    fn what_is_fitted_is_whole_in_the_picture_from_everywhere_and_fills_it(
        bounds in bounds(), power in -1.0..1.0, azimuth in angle(), elevation in angle()
    ) {
        let aspect = 10_f64.powf(power);
        let camera = Camera::default().seen_from(1.0, 0.4).fitted_to(&bounds, aspect).seen_from(azimuth, elevation);
        let mut widest = 0.0_f64;
        for point in sphere() {
            let seen = seen(&camera, &bounds, aspect, point);
            prop_assert!(seen.x.abs() <= 1.0 && seen.y.abs() <= 1.0, "{point} appears at {seen}");
            prop_assert!(seen.z > 0.0 && seen.z <= 1.0 + 1e-9, "{point} is at depth {}", seen.z);
            widest = widest.max(seen.x.abs()).max(seen.y.abs());
        }
        prop_assert!(widest > 0.9, "only {widest} of the picture is used");
    }

    #[test]
    fn the_target_is_in_the_middle_at_its_distance((camera, bounds, aspect) in used()) {
        let local = (camera.target() - bounds.centre) / bounds.radius;
        let middle = camera.view_from_local(&bounds).transform_point3(local);
        // Places a million radii from the origin keep fewer digits.
        let tolerance = 1e-12 * (1.0 + bounds.centre.length() / bounds.radius);
        prop_assert!(middle.x.abs() < tolerance && middle.y.abs() < tolerance);
        prop_assert!(near(-middle.z * bounds.radius, camera.distance(), tolerance));
        prop_assert!((camera.eye() - camera.target()).length() > 0.0);
        prop_assert!(seen(&camera, &bounds, aspect, local).is_finite());
    }

    #[test]
    fn turning_there_and_back_is_no_turn((camera, _, _) in used(), right in angle(), down in angle()) {
        let turned = camera.orbited(right, down);
        prop_assert_eq!((turned.target(), turned.distance()), (camera.target(), camera.distance()));
        prop_assert!(turned.azimuth_rad().abs() <= PI && turned.elevation_rad().abs() <= 89.0_f64.to_radians() + 1e-12);
        let back = turned.orbited(-right, turned.elevation_rad().mul_add(-1.0, camera.elevation_rad()));
        for (a, b) in back.axes().into_iter().zip(camera.axes()) {
            prop_assert!((a - b).length() < 1e-11);
        }
    }

    #[test]
    fn a_drag_pulls_the_front_along(azimuth in angle(), elevation in -1.3..1.3, by in 1e-6..0.2) {
        let camera = Camera::default().seen_from(azimuth, elevation);
        let front = camera.axes()[2];
        let at = |camera: Camera| seen(&camera, &Bounds::UNIT, 1.0, front);
        prop_assert!(at(camera.orbited(by, 0.0)).x > at(camera).x);
        prop_assert!(at(camera.orbited(0.0, by)).y < at(camera).y, "down on the picture is less");
    }

    #[test]
    fn zooming_changes_the_distance_by_its_factor_within_the_limits((camera, bounds, _) in used(), factor in 0.001..1000.0) {
        let zoomed = camera.zoomed(factor);
        let expected = (camera.distance() / factor).clamp(0.2 * bounds.radius, 40.0 * bounds.radius);
        prop_assert!(near(zoomed.distance() / bounds.radius, expected / bounds.radius, 1e-12));
        prop_assert_eq!(zoomed.axes(), camera.axes());
    }

    #[test]
    fn panning_moves_the_target_by_its_part_of_the_picture(azimuth in angle(), elevation in angle(), right in -0.2..0.2, down in -0.2..0.2) {
        let camera = Camera::default().seen_from(azimuth, elevation).zoomed(2.0);
        let before = seen(&camera.panned(right, down), &Bounds::UNIT, 1.0, DVec3::ZERO);
        // Pictures are 2 high in clip coordinates.
        prop_assert!(near(before.x, 2.0 * right, 1e-9) && near(before.y, -2.0 * down, 1e-9), "{before}");
    }

    #[test]
    fn the_target_stays_in_the_subject((camera, bounds, _) in used(), moves in prop::collection::vec((-3.0..3.0, -3.0..3.0), 1..9)) {
        let moved = moves.into_iter().fold(camera, |camera, (right, down)| camera.panned(right, down));
        let slack = 1e-9 * (bounds.radius + bounds.centre.length());
        prop_assert!((moved.target() - bounds.centre).length() <= bounds.radius + slack);
    }

    #[test]
    fn numbers_that_are_none_move_nothing((camera, bounds, _) in used(), bad in prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY])) {
        prop_assert_eq!(camera.orbited(bad, 0.1), camera);
        prop_assert_eq!(camera.orbited(0.1, bad), camera);
        prop_assert_eq!(camera.panned(bad, 0.0), camera);
        prop_assert_eq!(camera.zoomed(bad), camera);
        prop_assert_eq!(camera.zoomed(0.0), camera);
        prop_assert_eq!(camera.zoomed(-1.0), camera);
        prop_assert_eq!(camera.fitted_to(&Bounds { radius: bad, ..bounds }, 1.0), camera);
        prop_assert_eq!(camera.fitted_to(&Bounds { centre: DVec3::splat(bad), ..bounds }, 1.0), camera);
        let square = camera.fitted_to(&bounds, bad);
        prop_assert_eq!(square, camera.fitted_to(&bounds, 1.0));
        prop_assert!(square.clip_from_view(&bounds, bad).is_finite());
    }

    #[test]
    fn huge_movements_leave_a_camera(x in prop::sample::select(vec![1e300, -1e300, 1e-300, f64::MAX, f64::MIN]), y in angle()) {
        let camera = Camera::default().orbited(x, y).orbited(y, x).panned(x, y).panned(y, x).zoomed(x.abs());
        prop_assert!(camera.eye().is_finite() && camera.view_from_local(&Bounds::UNIT).is_finite());
        prop_assert!(camera.axes().into_iter().all(|axis| (axis.length() - 1.0).abs() < 1e-9));
    }
}
