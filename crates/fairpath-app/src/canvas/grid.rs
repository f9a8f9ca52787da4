//! The grid behind the drawing, and the bar that tells its scale.

use super::paint::Brush;
use eframe::egui::{Align2, FontId, Pos2, Stroke, pos2, vec2};
use fairpath_curve::Point;
use fairpath_io::Unit;

/// Least distance of lines on the screen, points.
const DENSEST: f64 = 22.0;

/// The step of a grid at least `least` wide: 1, 2 or 5 times a power of ten, and after how many steps a line is stronger.
fn step(least: f64) -> (f64, i64) {
    let power = 10.0_f64.powf(least.log10().floor());
    match least / power {
        x if x <= 1.0 => (power, 10),
        x if x <= 2.0 => (2.0 * power, 5),
        x if x <= 5.0 => (5.0 * power, 2),
        _ => (10.0 * power, 10),
    }
}

impl Brush<'_> {
    /// The lines of the grid.
    pub(crate) fn grid(&self, pixels_per_point: f32) {
        let (step, strong) = step(DENSEST * self.view.pixel_size());
        let [min, max] = self.view.seen();
        let canvas = self.view.canvas();
        let thin = 1.0 / pixels_per_point;
        let snap = |x: f32| ((x * pixels_per_point).floor() + 0.5) / pixels_per_point;
        let stroke = |i: i64| {
            let colour = if i % strong == 0 { self.palette.grid_strong } else { self.palette.grid };
            Stroke::new(thin, colour)
        };
        let indices = |low: f64, high: f64| (low / step).floor() as i64..=(high / step).ceil() as i64;
        for i in indices(min.x, max.x) {
            let x = snap(self.view.screen_of(Point::new(i as f64 * step, 0.0)).x);
            self.painter.line_segment([pos2(x, canvas.top()), pos2(x, canvas.bottom())], stroke(i));
        }
        for i in indices(min.y, max.y) {
            let y = snap(self.view.screen_of(Point::new(0.0, i as f64 * step)).y);
            self.painter.line_segment([pos2(canvas.left(), y), pos2(canvas.right(), y)], stroke(i));
        }
    }

    /// A bar of a round length at `right_bottom`.
    pub(crate) fn scale_bar(&self, unit: Unit, right_bottom: Pos2) {
        let (length, _) = step(48.0 * self.view.pixel_size());
        let width = (length * self.view.zoom()) as f32;
        let stroke = Stroke::new(1.0, self.palette.ghost);
        let left = right_bottom - vec2(width, 0.0);
        self.painter.line_segment([left, right_bottom], stroke);
        for end in [left, right_bottom] {
            self.painter.line_segment([end - vec2(0.0, 4.0), end], stroke);
        }
        let text = format!("{length} {unit}");
        let middle = left + vec2(0.5 * width, -4.0);
        self.painter.text(middle, Align2::CENTER_BOTTOM, text, FontId::proportional(11.0), self.palette.ghost);
    }
}

#[cfg(test)]
mod tests {
    use super::step;

    #[test]
    fn steps_are_round_and_wide_enough() {
        for least in [1e-4, 0.003, 0.9999, 1.0, 1.0001, 3.7, 49.0, 51.0, 12345.0] {
            let (step, _) = step(least);
            assert!(step >= least * (1.0 - 1e-9) && step <= 2.5 * least + 1e-12, "{least} {step}");
        }
    }
}
