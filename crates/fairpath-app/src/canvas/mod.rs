//! The canvas: where strokes are drawn and curves are seen.

mod backdrop;
mod comb;
mod grid;
mod hands;
mod paint;
mod shapes;
mod still;
mod templates;

pub(crate) use comb::suitable as suitable_comb;
pub(crate) use hands::GRASP;

use crate::app::{Shown, Tool};
use crate::theme::Palette;
use crate::view::View;
use backdrop::Backdrop;
use eframe::egui::{self, CursorIcon, Rect, Role, Sense, Ui, WidgetInfo};
use fairpath_sketch::{CurveId, Session};
use hands::Hands;
use paint::{Brush, Made};

/// From this width on the scale has room beside the bar below, points; else it is so far up.
const BESIDE_THE_BAR: f32 = 960.0;
const ABOVE_THE_BAR: f32 = 76.0;

/// What the canvas remembers from one frame to the next.
#[derive(Default)]
pub(crate) struct Canvas {
    hands: Hands,
    made: Made,
    backdrop: Backdrop,
    /// The place of a curve under the pointer, here or in the plot: the curve and a station.
    pub(crate) hovered: Option<(CurveId, f64)>,
    /// Whoever shows the window clears it with the paper's colour already.
    pub(crate) window_is_paper: bool,
}

/// What hands on the canvas work with.
pub(crate) struct Work<'a> {
    pub(crate) session: &'a mut Session,
    pub(crate) view: &'a mut View,
    pub(crate) tool: Tool,
    pub(crate) shown: &'a mut Shown,
}

impl Canvas {
    /// How high the picture to trace over is for its width; 1 if there is none.
    pub(crate) fn picture_height_per_width(&self) -> f64 {
        self.backdrop.height_per_width()
    }

    /// Drops what is in hand.
    pub(crate) fn cancel(&mut self, session: &mut Session) {
        self.hands.cancel(session);
    }

    /// Shows the canvas in all of `ui` and does what hands do on it.
    pub(crate) fn show(&mut self, ui: &mut Ui, mut work: Work<'_>) {
        let rect = ui.max_rect();
        work.view.on(rect);
        let response = ui.interact(rect, ui.scope_id().with("canvas"), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Canvas"));
        self.hands.read(ui, &response, &mut work);
        let Work { session, view, tool, shown } = work;
        if response.contains_pointer() {
            ui.ctx().set_cursor_icon(self.cursor(ui, tool));
        }
        if let Some(pos) = response.hover_pos().filter(|_| !self.hands.busy() && response.contains_pointer()) {
            let place = view.drawing_at(pos);
            self.hovered = session.nearest(place, GRASP * view.pixel_size());
        }
        self.paint(ui, rect, session, view, shown);
    }

    fn cursor(&self, ui: &Ui, tool: Tool) -> CursorIcon {
        match tool {
            _ if ui.input(|i| i.key_down(egui::Key::Space)) => CursorIcon::Grab,
            Tool::Draw => CursorIcon::Crosshair,
            Tool::Select if self.hovered.is_some() => CursorIcon::Move,
            Tool::Pull if self.hovered.is_some() => CursorIcon::Grab,
            Tool::Cut | Tool::Corner if self.hovered.is_some() => CursorIcon::Crosshair,
            Tool::Picture => CursorIcon::Move,
            _ => CursorIcon::Default,
        }
    }

    fn paint(&mut self, ui: &Ui, rect: Rect, session: &Session, view: &View, shown: &Shown) {
        let palette = Palette::of(ui.ctx().theme());
        let painter = ui.painter_at(rect);
        let brush = Brush { painter: &painter, view, shown, palette };
        if !self.window_is_paper {
            painter.rect_filled(rect, 0.0, palette.paper);
        }
        self.backdrop.paint(ui.ctx(), &painter, view, session.drawing().background.as_ref());
        if shown.grid {
            brush.grid(ui.ctx().pixels_per_point());
        }
        let hovered = self.hovered.and_then(|(id, station)| Some((&**session.drawing().curve(id)?, station)));
        brush.session(session, &mut self.made, hovered);
        if shown.grid {
            // Beside the bar below, where there is room, else above it.
            let up = if rect.width() < BESIDE_THE_BAR { ABOVE_THE_BAR } else { 14.0 };
            brush.scale_bar(session.drawing().unit, rect.right_bottom() - egui::vec2(16.0, up));
        }
    }
}
