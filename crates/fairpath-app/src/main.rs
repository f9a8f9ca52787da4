//! The desktop's program.

#[cfg(not(target_arch = "wasm32"))]
mod desktop;

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    desktop::run()
}

/// In a browser the page starts the library.
#[cfg(target_arch = "wasm32")]
fn main() {}
