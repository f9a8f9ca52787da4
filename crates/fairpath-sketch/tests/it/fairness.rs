//! What the slider does: the stroke itself at one end, the preset in the middle, ever fairer to the other end.

use crate::common::{corpus, wave};
use fairpath_curve::Kind;
use fairpath_fit::{Closing, Preset, Stroke};
use fairpath_io::shipped_templates;
use fairpath_sketch::{Method, Neatening, Settings};

#[test]
fn in_the_middle_options_are_exactly_those_of_the_preset() {
    for method in Method::ALL {
        for preset in Preset::ALL {
            let neatening = Neatening { method, preset, ..Neatening::default() };
            assert_eq!(neatening.settings().unwrap(), Settings::of(method, preset));
        }
    }
}

#[test]
fn size_and_closing_are_those_of_the_stroke_wherever_the_slider_is() {
    for method in Method::ALL {
        for fairness in [0.1, 0.5, 0.93] {
            let neatening =
                Neatening { method, fairness, pixel_size: 0.25, closed: Closing::No, ..Neatening::default() };
            let mut settings = neatening.settings().unwrap();
            assert_eq!(settings.stroke(), Some((&mut 0.25, &mut Closing::No)));
        }
    }
}

#[test]
fn names_are_those_of_files() {
    for method in Method::ALL {
        assert_eq!(serde_json::to_value(method).unwrap(), method.name());
        assert_eq!(Method::from_name(method.name()), Some(method));
    }
    for preset in Preset::ALL {
        assert_eq!(serde_json::to_value(preset).unwrap(), preset.name());
        assert_eq!(Preset::from_name(preset.name()), Some(preset));
    }
}

#[test]
fn at_the_left_end_a_curve_is_its_points() {
    let mut points = wave();
    points.insert(7, points[6]);
    for method in Method::ALL {
        let settings = Neatening { method, fairness: 0.0, ..Neatening::default() }.settings().unwrap();
        let (fit, _) = settings.fit(&Stroke::new("wave", points.clone()), None, &mut ()).unwrap();
        let segments = fit.spline.segments();
        assert!(segments.iter().all(|segment| segment.kind() == Kind::Line));
        let mut expected = points.clone();
        expected.dedup();
        let starts: Vec<_> = segments.iter().map(|segment| segment.start).collect();
        assert_eq!(starts, expected[..expected.len() - 1]);
        let end = fit.spline.end_pose().point;
        assert!((end - expected[expected.len() - 1]).hypot() < 1e-12);
    }
}

/// Mean deviation in px and mean number of pieces over the strokes, at a place of the slider.
fn means(strokes: &[Stroke], method: Method, fairness: f64) -> [f64; 2] {
    let templates = shipped_templates("burmester");
    let settings = Neatening { method, fairness, ..Neatening::default() }.settings().unwrap();
    let mut sums = [0.0; 2];
    for stroke in strokes {
        let (fit, _) = settings.fit(stroke, templates.as_ref(), &mut ()).expect("it can be fitted");
        sums[0] += fit.report.rms_deviation;
        sums[1] += fit.report.pieces as f64;
    }
    sums.map(|sum| sum / strokes.len() as f64)
}

#[test]
fn to_the_right_curves_get_simpler_and_further_from_their_strokes() {
    let Some(strokes) = corpus("synthetic.json") else { return };
    for method in Method::ALL {
        let places = [0.1, 0.3, 0.5, 0.75, 1.0];
        let figures = places.map(|place| means(&strokes, method, place));
        for (place, [rms, pieces]) in places.iter().zip(&figures) {
            eprintln!("{:16} {place:4}  rms {rms:6.3} px  pieces {pieces:6.2}", method.name());
        }
        for pair in figures.windows(2) {
            let [[rms, pieces], [next_rms, next_pieces]] = [pair[0], pair[1]];
            assert!(next_rms > rms, "{method:?}: {figures:?}");
            assert!(next_pieces <= pieces, "{method:?}: {figures:?}");
        }
    }
}
