//! What lies across a path: lanes, edges and parametric pieces, as data that can be replaced for each path.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What moves on a strip of a cross-section.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LaneKind {
    /// Vehicles.
    Driving,
    /// Nobody, but a vehicle that broke down.
    Shoulder,
    /// Nobody: what keeps directions apart.
    Median,
    /// People on foot.
    Sidewalk,
    /// Cycles.
    Cycling,
    /// A track of rails.
    Rail,
    /// Nothing moves on it: a pipe, a ribbon.
    None,
}

/// The line on the outer edge of a lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Marking {
    /// No line.
    #[default]
    None,
    /// An unbroken line.
    Solid,
    /// A broken line.
    Broken,
    /// Two unbroken lines.
    Double,
}

/// What a surface looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Material {
    /// Black top.
    #[default]
    Asphalt,
    /// Concrete, as of parapets and pillars.
    Concrete,
    /// Broken stone, as under rails.
    Ballast,
    /// Trodden earth.
    Earth,
    /// Grass.
    Grass,
    /// Steel.
    Steel,
    /// Wood.
    Wood,
    /// White paint.
    Paint,
    /// Coloured cloth.
    Cloth,
}

/// A strip along a path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lane {
    /// What moves on it.
    pub kind: LaneKind,
    /// Its width, m.
    pub width_m: f64,
    /// The line on its edge away from the middle.
    #[serde(default)]
    pub marking: Marking,
    /// What it is made of.
    #[serde(default)]
    pub material: Material,
}

/// A piece that is laid again and again along a path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Piece {
    /// Its name, by which instances are told apart in scenes.
    pub name: String,
    /// Size along the path, across it and upwards, m.
    pub size_m: [f64; 3],
    /// From one to the next, m; as long as the piece itself where it runs on without a gap.
    pub every_m: f64,
    /// Where its middle lies to the left of the path's middle, m.
    pub left_m: f64,
    /// How far its foot lies above the surface, m.
    pub above_m: f64,
    /// What it is made of.
    pub material: Material,
}

/// What meets whom where paths of this kind cross others and nobody said more.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Crosses {
    /// They meet at one height.
    #[default]
    Level,
    /// It passes over others.
    Over,
    /// It passes under others.
    Under,
}

/// The cross-section of a path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Section {
    /// Its name.
    pub name: String,
    /// Lanes to the left of the middle, from the middle outwards; traffic on them comes towards the path's start.
    #[serde(default)]
    pub left: Vec<Lane>,
    /// Lanes to the right of the middle, from the middle outwards; traffic on them goes with the path.
    #[serde(default)]
    pub right: Vec<Lane>,
    /// The line in the middle.
    #[serde(default)]
    pub centre: Marking,
    /// How thick the deck of a bridge is, m.
    pub thickness_m: f64,
    /// How far the ground is cut below the surface for what is laid on it: pavement or ballast, m.
    #[serde(default)]
    pub bed_m: f64,
    /// Height that must be free above it, m.
    pub clearance_m: f64,
    /// No bend of the path is tighter than this, m.
    pub min_radius_m: f64,
    /// The steepest grade, rise for a metre.
    pub max_grade: f64,
    /// Speed that it is meant for where none is set, km/h.
    pub speed_kmh: f64,
    /// Whether the ground is cut and filled for it; a pipe or a ribbon leaves the ground alone.
    pub shapes_ground: bool,
    /// How paths of this kind cross others.
    #[serde(default)]
    pub crosses: Crosses,
    /// What is laid along it.
    #[serde(default)]
    pub pieces: Vec<Piece>,
}

/// What is wrong with a cross-section.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("section {section:?}: {field} is {value}; expected {expected}")]
#[non_exhaustive]
pub struct SectionError {
    /// Which section.
    pub section: String,
    /// What of it.
    pub field: String,
    /// What stands there.
    pub value: f64,
    /// What would do.
    pub expected: &'static str,
}

impl Section {
    /// How far it reaches to the left and to the right of the middle, m.
    #[must_use]
    pub fn half_widths_m(&self) -> [f64; 2] {
        [&self.left, &self.right].map(|lanes| lanes.iter().map(|lane| lane.width_m).sum())
    }

    /// Its whole width, m.
    #[must_use]
    pub fn width_m(&self) -> f64 {
        let [left, right] = self.half_widths_m();
        left + right
    }

    /// Whether vehicles drive on it.
    #[must_use]
    pub fn is_road(&self) -> bool {
        self.left.iter().chain(&self.right).any(|lane| lane.kind == LaneKind::Driving)
    }

    /// Checks every number against its range.
    ///
    /// # Errors
    /// Names the first that is out of its range.
    pub fn validate(&self) -> Result<(), SectionError> {
        let wrong = |field: String, value: f64, expected: &'static str| SectionError {
            section: self.name.clone(),
            field,
            value,
            expected,
        };
        let within = |v: f64, low: f64, high: f64| (low..=high).contains(&v);
        for (side, lanes) in [("left", &self.left), ("right", &self.right)] {
            for (i, lane) in lanes.iter().enumerate() {
                if !within(lane.width_m, 0.05, 50.0) {
                    return Err(wrong(format!("{side}[{i}].width_m"), lane.width_m, "0.05 to 50 m"));
                }
            }
        }
        if !(self.width_m() > 0.0) {
            return Err(wrong("width".to_owned(), self.width_m(), "a lane on one side at least"));
        }
        for (i, piece) in self.pieces.iter().enumerate() {
            let least = piece.size_m.iter().copied().fold(f64::INFINITY, f64::min);
            if !(least > 0.0 && piece.size_m.iter().all(|s| *s <= 1000.0)) {
                return Err(wrong(format!("pieces[{i}].size_m"), least, "more than 0 and up to 1000 m each"));
            }
            if !within(piece.every_m, 0.1, 1e4) {
                return Err(wrong(format!("pieces[{i}].every_m"), piece.every_m, "0.1 to 10000 m"));
            }
            for (field, value) in [("left_m", piece.left_m), ("above_m", piece.above_m)] {
                if !within(value, -100.0, 100.0) {
                    return Err(wrong(format!("pieces[{i}].{field}"), value, "-100 to 100 m"));
                }
            }
        }
        let rules: [(&str, f64, f64, f64, &'static str); 6] = [
            ("bed_m", self.bed_m, 0.0, 20.0, "0 to 20 m"),
            ("thickness_m", self.thickness_m, 0.0, 20.0, "0 to 20 m"),
            ("clearance_m", self.clearance_m, 0.0, 100.0, "0 to 100 m"),
            ("min_radius_m", self.min_radius_m, 0.1, 1e4, "0.1 to 10000 m"),
            ("max_grade", self.max_grade, 0.001, 2.0, "0.001 to 2"),
            ("speed_kmh", self.speed_kmh, 1.0, 500.0, "1 to 500 km/h"),
        ];
        for (field, value, low, high, expected) in rules {
            if !within(value, low, high) {
                return Err(wrong(field.to_owned(), value, expected));
            }
        }
        Ok(())
    }

    /// The sections that come along, by name: `two-lane`, `four-lane`, `rail`, `footpath`, `pipe`, `ribbon`.
    #[must_use]
    pub fn shipped(name: &str) -> Option<Self> {
        match name {
            "two-lane" => Some(two_lane()),
            "four-lane" => Some(four_lane()),
            "rail" => Some(rail()),
            "footpath" => Some(footpath()),
            "pipe" => Some(pipe()),
            "ribbon" => Some(ribbon()),
            _ => None,
        }
    }

    /// The names of the sections that come along.
    pub const SHIPPED: [&'static str; 6] = ["two-lane", "four-lane", "rail", "footpath", "pipe", "ribbon"];
}

fn lane(kind: LaneKind, width_m: f64, marking: Marking, material: Material) -> Lane {
    Lane { kind, width_m, marking, material }
}

/// A rural road: a lane of 3.25 m each way and a paved shoulder of half a metre.
fn two_lane() -> Section {
    let side = vec![
        lane(LaneKind::Driving, 3.25, Marking::Solid, Material::Asphalt),
        lane(LaneKind::Shoulder, 0.5, Marking::None, Material::Asphalt),
    ];
    Section {
        name: "two-lane".to_owned(),
        left: side.clone(),
        right: side,
        centre: Marking::Broken,
        thickness_m: 0.8,
        bed_m: 0.5,
        clearance_m: 4.7,
        min_radius_m: 12.0,
        max_grade: 0.1,
        speed_kmh: 60.0,
        shapes_ground: true,
        crosses: Crosses::Level,
        pieces: Vec::new(),
    }
}

/// A dual carriageway: half a median of 1.5 m, two lanes of 3.5 m and a hard shoulder of 2.5 m each way.
fn four_lane() -> Section {
    let side = vec![
        lane(LaneKind::Median, 1.5, Marking::Solid, Material::Grass),
        lane(LaneKind::Driving, 3.5, Marking::Broken, Material::Asphalt),
        lane(LaneKind::Driving, 3.5, Marking::Solid, Material::Asphalt),
        lane(LaneKind::Shoulder, 2.5, Marking::None, Material::Asphalt),
    ];
    Section {
        name: "four-lane".to_owned(),
        left: side.clone(),
        right: side,
        centre: Marking::None,
        thickness_m: 1.2,
        bed_m: 0.6,
        clearance_m: 4.7,
        min_radius_m: 120.0,
        max_grade: 0.06,
        speed_kmh: 110.0,
        shapes_ground: true,
        pieces: vec![Piece {
            name: "guard rail".to_owned(),
            size_m: [4.0, 0.1, 0.75],
            every_m: 4.0,
            left_m: 0.0,
            above_m: 0.0,
            material: Material::Steel,
        }],
        crosses: Crosses::Level,
    }
}

/// A single track of standard gauge, 1.435 m between the rails, on sleepers every 0.6 m.
fn rail() -> Section {
    let side = vec![lane(LaneKind::Rail, 2.2, Marking::None, Material::Ballast)];
    let rail = |left_m: f64| Piece {
        name: "rail".to_owned(),
        size_m: [3.0, 0.07, 0.17],
        every_m: 3.0,
        left_m,
        above_m: 0.2,
        material: Material::Steel,
    };
    Section {
        name: "rail".to_owned(),
        left: side.clone(),
        right: side,
        centre: Marking::None,
        thickness_m: 1.0,
        bed_m: 0.7,
        clearance_m: 6.5,
        min_radius_m: 150.0,
        max_grade: 0.035,
        speed_kmh: 80.0,
        shapes_ground: true,
        crosses: Crosses::Level,
        pieces: vec![
            Piece {
                name: "sleeper".to_owned(),
                size_m: [0.26, 2.6, 0.2],
                every_m: 0.6,
                left_m: 0.0,
                above_m: 0.0,
                material: Material::Wood,
            },
            rail(0.7525),
            rail(-0.7525),
        ],
    }
}

fn footpath() -> Section {
    let side = vec![lane(LaneKind::Sidewalk, 0.9, Marking::None, Material::Earth)];
    Section {
        name: "footpath".to_owned(),
        left: side.clone(),
        right: side,
        centre: Marking::None,
        thickness_m: 0.3,
        bed_m: 0.2,
        clearance_m: 2.5,
        min_radius_m: 1.5,
        max_grade: 0.25,
        speed_kmh: 5.0,
        shapes_ground: true,
        crosses: Crosses::Level,
        pieces: Vec::new(),
    }
}

fn pipe() -> Section {
    let side = vec![lane(LaneKind::None, 0.5, Marking::None, Material::Steel)];
    Section {
        name: "pipe".to_owned(),
        left: side.clone(),
        right: side,
        centre: Marking::None,
        thickness_m: 1.0,
        bed_m: 0.0,
        clearance_m: 0.5,
        min_radius_m: 3.0,
        max_grade: 2.0,
        speed_kmh: 10.0,
        shapes_ground: false,
        crosses: Crosses::Over,
        pieces: vec![Piece {
            name: "saddle".to_owned(),
            size_m: [0.4, 1.4, 0.5],
            every_m: 12.0,
            left_m: 0.0,
            above_m: -1.5,
            material: Material::Concrete,
        }],
    }
}

fn ribbon() -> Section {
    let side = vec![lane(LaneKind::None, 1.0, Marking::None, Material::Cloth)];
    Section {
        name: "ribbon".to_owned(),
        left: side.clone(),
        right: side,
        centre: Marking::None,
        thickness_m: 0.05,
        bed_m: 0.0,
        clearance_m: 1.0,
        min_radius_m: 2.0,
        max_grade: 2.0,
        speed_kmh: 20.0,
        shapes_ground: false,
        crosses: Crosses::Over,
        pieces: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_comes_along_is_valid_and_goes_by_its_name() {
        for name in Section::SHIPPED {
            let section = Section::shipped(name).unwrap();
            assert_eq!(section.name, name);
            assert_eq!(section.validate(), Ok(()));
        }
        assert_eq!(Section::shipped("motorway"), None);
    }

    #[test]
    fn a_lane_without_width_is_named() {
        let mut section = Section::shipped("two-lane").unwrap();
        section.left[1].width_m = 0.0;
        let error = section.validate().unwrap_err();
        assert_eq!(error.to_string(), "section \"two-lane\": left[1].width_m is 0; expected 0.05 to 50 m");
    }
}
