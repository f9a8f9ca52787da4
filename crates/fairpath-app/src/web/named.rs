//! Where in the window everything lies that has a name: for judges, who press what is called so and not what lies there today.

use eframe::egui::{Context, FullOutput, Plugin, Pos2, Rect, accesskit};

/// Something with a name.
#[derive(Clone, Debug)]
pub(super) struct Place {
    /// What a screen reader would say.
    pub(super) name: String,
    /// Where it is, in points of the screen.
    pub(super) rect: Rect,
}

/// Everything that has a name in the frame that is shown; nothing at the first call, which begins to gather it.
pub(super) fn places(ctx: &Context) -> Vec<Place> {
    if ctx.plugin_opt::<Named>().is_none() {
        ctx.add_plugin(Named::default());
        ctx.request_repaint();
    }
    ctx.plugin::<Named>().lock().places.clone()
}

/// Takes the names from the tree that the interface makes for screen readers, of which eframe tells no browser.
#[derive(Default)]
struct Named {
    places: Vec<Place>,
}

impl Plugin for Named {
    fn debug_name(&self) -> &'static str {
        "names"
    }

    fn setup(&mut self, ctx: &Context) {
        ctx.enable_accesskit();
    }

    fn output_hook(&mut self, _: &Context, output: &mut FullOutput) {
        if let Some(update) = &output.platform_output.accesskit_update {
            self.places = update.nodes.iter().filter_map(|(_, node)| place(node)).collect();
        }
    }
}

/// A label tells its text as a value.
fn place(node: &accesskit::Node) -> Option<Place> {
    let bounds = node.bounds()?;
    let name = node.label().or(node.value()).filter(|name| !name.is_empty())?.to_owned();
    let corner = |x: f64, y: f64| Pos2::new(x as f32, y as f32);
    Some(Place { name, rect: Rect::from_min_max(corner(bounds.x0, bounds.y0), corner(bounds.x1, bounds.y1)) })
}
