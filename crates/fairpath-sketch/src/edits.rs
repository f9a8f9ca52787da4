//! Edits by hand: each takes places of curves and changes the drawing as one step that can be undone.

use crate::carry::carried;
use crate::curve::{Curve, CurveId};
use crate::desk::Slot;
use crate::edit_list::edited;
use crate::file::splines_of;
use crate::job::Trouble;
use crate::session::Session;
use fairpath_curve::{Continuity, Spline};
use fairpath_fit::{CurveEnd, Extension, close, cut, extend, join, make_corner, smooth_corner};
use fairpath_io::Edit;
use std::collections::BTreeSet;

impl Session {
    /// Cuts a curve at a station: an open one in two, a closed one open.
    pub fn cut(&mut self, id: CurveId, station: f64) {
        let Some(curve) = self.drawing().curve(id).cloned() else { return };
        let parts = match cut(&curve.spline, &[station]) {
            Ok(parts) => parts,
            Err(error) => return self.report(error),
        };
        self.desk.drop_wishes(Slot::Curve(id));
        self.selection = self.history.act("Cut", |drawing| {
            let part = |(i, spline): (usize, Spline)| {
                let mut part = curve.edited(spline, &[]);
                if i > 0 {
                    part.id = drawing.new_id();
                    part.name = drawing.free_name(&curve.name);
                }
                part
            };
            let parts: Vec<Curve> = parts.into_iter().enumerate().map(part).collect();
            let ids = parts.iter().map(|part| part.id).collect();
            drawing.replace(id, parts);
            ids
        });
        self.want_all();
    }

    /// Joins two open curves at their nearest ends, smoothly, cutting both back by up to `reach`.
    pub fn join(&mut self, a: CurveId, b: CurveId, reach: f64) {
        if a == b {
            return;
        }
        let (Some(first), Some(second)) = (self.drawing().curve(a).cloned(), self.drawing().curve(b).cloned()) else {
            return;
        };
        let [end, with_end] = nearest_ends(&first.spline, &second.spline);
        let reach = reach.min(0.3 * first.spline.length()).min(0.3 * second.spline.length());
        let joined = match join(&first.spline, end, &second.spline, with_end, Continuity::G2, reach) {
            Ok(joined) => joined,
            Err(error) => return self.report(error),
        };
        self.desk.drop_wishes(Slot::Curve(a));
        self.desk.drop_wishes(Slot::Curve(b));
        let stroke = carried(&[first.source(), second.source()], &joined, &[], first.neatening.pixel_size);
        self.history.act("Join", |drawing| {
            drawing.put(first.reshaped(joined, stroke));
            drawing.remove(b);
        });
        self.want_all();
        self.select(Some(a), false);
    }

    /// Closes an open curve, smoothly, cutting both ends back by up to `reach`.
    pub fn close(&mut self, id: CurveId, reach: f64) {
        let Some(curve) = self.drawing().curve(id) else { return };
        match close(&curve.spline, Continuity::G2, reach.min(0.2 * curve.spline.length())) {
            Ok(closed) => self.reshape("Close", id, closed),
            Err(error) => self.report(error),
        }
    }

    /// Opens a closed curve where it begins.
    pub fn open_curve(&mut self, id: CurveId) {
        self.cut(id, 0.0);
    }

    /// Lengthens an open curve beyond an end.
    pub fn extend(&mut self, id: CurveId, end: CurveEnd, length: f64, how: Extension) {
        let Some(curve) = self.drawing().curve(id) else { return };
        match extend(&curve.spline, end, length, how) {
            Ok(longer) if turning(&longer) > MOST_TURNING => self.report(Trouble {
                code: "too-long".into(),
                text: format!("{length} more would wind it up thousands of times; lengthen it by less"),
            }),
            Ok(longer) => self.reshape("Extend", id, longer),
            Err(error) => self.report(error),
        }
    }

    /// Cuts an open curve back from one of its ends to a station.
    pub fn shorten(&mut self, id: CurveId, end: CurveEnd, station: f64) {
        let Some(curve) = self.drawing().curve(id) else { return };
        match cut(&curve.spline, &[station]) {
            Ok(mut parts) if parts.len() == 2 => {
                let rest = parts.swap_remove(if end == CurveEnd::Start { 1 } else { 0 });
                self.reshape("Shorten", id, rest);
            }
            Ok(_) => {}
            Err(error) => self.report(error),
        }
    }

    /// Makes a list of edits on the curves, by their names, as one step; false if it cannot be made, of which [`take_trouble`](Self::take_trouble) tells.
    pub fn make_edits(&mut self, edits: &[Edit]) -> bool {
        let before = self.drawing().curves().to_vec();
        let list = match edited(&splines_of(self.drawing()), edits) {
            Ok(list) => list,
            Err(error) => {
                self.report(Trouble { code: "no-edit".into(), text: error.to_string() });
                return false;
            }
        };
        self.desk.clear();
        self.corrections.clear();
        self.history.act("Edits", |drawing| {
            let mut first_of = BTreeSet::new();
            let mut curves = Vec::with_capacity(list.origins.len());
            for (entry, origins) in list.file.splines.into_iter().zip(&list.origins) {
                let of = &before[origins[0]];
                let mut curve = if entry.spline == of.spline {
                    (**of).clone()
                } else {
                    let sources: Vec<_> = origins.iter().map(|&i| before[i].source()).collect();
                    let stroke = carried(&sources, &entry.spline, &[], of.neatening.pixel_size);
                    of.reshaped(entry.spline, stroke)
                };
                // The first part of a curve that was cut is still that curve.
                if !first_of.insert(origins[0]) {
                    curve.id = drawing.new_id();
                }
                curve.name = entry.name;
                curves.push(curve);
            }
            for curve in &before {
                drawing.remove(curve.id);
            }
            for curve in curves {
                drawing.put(curve);
            }
        });
        let drawing = self.history.drawing();
        self.selection.retain(|&id| drawing.curve(id).is_some());
        self.want_all();
        true
    }

    /// Makes a corner of a smooth place of a curve, or smooths the corner that is within `reach` of it.
    pub fn toggle_corner(&mut self, id: CurveId, station: f64, reach: f64) {
        let Some(curve) = self.drawing().curve(id) else { return };
        let spline = &curve.spline;
        let made = match corner_near(spline, station, reach) {
            Some(join) => smooth_corner(spline, join, room(spline, join_station(spline, join), reach)),
            None => make_corner(spline, station, room(spline, station, reach)),
        };
        match made {
            Ok(made) => self.reshape("Corner", id, made),
            Err(error) => self.report(error),
        }
    }
}

/// A curve that turns by more than this is no drawing any more, radians.
const MOST_TURNING: f64 = 1e4;

/// How much a curve turns, left and right added.
fn turning(spline: &Spline) -> f64 {
    spline.segments().iter().map(fairpath_curve::Segment::absolute_turning).sum()
}

/// The ends at which two open curves are nearest to each other.
fn nearest_ends(a: &Spline, b: &Spline) -> [CurveEnd; 2] {
    let ends = [CurveEnd::End, CurveEnd::Start];
    let place = |curve: &Spline, end| match end {
        CurveEnd::Start => curve.start_pose().point,
        CurveEnd::End => curve.end_pose().point,
    };
    let pairs = ends.into_iter().flat_map(|end| ends.map(|with| [end, with]));
    let distance = |pair: &[CurveEnd; 2]| (place(a, pair[0]) - place(b, pair[1])).hypot();
    pairs.min_by(|p, q| distance(p).total_cmp(&distance(q))).unwrap_or([CurveEnd::End, CurveEnd::Start])
}

/// The station of a join.
fn join_station(spline: &Spline, join: usize) -> f64 {
    spline.segments()[..=join].iter().map(|segment| segment.length).sum()
}

/// The corner nearest to a station, no further than `reach`.
fn corner_near(spline: &Spline, station: f64, reach: f64) -> Option<usize> {
    let corners = (0..spline.joins().len()).filter(|&join| spline.joins()[join] == Continuity::G0);
    let away = |join: &usize| {
        let straight = (join_station(spline, *join) - station).abs();
        if spline.is_closed() { straight.min(spline.length() - straight) } else { straight }
    };
    corners.filter(|join| away(join) <= reach).min_by(|a, b| away(a).total_cmp(&away(b)))
}

/// As much of a reach as a curve has room for on both sides of a station.
fn room(spline: &Spline, station: f64, reach: f64) -> f64 {
    let length = spline.length();
    let most = if spline.is_closed() { 0.25 * length } else { 0.9 * station.min(length - station) };
    reach.min(most)
}
