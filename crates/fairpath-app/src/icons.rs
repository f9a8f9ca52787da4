//! The icons: glyphs of the Lucide font.

use eframe::egui::{FontData, FontDefinitions, FontFamily, FontId, RichText};
pub(crate) use lucide_icons::Icon;

/// What the family is called among the fonts.
const FAMILY: &str = "icons";

/// Adds the font of icons.
pub(crate) fn install(fonts: &mut FontDefinitions) {
    let data = FontData::from_static(lucide_icons::LUCIDE_FONT_BYTES);
    fonts.font_data.insert(FAMILY.into(), std::sync::Arc::new(data));
    fonts.families.insert(FontFamily::Name(FAMILY.into()), vec![FAMILY.into()]);
}

/// An icon of that size in points.
pub(crate) fn icon(icon: Icon, size: f32) -> RichText {
    RichText::new(char::from(icon)).font(FontId::new(size, FontFamily::Name(FAMILY.into())))
}
