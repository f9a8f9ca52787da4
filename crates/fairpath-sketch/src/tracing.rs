//! The picture behind a drawing: put there, moved, scaled, made fainter, taken away.

use crate::background::Background;
use crate::session::Session;
use fairpath_curve::{Point, Vec2};
use std::sync::Arc;

impl Session {
    /// Puts a picture behind the drawing, or takes it away.
    pub fn set_background(&mut self, background: Option<Arc<Background>>) {
        self.history.act("Picture", |drawing| drawing.background = background);
    }

    /// Moves the picture; moves that follow each other are one step.
    pub fn move_background(&mut self, by: Vec2) {
        self.change_background("Move picture", |picture| picture.at += by);
    }

    /// Makes the picture that wide, its middle staying where it is, given how high it is for its width; changes that follow each other are one step.
    pub fn scale_background(&mut self, width: f64, height_per_width: f64) {
        self.change_background("Scale picture", |picture| {
            let grown = 0.5 * (picture.width - width);
            picture.at += Vec2::new(grown, grown * height_per_width);
            picture.width = width;
        });
    }

    /// Makes the picture fainter or stronger, from 0 to 1; changes that follow each other are one step.
    pub fn fade_background(&mut self, opacity: f64) {
        self.change_background("Fade picture", |picture| picture.opacity = opacity);
    }

    fn change_background(&mut self, deed: &str, change: impl FnOnce(&mut Background)) {
        let Some(picture) = &self.drawing().background else { return };
        let mut changed = (**picture).clone();
        change(&mut changed);
        if changed.is_valid() && changed.at.to_vec2().hypot() < FARTHEST {
            self.history.act_on(deed, |drawing| drawing.background = Some(Arc::new(changed)));
        }
    }

    /// Whether a place lies on the picture, given how high it is for its width.
    #[must_use]
    pub fn is_on_background(&self, place: Point, height_per_width: f64) -> bool {
        self.drawing().background.as_ref().is_some_and(|picture| {
            let inside = place - picture.at;
            let (width, height) = (picture.width, picture.width * height_per_width);
            (0.0..=width).contains(&inside.x) && (0.0..=height).contains(&inside.y)
        })
    }
}

/// A picture further away than this, in the drawing's unit, would be found by nobody.
const FARTHEST: f64 = 1e9;
