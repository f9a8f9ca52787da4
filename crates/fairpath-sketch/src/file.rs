//! `fairpath-drawing 1`: a drawing as JSON, with everything that is needed to go on with it.
//!
//! It holds two documents whole that other programs read as well, `fairpath-strokes 1` and `fairpath-spline 1`, and beside them what only a drawing has.
//! Whoever wants but the curves takes the member `splines`.

use crate::background::Background;
use crate::curve::{Curve, CurveId, Pin};
use crate::drawing::Drawing;
use crate::neatening::Neatening;
use fairpath_curve::Similarity;
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

/// The curves of a file in the coordinates of the drawing to which they are to be added.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The unit of the curves: the drawing's, or if that was empty the file's.
    pub unit: Unit,
    /// Where y points, likewise.
    pub y: YAxis,
    /// The curves.
    pub curves: Vec<Curve>,
    /// What the file's reader had to say, what could not be used, such as strokes that are dots, and what was changed to suit the drawing.
    pub told: Vec<Warning>,
}

/// The curves of a file of strokes, splines or of a whole drawing, by the file's content, to be added to a drawing; `name` stands for the file in messages.
/// Strokes are to be fitted as `neatening` says; splines come as they are.
///
/// Lengths are converted to the drawing's unit; a pixel is a hundredth of an inch unless the file tells how many of its pixels make one. Where y points the
/// other way the curves are turned over, so that they look as in their own file. Both are told. A drawing that holds nothing takes over the file's unit and
/// direction of y instead, and no number changes.
///
/// # Errors
/// When the file is none of these, or faulty.
pub fn import(bytes: &[u8], name: &str, into: &Drawing, neatening: &Neatening) -> Result<Imported, DrawingError> {
    let (file, dpi) = read_curves(bytes, name, neatening)?;
    Ok(file.suited_to(into, dpi))
}

/// The curves of a file in its own coordinates, and how many of its pixels make an inch, if it says so.
fn read_curves(bytes: &[u8], name: &str, neatening: &Neatening) -> Result<(Imported, Option<f64>), DrawingError> {
    if is_drawing(bytes) {
        let drawing = decode_drawing(bytes, name)?;
        let curves = drawing.curves().iter().map(|curve| (**curve).clone()).collect();
        return Ok((Imported { unit: drawing.unit, y: drawing.y, curves, told: Vec::new() }, None));
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
        let curves = file.splines.into_iter().map(|entry| curve_of(entry, neatening, size)).collect();
        return Ok((Imported { unit: file.unit, y: file.y, curves, told }, None));
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
    Ok((Imported { unit: file.unit, y: file.y, curves, told }, file.dpi))
}

/// Length of a unit in metres; a pixel is what the file says it is, or else a hundredth of an inch.
fn metres(unit: Unit, dpi: Option<f64>) -> f64 {
    match dpi.filter(|dpi| unit == Unit::Px && dpi.is_finite() && *dpi > 0.0) {
        Some(dpi) => Unit::In.metres() / dpi,
        None => unit.metres(),
    }
}

impl Imported {
    /// The same in the coordinates of a drawing, unless that holds nothing.
    fn suited_to(self, drawing: &Drawing, dpi: Option<f64>) -> Self {
        let Self { unit, y, mut curves, mut told } = self;
        if (unit, y) == (drawing.unit, drawing.y) {
            return Self { unit, y, curves, told };
        }
        let mut tell = |code: &str, text: String| told.push(Warning { code: code.into(), text });
        if drawing.curves().is_empty() && drawing.background.is_none() {
            tell("unit-taken", format!("the drawing was empty and is now in {unit}, y {}, as the file is", y.as_str()));
            return Self { unit, y, curves, told };
        }
        let scale = if unit == drawing.unit { 1.0 } else { metres(unit, dpi) / metres(drawing.unit, None) };
        let by = Similarity { mirror: y != drawing.y, scale, ..Similarity::IDENTITY };
        if unit != drawing.unit {
            tell("converted", format!("its {unit} are converted to {}, {scale:.6} to one", drawing.unit));
        }
        if by.mirror {
            let (from, to) = (y.as_str(), drawing.y.as_str());
            tell(
                "turned-over",
                format!("its y points {from}, the drawing's {to}: y has changed its sign, so that it looks the same"),
            );
        }
        curves.iter_mut().for_each(|curve| *curve = curve.transformed(&by));
        Self { unit: drawing.unit, y: drawing.y, curves, told }
    }
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
        let Imported { curves, told, .. } =
            import(text, "two.txt", &Drawing::default(), &Neatening::default()).unwrap();
        assert_eq!(curves.len(), 1);
        assert!(told.iter().any(|warning| warning.code == "too-short"), "{told:?}");
    }

    /// A stroke of three points as text, in a unit and with a direction of y.
    fn imported(head: &str, into: &Drawing) -> Imported {
        let text = format!("{head}0 0\n30 1\n60 -20\n");
        import(text.as_bytes(), "three.txt", into, &Neatening::default()).unwrap()
    }

    #[test]
    fn an_import_is_converted_to_the_unit_of_the_drawing_and_tells_so() {
        let cases = [
            ("# unit: mm\n", 100.0 / 25.4),
            ("# unit: in\n", 100.0),
            ("# unit: pt\n", 100.0 / 72.0),
            ("# unit: m\n", 100.0 / 0.0254),
        ];
        for (head, scale) in cases {
            let Imported { unit, y, curves, told } = imported(head, &drawn());
            assert_eq!((unit, y, curves.len()), (Unit::Px, YAxis::Down, 1));
            let ends = [curves[0].stroke.points[2], curves[0].spline.end_pose().point];
            for end in ends {
                assert!((end - Point::new(60.0 * scale, -20.0 * scale)).hypot() < 1e-12 * scale * 60.0, "{head}{end}");
            }
            let own = imported(head, &Drawing::default());
            let sizes = [&curves[0], &own.curves[0]].map(|curve| curve.neatening.pixel_size);
            assert!((sizes[0] / sizes[1] - scale).abs() < 1e-12 * scale, "{head}{sizes:?}");
            assert!(told.iter().any(|warning| warning.code == "converted"), "{told:?}");
        }
        // Pixels are what the file says they are, where it does.
        let mut millimetres = drawn();
        millimetres.unit = Unit::Mm;
        for (head, size) in [("", 25.4 / 100.0), ("# dpi: 200\n", 25.4 / 200.0)] {
            let end = imported(head, &millimetres).curves[0].stroke.points[2];
            assert!((end - Point::new(60.0 * size, -20.0 * size)).hypot() < 1e-12, "{head}{end}");
        }
        // Pixels of a screen stay pixels.
        let same = imported("# dpi: 200\n", &drawn());
        assert_eq!(same.curves[0].stroke.points[2], Point::new(60.0, -20.0));
        assert!(same.told.is_empty(), "{:?}", same.told);
    }

    #[test]
    fn an_import_with_y_the_other_way_is_turned_over_and_tells_so() {
        let Imported { y, curves, told, .. } = imported("# y: up\n", &drawn());
        assert_eq!((y, curves[0].stroke.points[2]), (YAxis::Down, Point::new(60.0, 20.0)));
        assert!((curves[0].spline.end_pose().point - Point::new(60.0, 20.0)).hypot() < 1e-12);
        assert!(told.iter().any(|warning| warning.code == "turned-over"), "{told:?}");
        let mut whole = drawn();
        whole.y = YAxis::Up;
        let mirrored = import(&encode_drawing(&whole).unwrap(), "up.json", &drawn(), &Neatening::default()).unwrap();
        for (new, old) in mirrored.curves.iter().zip(whole.curves()) {
            let (a, b) = (new.spline.pose_at(20.0), old.spline.pose_at(20.0));
            assert!((a.point - Point::new(b.point.x, -b.point.y)).hypot() < 1e-12);
            assert!(b.curvature != 0.0 && (a.curvature + b.curvature).abs() < 1e-15);
            assert_eq!(new.report, old.report);
        }
    }

    #[test]
    fn an_empty_drawing_takes_over_the_unit_of_an_import_and_undo_gives_it_back() {
        let mut session = Session::default();
        let import = imported("# unit: mm\n# y: up\n", session.drawing());
        assert_eq!(import.curves[0].stroke.points[2], Point::new(60.0, -20.0));
        assert!(import.told.iter().any(|warning| warning.code == "unit-taken"), "{:?}", import.told);
        session.import(import);
        assert_eq!((session.drawing().unit, session.drawing().y), (Unit::Mm, YAxis::Up));
        session.undo();
        assert_eq!((session.drawing().unit, session.drawing().y), (Unit::Px, YAxis::Down));
        // A picture has its place and size in the drawing's own unit.
        let image = vec![0, 1];
        let picture = Background { name: "map".into(), image, at: Point::ORIGIN, width: 3.0, opacity: 0.5 };
        let mut traced = Drawing::default();
        traced.background = Some(Arc::new(picture));
        assert_eq!(imported("# unit: mm\n", &traced).unit, Unit::Px);
    }

    #[test]
    fn a_curve_without_its_spline_is_named() {
        let text = String::from_utf8(encode_drawing(&drawn()).unwrap()).unwrap();
        let error =
            decode_drawing(text.replacen("\"curve 1\"", "\"other\"", 1).as_bytes(), "x").unwrap_err().to_string();
        assert!(error.contains("curve \"other\" has no stroke"), "{error}");
    }
}
