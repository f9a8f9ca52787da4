//! What the fitter must reach on each file of the shared data folder.
//!
//! The figures are those that `cargo xtask evaluate` reads from the evaluator's summary. Most are what the best known
//! implementation of the method reaches with its own parameters; the rest is what a user would call a mistake.
//! Timings have no limit here: they depend on the machine.

use serde_json::Value;

/// The limits of one file.
pub(crate) struct Limits {
    /// The file's name.
    pub(crate) file: &'static str,
    /// A figure of the summary and the largest value that it may have.
    pub(crate) most: &'static [(&'static str, f64)],
}

/// Limits that hold for every file. Distances are in px.
pub(crate) const EVERY_FILE: &[(&str, f64)] = &[("missing", 0.0), ("faulty", 0.0), ("dev_max", 8.0), ("rev_max", 8.0)];

/// Limits of single files.
pub(crate) const LIMITS: &[Limits] = &[
    Limits {
        file: "synthetic.json",
        most: &[
            ("segments", 222.0),
            ("dev_rms_mean", 0.826),
            ("truth_rms_mean", 0.834),
            ("missed_corners", 0.0),
            ("extra_corners", 1.0),
        ],
    },
    Limits { file: "quickdraw.json", most: &[("segments", 1157.0), ("dev_rms_mean", 1.037)] },
    Limits { file: "omniglot.json", most: &[("segments", 1637.0), ("dev_rms_mean", 1.5), ("corners", 299.0)] },
    Limits { file: "wacom.json", most: &[("segments", 368.0), ("dev_rms_mean", 0.507)] },
    Limits { file: "perfect.json", most: &[("segments", 108.0), ("dev_rms_mean", 1.45)] },
    // The long strokes are smooth by construction: any corner is an extra one.
    Limits { file: "long.json", most: &[("segments", 446.0), ("dev_rms_mean", 2.0), ("corners", 0.0)] },
];

/// The only reason for which a stroke of these files may have no curve.
pub(crate) const ALLOWED_REFUSAL: &str = "too-short";

/// Every limit that the evaluator's summary of a file breaks, in words.
pub(crate) fn breaches(file: &str, summary: &Value) -> Vec<String> {
    let own = LIMITS.iter().filter(|limits| limits.file == file).flat_map(|limits| limits.most);
    EVERY_FILE
        .iter()
        .chain(own)
        .filter_map(|&(figure, most)| match summary[figure].as_f64() {
            Some(value) if value <= most => None,
            Some(value) => Some(format!("{figure} is {value}, more than {most}")),
            None => Some(format!("{figure} is missing from the evaluator's summary")),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_good_summary_breaks_nothing() {
        let summary =
            json!({"missing": 0, "faulty": 0, "dev_max": 8.0, "rev_max": 1.0, "segments": 368, "dev_rms_mean": 0.5});
        assert_eq!(breaches("wacom.json", &summary), Vec::<String>::new());
    }

    #[test]
    fn each_limit_can_be_broken() {
        let summary =
            json!({"missing": 1, "faulty": 0, "dev_max": 8.1, "rev_max": 1.0, "segments": 369, "dev_rms_mean": 0.5});
        let said = breaches("wacom.json", &summary);
        assert_eq!(
            said,
            ["missing is 1, more than 0", "dev_max is 8.1, more than 8", "segments is 369, more than 368"]
        );
    }

    #[test]
    fn a_figure_that_was_not_measured_is_a_breach() {
        let said = breaches("hwrt.json", &json!({"missing": 0, "faulty": 0, "dev_max": 1.0}));
        assert_eq!(said, ["rev_max is missing from the evaluator's summary"]);
        assert!(!breaches("hwrt.json", &json!({"missing": 0, "faulty": 0, "dev_max": null, "rev_max": 0})).is_empty());
    }
}
