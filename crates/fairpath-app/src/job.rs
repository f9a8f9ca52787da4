//! A stand-in for the jobs of the sketch.
use fairpath_fit::{FitOptions, fit};
use fairpath_io::{ReadOptions, SplineEntry, SplineFile, SplineFormat, StrokeFormat, WriteOptions};

/// Fits strokes given as JSON; splines as JSON.
#[must_use]
pub fn run_encoded_job(job: &str) -> String {
    assert!(!job.contains("die of this"), "this job was made to die of");
    let read = fairpath_io::read_strokes_from(job.as_bytes(), "job", Some(StrokeFormat::Json), &ReadOptions::default());
    let Ok(strokes) = read else { return "{}".into() };
    let mut file = SplineFile { unit: strokes.unit, y: strokes.y, ..SplineFile::default() };
    for stroke in &strokes.strokes {
        if let Ok(fit) = fit(stroke, &FitOptions::default()) {
            file.splines.push(SplineEntry::from_fit(&stroke.name, "shortest-path", fit, None));
        }
    }
    let encoded = fairpath_io::encode_splines(&file, SplineFormat::Json, None, &WriteOptions::default());
    encoded.map(|encoded| String::from_utf8_lossy(&encoded.bytes).into_owned()).unwrap_or_default()
}
