//! What is told of a network of roads before it has heights.

/// Roads whose heights depend on each other.
///
/// ```
/// use fairpath_drive::{ClearanceAt, EarthworkSection, EngineeredNetwork, EngineeredRoad, GradeLimits, RoadPoint};
///
/// let road = |name: &str| EngineeredRoad {
///     name: name.to_owned(),
///     length_m: 800.0,
///     ground: vec![[0.0, 20.0], [300.0, 24.0], [800.0, 21.0]],
///     knot_spacing_m: 10.0,
///     closed: false,
///     limits: GradeLimits { max_grade: 0.06, crest_k_m: 20.0, sag_k_m: 18.0 },
///     section: EarthworkSection { platform_m: 10.0, slope_run: 1.5, cut_weight: 1.0, fill_weight: 1.2 },
///     fixed: Vec::new(),
///     bounds: Vec::new(),
///     start_grade: None,
///     end_grade: None,
///     stretches: Vec::new(),
/// };
/// let (upper, lower) = (RoadPoint { road: 0, station_m: 350.0 }, RoadPoint { road: 1, station_m: 500.0 });
/// let network = EngineeredNetwork {
///     roads: vec![road("pass"), road("valley")],
///     over: vec![ClearanceAt { upper, lower, clearance_m: 5.2 }],
///     meet: Vec::new(),
/// };
/// let heights = network.solve()?;
/// let [above, below] = [upper, lower].map(|place| heights.profiles[place.road].at(place.station_m).height_m);
/// assert!(above - below >= 5.2 && heights.strict);
/// assert!(heights.profiles[0].steepest([0.0, 800.0]).1.abs() <= 0.06);
/// # Ok::<(), fairpath_drive::EngineeredError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EngineeredNetwork {
    /// The roads.
    pub roads: Vec<EngineeredRoad>,
    /// Where one passes over another, or over itself.
    pub over: Vec<ClearanceAt>,
    /// Where two are at the same height.
    pub meet: Vec<MeetAt>,
}

/// A road without its heights.
#[derive(Clone, Debug, PartialEq)]
pub struct EngineeredRoad {
    /// By which messages call it.
    pub name: String,
    /// Arc length in plan, m.
    pub length_m: f64,
    /// The ground along it: stations and heights, m, ascending by station, straight between them. Before the first and beyond the last it is level; they
    /// must be no further from the road's ends than one knot spacing.
    pub ground: Vec<[f64; 2]>,
    /// The longest interval over which the road is one parabola, m. The intervals are all equal, so they may be a little shorter.
    pub knot_spacing_m: f64,
    /// Whether its end is its start: height and grade go on there without a break.
    pub closed: bool,
    /// How steep and how bent it may be.
    pub limits: GradeLimits,
    /// What moving the ground costs.
    pub section: EarthworkSection,
    /// Heights that are given.
    pub fixed: Vec<FixedPoint>,
    /// Heights that it must not go beyond.
    pub bounds: Vec<HeightBound>,
    /// Grade at station 0, rise for a metre.
    pub start_grade: Option<f64>,
    /// Grade at the end, rise for a metre.
    pub end_grade: Option<f64>,
    /// Stretches where earth counts more or less, such as bridges and tunnels. Where they overlap, their weights multiply.
    pub stretches: Vec<WeightedStretch>,
}

/// How steep and how bent a road may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GradeLimits {
    /// Greatest rise or fall for a metre: 0.08 is 8 %.
    pub max_grade: f64,
    /// Least K over crests: metres of vertical curve for each percent by which the grade changes.
    pub crest_k_m: f64,
    /// Least K in sags, likewise.
    pub sag_k_m: f64,
}

/// A cross-section of the earth that is moved: a platform, and slopes from it to the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EarthworkSection {
    /// Width of the platform, m.
    pub platform_m: f64,
    /// How far the side slopes run for a metre of rise; 0 is a wall.
    pub slope_run: f64,
    /// What a cubic metre of cut counts.
    pub cut_weight: f64,
    /// What a cubic metre of fill counts.
    pub fill_weight: f64,
}

/// A height that is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedPoint {
    /// Where, m.
    pub station_m: f64,
    /// How high, m.
    pub height_m: f64,
    /// The grade there if that is given too, rise for a metre.
    pub grade: Option<f64>,
}

/// Heights between which a road must stay over a range of stations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightBound {
    /// Where the range begins, m.
    pub from_m: f64,
    /// Where it ends, m.
    pub to_m: f64,
    /// Not below this, m: a water level with freeboard, say.
    pub lowest_m: Option<f64>,
    /// Not above this, m.
    pub highest_m: Option<f64>,
}

/// A stretch on which moving the ground counts more or less than elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightedStretch {
    /// Where it begins, m.
    pub from_m: f64,
    /// Where it ends, m.
    pub to_m: f64,
    /// Factor of all earthwork there; 0 where none is done.
    pub weight: f64,
}

/// A place on a road.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoadPoint {
    /// Which road.
    pub road: usize,
    /// Arc length in plan from its start, m.
    pub station_m: f64,
}

/// A crossing at which one road passes over another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClearanceAt {
    /// The place that is above.
    pub upper: RoadPoint,
    /// The place that is below, on the same road perhaps.
    pub lower: RoadPoint,
    /// Least height of the one above the other, m.
    pub clearance_m: f64,
}

/// A crossing on one level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeetAt {
    /// One place.
    pub a: RoadPoint,
    /// The other, on the same road perhaps.
    pub b: RoadPoint,
}
