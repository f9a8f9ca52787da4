//! Readers and writers of strokes and clothoid splines.
