//! Paths, bridges, tunnels and signs as GeoJSON (RFC 7946): longitude, latitude and height, found from the terrain's georeference.

use super::export::DriveExport;
use crate::error::Error;
use crate::terrain::Projector;
use fairpath_curve::Point;
use fairpath_drive::{Carrier, PathResult, Sign, SignKind};
use serde_json::{Value, json};

/// Lines leave the curves by no more than this, m.
const ACCURACY_M: f64 = 0.05;

/// Decimals of a degree: a millimetre.
const DECIMALS: f64 = 1e8;

pub(super) fn write(export: &DriveExport<'_>) -> Result<Vec<u8>, Error> {
    let unwritable =
        |problem: String| Error::Unwritable { format: "GeoJSON", place: "the terrain".to_owned(), problem };
    let georeference = export.state.terrain.as_ref().and_then(|t| t.georeference.as_ref());
    let georeference = georeference.ok_or_else(|| {
        unwritable(
            "it lies nowhere on the globe; GeoJSON needs a terrain with a georeference, such as a GeoTIFF or SRTM"
                .to_owned(),
        )
    })?;
    let projector = Projector::new(georeference).map_err(|e| unwritable(e.to_string()))?;
    let place = |p: Point, z: f64| -> Result<Value, Error> {
        let [longitude, latitude] = projector.longitude_latitude(p).map_err(|e| unwritable(e.to_string()))?;
        let round = |x: f64, by: f64| (x * by).round() / by;
        Ok(json!([round(longitude, DECIMALS), round(latitude, DECIMALS), round(z, 1e3)]))
    };
    let mut features = Vec::new();
    for (path, signs) in export.results.paths.iter().zip(&export.results.signs) {
        let properties = json!({
            "name": path.path.name,
            "layer": path.path.layer,
            "section": path.path.section.name,
            "length_m": path.path.length_m(),
            "speed_limits": limits(path),
        });
        features.push(line(path, [0.0, path.path.length_m()], properties, &place)?);
        for s in &path.structures {
            let kind = if s.carrier == Carrier::Bridge { "bridge" } else { "tunnel" };
            let properties = json!({
                "kind": kind, "path": path.path.name, "from_m": s.from_m, "to_m": s.to_m,
                "over_water": s.over_water, "over_path": s.over_path,
            });
            features.push(line(path, [s.from_m, s.to_m], properties, &place)?);
        }
        for sign in signs.iter() {
            features.push(sign_feature(path, sign, &place)?);
        }
    }
    let text = serde_json::to_string(&json!({"type": "FeatureCollection", "name": export.name, "features": features}));
    text.map(String::into_bytes).map_err(|e| unwritable(e.to_string()))
}

/// Speeds that hold along a path.
fn limits(path: &PathResult) -> Value {
    path.path.speed_limits().iter().map(|(from_m, kmh)| json!({"from_m": from_m, "kmh": kmh})).collect()
}

type PlaceOf<'a> = dyn Fn(Point, f64) -> Result<Value, Error> + 'a;

fn line(path: &PathResult, [from, to]: [f64; 2], properties: Value, place: &PlaceOf<'_>) -> Result<Value, Error> {
    let mut stations = vec![from];
    let mut begin = 0.0;
    for segment in path.path.plan.segments() {
        stations.extend(segment.flatten_at(ACCURACY_M).into_iter().map(|s| begin + s).filter(|s| *s > from && *s < to));
        begin += segment.length;
    }
    stations.push(to);
    stations.dedup_by(|b, a| *b - *a < 1e-3);
    let positions: Result<Vec<Value>, Error> =
        stations.iter().map(|&s| place(path.path.plan.point_at(s), path.profile.at(s).height_m)).collect();
    Ok(json!({
        "type": "Feature", "properties": properties,
        "geometry": {"type": "LineString", "coordinates": positions?},
    }))
}

fn sign_feature(path: &PathResult, sign: &Sign, place: &PlaceOf<'_>) -> Result<Value, Error> {
    let (p, _) = sign.stands(&path.path);
    let (kind, value) = match sign.kind {
        SignKind::Stop => ("stop", Value::Null),
        SignKind::StopAhead => ("stop-ahead", Value::Null),
        SignKind::SharpLeft => ("sharp-left", Value::Null),
        SignKind::SharpRight => ("sharp-right", Value::Null),
        SignKind::Bump => ("bump", Value::Null),
        SignKind::Dip => ("dip", Value::Null),
        SignKind::SpeedLimit(kmh) => ("speed-limit", json!(kmh)),
    };
    Ok(json!({
        "type": "Feature",
        "properties": {
            "kind": "sign", "sign": kind, "kmh": value, "path": path.path.name,
            "station_m": sign.station_m, "forward": sign.forward,
        },
        "geometry": {"type": "Point", "coordinates": place(p, path.profile.at(sign.station_m).height_m)?},
    }))
}
