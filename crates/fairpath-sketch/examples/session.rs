//! What a session of 500 strokes costs: the time of each deed, of its job, and of what is asked with every move of the pointer, and the memory that 500
//! curves with 500 steps of history take. Where the strokes are fewer than 500, they are drawn again elsewhere.
//!
//! `cargo run -p fairpath-sketch --release --example session [STROKES.json]`

use fairpath_curve::{Point, Vec2};
use fairpath_fit::{CurveEnd, Extension, Stroke};
use fairpath_io::{ReadOptions, read_strokes};
use fairpath_sketch::{CurveId, Neatening, Pin, Session, run};
use std::error::Error;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// How many strokes are drawn.
const STROKES: usize = 500;

/// Times of one kind of deed: in the interface, and in the worker.
#[derive(Default)]
struct Times {
    here: Vec<Duration>,
    worker: Vec<Duration>,
}

impl Times {
    /// Times a deed and the jobs that it asks for.
    fn time<R>(&mut self, session: &mut Session, deed: impl FnOnce(&mut Session) -> R) -> R {
        let start = Instant::now();
        let result = deed(session);
        let mut here = start.elapsed();
        let mut worker = Duration::ZERO;
        while let Some((ticket, job)) = session.next_job() {
            let start = Instant::now();
            let answer = run(&job);
            worker += start.elapsed();
            let start = Instant::now();
            session.take_answer(ticket, answer);
            here += start.elapsed();
        }
        self.here.push(here);
        self.worker.push(worker);
        result
    }

    fn tell(mut self, deed: &str) {
        let [here, worker] = [&mut self.here, &mut self.worker].map(|times| {
            times.sort();
            let ms = |time: Duration| time.as_secs_f64() * 1e3;
            [ms(times[times.len() / 2]), times.last().map_or(0.0, |&time| ms(time))]
        });
        println!(
            "{deed:22} {:5}   {:8.4} {:8.4}   {:8.3} {:8.3}",
            self.here.len(),
            here[0],
            here[1],
            worker[0],
            worker[1]
        );
    }
}

/// Peak of the memory of this process, in MiB, where the system tells it.
fn peak_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kib: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib / 1024.0)
}

fn tell_memory(when: &str) {
    match peak_mib() {
        Some(mib) => println!("{when}: peak of {mib:.1} MiB"),
        None => println!("{when}: the system does not tell its memory"),
    }
}

fn draw(session: &mut Session, points: &[Point]) {
    session.begin_stroke(1.0, false);
    points.iter().for_each(|&point| session.extend_stroke(point, None, None));
    session.finish_stroke(true);
}

/// The strokes of a file, as often as it takes, each time further down.
fn strokes(file: PathBuf) -> Result<Vec<Stroke>, Box<dyn Error>> {
    let read = read_strokes(&file, &ReadOptions::default())?.strokes;
    let moved = |i: usize| {
        let mut stroke = read[i % read.len()].clone();
        let by = Vec2::new(3.0, 5.0) * (i / read.len()) as f64;
        stroke.points.iter_mut().for_each(|point| *point += by);
        stroke
    };
    Ok((0..STROKES).map(moved).collect())
}

fn main() -> Result<(), Box<dyn Error>> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data/strokes/quickdraw.json");
    let strokes = strokes(std::env::args_os().nth(1).map_or_else(|| beside.into(), PathBuf::from))?;
    tell_memory("before");
    println!("{:22} {:>5}   {:>17}   {:>17}", "", "", "here, ms", "worker, ms");
    println!("{:22} {:>5}   {:>8} {:>8}   {:>8} {:>8}", "deed", "times", "median", "most", "median", "most");
    let mut session = Session::default();
    let mut drawing = Times::default();
    for stroke in &strokes {
        drawing.time(&mut session, |session| draw(session, &stroke.points));
    }
    drawing.tell("draw");
    let ids: Vec<CurveId> = session.drawing().curves().iter().map(|curve| curve.id).collect();
    tell_memory(&format!("{} curves with as many steps of history", ids.len()));

    let mut pointer = Times::default();
    let mut missing = Times::default();
    let mut watching = Times::default();
    for (i, stroke) in strokes.iter().enumerate() {
        let place = stroke.points[stroke.points.len() / 2];
        pointer.time(&mut session, |session| session.nearest(place, 10.0));
        missing.time(&mut session, |session| session.nearest(place + Vec2::new(0.0, 1e5), 10.0));
        if i % 10 == 0 {
            session.begin_stroke(1.0, false);
            stroke.points.iter().for_each(|&point| session.extend_stroke(point, None, None));
            watching.time(&mut session, |session| session.watch_stroke(false));
            session.drop_stroke();
        }
    }
    pointer.tell("nearest, on a curve");
    missing.tell("nearest, on none");
    watching.tell("watch a stroke");
    edits(&mut session, &ids);
    tell_memory(&format!("{} curves after all of that", session.drawing().curves().len()));

    let (mut undoing, mut redoing) = (Times::default(), Times::default());
    let mut steps = 0;
    while session.history().undoable().is_some() {
        undoing.time(&mut session, Session::undo);
        steps += 1;
    }
    while session.history().redoable().is_some() {
        redoing.time(&mut session, Session::redo);
    }
    undoing.tell("undo");
    redoing.tell("redo");
    tell_memory(&format!("{steps} steps undone and done again"));
    Ok(())
}

/// What is done to a curve.
type Deed = fn(&mut Session, CurveId);

/// A share of the length of a curve.
fn station(session: &Session, id: CurveId, share: f64) -> f64 {
    session.drawing().curve(id).map_or(0.0, |curve| share * curve.spline.length())
}

/// Every edit on curves of its own.
fn edits(session: &mut Session, ids: &[CurveId]) {
    let deeds: [(&str, Deed); 9] = [
        ("cut", |session, id| session.cut(id, station(session, id, 0.5))),
        ("extend", |session, id| session.extend(id, CurveEnd::End, 20.0, Extension::Curvature)),
        ("shorten", |session, id| session.shorten(id, CurveEnd::End, station(session, id, 0.9))),
        ("close", |session, id| session.close(id, 20.0)),
        ("corner", |session, id| session.toggle_corner(id, station(session, id, 0.5), 10.0)),
        ("neaten", |session, id| {
            session.select(Some(id), false);
            session.set_neatening(Neatening { fairness: 0.7, ..session.neatening().clone() });
            session.end_gesture();
        }),
        ("duplicate", |session, id| {
            session.select(Some(id), false);
            session.duplicate_selected(Vec2::new(4.0, 4.0));
        }),
        ("move", |session, id| {
            session.select(Some(id), false);
            session.move_selected(Vec2::new(2.0, 1.0));
            session.end_gesture();
        }),
        ("delete", |session, id| {
            session.select(Some(id), false);
            session.delete_selected();
        }),
    ];
    for (k, (name, deed)) in deeds.into_iter().enumerate() {
        let mut times = Times::default();
        for &id in ids.iter().skip(k).step_by(20) {
            times.time(session, |session| deed(session, id));
        }
        times.tell(name);
    }
    pulls(session, ids);
    let mut times = Times::default();
    times.time(session, |session| {
        session.select_all();
        session.set_neatening(Neatening { fairness: 0.6, ..session.neatening().clone() });
        session.end_gesture();
    });
    times.tell("neaten all");
}

/// A pull begins by fixing a place and goes on with moves of it.
fn pulls(session: &mut Session, ids: &[CurveId]) {
    let (mut first, mut next) = (Times::default(), Times::default());
    for &id in ids.iter().skip(11).step_by(20) {
        let Some(curve) = session.drawing().curve(id) else { continue };
        let place = curve.spline.point_at(0.5 * curve.spline.length());
        let mut index = None;
        for step in 1..=5 {
            let pin = Pin { share: 0.5, point: place + Vec2::new(0.0, f64::from(step)) };
            let times = if index.is_none() { &mut first } else { &mut next };
            index = times.time(session, |session| session.pin(id, index, pin));
        }
        session.end_gesture();
    }
    first.tell("pull, begin");
    next.tell("pull, go on");
}
