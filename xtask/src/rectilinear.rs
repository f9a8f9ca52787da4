//! Whether straight French curves make drawings straight: McCrae and Singh (2011, section 5) expect it of a set of lines and angles.

use std::fs;
use std::process::Command;

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::steps::{Outcome, Steps};
use crate::{process, tree};

/// Drawings by hand of which, and so many of which, must come out straight with corners; 68 did when this was set.
const DRAWINGS: (&str, usize) = ("quickdraw.json", 40);

/// The drawing that must come out straight with four corners.
const RECTANGLE: (&str, &str) = ("synthetic.json", "sharp_rect");

/// Adds the step; where the shared data folder is absent, one that says so.
pub(crate) fn add_step(steps: &mut Steps) {
    steps.step("French curves: straight drawings", || {
        if !tree::strokes().join(DRAWINGS.0).exists() {
            let missing = format!("no {} in the shared data folder", DRAWINGS.0);
            if tree::on_build_server() { bail!("{missing}") } else { return Ok(Outcome::Skipped(missing)) }
        }
        let straight = fitted(DRAWINGS.0)?.iter().filter(|spline| corners_if_straight(spline) >= Some(2)).count();
        if straight < DRAWINGS.1 {
            bail!(
                "{straight} drawings of {} are straight with two corners or more, at least {} should be",
                DRAWINGS.0,
                DRAWINGS.1
            );
        }
        let synthetic = fitted(RECTANGLE.0)?;
        let rectangle = synthetic.iter().find(|spline| spline["name"] == RECTANGLE.1);
        if rectangle.and_then(corners_if_straight) != Some(4) {
            bail!("{} is not straight with four corners", RECTANGLE.1);
        }
        Ok(Outcome::Passed(format!("{straight} drawings with two corners or more and the rectangle are straight")))
    });
}

/// The splines of a file's strokes, drawn with lines and right angles as the paper does.
fn fitted(name: &str) -> Result<Vec<Value>> {
    let out = tree::scratch("rectilinear")?.join(name);
    let mut fit = Command::new(tree::fairpath()?);
    fit.arg("fit").arg(tree::strokes().join(name)).arg("-o").arg(&out);
    fit.args(["--method", "french-curve", "--templates", "rectilinear", "--set", "mode=faithful"]);
    let ran = process::capture(&mut fit)?;
    if !matches!(ran.code, Some(0 | 1)) {
        bail!("{} ended with {:?}:\n{}", process::shown(&fit), ran.code, ran.text);
    }
    let text = fs::read(&out).with_context(|| format!("cannot read {}", out.display()))?;
    let file: Value = serde_json::from_slice(&text).with_context(|| format!("{} is no JSON", out.display()))?;
    Ok(file["splines"].as_array().cloned().unwrap_or_default())
}

/// How many corners a spline of nothing but lines has; nothing if it has anything else.
fn corners_if_straight(spline: &Value) -> Option<usize> {
    let all = |key: &str| spline[key].as_array().into_iter().flatten();
    all("segments").all(|segment| segment["kind"] == "line").then(|| all("joins").filter(|join| *join == "G0").count())
}

#[cfg(test)]
mod tests {
    use super::corners_if_straight;
    use serde_json::json;

    #[test]
    fn only_what_is_all_lines_is_straight() {
        let spline = |kinds: [&str; 2], joins: [&str; 1]| {
            let segments = kinds.map(|kind| json!({"kind": kind}));
            json!({"segments": segments, "joins": joins})
        };
        assert_eq!(corners_if_straight(&spline(["line", "line"], ["G0"])), Some(1));
        assert_eq!(corners_if_straight(&spline(["line", "line"], ["G1"])), Some(0));
        assert_eq!(corners_if_straight(&spline(["line", "arc"], ["G0"])), None);
    }
}
