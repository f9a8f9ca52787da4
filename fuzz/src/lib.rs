//! What the targets have in common.

use fairpath_curve::{Point, Segment, Spline};
use fairpath_drive::{Command, Document, NoFiles};
use fairpath_fit::Stroke;
use fairpath_io::{
    RawLayout, RawSample, ReadOptions, ScriptCommand, SplineFormat, StrokeFormat, TemplateOptions, TerrainFormat,
    TerrainOptions, WriteOptions, encode_project, encode_splines, encode_strokes, encode_templates, longitude_latitude,
    read_drive_script_from, read_splines_from, read_strokes_from, read_templates_from, read_terrain_from,
};
use fairpath_sketch::{Answer, Job, run, run_encoded_job};
use std::path::Path;

/// Any bytes as splines in one format: read or refused, and what was read can be written in every format and reads back the same.
///
/// # Panics
/// When it does not.
pub fn splines(bytes: &[u8], format: SplineFormat) {
    let options = ReadOptions::default();
    let Ok(mut file) = read_splines_from(bytes, "fuzz", Some(format), &options) else { return };
    let mut writing = WriteOptions::default();
    writing.picture.size_px = 64.0;
    file.warnings.clear();
    for format in SplineFormat::ALL {
        let Ok(encoded) = encode_splines(&file, format, None, &writing) else { continue };
        match format {
            SplineFormat::Json | SplineFormat::Svg => {
                let back = read_splines_from(&encoded.bytes[..], "fuzz", Some(format), &options);
                assert_eq!(back.expect("our own file is read"), file);
            }
            SplineFormat::Csv => {
                let back = read_splines_from(&encoded.bytes[..], "fuzz", Some(format), &options);
                assert_eq!(back.expect("our own file is read").splines.len(), file.splines.len());
            }
            _ => {}
        }
    }
}

/// Any bytes as a job for the worker that shares no memory with the interface: each is answered, and with what the job itself gives. Jobs that are done,
/// but slowly, are left out.
///
/// # Panics
/// When one is not.
pub fn jobs(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let there = match serde_json::from_str::<Job>(text) {
        Ok(job) if is_slow(&job) => return,
        Ok(job) => Some(run(&job)),
        Err(_) => None,
    };
    let answer: Answer = serde_json::from_str(&run_encoded_job(text)).expect("every answer is an answer");
    match there {
        Some(there) => assert_eq!(answer, there),
        None => assert!(matches!(answer, Answer::Failed(_))),
    }
}

/// Whether a job has more points, turns or triangles than there is time for.
fn is_slow(job: &Job) -> bool {
    let winds = |spline: &Spline| spline.segments().iter().map(Segment::absolute_turning).sum::<f64>() > 100.0;
    let is_long = |stroke: &Stroke| stroke.points.len() > 200;
    match job {
        Job::Fit { stroke, .. } => is_long(stroke),
        Job::Hold { stroke, spline, .. } | Job::Oversketch { stroke, spline, .. } => is_long(stroke) || winds(spline),
        Job::Inflate { spline, options } => winds(spline) || options.triangles > 1000,
    }
}

/// Any bytes as strokes in one format: read or refused, and what was read can be written and reads back the same.
///
/// # Panics
/// When it does not.
pub fn strokes(bytes: &[u8], format: StrokeFormat) {
    let mut options = ReadOptions::default();
    options.limits.max_points = 200_000;
    options.limits.max_nodes = 20_000;
    let Ok(mut file) = read_strokes_from(bytes, "fuzz", Some(format), &options) else { return };
    let json = encode_strokes(&file, StrokeFormat::Json).expect("what was read is finite");
    let back = read_strokes_from(&json[..], "fuzz", Some(StrokeFormat::Json), &options).expect("our own JSON is read");
    file.warnings.clear();
    assert_eq!(file, back);
}

/// Any bytes as a set of French curves, its own format, splines or a drawing: read or refused, and what was read can be written and reads
/// back the same.
///
/// # Panics
/// When it does not.
pub fn templates(bytes: &[u8]) {
    let mut options = TemplateOptions::default();
    options.read.limits.max_points = 2_000;
    options.read.limits.max_nodes = 2_000;
    let Ok(file) = read_templates_from(bytes, "fuzz", &options) else { return };
    let json = encode_templates(&file.set).expect("what was read is finite");
    let back = read_templates_from(&json[..], "fuzz", &options).expect("our own JSON is read");
    // A set without a name is called like its file.
    assert_eq!(back.set, file.set);
}

/// Any bytes as a drive script: refused, or its commands are done or refused one by one, on a small terrain, and what follows does not depend on the way there.
///
/// # Panics
/// When it does.
pub fn drive_script(bytes: &[u8]) {
    let mut options = ReadOptions::default();
    options.limits.max_items = 12;
    let Ok(script) = read_drive_script_from(bytes, "fuzz", &options) else { return };
    let mut document = Document::new();
    for command in script.commands {
        let ScriptCommand::Document(mut command) = command else { continue };
        match &mut command {
            Command::Terrain(source) => source.size = Some(source.size.unwrap_or(65).min(129)),
            // A long stroke only takes long.
            Command::Sketch { points_m, .. } | Command::Oversketch { points_m, .. } => {
                points_m.truncate(30);
                points_m.retain(|p| p.iter().all(|x| x.abs() < 2e3));
            }
            _ => {}
        }
        let _ = document.run(command, &NoFiles);
    }
    if let Some(results) = document.results() {
        assert!(document.results_anew().as_ref() == Some(results.as_ref()));
        let bytes = encode_project(&document, Path::new(""), Path::new("")).expect("all numbers are finite");
        while document.undo() {}
        while document.redo() {}
        assert!(encode_project(&document, Path::new(""), Path::new("")).expect("as before") == bytes);
    }
}

/// Any bytes as a terrain: what its content tells, or, behind a first byte that says so, what could not be told. Read or refused; what was read is finite, within
/// the limits and somewhere on the globe, if it says where.
///
/// # Panics
/// When it is not.
pub fn terrain(bytes: &[u8]) {
    let mut options = TerrainOptions::default();
    options.limits.max_terrain_samples = 100_000;
    options.limits.max_bytes = 1 << 20;
    options.spacing_m = Some(10.0);
    options.height_range_m = Some([0.0, 100.0]);
    options.raw = Some(RawLayout { columns: 4, rows: 3, sample: RawSample::F32, big_endian: false });
    let (format, bytes) = match bytes {
        [b'h', rest @ ..] => (Some(TerrainFormat::Hgt), rest),
        [b'r', rest @ ..] => (Some(TerrainFormat::Raw), rest),
        _ => (None, bytes),
    };
    let Ok(file) = read_terrain_from(bytes, "N42E001", format, &options) else { return };
    let samples = file.field.samples();
    assert!(samples.len() as u64 <= options.limits.max_terrain_samples);
    assert!((0..samples.len()).all(|i| samples.get(i).is_finite()));
    if let Some(Ok(place)) = file.georeference.map(|reference| longitude_latitude(&reference, Point::ZERO)) {
        assert!(place.iter().all(|degrees| degrees.is_finite()));
    }
}
