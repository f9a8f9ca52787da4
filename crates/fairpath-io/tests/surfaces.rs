//! Surfaces to files: what is written is what was given, and what no file should have is refused.

use fairpath_io::{Error, SurfaceEntry, SurfaceFile, SurfaceFormat, Unit, YAxis, encode_surfaces, write_surfaces};
use fairpath_shape::Mesh;
use serde_json::Value;
use std::path::Path;

/// A tetrahedron at a place, with edges of a length along the axes.
fn tetrahedron(at: [f64; 3], length: f64) -> Mesh {
    let third = 1.0 / 3.0_f64.sqrt();
    let far = 1.0 / 11.0_f64.sqrt();
    let corners = [[0.0; 3], [length, 0.0, 0.0], [0.0, length, 0.0], [0.0, 0.0, length]];
    Mesh {
        vertices: corners.iter().map(|c| [0, 1, 2].map(|k| at[k] + c[k])).collect(),
        normals: vec![[-third; 3], [3.0 * far, -far, -far], [-far, 3.0 * far, -far], [-far, -far, 3.0 * far]],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    }
}

fn file(y: YAxis, unit: Unit) -> SurfaceFile {
    let entry = |name: &str, mesh| SurfaceEntry { name: name.into(), mesh };
    SurfaceFile {
        unit,
        y,
        surfaces: vec![
            entry("near", tetrahedron([0.0; 3], 2.0)),
            entry("far \"away\" # é\n", tetrahedron([1e6, -3e6, 0.5], 0.25)),
        ],
    }
}

/// The document of a binary glTF file and its numbers.
fn parts(glb: &[u8]) -> (Value, &[u8]) {
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&glb[..4], word(4), word(8)), (&b"glTF"[..], 2, glb.len()));
    let text = word(12);
    assert_eq!((&glb[16..20], text % 4), (&b"JSON"[..], 0));
    assert_eq!((word(20 + text), &glb[24 + text..28 + text]), (glb.len() - 28 - text, &b"BIN\0"[..]));
    (serde_json::from_slice(&glb[20..20 + text]).unwrap(), &glb[28 + text..])
}

fn floats(document: &Value, binary: &[u8], accessor: usize) -> Vec<[f64; 3]> {
    let accessor = &document["accessors"][accessor];
    let view = &document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let (begin, length) =
        (view["byteOffset"].as_u64().unwrap() as usize, view["byteLength"].as_u64().unwrap() as usize);
    let numbers: Vec<f64> =
        binary[begin..begin + length].chunks(4).map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap()))).collect();
    assert_eq!(numbers.len(), 3 * accessor["count"].as_u64().unwrap() as usize);
    numbers.chunks(3).map(|c| [c[0], c[1], c[2]]).collect()
}

#[test]
fn gltf_holds_every_vertex_in_metres_with_y_up_however_far_away() {
    for (y, unit, metres) in
        [(YAxis::Up, Unit::M, 1.0), (YAxis::Down, Unit::Mm, 0.001), (YAxis::Down, Unit::Px, 0.000_254)]
    {
        let file = file(y, unit);
        let glb = encode_surfaces(&file, SurfaceFormat::Glb).unwrap();
        let (document, binary) = parts(&glb);
        assert_eq!(document["asset"]["version"], "2.0");
        let sign = if y == YAxis::Up { 1.0 } else { -1.0 };
        for (i, entry) in file.surfaces.iter().enumerate() {
            let node = &document["nodes"][i];
            assert_eq!(node["name"], entry.name);
            let middle: Vec<f64> =
                node["translation"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
            let primitive = &document["meshes"][i]["primitives"][0];
            let number = |value: &Value| value.as_u64().unwrap() as usize;
            let position = number(&primitive["attributes"]["POSITION"]);
            let positions = floats(&document, binary, position);
            for (given, written) in entry.mesh.vertices.iter().zip(&positions) {
                let wanted = [given[0] * metres, sign * given[1] * metres, sign * given[2] * metres];
                for k in 0..3 {
                    // The far one is a quarter of a unit large at a million units: plain numbers of 32 bits would be all the same.
                    assert!((middle[k] + written[k] - wanted[k]).abs() < 1e-6 * metres, "{given:?} {written:?}");
                }
            }
            for (bound, pick) in [("min", f64::min as fn(f64, f64) -> f64), ("max", f64::max)] {
                for k in 0..3 {
                    let exact = positions.iter().map(|p| p[k]).reduce(pick).unwrap();
                    assert_eq!(document["accessors"][position][bound][k].as_f64().unwrap(), exact);
                }
            }
            let normals = floats(&document, binary, number(&primitive["attributes"]["NORMAL"]));
            for (given, written) in entry.mesh.normals.iter().zip(&normals) {
                assert!((given[0] - written[0]).abs() < 1e-6 && (sign * given[1] - written[1]).abs() < 1e-6);
            }
        }
    }
}

#[test]
fn obj_holds_every_vertex_to_the_last_bit_and_groups_by_name() {
    let file = file(YAxis::Down, Unit::Px);
    let text = String::from_utf8(encode_surfaces(&file, SurfaceFormat::Obj).unwrap()).unwrap();
    let rows = |word: &str| -> Vec<Vec<String>> {
        let of = text.lines().filter_map(|line| line.strip_prefix(word)?.strip_prefix(' '));
        of.map(|line| line.split(' ').map(str::to_owned).collect()).collect()
    };
    let given: Vec<[f64; 3]> = file.surfaces.iter().flat_map(|s| s.mesh.vertices.clone()).collect();
    let written: Vec<Vec<f64>> = rows("v").iter().map(|r| r.iter().map(|x| x.parse().unwrap()).collect()).collect();
    assert_eq!(given.len(), written.len());
    for (given, written) in given.iter().zip(&written) {
        assert_eq!([given[0], -given[1], -given[2]], written[..]);
    }
    assert_eq!(rows("g"), [["near"], ["far_\"away\"___é_"]]);
    assert_eq!(rows("vn").len(), 8);
    let faces = rows("f");
    assert_eq!((faces.len(), &faces[4]), (8, &["5//5", "7//7", "6//6"].map(String::from).to_vec()));
}

#[test]
fn a_picture_shows_the_surface_on_white() {
    let file = file(YAxis::Up, Unit::M);
    let near = SurfaceFile { surfaces: file.surfaces[..1].to_vec(), ..file };
    let png = encode_surfaces(&near, SurfaceFormat::Png).unwrap();
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    assert_eq!(png, encode_surfaces(&near, SurfaceFormat::Png).unwrap());
    let decoder = png::Decoder::new(std::io::Cursor::new(&png));
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    let (width, height) = (info.width as usize, info.height as usize);
    let at = |x: usize, y: usize| [0, 1, 2].map(|k| pixels[3 * (y * width + x) + k]);
    assert_eq!(at(0, 0), [255; 3]);
    let coloured = (0..width * height).filter(|i| pixels[3 * i..3 * i + 3] != [255; 3]).count();
    assert!((0.1..0.9).contains(&(coloured as f64 / (width * height) as f64)), "{coloured} pixels");
}

#[test]
fn what_no_file_should_have_is_refused_with_its_place() {
    let good = file(YAxis::Up, Unit::M);
    let refused = |change: &dyn Fn(&mut SurfaceFile), said: &str| {
        for format in SurfaceFormat::ALL {
            let mut file = good.clone();
            change(&mut file);
            match encode_surfaces(&file, format) {
                Err(error @ Error::Unwritable { .. }) => assert!(error.to_string().contains(said), "{error}"),
                other => panic!("{said}: {:?}", other.map(|bytes| bytes.len())),
            }
        }
    };
    refused(&|f| f.surfaces.clear(), "no surface");
    refused(&|f| f.surfaces[0].mesh.triangles.clear(), "no triangle");
    refused(&|f| f.surfaces[0].mesh.vertices[0][1] = f64::NAN, "surface \"near\": a coordinate");
    refused(&|f| f.surfaces[1].mesh.vertices[0][1] = f64::INFINITY, "a coordinate");
    refused(&|f| f.surfaces[0].mesh.normals[0] = [0.0; 3], "a normal");
    refused(&|f| f.surfaces[0].mesh.normals.truncate(3), "normals");
    refused(&|f| f.surfaces[0].mesh.triangles[0][2] = 4, "a vertex that does not exist");
    for length in [1e-60, 1e60] {
        let mesh = tetrahedron([0.0; 3], length);
        let file = SurfaceFile { surfaces: vec![SurfaceEntry { name: "odd".into(), mesh }], ..good.clone() };
        assert!(matches!(encode_surfaces(&file, SurfaceFormat::Glb), Err(Error::Unwritable { .. })));
        assert!(encode_surfaces(&file, SurfaceFormat::Obj).is_ok());
    }
    let error = write_surfaces(Path::new("nowhere.stl"), &good).unwrap_err();
    assert!(error.to_string().contains(".glb, .obj or .png"), "{error}");
}
