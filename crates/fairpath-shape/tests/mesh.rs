//! Each fault of a mesh is found, and a good mesh has none.

use fairpath_shape::{Mesh, MeshFault};

/// A tetrahedron with a corner at the origin and edges of length one along the axes.
fn tetrahedron() -> Mesh {
    let normal = |v: [f64; 3]| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / length)
    };
    Mesh {
        vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        normals: [[-1.0, -1.0, -1.0], [3.0, -1.0, -1.0], [-1.0, 3.0, -1.0], [-1.0, -1.0, 3.0]].map(normal).to_vec(),
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    }
}

#[test]
fn a_tetrahedron_has_its_measures_and_no_fault() {
    let mesh = tetrahedron();
    assert_eq!(mesh.faults(), []);
    assert_eq!(mesh.euler_characteristic(), 2);
    assert!((mesh.volume() - 1.0 / 6.0).abs() < 1e-15);
    assert!((mesh.area() - (1.5 + 0.75_f64.sqrt())).abs() < 1e-15);
    assert!((mesh.least_angle().to_degrees() - 45.0).abs() < 1e-12);
}

#[test]
fn each_fault_is_found() {
    let broken = |change: &dyn Fn(&mut Mesh)| {
        let mut mesh = tetrahedron();
        change(&mut mesh);
        mesh.faults()
    };
    assert_eq!(Mesh::default().faults(), [MeshFault::Empty]);
    assert!(broken(&|m| m.vertices[1][0] = f64::NAN).contains(&MeshFault::BadVertex(1)));
    assert!(broken(&|m| m.normals[2] = [0.0, 0.0, 2.0]).contains(&MeshFault::BadVertex(2)));
    assert_eq!(broken(&|m| m.normals.truncate(3)), [MeshFault::NormalCount]);
    assert_eq!(broken(&|m| m.triangles[0] = [0, 2, 9]), [MeshFault::BadTriangle(0)]);
    assert_eq!(broken(&|m| m.triangles[0] = [0, 2, 2]), [MeshFault::BadTriangle(0)]);
    assert!(broken(&|m| m.vertices[3] = [0.5, 0.0, 0.0]).contains(&MeshFault::Degenerate(1)));
    assert!(broken(&|m| m.normals.iter_mut().flatten().for_each(|x| *x = -*x)).contains(&MeshFault::Inverted(0)));
    assert!(broken(&|m| m.triangles.truncate(3)).contains(&MeshFault::OpenEdge(2, 1)));
    let flipped = broken(&|m| m.triangles[0] = [0, 1, 2]);
    assert!(
        flipped.contains(&MeshFault::CrowdedEdge(0, 1)) && flipped.contains(&MeshFault::OpenEdge(2, 0)),
        "{flipped:?}"
    );
    assert!(broken(&|m| m.triangles.push([1, 2, 3])).contains(&MeshFault::CrowdedEdge(1, 2)));
    let loose = broken(&|m| {
        m.vertices.push([5.0; 3]);
        m.normals.push([1.0, 0.0, 0.0]);
    });
    assert_eq!(loose, [MeshFault::LooseVertex(4)]);
}

#[test]
fn two_parts_that_meet_in_a_point_are_found() {
    let mut mesh = tetrahedron();
    let other = tetrahedron();
    // A second one behind the first, which shares the corner at the origin.
    for k in 1..4 {
        mesh.vertices.push(other.vertices[k].map(|x| -x));
        mesh.normals.push(other.normals[k].map(|x| -x));
    }
    let number = |i: u32| if i == 0 { 0 } else { i + 3 };
    mesh.triangles.extend(other.triangles.iter().map(|&[a, b, c]| [number(a), number(c), number(b)]));
    assert!(mesh.faults().contains(&MeshFault::PinchedVertex(0)));
    assert!(mesh.faults().iter().all(|f| !matches!(f, MeshFault::OpenEdge(..) | MeshFault::CrowdedEdge(..))));
}
