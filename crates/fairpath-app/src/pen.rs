//! What a pen, a mouse or a finger does: reports of the device come in, the samples of one stroke after another go out.

/// One report of the device while it draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenSample {
    /// Across the canvas from its left edge, in points of the user interface.
    pub x: f64,
    /// Down the canvas from its top edge, in points of the user interface.
    pub y: f64,
    /// Seconds since a moment that is the same for all samples of one run of the program; never less than in the sample before.
    pub time_s: f64,
    /// From 0 to 1, of devices that measure it.
    pub pressure: Option<f32>,
    /// Which device.
    pub kind: PenKind,
    /// What it did.
    pub phase: PenPhase,
}

/// A device that draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PenKind {
    /// A stylus.
    Pen,
    /// A mouse, a trackpad, or what the browser takes for one.
    Mouse,
    /// A finger.
    Touch,
}

/// What the device did. A stroke is one [`Down`](Self::Down), moves, and one [`Up`](Self::Up) or [`Cancel`](Self::Cancel).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PenPhase {
    /// It was set down.
    Down,
    /// It moved while down.
    Move,
    /// It was lifted.
    Up,
    /// The stroke is void: it became a gesture, or the system took the device away.
    Cancel,
}

/// A report as the device gives it, before it is known whether it belongs to a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenReport {
    /// The device, or the finger: several can be down at once.
    pub pointer: i32,
    /// Whether the button that draws is down, or was until now: the left one of a mouse, the tip of a pen, a finger.
    pub draws: bool,
    /// Its values; the pressure as the system states it, measured or not.
    pub sample: PenSample,
}

#[cfg(target_arch = "wasm32")]
pub use crate::web::pen::drain;

/// All samples since the last call, where the platform thins out what the user interface hears. The desktop's windows hear everything.
#[cfg(not(target_arch = "wasm32"))]
#[must_use]
pub fn drain() -> Vec<PenSample> {
    Vec::new()
}

/// Sorts reports into strokes: one pointer draws at a time.
///
/// A pen comes before fingers, since a hand rests on the canvas beside it: while it is down fingers are ignored, and a finger's stroke is
/// void when it comes. A second finger makes a gesture of what the first one did, so its stroke is void too.
#[derive(Default)]
pub struct PenFilter {
    /// The pointer that draws.
    drawing: Option<(i32, PenSample)>,
    /// The time of the latest sample.
    latest_s: f64,
}

impl PenFilter {
    /// Takes one report and appends the samples that come of it, at most two.
    pub fn take(&mut self, report: PenReport, samples: &mut Vec<PenSample>) {
        let PenReport { pointer, draws, mut sample } = report;
        if ![sample.x, sample.y, sample.time_s].iter().all(|value| value.is_finite()) {
            return;
        }
        // Some browsers round times to protect their users, and the last moves before a press can be reported after it.
        self.latest_s = sample.time_s.max(self.latest_s);
        sample.time_s = self.latest_s;
        sample.pressure = measured(sample.kind, sample.pressure);
        let own = self.drawing.is_some_and(|(drawing, _)| drawing == pointer);
        match sample.phase {
            PenPhase::Down if !own && draws => self.set_down(pointer, sample, samples),
            PenPhase::Move if own => {
                self.drawing = Some((pointer, sample));
                samples.push(sample);
            }
            PenPhase::Up | PenPhase::Cancel if own => {
                self.drawing = None;
                samples.push(sample);
            }
            _ => {}
        }
    }

    fn set_down(&mut self, pointer: i32, sample: PenSample, samples: &mut Vec<PenSample>) {
        if let Some((_, last)) = self.drawing {
            let takes_over = sample.kind == PenKind::Pen && last.kind != PenKind::Pen;
            let gesture = sample.kind == PenKind::Touch && last.kind == PenKind::Touch;
            if !takes_over && !gesture {
                return;
            }
            self.drawing = None;
            samples.push(PenSample { phase: PenPhase::Cancel, time_s: sample.time_s, ..last });
            if gesture {
                return;
            }
        }
        self.drawing = Some((pointer, sample));
        samples.push(sample);
    }
}

/// The pressure if the device measures any: systems state one half for a mouse, and 0, one half or 1 for a finger.
fn measured(kind: PenKind, stated: Option<f32>) -> Option<f32> {
    stated.filter(|pressure| kind == PenKind::Pen && pressure.is_finite()).map(|pressure| pressure.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::PenKind::{Mouse, Pen, Touch};
    use super::PenPhase::{Cancel, Down, Move, Up};
    use super::*;

    fn report(pointer: i32, kind: PenKind, phase: PenPhase, x: f64) -> PenReport {
        let sample = PenSample { x, y: 0.0, time_s: x, pressure: Some(0.5), kind, phase };
        PenReport { pointer, draws: true, sample }
    }

    fn filtered(reports: &[PenReport]) -> Vec<PenSample> {
        let (mut filter, mut samples) = (PenFilter::default(), Vec::new());
        for report in reports {
            filter.take(*report, &mut samples);
        }
        samples
    }

    fn phases(reports: &[PenReport]) -> Vec<(PenKind, PenPhase, f64)> {
        filtered(reports).iter().map(|sample| (sample.kind, sample.phase, sample.x)).collect()
    }

    #[test]
    fn a_stroke_is_what_lies_between_down_and_up() {
        let drawn = phases(&[
            report(1, Mouse, Move, 1.0),
            report(1, Mouse, Down, 2.0),
            report(1, Mouse, Move, 3.0),
            report(1, Mouse, Up, 4.0),
            report(1, Mouse, Move, 5.0),
            report(1, Mouse, Up, 6.0),
        ]);
        assert_eq!(drawn, [(Mouse, Down, 2.0), (Mouse, Move, 3.0), (Mouse, Up, 4.0)]);
    }

    #[test]
    fn other_buttons_draw_nothing() {
        let right = PenReport { draws: false, ..report(1, Mouse, Down, 1.0) };
        assert_eq!(phases(&[right, report(1, Mouse, Move, 2.0), report(1, Mouse, Up, 3.0)]), []);
    }

    #[test]
    fn a_second_finger_voids_the_stroke_of_the_first_and_draws_none() {
        let drawn = phases(&[
            report(1, Touch, Down, 1.0),
            report(1, Touch, Move, 2.0),
            report(2, Touch, Down, 3.0),
            report(1, Touch, Move, 4.0),
            report(2, Touch, Up, 5.0),
            report(1, Touch, Up, 6.0),
            report(3, Touch, Down, 7.0),
        ]);
        let expected = [(Touch, Down, 1.0), (Touch, Move, 2.0), (Touch, Cancel, 2.0), (Touch, Down, 7.0)];
        assert_eq!(drawn, expected);
    }

    #[test]
    fn a_pen_takes_over_from_a_resting_hand_and_is_not_disturbed_by_one() {
        let drawn = phases(&[
            report(1, Touch, Down, 1.0),
            report(9, Pen, Down, 2.0),
            report(1, Touch, Move, 3.0),
            report(2, Touch, Down, 4.0),
            report(9, Pen, Move, 5.0),
            report(2, Touch, Cancel, 6.0),
            report(9, Pen, Up, 7.0),
        ]);
        let expected = [(Touch, Down, 1.0), (Touch, Cancel, 1.0), (Pen, Down, 2.0), (Pen, Move, 5.0), (Pen, Up, 7.0)];
        assert_eq!(drawn, expected);
    }

    #[test]
    fn times_never_run_backwards() {
        let mut late = report(1, Pen, Move, 1.0);
        late.sample.time_s = 0.25;
        let times: Vec<f64> = filtered(&[report(1, Pen, Down, 0.5), late, report(1, Pen, Up, 2.0)])
            .iter()
            .map(|sample| sample.time_s)
            .collect();
        assert_eq!(times, [0.5, 0.5, 2.0]);
    }

    #[test]
    fn pressure_is_told_of_pens_only_and_within_its_bounds() {
        assert_eq!(measured(Mouse, Some(0.5)), None);
        assert_eq!(measured(Touch, Some(1.0)), None);
        assert_eq!(measured(Pen, Some(1.5)), Some(1.0));
        assert_eq!(measured(Pen, Some(f32::NAN)), None);
        assert_eq!(measured(Pen, None), None);
    }

    #[test]
    fn a_place_that_is_no_number_is_no_sample() {
        for bad in [f64::NAN, f64::INFINITY] {
            let drawn = phases(&[report(1, Pen, Down, 0.5), report(1, Pen, Move, bad), report(1, Pen, Up, 2.0)]);
            assert_eq!(drawn, [(Pen, Down, 0.5), (Pen, Up, 2.0)]);
        }
    }

    #[test]
    fn a_cancelled_stroke_ends_once() {
        let drawn = phases(&[report(1, Touch, Down, 1.0), report(1, Touch, Cancel, 2.0), report(1, Touch, Up, 3.0)]);
        assert_eq!(drawn, [(Touch, Down, 1.0), (Touch, Cancel, 2.0)]);
    }
}
