//! The real strokes, where the data folder lies beside the workspace.

use fairpath_curve::Point;
use fairpath_fit::Stroke;
use serde_json::Value;
use std::path::Path;

/// A file of strokes and how many it holds, as the data folder's own page says.
const FILES: [(&str, usize); 5] =
    [("quickdraw", 300), ("omniglot", 250), ("wacom", 175), ("perfect", 5), ("synthetic", 28)];

/// Every file with its strokes. Nothing where the folder is absent, which is said aloud, and an error on the machines that guard
/// the project, where the environment variable `CI` is set.
pub(crate) fn corpus() -> Option<Vec<(&'static str, Vec<Stroke>)>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/strokes");
    if !folder.is_dir() {
        assert!(std::env::var_os("CI").is_none(), "the real strokes are not at {}", folder.display());
        eprintln!("skipped: the real strokes are not at {}", folder.display());
        return None;
    }
    Some(
        FILES
            .iter()
            .map(|&(name, count)| {
                let strokes = read(&folder.join(name).with_extension("json"));
                assert_eq!(strokes.len(), count, "{name}");
                (name, strokes)
            })
            .collect(),
    )
}

fn read(path: &Path) -> Vec<Stroke> {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let file: Value = serde_json::from_str(&text).expect("the file is JSON");
    let number = |v: &Value| v.as_f64().expect("a coordinate is a number");
    let list = |v: &Value| v.as_array().expect("strokes and points are lists").clone();
    list(&file["strokes"])
        .iter()
        .map(|s| {
            let points = list(&s["points"]).iter().map(|p| Point::new(number(&p[0]), number(&p[1]))).collect();
            Stroke::new(s["name"].as_str().expect("a stroke has a name"), points)
        })
        .collect()
}
