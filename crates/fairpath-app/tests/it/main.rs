//! The application, driven as hands and keys drive it.

mod documents;
mod draw;
mod given;
mod hands;
mod surface_view;
