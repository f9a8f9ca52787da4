//! What shaded pictures have in common: the samples that a triangle covers, and samples as a PNG file.

use crate::error::Error;

/// Calls with each sample whose middle lies in a triangle, counted row by row in a canvas of this width and height, and with the weights of the corners there. The turn is twice the
/// triangle's area on the picture, positive where its corners run clockwise as seen, since y points down.
pub(crate) fn covered(
    p: [[f64; 3]; 3],
    turn: f64,
    [width, height]: [usize; 2],
    mut sample: impl FnMut(usize, [f64; 3]),
) {
    let range = |k: usize, most: usize| {
        let low = p.iter().map(|v| v[k]).fold(f64::INFINITY, f64::min);
        let high = p.iter().map(|v| v[k]).fold(f64::NEG_INFINITY, f64::max);
        // Samples lie in the middles of their squares.
        (((low - 0.5).ceil().max(0.0)) as usize, ((high + 0.5).floor().max(0.0) as usize).min(most))
    };
    let ((left, right), (top, bottom)) = (range(0, width), range(1, height));
    for row in top..bottom {
        for column in left..right {
            let at = [column as f64 + 0.5, row as f64 + 0.5];
            let weight = |i: usize, j: usize| {
                ((p[i][0] - at[0]) * (p[j][1] - at[1]) - (p[j][0] - at[0]) * (p[i][1] - at[1])) / turn
            };
            let weights = [weight(1, 2), weight(2, 0), weight(0, 1)];
            if weights.iter().all(|&w| !(w < 0.0)) {
                sample(row * width + column, weights);
            }
        }
    }
}

/// Twice the area of a triangle on the picture; see [`covered`].
pub(crate) fn turn(p: [[f64; 3]; 3]) -> f64 {
    (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1])
}

/// A PNG file of light in rows of `width` samples; a pixel is the mean of `side` by `side` of them.
pub(crate) fn to_png(light: &[[f32; 3]], width: usize, side: usize) -> Result<Vec<u8>, Error> {
    let (columns, rows) = (width / side, light.len() / width / side);
    let mut pixels = Vec::with_capacity(3 * columns * rows);
    for row in 0..rows {
        for column in 0..columns {
            for k in 0..3 {
                let mut sum = 0.0;
                for sample in 0..side * side {
                    let (y, x) = (row * side + sample / side, column * side + sample % side);
                    sum += f64::from(light[y * width + x][k]);
                }
                let mean = sum / (side * side) as f64;
                pixels.push((255.0 * mean.clamp(0.0, 1.0).sqrt()).round() as u8);
            }
        }
    }
    encode(columns, rows, &pixels)
}

/// Rows of red, green and blue as a PNG file.
fn encode(width: usize, height: usize, pixels: &[u8]) -> Result<Vec<u8>, Error> {
    let fail = |e: png::EncodingError| Error::Unwritable {
        format: "PNG",
        place: "the picture".into(),
        problem: e.to_string(),
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().map_err(fail)?;
    writer.write_image_data(pixels).map_err(fail)?;
    writer.finish().map_err(fail)?;
    Ok(bytes)
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Of length one; towards the viewer if it has no length.
pub(crate) fn normalised(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    if length > 0.0 { v.map(|x| x / length) } else { [0.0, 0.0, 1.0] }
}
