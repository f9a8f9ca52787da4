//! The stroke in hand: points come in as they are drawn, what they would become is shown meanwhile, a curve or a change of one goes out.
//!
//! There is no mode for drawing over a curve: a stroke that begins and ends at a curve, or leaves one of its ends along it, changes that curve (Baran,
//! Lehtinen and Popović 2010, section 3.7; the thesis on Drive, section 3.4.2, for ends), unless the person asks for a new one.

use crate::curve::{Curve, CurveId};
use crate::desk::{Slot, Wish};
use crate::job::{Fitted, Job, Trouble};
use crate::neatening::Neatening;
use crate::session::Session;
use fairpath_curve::{Point, Spline, trig};
use fairpath_fit::{
    FitOptions, FrenchCurveOptions, FrenchCurveStream, OversketchOptions, OversketchRegion, Stroke, TemplateSet,
    oversketch_region,
};
use std::fmt;
use std::sync::Arc;

/// A stroke that never was further than this from its start is a tap, px.
const TAP: f64 = 3.0;

/// A stroke that leaves one end of a curve, or meets it, at no more than this angle goes on with that curve, radians.
const ALONG: f64 = 0.7;

/// Length of the stroke by which that is judged, px.
const ALONG_LENGTH: f64 = 12.0;

/// A stroke in hand.
pub struct Hand {
    stroke: Stroke,
    pixel_size: f64,
    /// How far it ever was from its start.
    extent: f64,
    over: Option<Over>,
    live: Option<Fitted>,
    preview: Option<Fitted>,
    stream: Option<FrenchCurveStream>,
    committed: Vec<Spline>,
}

/// A curve that a stroke is drawn over, and what it would replace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Over {
    /// The curve.
    pub id: CurveId,
    /// What would be replaced.
    pub region: OversketchRegion,
}

impl fmt::Debug for Hand {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { stroke, over, .. } = self;
        f.debug_struct("Hand").field("points", &stroke.points.len()).field("over", over).finish_non_exhaustive()
    }
}

impl Hand {
    /// The points so far.
    #[must_use]
    pub fn points(&self) -> &[Point] {
        &self.stroke.points
    }

    /// The curve that it is drawn over.
    #[must_use]
    pub fn over(&self) -> Option<Over> {
        self.over
    }

    /// The curve that it would become, as of some points ago.
    #[must_use]
    pub fn live(&self) -> Option<&Fitted> {
        self.live.as_ref().filter(|_| self.over.is_none())
    }

    /// What the curve that it is drawn over would become, as of some points ago.
    #[must_use]
    pub fn preview(&self) -> Option<&Fitted> {
        self.preview.as_ref().filter(|_| self.over.is_some())
    }

    /// Parts of French curves that are certain already.
    #[must_use]
    pub fn committed(&self) -> &[Spline] {
        &self.committed
    }

    pub(crate) fn take(&mut self, slot: Slot, fitted: Fitted) {
        match slot {
            Slot::Preview => self.preview = Some(fitted),
            _ => self.live = Some(fitted),
        }
    }

    fn is_tap(&self) -> bool {
        self.extent <= TAP * self.pixel_size
    }
}

impl Session {
    /// Sets the pen down. `pixel_size` is the size of a pixel of the screen in the drawing's unit. With `greedy`, parts of French curves are laid while
    /// the stroke is drawn (McCrae and Singh 2011, section 4).
    pub fn begin_stroke(&mut self, pixel_size: f64, greedy: bool) {
        self.drop_stroke();
        let name = self.drawing().free_name("curve");
        let wish = Neatening { pixel_size, ..self.neatening().clone() };
        let stream = if greedy { self.french_stream(&wish) } else { None };
        let stroke = Stroke::new(name, Vec::new());
        let (over, live, preview, committed) = (None, None, None, Vec::new());
        self.hand = Some(Hand { stroke, pixel_size, extent: 0.0, over, live, preview, stream, committed });
    }

    fn french_stream(&self, wish: &Neatening) -> Option<FrenchCurveStream> {
        let set: Arc<TemplateSet> = self.drawing().template_set(&wish.templates)?;
        let mut options = FrenchCurveOptions::default();
        options.stroke.pixel_size = wish.pixel_size;
        FrenchCurveStream::new(&set, &options).ok()
    }

    /// Moves the pen. Times are seconds of any clock; pressure lies in [0, 1].
    pub fn extend_stroke(&mut self, point: Point, time_s: Option<f64>, pressure: Option<f64>) {
        let Some(hand) = &mut self.hand else { return };
        let stroke = &mut hand.stroke;
        if !point.is_finite() || stroke.points.last() == Some(&point) {
            return;
        }
        // Either all points have a time or none has.
        let before = stroke.points.len();
        for (list, value) in [(&mut stroke.times_s, time_s), (&mut stroke.pressures, pressure)] {
            match value {
                Some(value) if list.len() == before => list.push(value),
                _ => list.clear(),
            }
        }
        stroke.points.push(point);
        hand.extent = hand.extent.max((point - stroke.points[0]).hypot());
        if let Some(stream) = &mut hand.stream {
            hand.committed.extend(stream.push(point).into_iter().map(|committed| committed.spline));
        }
    }

    /// Asks for what the stroke would become: to be called once for each picture that is shown. With `fresh` it becomes a curve of its own, wherever it is
    /// drawn.
    pub fn watch_stroke(&mut self, fresh: bool) {
        let Some(hand) = &self.hand else { return };
        if hand.is_tap() {
            return;
        }
        let over = if fresh { None } else { self.over(hand) };
        let (stroke, pixel_size) = (hand.stroke.clone(), hand.pixel_size);
        let (wish, other, job) = match over {
            Some(Over { id, .. }) => {
                let Some(curve) = self.drawing().curve(id) else { return };
                let options = Box::new(oversketch_options(curve, pixel_size));
                let job = Job::Oversketch { spline: curve.spline.clone(), stroke, options };
                (Wish::new(Slot::Preview, Some(curve)), Slot::Live, job)
            }
            None => (Wish::new(Slot::Live, None), Slot::Preview, self.fit_job(stroke, pixel_size)),
        };
        self.desk.drop_wishes(other);
        self.desk.want_also(wish, job);
        if let Some(hand) = &mut self.hand {
            if hand.over.map(|over| over.id) != over.map(|over| over.id) {
                hand.preview = None;
            }
            hand.over = over;
        }
    }

    fn fit_job(&self, stroke: Stroke, pixel_size: f64) -> Job {
        let neatening = Neatening { pixel_size, ..self.neatening().clone() };
        let templates = self.drawing().templates_for(&neatening);
        Job::Fit { stroke, neatening, templates, pins: Vec::new() }
    }

    /// The curve that a stroke is drawn over, if it is: both ends lie on it, or one end does and runs along it there.
    fn over(&self, hand: &Hand) -> Option<Over> {
        let points = &hand.stroke.points;
        let reach = OversketchOptions::default().reach * hand.pixel_size;
        let ends = [*points.first()?, *points.last()?];
        let near = ends.map(|end| self.nearest(end, reach).map(|(id, _)| id));
        // A stroke may begin at one curve, as that of a T does, and end along another.
        near.into_iter().flatten().find_map(|id| self.over_curve(hand, id))
    }

    /// What a stroke means for one curve.
    fn over_curve(&self, hand: &Hand, id: CurveId) -> Option<Over> {
        let points = &hand.stroke.points;
        let curve = self.drawing().curve(id)?;
        let options = oversketch_options(curve, hand.pixel_size);
        let region = oversketch_region(&curve.spline, &hand.stroke, &options).ok()?;
        // The region tells it in the curve's direction.
        let [start, end] = region.attached;
        let attached = if region.backward { [end, start] } else { [start, end] };
        let follows = match attached {
            [true, true] => true,
            [true, false] => runs_along(&curve.spline, points.iter().copied(), hand.pixel_size),
            [false, true] => runs_along(&curve.spline, points.iter().rev().copied(), hand.pixel_size),
            [false, false] => false,
        };
        follows.then_some(Over { id, region })
    }

    /// Lifts the pen: the stroke becomes a curve, or changes the one that it was drawn over. A tap does nothing and gives back where it was.
    pub fn finish_stroke(&mut self, fresh: bool) -> Option<Point> {
        let hand = self.hand.take()?;
        self.desk.drop_wishes(Slot::Live);
        self.desk.drop_wishes(Slot::Preview);
        if hand.is_tap() {
            return hand.stroke.points.first().copied();
        }
        match if fresh { None } else { self.over(&hand) } {
            Some(Over { id, .. }) => {
                if let Some(options) = self.drawing().curve(id).map(|curve| oversketch_options(curve, hand.pixel_size))
                {
                    self.correct(id, hand.stroke, options);
                }
            }
            None => self.draw(hand),
        }
        None
    }

    /// A new curve.
    fn draw(&mut self, hand: Hand) {
        let neatening = Neatening { pixel_size: hand.pixel_size, ..self.neatening().clone() };
        let drawn = self.history.act("Draw", |drawing| {
            let id = drawing.new_id();
            let curve = Curve::drawn(id, hand.stroke, neatening)?;
            drawing.put(curve);
            Ok::<CurveId, Trouble>(id)
        });
        match drawn {
            Ok(_) => {
                self.strokes_drawn += 1;
                self.selection.clear();
                self.want_all();
            }
            Err(trouble) => self.report(trouble),
        }
    }

    /// Drops the stroke in hand, and nothing else; false if there is none.
    pub fn drop_stroke(&mut self) -> bool {
        self.desk.drop_wishes(Slot::Live);
        self.desk.drop_wishes(Slot::Preview);
        self.hand.take().is_some()
    }
}

/// How a stroke is drawn into a curve: as the curve was fitted, on the screen as it is now.
fn oversketch_options(curve: &Curve, pixel_size: f64) -> OversketchOptions {
    let fit = FitOptions { pixel_size, ..FitOptions::preset(curve.neatening.preset) };
    OversketchOptions { fit, ..OversketchOptions::default() }
}

/// Whether points that begin at a curve run along it, either way.
fn runs_along(curve: &Spline, mut points: impl Iterator<Item = Point>, pixel_size: f64) -> bool {
    let Some(first) = points.next() else { return false };
    let Some(next) = points.find(|&point| (point - first).hypot() >= ALONG_LENGTH * pixel_size) else { return false };
    let foot = curve.nearest(first);
    let tangent = trig::angle_of(curve.tangent_at(curve.station(foot.segment, foot.s)));
    let turn = trig::wrap_angle(trig::angle_of(next - first) - tangent).abs();
    turn.min(std::f64::consts::PI - turn) <= ALONG
}
