//! Where paths meet in plan, and how: two paths come in, their crossings and the ends of one on the other go out; what was said about crossings decides who passes
//! over whom (section 3.4.3 of the thesis).

use super::path::{Path, PathId};
use crate::section::Crosses;
use crate::survey::Survey;
use fairpath_curve::{Contact as Touch, Point, Rect};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A place on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPlace {
    /// Which path.
    pub path: PathId,
    /// Arc length from its start, m.
    pub station_m: f64,
}

/// How two paths stand to each other where they meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Meeting {
    /// At one height: an intersection.
    Level,
    /// The first passes over the second.
    Over,
    /// The first passes under the second.
    Under,
}

impl Meeting {
    /// As the second path sees it.
    #[must_use]
    pub fn turned(self) -> Self {
        match self {
            Self::Level => Self::Level,
            Self::Over => Self::Under,
            Self::Under => Self::Over,
        }
    }
}

/// A place where two paths, or two places of one, come together in plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// On one path: that of the lower id, or the earlier place of one path.
    pub first: PathPlace,
    /// On the other.
    pub second: PathPlace,
    /// Where.
    pub point: Point,
    /// Whether an end of one of them lies there, so that nothing goes on beyond.
    pub at_end: bool,
    /// How the first stands to the second.
    pub meeting: Meeting,
}

impl Crossing {
    /// The upper and the lower place where one passes over the other.
    #[must_use]
    pub fn upper_lower(&self) -> Option<[PathPlace; 2]> {
        match self.meeting {
            Meeting::Level => None,
            Meeting::Over => Some([self.first, self.second]),
            Meeting::Under => Some([self.second, self.first]),
        }
    }

    /// Both places.
    #[must_use]
    pub fn places(&self) -> [PathPlace; 2] {
        [self.first, self.second]
    }
}

/// What somebody said about a crossing: it holds for the crossing of these two that is nearest to where it was said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// One path.
    pub first: PathId,
    /// The other, or the same one.
    pub second: PathId,
    /// Where the crossing was then.
    pub near: Point,
    /// How the first shall stand to the second.
    pub meeting: Meeting,
}

/// An end of a path this far beside another path's edge still lies on it, m.
const END_REACH_M: f64 = 3.0;

/// What a path sticks out beyond a crossing by no more than this, in widths of the other path, is no arm of an intersection but a stub.
const STUB_WIDTHS: f64 = 1.5;

/// What was said about a crossing that moved further than this is forgotten, m.
const CHOICE_REACH_M: f64 = 60.0;

/// A path and how far it reaches.
pub(crate) type Surveyed<'a> = (&'a Path, &'a Survey);

/// The box in which a path can meet another one.
pub(crate) fn reach((path, survey): Surveyed<'_>) -> Rect {
    let beyond = path.section.width_m() + 10.0;
    survey.bounds.inflate(beyond, beyond)
}

/// All places where two different paths come together, `a` with the lower id, as if nothing had been said about them.
pub(crate) fn crossings_between((a, of_a): Surveyed<'_>, (b, of_b): Surveyed<'_>) -> Vec<Crossing> {
    let place = |path: &Path, station_m| PathPlace { path: path.id, station_m };
    let mut found: Vec<Crossing> = Vec::new();
    for x in a.plan.intersections_in(&of_a.boxes, &b.plan, &of_b.boxes) {
        // Paths that run along each other meet nowhere in particular.
        if x.contact == Touch::Overlap {
            continue;
        }
        let s = a.plan.station(x.first.segment, x.first.s);
        let t = b.plan.station(x.second.segment, x.second.s);
        let at_end = is_stub(a, s, b) || is_stub(b, t, a);
        let (first, second) = (place(a, s), place(b, t));
        found.push(Crossing { first, second, point: x.point, at_end, meeting: Meeting::Level });
    }
    let mut ends = Vec::new();
    for (own, (other, survey), turned) in [(a, (b, of_b), false), (b, (a, of_a), true)] {
        let reach = other.section.width_m() * 0.5 + END_REACH_M;
        // Wide enough that what decides is the distance.
        let around = survey.bounds.inflate(reach + 1.0, reach + 1.0);
        for station in own.ends() {
            let end = own.plan.point_at(station);
            if !around.contains(end) {
                continue;
            }
            let near = other.plan.nearest(end);
            let on_other = other.snapped(other.plan.station(near.segment, near.s), own);
            let crossed = |c: &Crossing| {
                let s = if turned { c.second } else { c.first };
                (s.station_m - station).abs() <= STUB_WIDTHS * other.section.width_m()
            };
            if near.distance > reach || found.iter().any(crossed) {
                continue;
            }
            let (first, second) = if turned { (on_other, station) } else { (station, on_other) };
            ends.push((first, second, end.midpoint(near.point)));
        }
    }
    // Two ends that meet were found from both sides.
    let mut kept: Vec<(f64, f64, Point)> = Vec::new();
    for end in ends {
        let width = a.section.width_m().max(b.section.width_m());
        if !kept.iter().any(|k| (k.0 - end.0).abs() <= width && (k.1 - end.1).abs() <= width) {
            kept.push(end);
        }
    }
    found.extend(kept.into_iter().map(|(s, t, point)| Crossing {
        first: place(a, s),
        second: place(b, t),
        point,
        at_end: true,
        meeting: Meeting::Level,
    }));
    found.sort_by(|p, q| p.first.station_m.total_cmp(&q.first.station_m));
    found
}

/// All places where a path comes together with itself.
pub(crate) fn crossings_within((path, survey): Surveyed<'_>) -> Vec<Crossing> {
    let place = |station_m| PathPlace { path: path.id, station_m };
    let mut found: Vec<Crossing> = Vec::new();
    for x in path.plan.self_intersections_in(&survey.boxes) {
        if x.contact == Touch::Overlap {
            continue;
        }
        let s = path.plan.station(x.first.segment, x.first.s);
        let t = path.plan.station(x.second.segment, x.second.s);
        let at_end = is_stub(path, s, path) || is_stub(path, t, path);
        found.push(Crossing { first: place(s), second: place(t), point: x.point, at_end, meeting: Meeting::Level });
    }
    let width = path.section.width_m();
    for station in path.ends() {
        let end = path.plan.point_at(station);
        let crossed =
            |c: &Crossing| [c.first, c.second].iter().any(|p| (p.station_m - station).abs() <= STUB_WIDTHS * width);
        if found.iter().any(crossed) {
            continue;
        }
        // The nearest place that is not the end's own neighbourhood.
        let own = |s: f64| (s - station).abs() <= 4.0 * width + 2.0 * END_REACH_M;
        let reach = 0.5 * width + END_REACH_M;
        let nearest = path
            .plan
            .segments()
            .iter()
            .zip(&survey.boxes)
            .enumerate()
            .filter(|(_, (_, bounds))| bounds.inflate(reach, reach).contains(end))
            .flat_map(|(i, (segment, _))| segment.nearest_all(end).into_iter().map(move |n| (i, n)))
            .map(|(i, n)| (path.plan.station(i, n.s), n))
            .filter(|(s, n)| !own(*s) && n.distance <= reach)
            .min_by(|p, q| p.1.distance.total_cmp(&q.1.distance));
        if let Some((other, near)) = nearest {
            let (s, t) = (station.min(other), station.max(other));
            let point = end.midpoint(near.point);
            found.push(Crossing { first: place(s), second: place(t), point, at_end: true, meeting: Meeting::Level });
        }
    }
    found.sort_by(|p, q| p.first.station_m.total_cmp(&q.first.station_m));
    found
}

/// Whether a path ends so soon beyond a place that it does not go on there.
fn is_stub(path: &Path, station: f64, other: &Path) -> bool {
    let stub = STUB_WIDTHS * other.section.width_m();
    path.ends().any(|end| (end - station).abs() <= stub)
}

impl Path {
    /// The stations of its ends; none of a closed path.
    pub(crate) fn ends(&self) -> impl Iterator<Item = f64> + use<> {
        let ends = if self.plan.is_closed() { None } else { Some([0.0, self.length_m()]) };
        ends.into_iter().flatten()
    }

    /// A station, moved to an end of the path that is nearer to it than `other` is wide.
    fn snapped(&self, station: f64, other: &Self) -> f64 {
        self.ends().find(|end| (end - station).abs() <= other.section.width_m()).unwrap_or(station)
    }
}

/// What a crossing is by the paths alone: breaks go under, then what their sections say.
fn unsaid(a: &Path, b: &Path, crossing: &Crossing) -> Meeting {
    let broken = |path: &Path, at: f64| path.breaks.iter().any(|[from, to]| (*from..=*to).contains(&at));
    let (first, second) = (broken(a, crossing.first.station_m), broken(b, crossing.second.station_m));
    match (first, second, a.section.crosses, b.section.crosses) {
        (true, false, ..) => Meeting::Under,
        (false, true, ..) => Meeting::Over,
        (_, _, x, y) if x == y => Meeting::Level,
        (_, _, Crosses::Over, _) | (_, _, _, Crosses::Under) => Meeting::Over,
        _ => Meeting::Under,
    }
}

/// Puts into crossings of two paths, or of one with itself, what was said about them.
pub(crate) fn decide(a: &Path, b: &Path, crossings: &mut [Crossing], choices: &[Choice]) {
    for crossing in crossings.iter_mut() {
        crossing.meeting = unsaid(a, b, crossing);
    }
    for choice in choices {
        let meeting =
            match (choice.first == a.id && choice.second == b.id, choice.first == b.id && choice.second == a.id) {
                (true, _) => choice.meeting,
                (_, true) => choice.meeting.turned(),
                _ => continue,
            };
        let distance = |c: &Crossing| (c.point - choice.near).hypot2().sqrt();
        let nearest = crossings.iter_mut().min_by(|p, q| distance(p).total_cmp(&distance(q)));
        if let Some(crossing) = nearest.filter(|c| distance(c) <= CHOICE_REACH_M) {
            crossing.meeting = meeting;
        }
    }
}
