//! The application, driven as hands and keys drive it.

mod documents;
mod draw;
mod dropped;
mod given;
mod hands;
mod neaten;
mod pictures;
mod surface_view;
mod tools;
mod window;
