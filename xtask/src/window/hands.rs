//! Hands and eyes on an X screen: moves of the pointer, its button and keys go in as those of devices do (the extension XTEST), pictures come out.

use std::io::IoSlice;

use anyhow::{Context, Result};
use x11rb::connection::{Connection as _, RequestConnection as _};
use x11rb::protocol::xproto::{
    AtomEnum, ClientMessageEvent, ConnectionExt as _, EventMask, ImageFormat, InputFocus, MapState, Window,
};
use x11rb::rust_connection::RustConnection;

use super::{Area, Picture, Place, Screen};

/// The extension that lets a program do what devices do, and its request that does one thing (its protocol, version 2.2).
const XTEST: &str = "XTEST";
const FAKE_INPUT: u8 = 2;

// What it calls that: the codes of the core protocol's events.
const KEY_PRESS: u8 = 2;
const KEY_RELEASE: u8 = 3;
const BUTTON_PRESS: u8 = 4;
const BUTTON_RELEASE: u8 = 5;
const MOTION: u8 = 6;

/// The button that draws.
const LEFT: u8 = 1;

/// A key by its keysym.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Key {
    /// A letter or a digit.
    Char(char),
    Control,
    Alt,
    Delete,
}

impl Key {
    fn keysym(self) -> u32 {
        match self {
            // Latin-1 is its own keysym.
            Self::Char(char) => u32::from(char),
            Self::Control => 0xffe3,
            Self::Alt => 0xffe9,
            Self::Delete => 0xffff,
        }
    }
}

/// Hands on one window.
pub(crate) struct Hands {
    connection: RustConnection,
    root: Window,
    window: Window,
    /// The window on the screen.
    area: Area,
    /// The code of the first key, and the keysyms of each key.
    keys: (u8, Vec<Vec<u32>>),
}

impl Hands {
    /// Hands on the window of that class, once it is shown; `None` before.
    pub(crate) fn on(screen: &Screen, class: &str) -> Result<Option<Self>> {
        let (connection, number) = x11rb::connect(Some(screen.name()))
            .with_context(|| format!("cannot reach the screen {}", screen.name()))?;
        let root = connection.setup().roots.get(number).context("the display has no such screen")?.root;
        let Some(window) = find(&connection, root, class)? else { return Ok(None) };
        let size = connection.get_geometry(window)?.reply()?;
        let at = connection.translate_coordinates(window, root, 0, 0)?.reply()?;
        let area = Area {
            left: i32::from(at.dst_x),
            top: i32::from(at.dst_y),
            width: i32::from(size.width),
            height: i32::from(size.height),
        };
        let (first, last) = (connection.setup().min_keycode, connection.setup().max_keycode);
        let mapping = connection.get_keyboard_mapping(first, last - first + 1)?.reply()?;
        let width = usize::from(mapping.keysyms_per_keycode).max(1);
        let keys = (first, mapping.keysyms.chunks(width).map(<[u32]>::to_vec).collect());
        let hands = Self { connection, root, window, area, keys };
        hands.focus()?;
        Ok(Some(hands))
    }

    /// Where no window manager does so, the keyboard is given to the window.
    fn focus(&self) -> Result<()> {
        self.connection.set_input_focus(InputFocus::PARENT, self.window, x11rb::CURRENT_TIME)?.check()?;
        Ok(())
    }

    /// The window, from its own upper left corner.
    pub(crate) fn area(&self) -> Area {
        Area { left: 0, top: 0, ..self.area }
    }

    /// What a device does. The request is laid out here: with the crate's own feature for it the window's libraries, which share that crate, would have to be
    /// built once more.
    fn fake(&self, event: u8, detail: u8, [x, y]: [i32; 2]) -> Result<()> {
        let extension = self.connection.extension_information(XTEST)?;
        let opcode = extension.context("the screen lacks the extension XTEST")?.major_opcode;
        let [x, y] = [x, y].map(|value| i16::try_from(value).unwrap_or(i16::MAX).to_ne_bytes());
        let mut request = [0; 36];
        // The length is in words of four bytes.
        request[..6].copy_from_slice(&[opcode, FAKE_INPUT, 0, 0, event, detail]);
        request[2..4].copy_from_slice(&9_u16.to_ne_bytes());
        request[12..16].copy_from_slice(&self.root.to_ne_bytes());
        request[24..26].copy_from_slice(&x);
        request[26..28].copy_from_slice(&y);
        let sent = self.connection.send_request_without_reply(&[IoSlice::new(&request)], Vec::new())?;
        // Done when this returns: what a connection sent last before it is closed can be lost, and then a button stays down.
        sent.check()?;
        Ok(())
    }

    /// Moves the pointer to a place in the window.
    pub(crate) fn move_to(&self, [x, y]: Place) -> Result<()> {
        self.fake(MOTION, 0, [self.area.left + x, self.area.top + y])
    }

    /// Presses the button that draws.
    pub(crate) fn press(&self) -> Result<()> {
        self.fake(BUTTON_PRESS, LEFT, [0, 0])
    }

    /// Lets it go.
    pub(crate) fn release(&self) -> Result<()> {
        self.fake(BUTTON_RELEASE, LEFT, [0, 0])
    }

    /// Holds a key down, or lets it go.
    pub(crate) fn hold(&self, key: Key, down: bool) -> Result<()> {
        let keysym = key.keysym();
        let (first, keys) = &self.keys;
        let at = keys.iter().position(|symbols| symbols.first() == Some(&keysym));
        let code = at.and_then(|at| u8::try_from(at + usize::from(*first)).ok());
        let code = code.with_context(|| format!("the keyboard has no key for {key:?}"))?;
        self.fake(if down { KEY_PRESS } else { KEY_RELEASE }, code, [0, 0])
    }

    /// Strikes a key, with Control or alone.
    pub(crate) fn strike(&self, key: Key, control: bool) -> Result<()> {
        if control {
            self.hold(Key::Control, true)?;
        }
        self.hold(key, true)?;
        self.hold(key, false)?;
        if control {
            self.hold(Key::Control, false)?;
        }
        Ok(())
    }

    /// What is seen of the window on the screen.
    pub(crate) fn picture(&self) -> Result<Picture> {
        let Area { left, top, width, height } = self.area;
        let [x, y] = [left, top].map(|value| i16::try_from(value).unwrap_or(0));
        let [wide, high] = [width, height].map(|value| u16::try_from(value).unwrap_or(0));
        let image = self.connection.get_image(ImageFormat::Z_PIXMAP, self.root, x, y, wide, high, !0)?.reply()?;
        Picture::from_bgrx(width, height, &image.data)
    }

    /// Asks the window to close, as a window manager does when a person presses the cross.
    pub(crate) fn ask_to_close(&self) -> Result<()> {
        let atom =
            |name: &str| -> Result<u32> { Ok(self.connection.intern_atom(false, name.as_bytes())?.reply()?.atom) };
        let data = [atom("WM_DELETE_WINDOW")?, x11rb::CURRENT_TIME, 0, 0, 0];
        let message = ClientMessageEvent::new(32, self.window, atom("WM_PROTOCOLS")?, data);
        self.connection.send_event(false, self.window, EventMask::NO_EVENT, message)?.check()?;
        Ok(())
    }
}

/// The window of that class that is shown, at `under` or below.
fn find(connection: &RustConnection, under: Window, class: &str) -> Result<Option<Window>> {
    for child in connection.query_tree(under)?.reply()?.children {
        let property = connection.get_property(false, child, AtomEnum::WM_CLASS, AtomEnum::STRING, 0, 64)?.reply();
        // A window may go while it is looked at.
        let Ok(property) = property else { continue };
        let names = property.value.split(|&byte| byte == 0).any(|name| name == class.as_bytes());
        if names && connection.get_window_attributes(child)?.reply()?.map_state == MapState::VIEWABLE {
            return Ok(Some(child));
        }
        if let Some(window) = find(connection, child, class)? {
            return Ok(Some(window));
        }
    }
    Ok(None)
}
