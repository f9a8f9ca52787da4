//! Pictures for the documents: of pages, taken by a browser, and of the application, drawn by the graphics device. They differ a little from one to the
//! other, so no test compares them.

use std::fs;
use std::process::Command;
use std::time::Duration;

use anyhow::{Result, bail};
use serde_json::json;

use crate::web::{Kind, Server, Toolchain};
use crate::{judge_web, process, tools, tree, web};

/// How long the browser may take for the pictures of the application's page.
const PAGE_LIMIT: Duration = Duration::from_secs(300);

/// Draws all of them anew.
pub(crate) fn run() -> Result<()> {
    comparison()?;
    application()?;
    page()
}

/// Writes `docs/web-*.png`: the application's page in a browser, led there by mouse, keys and files.
fn page() -> Result<()> {
    let (browser, packages) = judge_web::tools_ready()?;
    let server = Server::start(&web::build(Kind::Quick, Toolchain::Auto)?.folder, 0)?;
    let root = tree::root();
    let task = json!({
        "url": server.url(), "browser": browser, "examples": root.join("examples"), "out": root.join("docs"),
    });
    let file = tree::scratch("pictures")?.join("page.json");
    fs::write(&file, task.to_string())?;
    let mut shoot = Command::new("node");
    shoot.arg(root.join("xtask/judges/web/pictures.mjs")).arg(file).current_dir(packages);
    let ran = process::capture_within(&mut shoot, PAGE_LIMIT)?;
    print!("{}", ran.text);
    if ran.code != Some(0) {
        bail!("the pictures of the page were not taken");
    }
    Ok(())
}

/// Writes `docs/app-*.png`: the application in the states that the documents tell of.
fn application() -> Result<()> {
    tools::graphics()?;
    // The build of the tests is at hand, and fast enough.
    let example = ["run", "--quiet", "--example", "pictures", "--"];
    process::run(process::cargo(&example).arg(tree::root().join("docs")))
}

/// Writes `docs/comparison.png`: every method on one of the synthetic strokes.
fn comparison() -> Result<()> {
    process::build(&["fairpath"])?;
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
