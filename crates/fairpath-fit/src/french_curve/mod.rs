//! Neatening strokes with pieces of French curves (McCrae and Singh 2011): stroke and templates in, spline and where its pieces come from out.

mod piece;
mod template;

pub use piece::TemplatePiece;
pub use template::{Template, TemplateError, TemplateSet};
