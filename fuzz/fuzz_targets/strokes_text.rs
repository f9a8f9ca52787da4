//! Any bytes as strokes in this format.
#![no_main]

use fairpath_io::StrokeFormat;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| fairpath_fuzz::strokes(bytes, StrokeFormat::Text));
