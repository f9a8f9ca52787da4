//! The small view of an inflated surface: drag turns it, the wheel or two fingers come nearer, a double click goes back to where it began.
//!
//! It draws with the device that the interface draws with, into a texture, and only when something has changed.

use eframe::egui::{
    self, Color32, EventFilter, Key, Modifiers, PointerButton, Pos2, Rect, Response, Role, Sense, StrokeKind,
    TextureId, Ui, Vec2, WidgetInfo,
};
use eframe::{egui_wgpu, wgpu};
use fairpath_io::YAxis as FileAxis;
use fairpath_render::{Camera, Finish, GpuMesh, Look, RenderError, SurfaceRenderer, YAxis};
use fairpath_shape::Mesh;
use std::f64::consts::PI;
use std::sync::Arc;

/// What it is called where it cannot be seen.
const NAME: &str = "Inflated surface";
/// What a drag across the height of the view turns the surface by, radians: from the front to the back.
const TURN_PER_HEIGHT_RAD: f64 = PI;
/// What a press of an arrow turns by, radians (7.5 degrees).
const TURN_PER_KEY_RAD: f64 = PI / 24.0;
/// How much nearer a press of plus comes.
const ZOOM_PER_KEY: f64 = 1.2;
/// Scrolling by so many points doubles the size.
const POINTS_PER_DOUBLING: f64 = 240.0;

/// A surface that can be turned.
pub struct SurfaceView {
    state: egui_wgpu::RenderState,
    renderer: SurfaceRenderer,
    /// The mesh that is shown, with its y axis, on the device.
    shown: Option<(Arc<Mesh>, FileAxis, GpuMesh)>,
    camera: Camera,
    texture: Option<TextureId>,
    /// What the texture shows.
    drawn: Option<Shot>,
    pictures: u64,
}

/// Everything that a picture of one mesh depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shot {
    camera: Camera,
    size_px: [u32; 2],
    look: Look,
}

impl SurfaceView {
    /// A view that draws with the device of the interface, `Frame::wgpu_render_state` or `CreationContext::wgpu_render_state`.
    #[must_use]
    pub fn new(state: &egui_wgpu::RenderState) -> Self {
        Self {
            renderer: SurfaceRenderer::new(&state.adapter, &state.device, &state.queue),
            state: state.clone(),
            shown: None,
            camera: Camera::default(),
            texture: None,
            drawn: None,
            pictures: 0,
        }
    }

    /// Shows `mesh` in all the room that `ui` has left, in the colours of its theme.
    ///
    /// `y` is where the y axis of the mesh points. The mesh is copied to the device when it is another one, by its address, than the time before;
    /// the camera keeps its direction then.
    ///
    /// # Errors
    /// [`RenderError`] where the mesh cannot be drawn; there is nothing in the room then.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        mesh: &Arc<Mesh>,
        y: FileAxis,
        finish: Finish,
    ) -> Result<Response, RenderError> {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, NAME));
        let size_px = self.pixels(ui, rect.size());
        let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
        self.take(mesh, y, aspect)?;
        self.read_pointer(ui, &response);
        self.read_keys(ui, &response);
        if response.double_clicked() || key(ui, &response, Key::Home) {
            self.reset(aspect);
        }
        self.draw(Shot { camera: self.camera, size_px, look: look(ui, finish) })?;
        self.paint(ui, rect, &response);
        Ok(response)
    }

    /// Where the camera stands.
    #[must_use]
    pub fn camera(&self) -> Camera {
        self.camera
    }

    /// How many pictures were drawn so far.
    #[must_use]
    pub fn pictures(&self) -> u64 {
        self.pictures
    }

    /// Pixels of a place on the screen, at least one and no more than the device can.
    fn pixels(&self, ui: &Ui, size: Vec2) -> [u32; 2] {
        let most = self.state.device.limits().max_texture_dimension_2d;
        let scale = ui.ctx().pixels_per_point();
        // Casts of floats saturate, and make nothing of what is no number.
        [size.x, size.y].map(|side| ((side * scale).round() as u32).clamp(1, most))
    }

    fn take(&mut self, mesh: &Arc<Mesh>, y: FileAxis, aspect: f64) -> Result<(), RenderError> {
        if self.shown.as_ref().is_some_and(|(shown, axis, _)| Arc::ptr_eq(shown, mesh) && *axis == y) {
            return Ok(());
        }
        self.shown = None;
        self.drawn = None;
        let axis = match y {
            FileAxis::Up => YAxis::Up,
            FileAxis::Down => YAxis::Down,
        };
        let uploaded = self.renderer.upload(&[&**mesh], axis)?;
        self.camera = self.camera.fitted_to(&uploaded.bounds(), aspect);
        self.shown = Some((Arc::clone(mesh), y, uploaded));
        Ok(())
    }

    fn reset(&mut self, aspect: f64) {
        if let Some((_, _, mesh)) = &self.shown {
            self.camera = Camera::default().fitted_to(&mesh.bounds(), aspect);
        }
    }

    fn read_pointer(&mut self, ui: &Ui, response: &Response) {
        let height = f64::from(response.rect.height().max(1.0));
        let [right, down] = [response.drag_delta().x, response.drag_delta().y].map(|by| f64::from(by) / height);
        let pans = ui.input(|i| i.modifiers.shift) || !response.dragged_by(PointerButton::Primary);
        if response.dragged() && pans {
            self.camera = self.camera.panned(right, down);
        } else if response.dragged() {
            self.camera = self.camera.orbited(right * TURN_PER_HEIGHT_RAD, down * TURN_PER_HEIGHT_RAD);
        }
        if response.hovered() {
            let (pinch, scroll) = ui.input(|i| (i.zoom_delta(), i.smooth_scroll_delta()));
            let wheel = (f64::from(scroll.y) / POINTS_PER_DOUBLING).exp2();
            self.camera = self.camera.zoomed(f64::from(pinch) * wheel);
            ui.set_cursor_icon(if response.dragged() { egui::CursorIcon::Grabbing } else { egui::CursorIcon::Grab });
        }
    }

    fn read_keys(&mut self, ui: &Ui, response: &Response) {
        // Or else arrows would move the focus on.
        let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
        let turn = TURN_PER_KEY_RAD;
        let turns = [
            (Key::ArrowLeft, -turn, 0.0),
            (Key::ArrowRight, turn, 0.0),
            (Key::ArrowUp, 0.0, -turn),
            (Key::ArrowDown, 0.0, turn),
        ];
        for (arrow, right, down) in turns {
            if key(ui, response, arrow) {
                self.camera = self.camera.orbited(right, down);
            }
        }
        for (sign, factor) in [(Key::Plus, ZOOM_PER_KEY), (Key::Equals, ZOOM_PER_KEY), (Key::Minus, 1.0 / ZOOM_PER_KEY)]
        {
            if key(ui, response, sign) {
                self.camera = self.camera.zoomed(factor);
            }
        }
    }

    fn draw(&mut self, shot: Shot) -> Result<(), RenderError> {
        let Some((_, _, mesh)) = &self.shown else { return Ok(()) };
        if self.drawn == Some(shot) {
            return Ok(());
        }
        let drawn = self.renderer.render(mesh, &shot.camera, shot.size_px, &shot.look)?;
        if drawn.is_new_texture {
            let (device, smooth) = (&self.state.device, wgpu::FilterMode::Linear);
            let mut interface = self.state.renderer.write();
            match self.texture {
                Some(id) => interface.update_egui_texture_from_wgpu_texture(device, drawn.view, smooth, id),
                None => self.texture = Some(interface.register_native_texture(device, drawn.view, smooth)),
            }
        }
        self.drawn = Some(shot);
        self.pictures += 1;
        Ok(())
    }

    fn paint(&self, ui: &Ui, rect: Rect, response: &Response) {
        let Some(texture) = self.texture else { return };
        let all = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        ui.painter().image(texture, rect, all, Color32::WHITE);
        if response.has_focus() {
            ui.painter().rect_stroke(rect, 0.0, ui.visuals().selection.stroke, StrokeKind::Inside);
        }
    }
}

impl Drop for SurfaceView {
    fn drop(&mut self) {
        if let Some(texture) = self.texture {
            self.state.renderer.write().free_texture(&texture);
        }
    }
}

/// Whether a key was pressed for the view; nobody else gets it then.
fn key(ui: &Ui, response: &Response, key: Key) -> bool {
    response.has_focus() && ui.input_mut(|i| i.consume_key(Modifiers::NONE, key))
}

/// The look of the interface's theme, on the colour of its windows.
fn look(ui: &Ui, finish: Finish) -> Look {
    let visuals = ui.visuals();
    let room = if visuals.dark_mode { Look::dark() } else { Look::light() };
    let [r, g, b, _] = visuals.window_fill.to_array();
    Look { background: [r, g, b], finish, ..room }
}
