//! The keyboard: one table for what keys do and for the list that shows it.

use super::is_narrow;
use super::toolbar::TOGGLES;
use crate::app::{App, Tool};
use crate::files::Purpose;
use eframe::egui::{Align2, Context, Grid, Key, KeyboardShortcut, Modifiers, ScrollArea, Ui, Window};

/// What keys can do.
type Deed = fn(&mut App, &Context);

const NONE: Modifiers = Modifiers::NONE;
const COMMAND: Modifiers = Modifiers::COMMAND;
const COMMAND_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

/// Modifiers, key, what is said of it, and what it does. Of two rows with one key the one with more modifiers comes first.
const TABLE: &[(Modifiers, Key, &str, Deed)] = &[
    (COMMAND_SHIFT, Key::Z, "Redo", |app, _| app.session.redo()),
    (COMMAND, Key::Z, "Undo", |app, _| app.session.undo()),
    (COMMAND, Key::Y, "Redo", |app, _| app.session.redo()),
    (COMMAND, Key::O, "Open", |app, ctx| app.files.choose(ctx, Purpose::Open)),
    (COMMAND_SHIFT, Key::S, "Save as", |app, ctx| app.save_as(ctx)),
    (COMMAND, Key::S, "Save", |app, ctx| app.save(ctx)),
    (COMMAND_SHIFT, Key::C, "Copy as SVG", |app, ctx| app.copy_svg(ctx)),
    (COMMAND, Key::A, "Select all", |app, _| app.session.select_all()),
    (COMMAND, Key::D, "Duplicate", |app, _| {
        let by = 16.0 * app.view.pixel_size();
        app.session.duplicate_selected(fairpath_curve::Vec2::new(by, by));
    }),
    (COMMAND, Key::Num0, "Show all", |app, _| app.fit_view()),
    (NONE, Key::OpenBracket, "Select the curve before", |app, _| app.session.select_next(true)),
    (NONE, Key::CloseBracket, "Select the curve after", |app, _| app.session.select_next(false)),
    (NONE, Key::Escape, "Drop the stroke in hand", |app, _| app.canvas.cancel(&mut app.session)),
    (NONE, Key::Delete, "Delete", |app, _| app.session.delete_selected()),
    (NONE, Key::Backspace, "Delete", |app, _| app.session.delete_selected()),
    (NONE, Key::P, "Draw", |app, _| app.tool = Tool::Draw),
    (NONE, Key::V, "Select and move", |app, _| app.tool = Tool::Select),
    (NONE, Key::B, "Pull through a point", |app, _| app.tool = Tool::Pull),
    (NONE, Key::C, "Cut", |app, _| app.tool = Tool::Cut),
    (NONE, Key::K, "Corner or smooth", |app, _| app.tool = Tool::Corner),
    (NONE, Key::M, "Move and fade the picture", |app, _| app.tool = Tool::Picture),
    (NONE, Key::J, "Join two selected curves", |app, _| app.join_selected()),
    (NONE, Key::O, "Close or open", |app, _| app.toggle_closed()),
    (NONE, Key::I, "Inflate a closed curve", |app, _| app.inflate_selected()),
    (NONE, Key::Num1, "Colours", |app, _| app.toggle(&TOGGLES[0])),
    (NONE, Key::Num2, "Strokes as drawn", |app, _| app.toggle(&TOGGLES[1])),
    (NONE, Key::Num3, "Curvature comb", |app, _| app.toggle(&TOGGLES[2])),
    (NONE, Key::Num4, "Curvature plot", |app, _| app.toggle(&TOGGLES[3])),
    (NONE, Key::Num5, "Grid", |app, _| app.toggle(&TOGGLES[4])),
    (NONE, Key::Num6, "Figures", |app, _| app.toggle(&TOGGLES[5])),
    (NONE, Key::Questionmark, "Shortcuts", |app, _| app.panels.shortcuts ^= true),
];

/// What hands do besides.
const GESTURES: &[(&str, &str)] = &[
    ("Alt while drawing", "A new curve, even near another"),
    ("Wheel, pinch", "Zoom"),
    ("Space-drag, middle-drag", "Pan"),
    ("Drag an end", "Lengthen or shorten"),
    ("Alt-drag", "Duplicate"),
    ("Arrows, with Shift", "Move by a point, by ten"),
    ("Click on a pin", "Let the curve go from it"),
    ("Tap of two, three fingers", "Undo, redo"),
];

/// Does what keys ask for.
pub(crate) fn read(app: &mut App, ui: &Ui) {
    if ui.ctx().egui_wants_keyboard_input() {
        return;
    }
    for &(modifiers, key, _, deed) in TABLE {
        let shortcut = KeyboardShortcut::new(modifiers, key);
        let pressed = if key == Key::Questionmark {
            ui.input_mut(|i| i.key_pressed(key))
        } else {
            ui.input_mut(|i| i.consume_shortcut(&shortcut))
        };
        if pressed {
            deed(app, ui.ctx());
        }
    }
    if ui.memory(|memory| memory.focused().is_none()) {
        read_arrows(app, ui);
    }
}

/// Moves the selected curves by the arrows, which move the focus where anything has it.
fn read_arrows(app: &mut App, ui: &Ui) {
    const ARROWS: [(Key, [f64; 2]); 4] = [
        (Key::ArrowLeft, [-1.0, 0.0]),
        (Key::ArrowRight, [1.0, 0.0]),
        (Key::ArrowUp, [0.0, -1.0]),
        (Key::ArrowDown, [0.0, 1.0]),
    ];
    if app.session.selection().is_empty() {
        return;
    }
    for (arrow, [x, y]) in ARROWS {
        for (modifiers, points) in [(Modifiers::SHIFT, 10.0), (NONE, 1.0)] {
            let count = ui.input_mut(|i| i.count_and_consume_key(modifiers, arrow));
            let by = fairpath_curve::Vec2::new(x, y) * (points * count as f64 * app.view.pixel_size());
            if count > 0 {
                app.session.move_selected(by);
            }
        }
        if ui.input(|i| i.key_released(arrow)) {
            app.session.end_gesture();
        }
    }
}

/// Height of a row of the list, points.
const ROW: f32 = 18.0;

/// What the list leaves free of the window above and below, points.
const AROUND: f32 = 110.0;

/// Shows the list, in two columns where there is room beside each other.
pub(crate) fn show(app: &mut App, ui: &Ui) {
    let mut open = app.panels.shortcuts;
    let window = ui.ctx().content_rect().size();
    let columns = if is_narrow(ui) { 1 } else { 2 };
    Window::new("Shortcuts")
        .open(&mut open)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .resizable(false)
        .collapsible(false)
        .show(ui.ctx(), |ui| {
            ui.spacing_mut().interact_size.y = ROW;
            let rows = rows(ui);
            ScrollArea::vertical().max_height((window.y - AROUND).max(ROW)).auto_shrink([true, true]).show(ui, |ui| {
                Grid::new("shortcuts").num_columns(2 * columns).spacing([24.0, 3.0]).show(ui, |ui| {
                    let height = rows.len().div_ceil(columns);
                    for i in 0..height {
                        for (shortcut, name) in (i..rows.len()).step_by(height).map(|i| &rows[i]) {
                            ui.weak(shortcut);
                            ui.label(*name);
                        }
                        ui.end_row();
                    }
                });
            });
        });
    app.panels.shortcuts = open;
}

/// All keys and gestures with what they do; keys that do the same stand together.
fn rows(ui: &Ui) -> Vec<(String, &'static str)> {
    let mut rows: Vec<(String, &str)> = Vec::new();
    for &(modifiers, key, name, _) in TABLE {
        let shortcut = match key {
            Key::OpenBracket => "[".into(),
            Key::CloseBracket => "]".into(),
            Key::Questionmark => "?".into(),
            _ => ui.ctx().format_shortcut(&KeyboardShortcut::new(modifiers, key)),
        };
        match rows.iter_mut().find(|(_, other)| *other == name) {
            Some((shortcuts, _)) => *shortcuts = format!("{shortcuts}, {shortcut}"),
            None => rows.push((shortcut, name)),
        }
    }
    rows.extend(GESTURES.iter().map(|(gesture, name)| ((*gesture).to_owned(), *name)));
    rows
}

impl App {
    fn join_selected(&mut self) {
        let ids: Vec<_> = self.session.selection().iter().copied().collect();
        match ids[..] {
            [a, b] => self.session.join(a, b, 24.0 * self.view.pixel_size()),
            _ => self.panels.say("Select two open curves to join them."),
        }
    }

    fn toggle_closed(&mut self) {
        let Some(curve) = self.session.selected() else {
            return self.panels.say("Select a curve to close or open it.");
        };
        let (id, closed) = (curve.id, curve.spline.is_closed());
        if closed { self.session.open_curve(id) } else { self.session.close(id, 24.0 * self.view.pixel_size()) }
    }
}
