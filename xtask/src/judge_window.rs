//! The desktop's window, judged by what an X screen shows and by what is in files: it starts, shows a stroke while it is drawn, records it as it was drawn,
//! finds the very curve that the command line finds, survives a crash, and closes when it is asked to.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail, ensure};
use fairpath_sketch::{Drawing, decode_drawing};
use serde_json::Value;

use crate::judge_web::same_curves;
use crate::steps::Outcome;
use crate::window::{Area, Hands, Key, Picture, Place, Program, Screen, laid_out, pause, until, wacom};
use crate::{process, tree};

/// After so long it is given up that something will be shown or kept: software draws here, and others may use the machine as well.
const PATIENCE: Duration = Duration::from_secs(60);

/// How long after a stroke the drawing is wanted to be kept, seconds; told, not judged.
const WANTED_KEPT_S: f64 = 15.0;

/// From one place of a stroke to the next, as of a mouse of 250 Hz.
const STEP: Duration = Duration::from_millis(4);

/// The part of the window where no panel lies.
const CANVAS: Area = Area { left: 100, top: 110, width: 820, height: 560 };

/// Where the strokes are drawn, apart from each other.
const PLACES: [Area; 3] = [
    Area { left: 120, top: 140, width: 420, height: 220 },
    Area { left: 120, top: 420, width: 360, height: 220 },
    Area { left: 580, top: 140, width: 320, height: 480 },
];

/// Where the pointer disturbs nothing.
const ASIDE: Place = [560, 120];

/// The share of a stroke's places beside which something must be seen.
const SEEN: f64 = 0.95;

/// A place recorded further than this from where the pointer was is another place, pixels.
const EXACT: f64 = 0.01;

/// Builds the window and judges it.
pub(crate) fn step() -> Result<Outcome> {
    let screen = match Screen::prepare().and_then(|()| Screen::start()) {
        Ok(screen) => screen,
        Err(error) if tree::on_build_server() => return Err(error),
        Err(error) => return Ok(Outcome::Skipped(format!("{error:#}"))),
    };
    process::build(&["fairpath-app"])?;
    let exe = tree::target_folder()?.join("debug/fairpath-app");
    let out = tree::scratch("judge-window")?;
    for old in fs::read_dir(&out)? {
        fs::remove_file(old?.path())?;
    }
    let trial = Trial { exe, screen, kept: out.join("kept.json"), out };
    let note = trial.run();
    note.map(Outcome::Passed).with_context(|| format!("pictures and files are in {}", trial.out.display()))
}

/// One run of the judge.
struct Trial {
    exe: PathBuf,
    screen: Screen,
    /// Where the window keeps its drawing.
    kept: PathBuf,
    /// Where what was seen is put.
    out: PathBuf,
}

impl Trial {
    fn run(&self) -> Result<String> {
        let strokes = strokes()?;
        let window = self.start("first", &self.kept, &[])?;
        let ready_ms = window.ready_ms;
        self.first_start(&window.hands)?;
        for (i, stroke) in strokes.iter().enumerate() {
            self.draw(&window.hands, i, stroke)?;
        }
        let drawing = self.wait_kept(strokes.len())?;
        recorded(&drawing, &strokes)?;
        let curves = self.as_the_command_line(&drawing)?;
        let before = self.seen_whole(&window.hands, "before-crash")?;
        self.crash(window, &strokes[0])?;

        let pace = self.out.join("pace.json");
        let window = self.start("again", &self.kept, &[Path::new("--pace"), &pace])?;
        self.is_back(&window.hands, &drawing, &before)?;
        let strokes_now = self.undo_and_draw(&window.hands, &strokes[0], drawing.curves().len())?;
        let after = self.seen_whole(&window.hands, "before-closing")?;
        let ended = window.close()?;
        ensure!(ended.code() == Some(0), "the window was closed, and its program ended with {ended}");
        let times = paced(&pace)?;
        self.wait_kept(strokes_now)?;

        self.given_file(&after)?;
        Ok(format!(
            "{curves} curves as the command line makes them, there again after a crash; shown in {ready_ms:.0} ms; {times}"
        ))
    }

    fn start(&self, name: &str, kept: &Path, more: &[&Path]) -> Result<Program> {
        let arguments = [&[Path::new("--kept"), kept], more].concat();
        let window = Program::start(&self.exe, &self.screen, &arguments, &self.out.join(format!("{name}.log")))?;
        println!("{name}: something is in the window after {:.0} ms", window.ready_ms);
        window.hands.picture()?.save(&self.out.join(format!("{name}.png")))?;
        Ok(window)
    }

    /// The first start shows curves, and their absence when they are deleted.
    fn first_start(&self, hands: &Hands) -> Result<()> {
        let room = hands.area();
        ensure!(room.width >= 1200 && room.height >= 800, "the window is too small to be drawn in: {room:?}");
        hands.move_to(ASIDE)?;
        let coloured = until(PATIENCE, "the curves of the first drawing", || {
            let coloured = hands.picture()?.colourful(CANVAS);
            Ok((coloured > 500).then_some(coloured))
        })?;
        hands.strike(Key::Char('a'), true)?;
        hands.strike(Key::Delete, false)?;
        self.wait_empty(hands)?;
        println!("the first drawing has {coloured} coloured pixels, and none once it is deleted");
        Ok(())
    }

    fn wait_empty(&self, hands: &Hands) -> Result<()> {
        until(PATIENCE, "an empty drawing", || Ok((hands.picture()?.colourful(CANVAS) == 0).then_some(())))
    }

    /// Draws a stroke; it is seen while the button is down, and moves without the button leave nothing.
    fn draw(&self, hands: &Hands, number: usize, stroke: &[Place]) -> Result<()> {
        hands.move_to(ASIDE)?;
        let before = steady(hands)?;
        follow(hands, stroke)?;
        hands.move_to(ASIDE)?;
        let moved = steady(hands)?.share_changed(&before, stroke, 2);
        ensure!(
            moved < 1.0 - SEEN,
            "{moved:.2} of a stroke is seen that was not drawn, so the judge's eyes are worth nothing"
        );

        hands.move_to(stroke[0])?;
        hands.press()?;
        follow(hands, stroke)?;
        let at_once = hands.picture()?.share_changed(&before, stroke, 3);
        let mut seen = 0.0;
        let live = until(PATIENCE, "the stroke to be seen while it is drawn", || {
            let picture = hands.picture()?;
            seen = picture.share_changed(&before, stroke, 3);
            Ok((seen >= SEEN).then_some(picture))
        });
        let live =
            live.with_context(|| format!("of stroke {} only {seen:.2} is seen with the button down", number + 1));
        if live.is_err() {
            hands.picture()?.save(&self.out.join(format!("live-{}.png", number + 1)))?;
        }
        live?.save(&self.out.join(format!("live-{}.png", number + 1)))?;
        println!("stroke {}: {at_once:.2} of it is seen right after its last place, with the button down", number + 1);
        hands.release()?;
        hands.move_to(ASIDE)
    }

    /// The drawing that is kept, once it has that many curves, all fitted.
    fn wait_kept(&self, curves: usize) -> Result<Drawing> {
        let begun = Instant::now();
        let drawing = until(PATIENCE, &format!("a kept drawing of {curves} fitted curves"), || {
            if !self.kept.is_file() {
                return Ok(None);
            }
            // It is written whole or not at all, so it can be read at any time.
            let drawing = decode_drawing(&fs::read(&self.kept)?, "the kept drawing")?;
            let all = drawing.curves().len() == curves && drawing.curves().iter().all(|curve| curve.fitted);
            Ok(all.then_some(drawing))
        })?;
        let seconds = begun.elapsed().as_secs_f64();
        let hint =
            if seconds > WANTED_KEPT_S { format!(", more than the {WANTED_KEPT_S} s wanted") } else { String::new() };
        println!("kept {seconds:.1} s after the last stroke{hint}");
        Ok(drawing)
    }

    /// The command line makes the same curves of the strokes that were recorded. How many there are.
    fn as_the_command_line(&self, drawing: &Drawing) -> Result<usize> {
        let kept: Value = serde_json::from_slice(&fs::read(&self.kept)?)?;
        for (member, file) in [("strokes", "recorded.json"), ("splines", "splines.json")] {
            fs::write(self.out.join(file), kept[member].to_string())?;
        }
        let pixel_size = drawing.curves().first().context("a drawing without curves")?.neatening.pixel_size;
        same_curves(&self.out, "splines.json", &pixel_size.into())
    }

    /// All of the drawing as the window shows it when it is asked to, the pointer aside.
    fn seen_whole(&self, hands: &Hands, name: &str) -> Result<Picture> {
        hands.move_to(ASIDE)?;
        let part = steady(hands)?;
        hands.strike(Key::Char('0'), true)?;
        until(PATIENCE, "all of the drawing", || {
            Ok((!hands.picture()?.changes(&part, CANVAS).is_empty()).then_some(()))
        })?;
        let picture = steady(hands)?;
        picture.save(&self.out.join(format!("{name}.png")))?;
        Ok(picture)
    }

    /// Ends the program while a stroke is drawn.
    fn crash(&self, mut window: Program, stroke: &[Place]) -> Result<()> {
        window.hands.move_to(stroke[0])?;
        window.hands.press()?;
        follow(&window.hands, &stroke[..stroke.len() / 2])?;
        window.crash()?;
        println!("ended in the middle of a stroke, as by a crash");
        // The button is the screen's, not the program's: the next window shall not find it down.
        window.hands.release()
    }

    /// The drawing is there again: in the file and on the screen.
    fn is_back(&self, hands: &Hands, drawing: &Drawing, before: &Picture) -> Result<()> {
        let kept = decode_drawing(&fs::read(&self.kept)?, "the kept drawing")?;
        ensure!(kept == *drawing, "the crash changed the drawing that was kept");
        hands.move_to(ASIDE)?;
        self.wait_same(hands, before, "again-whole")
    }

    /// Waits until the canvas shows the same drawing as a picture.
    fn wait_same(&self, hands: &Hands, before: &Picture, name: &str) -> Result<()> {
        let ink = before.colourful(CANVAS);
        // Smoothed edges may fall otherwise by a shade.
        let allowed = ink / 100;
        let mut other = usize::MAX;
        let seen = until(PATIENCE, "the drawing as it was", || {
            let picture = hands.picture()?;
            other = picture.changes(before, CANVAS).len();
            Ok((other <= allowed).then_some(picture))
        });
        let failed = |_: &anyhow::Error| hands.picture().and_then(|p| p.save(&self.out.join(format!("{name}.png"))));
        let picture = seen
            .inspect_err(|error| {
                // The picture helps people only.
                let _ = failed(error);
            })
            .with_context(|| format!("{other} pixels differ, {ink} have a colour"))?;
        picture.save(&self.out.join(format!("{name}.png")))?;
        println!("{name}: {other} pixels differ from before, of {ink} that have a colour");
        Ok(())
    }

    /// Undo leads to an empty drawing and redo back; then one more stroke. How many curves there are then.
    fn undo_and_draw(&self, hands: &Hands, stroke: &[Place], curves: usize) -> Result<usize> {
        let before = hands.picture()?;
        hands.strike(Key::Char('z'), true)?;
        self.wait_empty(hands)?;
        // Empty paper is not the drawing: the eyes that found it there again can tell.
        let gone = hands.picture()?.changes(&before, CANVAS).len();
        ensure!(
            gone > before.colourful(CANVAS) / 100,
            "the judge takes empty paper for the drawing, so its word is worth nothing"
        );
        self.draw(hands, PLACES.len(), stroke)?;
        self.wait_kept(1)?;
        hands.strike(Key::Char('z'), true)?;
        self.wait_empty(hands)?;
        hands.strike(Key::Char('y'), true)?;
        until(PATIENCE, "the stroke that was undone", || Ok((hands.picture()?.colourful(CANVAS) > 100).then_some(())))?;
        println!("undo led from {curves} curves to none, and from one that was drawn then");
        Ok(1)
    }

    /// A drawing given as an argument is shown as it was.
    fn given_file(&self, before: &Picture) -> Result<()> {
        let file = self.out.join("drawing.json");
        fs::copy(&self.kept, &file)?;
        let window = self.start("given", &self.out.join("other.json"), &[&file])?;
        window.hands.move_to(ASIDE)?;
        self.wait_same(&window.hands, before, "given-whole")?;
        let ended = window.close()?;
        ensure!(ended.code() == Some(0), "the window with a file was closed, and its program ended with {ended}");
        Ok(())
    }
}

/// The strokes to draw: the example's longest and, where the shared data are, the two longest of a tablet.
fn strokes() -> Result<Vec<Vec<Place>>> {
    let longest = |file: &Path, area: Area, rank: usize| -> Result<Vec<Place>> {
        let mut strokes = laid_out(file, area)?;
        strokes.sort_by_key(|stroke| std::cmp::Reverse(stroke.len()));
        strokes.into_iter().nth(rank).with_context(|| format!("{} has too few strokes", file.display()))
    };
    let mut strokes = vec![longest(&tree::root().join("examples/hello.json"), PLACES[0], 0)?];
    if let Some(wacom) = wacom() {
        strokes.push(longest(&wacom, PLACES[1], 0)?);
        strokes.push(longest(&wacom, PLACES[2], 1)?);
    }
    Ok(strokes)
}

/// Moves the pointer along a stroke.
fn follow(hands: &Hands, stroke: &[Place]) -> Result<()> {
    for place in stroke {
        hands.move_to(*place)?;
        pause(STEP);
    }
    Ok(())
}

/// What is seen once nothing changes any more.
fn steady(hands: &Hands) -> Result<Picture> {
    let mut last = hands.picture()?;
    let mut same = 0;
    until(PATIENCE, "a picture that stays", || {
        pause(Duration::from_millis(100));
        let now = hands.picture()?;
        same = if now.changes(&last, CANVAS).is_empty() { same + 1 } else { 0 };
        last = now;
        Ok((same >= 5).then(|| last.clone()))
    })
}

/// The strokes of the drawing are those that were drawn, place by place.
fn recorded(drawing: &Drawing, strokes: &[Vec<Place>]) -> Result<()> {
    ensure!(drawing.curves().len() == strokes.len(), "{} curves of {} strokes", drawing.curves().len(), strokes.len());
    for (curve, stroke) in drawing.curves().iter().zip(strokes) {
        let points: Vec<[f64; 2]> = curve.stroke.points.iter().map(|p| [p.x, p.y]).collect();
        let off = farthest(&points, curve.neatening.pixel_size, stroke)
            .with_context(|| format!("{} is not what was drawn", curve.name))?;
        println!("{}: {} places, the farthest {off:.1e} pixels from where the pointer was", curve.name, points.len());
        // A stroke is not the same one drawn backwards.
        let backward: Vec<Place> = stroke.iter().rev().copied().collect();
        if farthest(&points, curve.neatening.pixel_size, &backward).is_ok() {
            bail!("the judge takes a stroke for another one, so its word is worth nothing");
        }
    }
    Ok(())
}

/// How far the recorded points are from the places that were drawn, pixels; the window's zoom is told by the size of a pixel, and where it is
/// by the first point.
fn farthest(points: &[[f64; 2]], pixel_size: f64, stroke: &[Place]) -> Result<f64> {
    ensure!(!stroke.is_empty(), "a stroke without places");
    ensure!(points.len() == stroke.len(), "{} points were recorded of {} places", points.len(), stroke.len());
    let mut farthest = 0.0_f64;
    for (i, (point, place)) in points.iter().zip(stroke).enumerate() {
        let off = |axis: usize| {
            let (drawn, recorded) =
                (f64::from(place[axis] - stroke[0][axis]), (point[axis] - points[0][axis]) / pixel_size);
            recorded - drawn
        };
        let off = off(0).hypot(off(1));
        ensure!(off <= EXACT, "point {} is {off} pixels from where the pointer was", i + 1);
        farthest = farthest.max(off);
    }
    Ok(farthest)
}

/// What the pace of a session says in which one stroke was drawn.
fn paced(file: &Path) -> Result<String> {
    let pace: Value = serde_json::from_slice(&fs::read(file).context("the window wrote no pace")?)?;
    let number = |what: &str, of: &str| pace[what][of].as_f64().with_context(|| format!("the pace has no {what}.{of}"));
    ensure!(
        number("curves", "count")? == 1.0,
        "the pace is of {} curves, and one was drawn",
        number("curves", "count")?
    );
    ensure!(number("frames", "count")? > 0.0, "the pace is of no picture");
    Ok(format!("its curve {:.1} ms after the last point", number("curves", "longest")?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stroke_is_recorded_only_if_every_place_is() {
        let stroke = [[10, 20], [12, 24], [20, 24]];
        let points = [[0.5, 0.5], [1.5, 2.5], [5.5, 2.5]];
        assert!(farthest(&points, 0.5, &stroke).unwrap() < 1e-12);
        assert!(farthest(&points, 0.51, &stroke).is_err());
        assert!(farthest(&points[..2], 0.5, &stroke).is_err());
        assert!(farthest(&[[0.5, 0.5], [1.5, 2.51], [5.5, 2.5]], 0.5, &stroke).is_err());
        assert!(farthest(&[], 0.5, &[]).is_err());
    }
}
