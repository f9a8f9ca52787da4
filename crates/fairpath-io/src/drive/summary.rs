//! A table of paths as a road engineer reads it.

use fairpath_curve::Kind;
use fairpath_drive::{Breach, Carrier, PathResult, Results, State, volumes_m3};

/// One path in figures.
#[derive(Clone, Debug, PartialEq)]
pub struct PathSummary {
    /// Its name.
    pub name: String,
    /// Its length in plan, m.
    pub length_m: f64,
    /// How many bends it has: runs of arcs and clothoids that turn one way.
    pub curves: usize,
    /// The tightest of them, m; infinite where it is straight.
    pub min_radius_m: f64,
    /// The steepest grade, rise for a metre.
    pub max_grade: f64,
    /// Lowest and highest place, m.
    pub heights_m: [f64; 2],
    /// What is dug off and what is put down, m³.
    pub earthwork_m3: [f64; 2],
    /// Bridges: how many, and how long they are together, m.
    pub bridges: (usize, f64),
    /// Tunnels likewise.
    pub tunnels: (usize, f64),
    /// How many signs stand beside it.
    pub signs: usize,
    /// Where the design breaks a rule, clearances among it.
    pub breaches: Vec<Breach>,
}

/// All paths in figures.
#[must_use]
pub fn summaries(state: &State, results: &Results) -> Vec<PathSummary> {
    let path_of = |id| results.path(id).map(|p| (p.path.as_ref(), p.profile.as_ref()));
    let clearances = state.rules.clearance_breaches(&results.crossings, path_of);
    let one = |(path, signs): (&std::sync::Arc<PathResult>, &std::sync::Arc<Vec<_>>)| {
        let mut breaches = state.rules.breaches(&path.path, &path.profile);
        breaches.extend(clearances.iter().filter(|b| b.path == path.path.id));
        breaches.sort_by(|a, b| a.station_m.total_cmp(&b.station_m).then(a.rule.cmp(&b.rule)));
        summary(path, signs.len(), breaches)
    };
    results.paths.iter().zip(&results.signs).map(one).collect()
}

fn summary(path: &PathResult, signs: usize, breaches: Vec<Breach>) -> PathSummary {
    let plan = &path.path.plan;
    let mut curves = 0;
    let mut turning = 0.0;
    let mut sharpest: f64 = 0.0;
    for segment in plan.segments() {
        let sign = if segment.kind() == Kind::Line { 0.0 } else { (segment.kappa0 + segment.kappa1).signum() };
        curves += usize::from(sign != 0.0 && sign != turning);
        turning = sign;
        sharpest = sharpest.max(segment.kappa0.abs()).max(segment.kappa1.abs());
    }
    let length_m = plan.length();
    let (_, grade) = path.profile.steepest([0.0, length_m]);
    let heights = path.profile.knots().iter().map(|k| k.height_m);
    let of = |carrier: Carrier| {
        let own = path.structures.iter().filter(|s| s.carrier == carrier);
        own.fold((0, 0.0), |(n, m), s| (n + 1, m + s.to_m - s.from_m))
    };
    PathSummary {
        name: path.path.name.clone(),
        length_m,
        curves,
        min_radius_m: 1.0 / sharpest,
        max_grade: grade.abs(),
        heights_m: [heights.clone().fold(f64::INFINITY, f64::min), heights.fold(f64::NEG_INFINITY, f64::max)],
        earthwork_m3: volumes_m3(&path.sections),
        bridges: of(Carrier::Bridge),
        tunnels: of(Carrier::Tunnel),
        signs,
        breaches,
    }
}
