//! A job gives the same whether it goes to a thread or, as text, to a worker that shares no memory.

use crate::common::{beside, ring, wave};
use fairpath_curve::Point;
use fairpath_fit::{FitOptions, OversketchMode, OversketchOptions, Preset, Stroke, fit};
use fairpath_io::shipped_templates;
use fairpath_shape::InflateOptions;
use fairpath_sketch::{Answer, Job, Method, Neatening, Pin, run, run_encoded_job};
use proptest::prelude::*;
use std::sync::Arc;

fn fit_job(points: Vec<Point>, neatening: Neatening, pins: Vec<Pin>) -> Job {
    let templates = shipped_templates(&neatening.templates).map(Arc::new);
    Job::Fit { stroke: Stroke::new("stroke", points), neatening, templates, pins }
}

/// Jobs of every kind.
fn jobs() -> Vec<Job> {
    let stroke = |points| Stroke::new("stroke", points);
    let pin = Pin { share: 0.4, point: Point::new(170.0, 90.0) };
    let mut jobs = Vec::new();
    for method in Method::ALL {
        for fairness in [0.0, 0.5, 0.9] {
            let neatening = Neatening { method, fairness, ..Neatening::default() };
            jobs.push(fit_job(wave(), neatening.clone(), Vec::new()));
            jobs.push(fit_job(ring(), neatening, vec![pin]));
        }
    }
    for preset in Preset::ALL {
        jobs.push(fit_job(wave(), Neatening { preset, ..Neatening::default() }, Vec::new()));
    }
    let curve = fit(&stroke(wave()), &FitOptions::default()).unwrap().spline;
    for (preset, mode) in
        Preset::ALL.into_iter().zip([OversketchMode::ShortestPath, OversketchMode::Refit].iter().cycle())
    {
        let fit = FitOptions::preset(preset);
        let options = Box::new(OversketchOptions { fit, mode: *mode, ..OversketchOptions::default() });
        jobs.push(Job::Oversketch {
            spline: curve.clone(),
            stroke: stroke(beside(&curve, 60.0, 200.0, 15.0)),
            options,
        });
    }
    jobs.push(Job::Hold { spline: curve.clone(), stroke: stroke(wave()), pins: vec![pin], pixel_size: 1.0 });
    let closed = fit(&stroke(ring()), &FitOptions::default()).unwrap().spline;
    for spline in [closed, curve] {
        jobs.push(Job::Inflate { spline, options: InflateOptions { triangles: 300, ..InflateOptions::default() } });
    }
    // These fail, and the reason has to arrive as well.
    jobs.push(fit_job(vec![Point::ORIGIN; 4], Neatening::default(), Vec::new()));
    let set = [("error_cost".to_owned(), serde_json::json!(-1))].into();
    jobs.push(fit_job(wave(), Neatening { set, ..Neatening::default() }, Vec::new()));
    jobs
}

#[test]
fn an_encoded_job_gives_to_the_bit_what_the_job_gives() {
    let (mut curves, mut surfaces, mut failed) = (0, 0, 0);
    for job in jobs() {
        let here = run(&job);
        let there = run_encoded_job(&serde_json::to_string(&job).unwrap());
        // Numbers are written so that they read back to the same bits.
        assert_eq!(serde_json::to_string(&here).unwrap(), there);
        let back: Answer = serde_json::from_str(&there).unwrap();
        assert_eq!(back, here);
        match here {
            Answer::Curve(_) => curves += 1,
            Answer::Surface(_) => surfaces += 1,
            Answer::Failed(_) => failed += 1,
        }
    }
    assert_eq!((curves, surfaces, failed), (51, 1, 3));
}

fn code(answer: &str) -> String {
    match serde_json::from_str(answer).expect("every answer is an answer") {
        Answer::Failed(trouble) => trouble.code,
        _ => "none".into(),
    }
}

#[test]
fn a_truncated_job_is_answered_with_why_not() {
    let text = serde_json::to_string(&jobs()[0]).unwrap();
    for end in (0..text.len()).filter(|&end| text.is_char_boundary(end)).step_by(61) {
        assert_eq!(code(&run_encoded_job(&text[..end])), "bad-job", "{end}");
    }
}

proptest! {
    #[test]
    fn rubbish_is_answered_with_why_not(text in any::<String>()) {
        prop_assert_eq!(code(&run_encoded_job(&text)), "bad-job");
    }

    /// A job with one character changed is still answered, whatever that makes of it.
    #[test]
    fn a_damaged_job_is_answered(at in 0.0..1.0_f64, by in prop::sample::select(vec!["", "9", "-", "null", "\"", "}", "e300"])) {
        let points = vec![Point::new(0.0, 0.0), Point::new(10.0, 1.0), Point::new(20.0, 4.0), Point::new(30.0, 9.0)];
        let text = serde_json::to_string(&fit_job(points, Neatening::default(), Vec::new())).unwrap();
        let mut at = (at * text.len() as f64) as usize;
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        let end = at + text[at..].chars().next().map_or(0, char::len_utf8);
        code(&run_encoded_job(&format!("{}{by}{}", &text[..at], &text[end..])));
    }
}
