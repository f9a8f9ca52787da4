//! `fairpath drive`: roads on a terrain, by scripts of the same commands that the application sends.

use std::path::Path;
use std::time::Instant;

use anyhow::{Context, Result, bail};
use fairpath_drive::{Breach, CameraTrack, Document, Play, Results, State};
use fairpath_io::{
    DriveExport, DriveView, ExportFormat, MOST_PIXELS, OpenedDrive, PathSummary, ReadOptions, encode_drive,
    encode_drive_picture, encode_earthwork, encode_moments, encode_project, open_drive, summaries,
};

use super::Ending;
use crate::args::{
    CameraName, DriveArgs, DriveCheckArgs, DriveEarthworkArgs, DrivePlayArgs, DriveRenderArgs, DriveRunArgs, DriveVerb,
    ViewName,
};
use crate::interrupt;
use crate::output::{Ready, check_place};
use crate::printer::{Printer, columns};

pub(crate) fn run(args: &DriveArgs, printer: &mut Printer) -> Result<Ending> {
    match &args.verb {
        DriveVerb::Run(args) => run_script(args, printer),
        DriveVerb::Check(args) => check(args, printer),
        DriveVerb::Earthwork(args) => earthwork(args, printer),
        DriveVerb::Play(args) => play(args, printer),
        DriveVerb::Render(args) => render(args, printer),
    }
}

fn run_script(args: &DriveRunArgs, printer: &mut Printer) -> Result<Ending> {
    let mut exports = Vec::new();
    for path in &args.export {
        check_place(path)?;
        let Some(format) = ExportFormat::from_path(path) else {
            let known: Vec<&str> = ExportFormat::ALL.iter().map(|f| f.extension()).collect();
            bail!("{}: networks are written as {}; use such an extension", path.display(), known.join(", "));
        };
        exports.push((path, format));
    }
    if let Some(path) = &args.project {
        check_place(path)?;
    }
    interrupt::install();
    let opened = opened(&args.script, args.times, printer)?;
    let (state, results) = laid(&opened.document, &args.script)?;
    let mut ready = Ready::default();
    let name = args.script.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    for (path, format) in exports {
        let begun = Instant::now();
        let export = DriveExport { state, results, name: &name };
        let bytes = encode_drive(&export, format).with_context(|| path.display().to_string())?;
        if args.times {
            printer.note(&format!("{:8.1} ms  {}", ms(begun), path.display()));
        }
        ready.add(path, bytes);
    }
    if let Some(path) = &args.project {
        let to = path.parent().unwrap_or(Path::new(""));
        ready.add(path, encode_project(&opened.document, &opened.folder, to)?);
    }
    ready.write()?;
    // A project on standard output is for a program, which a table would disturb.
    if args.project.as_deref() != Some(Path::new("-")) {
        printer.result(&table(&summaries(state, results)))?;
    }
    Ok(Ending::Done)
}

fn check(args: &DriveCheckArgs, printer: &mut Printer) -> Result<Ending> {
    interrupt::install();
    let opened = opened(&args.project, false, printer)?;
    let (state, results) = laid(&opened.document, &args.project)?;
    let all = summaries(state, results);
    let rows: Vec<Vec<String>> =
        all.iter().flat_map(|path| path.breaches.iter().map(|b| breach(&path.name, b))).collect();
    let broken = !rows.is_empty();
    let head = ["path", "station m", "from m", "to m", "rule", "value", "limit", "unit"];
    let head = vec![head.map(str::to_owned).to_vec()];
    printer.result(&if broken { columns(&[head, rows].concat()) } else { "no rule is broken\n".to_owned() })?;
    Ok(if broken && args.strict { Ending::SomeFailed } else { Ending::Done })
}

fn earthwork(args: &DriveEarthworkArgs, printer: &mut Printer) -> Result<Ending> {
    check_place(&args.output)?;
    if !(0.1..=1e6).contains(&args.every) {
        bail!("--every {}: rows can be 0.1 to 1000000 m apart", args.every);
    }
    interrupt::install();
    let opened = opened(&args.project, false, printer)?;
    let (state, results) = laid(&opened.document, &args.project)?;
    if let Some(name) = args.path.as_deref().filter(|name| state.path(name).is_none()) {
        return Err(no_path(state, &args.project, name));
    }
    let mut ready = Ready::default();
    ready.add(&args.output, encode_earthwork(results, args.path.as_deref(), args.every)?);
    ready.write()?;
    Ok(Ending::Done)
}

fn no_path(state: &State, file: &Path, name: &str) -> anyhow::Error {
    anyhow::Error::new(state.no_path(name)).context(file.display().to_string())
}

fn play(args: &DrivePlayArgs, printer: &mut Printer) -> Result<Ending> {
    check_place(&args.output)?;
    interrupt::install();
    let opened = opened(&args.project, false, printer)?;
    let (state, results) = laid(&opened.document, &args.project)?;
    let track = args.camera.map(|name| match name {
        CameraName::Driver => CameraTrack::Driver,
        CameraName::Chase => CameraTrack::Chase,
        CameraName::Aerial => CameraTrack::Aerial,
        CameraName::Side => CameraTrack::Side,
    });
    let play = Play {
        path: args.path.clone(),
        from_m: args.from,
        to_m: args.to,
        on: args.on,
        step_s: args.step,
        camera: track.unwrap_or_default(),
    };
    let drive = play.drive(state, results).with_context(|| args.project.display().to_string())?;
    let mut ready = Ready::default();
    ready.add(&args.output, encode_moments(&drive, track)?);
    ready.write()?;
    Ok(Ending::Done)
}

fn render(args: &DriveRenderArgs, printer: &mut Printer) -> Result<Ending> {
    check_place(&args.output)?;
    if !args.size.iter().all(|side| (1..=MOST_PIXELS).contains(side)) {
        bail!("--size {}x{}: each side has 1 to {MOST_PIXELS} pixels", args.size[0], args.size[1]);
    }
    interrupt::install();
    let opened = opened(&args.project, false, printer)?;
    let (state, results) = laid(&opened.document, &args.project)?;
    let view = match args.camera {
        ViewName::Birdseye => DriveView::Birdseye,
        ViewName::Midway => DriveView::Midway,
        ViewName::Closeup => DriveView::Closeup,
        ViewName::Driver => DriveView::Driver,
    };
    let mut ready = Ready::default();
    ready.add(&args.output, encode_drive_picture(&DriveExport { state, results, name: "" }, view, args.size)?);
    ready.write()?;
    Ok(Ending::Done)
}

/// The document that a script or a project leads to.
fn opened(path: &Path, times: bool, printer: &mut Printer) -> Result<OpenedDrive> {
    let mut since = Instant::now();
    let mut done = |number: usize, word: &str| {
        if times {
            printer.note(&format!("{:8.1} ms  command {number} ({word})", ms(since)));
        }
        since = Instant::now();
    };
    let opened = open_drive(path, &ReadOptions::default(), &mut done)?;
    for warning in &opened.warnings {
        printer.note(&format!("{}: {}", path.display(), warning.text));
    }
    Ok(opened)
}

fn ms(since: Instant) -> f64 {
    1e3 * since.elapsed().as_secs_f64()
}

/// What there is to write of a document.
fn laid<'a>(document: &'a Document, path: &Path) -> Result<(&'a State, &'a Results)> {
    match document.results() {
        Some(results) => Ok((document.state(), results)),
        None => bail!("{}: it lays no terrain, so that nothing follows from it", path.display()),
    }
}

/// The table of paths.
fn table(all: &[PathSummary]) -> String {
    let head = [
        "path",
        "length m",
        "curves",
        "min R m",
        "max grade %",
        "lowest m",
        "highest m",
        "cut m3",
        "fill m3",
        "bridges",
        "m",
        "tunnels",
        "m",
        "signs",
        "breaches",
    ];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for path in all {
        let radius = if path.min_radius_m.is_finite() { format!("{:.1}", path.min_radius_m) } else { "-".to_owned() };
        rows.push(vec![
            path.name.clone(),
            format!("{:.0}", path.length_m),
            path.curves.to_string(),
            radius,
            format!("{:.1}", 100.0 * path.max_grade),
            format!("{:.1}", path.heights_m[0]),
            format!("{:.1}", path.heights_m[1]),
            format!("{:.0}", path.earthwork_m3[0]),
            format!("{:.0}", path.earthwork_m3[1]),
            path.bridges.0.to_string(),
            format!("{:.0}", path.bridges.1),
            path.tunnels.0.to_string(),
            format!("{:.0}", path.tunnels.1),
            path.signs.to_string(),
            path.breaches.len().to_string(),
        ]);
    }
    columns(&rows)
}

fn breach(path: &str, breach: &Breach) -> Vec<String> {
    let number = |x: f64| if x.abs() < 10.0 { format!("{x:.3}") } else { format!("{x:.1}") };
    vec![
        path.to_owned(),
        format!("{:.0}", breach.station_m),
        format!("{:.0}", breach.range_m[0]),
        format!("{:.0}", breach.range_m[1]),
        breach.rule.name().to_owned(),
        number(breach.value),
        number(breach.limit),
        breach.rule.unit().to_owned(),
    ]
}
