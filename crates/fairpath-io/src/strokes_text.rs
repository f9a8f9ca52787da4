//! Strokes as text: `x y [t [pressure]]` a line, a blank line between strokes; read as a stream.

use crate::error::{Error, Fault};
use crate::input::{Budget, Lines};
use crate::limits::ReadOptions;
use crate::stroke_file::StrokeFile;
use crate::strokes_json::check_writable;
use crate::unit::{Unit, YAxis};
use fairpath_curve::Point;
use fairpath_fit::Stroke;
use std::fmt::Write;
use std::io::Read;

/// What a line should be.
const EXPECTED: &str = "expected `x y [t [pressure]]` separated by blanks, tabs, commas or semicolons, \
                        a blank line before the next stroke, or a comment after #";

/// Comments that carry what the points cannot: `# name: …`, `# unit: mm`, `# y: up`, `# dpi: 96`.
const NAME: &str = "name:";

pub(crate) fn read(reader: impl Read, options: &ReadOptions) -> Result<StrokeFile, Fault> {
    let mut lines = Lines::new(reader, &options.limits);
    let mut points = Budget::points(&options.limits);
    let mut items = Budget::items(&options.limits);
    let mut file = StrokeFile::default();
    let mut current = Stroke::new("", Vec::new());
    let mut columns = 0;
    let mut header_allowed = true;
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
        let mut fields = [0.0; 4];
        let count = match numbers(line, &mut fields) {
            Ok(count) => count,
            Err(_) if std::mem::take(&mut header_allowed) && looks_like_header(line) => continue,
            Err(problem) => return Err(Fault::new(place(), format_args!("{problem}; {EXPECTED}"))),
        };
        header_allowed = false;
        if current.points.is_empty() {
            items.spend(place)?;
            columns = count;
        } else if count != columns {
            let problem = format!(
                "{count} numbers where the stroke's first line has {columns}; the lines of one stroke have one length"
            );
            return Err(Fault::new(place(), problem));
        }
        points.spend(place)?;
        current.points.push(Point::new(fields[0], fields[1]));
        if count > 2 {
            current.times_s.push(fields[2]);
        }
        if count > 3 {
            current.pressures.push(fields[3]);
        }
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

/// The numbers of a line, two to four.
fn numbers(line: &str, out: &mut [f64; 4]) -> Result<usize, String> {
    let mut count = 0;
    for field in fields(line) {
        let value: f64 = match field.parse() {
            Ok(value) => value,
            Err(_) if field.is_empty() => return Err(format!("column {} is empty", count + 1)),
            Err(_) => return Err(format!("column {} is {:?}, not a number", count + 1, shortened(field))),
        };
        if !value.is_finite() {
            return Err(format!("column {} is {:?}, not a finite number", count + 1, shortened(field)));
        }
        if count == 4 {
            return Err("there are more than four columns".into());
        }
        out[count] = value;
        count += 1;
    }
    if count < 2 {
        return Err("there is one number only".into());
    }
    Ok(count)
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
