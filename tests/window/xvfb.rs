//! A display of its own, and hands and eyes on it: real X events, and what the window's pixels really are.

use std::io::{BufRead, BufReader, IoSlice};
use std::process::{Child, Command, Stdio};

use x11rb::connection::{Connection, RequestConnection};
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    AtomEnum, ConfigureWindowAux, ConnectionExt, CreateWindowAux, ImageFormat, InputFocus, MapState, Window,
    WindowClass,
};
use x11rb::rust_connection::RustConnection;

use crate::support::patience::Patience;

/// An X server without a screen.
pub struct Xvfb {
    server: Child,
    /// As in the environment variable `DISPLAY`.
    pub name: String,
    connection: RustConnection,
    root: Window,
    /// The first byte of a request to the extension that fakes input.
    xtest: u8,
}

/// What a window shows: r, g, b of each pixel, row by row.
#[derive(Clone, PartialEq)]
pub struct Screenshot {
    pub width: u32,
    pub height: u32,
    pub pixels: Vec<[u8; 3]>,
}

const KEY: u8 = 2;
const BUTTON: u8 = 4;
const MOTION: u8 = 6;

impl Xvfb {
    /// Starts a server on a display that is free.
    pub fn start() -> Self {
        let mut command = Command::new("Xvfb");
        command.args(["-displayfd", "1", "-screen", "0", "1100x800x24", "-nolisten", "tcp"]);
        let spawned = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null()).spawn();
        let mut server = spawned.expect("this test needs Xvfb: `sh setup.sh --tests` installs it");
        let mut line = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let name = format!(":{}", line.trim());
        let (connection, screen) = x11rb::connect(Some(&name)).expect("Xvfb takes connections");
        let root = connection.setup().roots[screen].root;
        let xtest = connection.query_extension(b"XTEST").unwrap().reply().unwrap().major_opcode;
        Self { server, name, connection, root, xtest }
    }

    /// The window whose title holds a text, if one is shown by now: one that is not can't be given the keyboard.
    pub fn window(&self, title: &str) -> Option<Window> {
        let tree = self.connection.query_tree(self.root).unwrap().reply().unwrap();
        tree.children.into_iter().find(|window| self.is_shown(*window) && self.title(*window).contains(title))
    }

    fn is_shown(&self, window: Window) -> bool {
        let attributes = self.connection.get_window_attributes(window).unwrap().reply();
        attributes.is_ok_and(|attributes| attributes.map_state == MapState::VIEWABLE)
    }

    pub fn title(&self, window: Window) -> String {
        let property = self.connection.get_property(false, window, AtomEnum::WM_NAME, AtomEnum::ANY, 0, 1000);
        let reply = property.unwrap().reply();
        reply.map_or(String::new(), |reply| String::from_utf8_lossy(&reply.value).into_owned())
    }

    /// Has the window hear the keyboard, as a window manager would.
    pub fn focus(&self, window: Window) {
        self.connection.set_input_focus(InputFocus::PARENT, window, x11rb::CURRENT_TIME).unwrap().check().unwrap();
    }

    pub fn resize(&self, window: Window, width: u32, height: u32) {
        let size = ConfigureWindowAux::new().width(width).height(height);
        self.connection.configure_window(window, &size).unwrap().check().unwrap();
    }

    /// Moves the pointer on the root window, whose top left is also that of a window without a manager.
    pub fn point(&self, x: i16, y: i16) {
        self.fake(MOTION, 0, x, y);
    }

    pub fn button(&self, button: u8, down: bool) {
        self.fake(BUTTON + u8::from(!down), button, 0, 0);
    }

    /// Presses and lets go of a key, by its keysym.
    pub fn key(&self, keysym: u32) {
        self.hold(keysym, true);
        self.hold(keysym, false);
    }

    /// Presses a key, or lets go of it.
    pub fn hold(&self, keysym: u32, down: bool) {
        let (least, most) = (self.connection.setup().min_keycode, self.connection.setup().max_keycode);
        let mapping = self.connection.get_keyboard_mapping(least, most - least + 1).unwrap().reply().unwrap();
        let keys = mapping.keysyms.chunks(usize::from(mapping.keysyms_per_keycode));
        let place = keys.into_iter().position(|syms| syms.first() == Some(&keysym)).expect("the keyboard has the key");
        self.fake(KEY + u8::from(!down), least + place as u8, 0, 0);
    }

    /// `XTestFakeInput`. Written out, since the extension's code in x11rb is a feature that would be winit's, too.
    fn fake(&self, kind: u8, detail: u8, x: i16, y: i16) {
        const MINOR: u8 = 2;
        let mut request = [0u8; 36];
        request[..6].copy_from_slice(&[self.xtest, MINOR, 9, 0, kind, detail]);
        request[12..16].copy_from_slice(&self.root.to_le_bytes());
        request[24..26].copy_from_slice(&x.to_le_bytes());
        request[26..28].copy_from_slice(&y.to_le_bytes());
        if cfg!(target_endian = "big") {
            panic!("this request is written for little-endian machines");
        }
        self.connection.send_request_without_reply(&[IoSlice::new(&request)], Vec::new()).unwrap().check().unwrap();
    }

    /// The text that a program offers on the clipboard; none where none does.
    pub fn clipboard(&self) -> Option<String> {
        let connection = &self.connection;
        let atom = |name: &str| connection.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom;
        let (clipboard, utf8, property) = (atom("CLIPBOARD"), atom("UTF8_STRING"), atom("LUCERNA_TEST"));
        let asker = connection.generate_id().unwrap();
        let (depth, visual) = (x11rb::COPY_DEPTH_FROM_PARENT, x11rb::COPY_FROM_PARENT);
        let (class, values) = (WindowClass::INPUT_OUTPUT, CreateWindowAux::new());
        connection.create_window(depth, asker, self.root, 0, 0, 1, 1, 0, class, visual, &values).unwrap();
        connection.convert_selection(asker, clipboard, utf8, property, x11rb::CURRENT_TIME).unwrap();
        connection.flush().unwrap();
        let answer = loop {
            if let Event::SelectionNotify(answer) = connection.wait_for_event().unwrap() {
                break answer;
            }
        };
        if answer.property == x11rb::NONE {
            return None;
        }
        let reply = connection.get_property(false, asker, property, AtomEnum::ANY, 0, 10_000).unwrap().reply().unwrap();
        String::from_utf8(reply.value).ok()
    }

    pub fn screenshot(&self, window: Window) -> Screenshot {
        let size = self.connection.get_geometry(window).unwrap().reply().unwrap();
        let image =
            self.connection.get_image(ImageFormat::Z_PIXMAP, window, 0, 0, size.width, size.height, !0).unwrap();
        // A screen of 24 bits has four bytes a pixel: b, g, r and one that is nothing.
        let pixels = image.reply().unwrap().data.chunks_exact(4).map(|p| [p[2], p[1], p[0]]).collect();
        Screenshot { width: size.width.into(), height: size.height.into(), pixels }
    }
}

impl Drop for Xvfb {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

impl Screenshot {
    /// Its left part, of a width: what a window that was made narrower keeps until it is drawn.
    pub fn narrowed(&self, width: u32) -> Screenshot {
        let rows = self.pixels.chunks(self.width as usize);
        Self { width, height: self.height, pixels: rows.flat_map(|row| row[..width as usize].to_vec()).collect() }
    }

    /// Whether nothing was drawn yet.
    pub fn is_black(&self) -> bool {
        self.pixels.iter().all(|pixel| *pixel == [0; 3])
    }

    /// Mean absolute difference of codes, of pictures of one size.
    pub fn difference(&self, other: &Screenshot) -> f64 {
        assert_eq!((self.width, self.height), (other.width, other.height));
        let codes = self.pixels.as_flattened().iter().zip(other.pixels.as_flattened());
        codes.map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / (3 * self.pixels.len()) as f64
    }

    /// A PNG file.
    pub fn read(path: &std::path::Path) -> Self {
        let picture = image::open(path).unwrap().into_rgb8();
        let (width, height) = picture.dimensions();
        Self { width, height, pixels: picture.pixels().map(|pixel| pixel.0).collect() }
    }

    pub fn write(&self, path: &std::path::Path) {
        image::save_buffer(path, self.pixels.as_flattened(), self.width, self.height, image::ColorType::Rgb8).unwrap();
    }
}

/// Waits until something is there that a process makes; fails with `what` once that no longer gets on.
#[track_caller]
pub fn await_some<T>(process: u32, what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let mut patience = Patience::with(process);
    loop {
        if let Some(found) = look() {
            return found;
        }
        patience.wait(what);
    }
}
