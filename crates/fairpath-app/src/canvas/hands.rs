//! What hands do on the canvas: events of the pointer come in, deeds of the session and moves of the view go out.

use super::Work;
use super::comb::Handle;
use crate::app::Tool;
use crate::pen::{self, PenKind, PenPhase, PenSample};
use crate::view::View;
use eframe::egui::{self, Event, Key, Modifiers, PointerButton, Pos2, Response, TouchId, TouchPhase, Ui};
use fairpath_fit::{CurveEnd, Extension};
use fairpath_sketch::{CurveId, Pin, Session};
use std::collections::VecDeque;

/// A pointer within this of a curve is on it, points.
pub(crate) const GRASP: f64 = 8.0;

/// Fingers are thicker than pointers.
const FINGER: f64 = 2.0;

/// What is pressed and moved by no more than this, points, is not moved.
const STILL: f32 = 2.0;

/// Reach of a corner that is made or smoothed, points.
const CORNER_REACH: f64 = 30.0;

/// A touch that moves no more than this, points, for no longer than `TAP_SECONDS`, is a tap.
const TAP_MOVE: f32 = 12.0;
const TAP_SECONDS: f64 = 0.35;

/// What a pressed pointer does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Gesture {
    #[default]
    None,
    Draw,
    Pan,
    Move {
        last: Pos2,
        moved: bool,
    },
    Pull {
        id: CurveId,
        pin: Option<usize>,
        share: f64,
        from: Pos2,
        moved: bool,
    },
    Lengthen {
        id: CurveId,
        end: CurveEnd,
    },
    /// Makes the teeth of the comb longer or shorter.
    Scale(Handle),
    /// Moves the picture to trace over.
    Picture {
        last: Pos2,
    },
}

/// Fingers on the glass.
#[derive(Clone, Debug, Default)]
struct Fingers {
    down: Vec<(TouchId, Pos2)>,
    most: usize,
    began_s: f64,
    still: bool,
}

/// What hands are doing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hands {
    gesture: Gesture,
    fingers: Fingers,
    /// Pressure of the pen or finger that is down, where it tells.
    force: Option<f64>,
    /// What the pen did at its own rate and no stroke has taken yet; always empty where the events of the interface tell everything.
    pen: VecDeque<PenSample>,
    /// What draws the stroke in hand, where it consists of these.
    by_pen: Option<PenKind>,
}

impl Hands {
    /// Whether the pointer holds something.
    pub(crate) fn busy(&self) -> bool {
        self.gesture != Gesture::None
    }

    /// Reads the events of a frame in their order. `canvas` is the response of the canvas, which tells whether something lies over it.
    pub(crate) fn read(&mut self, ui: &Ui, canvas: &Response, work: &mut Work<'_>) {
        let (events, time, space, modifiers) =
            ui.input(|i| (i.events.clone(), i.time, i.key_down(Key::Space), i.modifiers));
        self.pen.extend(pen::drain());
        let over = canvas.contains_pointer();
        let mut moved = false;
        for event in &events {
            match *event {
                // A hand that rests beside a stylus does nothing.
                Event::Touch { .. } if self.by_stylus() => {}
                Event::Touch { id, phase, pos, force, .. } => {
                    self.force = force.map(f64::from);
                    self.touch(id, phase, pos, time, work.session);
                }
                Event::PointerButton { pos, button, pressed: true, modifiers } if over => {
                    // What is pressed may be a stylus that takes over from the hand beside it.
                    moved |= self.follow_pen(modifiers, work);
                    if !self.busy() {
                        self.press(pos, button, space, modifiers, time, work);
                    }
                }
                Event::PointerMoved(pos) => {
                    self.drag(pos, time, work);
                    moved = true;
                }
                // Which pointer went up is not told here: a pen tells it itself.
                // The keys as they were then, which on a slow screen may be long ago.
                Event::PointerButton { pos, pressed: false, modifiers, .. } if self.busy() && !self.draws_by_pen() => {
                    self.release(pos, modifiers, work);
                }
                Event::PointerGone if self.by_stylus() => {}
                Event::PointerGone | Event::WindowFocused(false) => self.cancel(work.session),
                _ => {}
            }
        }
        moved |= self.follow_pen(modifiers, work);
        if self.gesture != Gesture::Draw {
            self.pen.clear();
        }
        if self.gesture == Gesture::Pan && moved {
            work.view.pan(ui.input(|i| i.pointer.delta()));
        }
        if self.gesture == Gesture::Draw && moved {
            work.session.watch_stroke(fresh(modifiers));
        }
        self.zoom(ui, over, work);
    }

    /// Whether the stroke in hand consists of what the pen did at its own rate.
    fn draws_by_pen(&self) -> bool {
        self.gesture == Gesture::Draw && self.by_pen.is_some()
    }

    /// Whether the stroke in hand is drawn by a stylus.
    fn by_stylus(&self) -> bool {
        self.gesture == Gesture::Draw && self.by_pen == Some(PenKind::Pen)
    }

    /// Drops what is in hand.
    pub(crate) fn cancel(&mut self, session: &mut Session) {
        session.drop_stroke();
        session.end_gesture();
        self.gesture = Gesture::None;
    }

    fn press(
        &mut self,
        pos: Pos2,
        button: PointerButton,
        space: bool,
        modifiers: Modifiers,
        time: f64,
        work: &mut Work<'_>,
    ) {
        if button == PointerButton::Middle || (button == PointerButton::Primary && space) {
            self.gesture = Gesture::Pan;
            return;
        }
        if button != PointerButton::Primary {
            return;
        }
        if let Some(handle) = Handle::of_selected(work.session, work.view, work.shown)
            && f64::from(handle.place(work.shown.comb_scale).distance(pos)) <= self.grasp()
        {
            self.gesture = Gesture::Scale(handle);
            return;
        }
        let Work { session, view, tool, shown } = work;
        let place = view.drawing_at(pos);
        let grasp = self.grasp() * view.pixel_size();
        let near = session.nearest(place, grasp);
        match *tool {
            Tool::Draw => {
                session.begin_stroke(view.pixel_size(), shown.greedy);
                self.gesture = Gesture::Draw;
                self.by_pen = self.set_pen_down(session, view);
                if self.by_pen.is_none() {
                    session.extend_stroke(place, Some(time), self.force);
                }
            }
            Tool::Select => {
                if let Some((id, end)) = grasped_end(session, view, pos, self.grasp()) {
                    self.gesture = Gesture::Lengthen { id, end };
                    return;
                }
                let Some((id, _)) = near else { return session.select(None, modifiers.shift) };
                if modifiers.shift || !session.selection().contains(&id) {
                    session.select(Some(id), modifiers.shift);
                }
                if modifiers.alt {
                    session.duplicate_selected(fairpath_curve::Vec2::ZERO);
                }
                self.gesture = Gesture::Move { last: pos, moved: false };
            }
            Tool::Pull => {
                let Some((id, station)) = near else { return session.select(None, false) };
                session.select(Some(id), false);
                let Some(curve) = session.selected() else { return };
                let on = |pin: &Pin| (pin.point - place).hypot() <= grasp;
                let pin = curve.pins.iter().position(on);
                let share = pin.map_or(station / curve.spline.length(), |i| curve.pins[i].share);
                self.gesture = Gesture::Pull { id, pin, share, from: pos, moved: false };
            }
            Tool::Cut => {
                if let Some((id, station)) = near {
                    session.cut(id, station);
                }
            }
            Tool::Corner => {
                if let Some((id, station)) = near {
                    session.select(Some(id), false);
                    session.toggle_corner(id, station, CORNER_REACH * view.pixel_size());
                }
            }
            Tool::Picture => self.gesture = Gesture::Picture { last: pos },
        }
    }

    /// How near to a thing what is pressed means that thing, points.
    fn grasp(&self) -> f64 {
        // The finger that was lifted just now counts, too.
        if self.fingers.most > 0 { FINGER * GRASP } else { GRASP }
    }

    /// Begins the stroke where the pen was set down, if it is known; what it did before belongs to no stroke. Gives what draws.
    fn set_pen_down(&mut self, session: &mut Session, view: &View) -> Option<PenKind> {
        while let Some(sample) = self.pen.pop_front() {
            if sample.phase == PenPhase::Down {
                extend(session, view, sample);
                return Some(sample.kind);
            }
        }
        None
    }

    /// Lets the stroke follow the pen, and ends it where that is lifted or taken away; whether it moved.
    fn follow_pen(&mut self, modifiers: Modifiers, work: &mut Work<'_>) -> bool {
        let mut moved = false;
        while self.draws_by_pen()
            && let Some(sample) = self.pen.pop_front()
        {
            match sample.phase {
                PenPhase::Move => {
                    extend(work.session, work.view, sample);
                    moved = true;
                }
                PenPhase::Up => self.release(Pos2::new(sample.x as f32, sample.y as f32), modifiers, work),
                PenPhase::Cancel => self.cancel(work.session),
                // Never within a stroke.
                PenPhase::Down => {}
            }
        }
        moved
    }

    fn drag(&mut self, pos: Pos2, time: f64, work: &mut Work<'_>) {
        let Work { session, view, shown, .. } = work;
        match &mut self.gesture {
            Gesture::Draw if self.by_pen.is_some() => {}
            Gesture::Draw => session.extend_stroke(view.drawing_at(pos), Some(time), self.force),
            Gesture::Move { last, moved } => {
                let by = pos - *last;
                if *moved || by.length() > STILL {
                    session.move_selected(view.vector(by));
                    (*last, *moved) = (pos, true);
                }
            }
            Gesture::Pull { id, pin, share, from, moved } => {
                *moved |= pos.distance(*from) > STILL;
                if *moved {
                    *pin = session.pin(*id, *pin, Pin { share: *share, point: view.drawing_at(pos) });
                }
            }
            Gesture::Scale(handle) => {
                shown.comb_scale = handle.scale_at(pos);
                shown.comb_by_hand = true;
            }
            Gesture::Picture { last } => {
                session.move_background(view.vector(pos - *last));
                *last = pos;
            }
            Gesture::None | Gesture::Pan | Gesture::Lengthen { .. } => {}
        }
    }

    fn release(&mut self, pos: Pos2, modifiers: Modifiers, work: &mut Work<'_>) {
        let Work { session, view, .. } = work;
        match self.gesture {
            Gesture::Draw => {
                if let Some(tapped) = session.finish_stroke(fresh(modifiers)) {
                    let near = session.nearest(tapped, self.grasp() * view.pixel_size());
                    session.select(near.map(|(id, _)| id), modifiers.shift);
                }
            }
            Gesture::Lengthen { id, end } => lengthen(session, view, id, end, pos),
            // A pin that is pressed and not moved lets the curve go.
            Gesture::Pull { id, pin: Some(pin), moved: false, .. } => session.unpin(id, pin),
            _ => {}
        }
        session.end_gesture();
        self.gesture = Gesture::None;
    }

    /// Fingers: one draws, two move and turn the paper; a tap of two undoes, of three redoes.
    fn touch(&mut self, id: TouchId, phase: TouchPhase, pos: Pos2, time: f64, session: &mut Session) {
        let fingers = &mut self.fingers;
        match phase {
            TouchPhase::Start => {
                if fingers.down.is_empty() {
                    *fingers = Fingers { began_s: time, still: true, ..Fingers::default() };
                }
                fingers.down.push((id, pos));
                fingers.most = fingers.most.max(fingers.down.len());
                if fingers.down.len() > 1 {
                    // A second finger means the paper, not a stroke.
                    self.cancel(session);
                }
            }
            TouchPhase::Move => {
                let start = fingers.down.iter().find(|(finger, _)| *finger == id);
                fingers.still &= start.is_some_and(|(_, start)| start.distance(pos) <= TAP_MOVE);
            }
            TouchPhase::End | TouchPhase::Cancel => {
                fingers.down.retain(|(finger, _)| *finger != id);
                let tap = fingers.still && time - fingers.began_s <= TAP_SECONDS && phase == TouchPhase::End;
                if fingers.down.is_empty() && tap {
                    match fingers.most {
                        2 => session.undo(),
                        3 => session.redo(),
                        _ => {}
                    }
                }
            }
        }
    }

    /// The wheel and two fingers.
    fn zoom(&mut self, ui: &Ui, over: bool, work: &mut Work<'_>) {
        let Work { session, view, .. } = work;
        if self.by_stylus() {
            return;
        }
        if let Some(touch) = ui.input(|i| i.multi_touch()) {
            self.cancel(session);
            view.pan(touch.translation_delta);
            view.zoom_at(touch.center_pos, f64::from(touch.zoom_delta));
            return;
        }
        let Some(pos) = ui.input(|i| i.pointer.hover_pos()).filter(|_| over) else { return };
        let (pinch, scroll) = ui.input(|i| (i.zoom_delta(), i.smooth_scroll_delta()));
        // A wheel's notch is some 50 points: about a sixth nearer.
        let wheel = (f64::from(scroll.y) / 320.0).exp2().powf(1.4);
        let factor = f64::from(pinch) * wheel;
        if factor != 1.0 {
            view.zoom_at(pos, factor);
        }
        if scroll.x != 0.0 {
            view.pan(egui::vec2(scroll.x, 0.0));
        }
    }
}

/// Lengthens the stroke in hand to where the pen is.
fn extend(session: &mut Session, view: &View, sample: PenSample) {
    let place = view.drawing_at(Pos2::new(sample.x as f32, sample.y as f32));
    session.extend_stroke(place, Some(sample.time_s), sample.pressure.map(f64::from));
}

/// Whether a stroke shall become a curve of its own although it is drawn over another.
fn fresh(modifiers: Modifiers) -> bool {
    modifiers.alt
}

/// The end of the selected curve that the pointer is on.
fn grasped_end(session: &Session, view: &View, pos: Pos2, grasp: f64) -> Option<(CurveId, CurveEnd)> {
    let curve = session.selected().filter(|curve| !curve.spline.is_closed())?;
    let ends = [(CurveEnd::Start, curve.spline.start_pose()), (CurveEnd::End, curve.spline.end_pose())];
    let near = |pose: &fairpath_curve::Pose| f64::from(view.screen_of(pose.point).distance(pos)) <= grasp;
    ends.iter().find(|(_, pose)| near(pose)).map(|(end, _)| (curve.id, *end))
}

/// Lengthens a curve towards where the pointer let go of its end, or cuts it back to there.
fn lengthen(session: &mut Session, view: &View, id: CurveId, end: CurveEnd, pos: Pos2) {
    let Some(curve) = session.drawing().curve(id) else { return };
    let place = view.drawing_at(pos);
    let pose = match end {
        CurveEnd::Start => curve.spline.start_pose(),
        CurveEnd::End => curve.spline.end_pose(),
    };
    let by = (place - pose.point).hypot();
    if by < 2.0 * view.pixel_size() {
        return;
    }
    let nearest = curve.spline.nearest(place);
    let station = curve.spline.station(nearest.segment, nearest.s);
    let inside = station > 1e-6 * curve.spline.length() && station < (1.0 - 1e-6) * curve.spline.length();
    if inside {
        session.shorten(id, end, station);
    } else {
        session.extend(id, end, by, Extension::Curvature);
    }
}
