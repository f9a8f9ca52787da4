//! Programs that nobody here wrote, judging what this project writes. A judge must also find fault with rubbish:
//! one that passes everything proves nothing.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

use crate::steps::Outcome;
use crate::{process, tools, tree};

/// The kernel's numbers against mpmath, scipy and pyclothoids.
pub(crate) fn kernel() -> Result<Outcome> {
    let cases = tree::scratch("judges")?.join("kernel-cases.txt");
    let file = File::create(&cases).with_context(|| format!("cannot write {}", cases.display()))?;
    process::run(&mut process::cargo(&["build", "--quiet", "--workspace", "--example", "kernel_cases"]))?;
    let example = tree::fairpath()?.with_file_name("examples/kernel_cases");
    process::run(Command::new(example).stdout(file))?;
    let mut judge = Command::new(tools::python()?);
    judge.arg(tree::root().join("tools/judge_kernel.py")).stdin(Stdio::from(File::open(&cases)?));
    process::run(&mut judge)?;
    Ok(Outcome::Passed("mpmath, scipy and pyclothoids agree with the kernel".into()))
}

/// A fitted drawing as DXF, read by ezdxf.
pub(crate) fn dxf() -> Result<Outcome> {
    let (spline, folder) = fitted_example()?;
    let dxf = folder.join("hello.dxf");
    convert(&spline, &dxf)?;
    let script = tree::root().join("xtask/judges/judge_dxf.py");
    let judge = |file: &Path| process::capture(Command::new(tools::python()?).arg(&script).arg(file).arg(&spline));
    let ran = judge(&dxf)?;
    print!("{}", ran.text);
    if ran.code != Some(0) {
        bail!("ezdxf finds fault with {}", dxf.display());
    }
    let rubbish = folder.join("rubbish.dxf");
    fs::write(&rubbish, "0\nSECTION\nthis is no drawing\n")?;
    if judge(&rubbish)?.code == Some(0) {
        bail!("the judge passes rubbish, so its word is worth nothing");
    }
    Ok(Outcome::Passed(ran.text.lines().last().unwrap_or_default().to_owned()))
}

/// A fitted drawing as SVG, drawn by librsvg.
pub(crate) fn svg() -> Result<Outcome> {
    if let Err(error) = tools::rsvg_convert() {
        return if tree::on_build_server() { Err(error) } else { Ok(Outcome::Skipped(format!("{error:#}"))) };
    }
    let (spline, folder) = fitted_example()?;
    let svg = folder.join("hello.svg");
    convert(&spline, &svg)?;
    let draw = |svg: &Path, png: &Path| {
        let ran = process::capture(Command::new("rsvg-convert").arg(svg).arg("-o").arg(png))?;
        let bytes = fs::metadata(png).map(|data| data.len()).unwrap_or(0);
        Ok::<_, anyhow::Error>((ran, bytes))
    };
    let (ran, bytes) = draw(&svg, &folder.join("hello.png"))?;
    let blank_svg = folder.join("blank.svg");
    fs::write(&blank_svg, r#"<svg xmlns="http://www.w3.org/2000/svg" width="800" height="400"/>"#)?;
    let (_, blank) = draw(&blank_svg, &folder.join("blank.png"))?;
    if ran.code != Some(0) || bytes <= blank {
        bail!("rsvg-convert ended with {:?} and drew {bytes} bytes (a blank page: {blank}): {}", ran.code, ran.text);
    }
    let rubbish = folder.join("rubbish.svg");
    fs::write(&rubbish, "<svg><path d=")?;
    if draw(&rubbish, &folder.join("rubbish.png"))?.0.code == Some(0) {
        bail!("the judge passes rubbish, so its word is worth nothing");
    }
    Ok(Outcome::Passed(format!("librsvg draws it: {bytes} bytes of PNG, a blank page has {blank}")))
}

/// Inflated drawings as glTF, read by the validator of the specification's authors: all closed curves of the examples and, where the shared
/// data folder is, of the synthetic strokes.
pub(crate) fn gltf() -> Result<Outcome> {
    let validator = match tools::gltf_validator() {
        Ok(folder) => folder,
        Err(error) if tree::on_build_server() => return Err(error),
        Err(error) => return Ok(Outcome::Skipped(format!("{error:#}"))),
    };
    let folder = tree::scratch("judges")?;
    let mut strokes: Vec<PathBuf> =
        ["duck.json", "leaf.svg"].map(|name| tree::root().join("examples").join(name)).into();
    let synthetic = tree::strokes().join("synthetic.json");
    if synthetic.is_file() || tree::on_build_server() {
        strokes.push(synthetic);
    } else {
        println!("skipped: the synthetic strokes are not at {}", synthetic.display());
    }
    let mut files = Vec::new();
    for stroke in &strokes {
        let stem = stroke.file_stem().context("a file of strokes has a name")?.to_string_lossy();
        let (spline, glb) = (folder.join(format!("{stem}-to-inflate.json")), folder.join(format!("{stem}.glb")));
        process::run(Command::new(tree::fairpath()?).arg("fit").arg(stroke).arg("-o").arg(&spline))?;
        let ran = process::capture(Command::new(tree::fairpath()?).arg("inflate").arg(&spline).arg("-o").arg(&glb))?;
        // Open curves have no surface, which is told with 1.
        if !matches!(ran.code, Some(0 | 1)) {
            bail!("{} cannot be inflated: {}", stroke.display(), ran.text);
        }
        files.push(glb);
    }
    let judge = |files: &[PathBuf]| {
        let script = tree::root().join("xtask/judges/gltf/judge.mjs");
        process::capture(Command::new("node").arg(script).args(files).current_dir(&validator))
    };
    let ran = judge(&files)?;
    print!("{}", ran.text);
    if ran.code != Some(0) {
        bail!("the glTF validator finds fault");
    }
    // Cut off in the middle, and with a triangle of a vertex that does not exist in its last bytes.
    let good = fs::read(&files[0])?;
    let (cut, wrong) = (folder.join("cut.glb"), folder.join("wrong.glb"));
    fs::write(&cut, &good[..good.len() / 2])?;
    fs::write(&wrong, [&good[..good.len() - 4], &[0xff, 0xff, 0xff, 0x7f]].concat())?;
    for rubbish in [cut, wrong] {
        if judge(&[rubbish])?.code == Some(0) {
            bail!("the judge passes rubbish, so its word is worth nothing");
        }
    }
    Ok(Outcome::Passed(format!("the glTF validator has no word against {} files", files.len())))
}

/// The page of a comparison, opened in a browser: its script runs to the end, and what it writes is there.
pub(crate) fn page() -> Result<Outcome> {
    let browser = match tools::chromium() {
        Ok(browser) => browser,
        Err(error) if tree::on_build_server() => return Err(error),
        Err(error) => return Ok(Outcome::Skipped(format!("{error:#}"))),
    };
    let folder = tree::scratch("judges")?;
    let page = folder.join("comparison.html");
    let mut compare = Command::new(tree::fairpath()?);
    process::run(compare.arg("compare").arg(tree::root().join("examples/hello.json")).arg("-o").arg(&page))?;
    let open = |page: &Path| {
        let mut command = Command::new(browser);
        command.args(["--headless=new", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=10000", "--dump-dom"]);
        let ran = process::capture(command.arg(format!("file://{}", page.display())))?;
        Ok::<_, anyhow::Error>(ran.text)
    };
    // Written by the script, the last of it after everything else.
    let missing = |shown: &str| {
        let marks = ["<td class=\"best\">", "aria-current=\"true\"", "class=\"cursor\"", "vector-effect", "6 methods"];
        marks.into_iter().find(|mark| !shown.contains(mark))
    };
    if let Some(mark) = missing(&open(&page)?) {
        bail!("the page does not show {mark}: its script did not run to the end");
    }
    let broken = folder.join("broken.html");
    let text = fs::read_to_string(&page)?;
    fs::write(&broken, text.replace("function figures()", "function figures("))?;
    if missing(&open(&broken)?).is_none() {
        bail!("the judge passes a broken script, so its word is worth nothing");
    }
    Ok(Outcome::Passed("the page of a comparison runs in a browser".into()))
}

fn fitted_example() -> Result<(PathBuf, PathBuf)> {
    let folder = tree::scratch("judges")?;
    let spline = folder.join("hello.json");
    let mut fit = Command::new(tree::fairpath()?);
    fit.arg("fit").arg(tree::root().join("examples/hello.json")).arg("-o").arg(&spline);
    process::run(&mut fit)?;
    Ok((spline, folder))
}

fn convert(spline: &Path, out: &Path) -> Result<()> {
    process::run(Command::new(tree::fairpath()?).arg("convert").arg(spline).arg("-o").arg(out))
}
