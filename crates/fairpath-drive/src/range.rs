//! Numbers that somebody gave, checked against their range.

use thiserror::Error;

/// A number is out of its range.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{field} is {value}; expected {expected}")]
pub struct OutOfRange {
    /// Which one.
    pub field: &'static str,
    /// What stands there.
    pub value: f64,
    /// What would do.
    pub expected: &'static str,
}

/// Nothing, if the number lies within its range; a NaN does not.
pub(crate) fn within(
    field: &'static str,
    value: f64,
    low: f64,
    high: f64,
    expected: &'static str,
) -> Result<(), OutOfRange> {
    if (low..=high).contains(&value) { Ok(()) } else { Err(OutOfRange { field, value, expected }) }
}
