//! The whole scene as binary glTF 2.0: a mesh for each surface, and for each piece one mesh that many nodes share.
//!
//! Frame: right-handed, metres, y up: x is east, y up, and z south. Positions of meshes are relative to their middle, since buffers hold 24 bits; nodes move them there.

use super::export::DriveExport;
use super::finishes::{Look, look};
use crate::error::Error;
use crate::gltf::{Buffers, container};
use fairpath_curve::trig;
use fairpath_drive::{Finish, Part, Placement, Scene, SceneOptions};
use serde_json::{Value, json};
use std::collections::BTreeMap;

pub(super) fn write(export: &DriveExport<'_>) -> Result<Vec<u8>, Error> {
    let scene = Scene::of(export.state, export.results, &SceneOptions::default());
    let mut buffers = Buffers::default();
    let (mut nodes, mut meshes): (Vec<Value>, Vec<Value>) = (Vec::new(), Vec::new());
    let finishes: BTreeMap<Finish, usize> = {
        let own = scene.parts.iter().map(|p| p.finish);
        let of_pieces = scene.instances.iter().flat_map(|i| i.parts.iter().map(|p| p.finish));
        let all: std::collections::BTreeSet<Finish> = own.chain(of_pieces).collect();
        all.into_iter().enumerate().map(|(i, f)| (f, i)).collect()
    };
    for part in &scene.parts {
        let middle = middle(part);
        let primitive = primitive(&mut buffers, part, middle, finishes[&part.finish]);
        nodes.push(json!({"name": part.name, "mesh": meshes.len(), "translation": up(middle)}));
        meshes.push(json!({"name": part.name, "primitives": [primitive]}));
    }
    for piece in &scene.instances {
        let primitives: Vec<Value> =
            piece.parts.iter().map(|part| primitive(&mut buffers, part, [0.0; 3], finishes[&part.finish])).collect();
        let mesh = meshes.len();
        meshes.push(json!({"name": piece.name, "primitives": primitives}));
        for placement in &piece.at {
            nodes.push(placed(&piece.name, mesh, placement));
        }
    }
    let Buffers { binary, views, accessors } = buffers;
    let materials: Vec<Value> = finishes.keys().map(|f| material(*f)).collect();
    let document = json!({
        "asset": {"version": "2.0", "generator": concat!("fairpath ", env!("CARGO_PKG_VERSION"))},
        "scene": 0,
        "scenes": [{"name": export.name, "nodes": (0..nodes.len()).collect::<Vec<_>>()}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": binary.len()}],
    });
    container(document.to_string().into_bytes(), binary)
}

/// x east, y up, z south.
fn up([x, y, z]: [f64; 3]) -> [f64; 3] {
    [x, z, -y]
}

fn middle(part: &Part) -> [f64; 3] {
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for v in &part.mesh.vertices {
        for k in 0..3 {
            low[k] = low[k].min(v[k]);
            high[k] = high[k].max(v[k]);
        }
    }
    [0, 1, 2].map(|k| if low[k] <= high[k] { (0.5 * (low[k] + high[k])).round() } else { 0.0 })
}

fn primitive(buffers: &mut Buffers, part: &Part, middle: [f64; 3], material: usize) -> Value {
    let near = |v: &[f64; 3]| up([v[0] - middle[0], v[1] - middle[1], v[2] - middle[2]]).map(|x| x as f32);
    let vertices: Vec<[f32; 3]> = part.mesh.vertices.iter().map(near).collect();
    let normals: Vec<[f32; 3]> = part.mesh.normals.iter().map(|&n| up(n).map(|x| x as f32)).collect();
    let position = buffers.vectors(&vertices, true);
    let normal = buffers.vectors(&normals, false);
    let indices = buffers.indices(&part.mesh.triangles);
    json!({"attributes": {"POSITION": position, "NORMAL": normal}, "indices": indices, "material": material})
}

fn placed(name: &str, mesh: usize, at: &Placement) -> Value {
    // First the pitch about the piece's own y axis (nose up is a turn from x to z), then the heading about the upright; in glTF's frame the upright is y, and the piece's y axis is −z.
    let ((sh, ch), (sp, cp)) = (trig::sin_cos(0.5 * at.heading_rad), trig::sin_cos(0.5 * at.pitch_rad));
    // The product of (0, sh, 0, ch) and (0, 0, sp, cp).
    let rotation = [sh * sp, sh * cp, ch * sp, ch * cp];
    let mut node = json!({"name": name, "mesh": mesh, "translation": up(at.position)});
    if rotation != [0.0, 0.0, 0.0, 1.0] {
        node["rotation"] = json!(rotation);
    }
    if at.scale != 1.0 {
        node["scale"] = json!([at.scale, at.scale, at.scale]);
    }
    node
}

/// Name, colour (linear), roughness and metal of a finish.
fn material(finish: Finish) -> Value {
    let Look { name, colour: [r, g, b], roughness, metallic } = look(finish);
    let mut material = json!({"name": name, "pbrMetallicRoughness":
        {"baseColorFactor": [r, g, b, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness}});
    if finish == Finish::Light {
        material["emissiveFactor"] = json!([1.0, 0.9, 0.6]);
    }
    if finish == Finish::Water {
        material["pbrMetallicRoughness"]["baseColorFactor"] = json!([r, g, b, 0.85]);
        material["alphaMode"] = json!("BLEND");
    }
    material
}
