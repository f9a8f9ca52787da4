//! How it looks: colours, type and spacing, light and dark.

use eframe::egui::{
    Color32, Context, CornerRadius, FontDefinitions, FontFamily, FontId, Frame, Margin, Shadow, Stroke, Style,
    TextStyle, Theme, Ui, Visuals, style::WidgetVisuals, vec2,
};

use crate::icons;

/// The colours of the canvas. Those of curves are the paper's: lines red, arcs green, clothoids blue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Palette {
    pub(crate) paper: Color32,
    pub(crate) grid: Color32,
    pub(crate) grid_strong: Color32,
    pub(crate) ink: Color32,
    pub(crate) ghost: Color32,
    pub(crate) line: Color32,
    pub(crate) arc: Color32,
    pub(crate) clothoid: Color32,
    pub(crate) comb: Color32,
    pub(crate) comb_hull: Color32,
    pub(crate) replaced: Color32,
    pub(crate) preview: Color32,
    pub(crate) selected: Color32,
    pub(crate) accent: Color32,
    /// Of French curves that lie beside each other.
    pub(crate) templates: [Color32; 4],
}

const LIGHT: Palette = Palette {
    paper: Color32::from_rgb(0xfc, 0xfb, 0xf9),
    grid: Color32::from_rgb(0xef, 0xed, 0xe8),
    grid_strong: Color32::from_rgb(0xe2, 0xdf, 0xd8),
    ink: Color32::from_rgb(0x1c, 0x1e, 0x22),
    ghost: Color32::from_rgb(0xc4, 0xc1, 0xba),
    line: Color32::from_rgb(0xd1, 0x35, 0x3a),
    arc: Color32::from_rgb(0x24, 0x93, 0x4a),
    clothoid: Color32::from_rgb(0x26, 0x62, 0xd4),
    comb: Color32::from_rgb(0xb9, 0xa6, 0xdd),
    comb_hull: Color32::from_rgb(0x7b, 0x5b, 0xbf),
    replaced: Color32::from_rgb(0xf3, 0xb1, 0x3c),
    preview: Color32::from_rgb(0xdb, 0x7d, 0x11),
    selected: Color32::from_rgb(0xcf, 0xdf, 0xfb),
    accent: Color32::from_rgb(0x26, 0x62, 0xd4),
    templates: [
        Color32::from_rgb(0xc8, 0x7a, 0x1e),
        Color32::from_rgb(0x1f, 0x8f, 0x8a),
        Color32::from_rgb(0x9b, 0x4f, 0xb3),
        Color32::from_rgb(0x6b, 0x83, 0x1d),
    ],
};

const DARK: Palette = Palette {
    paper: Color32::from_rgb(0x17, 0x18, 0x1b),
    grid: Color32::from_rgb(0x20, 0x22, 0x26),
    grid_strong: Color32::from_rgb(0x2a, 0x2d, 0x32),
    ink: Color32::from_rgb(0xec, 0xec, 0xe8),
    ghost: Color32::from_rgb(0x55, 0x58, 0x5e),
    line: Color32::from_rgb(0xff, 0x6b, 0x6b),
    arc: Color32::from_rgb(0x51, 0xcf, 0x7b),
    clothoid: Color32::from_rgb(0x74, 0xa7, 0xff),
    comb: Color32::from_rgb(0x55, 0x48, 0x78),
    comb_hull: Color32::from_rgb(0xa8, 0x8d, 0xe6),
    replaced: Color32::from_rgb(0x96, 0x6a, 0x1c),
    preview: Color32::from_rgb(0xff, 0xb2, 0x4a),
    selected: Color32::from_rgb(0x22, 0x35, 0x57),
    accent: Color32::from_rgb(0x74, 0xa7, 0xff),
    templates: [
        Color32::from_rgb(0xf0, 0xa8, 0x4e),
        Color32::from_rgb(0x55, 0xc9, 0xc3),
        Color32::from_rgb(0xcf, 0x8d, 0xe6),
        Color32::from_rgb(0xb0, 0xcc, 0x5c),
    ],
};

impl Palette {
    /// The colours of a theme.
    pub(crate) fn of(theme: Theme) -> &'static Self {
        match theme {
            Theme::Light => &LIGHT,
            Theme::Dark => &DARK,
        }
    }
}

/// Sets fonts and styles of both themes.
pub(crate) fn install(ctx: &Context) {
    let mut fonts = FontDefinitions::default();
    icons::install(&mut fonts);
    ctx.set_fonts(fonts);
    // Where the system does not say, paper is white.
    ctx.options_mut(|options| options.fallback_theme = Theme::Light);
    for theme in [Theme::Light, Theme::Dark] {
        ctx.set_style_of(theme, style(theme));
    }
}

/// The least size of what is pressed by a finger, points.
const FINGER: f32 = 40.0;

/// Makes what can be pressed as large as fingers need it, once the screen was touched.
pub(crate) fn suit_fingers(ui: &Ui) {
    if ui.spacing().interact_size.y < FINGER && ui.input(|i| i.has_touch_screen()) {
        ui.ctx().all_styles_mut(|style| {
            style.spacing.interact_size = vec2(FINGER, FINGER);
            style.spacing.slider_rail_height *= 1.5;
        });
    }
}

fn style(theme: Theme) -> Style {
    let palette = Palette::of(theme);
    let mut style = Style::default();
    let proportional = |size| FontId::new(size, FontFamily::Proportional);
    style.text_styles = [
        (TextStyle::Small, proportional(11.0)),
        (TextStyle::Body, proportional(13.0)),
        (TextStyle::Button, proportional(13.0)),
        (TextStyle::Heading, proportional(15.0)),
        (TextStyle::Monospace, FontId::new(12.0, FontFamily::Monospace)),
    ]
    .into();
    style.spacing.item_spacing = vec2(6.0, 6.0);
    style.spacing.button_padding = vec2(8.0, 4.0);
    style.spacing.interact_size = vec2(28.0, 26.0);
    style.spacing.slider_width = 150.0;
    style.visuals = visuals(theme, palette);
    style
}

fn visuals(theme: Theme, palette: &Palette) -> Visuals {
    let dark = theme == Theme::Dark;
    let mut visuals = if dark { Visuals::dark() } else { Visuals::light() };
    let (panel, raised, edge, text, quiet) = if dark {
        (gray(0x20), gray(0x2b), gray(0x38), gray(0xe4), gray(0xa0))
    } else {
        (gray(0xff), gray(0xf1), gray(0xdd), gray(0x22), gray(0x68))
    };
    visuals.panel_fill = panel;
    visuals.window_fill = panel;
    visuals.window_stroke = Stroke::new(1.0, edge);
    visuals.extreme_bg_color = if dark { gray(0x17) } else { gray(0xf7) };
    visuals.faint_bg_color = raised;
    visuals.override_text_color = None;
    visuals.weak_text_color = Some(quiet);
    visuals.selection.bg_fill = palette.selected;
    visuals.selection.stroke = Stroke::new(1.0, palette.accent);
    visuals.hyperlink_color = palette.accent;
    visuals.window_corner_radius = CornerRadius::same(10);
    visuals.menu_corner_radius = CornerRadius::same(8);
    let shadow =
        Shadow { offset: [0, 3], blur: 14, spread: 0, color: Color32::from_black_alpha(if dark { 96 } else { 28 }) };
    visuals.window_shadow = shadow;
    visuals.popup_shadow = shadow;
    visuals.slider_trailing_fill = true;
    let widget = |fill: Color32, ink: Color32, stroke: Color32| WidgetVisuals {
        bg_fill: fill,
        weak_bg_fill: fill,
        bg_stroke: Stroke::new(1.0, stroke),
        corner_radius: CornerRadius::same(6),
        fg_stroke: Stroke::new(1.0, ink),
        expansion: 0.0,
    };
    visuals.widgets.noninteractive = widget(panel, text, edge);
    visuals.widgets.inactive = widget(raised, text, Color32::TRANSPARENT);
    visuals.widgets.hovered = widget(if dark { gray(0x36) } else { gray(0xe7) }, text, Color32::TRANSPARENT);
    visuals.widgets.active = widget(if dark { gray(0x40) } else { gray(0xdc) }, text, Color32::TRANSPARENT);
    visuals.widgets.open = visuals.widgets.hovered;
    visuals
}

fn gray(level: u8) -> Color32 {
    Color32::from_gray(level)
}

/// The frame of what floats over the canvas.
pub(crate) fn floating(style: &Style) -> Frame {
    Frame::new()
        .fill(style.visuals.window_fill)
        .stroke(style.visuals.window_stroke)
        .corner_radius(10)
        .shadow(Shadow { blur: 10, offset: [0, 2], ..style.visuals.window_shadow })
        .inner_margin(Margin::same(6))
}
