//! Splines as a table, one row per segment:
//! `name,index,kind,x,y,heading,length,kappa0,kappa1,join`.
//!
//! `kind` follows from the curvatures and is not looked at when reading. `index` counts from 0 in each spline; `join` is the
//! continuity towards the next segment, empty after the last of an open spline; a closed spline has one there, towards its first.
//! Unit and direction of y stand in comments above. Method, report, warnings and failures have no place in the table: failures are
//! listed in comments, the rest is left out.

use crate::error::{Error, Fault};
use crate::input::Budget;
use crate::limits::ReadOptions;
use crate::spline_file::{SplineEntry, SplineFile};
use crate::unit::{Unit, YAxis};
use fairpath_curve::{Continuity, Kind, Point, Segment, Spline};
use std::fmt::Write;

const COLUMNS: [&str; 10] = ["name", "index", "kind", "x", "y", "heading", "length", "kappa0", "kappa1", "join"];

/// The word for a kind of segment, as in all formats.
pub(crate) const fn kind_word(kind: Kind) -> &'static str {
    match kind {
        Kind::Line => "line",
        Kind::Arc => "arc",
        Kind::Clothoid => "clothoid",
    }
}

const fn join_word(join: Option<&Continuity>) -> &'static str {
    match join {
        None => "",
        Some(Continuity::G0) => "G0",
        Some(Continuity::G1) => "G1",
        Some(Continuity::G2) => "G2",
        Some(Continuity::G3) => "G3",
    }
}

pub(crate) fn write(file: &SplineFile) -> Result<Vec<u8>, Error> {
    let mut head = format!("# fairpath-spline 1\n# unit: {}\n# y: {}\n", file.unit, file.y.as_str());
    for failure in &file.failures {
        let text = format!("# failed: {:?}: {}: {}", failure.name, failure.code, failure.text);
        let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        writeln!(head, "{text}").expect("writing to a String does not fail");
    }
    let fail = |e: csv::Error| Error::Unwritable {
        format: "CSV",
        place: "the file as a whole".into(),
        problem: e.to_string(),
    };
    let mut table = csv::WriterBuilder::new().comment(Some(b'#')).from_writer(head.into_bytes());
    table.write_record(COLUMNS).map_err(fail)?;
    for entry in &file.splines {
        for (i, s) in entry.spline.segments().iter().enumerate() {
            table.write_field(&entry.name).map_err(fail)?;
            table.write_field(i.to_string()).map_err(fail)?;
            table.write_field(kind_word(s.kind())).map_err(fail)?;
            for number in [s.start.x, s.start.y, s.heading, s.length, s.kappa0, s.kappa1] {
                table.write_field(number.to_string()).map_err(fail)?;
            }
            table.write_field(join_word(entry.spline.joins().get(i))).map_err(fail)?;
            table.write_record(None::<&[u8]>).map_err(fail)?;
        }
    }
    table.into_inner().map_err(|e| fail(csv::Error::from(e.into_error())))
}

pub(crate) fn read(text: &str, options: &ReadOptions) -> Result<SplineFile, Fault> {
    check_lines(text, options)?;
    let mut items = Budget::items(&options.limits);
    let mut file = SplineFile::default();
    for comment in text.lines().map_while(|l| l.strip_prefix('#')) {
        if let Some(unit) = comment.trim().strip_prefix("unit:") {
            file.unit = Unit::from_word(unit.trim())
                .ok_or_else(|| Fault::new("the comments at the top", format_args!("the unit {unit:?} is not known")))?;
        } else if let Some(y) = comment.trim().strip_prefix("y:") {
            file.y = YAxis::from_word(y.trim())
                .ok_or_else(|| Fault::new("the comments at the top", "y is neither `down` nor `up`"))?;
        }
    }
    let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).flexible(true).from_reader(text.as_bytes());
    let headers = table.headers().map_err(|e| csv_fault(&e))?;
    if headers.iter().map(str::trim).ne(COLUMNS) {
        let problem = format!("expected the columns {}", COLUMNS.join(","));
        return Err(Fault::new("the first line", problem));
    }
    let mut current = Open::default();
    for record in table.records() {
        let record = record.map_err(|e| csv_fault(&e))?;
        let line = record.position().map_or(0, csv::Position::line);
        let row = Row::of(&record).map_err(|problem| Fault::new(format_args!("line {line}"), problem))?;
        if row.index == 0 {
            current.close(&mut file)?;
            items.spend(|| format!("line {line}"))?;
            current.name = row.name.to_owned();
        } else if row.index != current.segments.len() || row.name != current.name {
            let problem = format!(
                "segment {} of {:?} follows segment {} of {:?}; expected the segments of each spline in order from 0",
                row.index,
                row.name,
                current.segments.len() as i64 - 1,
                current.name
            );
            return Err(Fault::new(format_args!("line {line}"), problem));
        }
        current.segments.push(row.segment);
        current.joins.push(row.join);
    }
    current.close(&mut file)?;
    Ok(file)
}

/// The line limit, which the table's parser does not know.
fn check_lines(text: &str, options: &ReadOptions) -> Result<(), Fault> {
    let max = options.limits.max_line_bytes;
    match text.lines().position(|l| l.len() as u64 > max) {
        Some(i) => {
            let place = format!("line {}", i + 1);
            Err(Fault::OverLimit { place, what: "bytes in one line", max, limit: "max_line_bytes" })
        }
        None => Ok(()),
    }
}

fn csv_fault(e: &csv::Error) -> Fault {
    let line = e.position().map_or(0, csv::Position::line);
    Fault::new(format_args!("line {line}"), format_args!("this is not a table: {e}"))
}

/// The spline whose rows are being read.
#[derive(Default)]
struct Open {
    name: String,
    segments: Vec<Segment>,
    joins: Vec<Option<Continuity>>,
}

impl Open {
    fn close(&mut self, file: &mut SplineFile) -> Result<(), Fault> {
        let Self { name, segments, mut joins } = std::mem::take(self);
        if segments.is_empty() {
            return Ok(());
        }
        let closed = joins.last().is_some_and(Option::is_some);
        if !closed {
            joins.pop();
        }
        if let Some(i) = joins.iter().position(Option::is_none) {
            return Err(Fault::new(
                format_args!("spline {name:?}, segment {i}"),
                "its join is empty; expected G0, G1, G2 or G3 for all but the last segment",
            ));
        }
        let joins = joins.into_iter().flatten().collect();
        match Spline::new(segments, joins, closed) {
            Ok(spline) => {
                file.splines.push(SplineEntry {
                    name,
                    method: String::new(),
                    spline,
                    report: None,
                    templates: None,
                    warnings: Vec::new(),
                });
                Ok(())
            }
            Err(source) => Err(Fault::Spline { name, source }),
        }
    }
}

struct Row<'r> {
    name: &'r str,
    index: usize,
    segment: Segment,
    join: Option<Continuity>,
}

impl<'r> Row<'r> {
    fn of(record: &'r csv::StringRecord) -> Result<Self, String> {
        if record.len() != COLUMNS.len() {
            return Err(format!("{} columns, expected {}", record.len(), COLUMNS.len()));
        }
        let number = |i: usize| {
            let value = record[i].trim().parse::<f64>().ok().filter(|v| v.is_finite());
            value.ok_or_else(|| format!("{} is {:?}, expected a finite number", COLUMNS[i], &record[i]))
        };
        let index = record[1].trim().parse();
        let index = index.map_err(|_| format!("index is {:?}, expected a number from 0", &record[1]))?;
        let join = match record[9].trim() {
            "" => None,
            "G0" => Some(Continuity::G0),
            "G1" => Some(Continuity::G1),
            "G2" => Some(Continuity::G2),
            "G3" => Some(Continuity::G3),
            other => return Err(format!("join is {other:?}, expected G0, G1, G2, G3 or nothing")),
        };
        let start = Point::new(number(3)?, number(4)?);
        let segment = Segment::clothoid(start, number(5)?, number(6)?, number(7)?, number(8)?);
        Ok(Self { name: &record[0], index, segment, join })
    }
}
