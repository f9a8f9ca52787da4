//! A module for each verb.

pub(crate) mod compare;
pub(crate) mod convert;
pub(crate) mod drive;
pub(crate) mod edit;
pub(crate) mod fit;
mod fit_inputs;
mod fit_report;
mod fitting;
pub(crate) mod inflate;
mod method_options;
pub(crate) mod oversketch;
mod template_sets;
pub(crate) mod templates;

/// How a command ended, when its arguments and inputs were usable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// All done.
    Done,
    /// Some stroke failed, or `--strict` found a tolerance missed.
    SomeFailed,
}
