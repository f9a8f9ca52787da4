//! Bridges, tunnels and signs of a road.

use super::plan;
use super::roads::Road;
use crate::drive::xml::{Xml, number};
use fairpath_drive::{Carrier, Sign, SignKind};

/// Height of a sign's middle above the road, m.
const MIDDLE_M: &str = "2.2";

/// Tunnels come before bridges, as the schema has them.
pub(super) fn write_objects(xml: &mut Xml, road: &Road<'_>) {
    let length = plan::length(&road.geometries);
    let around = around(road);
    let mut found: Vec<(Carrier, f64, f64)> = Vec::new();
    for turn in around {
        for s in &road.path.structures {
            let from = (s.from_m + turn - road.range[0]).max(0.0);
            let to = (s.to_m + turn - road.range[0]).min(length);
            if to > from {
                found.push((s.carrier, from, to));
            }
        }
    }
    if found.is_empty() {
        return;
    }
    xml.open("objects", &[]);
    for (carrier, element, kind) in [(Carrier::Tunnel, "tunnel", "standard"), (Carrier::Bridge, "bridge", "concrete")] {
        for (k, (_, from, to)) in found.iter().filter(|f| f.0 == carrier).enumerate() {
            let id = format!("{}{}{k}", road.id, &element[..1]);
            let name = format!("{element} of {}", road.path.path.name);
            let (s, length) = (number(*from), number(to - from));
            let mut attributes =
                vec![("id", id.as_str()), ("name", &name), ("s", &s), ("length", &length), ("type", kind)];
            if carrier == Carrier::Tunnel {
                attributes.extend([("lighting", "1"), ("daylight", "0")]);
            }
            xml.empty(element, &attributes);
        }
    }
    xml.close("objects");
}

/// Whole turns by which stations of a closed path can lie on the road.
fn around(road: &Road<'_>) -> Vec<f64> {
    if road.path.path.plan.is_closed() { vec![0.0, road.path.path.length_m()] } else { vec![0.0] }
}

/// Signs by the numbers of the Manual on Uniform Traffic Control Devices of the United States.
pub(super) fn write_signals(xml: &mut Xml, road: &Road<'_>, signs: &[Sign]) {
    let length = plan::length(&road.geometries);
    let mut found: Vec<(f64, &Sign)> = Vec::new();
    for turn in around(road) {
        for sign in signs {
            let s = sign.station_m + turn - road.range[0];
            if (-1e-6..=length + 1e-6).contains(&s) {
                found.push((s.clamp(0.0, length), sign));
            }
        }
    }
    if found.is_empty() {
        return;
    }
    xml.open("signals", &[]);
    for (k, (s, sign)) in found.into_iter().enumerate() {
        let (name, code, value) = match sign.kind {
            SignKind::Stop => ("stop", "R1-1", None),
            SignKind::StopAhead => ("stop ahead", "W3-1", None),
            SignKind::SharpLeft => ("sharp bend to the left", "W1-1L", None),
            SignKind::SharpRight => ("sharp bend to the right", "W1-1R", None),
            SignKind::Bump => ("bump", "W8-1", None),
            SignKind::Dip => ("dip", "W8-2", None),
            SignKind::SpeedLimit(kmh) => ("speed limit", "R2-1", Some(kmh.to_string())),
        };
        let id = format!("{}{k:03}", road.id);
        let (s, t) = (number(s), number(sign.to_left_m(&road.path.path.section)));
        let orientation = if sign.forward { "+" } else { "-" };
        let mut attributes = vec![
            ("s", s.as_str()),
            ("t", &t),
            ("id", &id),
            ("name", name),
            ("dynamic", "no"),
            ("orientation", orientation),
            ("zOffset", MIDDLE_M),
            ("country", "US"),
            ("type", code),
            ("subtype", "-1"),
            ("height", "0.76"),
            ("width", "0.76"),
        ];
        if let Some(value) = &value {
            attributes.extend([("value", value.as_str()), ("unit", "km/h")]);
        }
        xml.empty("signal", &attributes);
    }
    xml.close("signals");
}
