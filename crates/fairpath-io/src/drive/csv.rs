//! A table of stations: where each path runs and how high, every few metres and at every join.

use super::export::DriveExport;
use crate::error::Error;
use fairpath_drive::{CameraTrack, Carrier, Drive, PathResult, Results, areas_m2_at, mass_haul};

/// Rows are no further apart, m; at joins of the plan and at ends of bridges and tunnels there are rows besides.
const EVERY_M: f64 = 10.0;

pub(super) fn write(export: &DriveExport<'_>) -> Result<Vec<u8>, Error> {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    let unwritable = |e: ::csv::Error| Error::Unwritable {
        format: "CSV",
        place: "the table of stations".to_owned(),
        problem: e.to_string(),
    };
    let head = [
        "path",
        "station_m",
        "x_m",
        "y_m",
        "z_m",
        "ground_m",
        "heading_rad",
        "curvature_per_m",
        "grade",
        "speed_kmh",
        "carrier",
        "cut_m2",
        "fill_m2",
    ];
    writer.write_record(head).map_err(unwritable)?;
    for path in &export.results.paths {
        for station in stations(path) {
            let pose = path.path.plan.pose_at(station);
            let at = path.profile.at(station);
            let carrier = path.structures.iter().find(|s| s.from_m <= station && station <= s.to_m).map(|s| s.carrier);
            let [cut, fill] = areas_m2_at(&path.sections, station);
            let numbers = [
                station,
                pose.point.x,
                pose.point.y,
                at.height_m,
                export.results.ground.natural().height(pose.point),
                pose.heading,
                pose.curvature,
                at.grade,
                path.path.speed_limit_kmh(station),
            ];
            let mut row = vec![path.path.name.clone()];
            row.extend(numbers.map(|x| x.to_string()));
            let carrier = match carrier {
                Some(Carrier::Bridge) => "bridge",
                Some(Carrier::Tunnel) => "tunnel",
                None => "ground",
            };
            row.push(carrier.to_owned());
            row.extend([cut, fill].map(|x| x.to_string()));
            writer.write_record(&row).map_err(unwritable)?;
        }
    }
    writer.into_inner().map_err(|e| Error::Unwritable {
        format: "CSV",
        place: "the table of stations".to_owned(),
        problem: e.to_string(),
    })
}

/// The mass-haul table of all paths, or of one: cut and fill by average end areas for every so many metres, and what has come together until then.
///
/// # Errors
/// Never for results of documents; the type is that of other writers.
pub fn encode_earthwork(results: &Results, path: Option<&str>, every_m: f64) -> Result<Vec<u8>, Error> {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    let unwritable = |problem: String| Error::Unwritable { format: "CSV", place: "the earthwork".to_owned(), problem };
    let head = ["path", "from_m", "to_m", "cut_m3", "fill_m3", "ordinate_m3"];
    writer.write_record(head).map_err(|e| unwritable(e.to_string()))?;
    for result in results.paths.iter().filter(|p| path.is_none_or(|name| p.path.name == name)) {
        for row in mass_haul(&result.sections, every_m) {
            let numbers = [row.from_m, row.to_m, row.cut_m3, row.fill_m3, row.ordinate_m3].map(|x| x.to_string());
            let cells = std::iter::once(&result.path.name).chain(&numbers);
            writer.write_record(cells).map_err(|e| unwritable(e.to_string()))?;
        }
    }
    writer.into_inner().map_err(|e| unwritable(e.to_string()))
}

/// Where a vehicle is over time, with a camera that goes along if one is given.
///
/// # Errors
/// Never for drives that were found; the type is that of other writers.
pub fn encode_moments(drive: &Drive, camera: Option<CameraTrack>) -> Result<Vec<u8>, Error> {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    let unwritable = |problem: String| Error::Unwritable { format: "CSV", place: "the drive".to_owned(), problem };
    let mut head =
        vec!["time_s", "driven_m", "x_m", "y_m", "z_m", "heading_rad", "grade", "curvature_per_m", "speed_m_s"];
    if camera.is_some() {
        head.extend(["eye_x_m", "eye_y_m", "eye_z_m", "target_x_m", "target_y_m", "target_z_m"]);
    }
    writer.write_record(&head).map_err(|e| unwritable(e.to_string()))?;
    for moment in &drive.moments {
        let [x, y, z] = moment.position;
        let mut row = vec![
            moment.time_s,
            moment.driven_m,
            x,
            y,
            z,
            moment.heading_rad,
            moment.grade,
            moment.curvature_per_m,
            moment.speed_m_s,
        ];
        if let Some(track) = camera {
            let camera = track.at(moment);
            row.extend(camera.eye);
            row.extend(camera.target);
        }
        writer.write_record(row.iter().map(f64::to_string)).map_err(|e| unwritable(e.to_string()))?;
    }
    writer.into_inner().map_err(|e| unwritable(e.to_string()))
}

fn stations(path: &PathResult) -> Vec<f64> {
    let length = path.path.length_m();
    let count = (length / EVERY_M).ceil().max(1.0) as usize;
    let mut all: Vec<f64> = (0..=count).map(|i| (i as f64 * EVERY_M).min(length)).collect();
    let mut at = 0.0;
    for segment in path.path.plan.segments() {
        at += segment.length;
        all.push(at.min(length));
    }
    all.extend(path.structures.iter().flat_map(|s| [s.from_m, s.to_m]));
    all.sort_by(f64::total_cmp);
    all.dedup_by(|b, a| *b - *a < 1e-6);
    all
}
