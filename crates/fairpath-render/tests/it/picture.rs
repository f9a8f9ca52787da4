//! Pictures against rays of light, and against each other.

use crate::common::{Ball, offscreen, pixel, ray};
use fairpath_render::{Camera, Colour, DVec3, Finish, GpuMesh, Look, Offscreen, Picture, YAxis, Zebra};
use fairpath_shape::Mesh;
use std::f64::consts::PI;

/// No surface here comes near to this colour.
const GREEN: Colour = [10, 255, 30];
const SIZE_PX: [u32; 2] = [240, 180];

fn look() -> Look {
    Look { background: GREEN, ..Look::light() }
}

fn aspect([width, height]: [u32; 2]) -> f64 {
    f64::from(width) / f64::from(height)
}

/// A small one to the right, a smaller one above, the smallest in front of the large one, so that no turn and no mirror leaves them as they are.
const BALLS: [Ball; 4] = [
    Ball::new(0.0, 0.0, 0.0, 1.0),
    Ball::new(2.5, 0.2, 0.0, 0.7),
    Ball::new(-0.2, 2.2, 0.1, 0.5),
    Ball::new(0.3, -0.4, 2.4, 0.35),
];

fn upload(offscreen: &Offscreen, balls: &[Ball], y: YAxis) -> GpuMesh {
    let meshes: Vec<Mesh> = balls.iter().map(Ball::mesh).collect();
    offscreen.upload(&meshes.iter().collect::<Vec<_>>(), y).expect("balls are sound")
}

/// Every pixel that is further than 1 px from a silhouette is as rays say: surface or background.
fn assert_as_rays_say(picture: &Picture, camera: &Camera, balls: &[Ball]) {
    let hit = |x: f64, y: f64| {
        let (eye, ray) = ray(camera, picture.size_px, x, y);
        balls.iter().any(|ball| ball.entered(eye, ray).is_some())
    };
    let around = [-1.0, -0.5, 0.0, 0.5, 1.0];
    let (mut inside, mut outside) = (0, 0);
    for y in 0..picture.size_px[1] {
        for x in 0..picture.size_px[0] {
            let (cx, cy) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            let hits = around.iter().flat_map(|dy| around.iter().map(move |dx| (dx, dy)));
            let hits = hits.filter(|(dx, dy)| hit(cx + **dx, cy + **dy)).count();
            let seen = pixel(picture, x, y);
            if hits == around.len() * around.len() {
                inside += 1;
                assert!(
                    i32::from(seen[0]) > i32::from(GREEN[0]) + 20,
                    "({x}, {y}) is {seen:?}: no surface ({camera:?})"
                );
            } else if hits == 0 {
                outside += 1;
                assert_eq!(seen, GREEN, "({x}, {y}) is not background ({camera:?})");
            }
        }
    }
    assert!(inside > 500 && outside > 500, "{inside} pixels inside and {outside} outside prove little");
}

#[test]
fn a_ball_has_its_silhouette_where_rays_touch_it_to_a_pixel() {
    let mut offscreen = offscreen();
    let ball = [Ball::new(0.0, 0.0, 0.0, 50.0)];
    let mesh = upload(&offscreen, &ball, YAxis::Up);
    for size_px in [SIZE_PX, [180, 240], [97, 331], [256, 256]] {
        let fitted = Camera::default().fitted_to(&mesh.bounds(), aspect(size_px));
        // Far off the middle of the picture, a ball appears as an ellipse.
        for camera in [fitted, fitted.zoomed(0.4).panned(0.2, -0.3), fitted.zoomed(1.3).panned(-0.3, 0.1)] {
            let picture = offscreen.picture(&mesh, &camera, size_px, &look()).unwrap();
            assert_as_rays_say(&picture, &camera, &ball);
        }
    }
}

#[test]
fn nothing_is_mirrored_from_any_side() {
    let mut offscreen = offscreen();
    let mesh = upload(&offscreen, &BALLS, YAxis::Up);
    let fitted = Camera::default().fitted_to(&mesh.bounds(), aspect(SIZE_PX));
    for (azimuth, elevation) in [(0.0, 0.0), (PI / 2.0, 0.0), (PI, 0.0), (-PI / 2.0, 0.1), (0.3, 1.5), (-2.0, -1.5)] {
        let camera = fitted.seen_from(azimuth, elevation);
        let picture = offscreen.picture(&mesh, &camera, SIZE_PX, &look()).unwrap();
        assert_as_rays_say(&picture, &camera, &BALLS);
    }
}

#[test]
fn a_drawing_with_y_down_is_turned_and_not_mirrored() {
    let mut offscreen = offscreen();
    let mesh = upload(&offscreen, &BALLS, YAxis::Down);
    let turned = BALLS.map(|Ball { centre: [x, y, z], radius }| Ball::new(x, -y, -z, radius));
    let fitted = Camera::default().fitted_to(&mesh.bounds(), aspect(SIZE_PX));
    for azimuth in [0.0, 1.0, PI] {
        let camera = fitted.seen_from(azimuth, 0.2);
        let picture = offscreen.picture(&mesh, &camera, SIZE_PX, &look()).unwrap();
        assert_as_rays_say(&picture, &camera, &turned);
    }
}

#[test]
fn from_the_front_what_was_drawn_at_the_upper_right_is_there() {
    let mut offscreen = offscreen();
    let middle = Ball::new(0.0, 0.0, 0.0, 0.4);
    for (y, upper) in [(YAxis::Up, 1.0), (YAxis::Down, -1.0)] {
        let mesh = upload(&offscreen, &[middle, Ball::new(2.0, upper, 0.0, 0.4)], y);
        // The frame of both together: the middle of the picture lies between them.
        let camera = Camera::default().fitted_to(&mesh.bounds(), aspect(SIZE_PX)).seen_from(0.0, 0.0);
        let picture = offscreen.picture(&mesh, &camera, SIZE_PX, &look()).unwrap();
        let [width, height] = SIZE_PX;
        let seen = |right: bool, low: bool| {
            let xs = if right { width / 2..width } else { 0..width / 2 };
            let ys = if low { height / 2..height } else { 0..height / 2 };
            xs.flat_map(|x| ys.clone().map(move |y| (x, y))).filter(|&(x, y)| pixel(&picture, x, y) != GREEN).count()
        };
        let quarters = [seen(true, false), seen(false, true), seen(false, false), seen(true, true)];
        assert!(quarters[0] > 300 && quarters[1] > 300 && quarters[2..] == [0, 0], "{y:?}: {quarters:?}");
    }
}

/// Two triangles as a square upright in the drawing, at a height, with one normal.
fn square(z: f64, half: f64, normal: [f64; 3]) -> Mesh {
    Mesh {
        vertices: [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| [x * half, y * half, z]).to_vec(),
        normals: vec![normal; 4],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}

#[test]
fn what_is_nearer_covers_what_is_farther_in_any_order() {
    let mut offscreen = offscreen();
    // Bright, since it faces the key light, and dark, since it faces away.
    let (near, far) = (square(0.1, 0.5, [-0.6, 0.0, 0.8]), square(-0.1, 1.0, [0.6, -0.5, 0.624_499_8]));
    let mut pictures = Vec::new();
    for meshes in [[&near, &far], [&far, &near]] {
        let mesh = offscreen.upload(&meshes, YAxis::Up).unwrap();
        let camera = Camera::default().fitted_to(&mesh.bounds(), 1.0).seen_from(0.0, 0.0);
        pictures.push(offscreen.picture(&mesh, &camera, [120, 120], &look()).unwrap());
        // From behind, the other one is the nearer.
        let behind = offscreen.picture(&mesh, &camera.seen_from(PI, 0.0), [120, 120], &look()).unwrap();
        let [middle, beside] = [pixel(&behind, 60, 60), pixel(&behind, 88, 60)].map(|p| i32::from(p[0]));
        assert!((middle - beside).abs() < 4, "only the large one is seen from behind: {middle}, {beside}");
    }
    assert_eq!(pictures[0], pictures[1]);
    let (middle, beside) = (pixel(&pictures[0], 60, 60), pixel(&pictures[0], 88, 60));
    assert!(beside != GREEN && i32::from(middle[0]) > i32::from(beside[0]) + 40, "{middle:?} over {beside:?}");
}

#[test]
fn the_same_picture_has_the_same_bytes_whatever_was_drawn_in_between() {
    let mut offscreen = offscreen();
    let mesh = upload(&offscreen, &BALLS, YAxis::Up);
    let camera = Camera::default().fitted_to(&mesh.bounds(), aspect(SIZE_PX));
    let first = offscreen.picture(&mesh, &camera, SIZE_PX, &look()).unwrap();
    assert_eq!(first, offscreen.picture(&mesh, &camera, SIZE_PX, &look()).unwrap());
    let zebra = Look { finish: Finish::Zebra(Zebra::default()), ..Look::dark() };
    let other = offscreen.picture(&mesh, &camera.orbited(1.0, 0.2), [50, 70], &zebra).unwrap();
    assert_eq!(other.rgba.len(), 4 * 50 * 70);
    assert_eq!(first, offscreen.picture(&mesh, &camera, SIZE_PX, &look()).unwrap());
}

#[test]
fn a_surface_far_from_the_origin_is_drawn_to_the_same_bytes() {
    let mut offscreen = offscreen();
    // On a grid of powers of two, so that moving is exact.
    let grid = 2_f64.powi(16);
    let mut mesh = BALLS[1].mesh();
    mesh.vertices.iter_mut().flatten().for_each(|x| *x = (*x * grid).round() / grid);
    let mut away = mesh.clone();
    away.vertices.iter_mut().for_each(|v| *v = [v[0] + 2_f64.powi(35), v[1] - 2_f64.powi(34), v[2] + 2_f64.powi(35)]);
    let mut draw = |mesh: &Mesh| {
        let mesh = offscreen.upload(&[mesh], YAxis::Up).unwrap();
        let camera = Camera::default().fitted_to(&mesh.bounds(), 1.0).orbited(0.3, -0.2).zoomed(1.2);
        offscreen.picture(&mesh, &camera, [128, 128], &look()).unwrap()
    };
    assert!(draw(&mesh) == draw(&away));
}

#[test]
fn tiny_and_huge_surfaces_are_drawn_alike() {
    let mut offscreen = offscreen();
    let ball = BALLS[1].mesh();
    let mut draw = |scale: f64| {
        let mut mesh = ball.clone();
        mesh.vertices.iter_mut().flatten().for_each(|x| *x *= scale);
        let mesh = offscreen.upload(&[&mesh], YAxis::Up).unwrap();
        let camera = Camera::default().fitted_to(&mesh.bounds(), 1.0);
        offscreen.picture(&mesh, &camera, [64, 64], &look()).unwrap()
    };
    let plain = draw(1.0);
    for power in [-300, -40, 40, 300] {
        assert!(draw(2_f64.powi(power)) == plain, "at 2^{power}");
    }
}

#[test]
fn zebra_stripes_lie_where_reflected_rays_say() {
    let mut offscreen = offscreen();
    let ball = Ball::new(0.0, 0.0, 0.0, 1.0);
    let mesh = upload(&offscreen, &[ball], YAxis::Up);
    let size_px = [300, 300];
    for (pairs, axis_rad) in [(8, 0.0), (5, 0.7), (12, -PI / 2.0)] {
        let camera = Camera::default().fitted_to(&mesh.bounds(), 1.0);
        let look = Look { finish: Finish::Zebra(Zebra { pairs, axis_rad }), ..look() };
        let picture = offscreen.picture(&mesh, &camera, size_px, &look).unwrap();
        let [right, up] = [camera.axes()[0], camera.axes()[1]];
        let axis = up * axis_rad.cos() - right * axis_rad.sin();
        // In which pair of stripes a place of the picture lies, and how far into it: dark ones come first, and one lies across the middle.
        let stripe = |x: f64, y: f64| -> Option<f64> {
            let (eye, ray) = ray(&camera, size_px, x, y);
            let normal = (eye + ball.entered(eye, ray)? * ray - DVec3::from(ball.centre)) / ball.radius;
            let mirrored = ray - 2.0 * ray.dot(normal) * normal;
            Some((mirrored.dot(axis).clamp(-1.0, 1.0).asin() / PI * f64::from(pairs) + 0.25).rem_euclid(1.0))
        };
        let (mut dark, mut bright) = (0, 0);
        for y in 0..size_px[1] {
            for x in 0..size_px[0] {
                let around = [-1.2, 0.0, 1.2].map(|dy| [-1.2, 0.0, 1.2].map(|dx| (dx, dy)));
                let at = |(dx, dy)| stripe(f64::from(x) + 0.5 + dx, f64::from(y) + 0.5 + dy);
                let phases: Option<Vec<f64>> = around.as_flattened().iter().map(|&d| at(d)).collect();
                let Some(phases) = phases else { continue };
                let seen = pixel(&picture, x, y)[0];
                if phases.iter().all(|p| (0.02..0.48).contains(p)) {
                    dark += 1;
                    assert!(seen < 40, "({x}, {y}) is {seen}, not dark, with {pairs} pairs at {axis_rad}");
                } else if phases.iter().all(|p| (0.52..0.98).contains(p)) {
                    bright += 1;
                    assert!(seen > 120, "({x}, {y}) is {seen}, not bright, with {pairs} pairs at {axis_rad}");
                }
            }
        }
        assert!(dark > 5_000 && bright > 5_000, "{dark} dark and {bright} bright pixels prove little");
    }
}

#[test]
fn clay_is_brightest_towards_the_key_light_and_a_dark_room_draws_the_edge() {
    let mut offscreen = offscreen();
    let mesh = upload(&offscreen, &[Ball::new(0.0, 0.0, 0.0, 1.0)], YAxis::Up);
    let camera = Camera::default().fitted_to(&mesh.bounds(), 1.0);
    let size_px = [200, 200];
    let sum = |colour: [u8; 3]| colour.iter().map(|&byte| u32::from(byte)).sum::<u32>();
    let bright = offscreen.picture(&mesh, &camera, size_px, &Look::light()).unwrap();
    let [lit, shadow] = [pixel(&bright, 62, 55), pixel(&bright, 120, 175)].map(sum);
    assert!(lit > shadow + 150, "{lit} in the light, {shadow} in the shadow");
    let dark = offscreen.picture(&mesh, &camera, size_px, &Look::dark()).unwrap();
    // Along the line from the middle to the right edge of the ball, at 98 px from it.
    let [inner, edge] = [pixel(&dark, 170, 100), pixel(&dark, 195, 100)].map(sum);
    assert!(edge > inner + 20, "{inner} before the edge, {edge} at it");
}

#[test]
fn an_eye_inside_sees_the_inside() {
    let mut offscreen = offscreen();
    let mesh = upload(&offscreen, &[Ball::new(0.0, 0.0, 0.0, 1.0)], YAxis::Up);
    let camera = Camera::default().fitted_to(&mesh.bounds(), 1.0).zoomed(1e9);
    assert!(camera.distance() < mesh.bounds().radius);
    let picture = offscreen.picture(&mesh, &camera, [60, 60], &look()).unwrap();
    assert!(picture.rgba.chunks_exact(4).all(|p| p[..3] != GREEN));
}

#[test]
fn the_back_of_a_sheet_is_lit_as_if_it_were_the_front() {
    let mut offscreen = offscreen();
    let sheet = square(0.0, 1.0, [0.6, 0.0, 0.8]);
    let mut other = square(0.0, 1.0, [-0.6, 0.0, -0.8]);
    other.triangles.iter_mut().for_each(|t| t.reverse());
    let mut behind = |mesh: &Mesh| {
        let mesh = offscreen.upload(&[mesh], YAxis::Up).unwrap();
        let camera = Camera::default().fitted_to(&mesh.bounds(), 1.0).seen_from(PI, 0.0);
        offscreen.picture(&mesh, &camera, [64, 64], &look()).unwrap()
    };
    assert!(behind(&sheet) == behind(&other));
}

#[test]
fn a_normal_that_points_away_counts_as_one_at_the_silhouette() {
    let mut offscreen = offscreen();
    let mut middle = |normal: [f64; 3]| {
        let mesh = offscreen.upload(&[&square(0.0, 1.0, normal)], YAxis::Up).unwrap();
        let camera = Camera::default().fitted_to(&mesh.bounds(), 1.0).seen_from(0.0, 0.0);
        // An odd size, so that a pixel has the middle of the square in its middle, where the eye is straight above.
        pixel(&offscreen.picture(&mesh, &camera, [63, 63], &look()).unwrap(), 31, 31)
    };
    assert_eq!(middle([0.6, 0.0, -0.8]), middle([1.0, 0.0, 0.0]));
}
