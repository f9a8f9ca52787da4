//! Ground as it was driven over: the heights of a recorded drive.

use crate::common::{assert_limits, network, road};
use std::path::Path;

/// Stations and heights of the points of a recorded drive, m.
fn driven(text: &str) -> Vec<[f64; 2]> {
    let number = |part: &str, name: &str, end: char| -> f64 {
        let after = &part[part.find(name).unwrap() + name.len()..];
        after[..after.find(end).unwrap()].parse().unwrap()
    };
    let mut points: Vec<[f64; 2]> = Vec::new();
    let (mut station, mut last): (f64, Option<[f64; 2]>) = (0.0, None);
    for part in text.split("<trkpt").skip(1) {
        let (lat, lon) = (number(part, "lat=\"", '"').to_radians(), number(part, "lon=\"", '"').to_radians());
        if let Some([lat0, lon0]) = last {
            let (north, east) = (lat - lat0, (lon - lon0) * libm::cos(lat));
            station += 6_371_000.0 * (north * north + east * east).sqrt();
        }
        if points.last().is_none_or(|p| station > p[0] + 1.0) {
            points.push([station, number(part, "<ele>", '<')]);
        }
        last = Some([lat, lon]);
    }
    points
}

#[test]
fn a_recorded_drive_becomes_a_road() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/roads/gpx/around-visnjan-with-car.gpx");
    let Ok(text) = std::fs::read_to_string(&file) else {
        assert!(std::env::var_os("CI").is_none(), "there is no {}", file.display());
        eprintln!("skipped: there is no {}", file.display());
        return;
    };
    let ground = driven(&text);
    let length_m = ground[ground.len() - 1][0];
    assert!(length_m > 2000.0, "{length_m}");
    let mut drive = road(length_m, |_| 0.0);
    drive.ground = ground;
    let drive = network(vec![drive]);
    let heights = drive.solve().unwrap();
    assert!(heights.strict);
    assert_limits(&drive, &heights);
    let earth = heights.earthwork[0];
    println!("{length_m:.0} m in {} iterations: {earth:?}", heights.iterations);
    // A road was there before: on the mean it is less than 2 m off.
    assert!(earth.cut_m3 + earth.fill_m3 < 10.0 * 2.0 * length_m, "{earth:?}");
}
