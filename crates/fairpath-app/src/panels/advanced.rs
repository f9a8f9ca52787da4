//! Every option of the method, from its schema: name, value, unit and what it means.

use super::{MARGIN, float};
use crate::app::App;
use eframe::egui::{
    Align2, Button, Checkbox, ComboBox, DragValue, Grid, Response, RichText, Role, ScrollArea, Ui, WidgetInfo, vec2,
};
use fairpath_sketch::{Kind, Neatening, Parameter};
use serde_json::Value;

/// Size of the panel, points.
const WIDTH: f32 = 330.0;
const HEIGHT: f32 = 380.0;

/// Options that have places of their own elsewhere.
const ELSEWHERE: [&str; 2] = ["pixel_size", "closed"];

/// Shows the options.
pub(crate) fn show(app: &mut App, ui: &Ui) {
    if !app.panels.advanced {
        return;
    }
    let mut wish = app.session.neatening().clone();
    // What is set here is set over preset and slider; these tell what it would be otherwise.
    let usual = Neatening { set: Default::default(), ..wish.clone() };
    let (Ok(now), Ok(usual)) = (wish.settings(), usual.settings()) else { return };
    let (values, usual) = (now.values(), usual.values());
    float(ui, "advanced", Align2::CENTER_BOTTOM, vec2(0.0, -MARGIN - 52.0), |ui| {
        ui.set_width(WIDTH);
        ui.horizontal(|ui| {
            ui.label(RichText::new("Options").heading());
            let any = !wish.set.is_empty();
            if ui.add_enabled(any, Button::new("All as usual")).clicked() {
                wish.set.clear();
            }
        });
        ScrollArea::vertical().max_height(HEIGHT).auto_shrink([false, true]).show(ui, |ui| {
            Grid::new("options").num_columns(2).spacing([12.0, 4.0]).show(ui, |ui| {
                for parameter in
                    now.parameters().iter().filter(|parameter| !ELSEWHERE.contains(&parameter.name.as_str()))
                {
                    let name = parameter.name.as_str();
                    let label = if wish.set.contains_key(name) {
                        RichText::new(said(name)).strong()
                    } else {
                        RichText::new(said(name))
                    };
                    ui.label(label).on_hover_text(explained(parameter, &usual[name]));
                    if let Some(value) = field(ui, parameter, &values[name]) {
                        if value == usual[name] {
                            wish.set.remove(name)
                        } else {
                            wish.set.insert(name.into(), value)
                        };
                    }
                    ui.end_row();
                }
            });
        });
    });
    if wish != *app.session.neatening() {
        app.session.set_neatening(wish);
    }
}

/// What an option means, and what it is unless it is set here.
fn explained(parameter: &Parameter, usual: &Value) -> String {
    let usual = match usual {
        Value::Null => "not allowed".into(),
        Value::String(word) => said(word).to_lowercase(),
        Value::Bool(on) => if *on { "on" } else { "off" }.into(),
        number => match (number.as_f64().map_or_else(|| number.to_string(), short), parameter.unit.as_str()) {
            (number, "1") => number,
            (number, unit) => format!("{number} {unit}"),
        },
    };
    format!("{}\n\nUsually: {usual}", parameter.description)
}

/// The name of an option as a person reads it.
fn said(name: &str) -> String {
    let words = name.replace('_', " ");
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A field for an option; its new value if it was changed.
fn field(ui: &mut Ui, parameter: &Parameter, value: &Value) -> Option<Value> {
    let name = said(&parameter.name);
    let named = |response: &Response, role: Role| response.widget_info(|| WidgetInfo::labeled(role, true, &name));
    ui.horizontal(|ui| match &parameter.kind {
        Kind::Bool => {
            let mut on = value.as_bool().unwrap_or_default();
            let response = ui.add(Checkbox::without_text(&mut on));
            named(&response, Role::CheckBox);
            response.changed().then_some(Value::Bool(on))
        }
        Kind::Choice(words) => {
            let mut word = value.as_str().unwrap_or_default().to_owned();
            let before = word.clone();
            let response =
                ComboBox::from_id_salt(&parameter.name).width(120.0).selected_text(said(&word)).show_ui(ui, |ui| {
                    for choice in words {
                        ui.selectable_value(&mut word, choice.clone(), said(choice));
                    }
                });
            named(&response.response, Role::ComboBox);
            (word != before).then_some(Value::String(word))
        }
        Kind::Integer => {
            let mut number = value.as_u64().unwrap_or_default();
            let response = ui.add(DragValue::new(&mut number).speed(0.2));
            named(&response, Role::SpinButton);
            unit(ui, parameter);
            response.changed().then(|| number.into())
        }
        Kind::Number { nullable } => number(ui, parameter, value, *nullable, &name),
    })
    .inner
}

/// A field for a number, which may be none at all where the option allows that.
fn number(ui: &mut Ui, parameter: &Parameter, value: &Value, nullable: bool, name: &str) -> Option<Value> {
    let mut changed = None;
    if nullable {
        let mut some = !value.is_null();
        let response = ui.add(Checkbox::without_text(&mut some)).on_hover_text("Allowed");
        response.widget_info(|| WidgetInfo::labeled(Role::CheckBox, true, format!("{name} allowed")));
        if response.changed() {
            let usual = parameter.default.as_f64().unwrap_or(10.0);
            changed = Some(if some { usual.into() } else { Value::Null });
        }
    }
    if let Some(mut number) = value.as_f64() {
        let speed = (number.abs() * 0.01).max(0.001);
        let response = ui.add(DragValue::new(&mut number).speed(speed).custom_formatter(|number, _| short(number)));
        response.widget_info(|| WidgetInfo::labeled(Role::SpinButton, true, name));
        unit(ui, parameter);
        if response.changed() {
            changed = Some(number.into());
        }
    }
    changed
}

/// A number with no more digits than it needs.
fn short(number: f64) -> String {
    let text = format!("{number:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn unit(ui: &mut Ui, parameter: &Parameter) {
    if parameter.unit != "1" {
        ui.weak(&parameter.unit);
    }
}
