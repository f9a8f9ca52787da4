//! `fairpath-drawing 1`: a drawing as JSON, with everything that is needed to go on with it.
//!
//! It holds two documents whole that other programs read as well, `fairpath-strokes 1` and `fairpath-spline 1`, and beside them what only a drawing has.
//! Whoever wants but the curves takes the member `splines`.

use crate::background::Background;
use crate::curve::{Curve, CurveId, Pin};
use crate::drawing::Drawing;
use crate::neatening::Neatening;
use fairpath_fit::{Stroke, TemplateSet, Warning, measure};
use fairpath_io::{
    Error as IoError, ReadOptions, SplineEntry, SplineFile, SplineFormat, SplineReport, StrokeFile, StrokeFormat, Unit,
    WriteOptions, YAxis, encode_splines, encode_strokes, read_splines_from, read_strokes_from,
};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use std::collections::BTreeMap;
use std::sync::Arc;
use thiserror::Error;

/// The word in the file's `format`.
const FORMAT: &str = "fairpath-drawing";

/// Why a file is no drawing, or a drawing cannot be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DrawingError {
    /// It is no JSON, or not such JSON.
    #[error("{file}: {problem}; expected a drawing as JSON (fairpath-drawing 1)")]
    Malformed {
        /// The file's name.
        file: String,
        /// What is wrong, and where.
        problem: String,
    },
    /// The strokes or the curves in it are faulty.
    #[error(transparent)]
    Part(#[from] IoError),
}

/// A drawing as it is written.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct DrawingRecord {
    format: String,
    version: u64,
    #[serde(default)]
    unit: Unit,
    #[serde(default)]
    y: YAxis,
    curves: Vec<CurveRecord>,
    strokes: Box<RawValue>,
    splines: Box<RawValue>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    template_sets: Vec<Arc<TemplateSet>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    background: Option<Arc<Background>>,
}

/// What only a drawing knows of a curve.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct CurveRecord {
    /// The name of its stroke and of its spline.
    name: String,
    neatening: Neatening,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pins: Vec<Pin>,
    /// Whether the spline is what the rest asks for; else it is to be fitted when the file is opened.
    fitted: bool,
}

/// The curves of a drawing as a file of splines, for every format that those are written in.
#[must_use]
pub fn splines_of(drawing: &Drawing) -> SplineFile {
    let entry = |curve: &Arc<Curve>| SplineEntry {
        name: curve.name.clone(),
        method: curve.neatening.method_name().into(),
        spline: curve.spline.clone(),
        report: Some(SplineReport { figures: curve.report.clone(), ms: None }),
        templates: curve.templates.clone(),
        warnings: curve.warnings.clone(),
    };
    let splines = drawing.curves().iter().map(entry).collect();
    SplineFile { unit: drawing.unit, y: drawing.y, splines, ..SplineFile::default() }
}

/// The strokes of a drawing as a file.
#[must_use]
pub fn strokes_of(drawing: &Drawing) -> StrokeFile {
    let named = |curve: &Arc<Curve>| Stroke { name: curve.name.clone(), ..curve.stroke.clone() };
    let strokes = drawing.curves().iter().map(named).collect();
    StrokeFile { unit: drawing.unit, y: drawing.y, strokes, ..StrokeFile::default() }
}

/// A drawing as the bytes of its file.
///
/// # Errors
/// When something in it cannot be written, such as a coordinate that is not finite.
pub fn encode_drawing(drawing: &Drawing) -> Result<Vec<u8>, DrawingError> {
    let malformed = |error: serde_json::Error| DrawingError::Malformed {
        file: "the drawing".into(),
        problem: format!("it cannot be written: {error}"),
    };
    let raw = |bytes: Vec<u8>| {
        let text = String::from_utf8_lossy(&bytes).trim_end().to_owned();
        RawValue::from_string(text).map_err(malformed)
    };
    let splines = encode_splines(&splines_of(drawing), SplineFormat::Json, None, &WriteOptions::default())?;
    let curve = |curve: &Arc<Curve>| CurveRecord {
        name: curve.name.clone(),
        neatening: curve.neatening.clone(),
        pins: curve.pins.clone(),
        fitted: curve.fitted,
    };
    let record = DrawingRecord {
        format: FORMAT.into(),
        version: 1,
        unit: drawing.unit,
        y: drawing.y,
        curves: drawing.curves().iter().map(curve).collect(),
        strokes: raw(encode_strokes(&strokes_of(drawing), StrokeFormat::Json)?)?,
        splines: raw(splines.bytes)?,
        template_sets: drawing.template_sets.clone(),
        background: drawing.background.clone(),
    };
    let mut bytes = serde_json::to_vec(&record).map_err(malformed)?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// Whether bytes begin as a drawing does, rather than as another of our formats.
#[must_use]
pub fn is_drawing(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(200)];
    String::from_utf8_lossy(head).contains(FORMAT)
}

/// The drawing of a file's bytes; `name` stands for the file in messages.
///
/// # Errors
/// When they are no such JSON, a stroke or a spline is faulty, or a curve lacks one of them.
pub fn decode_drawing(bytes: &[u8], name: &str) -> Result<Drawing, DrawingError> {
    let malformed = |problem: String| DrawingError::Malformed { file: name.into(), problem };
    let record: DrawingRecord = serde_json::from_slice(bytes).map_err(|error| malformed(error.to_string()))?;
    if record.format != FORMAT || record.version != 1 {
        return Err(malformed(format!("its format is {} {}", record.format, record.version)));
    }
    let options = ReadOptions::default();
    let part = |what: &str| format!("{name}, {what}");
    let (strokes, splines) = (record.strokes.get().as_bytes(), record.splines.get().as_bytes());
    let strokes = read_strokes_from(strokes, &part("strokes"), Some(StrokeFormat::Json), &options)?;
    let splines = read_splines_from(splines, &part("splines"), Some(SplineFormat::Json), &options)?;
    let mut strokes: BTreeMap<String, Stroke> = strokes.strokes.into_iter().map(|s| (s.name.clone(), s)).collect();
    let mut splines: BTreeMap<String, SplineEntry> = splines.splines.into_iter().map(|s| (s.name.clone(), s)).collect();
    let mut drawing = Drawing::new(record.unit, record.y);
    for CurveRecord { name: curve, neatening, pins, fitted } in record.curves {
        neatening.settings().map_err(|error| malformed(format!("curve {curve:?}: {error}")))?;
        if !pins.iter().all(|pin| pin.point.is_finite() && (0.0..=1.0).contains(&pin.share)) {
            return Err(malformed(format!("curve {curve:?}: a pin is nowhere on it")));
        }
        let stroke = strokes.remove(&curve).ok_or_else(|| malformed(format!("curve {curve:?} has no stroke")))?;
        let entry = splines.remove(&curve).ok_or_else(|| malformed(format!("curve {curve:?} has no spline")))?;
        let report = match entry.report {
            Some(report) => report.figures,
            None => measure(&entry.spline, &stroke, neatening.pixel_size),
        };
        let id = drawing.new_id();
        let SplineEntry { spline, templates, warnings, .. } = entry;
        let (name, unpinned) = (curve, None);
        drawing.put(Curve { id, name, stroke, neatening, pins, unpinned, fitted, spline, report, warnings, templates });
    }
    if let Some(background) = record.background {
        if !background.is_valid() {
            return Err(malformed(format!("the picture {:?} is nowhere or has no width", background.name)));
        }
        drawing.background = Some(background);
    }
    drawing.template_sets = record.template_sets;
    Ok(drawing)
}

/// The curves of a file of strokes, splines or of a whole drawing, to be added to a drawing, by the file's content, and what its reader had to say or could
/// not use, such as strokes that are dots. Strokes are to be fitted as `neatening` says; splines come as they are. Numbers are taken as they stand: a file's
/// unit tells the size of its pixels only.
///
/// # Errors
/// When the file is none of these, or faulty.
pub fn import(bytes: &[u8], name: &str, neatening: &Neatening) -> Result<(Vec<Curve>, Vec<Warning>), DrawingError> {
    if is_drawing(bytes) {
        let drawing = decode_drawing(bytes, name)?;
        return Ok((drawing.curves().iter().map(|curve| (**curve).clone()).collect(), Vec::new()));
    }
    let options = ReadOptions::default();
    let path = std::path::Path::new(name);
    let as_splines = read_splines_from(bytes, name, SplineFormat::from_path(path), &options);
    if let Ok(file) = as_splines
        && !file.splines.is_empty()
    {
        let size = file.unit.pixel_size();
        let mut told = file.warnings;
        told.extend(file.failures.into_iter().map(|failure| left_out(&failure.name, failure.code, &failure.text)));
        return Ok((file.splines.into_iter().map(|entry| curve_of(entry, neatening, size)).collect(), told));
    }
    let file = read_strokes_from(bytes, name, StrokeFormat::from_path(path), &options)?;
    let neatening = Neatening { pixel_size: file.unit.pixel_size(), ..neatening.clone() };
    let (mut curves, mut told) = (Vec::new(), file.warnings);
    for stroke in file.strokes {
        let name = stroke.name.clone();
        match Curve::drawn(CurveId(0), stroke, neatening.clone()) {
            Ok(curve) => curves.push(curve),
            Err(error) => told.push(left_out(&name, error.code().into(), &error.to_string())),
        }
    }
    Ok((curves, told))
}

fn left_out(name: &str, code: String, why: &str) -> Warning {
    Warning { code, text: format!("{name:?} is left out: {why}") }
}

/// Distance of the points that stand for the stroke of a spline that came without one, px.
const SPACING: f64 = 4.0;

/// The curve of a spline that came without its stroke.
fn curve_of(entry: SplineEntry, neatening: &Neatening, pixel_size: f64) -> Curve {
    let SplineEntry { name, method, spline, report, templates, warnings } = entry;
    let points = spline.samples(SPACING * pixel_size).into_iter().map(|pose| pose.point).collect();
    let stroke = Stroke::new(name.clone(), points);
    let method = crate::Method::from_name(&method).unwrap_or(neatening.method);
    let neatening = Neatening { method, pixel_size, ..neatening.clone() };
    let report = report.map_or_else(|| measure(&spline, &stroke, pixel_size), |report| report.figures);
    let (id, pins, unpinned, fitted) = (CurveId(0), Vec::new(), None, true);
    Curve { id, name, stroke, neatening, pins, unpinned, fitted, spline, report, warnings, templates }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::run;
    use crate::session::Session;
    use fairpath_curve::Point;

    fn drawn() -> Drawing {
        let mut drawing = Drawing::default();
        for (i, turns) in [0.2, 0.7].into_iter().enumerate() {
            let point = |k: u32| {
                let a = f64::from(k) * turns / 10.0;
                Point::new(100.0 * i as f64 + 60.0 * a.cos(), 60.0 * a.sin() / 3.0)
            };
            let stroke = Stroke::new(format!("curve {i}"), (0..60).map(point).collect());
            let id = drawing.new_id();
            drawing.put(Curve::drawn(id, stroke, Neatening::default()).unwrap());
        }
        let mut session = Session::new(drawing);
        while let Some((ticket, job)) = session.next_job() {
            session.take_answer(ticket, run(&job));
        }
        session.drawing().clone()
    }

    #[test]
    fn a_drawing_reads_back_as_it_was() {
        let mut drawing = drawn();
        let image = vec![0, 1, 2, 250];
        drawing.background =
            Some(Arc::new(Background { name: "map.png".into(), image, at: Point::ORIGIN, width: 3.0, opacity: 0.5 }));
        drawing.template_sets = vec![Arc::new(fairpath_io::shipped_templates("burmester").unwrap())];
        let bytes = encode_drawing(&drawing).unwrap();
        assert!(is_drawing(&bytes));
        let back = decode_drawing(&bytes, "drawing.json").unwrap();
        assert_eq!(back, drawing);
        assert_eq!(encode_drawing(&back).unwrap(), bytes);
    }

    #[test]
    fn an_empty_drawing_reads_back() {
        let bytes = encode_drawing(&Drawing::default()).unwrap();
        assert_eq!(decode_drawing(&bytes, "empty").unwrap(), Drawing::default());
    }

    #[test]
    fn a_truncated_drawing_is_refused_wherever_it_ends() {
        let bytes = encode_drawing(&drawn()).unwrap();
        for end in (0..bytes.len() - 2).step_by(97) {
            let error = decode_drawing(&bytes[..end], "half.json").unwrap_err().to_string();
            assert!(error.starts_with("half.json"), "{error}");
        }
    }

    #[test]
    fn a_stroke_that_is_left_out_of_an_import_is_told_of() {
        let text = b"0 0\n30 1\n60 0\n\n5 5\n5 5\n";
        let (curves, told) = import(text, "two.txt", &Neatening::default()).unwrap();
        assert_eq!(curves.len(), 1);
        assert!(told.iter().any(|warning| warning.code == "too-short"), "{told:?}");
    }

    #[test]
    fn a_curve_without_its_spline_is_named() {
        let text = String::from_utf8(encode_drawing(&drawn()).unwrap()).unwrap();
        let error =
            decode_drawing(text.replacen("\"curve 1\"", "\"other\"", 1).as_bytes(), "x").unwrap_err().to_string();
        assert!(error.contains("curve \"other\" has no stroke"), "{error}");
    }
}
