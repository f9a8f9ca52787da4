//! The desktop window.

#[cfg(not(target_arch = "wasm32"))]
fn main() -> eframe::Result {
    let options = eframe::NativeOptions {
        viewport: eframe::egui::ViewportBuilder::default()
            .with_title("Fairpath")
            .with_app_id("fairpath")
            .with_inner_size([1280.0, 820.0])
            .with_min_inner_size([480.0, 360.0]),
        ..Default::default()
    };
    eframe::run_native(
        "fairpath",
        options,
        Box::new(|creation| Ok(Box::new(fairpath_app::App::on_desktop(&creation.egui_ctx)))),
    )
}

/// In a browser the page starts the library.
#[cfg(target_arch = "wasm32")]
fn main() {}
