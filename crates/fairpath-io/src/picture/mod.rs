//! Pictures of strokes and splines: lines red, arcs green, clothoids blue, as in the paper's figures 3, 4 and 9.
//!
//! A picture is made of shapes only, lettering included, and so looks the same on a machine without fonts. Its page is measured in
//! px; the drawing is moved to the page in f64 before anything is rounded, so that far-away coordinates lose nothing.

mod board;
mod curvature_stages;
mod drawing;
mod lettering;
mod oversketch;
mod page;
mod pieces;
mod raster;
mod shaded;
mod sheet;
mod stages;

pub use board::draw_templates;
pub use curvature_stages::draw_curvature_stages;
pub(crate) use drawing::bounds;
pub use drawing::draw_splines;
pub use oversketch::{Correction, draw_corrections};
pub use page::Picture;
pub(crate) use page::{View, path_data};
pub use pieces::draw_pieces;
pub(crate) use raster::{covered, dot, normalised, to_png, turn};
pub(crate) use shaded::draw as draw_shaded;
pub use sheet::draw_comparison;
pub use stages::{StagePicture, draw_stages};

/// How strokes are laid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Layout {
    /// Everything where it is.
    #[default]
    Together,
    /// A contact sheet: each stroke in a cell of its own, scaled to fit, with its name below.
    Sheet {
        /// Cells in a row; chosen for a landscape page if absent.
        columns: Option<usize>,
    },
}

/// Whether and how high the curvature comb is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Comb {
    /// No comb.
    #[default]
    Off,
    /// So high that the sharpest bends, but for a few, reach an eighth of the drawing.
    Auto,
    /// Tooth length = this × curvature; in the file's unit squared.
    Scale(f64),
}

/// What a picture shows.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PictureOptions {
    /// Longest side of the page, px, from 64 to 16,384. A sheet of many strokes becomes larger: its cells are at least 240 px wide.
    /// Default 1600.
    pub size_px: f64,
    /// Whether the strokes are shown behind their splines. Default yes.
    pub ghost: bool,
    /// Whether joins, corners and ends are marked. Default yes.
    pub joins: bool,
    /// The curvature comb. Default off.
    pub comb: Comb,
    /// Where the strokes go. Default together.
    pub layout: Layout,
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self { size_px: 1600.0, ghost: true, joins: true, comb: Comb::Off, layout: Layout::Together }
    }
}
