//! The bar below: methods, presets, every option from the schema, French curves.

use crate::hands::{app, arch, draw, empty_app, press, release, session};
use eframe::egui::{Event, Key, Pos2, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use fairpath_app::App;
use fairpath_sketch::{Method, Settings};

fn choose(app: &mut Harness<'_, App>, list: &str, entry: &str) {
    app.get_by_label(list).click();
    app.run_steps(3);
    app.get_by_label(entry).click();
    app.run_steps(3);
}

/// An S of two arcs.
fn bend() -> Vec<Pos2> {
    let at = |i: usize| {
        let a = std::f32::consts::PI * i as f32 / 60.0;
        if i <= 60 {
            pos2(400.0 - 70.0 * a.sin(), 250.0 - 70.0 * a.cos() + 70.0)
        } else {
            pos2(400.0 - 70.0 * a.sin(), 250.0 + 210.0 + 70.0 * a.cos() - 70.0 + 140.0)
        }
    };
    (0..=60).map(at).collect()
}

#[test]
fn each_method_can_be_chosen_and_fits_the_selected_curve() {
    let titles = [
        (Method::ShortestPath, "Shortest path"),
        (Method::CurvatureSpace, "Curvature space"),
        (Method::FrenchCurve, "French curves"),
        (Method::Laplacian, "Laplacian"),
        (Method::Cubic, "Cubic Béziers"),
        (Method::Mvc, "Least variation"),
    ];
    let mut app = empty_app();
    draw(&mut app, &bend());
    let id = session(&app).drawing().curves()[0].id;
    app.state_mut().session_mut().select(Some(id), false);
    app.run_steps(2);
    // The first is chosen already; each of the others, and the first again.
    for (method, title) in titles.into_iter().skip(1).chain([titles[0]]) {
        choose(&mut app, "Method", title);
        let curve = &session(&app).drawing().curves()[0];
        assert_eq!(curve.neatening.method, method);
        assert!(curve.fitted, "{title}");
        assert!(curve.report.rms_deviation < 3.0, "{title}: {:?}", curve.report);
        assert_eq!(session(&app).history().undoable(), Some("Neaten"));
    }
}

#[test]
fn every_option_of_every_method_has_a_field_of_its_name() {
    for title in ["Curvature space", "French curves", "Laplacian", "Cubic Béziers", "Least variation", "Shortest path"]
    {
        let mut app = empty_app();
        if title != "Shortest path" {
            choose(&mut app, "Method", title);
        }
        app.get_by_label("All options").click();
        app.run_steps(4);
        let settings: Settings = session(&app).neatening().settings().unwrap();
        let mut fields = 0;
        for parameter in settings.parameters() {
            if ["pixel_size", "closed"].contains(&parameter.name.as_str()) {
                continue;
            }
            let mut words = parameter.name.replace('_', " ");
            words[..1].make_ascii_uppercase();
            // One that is not allowed at present has the switch that allows it.
            let fields_of = app.query_all_by_label_contains(&words).count();
            assert!(fields_of >= 2, "{title}: {words} has a name and a field");
            fields += 1;
        }
        assert!(fields > 0, "{title}");
    }
}

#[test]
fn an_option_that_is_switched_is_set_and_all_as_usual_takes_it_back() {
    let mut app = empty_app();
    app.get_by_label("All options").click();
    app.run_steps(4);
    let refine = app.get_all_by_label("Refine").last().expect("a field");
    refine.scroll_to_me();
    app.run_steps(4);
    app.get_all_by_label("Refine").last().unwrap().click();
    app.run_steps(3);
    assert_eq!(session(&app).neatening().set.get("refine"), Some(&false.into()));
    app.get_by_label("All as usual").click();
    app.run_steps(3);
    assert!(session(&app).neatening().set.is_empty());
}

#[test]
fn french_curves_are_laid_while_a_stroke_is_drawn() {
    let mut app = empty_app();
    choose(&mut app, "Method", "French curves");
    app.get_by_label("Lay French curves while drawing").click();
    app.run_steps(2);
    let long: Vec<Pos2> =
        (0..240).map(|i| i as f32).map(|x| pos2(150.0 + 3.0 * x, 350.0 + 90.0 * (x / 30.0).sin())).collect();
    press(&mut app, long[0]);
    for chunk in long[1..].chunks(4) {
        chunk.iter().for_each(|&point| app.event(Event::PointerMoved(point)));
        app.step();
    }
    assert!(!session(&app).hand().unwrap().committed().is_empty(), "parts are certain before the pen is lifted");
    release(&mut app, long[239]);
    let curve = &session(&app).drawing().curves()[0];
    let used = curve.templates.as_ref().expect("it is made of French curves");
    assert!(!used.pieces.is_empty());
}

#[test]
fn a_selected_curve_becomes_a_french_curve_that_others_are_made_of() {
    let mut app = empty_app();
    draw(&mut app, &bend());
    let id = session(&app).drawing().curves()[0].id;
    choose(&mut app, "Method", "French curves");
    app.state_mut().session_mut().select(Some(id), false);
    app.run_steps(2);
    choose(&mut app, "Method", "French curves");
    app.get_by_label("Make the selected curve a French curve").click();
    app.run_steps(3);
    assert_eq!(session(&app).neatening().templates, "mine");
    app.state_mut().session_mut().select(None, false);
    app.run_steps(2);
    draw(&mut app, &arch(750.0, 300.0, 60.0));
    let used = session(&app).drawing().curves().last().unwrap().templates.clone().expect("French curves");
    assert_eq!(used.set, "mine");
}

#[test]
fn the_plot_shows_the_selected_curve_and_marks_its_place_on_the_canvas() {
    let mut app = app();
    let id = session(&app).drawing().curves()[0].id;
    app.state_mut().session_mut().select(Some(id), false);
    app.run_steps(2);
    let before = app.get_by_label("Canvas").rect().height();
    app.key_press(Key::Num4);
    app.run_steps(4);
    assert!(app.get_by_label("Canvas").rect().height() < before - 80.0, "the plot lies under the canvas");
    app.key_press(Key::Num4);
    app.run_steps(4);
    assert_eq!(app.get_by_label("Canvas").rect().height(), before);
}
