//! Reads every file of strokes that nobody here made, where the data folder lies beside the workspace.

use fairpath_io::{ReadOptions, StrokeFormat, encode_strokes, read_strokes, read_strokes_from};
use std::path::Path;

/// File and number of strokes, as the data folder's own page says.
const FILES: [(&str, usize); 8] = [
    ("quickdraw.json", 300),
    ("omniglot.json", 250),
    ("wacom.json", 175),
    ("perfect.json", 5),
    ("msink.json", 10),
    ("hwrt.json", 6),
    ("synthetic.json", 28),
    ("long.json", 12),
];

#[test]
fn every_file_of_the_corpus_is_read_and_survives_a_round_trip() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/strokes");
    if !folder.is_dir() {
        assert!(std::env::var_os("CI").is_none(), "the corpus is not at {}", folder.display());
        eprintln!("skipped: the corpus is not at {}", folder.display());
        return;
    }
    let options = ReadOptions::default();
    for (name, count) in FILES {
        let file = read_strokes(&folder.join(name), &options).unwrap();
        assert_eq!(file.strokes.len(), count, "{name}");
        assert!(file.warnings.is_empty() && file.dpi == Some(100.0), "{name}");
        assert!(file.strokes.iter().all(|s| s.times_s.is_empty() || s.times_s.len() == s.points.len()), "{name}");
        for format in [StrokeFormat::Json, StrokeFormat::Text] {
            let bytes = encode_strokes(&file, format).unwrap();
            assert_eq!(read_strokes_from(&bytes[..], name, Some(format), &options).unwrap(), file, "{name}");
        }
    }
}
