//! Draughtsman's lettering: every glyph a few pen strokes on a grid 4 wide and 6 high, so that labels need no font.
//!
//! Lower case is shown as smaller capitals. A sign without a glyph becomes an empty box.

use kurbo::{BezPath, Point};

/// Height of the capitals in grid units.
const HEIGHT: f64 = 6.0;
/// Space between glyphs in grid units.
const GAP: f64 = 1.7;
/// Lower case over capitals.
const SMALL: f64 = 0.8;

/// The pen strokes of a glyph: points as two digits x y (y down from the capitals' top), a blank between points, a bar between strokes.
const fn glyph(c: char) -> &'static str {
    match c {
        'A' => "06 20 46|14 34",
        'B' => "03 33 44 45 36 06 00 30 41 42 33",
        'C' => "41 30 10 01 05 16 36 45",
        'D' => "00 06 26 44 42 20 00",
        'E' => "40 00 06 46|03 33",
        'F' => "40 00 06|03 33",
        'G' => "41 30 10 01 05 16 36 45 43 23",
        'H' => "00 06|40 46|03 43",
        'I' => "00 06",
        'J' => "30 35 26 16 05",
        'K' => "00 06|40 04|22 46",
        'L' => "00 06 36",
        'M' => "06 00 23 40 46",
        'N' => "06 00 46 40",
        'O' => "10 30 41 45 36 16 05 01 10",
        'P' => "06 00 30 41 42 33 03",
        'Q' => "10 30 41 45 36 16 05 01 10|24 46",
        'R' => "06 00 30 41 42 33 03|23 46",
        'S' => "41 30 10 01 02 13 33 44 45 36 16 05",
        'T' => "00 40|20 26",
        'U' => "00 05 16 36 45 40",
        'V' => "00 26 40",
        'W' => "00 16 22 36 40",
        'X' => "00 46|40 06",
        'Y' => "00 23 40|23 26",
        'Z' => "00 40 06 46",
        '0' => "10 20 31 35 26 16 05 01 10",
        '1' => "01 10 16",
        '2' => "01 10 20 31 32 06 36",
        '3' => "01 10 20 31 32 23 13|23 34 35 26 16 05",
        '4' => "36 30 04 44",
        '5' => "30 00 02 22 33 35 26 16 05",
        '6' => "30 10 01 05 16 26 35 34 23 13 04",
        '7' => "00 30 16",
        '8' => "10 20 31 32 23 13 02 01 10|13 04 05 16 26 35 34 23",
        '9' => "06 26 35 31 20 10 01 02 13 23 32",
        ' ' => "",
        '/' => "06 30",
        '\\' => "00 36",
        '|' => "00 07",
        '-' | '–' => "03 23",
        '_' => "06 36",
        '.' => "06 06",
        ',' => "16 07",
        ':' => "02 02|05 05",
        ';' => "12 12|15 06",
        '\'' => "00 01",
        '"' => "00 01|20 21",
        '!' => "00 04|06 06",
        '?' => "01 10 20 31 32 23 24|26 26",
        '(' | '[' | '{' => "10 01 05 16",
        ')' | ']' | '}' => "00 11 15 06",
        '<' => "31 03 35",
        '>' => "01 33 05",
        '+' => "03 43|21 25",
        '#' => "10 06|40 36|02 42|04 44",
        '=' => "02 32|04 34",
        '~' => "04 13 33 42",
        '*' => "03 43|11 35|31 15",
        '&' => "46 02 01 10 20 21 04 05 16 26 44",
        '%' => "06 40|00 00|46 46",
        '@' => "33 23 14 25 34 33 41 30 10 01 05 16 36",
        '…' => "06 06|26 26|46 46",
        _ => "00 30 36 06 00",
    }
}

fn glyph_of(c: char) -> (&'static str, f64) {
    if c.is_ascii_lowercase() { (glyph(c.to_ascii_uppercase()), SMALL) } else { (glyph(c), 1.0) }
}

/// The pen strokes of a glyph as grid points.
fn strokes(shape: &str) -> impl Iterator<Item = impl Iterator<Item = (f64, f64)> + '_> + '_ {
    shape.split('|').filter(|s| !s.is_empty()).map(|stroke| {
        stroke.split(' ').filter_map(|pair| {
            let digits = pair.as_bytes();
            Some((f64::from(digits.first()?.wrapping_sub(b'0')), f64::from(digits.get(1)?.wrapping_sub(b'0'))))
        })
    })
}

fn advance(shape: &str, size: f64) -> f64 {
    let width = strokes(shape).flatten().map(|(x, _)| x).fold(0.0, f64::max);
    size * if shape.is_empty() { 1.6 } else { width } + GAP
}

/// Width of a text whose capitals are `height` px high.
pub(crate) fn width(text: &str, height: f64) -> f64 {
    let units: f64 = text.chars().map(glyph_of).map(|(shape, size)| advance(shape, size)).sum();
    (units - GAP).max(0.0) * height / HEIGHT
}

/// The pen strokes of a text that begins at `at`, on its base line.
pub(crate) fn text(text: &str, at: Point, height: f64) -> BezPath {
    let unit = height / HEIGHT;
    let mut path = BezPath::new();
    let mut x = at.x;
    for (shape, size) in text.chars().map(glyph_of) {
        for stroke in strokes(shape) {
            for (i, (gx, gy)) in stroke.enumerate() {
                let p = Point::new(x + gx * size * unit, at.y + (gy - HEIGHT) * size * unit);
                if i == 0 { path.move_to(p) } else { path.line_to(p) }
            }
        }
        x += advance(shape, size) * unit;
    }
    path
}

/// The text, or if it is too wide, so much of its end as fits: names differ at their ends.
pub(crate) fn shortened(text: &str, height: f64, most: f64) -> String {
    if width(text, height) <= most {
        return text.to_owned();
    }
    let mut kept: Vec<char> = Vec::new();
    let mut units = advance("06 06|26 26|46 46", 1.0);
    for c in text.chars().rev() {
        let (shape, size) = glyph_of(c);
        units += advance(shape, size);
        if units * height / HEIGHT > most {
            break;
        }
        kept.push(c);
    }
    kept.push('…');
    kept.iter().rev().collect()
}
