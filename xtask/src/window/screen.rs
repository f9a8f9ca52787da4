//! A screen that nobody sees: Debian's Xvfb on a free display, and what a window needs to be drawn on it.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use anyhow::{Context, Result, bail};

use crate::{process, tools};

/// Size of the screen, pixels: larger than the window.
const SIZE: &str = "1360x900x24";

/// Libraries that the window loads when it starts, by Debian's names: no program that is built here tells that it needs them.
const LIBRARIES: [(&str, &str); 6] = [
    ("libX11.so.6", "libx11-6"),
    ("libX11-xcb.so.1", "libx11-xcb1"),
    ("libXcursor.so.1", "libxcursor1"),
    ("libXi.so.6", "libxi6"),
    ("libxkbcommon.so.0", "libxkbcommon0"),
    ("libxkbcommon-x11.so.0", "libxkbcommon-x11-0"),
];

/// A screen; it goes with its value.
#[derive(Debug)]
pub(crate) struct Screen {
    server: Option<Child>,
    /// Its name, such as `:1`.
    name: String,
}

impl Screen {
    /// Installs what is missing, as far as that can be done here.
    pub(crate) fn prepare() -> Result<()> {
        if !cfg!(target_os = "linux") {
            bail!("a window is driven on Linux only");
        }
        if tools::path_of("Xvfb").is_err() {
            tools::apt("xvfb")?;
        }
        let known = process::capture(Command::new("/sbin/ldconfig").arg("-p"))?.text;
        for (library, package) in LIBRARIES {
            if !known.contains(library) {
                tools::apt(package)?;
            }
        }
        tools::graphics()?;
        Ok(())
    }

    /// A new screen.
    pub(crate) fn start() -> Result<Self> {
        let mut server = Command::new("Xvfb")
            // It takes a display that is free and says which.
            .args(["-displayfd", "1", "-screen", "0", SIZE, "-nolisten", "tcp", "-noreset"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .context("cannot start Xvfb")?;
        let mut number = String::new();
        let stdout = server.stdout.take().context("no pipe to standard output")?;
        BufReader::new(stdout).read_line(&mut number).context("Xvfb does not say which display it has")?;
        if number.trim().is_empty() {
            let ended = server.wait().context("cannot wait for Xvfb")?;
            bail!("Xvfb ended with {ended}");
        }
        Ok(Self { server: Some(server), name: format!(":{}", number.trim()) })
    }

    /// The screen that a person sits at.
    pub(crate) fn of_person() -> Result<Self> {
        let name = std::env::var("DISPLAY").context("no DISPLAY is set, so there is no X screen here")?;
        Ok(Self { server: None, name })
    }

    /// What programs know it by.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Has a program draw on this screen: by the driver that draws in software if the screen is none, since others want a real one.
    pub(crate) fn dress(&self, command: &mut Command) {
        command.env("DISPLAY", &self.name).env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
        if self.server.is_none() {
            return;
        }
        command.env("WGPU_BACKEND", "vulkan");
        let arch = std::env::consts::ARCH;
        let driver = format!("/usr/share/vulkan/icd.d/lvp_icd.{arch}.json");
        if Path::new(&driver).is_file() {
            // The second is the name that older loaders know.
            command.env("VK_DRIVER_FILES", &driver).env("VK_ICD_FILENAMES", &driver);
        }
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        if let Some(server) = &mut self.server {
            // It may have ended already.
            let _ = server.kill();
            let _ = server.wait();
        }
    }
}
