//! Pictures of pages for the documents, taken by a browser. They differ a little from browser to browser, so no test compares them.

use std::process::Command;

use anyhow::{Result, bail};

use crate::{process, tools, tree};

/// Writes `docs/comparison.png`: every method on one of the synthetic strokes.
pub(crate) fn run() -> Result<()> {
    process::run(&mut process::cargo(&["build", "--release", "--package", "fairpath"]))?;
    let browser = tools::chromium()?;
    let page = tree::scratch("pictures")?.join("comparison.html");
    let mut compare = Command::new(tree::fairpath()?);
    process::run(compare.arg("compare").arg(tree::strokes().join("synthetic.json")).arg("-o").arg(&page))?;
    let picture = tree::root().join("docs/comparison.png");
    let mut shoot = Command::new(browser);
    shoot.args(["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--window-size=1240,1180"]);
    shoot.arg("--virtual-time-budget=10000").arg(format!("--screenshot={}", picture.display()));
    let ran = process::capture(shoot.arg(format!("file://{}#stroke=closed_squiggle&view=alone", page.display())))?;
    if ran.code != Some(0) || !picture.is_file() {
        bail!("{browser} took no picture: {}", ran.text);
    }
    println!("wrote docs/comparison.png");
    Ok(())
}
