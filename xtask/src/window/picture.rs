//! Pictures of a window, and what can be said of them without knowing what they should look like.

use std::collections::HashMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use anyhow::{Context, Result, bail};

use super::Place;

/// Two colours that differ by more than this in red, green or blue are seen to differ.
const SEEN: u8 = 24;

/// A picture of fewer colours than this, or of which hardly anything has another colour than the rest, is blank.
const FEWEST_COLOURS: usize = 16;
const LEAST_INK: f64 = 0.01;

/// A part of a window, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Area {
    pub(crate) left: i32,
    pub(crate) top: i32,
    pub(crate) width: i32,
    pub(crate) height: i32,
}

impl Area {
    /// The places in it.
    fn places(self) -> impl Iterator<Item = Place> {
        (self.top..self.top + self.height).flat_map(move |y| (self.left..self.left + self.width).map(move |x| [x, y]))
    }
}

/// A picture.
#[derive(Clone, PartialEq, Eq)]
pub(crate) struct Picture {
    width: i32,
    height: i32,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    /// The picture of bytes as X gives them: blue, green, red, and one that means nothing.
    pub(crate) fn from_bgrx(width: i32, height: i32, bytes: &[u8]) -> Result<Self> {
        let pixels: Vec<[u8; 3]> = bytes.chunks_exact(4).map(|pixel| [pixel[2], pixel[1], pixel[0]]).collect();
        if width <= 0 || height <= 0 || i64::try_from(pixels.len())? != i64::from(width) * i64::from(height) {
            bail!("a picture of {width}×{height} came in {} bytes; the screen must have a depth of 24", bytes.len());
        }
        Ok(Self { width, height, pixels })
    }

    /// Writes it for people to look at.
    pub(crate) fn save(&self, path: &Path) -> Result<()> {
        let file = File::create(path).with_context(|| format!("cannot write {}", path.display()))?;
        let mut encoder =
            png::Encoder::new(BufWriter::new(file), self.width.unsigned_abs(), self.height.unsigned_abs());
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header()?.write_image_data(self.pixels.as_flattened())?;
        Ok(())
    }

    fn at(&self, [x, y]: Place) -> Option<[u8; 3]> {
        let inside = (0..self.width).contains(&x) && (0..self.height).contains(&y);
        inside.then(|| self.pixels[(y * self.width + x) as usize])
    }

    /// Whether nothing is to be seen in it.
    pub(crate) fn is_blank(&self) -> bool {
        let mut counts: HashMap<[u8; 3], usize> = HashMap::new();
        for pixel in &self.pixels {
            *counts.entry(*pixel).or_default() += 1;
        }
        let most = counts.values().max().copied().unwrap_or(0);
        let ink = (self.pixels.len() - most) as f64 / self.pixels.len() as f64;
        counts.len() < FEWEST_COLOURS || ink < LEAST_INK
    }

    /// The share of places beside which, within `reach` pixels, this picture is seen to differ from the one before.
    pub(crate) fn share_changed(&self, before: &Self, places: &[Place], reach: i32) -> f64 {
        let changed = |place: &&Place| {
            let [x, y] = **place;
            let around = Area { left: x - reach, top: y - reach, width: 2 * reach + 1, height: 2 * reach + 1 };
            around.places().any(|place| self.differs(before, place))
        };
        places.iter().filter(changed).count() as f64 / places.len().max(1) as f64
    }

    fn differs(&self, other: &Self, place: Place) -> bool {
        match (self.at(place), other.at(place)) {
            (Some(a), Some(b)) => a.iter().zip(b).any(|(a, b)| a.abs_diff(b) > SEEN),
            _ => false,
        }
    }

    /// The places of an area that are seen to differ between two pictures.
    pub(crate) fn changes(&self, other: &Self, area: Area) -> Vec<Place> {
        area.places().filter(|&place| self.differs(other, place)).collect()
    }

    /// How many pixels of an area have a strong colour, as curves have and paper and panels do not.
    pub(crate) fn colourful(&self, area: Area) -> usize {
        let strong = |place: &Place| self.at(*place).is_some_and(|[r, g, b]| r.max(g).max(b) - r.min(g).min(b) > 80);
        area.places().filter(strong).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paper(width: i32, height: i32) -> Picture {
        Picture { width, height, pixels: vec![[250; 3]; (width * height) as usize] }
    }

    fn with_diagonal(mut picture: Picture) -> Picture {
        for i in 0..picture.width.min(picture.height) {
            // Shades, as smoothed edges have.
            picture.pixels[(i * picture.width + i) as usize] = [200, (i % 40) as u8, 10];
        }
        picture
    }

    #[test]
    fn paper_is_blank_and_a_drawing_is_not() {
        assert!(paper(100, 80).is_blank());
        assert!(!with_diagonal(paper(100, 80)).is_blank());
    }

    #[test]
    fn what_was_drawn_is_found_where_it_was_drawn_and_nowhere_else() {
        let (before, after) = (paper(100, 100), with_diagonal(paper(100, 100)));
        let along: Vec<Place> = (10..90).map(|i| [i, i + 1]).collect();
        let across: Vec<Place> = (10..40).map(|i| [i, 99 - i]).collect();
        assert_eq!(after.share_changed(&before, &along, 2), 1.0);
        assert_eq!(after.share_changed(&before, &across, 2), 0.0);
        assert_eq!(before.share_changed(&before, &along, 2), 0.0);
        assert_eq!(after.share_changed(&before, &[], 2), 0.0);
        let area = Area { left: 0, top: 0, width: 50, height: 100 };
        assert_eq!(after.changes(&before, area).len(), 50);
        assert_eq!([before.colourful(area), after.colourful(area)], [0, 50]);
    }

    #[test]
    fn bytes_that_do_not_fill_a_picture_are_refused() {
        assert!(Picture::from_bgrx(2, 1, &[0; 8]).is_ok());
        assert!(Picture::from_bgrx(2, 1, &[0; 4]).is_err());
        assert!(Picture::from_bgrx(0, 0, &[]).is_err());
    }
}
