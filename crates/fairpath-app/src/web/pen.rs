//! The pen at the device's own rate. The user interface hears of at most one place per frame, in whole pixels; a stroke wants all of
//! them, as exact as they were measured, with their times and pressures.

use std::cell::RefCell;
use std::mem;

use eframe::egui;
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;
use web_sys::{AddEventListenerOptions, Element, HtmlCanvasElement, PointerEvent};

use crate::pen::{PenFilter, PenKind, PenPhase, PenReport, PenSample};

#[wasm_bindgen]
extern "C" {
    /// A pointer event as browsers give it: with fractions of pixels, and not always with what it was made of.
    #[wasm_bindgen(extends = PointerEvent)]
    type ExactPointerEvent;

    #[wasm_bindgen(method, getter, js_name = clientX)]
    fn exact_x(this: &ExactPointerEvent) -> f64;

    #[wasm_bindgen(method, getter, js_name = clientY)]
    fn exact_y(this: &ExactPointerEvent) -> f64;

    /// Safari learnt this in version 18.2 only.
    #[wasm_bindgen(catch, method, js_name = getCoalescedEvents)]
    fn coalesced(this: &ExactPointerEvent) -> Result<js_sys::Array, JsValue>;
}

/// What the listeners heard and the application has not yet asked for.
#[derive(Default)]
struct Heard {
    filter: PenFilter,
    samples: Vec<PenSample>,
}

thread_local! {
    static HEARD: RefCell<Heard> = RefCell::default();
}

/// All samples since the last call, in the order of their times. Places are in points of the user interface from the canvas's corner.
#[must_use]
pub fn drain() -> Vec<PenSample> {
    HEARD.with_borrow_mut(|heard| mem::take(&mut heard.samples))
}

/// Listens to the pointers over `canvas` for as long as the page lives.
///
/// # Errors
/// What the browser says if it takes no listener.
pub(super) fn listen(canvas: &HtmlCanvasElement, ctx: &egui::Context) -> Result<(), JsValue> {
    let phases = [
        ("pointerdown", PenPhase::Down),
        ("pointermove", PenPhase::Move),
        ("pointerup", PenPhase::Up),
        ("pointercancel", PenPhase::Cancel),
    ];
    for (name, phase) in phases {
        let (on, ctx) = (canvas.clone(), ctx.clone());
        let listener = Closure::<dyn FnMut(ExactPointerEvent)>::new(move |event| hear(&event, phase, &on, &ctx));
        // In the capturing phase: what comes of an event must wait here before any other listener draws a frame for it.
        let options = AddEventListenerOptions::new();
        options.set_capture(true);
        canvas.add_event_listener_with_callback_and_add_event_listener_options(
            name,
            listener.as_ref().unchecked_ref(),
            &options,
        )?;
        listener.forget();
    }
    Ok(())
}

fn hear(event: &ExactPointerEvent, phase: PenPhase, canvas: &HtmlCanvasElement, ctx: &egui::Context) {
    let kind = match event.pointer_type().as_str() {
        "pen" => PenKind::Pen,
        "touch" => PenKind::Touch,
        _ => PenKind::Mouse,
    };
    if phase == PenPhase::Down {
        // Or a stroke that leaves the canvas would never end. A pointer that is gone already cannot be held, and need not be.
        let _ = canvas.set_pointer_capture(event.pointer_id());
    }
    let frame = Frame::of(canvas, ctx);
    let draws = event.button() == 0;
    HEARD.with_borrow_mut(|heard| {
        let before = heard.samples.len();
        let mut take = |event: &ExactPointerEvent| {
            let sample = frame.sample(event, kind, phase);
            heard.filter.take(PenReport { pointer: event.pointer_id(), draws, sample }, &mut heard.samples);
        };
        let parts = if phase == PenPhase::Move { event.coalesced().unwrap_or_default() } else { js_sys::Array::new() };
        if parts.length() == 0 {
            take(event);
        }
        for part in parts.iter() {
            take(part.unchecked_ref());
        }
        if heard.samples.len() > before {
            ctx.request_repaint();
        }
    });
}

/// Where the canvas lies in the window, and how large a point of its user interface is.
struct Frame {
    left: f64,
    top: f64,
    zoom: f64,
}

impl Frame {
    fn of(canvas: &Element, ctx: &egui::Context) -> Self {
        let rect = canvas.get_bounding_client_rect();
        Self { left: rect.left(), top: rect.top(), zoom: f64::from(ctx.zoom_factor()) }
    }

    fn sample(&self, event: &ExactPointerEvent, kind: PenKind, phase: PenPhase) -> PenSample {
        PenSample {
            x: (event.exact_x() - self.left) / self.zoom,
            y: (event.exact_y() - self.top) / self.zoom,
            time_s: event.time_stamp() / 1000.0,
            pressure: Some(event.pressure()),
            kind,
            phase,
        }
    }
}
