//! Lines of a file as sketches: a file of strokes, of GeoJSON or of GPX and the terrain's place on the globe come in, commands go out.

use crate::error::{Error, Fault};
use crate::input::{label, open, read_all, text};
use crate::limits::ReadOptions;
use crate::stroke_file::StrokeFile;
use crate::strokes::{StrokeFormat, format_of, read_strokes_from};
use crate::terrain::Projector;
use crate::unit::{Unit, YAxis};
use crate::{strokes_geojson, strokes_gpx};
use fairpath_curve::Point;
use fairpath_drive::{Command, GeoReference, Heightfield, SketchAs};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Sketches every line of a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "do", rename = "import", deny_unknown_fields)]
pub struct Import {
    /// The file, beside the script: GeoJSON or GPX, put in their place by the terrain's georeference, or any other file of strokes, in the terrain's frame. Coordinates without a
    /// unit, pixels and points are metres.
    pub file: String,
    /// Only the lines of this name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub only: Option<String>,
    /// The name of the path that the first line becomes; else all get names of their layer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Whether the lines close on themselves.
    #[serde(default)]
    pub closed: bool,
    /// Where the y axis of a file points that is not on the globe; else as the file says, and up where it says nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y: Option<YAxis>,
    /// By how much lines that are not on the globe are moved, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub offset_m: Option<[f64; 2]>,
    /// The layer on which the lines lie.
    #[serde(default = "road")]
    pub layer: String,
    /// The cross-section, by name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<String>,
    /// Size of a pixel of a stroke on the map, m.
    #[serde(default = "one")]
    pub pixel_m: f64,
    /// No bend is tighter, m; else as the cross-section has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub min_radius_m: Option<f64>,
    /// Lines that are shorter stay out, m.
    #[serde(default)]
    pub shortest_m: f64,
    /// No more lines than this are taken, the first ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub most: Option<usize>,
}

fn road() -> String {
    "road".to_owned()
}

fn one() -> f64 {
    1.0
}

impl Import {
    /// The sketches of the lines of a file that lie on the terrain; a line that leaves it is cut there. How many were left out is told in the second value.
    ///
    /// # Errors
    /// When the file cannot be read, or is in longitudes and latitudes and the terrain lies nowhere, or none of its lines is asked for and lies on the terrain.
    pub fn sketches(
        &self,
        folder: &Path,
        field: &Heightfield,
        georeference: Option<&GeoReference>,
    ) -> Result<(Vec<Command>, usize), Error> {
        let path = folder.join(&self.file);
        let lines = self.lines(&path, georeference)?;
        let mut commands = Vec::new();
        let (mut left_out, mut matching, mut off_terrain) = (0, 0, 0);
        for (name, points) in lines {
            if self.only.as_ref().is_some_and(|only| *only != name) {
                continue;
            }
            matching += 1;
            let runs = on_terrain(field, &points);
            off_terrain += usize::from(runs.is_empty());
            for run in runs {
                let length: f64 = run.windows(2).map(|p| (p[1] - p[0]).hypot2().sqrt()).sum();
                if length < self.shortest_m || run.len() < 2 || self.most.is_some_and(|most| commands.len() >= most) {
                    left_out += 1;
                    continue;
                }
                let name = self.name.clone().filter(|_| commands.is_empty());
                // What was cut at the rim does not close.
                commands.push(self.sketch(name, &run, self.closed && run.len() == points.len()));
            }
        }
        if commands.is_empty() {
            let problem = match &self.only {
                Some(only) if matching == 0 => format!("no line in it is named {only:?}"),
                _ if off_terrain == matching => format!("none of its {matching} lines lies on the terrain"),
                _ => format!(
                    "none of its {matching} lines is {} m long on the terrain; lower \"shortest_m\"",
                    self.shortest_m
                ),
            };
            return Err(Fault::new("the file as a whole", problem).in_file(&label(&path)));
        }
        Ok((commands, left_out + off_terrain))
    }

    /// The lines of a file in the terrain's metres, with their names.
    fn lines(&self, path: &Path, georeference: Option<&GeoReference>) -> Result<Vec<(String, Vec<Point>)>, Error> {
        let options = ReadOptions::default();
        let name = label(path);
        let in_file = |fault: Fault| fault.in_file(&name);
        let bytes = read_all(open(path)?, &options.limits).map_err(in_file)?;
        let format = format_of(&bytes, &name, StrokeFormat::from_path(path))?;
        let read_places = match format {
            StrokeFormat::GeoJson => strokes_geojson::read_places,
            StrokeFormat::Gpx => strokes_gpx::read_places,
            _ => {
                let file = read_strokes_from(&bytes[..], &name, Some(format), &options)?;
                return Ok(self.placed(file, format));
            }
        };
        let georeference = georeference.ok_or_else(|| {
            in_file(Fault::new(
                "the file as a whole",
                "it is in longitude and latitude, and the terrain lies nowhere on the globe",
            ))
        })?;
        let projector = Projector::new(georeference)
            .map_err(|e| in_file(Fault::new("the terrain's georeference", e.to_string())))?;
        let (file, places) = text(&bytes).and_then(|t| read_places(t, &options)).map_err(in_file)?;
        let mut lines = Vec::with_capacity(places.len());
        for (stroke, places) in file.strokes.into_iter().zip(places) {
            let points: Result<Vec<Point>, _> =
                places.iter().map(|p| projector.point([p.longitude, p.latitude])).collect();
            let points =
                points.map_err(|e| in_file(Fault::new(format_args!("line {:?}", stroke.name), e.to_string())))?;
            lines.push((stroke.name, points));
        }
        Ok(lines)
    }

    /// Lines that are not on the globe, in metres with y to the north, moved to where they belong.
    fn placed(&self, file: StrokeFile, format: StrokeFormat) -> Vec<(String, Vec<Point>)> {
        // Plain numbers that say nothing are a survey's, not a screen's.
        let says = if format == StrokeFormat::Text && file.unit == Unit::Px { YAxis::Up } else { file.y };
        let metre = if matches!(file.unit, Unit::Px | Unit::Pt) { 1.0 } else { file.unit.metres() };
        let up = if self.y.unwrap_or(says) == YAxis::Down { -metre } else { metre };
        let [x, y] = self.offset_m.unwrap_or_default();
        let placed = |p: &Point| Point::new(metre * p.x + x, up * p.y + y);
        file.strokes.into_iter().map(|s| (s.name, s.points.iter().map(placed).collect())).collect()
    }

    fn sketch(&self, name: Option<String>, points: &[Point], closed: bool) -> Command {
        Command::Sketch {
            points_m: points.iter().map(|p| [p.x, p.y]).collect(),
            layer: self.layer.clone(),
            name,
            section: self.section.clone(),
            sketch_as: SketchAs::New,
            closed,
            pixel_m: self.pixel_m,
            min_radius_m: self.min_radius_m,
        }
    }
}

/// Runs of points on the terrain, a cell away from its edge.
fn on_terrain(field: &Heightfield, points: &[Point]) -> Vec<Vec<Point>> {
    let (low, high, spacing) = (field.corner(), field.far_corner(), field.spacing_m());
    let inside = |p: &&Point| {
        (low.x + spacing.x..=high.x - spacing.x).contains(&p.x)
            && (low.y + spacing.y..=high.y - spacing.y).contains(&p.y)
    };
    points.split(|p| !inside(&p)).filter(|run| run.len() > 1).map(<[Point]>::to_vec).collect()
}
