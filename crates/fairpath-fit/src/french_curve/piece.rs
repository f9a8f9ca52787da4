//! Which part of which template lies where: what tells of a curve how it was made.

use fairpath_curve::Similarity;

/// A part of a French curve laid over a part of the stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct TemplatePiece {
    /// Which template of the set.
    pub template: usize,
    /// Arc length along the template at which the part begins, in its own direction, px. A closed template may be passed more than once:
    /// then `offset + length` exceeds its length.
    pub offset: f64,
    /// Length of the part along the template, px.
    pub length: f64,
    /// Whether the part is run through against the template's own direction, from `offset + length` to `offset`. That is equation 4 of McCrae
    /// and Singh (2011), which they call a flip: curvature changes its sign and its order.
    pub backward: bool,
    /// Whether the template is turned over like a sheet: curvature changes its sign only. A physical French curve can be used so as well.
    pub turned_over: bool,
    /// Lays the template as it was drawn, px, over the stroke, in the stroke's unit and frame; a mirror image if it is turned over.
    pub transform: Similarity,
    /// Arc lengths along the resulting curve between which this part is seen, blends included, in the stroke's unit. On a closed curve it begins
    /// within the curve's length and may run on through its start.
    pub span: [f64; 2],
}
