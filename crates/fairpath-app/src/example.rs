//! The drawing of a first start: strokes of ours, drawn by a program, not copied from anywhere.

use fairpath_io::{ReadOptions, StrokeFile, StrokeFormat, read_strokes_from};

/// The strokes of the examples that also stand in the documents.
const HELLO: &str = include_str!("../../../examples/hello.json");

/// The strokes to begin with; none if they cannot be read, which a test rules out.
pub(crate) fn strokes() -> StrokeFile {
    read_strokes_from(HELLO.as_bytes(), "hello.json", Some(StrokeFormat::Json), &ReadOptions::default())
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    #[test]
    fn there_is_something_to_begin_with() {
        assert!(super::strokes().strokes.len() > 2);
    }
}
