//! What cannot be drawn is refused with a reason, and what was drawn before can be drawn again.

use crate::common::{Ball, offscreen};
use fairpath_render::{Camera, Look, RenderError, YAxis};
use fairpath_shape::Mesh;

fn ball() -> Mesh {
    Ball::new(0.0, 0.0, 0.0, 1.0).mesh()
}

#[test]
fn meshes_that_cannot_be_drawn_are_refused_by_the_place_of_their_fault() {
    let offscreen = offscreen();
    let upload = |mesh: &Mesh| offscreen.upload(&[&ball(), mesh], YAxis::Up).expect_err("it cannot be drawn");
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut mesh = ball();
        mesh.vertices[7][1] = bad;
        assert_eq!(upload(&mesh), RenderError::NotFinite { mesh: 1, vertex: 7 });
        let mut mesh = ball();
        mesh.normals[9][2] = bad;
        assert_eq!(upload(&mesh), RenderError::NotFinite { mesh: 1, vertex: 9 });
    }
    let mut mesh = ball();
    let count = mesh.vertices.len();
    mesh.triangles[3][0] = count as u32;
    assert_eq!(upload(&mesh), RenderError::BadTriangle { mesh: 1, triangle: 3 });
    mesh.normals.pop();
    assert_eq!(upload(&mesh), RenderError::NormalCount { mesh: 1, vertices: count, normals: count - 1 });
    let mut mesh = ball();
    mesh.vertices.iter_mut().flatten().for_each(|x| *x *= 1e200);
    assert!(matches!(upload(&mesh), RenderError::Extent { .. }));
    mesh.vertices[0] = [f64::MAX; 3];
    mesh.vertices[1] = [f64::MIN; 3];
    assert!(matches!(upload(&mesh), RenderError::Extent { .. }));
}

#[test]
fn nothing_and_points_are_refused() {
    let offscreen = offscreen();
    assert_eq!(offscreen.upload(&[], YAxis::Up).expect_err("nothing"), RenderError::Empty);
    let empty = Mesh::default();
    assert_eq!(offscreen.upload(&[&empty, &empty], YAxis::Down).expect_err("nothing"), RenderError::Empty);
    let mut point = ball();
    point.vertices.iter_mut().for_each(|v| *v = [3.0, 4.0, 5.0]);
    assert!(matches!(offscreen.upload(&[&point], YAxis::Up), Err(RenderError::Extent { .. })));
    // Nothing beside something is no trouble.
    assert!(offscreen.upload(&[&empty, &ball()], YAxis::Up).is_ok());
}

#[test]
fn pictures_without_pixels_or_too_large_are_refused_and_the_next_is_drawn() {
    let mut offscreen = offscreen();
    let mesh = offscreen.upload(&[&ball()], YAxis::Up).unwrap();
    let camera = Camera::default();
    for [width, height] in [[0, 10], [10, 0], [0, 0], [1_000_000, 10], [u32::MAX, u32::MAX]] {
        match offscreen.picture(&mesh, &camera, [width, height], &Look::light()) {
            Err(RenderError::BadSize { width: w, height: h, limit }) => {
                assert_eq!((w, h), (width, height));
                assert!(limit >= 2048);
            }
            other => panic!("{width} by {height}: {:?}", other.map(|picture| picture.size_px)),
        }
    }
    assert!(offscreen.picture(&mesh, &camera, [1, 1], &Look::light()).is_ok());
}

#[test]
fn a_texture_is_kept_while_the_size_stays() {
    let mut offscreen = offscreen();
    let mesh = offscreen.upload(&[&ball()], YAxis::Up).unwrap();
    let renderer = offscreen.renderer();
    let mut is_new =
        |camera: Camera, size| renderer.render(&mesh, &camera, size, &Look::light()).unwrap().is_new_texture;
    let camera = Camera::default();
    assert!(is_new(camera, [20, 30]));
    assert!(!is_new(camera.orbited(1.0, 1.0), [20, 30]));
    assert!(is_new(camera, [30, 20]));
    assert!(!is_new(camera, [30, 20]));
}
