//! Draws the closed strokes of a file as one inflated surface:
//! `cargo run -p fairpath-render --example surface -- OUT.png [STROKES] [dark] [zebra] [AZIMUTH,ELEVATION]`, angles in degrees.
//!
//! Without strokes, the duck of `examples/`.

use fairpath_fit::{FitOptions, fit};
use fairpath_io::{ReadOptions, YAxis as FileAxis, read_strokes, write_whole};
use fairpath_render::{Adapter, Camera, Finish, Look, Offscreen, Picture, YAxis, Zebra};
use fairpath_shape::{InflateOptions, Mesh, inflate};
use std::error::Error;
use std::path::Path;

/// The duck, wherever the example is started.
const DUCK: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/duck.json");
/// Size of the picture, px.
const SIZE_PX: [u32; 2] = [960, 860];

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [output, words @ ..] = args.as_slice() else {
        return Err("usage: surface OUT.png [STROKES] [dark] [zebra] [AZIMUTH,ELEVATION]".into());
    };
    let has = |wanted: &str| words.iter().any(|word| word == wanted);
    let strokes = words.iter().find(|word| word.contains('.') && !word.contains(',')).map_or(DUCK, String::as_str);
    let (meshes, y) = inflated(Path::new(strokes))?;

    let mut offscreen = Offscreen::new(Adapter::Best)?;
    let mesh = offscreen.upload(&meshes.iter().collect::<Vec<_>>(), y)?;
    let mut camera = Camera::default().fitted_to(&mesh.bounds(), f64::from(SIZE_PX[0]) / f64::from(SIZE_PX[1]));
    if let Some((azimuth, elevation)) = words.iter().find_map(|word| word.split_once(',')) {
        camera = camera.seen_from(azimuth.parse::<f64>()?.to_radians(), elevation.parse::<f64>()?.to_radians());
    }
    let mut look = if has("dark") { Look::dark() } else { Look::light() };
    if has("zebra") {
        look.finish = Finish::Zebra(Zebra::default());
    }
    let picture = offscreen.picture(&mesh, &camera, SIZE_PX, &look)?;
    write_whole(Path::new(output), &encode(&picture)?)?;
    let samples = offscreen.renderer().samples();
    println!("{output}: drawn by {}, {samples} samples to a pixel", offscreen.adapter());
    Ok(())
}

/// A surface for each closed stroke.
fn inflated(path: &Path) -> Result<(Vec<Mesh>, YAxis), Box<dyn Error>> {
    let file = read_strokes(path, &ReadOptions::default())?;
    let mut meshes = Vec::new();
    for stroke in &file.strokes {
        let spline = fit(stroke, &FitOptions::default())?.spline;
        if spline.is_closed() {
            meshes.push(inflate(&spline, &InflateOptions::default())?.mesh);
        }
    }
    let y = match file.y {
        FileAxis::Up => YAxis::Up,
        FileAxis::Down => YAxis::Down,
    };
    Ok((meshes, y))
}

fn encode(picture: &Picture) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.size_px[0], picture.size_px[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&picture.rgba)?;
    writer.finish()?;
    Ok(bytes)
}
