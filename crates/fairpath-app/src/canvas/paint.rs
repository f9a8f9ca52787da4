//! What is on the canvas: a session and a view come in, strokes of paint go out. Nothing here changes anything.

use super::comb::Handle;
use super::shapes::{Shape, Shapes};
use super::still::{Sight, Still};
use crate::app::{Ink, Shown};
use crate::theme::Palette;
use crate::view::View;
use eframe::egui::{self, Color32, Painter, Stroke, StrokeKind};
use fairpath_curve::{Continuity, Kind, Point, Spline};
use fairpath_sketch::{Curve, Session};

/// Width of a curve, points.
const CURVE_WIDTH: f32 = 2.0;
/// Width of what marks a selected curve.
const SELECTED_WIDTH: f32 = 8.0;
/// Distance of the teeth of a comb, points.
const TOOTH_SPACING: f64 = 5.0;
/// Most teeth of a curve, but for those that its segments have at least.
const MOST_TEETH: f64 = 4000.0;
/// Fewest teeth of a segment.
const LEAST_TEETH: f64 = 10.0;

/// Everything that a painter needs to know.
pub(crate) struct Brush<'a> {
    pub(crate) painter: &'a Painter,
    pub(crate) view: &'a View,
    pub(crate) shown: &'a Shown,
    pub(crate) palette: &'static Palette,
}

/// What was made of the curves and is used again as long as they are the same.
#[derive(Default)]
pub(crate) struct Made {
    shapes: Shapes,
    still: Still,
}

impl Brush<'_> {
    fn path(&self, points: &[Point], stroke: Stroke) -> egui::Shape {
        egui::Shape::line(points.iter().map(|&point| self.view.screen_of(point)).collect(), stroke)
    }

    fn colour(&self, kind: Kind) -> Color32 {
        match (self.shown.ink, kind) {
            (Ink::Plain, _) => self.palette.ink,
            (Ink::Kinds, Kind::Line) => self.palette.line,
            (Ink::Kinds, Kind::Arc) => self.palette.arc,
            (Ink::Kinds, Kind::Clothoid) => self.palette.clothoid,
        }
    }

    fn pieces(&self, shape: &Shape, stroke_of: impl Fn(Kind) -> Stroke) -> impl Iterator<Item = egui::Shape> {
        shape.pieces.iter().map(move |piece| self.path(&piece.points, stroke_of(piece.kind)))
    }

    pub(crate) fn shape(&self, shape: &Shape, stroke_of: impl Fn(Kind) -> Stroke) {
        self.painter.extend(self.pieces(shape, stroke_of));
    }

    /// All curves that are seen, with what was drawn and their combs.
    fn curves(&self, sight: &Sight<'_>, shapes: &mut Shapes) -> Vec<egui::Shape> {
        let seen = self.view.seen();
        let margin = 4.0 * self.view.pixel_size();
        let mut all = Vec::new();
        shapes.keep(sight.curves);
        if self.shown.ghost {
            let ghost = Stroke::new(1.0, self.palette.ghost);
            all.extend(sight.curves.iter().map(|curve| self.path(&curve.stroke.points, ghost)));
        }
        for curve in sight.curves {
            let shape = shapes.of(curve, self.view.zoom());
            if !shape.is_within(seen, margin) {
                continue;
            }
            let selected = sight.selection.contains(&curve.id);
            // French curves lie where the mark would.
            if selected && !(self.shown.templates && curve.templates.is_some()) {
                all.extend(self.pieces(&shape, |_| Stroke::new(SELECTED_WIDTH, self.palette.selected)));
            }
            if self.shown.comb {
                all.extend(self.comb(&curve.spline));
            }
            all.extend(self.pieces(&shape, |kind| Stroke::new(CURVE_WIDTH, self.colour(kind))));
        }
        all
    }

    /// The drawing and the stroke in hand.
    pub(crate) fn session(&self, session: &Session, made: &mut Made, hovered: Option<(&Curve, f64)>) {
        let sight = Sight {
            curves: session.drawing().curves(),
            selection: session.selection(),
            view: self.view,
            shown: self.shown,
            palette: self.palette,
        };
        let Made { shapes, still } = made;
        still.paint(self.painter, &sight, || self.curves(&sight, shapes));
        if let Some(curve) = session.selected() {
            if self.shown.templates {
                self.templates(session.drawing(), curve);
            }
            self.joins(&curve.spline);
            self.pins(curve);
            if let Some(handle) = Handle::of_selected(session, self.view, self.shown) {
                let place = handle.place(self.shown.comb_scale);
                self.painter.circle(place, 4.5, self.palette.comb_hull, Stroke::new(1.5, self.palette.paper));
            }
        }
        if let Some((curve, station)) = hovered {
            let place = self.view.screen_of(curve.spline.point_at(station));
            self.painter.circle(place, 4.0, self.palette.paper, Stroke::new(1.5, self.palette.accent));
        }
        self.hand(session);
    }

    /// The stroke in hand, what it would become, and what it would replace.
    fn hand(&self, session: &Session) {
        let Some(hand) = session.hand() else { return };
        let zoom = self.view.zoom();
        if let Some(over) = hand.over()
            && let Some(curve) = session.drawing().curve(over.id)
        {
            let [from, to] = over.region.replaced;
            for part in parts(&curve.spline, from, to) {
                self.shape(&Shape::new(&part, zoom), |_| Stroke::new(SELECTED_WIDTH, self.palette.replaced));
            }
        }
        self.painter.add(self.path(hand.points(), Stroke::new(1.25, self.palette.ghost)));
        if let Some(preview) = hand.preview() {
            self.shape(&Shape::new(&preview.spline, zoom), |_| Stroke::new(CURVE_WIDTH, self.palette.preview));
        }
        for part in hand.committed() {
            self.shape(&Shape::new(part, zoom), |_| Stroke::new(CURVE_WIDTH + 2.0, self.palette.selected));
        }
        if let Some(live) = hand.live() {
            if self.shown.comb {
                self.painter.extend(self.comb(&live.spline));
            }
            self.shape(&Shape::new(&live.spline, zoom), |kind| Stroke::new(CURVE_WIDTH, self.colour(kind)));
        } else if hand.over().is_none() {
            self.painter.add(self.path(hand.points(), Stroke::new(CURVE_WIDTH, self.palette.ink)));
        }
    }

    /// The curvature of a curve as a comb.
    fn comb(&self, spline: &Spline) -> Vec<egui::Shape> {
        // However near a curve is seen, its comb has no more teeth than these.
        let spacing = (TOOTH_SPACING * self.view.pixel_size()).max(spline.length() / MOST_TEETH);
        let scale = self.shown.comb_scale;
        let thin = Stroke::new(0.75, self.palette.comb);
        let (mut hull, mut teeth) = (Vec::new(), Vec::new());
        for segment in spline.segments() {
            // In a tight bend the line through the tips is much longer than the curve.
            let spacing = spacing.min(segment.length / LEAST_TEETH);
            for tooth in segment.comb(spacing, scale) {
                let [base, tip] = [tooth.base, tooth.tip].map(|point| self.view.screen_of(point));
                teeth.push(egui::Shape::line_segment([base, tip], thin));
                hull.push(tip);
            }
        }
        teeth.push(egui::Shape::line(hull, Stroke::new(1.25, self.palette.comb_hull)));
        teeth
    }

    /// A mark at each join of a curve: a tick where it is smooth, a square at a corner, a ring at an end.
    fn joins(&self, spline: &Spline) {
        let segments = spline.segments();
        let mark = Stroke::new(1.25, self.palette.ink);
        for (i, join) in spline.joins().iter().enumerate() {
            let end = segments[i].end_pose();
            let place = self.view.screen_of(end.point);
            if *join == Continuity::G0 {
                let square = egui::Rect::from_center_size(place, egui::Vec2::splat(7.0));
                self.painter.rect(square, 0.0, self.palette.paper, mark, StrokeKind::Middle);
            } else {
                let normal = egui::Vec2::angled((end.heading + std::f64::consts::FRAC_PI_2) as f32) * 4.5;
                self.painter.line_segment([place - normal, place + normal], mark);
            }
        }
        if !spline.is_closed() {
            for end in [spline.start_pose(), spline.end_pose()] {
                let place = self.view.screen_of(end.point);
                self.painter.circle(place, 4.5, self.palette.paper, Stroke::new(1.5, self.palette.accent));
            }
        }
    }

    fn pins(&self, curve: &Curve) {
        for pin in &curve.pins {
            let place = self.view.screen_of(pin.point);
            self.painter.circle(place, 4.0, self.palette.preview, Stroke::new(1.5, self.palette.paper));
        }
    }
}

/// The part of a curve between two stations, which on a closed one may run through its start.
fn parts(spline: &Spline, from: f64, to: f64) -> Vec<Spline> {
    let length = spline.length();
    let (from, to) = (from.min(to), from.max(to));
    if !spline.is_closed() {
        return spline.subspline(from.max(0.0), to.min(length)).into_iter().collect();
    }
    let shift = (from / length).floor() * length;
    let (from, to) = (from - shift, (to - shift).min(from - shift + length));
    if to <= length {
        return spline.subspline(from, to).into_iter().collect();
    }
    [spline.subspline(from, length), spline.subspline(0.0, to - length)].into_iter().flatten().collect()
}
