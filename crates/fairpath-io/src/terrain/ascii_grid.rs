//! ESRI ASCII grids, `.asc`: a few words with their numbers, then the heights, rows from the north. After ESRI's "ASCII raster format"; as GDAL does, `dx` and
//! `dy` are taken for cells that are not square.

use super::TerrainOptions;
use super::epsg;
use super::raster::{Plane, Raster, Stored, check_count, check_size, excerpt};
use crate::error::Fault;
use crate::input::text;
use fairpath_drive::Samples;
use fairpath_fit::Warning;

/// What stands for no height where the file does not say, after ESRI.
const DEFAULT_VOID: f64 = -9999.0;

/// How such a file begins.
pub(super) fn begins(head: &[u8]) -> bool {
    let text = crate::input::strip_bom(head);
    let word: Vec<u8> =
        text.iter().skip_while(|b| b.is_ascii_whitespace()).take(5).map(u8::to_ascii_lowercase).collect();
    [b"ncols", b"nrows"].iter().any(|known| word.starts_with(*known))
}

/// The words before the heights.
#[derive(Default)]
struct Header {
    columns: Option<f64>,
    rows: Option<f64>,
    /// West and south, and whether it is the corner of a cell instead of its middle.
    west: Option<(f64, bool)>,
    south: Option<(f64, bool)>,
    step: [Option<f64>; 2],
    void: Option<f64>,
}

impl Header {
    /// Takes a word with its number; whether it is a known one.
    fn take(&mut self, word: &str, number: f64) -> bool {
        match word {
            "ncols" => self.columns = Some(number),
            "nrows" => self.rows = Some(number),
            "xllcorner" => self.west = Some((number, true)),
            "xllcenter" => self.west = Some((number, false)),
            "yllcorner" => self.south = Some((number, true)),
            "yllcenter" => self.south = Some((number, false)),
            "cellsize" => self.step = [Some(number); 2],
            "dx" => self.step[0] = Some(number),
            "dy" => self.step[1] = Some(number),
            "nodata_value" => self.void = Some(number),
            _ => return false,
        }
        true
    }
}

/// The heights of such a file.
pub(super) fn read(bytes: &[u8], options: &TerrainOptions) -> Result<Raster, Fault> {
    let text = text(bytes)?;
    let mut header = Header::default();
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line)).peekable();
    while let Some(&(number, line)) = lines.peek() {
        let mut words = line.split_ascii_whitespace();
        let word = words.next().unwrap_or("0").to_ascii_lowercase();
        // `nan` is a height, not a word.
        if !word.starts_with(|c: char| c.is_ascii_alphabetic()) || word == "nan" {
            if words.next().is_some() || !line.trim().is_empty() {
                break;
            }
            lines.next();
            continue;
        }
        let value = words.next().and_then(|value| value.parse().ok());
        let known = value.is_some_and(|value| header.take(&word, value));
        if !known || words.next().is_some() {
            let problem = format!(
                "{:?} is none of ncols, nrows, xllcorner, xllcenter, yllcorner, yllcenter, cellsize, dx, dy and NODATA_value with a number",
                excerpt(line)
            );
            return Err(Fault::new(format_args!("line {number}"), problem));
        }
        lines.next();
    }
    let (stored, void) = grid(&header, options)?;
    let (plane, warning) = plane(&stored, options)?;
    let mut samples = Vec::new();
    for (number, line) in lines {
        for word in line.split_ascii_whitespace() {
            let value: f64 = word.parse().map_err(|_| {
                Fault::new(
                    format_args!("line {number}"),
                    format_args!("{:?} is not a number; expected heights", excerpt(word)),
                )
            })?;
            if samples.len() == stored.size[0] * stored.size[1] {
                let problem =
                    format!("there are more heights than the {} × {} announced", stored.size[0], stored.size[1]);
                return Err(Fault::new(format_args!("line {number}"), problem));
            }
            let is_void = value == void || options.void_value == Some(value);
            samples.push(if is_void { f32::NAN } else { options.height(value, None) as f32 });
        }
    }
    check_count(stored.size, samples.len())?;
    stored.raster(Samples::F32(samples), plane, warning.into_iter().collect())
}

/// Where the samples lie, and what stands for none.
fn grid(header: &Header, options: &TerrainOptions) -> Result<(Stored, f64), Fault> {
    let missing = |word: &str| Fault::new("the header", format_args!("{word} is missing or no number of use"));
    let count = |number: Option<f64>, word: &str| {
        // A count beyond what fits becomes the largest there is, which no limit lets through.
        number.filter(|n| *n >= 1.0 && n.fract() == 0.0).map(|n| n as usize).ok_or_else(|| missing(word))
    };
    let size = [count(header.columns, "ncols")?, count(header.rows, "nrows")?];
    check_size(size, &options.limits)?;
    let positive =
        |number: Option<f64>| number.filter(|n| *n > 0.0 && n.is_finite()).ok_or_else(|| missing("cellsize"));
    let step = [positive(header.step[0])?, positive(header.step[1])?];
    let place = |given: Option<(f64, bool)>, step: f64, word: &str| {
        let (at, corner) = given.filter(|(at, _)| at.is_finite()).ok_or_else(|| missing(word))?;
        Ok(if corner { at + 0.5 * step } else { at })
    };
    let west = place(header.west, step[0], "xllcorner or xllcenter")?;
    let south = place(header.south, step[1], "yllcorner or yllcenter")?;
    let first = [west, south + (size[1] - 1) as f64 * step[1]];
    Ok((Stored { size, first, step: [step[0], -step[1]] }, header.void.unwrap_or(DEFAULT_VOID)))
}

/// The file says nothing about it: metres, unless the caller knows better, and not where they look like degrees.
fn plane(stored: &Stored, options: &TerrainOptions) -> Result<(Plane, Option<Warning>), Fault> {
    if let Some(code) = options.epsg {
        let found = epsg::plane(code).map_err(|problem| Fault::new("the header", problem))?;
        if found.unit_m != 1.0 {
            let problem = format!("EPSG:{code} is not in metres; convert the grid, or save it as a GeoTIFF");
            return Err(Fault::new("the header", problem));
        }
        return Ok((found.plane, found.warning));
    }
    stored.check_metres()?;
    Ok((Plane::Local, Some(Stored::without_a_globe())))
}
