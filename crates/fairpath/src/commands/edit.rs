//! `fairpath edit`: a list of edits made on the curves of a file, all or none.

use anyhow::{Context, Result, bail};
use fairpath_curve::{Continuity, Point, Spline};
use fairpath_fit::{Constraint, close, cut, extend, interpolate_all, join, make_corner, smooth_corner};
use fairpath_io::{Edit, ReadOptions, SplineEntry, SplineFile, Through, read_edits, read_splines};

use super::Ending;
use crate::args::EditArgs;
use crate::output::{Destination, Ready};
use crate::printer::Printer;
use crate::{interrupt, pictures};

pub(crate) fn run(args: &EditArgs, printer: &mut Printer) -> Result<Ending> {
    let to = Destination::new(&args.output, args.format)?;
    interrupt::install();
    if args.splines.as_os_str() == "-" && args.edits.as_os_str() == "-" {
        bail!("standard input (-) can be read only once");
    }
    let mut file = read_splines(&args.splines, &ReadOptions::default())?;
    let edits = read_edits(&args.edits, &ReadOptions::default())?;
    for (i, edit) in edits.iter().enumerate() {
        make(&mut file, edit).with_context(|| format!("{}: edit {} ({})", args.edits.display(), i + 1, edit.name()))?;
    }
    let mut ready = Ready::default();
    let (bytes, warnings) = pictures::encode(&file, None, to.format, args.flip_y)?;
    ready.add(&to.path, bytes);
    for warning in warnings {
        printer.note(&format!("{}: {}", to.path.display(), warning.text));
    }
    ready.write()?;
    Ok(Ending::Done)
}

/// Makes one edit.
fn make(file: &mut SplineFile, edit: &Edit) -> Result<()> {
    match edit {
        Edit::Extend { spline, end, length, how } => {
            let at = find(file, spline.as_deref(), None)?;
            replace(file, at, |old| Ok(extend(old, *end, *length, *how)?))
        }
        Edit::Cut { spline, stations, keep } => {
            let at = find(file, spline.as_deref(), None)?;
            parted(file, at, stations, keep.as_deref())
        }
        Edit::Join { spline, end, with, with_end, continuity, reach } => {
            let other = find(file, Some(with), None)?;
            let at = match spline {
                None if file.splines.len() == 2 => 1 - other,
                _ => find(file, spline.as_deref(), None)?,
            };
            if at == other {
                bail!("spline {with:?} cannot be joined to itself; `close` does that");
            }
            let second = file.splines[other].spline.clone();
            replace(file, at, |old| Ok(join(old, *end, &second, *with_end, *continuity, *reach)?))?;
            file.splines.remove(other);
            Ok(())
        }
        Edit::Close { spline, continuity, reach } => {
            let at = find(file, spline.as_deref(), None)?;
            replace(file, at, |old| Ok(close(old, *continuity, *reach)?))
        }
        Edit::Interpolate { spline, point: at, station, heading, curvature, and, reach } => {
            let index = find(file, spline.as_deref(), Some(point(*at)))?;
            let first = Through { point: *at, station: *station, heading: *heading, curvature: *curvature };
            let constraints: Vec<Constraint> = std::iter::once(&first).chain(and).map(constraint).collect();
            replace(file, index, |old| Ok(interpolate_all(old, &constraints, *reach)?))
        }
        Edit::SmoothCorner { spline, near, reach } => {
            let at = find(file, spline.as_deref(), Some(point(*near)))?;
            replace(file, at, |old| Ok(smooth_corner(old, nearest_corner(old, point(*near))?, *reach)?))
        }
        Edit::MakeCorner { spline, near, reach } => {
            let at = find(file, spline.as_deref(), Some(point(*near)))?;
            replace(file, at, |old| {
                let place = old.nearest(point(*near));
                Ok(make_corner(old, old.station(place.segment, place.s), *reach)?)
            })
        }
    }
}

fn point([x, y]: [f64; 2]) -> Point {
    Point::new(x, y)
}

fn constraint(through: &Through) -> Constraint {
    let Through { point: at, station, heading, curvature } = *through;
    Constraint { station, point: point(at), heading, curvature }
}

/// The spline of that name; else the one nearest to the point; else the only one.
fn find(file: &SplineFile, name: Option<&str>, near: Option<Point>) -> Result<usize> {
    let names = || file.splines.iter().map(|e| format!("{:?}", e.name)).collect::<Vec<_>>().join(", ");
    if let Some(name) = name {
        let found = file.splines.iter().position(|entry| entry.name == name);
        return found.with_context(|| format!("there is no spline {name:?}; the file has {}", names()));
    }
    let distance = |entry: &SplineEntry| near.map_or(0.0, |p| entry.spline.nearest(p).distance);
    match (file.splines.len(), near) {
        (0, _) => bail!("the file has no spline"),
        (1, _) => Ok(0),
        (_, Some(_)) => {
            let of = |i: &usize| distance(&file.splines[*i]);
            (0..file.splines.len()).min_by(|a, b| of(a).total_cmp(&of(b))).context("the file has no spline")
        }
        (_, None) => bail!("say by \"spline\" which one is meant: {}", names()),
    }
}

/// A changed spline in its place; the figures of its fit no longer hold.
fn replace(file: &mut SplineFile, at: usize, edit: impl FnOnce(&Spline) -> Result<Spline>) -> Result<()> {
    let entry = &mut file.splines[at];
    entry.spline = edit(&entry.spline).with_context(|| format!("spline {:?}", entry.name))?;
    entry.report = None;
    Ok(())
}

/// The parts of a spline in its place.
fn parted(file: &mut SplineFile, at: usize, stations: &[f64], keep: Option<&[usize]>) -> Result<()> {
    let old = &file.splines[at];
    let parts = cut(&old.spline, stations).with_context(|| format!("spline {:?}", old.name))?;
    if let Some(&bad) = keep.unwrap_or_default().iter().find(|&&k| k == 0 || k > parts.len()) {
        bail!("keep names part {bad}; there are {}, counted from 1", parts.len());
    }
    let alone = parts.len() == 1;
    let entries: Vec<SplineEntry> = parts
        .into_iter()
        .enumerate()
        .filter(|(i, _)| keep.is_none_or(|keep| keep.contains(&(i + 1))))
        .map(|(i, spline)| {
            let name = if alone { old.name.clone() } else { format!("{}/{}", old.name, i + 1) };
            SplineEntry { name, spline, report: None, ..old.clone() }
        })
        .collect();
    let taken = |e: &&SplineEntry| !alone && file.splines.iter().any(|other| other.name == e.name);
    if let Some(entry) = entries.iter().find(taken) {
        bail!("there is a spline {:?} already; rename it first", entry.name);
    }
    file.splines.splice(at..=at, entries);
    Ok(())
}

/// The corner nearest to a point.
fn nearest_corner(spline: &Spline, near: Point) -> Result<usize> {
    let corners = spline.joins().iter().enumerate().filter(|(_, join)| **join == Continuity::G0).map(|(i, _)| i);
    let distance = |i: &usize| (spline.segments()[*i].end() - near).hypot2();
    corners.min_by(|a, b| distance(a).total_cmp(&distance(b))).context("it has no corner")
}
