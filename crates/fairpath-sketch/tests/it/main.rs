//! What a session promises, from the outside.

mod bad_strokes;
mod carrying;
mod common;
mod desk;
mod fairness;
mod hands;
mod jobs;
mod whole;
mod work;
