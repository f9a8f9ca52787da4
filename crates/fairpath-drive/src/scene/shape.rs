//! Building blocks of scenes: triangles with flat or given normals, boxes, strips and prisms.

use fairpath_shape::Mesh;

pub(super) type P3 = [f64; 3];

pub(super) fn sub(a: P3, b: P3) -> P3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn unit_cross(a: P3, b: P3) -> Option<P3> {
    let n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    (length > 1e-12).then(|| n.map(|x| x / length))
}

/// A triangle, counterclockwise seen from its front, with a flat normal; nothing where it has no area.
pub(super) fn triangle(mesh: &mut Mesh, [a, b, c]: [P3; 3]) {
    let Some(normal) = unit_cross(sub(b, a), sub(c, a)) else { return };
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend([a, b, c]);
    mesh.normals.extend([normal; 3]);
    mesh.triangles.push([first, first + 1, first + 2]);
}

/// A quadrangle, counterclockwise seen from its front, with a flat normal.
pub(super) fn quad(mesh: &mut Mesh, [a, b, c, d]: [P3; 4]) {
    let Some(normal) = unit_cross(sub(c, a), sub(d, b)) else { return };
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend([a, b, c, d]);
    mesh.normals.extend([normal; 4]);
    for corners in [[0, 1, 2], [0, 2, 3]] {
        let [p, q, r]: [P3; 3] = corners.map(|k| [a, b, c, d][k]);
        if unit_cross(sub(q, p), sub(r, p)).is_some() {
            mesh.triangles.push(corners.map(|k| first + k as u32));
        }
    }
}

/// A band between two lines of as many points, seen from the side on which `right` lies to the right of the direction of travel and up is up: smooth along, flat across.
pub(super) fn band(mesh: &mut Mesh, left: &[P3], right: &[P3]) {
    for i in 1..left.len().min(right.len()) {
        quad(mesh, [left[i - 1], right[i - 1], right[i], left[i]]);
    }
}

/// An upright box about a middle of its foot: size along x, y and upwards.
pub(super) fn cuboid(mesh: &mut Mesh, foot: P3, [x, y, z]: P3) {
    let corner = |i: f64, j: f64, k: f64| [foot[0] + 0.5 * i * x, foot[1] + 0.5 * j * y, foot[2] + k * z];
    let faces = [
        [(1.0, -1.0, 0.0), (1.0, 1.0, 0.0), (1.0, 1.0, 1.0), (1.0, -1.0, 1.0)],
        [(-1.0, 1.0, 0.0), (-1.0, -1.0, 0.0), (-1.0, -1.0, 1.0), (-1.0, 1.0, 1.0)],
        [(1.0, 1.0, 0.0), (-1.0, 1.0, 0.0), (-1.0, 1.0, 1.0), (1.0, 1.0, 1.0)],
        [(-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (1.0, -1.0, 1.0), (-1.0, -1.0, 1.0)],
        [(-1.0, -1.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0, 1.0), (-1.0, 1.0, 1.0)],
        [(-1.0, 1.0, 0.0), (1.0, 1.0, 0.0), (1.0, -1.0, 0.0), (-1.0, -1.0, 0.0)],
    ];
    for face in faces {
        quad(mesh, face.map(|(i, j, k)| corner(i, j, k)));
    }
}

/// A cone or a frustum about the z axis, with `sides` sides, open below: radii at two heights.
pub(super) fn frustum(mesh: &mut Mesh, sides: usize, [z0, r0]: [f64; 2], [z1, r1]: [f64; 2]) {
    let at = |k: usize, r: f64, z: f64| {
        let (sin, cos) = fairpath_curve::trig::sin_cos(std::f64::consts::TAU * k as f64 / sides as f64);
        [r * cos, r * sin, z]
    };
    for k in 0..sides {
        if r1 > 0.0 {
            quad(mesh, [at(k, r0, z0), at(k + 1, r0, z0), at(k + 1, r1, z1), at(k, r1, z1)]);
        } else {
            triangle(mesh, [at(k, r0, z0), at(k + 1, r0, z0), [0.0, 0.0, z1]]);
        }
    }
}

/// A plate in the plane x = `x`, seen from −x: a convex outline of y and z, counterclockwise as seen.
pub(super) fn plate(mesh: &mut Mesh, x: f64, outline: &[[f64; 2]]) {
    let at = |i: usize| [x, outline[i][0], outline[i][1]];
    for i in 2..outline.len() {
        // Seen from −x, y runs to the left where z is up: so the order turns round.
        triangle(mesh, [at(0), at(i), at(i - 1)]);
        triangle(mesh, [at(0), at(i - 1), at(i)].map(|p| [p[0] + 0.02, p[1], p[2]]));
    }
}
