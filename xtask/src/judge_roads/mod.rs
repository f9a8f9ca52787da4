//! Files of roads, judged by programs that nobody here wrote, and by walks over their geometry with other formulas than the project's own.
//! Which judges look at a file is told by its extension: OpenDRIVE, LandXML, GeoJSON and glTF.

mod opendrive;
mod outlines;
mod self_test;
mod verdict;

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, anyhow, bail};

use self::verdict::Verdict;
use crate::steps::{Outcome, Steps};
use crate::{process, tools, tree};

/// How many faults, and how many warnings, of one judge about one file are shown.
const SHOWN: usize = 6;

/// One program, and how it is asked about one file.
struct Judge {
    name: &'static str,
    /// Of the files that it reads.
    extension: &'static str,
    /// What it says of a file, with a folder for what it writes meanwhile; an error where it did not come to a verdict.
    ask: fn(&Path, &Path) -> Result<Verdict>,
}

/// All of them, the slowest first: they are asked in this order, so that in the end none is waited for long.
const JUDGES: [Judge; 10] = [
    Judge { name: "maliput", extension: "xodr", ask: opendrive::maliput },
    Judge { name: "asam", extension: "xodr", ask: opendrive::asam },
    Judge { name: "gltf", extension: "glb", ask: outlines::gltf },
    Judge { name: "alignments", extension: "xml", ask: outlines::alignments },
    Judge { name: "plan", extension: "xodr", ask: opendrive::plan },
    Judge { name: "sumo", extension: "xodr", ask: opendrive::sumo },
    Judge { name: "carla", extension: "xodr", ask: opendrive::carla },
    Judge { name: "check-geojson", extension: "geojson", ask: outlines::check_geojson },
    Judge { name: "xmllint", extension: "xml", ask: outlines::xmllint },
    Judge { name: "ogrinfo", extension: "geojson", ask: outlines::ogrinfo },
];

/// What the program writes of its example networks, judged; the judges themselves first.
pub(crate) fn examples() -> Result<Outcome> {
    // The examples lie on real terrains.
    if !tree::shared().is_dir() {
        let missing = format!("there is no shared data folder ({})", tree::shared().display());
        return if tree::on_build_server() { Err(anyhow!(missing)) } else { Ok(Outcome::Skipped(missing)) };
    }
    let folder = tree::scratch("judge-roads")?.join("examples");
    std::fs::create_dir_all(&folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    let mut files = Vec::new();
    for script in scripts()? {
        let stem = script.file_stem().context("a script has a name")?.to_string_lossy().into_owned();
        let mut command = Command::new(tree::fairpath()?);
        command.arg("drive").arg("run").arg(&script);
        for extension in ["xodr", "xml", "geojson", "glb"] {
            // What nobody surveyed lies nowhere on the globe.
            if extension != "geojson" || is_surveyed(&script)? {
                let file = folder.join(format!("{stem}.{extension}"));
                command.arg("--export").arg(&file);
                files.push(file);
            }
        }
        process::run(&mut command)?;
    }
    judge(&files)
}

/// Whether a script's terrain comes from a file.
fn is_surveyed(script: &Path) -> Result<bool> {
    let text = std::fs::read_to_string(script).with_context(|| format!("cannot read {}", script.display()))?;
    let script: serde_json::Value = serde_json::from_str(&text).context("an example is JSON")?;
    Ok(script.pointer("/commands/0/file").is_some())
}

/// The example networks.
fn scripts() -> Result<Vec<PathBuf>> {
    let folder = tree::root().join("examples/drive");
    let entries = std::fs::read_dir(&folder).with_context(|| format!("cannot read {}", folder.display()))?;
    let mut scripts: Vec<PathBuf> = entries.filter_map(|e| e.ok()).map(|e| e.path()).collect();
    scripts.retain(|path| path.extension().is_some_and(|e| e == "json"));
    scripts.sort();
    if scripts.is_empty() {
        bail!("{} holds no script", folder.display());
    }
    Ok(scripts)
}

/// Judges files, and first the judges themselves where that is wished.
pub(crate) fn run(files: &[PathBuf], with_self_test: bool) -> Result<()> {
    if files.is_empty() && !with_self_test {
        bail!("name the files to judge, or ask for --self-test");
    }
    let mut steps = Steps::default();
    if with_self_test {
        steps.step("judges of roads", self_test);
    }
    if !files.is_empty() {
        steps.step("files of roads", || judge(files));
    }
    steps.finish()
}

/// Whether every judge finds the faults that it is there for, and none where there are none.
pub(crate) fn self_test() -> Result<Outcome> {
    match install(&JUDGES.map(|judge| judge.extension)) {
        Ok(()) => self_test::run(),
        Err(error) if tree::on_build_server() => Err(error),
        Err(error) => Ok(Outcome::Skipped(format!("{error:#}"))),
    }
}

/// What all judges say of the files: an error if one finds fault, or if there is none for a file.
pub(crate) fn judge(files: &[PathBuf]) -> Result<Outcome> {
    let extensions: Vec<&str> = files.iter().filter_map(|file| file.extension()?.to_str()).collect();
    match install(&extensions) {
        Ok(()) => {}
        Err(error) if tree::on_build_server() => return Err(error),
        Err(error) => return Ok(Outcome::Skipped(format!("{error:#}"))),
    }
    let (mut times, mut refused, mut warnings) = (Times::default(), Vec::new(), 0);
    let mut cases = Vec::new();
    for file in files {
        cases.extend(judges_of(file)?.into_iter().map(|judge| Case { judge, file }));
    }
    for (Case { judge, file }, verdict) in times.ask(&cases)? {
        match verdict {
            Ok(verdict) => {
                show(judge, file, &verdict);
                warnings += verdict.warnings.len();
                if !verdict.faults.is_empty() {
                    refused.push(format!("{} by {}", file.display(), judge.name));
                }
            }
            // A judge that a file kills has not passed it, and the others are still to be heard.
            Err(error) => {
                println!("BROKEN  {:<14} {}: {error:#}", judge.name, file.display());
                refused.push(format!("{} by {}, which broke", file.display(), judge.name));
            }
        }
    }
    times.show();
    if times.asked() == 0 {
        bail!("no judge looked at anything");
    }
    if !refused.is_empty() {
        bail!("refused: {}", refused.join("; "));
    }
    Ok(Outcome::Passed(format!("{} verdicts on {} files, no fault, {warnings} warnings", times.asked(), files.len())))
}

/// Installs what the judges of some extensions need, where it is missing.
fn install(extensions: &[&str]) -> Result<()> {
    if extensions.contains(&"xodr") {
        tools::roads_python()?;
        tools::roads_python_3_10()?;
    }
    if extensions.contains(&"xodr") || extensions.contains(&"xml") {
        tools::python()?;
    }
    if extensions.contains(&"xml") {
        tools::xmllint()?;
    }
    if extensions.contains(&"geojson") {
        tools::node_packages("roads/geojson")?;
        tools::ogrinfo()?;
    }
    if extensions.contains(&"glb") {
        tools::gltf_validator()?;
    }
    Ok(())
}

fn judges_of(file: &Path) -> Result<Vec<&'static Judge>> {
    let extension = file.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    let judges: Vec<&Judge> = JUDGES.iter().filter(|judge| judge.extension == extension).collect();
    if judges.is_empty() {
        bail!("no judge reads {}: there are some for .xodr, .xml, .geojson and .glb", file.display());
    }
    Ok(judges)
}

fn show(judge: &Judge, file: &Path, verdict: &Verdict) {
    let word = if verdict.faults.is_empty() { "ok" } else { "REFUSED" };
    println!("{word:<7} {:<14} {}: {}", judge.name, file.display(), verdict.note);
    for (kind, texts) in [("fault", &verdict.faults), ("warning", &verdict.warnings)] {
        for text in texts.iter().take(SHOWN) {
            println!("        {kind}: {text}");
        }
        if texts.len() > SHOWN {
            println!("        … {} {kind}s in all", texts.len());
        }
    }
}

/// A judge and a file for it.
#[derive(Clone, Copy)]
struct Case<'a> {
    judge: &'static Judge,
    file: &'a Path,
}

/// How often each judge was asked, and how long it took.
#[derive(Default)]
struct Times(BTreeMap<&'static str, (usize, Duration)>);

impl Times {
    /// Hears all cases, two at a time, slow judges and large files first: the verdicts in the order of the cases.
    fn ask<'a>(&mut self, cases: &[Case<'a>]) -> Result<Vec<(Case<'a>, Result<Verdict>)>> {
        // Some judges run in other folders.
        let places: Vec<PathBuf> = cases
            .iter()
            .map(|case| case.file.canonicalize().with_context(|| format!("there is no file {}", case.file.display())))
            .collect::<Result<_>>()?;
        let slowness = |case: &usize| {
            let rank = JUDGES.iter().position(|judge| judge.name == cases[*case].judge.name);
            (rank, Reverse(places[*case].metadata().map_or(0, |data| data.len())))
        };
        let mut order: Vec<usize> = (0..cases.len()).collect();
        order.sort_by_key(slowness);
        let next = AtomicUsize::new(0);
        // Each has its own folder, since a judge that is asked about two files at once writes twice under one name.
        let work = |folder: PathBuf| {
            let mut heard = Vec::new();
            while let Some(&case) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
                let begun = Instant::now();
                let verdict = (cases[case].judge.ask)(&places[case], &folder);
                heard.push((case, verdict, begun.elapsed()));
            }
            heard
        };
        let (first, second) = (tree::scratch("judge-roads/first")?, tree::scratch("judge-roads/second")?);
        let mut heard = thread::scope(|scope| {
            let second = scope.spawn(|| work(second));
            let mut heard = work(first);
            heard.extend(second.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
            heard
        });
        heard.sort_by_key(|(case, ..)| *case);
        for (case, _, time) in &heard {
            let (count, total) = self.0.entry(cases[*case].judge.name).or_default();
            *count += 1;
            *total += *time;
        }
        Ok(heard.into_iter().map(|(case, verdict, _)| (cases[case], verdict)).collect())
    }

    fn asked(&self) -> usize {
        self.0.values().map(|(count, _)| count).sum()
    }

    fn show(&self) {
        let each = self.0.iter().map(|(name, (count, time))| format!("{name} {count} in {:.1} s", time.as_secs_f64()));
        println!("asked: {}", each.collect::<Vec<_>>().join(", "));
    }
}

/// A script of `xtask/judges/roads/`, run by one of the judges' Pythons.
fn python_script(python: &Path, script: &str, args: &[&Path]) -> Result<Verdict> {
    let mut command = Command::new(python);
    // Nothing that Python compiles is left beside the scripts.
    command.arg("-B").arg(tree::root().join("xtask/judges/roads").join(script)).args(args);
    Verdict::of_script(&process::capture_within(&mut command, verdict::PATIENCE)?)
}
