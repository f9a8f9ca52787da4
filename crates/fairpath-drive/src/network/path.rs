//! A path as it is kept: where it runs in plan and what was said about its height, its cross-section and its speed. All else follows from these.

use crate::section::Section;
use fairpath_curve::Spline;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What tells paths apart for as long as a document lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
pub struct PathId(pub u32);

/// How the height of a path follows the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum HeightMode {
    /// The ground made fair, and on it the heights at crossings, with a continuous grade throughout.
    #[default]
    Fair,
    /// As in the thesis (section 3.4.4): on the ground itself, and between crossings a Catmull-Rom spline through their heights over it.
    Draped,
    /// The least earthwork that keeps to the limits of grade and vertical curves, by a convex program.
    Engineered,
}

/// Speed along a stretch of a path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SpeedZone {
    /// Where it begins, arc length from the path's start, m.
    pub from_m: f64,
    /// Where it ends, m.
    pub to_m: f64,
    /// Speed, km/h.
    pub kmh: f64,
}

/// Heights that were drawn beside a path in a vertical plane along it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct DrawnHeights {
    /// Arc length from the path's start and height, m; stations ascend.
    pub points_m: Vec<[f64; 2]>,
}

/// A path.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// What tells it apart.
    pub id: PathId,
    /// Its name, unique in the network.
    pub name: String,
    /// The layer that it lies on.
    pub layer: String,
    /// What lies across it.
    pub section: Arc<Section>,
    /// Where it runs in plan, m.
    pub plan: Arc<Spline>,
    /// How its height follows the ground.
    pub heights: HeightMode,
    /// Heights that were drawn, in the order in which they were.
    pub drawn: Vec<DrawnHeights>,
    /// Where its stroke was broken off and taken up again: it passes under what crosses it there. From and to, arc lengths, m.
    pub breaks: Vec<[f64; 2]>,
    /// Speeds that were set; later ones replace earlier ones.
    pub speeds: Vec<SpeedZone>,
}

impl Path {
    /// Its length in plan, m.
    #[must_use]
    pub fn length_m(&self) -> f64 {
        self.plan.length()
    }

    /// The path on another course: what was said about stretches of it moves along with the places that it was said about, and is forgotten where these are
    /// gone. `reach_m` is how far a place may have moved.
    #[must_use]
    pub fn on(&self, plan: Arc<Spline>, reach_m: f64) -> Self {
        let moved = |station: f64| {
            let near = plan.nearest(self.plan.point_at(station));
            (near.distance <= reach_m).then(|| plan.station(near.segment, near.s))
        };
        let whole = self.length_m();
        let range = |[from, to]: [f64; 2]| {
            // All round a closed path is all round it wherever it begins.
            if self.plan.is_closed() && to - from >= whole - 1e-6 {
                return Some([0.0, plan.length()]);
            }
            let (a, b) = (moved(from)?, moved(to)?);
            (a != b).then(|| [a.min(b), a.max(b)])
        };
        let drawn = self.drawn.iter().filter_map(|drawn| {
            let mut points_m: Vec<[f64; 2]> =
                drawn.points_m.iter().filter_map(|[s, z]| moved(*s).map(|s| [s, *z])).collect();
            points_m.sort_by(|a, b| a[0].total_cmp(&b[0]));
            points_m.dedup_by(|a, b| a[0] == b[0]);
            (points_m.len() > 1).then_some(DrawnHeights { points_m })
        });
        let speeds = self.speeds.iter().filter_map(|zone| {
            let [from_m, to_m] = range([zone.from_m, zone.to_m])?;
            Some(SpeedZone { from_m, to_m, ..*zone })
        });
        Self {
            drawn: drawn.collect(),
            breaks: self.breaks.iter().filter_map(|&b| range(b)).collect(),
            speeds: speeds.collect(),
            plan: plan.clone(),
            ..self.clone()
        }
    }

    /// The stretch of the path between two stations, with what was said about it: of what reaches beyond, the part that lies on it. On a closed path the second may lie beyond its end. Nothing if the
    /// stretch is empty.
    #[must_use]
    pub fn part(&self, [from, to]: [f64; 2], id: PathId, name: String) -> Option<Self> {
        let plan = Arc::new(self.plan.subspline(from, to)?);
        let length = self.length_m();
        let turns = if self.plan.is_closed() { &[0.0, length][..] } else { &[0.0][..] };
        let clipped = |[a, b]: [f64; 2]| {
            let on_it = turns.iter().map(move |turn| [(a + turn).max(from) - from, (b + turn).min(to) - from]);
            on_it.filter(|[a, b]| a < b).collect::<Vec<_>>()
        };
        let speeds = self.speeds.iter().flat_map(|zone| {
            let stretches = clipped([zone.from_m, zone.to_m]).into_iter();
            stretches.map(|[from_m, to_m]| SpeedZone { from_m, to_m, ..*zone })
        });
        let drawn = self
            .drawn
            .iter()
            .flat_map(|drawn| turns.iter().filter_map(|turn| drawn.part([from - turn, to - turn])).collect::<Vec<_>>());
        Some(Self {
            id,
            name,
            speeds: speeds.collect(),
            drawn: drawn.collect(),
            breaks: self.breaks.iter().flat_map(|&b| clipped(b)).collect(),
            plan,
            ..self.clone()
        })
    }
}

impl DrawnHeights {
    /// What was drawn between two stations, which become 0 and their difference; nothing if that is no stretch.
    fn part(&self, [from, to]: [f64; 2]) -> Option<Self> {
        let first = self.points_m.first()?[0].max(from);
        let last = self.points_m.last()?[0].min(to);
        let height = |station: f64| {
            let k = self.points_m.partition_point(|p| p[0] < station).clamp(1, self.points_m.len() - 1);
            let [a, b] = [self.points_m[k - 1], self.points_m[k]];
            a[1] + (b[1] - a[1]) * (station - a[0]) / (b[0] - a[0])
        };
        let between = self.points_m.iter().filter(|p| p[0] > first && p[0] < last).copied();
        (first < last).then(|| {
            let ends = [[first, height(first)], [last, height(last)]];
            let points = std::iter::once(ends[0]).chain(between).chain([ends[1]]);
            Self { points_m: points.map(|[s, z]| [s - from, z]).collect() }
        })
    }
}
