//! What the clothoid kernel promises, module by module.

mod common;
mod conversion;
mod evaluation;
mod hermite;
mod intersect;
mod nearest;
mod offset;
mod parts;
