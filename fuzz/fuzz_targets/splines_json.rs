//! Any bytes as splines in this format.
#![no_main]

use fairpath_io::SplineFormat;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| fairpath_fuzz::splines(bytes, SplineFormat::Json));
