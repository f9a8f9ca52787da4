//! The picture behind the drawing, ready to be painted.

use crate::view::View;
use eframe::egui::{Color32, ColorImage, Context, Painter, Pos2, Rect, TextureHandle, TextureOptions, pos2};
use fairpath_curve::Vec2;
use fairpath_sketch::Background;
use std::sync::Arc;

/// Sides of a picture longer than this are halved until they are not, pixels: what every graphics device takes.
const LARGEST: u32 = 4096;

/// The picture of the drawing on the graphics device.
#[derive(Default)]
pub(crate) struct Backdrop {
    shown: Option<(Arc<Background>, Option<TextureHandle>)>,
}

impl Backdrop {
    /// How high the picture is for its width; 1 if there is none that can be shown.
    pub(crate) fn height_per_width(&self) -> f64 {
        let texture = self.shown.as_ref().and_then(|(_, texture)| texture.as_ref());
        texture.map_or(1.0, |texture| texture.size()[1] as f64 / texture.size()[0] as f64)
    }

    /// Paints the picture.
    pub(crate) fn paint(
        &mut self,
        ctx: &Context,
        painter: &Painter,
        view: &View,
        background: Option<&Arc<Background>>,
    ) {
        let Some(background) = background else {
            self.shown = None;
            return;
        };
        let known = self.shown.as_ref().is_some_and(|(shown, _)| shown.image == background.image);
        if !known {
            let texture =
                decoded(&background.image).map(|image| ctx.load_texture("picture", image, TextureOptions::LINEAR));
            self.shown = Some((Arc::clone(background), texture));
        }
        let Some((_, Some(texture))) = &self.shown else { return };
        let size = Vec2::new(background.width, background.width * self.height_per_width());
        let rect = Rect::from_two_pos(view.screen_of(background.at), view.screen_of(background.at + size));
        let all = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
        painter.image(texture.id(), rect, all, Color32::WHITE.gamma_multiply(background.opacity as f32));
    }
}

/// The pixels of a picture; `None` if it is none after all, which was said when it was chosen.
fn decoded(bytes: &[u8]) -> Option<ColorImage> {
    let mut image = image::load_from_memory(bytes).ok()?;
    while image.width().max(image.height()) > LARGEST {
        image = image.thumbnail(image.width() / 2, image.height() / 2);
    }
    let image = image.into_rgba8();
    let size = [image.width() as usize, image.height() as usize];
    Some(ColorImage::from_rgba_unmultiplied(size, &image))
}
