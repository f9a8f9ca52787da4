//! The view of a surface in an interface that is drawn: colours, hands, keys, and when it draws.

use eframe::egui::{self, Key, Modifiers, PointerButton, Pos2, Theme, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use fairpath_app::SurfaceView;
use fairpath_curve::{Continuity, Point, Segment, Spline};
use fairpath_io::YAxis;
use fairpath_render::{Camera, Finish, Zebra};
use fairpath_shape::{InflateOptions, Mesh, inflate};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

const SIZE: Vec2 = Vec2::new(320.0, 240.0);
const NAME: &str = "Inflated surface";

/// An interface that is nothing but the view.
struct Whole {
    view: SurfaceView,
    mesh: Arc<Mesh>,
    finish: Finish,
}

impl eframe::App for Whole {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let Self { view, mesh, finish } = self;
        egui::CentralPanel::default().frame(egui::Frame::NONE).show(ui, |ui| {
            view.show(ui, mesh, YAxis::Down, *finish).expect("the mesh is sound");
        });
    }
}

fn ball(radius: f64) -> Arc<Mesh> {
    let arc = Segment::arc(Point::new(radius, 0.0), PI / 2.0, radius * TAU, 1.0 / radius);
    let circle = Spline::new(vec![arc], vec![Continuity::G1], true).expect("it is a circle");
    Arc::new(inflate(&circle, &InflateOptions::default()).expect("circles can be inflated").mesh)
}

fn harness(theme: Theme) -> Harness<'static, Whole> {
    let build = |creation: &mut eframe::CreationContext<'_>| {
        let state = creation.wgpu_render_state.as_ref().expect("the interface is drawn with wgpu");
        Whole { view: SurfaceView::new(state), mesh: ball(100.0), finish: Finish::Clay }
    };
    // Two clicks are a double click within a third of a second only, and a wheel takes a while to come to rest.
    let builder = Harness::builder().with_size(SIZE).with_theme(theme).with_step_dt(1.0 / 60.0).with_max_steps(120);
    let mut harness = builder.wgpu().build_eframe(build);
    harness.run();
    harness
}

fn camera(harness: &Harness<'_, Whole>) -> Camera {
    harness.state().view.camera()
}

fn drag(harness: &mut Harness<'_, Whole>, button: PointerButton, by: Vec2) {
    let from = Pos2::new(160.0, 120.0);
    let press = |pos, pressed| egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE };
    harness.event(egui::Event::PointerMoved(from));
    harness.event(press(from, true));
    harness.run();
    harness.event(egui::Event::PointerMoved(from + by));
    harness.run();
    harness.event(press(from + by, false));
    harness.run();
}

#[test]
fn colours_come_through_the_interface_as_they_are() {
    for theme in [Theme::Light, Theme::Dark] {
        let mut harness = harness(theme);
        let picture = harness.render().expect("it can be drawn");
        let fill = harness.ctx.style_of(theme).visuals.window_fill.to_array();
        assert_eq!(picture.get_pixel(3, 3).0[..3], fill[..3], "the background in {theme:?}");
        let [r, g, b, _] = picture.get_pixel(160, 120).0;
        assert!(r > g && g > b && r - b > 60, "terracotta in {theme:?}: {r}, {g}, {b}");
    }
}

#[test]
fn it_has_a_name_and_fills_its_room() {
    let harness = harness(Theme::Light);
    assert_eq!(harness.get_by_label(NAME).rect().size(), SIZE);
}

#[test]
fn it_draws_only_when_something_has_changed() {
    let mut harness = harness(Theme::Light);
    let count = |harness: &Harness<'_, Whole>| harness.state().view.pictures();
    let before = count(&harness);
    harness.run_steps(5);
    assert_eq!(count(&harness), before, "nothing has changed");
    let mut expect_one_more = |change: &dyn Fn(&mut Harness<'_, Whole>), what: &str| {
        let before = count(&harness);
        change(&mut harness);
        harness.run_steps(4);
        assert_eq!(count(&harness), before + 1, "{what}");
    };
    expect_one_more(&|h| h.state_mut().finish = Finish::Zebra(Zebra::default()), "another finish");
    expect_one_more(&|h| h.state_mut().mesh = ball(70.0), "another mesh");
    expect_one_more(
        &|h| {
            h.set_size(Vec2::new(200.0, 300.0));
        },
        "another size",
    );
    expect_one_more(&|h| h.ctx.set_theme(Theme::Dark), "another theme");
}

#[test]
fn a_drag_turns_and_a_drag_with_another_button_moves() {
    let mut harness = harness(Theme::Light);
    let before = camera(&harness);
    drag(&mut harness, PointerButton::Primary, Vec2::new(24.0, 12.0));
    let turned = camera(&harness);
    // A tenth and a twentieth of the height.
    assert!((turned.azimuth_rad() - (before.azimuth_rad() - 0.1 * PI)).abs() < 1e-6, "{turned:?}");
    assert!((turned.elevation_rad() - (before.elevation_rad() + 0.05 * PI)).abs() < 1e-6, "{turned:?}");
    assert_eq!((turned.target(), turned.distance()), (before.target(), before.distance()));
    drag(&mut harness, PointerButton::Middle, Vec2::new(24.0, 0.0));
    let moved = camera(&harness);
    assert_eq!(moved.azimuth_rad(), turned.azimuth_rad());
    assert!((moved.target() - turned.target()).length() > 1.0);
}

#[test]
fn the_wheel_comes_nearer_and_a_double_click_goes_back() {
    let mut harness = harness(Theme::Light);
    let before = camera(&harness);
    harness.hover_at(Pos2::new(160.0, 120.0));
    harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: Vec2::new(0.0, 120.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    harness.run();
    assert!(camera(&harness).distance() < 0.8 * before.distance(), "{:?}", camera(&harness));
    drag(&mut harness, PointerButton::Primary, Vec2::new(50.0, -30.0));
    assert_ne!(camera(&harness).axes(), before.axes());
    harness.get_by_label(NAME).click();
    harness.get_by_label(NAME).click();
    harness.run();
    assert_eq!(camera(&harness), before);
}

#[test]
fn arrows_turn_once_it_has_the_focus_and_home_goes_back() {
    let mut harness = harness(Theme::Light);
    let before = camera(&harness);
    harness.key_press(Key::Plus);
    harness.run();
    assert_eq!(camera(&harness), before, "keys are not for what has no focus");
    harness.get_by_label(NAME).focus();
    harness.run();
    for (arrow, right, down) in [(Key::ArrowRight, 1.0, 0.0), (Key::ArrowLeft, -1.0, 0.0), (Key::ArrowDown, 0.0, 1.0)] {
        let from = camera(&harness);
        harness.key_press(arrow);
        harness.run();
        let expected = from.orbited(right * PI / 24.0, down * PI / 24.0);
        assert_eq!(camera(&harness), expected, "{arrow:?}");
    }
    harness.key_press(Key::Plus);
    harness.run();
    assert!(camera(&harness).distance() < before.distance());
    assert!(harness.get_by_label(NAME).is_focused());
    harness.key_press(Key::Home);
    harness.run();
    assert_eq!(camera(&harness), before);
}
