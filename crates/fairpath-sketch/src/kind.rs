//! What a file is for a drawing: its first bytes come in, the word goes out. Whether it is sound its reader says.

/// What a file is for a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A drawing, to go on with (`fairpath-drawing`).
    Drawing,
    /// A set of French curves (`fairpath-templates`).
    Templates,
    /// Edits, to be made on curves that are there (`fairpath-edits`).
    Edits,
    /// Anything else: strokes or curves, if it can be read at all.
    Curves,
}

/// The word of a format stands within so many bytes of the file's beginning.
const HEAD: usize = 200;

impl FileKind {
    /// The kind of a file that begins like this.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)]);
        // Other formats may speak of ours; these are JSON.
        if !head.trim_start_matches('\u{feff}').trim_start().starts_with('{') {
            return Self::Curves;
        }
        // A drawing holds the others, so its word stands first.
        let words = [
            ("\"fairpath-drawing\"", Self::Drawing),
            ("\"fairpath-templates\"", Self::Templates),
            ("\"fairpath-edits\"", Self::Edits),
        ];
        let found = words.into_iter().filter_map(|(word, kind)| Some((head.find(word)?, kind)));
        found.min_by_key(|(at, _)| *at).map_or(Self::Curves, |(_, kind)| kind)
    }
}

#[cfg(test)]
mod tests {
    use super::FileKind;

    #[test]
    fn the_first_word_of_a_format_counts() {
        for (text, kind) in [
            ("\u{feff} {\"format\": \"fairpath-edits\", \"version\": 1}", FileKind::Edits),
            ("{\"format\":\"fairpath-templates\",\"name\":\"fairpath-drawing\"", FileKind::Templates),
            (
                "{\"format\":\"fairpath-drawing\",\"template_sets\":[{\"format\":\"fairpath-templates\"",
                FileKind::Drawing,
            ),
            ("{\"format\":\"fairpath-strokes\"", FileKind::Curves),
            ("<svg><title>{\"fairpath-edits\"}</title></svg>", FileKind::Curves),
            ("", FileKind::Curves),
        ] {
            assert_eq!(FileKind::of(text.as_bytes()), kind, "{text}");
        }
    }
}
