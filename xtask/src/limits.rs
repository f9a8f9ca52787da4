//! What the fitter must reach on each file of the shared data folder, and what it is held to where it does not yet.
//!
//! The figures are those that `cargo xtask evaluate` reads from the evaluator's summary. Most goals are what the best known
//! implementation of the method reaches with its own parameters; the rest is what a user would call a mistake. A goal
//! that is not reached has an exception: a value a little above what is reached now, which fails the run when it is
//! passed. An exception that is no longer needed fails the run too, so that none outlives its reason.
//! Timings have no limit here: they depend on the machine.

use std::fmt;

use serde_json::Value;

/// What is wanted of one figure of the summary.
pub(crate) struct Limit {
    /// Its key in the summary.
    pub(crate) figure: &'static str,
    /// The largest value that is wanted.
    pub(crate) goal: f64,
    /// Where the goal is not reached yet: the largest value that it may have meanwhile.
    pub(crate) held: Option<f64>,
}

const fn reached(figure: &'static str, goal: f64) -> Limit {
    Limit { figure, goal, held: None }
}

/// A goal that is not reached yet, and the value that must not be exceeded meanwhile.
const fn short(figure: &'static str, goal: f64, held: f64) -> Limit {
    Limit { figure, goal, held: Some(held) }
}

/// Limits of the usual method that hold for every file that has none of its own for the figure. Distances are in px.
pub(crate) const EVERY_FILE: &[Limit] =
    &[reached("missing", 0.0), reached("faulty", 0.0), reached("dev_max", 8.0), reached("rev_max", 8.0)];

/// The method that is used where none is asked for.
pub(crate) const USUAL_METHOD: &str = "shortest-path";

/// Limits of the other methods, for every file: every stroke has a sound curve.
const OTHER_METHODS: &[Limit] = &[reached("missing", 0.0), reached("faulty", 0.0)];

/// Limits of the other methods for single files. Curvature space keeps within one and a half times of what shortest paths reach.
const OTHER_FILES: &[(&str, &str, &[Limit])] =
    &[("curvature-space", "synthetic.json", &[reached("dev_rms_mean", 1.5 * 0.791)])];

/// Limits of single files for the usual method.
const FILES: &[(&str, &[Limit])] = &[
    (
        "synthetic.json",
        &[
            reached("segments", 222.0),
            reached("dev_rms_mean", 0.826),
            reached("truth_rms_mean", 0.834),
            reached("missed_corners", 0.0),
            short("extra_corners", 1.0, 6.0),
        ],
    ),
    ("quickdraw.json", &[reached("segments", 1157.0), reached("dev_rms_mean", 1.037)]),
    ("omniglot.json", &[reached("segments", 1637.0), reached("dev_rms_mean", 1.5), reached("corners", 299.0)]),
    ("wacom.json", &[reached("segments", 368.0), reached("dev_rms_mean", 0.507)]),
    ("perfect.json", &[reached("segments", 108.0), reached("dev_rms_mean", 1.45)]),
    // The long strokes are smooth by construction: any corner is an extra one.
    ("long.json", &[short("segments", 446.0, 590.0), reached("dev_rms_mean", 2.0), short("corners", 0.0, 9.0)]),
];

/// The only reason for which a stroke of these files may have no curve.
pub(crate) const ALLOWED_REFUSAL: &str = "too-short";

/// A goal that is not reached, and is not expected to be yet.
#[derive(Debug, PartialEq)]
pub(crate) struct Short {
    figure: &'static str,
    value: f64,
    goal: f64,
}

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is {}, the goal is {}", self.figure, self.value, self.goal)
    }
}

/// How the summary of a file stands against its limits.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Held {
    /// Limits that are broken and exceptions that are no longer needed, in words.
    pub(crate) broken: Vec<String>,
    /// Goals that are not reached, within their exceptions.
    pub(crate) short: Vec<Short>,
    /// Every figure above its goal, excepted or not.
    pub(crate) above: Vec<&'static str>,
}

/// Holds the evaluator's summary of a file against its limits.
pub(crate) fn hold(method: &str, file: &str, summary: &Value) -> Held {
    let usual = FILES.iter().map(|&(name, limits)| (USUAL_METHOD, name, limits));
    let others = OTHER_FILES.iter().copied();
    let own =
        usual.chain(others).filter(|&(by, name, _)| by == method && name == file).flat_map(|(_, _, limits)| limits);
    let every = if method == USUAL_METHOD { EVERY_FILE } else { OTHER_METHODS };
    let general = every.iter().filter(|limit| !own.clone().any(|o| o.figure == limit.figure));
    let mut held = Held::default();
    for &Limit { figure, goal, held: exception } in general.chain(own.clone()) {
        let most = exception.unwrap_or(goal);
        if summary[figure].as_f64().is_some_and(|value| value > goal) {
            held.above.push(figure);
        }
        match summary[figure].as_f64() {
            Some(value) if value > most => held.broken.push(format!("{figure} is {value}, more than {most}")),
            Some(value) if value > goal => held.short.push(Short { figure, value, goal }),
            Some(value) if exception.is_some() => held
                .broken
                .push(format!("{figure} is {value}, goal reached: remove the exception from {goal} in {}", file!())),
            Some(_) => {}
            None => held.broken.push(format!("{figure} is missing from the evaluator's summary")),
        }
    }
    held
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_good_summary_breaks_nothing() {
        let summary =
            json!({"missing": 0, "faulty": 0, "dev_max": 8.0, "rev_max": 1.0, "segments": 368, "dev_rms_mean": 0.5});
        assert_eq!(hold(USUAL_METHOD, "wacom.json", &summary), Held::default());
    }

    #[test]
    fn each_limit_can_be_broken() {
        let summary =
            json!({"missing": 1, "faulty": 0, "dev_max": 8.1, "rev_max": 1.0, "segments": 369, "dev_rms_mean": 0.5});
        let said = hold(USUAL_METHOD, "wacom.json", &summary).broken;
        assert_eq!(
            said,
            ["missing is 1, more than 0", "dev_max is 8.1, more than 8", "segments is 369, more than 368"]
        );
    }

    #[test]
    fn a_figure_that_was_not_measured_is_a_breach() {
        let said = hold(USUAL_METHOD, "hwrt.json", &json!({"missing": 0, "faulty": 0, "dev_max": 1.0})).broken;
        assert_eq!(said, ["rev_max is missing from the evaluator's summary"]);
        let unmeasured = json!({"missing": 0, "faulty": 0, "dev_max": null, "rev_max": 0});
        assert!(!hold(USUAL_METHOD, "hwrt.json", &unmeasured).broken.is_empty());
    }

    #[test]
    fn other_methods_are_held_to_soundness_on_every_file_and_to_more_on_some() {
        let summary = json!({"missing": 0, "faulty": 0, "dev_max": 30.0, "rev_max": 30.0, "dev_rms_mean": 1.2});
        assert_eq!(hold("french-curve", "synthetic.json", &summary), Held::default());
        assert_eq!(hold("curvature-space", "wacom.json", &summary), Held::default());
        assert_eq!(hold("curvature-space", "synthetic.json", &summary).broken.len(), 1);
        let faulty = json!({"missing": 1, "faulty": 2});
        assert_eq!(hold("french-curve", "wacom.json", &faulty).broken.len(), 2);
    }

    #[test]
    fn every_exception_is_weaker_than_its_goal_and_cannot_outlive_it() {
        for (file, limits) in FILES {
            for limit in limits.iter().filter(|limit| limit.held.is_some()) {
                let most = limit.held.unwrap();
                assert!(most > limit.goal, "{file}: {}", limit.figure);
                let at = |value: f64| {
                    let held = hold(USUAL_METHOD, file, &json!({ limit.figure: value }));
                    let broken =
                        held.broken.iter().any(|said| said.starts_with(&format!("{} is {value}", limit.figure)));
                    (broken, held.short.iter().any(|short| short.figure == limit.figure))
                };
                assert_eq!(at(limit.goal), (true, false), "{file}: {} reached", limit.figure);
                assert_eq!(at(most), (false, true), "{file}: {} held", limit.figure);
                assert_eq!(at(most + 1.0), (true, false), "{file}: {} broken", limit.figure);
            }
        }
    }
}
