//! Strokes as text: `x y [t [pressure]]` a line, a blank line between strokes; read as a stream.
//!
//! A first line of words is a header. If it has columns `x` and `y`, columns go by their names: `t`, `time`, `t_s`, `time_s` in seconds,
//! `t_ms`, `time_ms` in milliseconds, `p`, `pressure` or `force`; others are left out with a warning. Any other header changes nothing.
//! Comments `# name: …`, `# unit: mm`, `# y: up` and `# dpi: 96` carry what the points cannot.

use crate::error::{Error, Fault};
use crate::input::{Budget, Lines};
use crate::limits::ReadOptions;
use crate::stroke_file::StrokeFile;
use crate::strokes_json::check_writable;
use crate::unit::{Unit, YAxis};
use fairpath_curve::Point;
use fairpath_fit::{Stroke, Warning};
use std::fmt::Write;
use std::io::Read;

/// What a line should be.
const EXPECTED: &str = "expected `x y [t [pressure]]` separated by blanks, tabs, commas or semicolons, \
                        a blank line before the next stroke, or a comment after #";

/// Begins the comment that names the next stroke.
const NAME: &str = "name:";

pub(crate) fn read(reader: impl Read, options: &ReadOptions) -> Result<StrokeFile, Fault> {
    let mut lines = Lines::new(reader, &options.limits);
    let mut points = Budget::points(&options.limits);
    let mut items = Budget::items(&options.limits);
    let mut file = StrokeFile::default();
    let mut current = Stroke::new("", Vec::new());
    let mut count_of_stroke = 0;
    let mut columns: Option<Columns> = None;
    let mut name: Option<String> = None;
    while let Some((number, line)) = lines.next_line()? {
        let place = || format!("line {number}");
        let line = line.trim();
        if let Some(comment) = line.strip_prefix('#') {
            if let Some(given) = read_comment(comment.trim(), &mut file) {
                finish(&mut file, &mut current, &mut name);
                name = Some(given);
            }
            continue;
        }
        if line.is_empty() {
            finish(&mut file, &mut current, &mut name);
            continue;
        }
        let columns = match &columns {
            Some(columns) => columns,
            None => {
                let header = looks_like_header(line);
                let found = columns.insert(if header { Columns::named(line) } else { Columns::in_order() });
                file.warnings.extend(found.warning());
                if header {
                    continue;
                }
                found
            }
        };
        let (row, count) =
            columns.read(line).map_err(|problem| Fault::new(place(), format_args!("{problem}; {EXPECTED}")))?;
        if current.points.is_empty() {
            items.spend(place)?;
            count_of_stroke = count;
        } else if count != count_of_stroke {
            let problem = format!(
                "{count} numbers where the stroke's first line has {count_of_stroke}; the lines of one stroke have one length"
            );
            return Err(Fault::new(place(), problem));
        }
        points.spend(place)?;
        let [x, y, t, pressure] = row;
        let (Some(x), Some(y)) = (x, y) else {
            return Err(Fault::new(place(), format_args!("there is no x or no y; {EXPECTED}")));
        };
        current.points.push(Point::new(x, y));
        current.times_s.extend(t);
        current.pressures.extend(pressure);
    }
    finish(&mut file, &mut current, &mut name);
    if file.strokes.is_empty() {
        return Err(Fault::new("the file as a whole", format_args!("there is no stroke; {EXPECTED}")));
    }
    file.make_names_unique();
    Ok(file)
}

/// Puts the current stroke, if it has points, into the file.
fn finish(file: &mut StrokeFile, current: &mut Stroke, name: &mut Option<String>) {
    if current.points.is_empty() {
        return;
    }
    let mut stroke = std::mem::replace(current, Stroke::new("", Vec::new()));
    stroke.name = name.take().unwrap_or_else(|| format!("stroke/{}", file.strokes.len()));
    file.strokes.push(stroke);
}

/// Takes what a comment says about the file; gives back the name of the next stroke if it is one.
fn read_comment(comment: &str, file: &mut StrokeFile) -> Option<String> {
    if let Some(name) = comment.strip_prefix(NAME) {
        let name = name.trim();
        return Some(serde_json::from_str(name).unwrap_or_else(|_| name.to_owned()));
    }
    if let Some(unit) = comment.strip_prefix("unit:").and_then(|w| Unit::from_word(w.trim())) {
        file.unit = unit;
    } else if let Some(y) = comment.strip_prefix("y:").and_then(|w| YAxis::from_word(w.trim())) {
        file.y = y;
    } else if let Some(dpi) = comment.strip_prefix("dpi:").and_then(|w| w.trim().parse::<f64>().ok()) {
        file.dpi = Some(dpi).filter(|d| d.is_finite());
    }
    None
}

/// What the columns mean.
struct Columns {
    /// For each column of the header which of x, y, t and pressure it is, and the factor to our unit; nothing without a header.
    roles: Option<Vec<Option<(usize, f64)>>>,
    /// Columns that are none of them.
    left_out: Vec<String>,
}

impl Columns {
    /// Columns x, y, t and pressure in this order.
    fn in_order() -> Self {
        Self { roles: None, left_out: Vec::new() }
    }

    /// The columns of a header.
    fn named(header: &str) -> Self {
        let role = |word: &str| match word.to_ascii_lowercase().as_str() {
            "x" => Some((0, 1.0)),
            "y" => Some((1, 1.0)),
            "t" | "time" | "t_s" | "time_s" => Some((2, 1.0)),
            "t_ms" | "time_ms" => Some((2, 1e-3)),
            "p" | "pressure" | "force" => Some((3, 1.0)),
            _ => None,
        };
        let roles: Vec<_> = fields(header).map(role).collect();
        if !has_position(header) {
            return Self::in_order();
        }
        let left_out = fields(header).filter(|f| role(f).is_none()).take(20).map(shortened).collect();
        Self { roles: Some(roles), left_out }
    }

    fn warning(&self) -> Option<Warning> {
        let text = format!("columns left out: {}", self.left_out.join(", "));
        (!self.left_out.is_empty()).then(|| Warning { code: "column-left-out".into(), text })
    }

    /// x, y, t and pressure of a line, and how many columns it has.
    fn read(&self, line: &str) -> Result<([Option<f64>; 4], usize), String> {
        let mut row = [None; 4];
        let mut count = 0;
        for field in fields(line) {
            let role = match &self.roles {
                None if count == 4 => return Err("there are more than four columns".into()),
                None => Some((count, 1.0)),
                Some(roles) => *roles
                    .get(count)
                    .ok_or_else(|| format!("there are more than the header's {} columns", roles.len()))?,
            };
            count += 1;
            if let Some((role, factor)) = role {
                row[role] = Some(factor * number(field, count)?);
            }
        }
        match &self.roles {
            None if count < 2 => Err("there is one number only".into()),
            Some(roles) if count < roles.len() => Err(format!("{count} columns where the header has {}", roles.len())),
            _ => Ok((row, count)),
        }
    }
}

fn number(field: &str, column: usize) -> Result<f64, String> {
    match field.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(format!("column {column} is {:?}, not a finite number", shortened(field))),
        Err(_) if field.is_empty() => Err(format!("column {column} is empty")),
        Err(_) => Err(format!("column {column} is {:?}, not a number", shortened(field))),
    }
}

/// Whether a header has columns x and y.
fn has_position(header: &str) -> bool {
    ["x", "y"].iter().all(|name| fields(header).any(|f| f.eq_ignore_ascii_case(name)))
}

/// Whether a text begins with a header that has columns x and y.
pub(crate) fn begins_with_header(text: &str) -> bool {
    let line = text.lines().map(str::trim).find(|l| !l.is_empty()).unwrap_or_default();
    looks_like_header(line) && has_position(line)
}

/// Splits at semicolons, else at commas, else at blanks; blanks around are trimmed.
fn fields(line: &str) -> Box<dyn Iterator<Item = &str> + '_> {
    let separator = if line.contains(';') { ';' } else { ',' };
    if line.contains(separator) {
        // One separator may stand at the end of the line, as some programs leave it.
        let line = line.strip_suffix(separator).unwrap_or(line);
        Box::new(line.split(separator).map(|f| f.trim().trim_matches('"')))
    } else {
        Box::new(line.split_whitespace().map(|f| f.trim_matches('"')))
    }
}

/// Whether a line that holds no point may be a header: every field begins with a letter and none is a number.
fn looks_like_header(line: &str) -> bool {
    fields(line).all(|f| f.starts_with(|c: char| c.is_alphabetic() || c == '_') && f.parse::<f64>().is_err())
}

/// So much of a field as a message should show.
fn shortened(field: &str) -> String {
    if field.chars().count() <= 24 { field.to_owned() } else { field.chars().take(24).chain(['…']).collect() }
}

pub(crate) fn write(file: &StrokeFile) -> Result<Vec<u8>, Error> {
    let mut out = format!("# unit: {}\n# y: {}\n", file.unit, file.y.as_str());
    if let Some(dpi) = file.dpi.filter(|d| d.is_finite()) {
        put(&mut out, format_args!("# dpi: {dpi}\n"));
    }
    for stroke in &file.strokes {
        check_writable(stroke, "text")?;
        if stroke.times_s.is_empty() && !stroke.pressures.is_empty() {
            let problem = "it has pressures but no times, and text has no way to say so; write JSON".into();
            return Err(Error::Unwritable { format: "text", place: format!("stroke {:?}", stroke.name), problem });
        }
        put(&mut out, format_args!("\n# name: {}\n", serde_json::Value::from(stroke.name.as_str())));
        for (i, p) in stroke.points.iter().enumerate() {
            put(&mut out, format_args!("{},{}", p.x, p.y));
            for value in [stroke.times_s.get(i), stroke.pressures.get(i)].into_iter().flatten() {
                put(&mut out, format_args!(",{value}"));
            }
            out.push('\n');
        }
    }
    Ok(out.into_bytes())
}

fn put(out: &mut String, args: std::fmt::Arguments<'_>) {
    out.write_fmt(args).expect("writing to a String does not fail");
}
