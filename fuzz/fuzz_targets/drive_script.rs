//! Any bytes as a drive script.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| fairpath_fuzz::drive_script(bytes));
