//! Any bytes as strokes in one format: read or refused, and what was read can be written and reads back the same.
#![no_main]

use fairpath_io::{ReadOptions, StrokeFormat, encode_strokes, read_strokes_from};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut options = ReadOptions::default();
    options.limits.max_points = 200_000;
    options.limits.max_nodes = 20_000;
    let Ok(mut file) = read_strokes_from(bytes, "fuzz", Some(StrokeFormat::Svg), &options) else { return };
    let json = encode_strokes(&file, StrokeFormat::Json).expect("what was read is finite");
    let back = read_strokes_from(&json[..], "fuzz", Some(StrokeFormat::Json), &options).expect("our own JSON is read");
    file.warnings.clear();
    assert_eq!(file, back);
});
