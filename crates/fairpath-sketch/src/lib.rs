//! A drawing of fair curves, without a window: what a sketching application holds and does, as plain values and functions.
//!
//! | to … | use |
//! | --- | --- |
//! | choose a method and its options by name | [`Method`], [`Settings`], [`Neatening`] |
//! | show a form of all that can be set, and set it | [`Parameter`], [`Kind`], [`with_parameter`], [`parameters_of`] |
//! | hold curves with the strokes that they come from | [`Drawing`], [`Curve`] |
//! | undo and redo | [`History`] |
//! | open and save, import, export | [`decode_drawing`], [`encode_drawing`], [`import`], [`splines_of`], [`strokes_of`] |
//! | tell what a file is for a drawing | [`FileKind`] |
//! | make a list of edits on the curves of a file | [`edited`] |
//! | work on a drawing: draw, draw over, select, edit | [`Session`] |
//! | fit away from the interface | [`Job`], [`Answer`], [`run`], and as text [`run_encoded_job`] |
//! | decide what to fit next | [`Desk`] |
//!
//! Nothing here knows of pixels on a screen, reads a clock or starts a thread.

mod answers;
mod background;
mod boxes;
mod carry;
mod corrections;
mod curve;
mod desk;
mod drawing;
mod edit_list;
mod edits;
mod fairness;
mod file;
mod follow;
mod hand;
mod history;
mod job;
mod kind;
mod method;
mod neatening;
mod parameters;
mod session;
mod tracing;
mod units;

pub use background::Background;
pub use carry::carried;
pub use curve::{Curve, CurveId, Pin};
pub use desk::{Desk, Slot, Ticket, Wish};
pub use drawing::Drawing;
pub use edit_list::{EditFault, EditListError, Edited, edited};
pub use file::{DrawingError, Imported, decode_drawing, encode_drawing, import, is_drawing, splines_of, strokes_of};
pub use hand::{Hand, Over};
pub use history::History;
pub use job::{Answer, Fitted, Job, Trouble, run, run_encoded_job};
pub use kind::FileKind;
pub use method::{Method, Settings};
pub use neatening::Neatening;
pub use parameters::{Kind, Parameter, SettingError, parameters_of, read_value, show_value, with_parameter};
pub use session::Session;
