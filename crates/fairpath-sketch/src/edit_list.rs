//! A list of edits made on the curves of a file, all or none: a file and the list come in, the changed file goes out, with what each of its curves came of.

use fairpath_curve::{Continuity, Point, Spline};
use fairpath_fit::{Constraint, EditError, close, cut, extend, interpolate_all, join, make_corner, smooth_corner};
use fairpath_io::{Edit, SplineEntry, SplineFile, Through};
use thiserror::Error;

/// Why a list of edits cannot be made.
#[derive(Debug, Error)]
#[error("edit {number} ({name}): {reason}")]
#[non_exhaustive]
pub struct EditListError {
    /// Which edit of the list, counted from 1.
    pub number: usize,
    /// The word for it in a file.
    pub name: &'static str,
    /// What is wrong with it.
    pub reason: EditFault,
}

/// What is wrong with an edit of a list.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EditFault {
    /// The curve cannot be edited so.
    #[error("spline {spline:?}: {error}")]
    Edit {
        /// The curve's name.
        spline: String,
        /// Why.
        error: EditError,
    },
    /// There is no curve of that name.
    #[error("there is no spline {wanted:?}; the file has {names}")]
    NoSpline {
        /// The name.
        wanted: String,
        /// Those that there are.
        names: String,
    },
    /// Nothing says which curve is meant.
    #[error("say by \"spline\" which one is meant: {names}")]
    Which {
        /// Those that there are.
        names: String,
    },
    /// There is nothing to edit.
    #[error("the file has no spline")]
    Empty,
    /// A curve is to be joined to itself.
    #[error("spline {spline:?} cannot be joined to itself; `close` does that")]
    WithItself {
        /// Its name.
        spline: String,
    },
    /// A curve has no corner that could be smoothed.
    #[error("spline {spline:?}: it has no corner")]
    NoCorner {
        /// Its name.
        spline: String,
    },
    /// A part is to be kept that there is not.
    #[error("keep names part {part}; there are {parts}, counted from 1")]
    NoPart {
        /// Which one.
        part: usize,
        /// How many there are.
        parts: usize,
    },
    /// A part would have a name that is taken.
    #[error("there is a spline {name:?} already; rename it first")]
    Taken {
        /// The name.
        name: String,
    },
}

/// A file after a list of edits.
#[derive(Clone, Debug, PartialEq)]
pub struct Edited {
    /// The file.
    pub file: SplineFile,
    /// For each of its splines, which splines of the file before it came of, by their places there.
    pub origins: Vec<Vec<usize>>,
}

/// Makes edits on the curves of a file in their order. What is changed has no report any more, since the figures of its fit no longer hold.
///
/// # Errors
/// The first edit that cannot be made.
pub fn edited(file: &SplineFile, edits: &[Edit]) -> Result<Edited, EditListError> {
    let mut list = Edited { file: file.clone(), origins: (0..file.splines.len()).map(|i| vec![i]).collect() };
    for (i, edit) in edits.iter().enumerate() {
        list.make(edit).map_err(|reason| EditListError { number: i + 1, name: edit.name(), reason })?;
    }
    Ok(list)
}

impl Edited {
    fn make(&mut self, edit: &Edit) -> Result<(), EditFault> {
        match edit {
            Edit::Extend { spline, end, length, how } => {
                let at = self.find(spline.as_deref(), None)?;
                self.replace(at, |old| extend(old, *end, *length, *how))
            }
            Edit::Cut { spline, stations, keep } => {
                let at = self.find(spline.as_deref(), None)?;
                self.part(at, stations, keep.as_deref())
            }
            Edit::Join { spline, end, with, with_end, continuity, reach } => {
                let other = self.find(Some(with), None)?;
                let at = match spline {
                    None if self.file.splines.len() == 2 => 1 - other,
                    _ => self.find(spline.as_deref(), None)?,
                };
                if at == other {
                    return Err(EditFault::WithItself { spline: with.clone() });
                }
                let second = self.file.splines[other].spline.clone();
                self.replace(at, |old| join(old, *end, &second, *with_end, *continuity, *reach))?;
                let others = self.origins[other].clone();
                self.origins[at].extend(others);
                self.file.splines.remove(other);
                self.origins.remove(other);
                Ok(())
            }
            Edit::Close { spline, continuity, reach } => {
                let at = self.find(spline.as_deref(), None)?;
                self.replace(at, |old| close(old, *continuity, *reach))
            }
            Edit::Interpolate { spline, point: at, station, heading, curvature, and, reach } => {
                let index = self.find(spline.as_deref(), Some(point(*at)))?;
                let first = Through { point: *at, station: *station, heading: *heading, curvature: *curvature };
                let constraints: Vec<Constraint> = std::iter::once(&first).chain(and).map(constraint).collect();
                self.replace(index, |old| interpolate_all(old, &constraints, *reach))
            }
            Edit::SmoothCorner { spline, near, reach } => {
                let at = self.find(spline.as_deref(), Some(point(*near)))?;
                let entry = &self.file.splines[at];
                let corner = nearest_corner(&entry.spline, point(*near))
                    .ok_or_else(|| EditFault::NoCorner { spline: entry.name.clone() })?;
                self.replace(at, |old| smooth_corner(old, corner, *reach))
            }
            Edit::MakeCorner { spline, near, reach } => {
                let at = self.find(spline.as_deref(), Some(point(*near)))?;
                self.replace(at, |old| {
                    let place = old.nearest(point(*near));
                    make_corner(old, old.station(place.segment, place.s), *reach)
                })
            }
        }
    }

    /// The spline of that name; else the one nearest to the point; else the only one.
    fn find(&self, name: Option<&str>, near: Option<Point>) -> Result<usize, EditFault> {
        let splines = &self.file.splines;
        let names = || splines.iter().map(|entry| format!("{:?}", entry.name)).collect::<Vec<_>>().join(", ");
        if let Some(name) = name {
            let found = splines.iter().position(|entry| entry.name == name);
            return found.ok_or_else(|| EditFault::NoSpline { wanted: name.into(), names: names() });
        }
        let distance = |entry: &SplineEntry| near.map_or(0.0, |point| entry.spline.nearest(point).distance);
        match splines.len() {
            0 => Err(EditFault::Empty),
            1 => Ok(0),
            _ if near.is_none() => Err(EditFault::Which { names: names() }),
            n => {
                (0..n).min_by(|&i, &j| distance(&splines[i]).total_cmp(&distance(&splines[j]))).ok_or(EditFault::Empty)
            }
        }
    }

    fn replace(&mut self, at: usize, edit: impl FnOnce(&Spline) -> Result<Spline, EditError>) -> Result<(), EditFault> {
        let entry = &mut self.file.splines[at];
        entry.spline = edit(&entry.spline).map_err(|error| EditFault::Edit { spline: entry.name.clone(), error })?;
        entry.report = None;
        Ok(())
    }

    /// The parts of a spline in its place.
    fn part(&mut self, at: usize, stations: &[f64], keep: Option<&[usize]>) -> Result<(), EditFault> {
        let old = &self.file.splines[at];
        let parts = cut(&old.spline, stations).map_err(|error| EditFault::Edit { spline: old.name.clone(), error })?;
        if let Some(&part) = keep.unwrap_or_default().iter().find(|&&k| k == 0 || k > parts.len()) {
            return Err(EditFault::NoPart { part, parts: parts.len() });
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
        let taken = |entry: &&SplineEntry| !alone && self.file.splines.iter().any(|other| other.name == entry.name);
        if let Some(entry) = entries.iter().find(taken) {
            return Err(EditFault::Taken { name: entry.name.clone() });
        }
        let origins = vec![self.origins[at].clone(); entries.len()];
        self.file.splines.splice(at..=at, entries);
        self.origins.splice(at..=at, origins);
        Ok(())
    }
}

fn point([x, y]: [f64; 2]) -> Point {
    Point::new(x, y)
}

fn constraint(through: &Through) -> Constraint {
    let Through { point: at, station, heading, curvature } = *through;
    Constraint { station, point: point(at), heading, curvature }
}

/// The corner nearest to a point.
fn nearest_corner(spline: &Spline, near: Point) -> Option<usize> {
    let corners = spline.joins().iter().enumerate().filter(|(_, join)| **join == Continuity::G0).map(|(i, _)| i);
    let distance = |i: &usize| (spline.segments()[*i].end() - near).hypot2();
    corners.min_by(|a, b| distance(a).total_cmp(&distance(b)))
}
