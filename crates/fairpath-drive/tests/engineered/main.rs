//! The engineered elevation of roads: that limits hold, that earthwork is least, and that what cannot be had is told rightly.

mod common;
mod exact;
mod infeasible;
mod limits;
mod oracle;
mod real;
