//! The curvature along the selected curve, under the canvas; the place under the pointer is the same in both.

use crate::app::App;
use crate::theme::Palette;
use eframe::egui::{Panel, Ui, Vec2, vec2};
use egui_plot::{HLine, Line, Plot, PlotPoints, VLine};
use fairpath_curve::Spline;

/// Beside and above the curve in the plot, as shares of its width and height.
const AIR: Vec2 = vec2(0.02, 0.12);

/// Curvatures that differ by less than this share of one of them are the same, rounded.
const SAME: f64 = 1e-6;

/// Where a segment's straight line in the plot has points. Two would do, but where a painted line turns sharply, as at a peak of curvature, its width is
/// wrong as far as the next point.
const PLACES: [f64; 5] = [0.0, 0.02, 0.5, 0.98, 1.0];

/// The curvature along a curve as lines: one along each run on which it is continuous, and an upright one at each jump.
fn profile(spline: &Spline) -> Vec<Vec<[f64; 2]>> {
    let mut station = 0.0;
    let mut lines: Vec<Vec<[f64; 2]>> = Vec::new();
    for segment in spline.segments() {
        let points = PLACES.map(|u| {
            let kappa = segment.kappa0 + u * (segment.kappa1 - segment.kappa0);
            [station + u * segment.length, kappa]
        });
        let end = lines.last().and_then(|run| run.last()).copied();
        match (lines.last_mut(), end) {
            (Some(run), Some([_, before])) if (before - segment.kappa0).abs() <= SAME * before.abs() => {
                run.extend(points)
            }
            (_, Some(end)) => lines.extend([vec![end, points[0]], points.to_vec()]),
            _ => lines.push(points.to_vec()),
        }
        station += segment.length;
    }
    lines
}

/// Shows the plot if it is asked for.
pub(crate) fn show(app: &mut App, ui: &mut Ui) {
    if !app.shown.plot {
        return;
    }
    let palette = Palette::of(ui.ctx().theme());
    Panel::bottom("plot").resizable(true).default_size(150.0).min_size(90.0).show(ui, |ui| {
        let Some(curve) = app.session.selected().or_else(|| app.session.drawing().curves().last()).cloned() else {
            ui.centered_and_justified(|ui| ui.weak("Select a curve to see its curvature."));
            return;
        };
        let marked = app.canvas.hovered.filter(|(id, _)| *id == curve.id).map(|(_, station)| station);
        let length = curve.spline.length();
        let plot = Plot::new(("curvature", curve.id.0))
            .allow_scroll(false)
            .allow_drag(false)
            .allow_boxed_zoom(false)
            .set_margin_fraction(AIR)
            .show_background(false)
            .grid_color(palette.grid_strong)
            .include_x(0.0)
            .include_x(length)
            .x_axis_label("arc length")
            .y_axis_label("curvature");
        let shown = plot.show(ui, |plot| {
            plot.hline(HLine::new("zero", 0.0).color(palette.grid_strong));
            for line in profile(&curve.spline) {
                let line = Line::new(curve.name.as_str(), PlotPoints::from(line));
                plot.line(line.color(palette.comb_hull).width(1.75));
            }
            if let Some(station) = marked {
                plot.vline(VLine::new("here", station).color(palette.accent));
            }
            plot.pointer_coordinate()
        });
        if shown.response.hovered()
            && let Some(at) = shown.inner
        {
            app.canvas.hovered = Some((curve.id, at.x.clamp(0.0, length)));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use fairpath_curve::{Continuity, Point, Segment};

    #[test]
    fn curvature_that_jumps_is_an_upright_line_between_two_runs() {
        let line = Segment::line(Point::ORIGIN, 0.0, 10.0);
        let arc = Segment::arc(line.end(), 0.0, 5.0, 0.1);
        let spline = Spline::new(vec![line, arc], vec![Continuity::G1], false).unwrap();
        let lines = profile(&spline);
        assert_eq!(lines.len(), 3);
        assert_eq!(lines[1], [[10.0, 0.0], [10.0, 0.1]]);
        assert_eq!(lines[2].last(), Some(&[15.0, 0.1]));
    }
}
