//! Any bytes as splines in one format: read or refused, and what was read can be written in every format and reads back the same.
#![no_main]

use fairpath_io::{ReadOptions, SplineFormat, WriteOptions, encode_splines, read_splines_from};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let options = ReadOptions::default();
    let Ok(mut file) = read_splines_from(bytes, "fuzz", Some(SplineFormat::Svg), &options) else { return };
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
});
