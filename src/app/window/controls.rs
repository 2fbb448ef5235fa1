//! Mouse and keyboard to what they mean. Knows the window library's events, and nothing of the scene.

use std::collections::HashSet;
use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use winit::event::{ElementState, KeyEvent, Modifiers, MouseButton, MouseScrollDelta, WindowEvent};
use winit::keyboard::{Key, KeyCode, NamedKey, PhysicalKey};

/// What a user wants.
#[derive(Clone, Debug, PartialEq)]
pub enum Intent {
    /// Radians.
    Orbit(DVec2),
    /// Heights of the picture.
    Pan(DVec2),
    /// The distance is multiplied by this.
    Zoom(f64),
    /// Pixels are shown twice as large so many times.
    Magnify(i32),
    /// To what is under the pointer.
    Focus,
    /// The mesh under the pointer.
    Select,
    /// The brightest paths of the pixel under the pointer, or to take them away.
    Paths,
    FrameAll,
    /// The member of the family that is so many places farther.
    Member(i32),
    /// A camera of the scene, by its place in the order of names, from 0.
    Camera(usize),
    Restart,
    Pause,
    /// Stops.
    Exposure(f32),
    /// Copy it, and print it.
    PrintCamera,
    /// Into the scene's file.
    SaveEdits,
    Help,
    Panel,
    Reload,
    /// Judge the last edit of the shaders, or end that.
    Judge,
    /// Show what was judged, before and after.
    Split,
    Fullscreen,
    Save,
    /// A key that means nothing, by what is written on it.
    Unknown(String),
    /// Or to take away what lies over the picture.
    Quit,
}

/// A line of the wheel multiplies the distance by this.
const ZOOM_LINE: f64 = 0.9;

/// Pixels of a smooth wheel that are a line.
const LINE_PIXELS: f64 = 40.0;

/// A drag over the height of the window multiplies the distance by e to this.
const ZOOM_DRAG: f64 = 3.0;

/// A hand that presses a button moves the pointer no farther, points: it clicks and does not drag.
const CLICK: f64 = 4.0;

/// Keys that fly while they are held, by their places on the keyboard: right, up, forward.
const FLIGHT: [(KeyCode, DVec3); 6] = [
    (KeyCode::KeyD, DVec3::X),
    (KeyCode::KeyA, DVec3::NEG_X),
    (KeyCode::KeyE, DVec3::Y),
    (KeyCode::KeyQ, DVec3::NEG_Y),
    (KeyCode::KeyW, DVec3::Z),
    (KeyCode::KeyS, DVec3::NEG_Z),
];

/// Keys that are pressed for what else is pressed with them, or for the desktop.
const SILENT: &[NamedKey] = &[
    NamedKey::Alt,
    NamedKey::AltGraph,
    NamedKey::CapsLock,
    NamedKey::Control,
    NamedKey::Fn,
    NamedKey::FnLock,
    NamedKey::NumLock,
    NamedKey::ScrollLock,
    NamedKey::Shift,
    NamedKey::Meta,
    NamedKey::Compose,
    NamedKey::PrintScreen,
];

/// What is held down, and where the pointer is.
#[derive(Debug, Default)]
pub struct Controls {
    held: HashSet<KeyCode>,
    drag: Option<MouseButton>,
    /// Where the left button was pressed, while that may become a click.
    click: Option<DVec2>,
    /// Pixels from the window's top left; none outside.
    pub cursor: Option<DVec2>,
    shift: bool,
    control: bool,
    /// What goes with S for saving: Control, or the key of that name on a Mac.
    command: bool,
}

impl Controls {
    /// Takes an event that the panel did not want. `height` of the window in pixels; `scale` is pixels a point.
    pub fn event(&mut self, event: &WindowEvent, height: f64, scale: f64) -> Option<Intent> {
        match event {
            WindowEvent::ModifiersChanged(modifiers) => self.modify(modifiers),
            WindowEvent::KeyboardInput { event, is_synthetic: false, .. } => return self.key(event),
            WindowEvent::MouseInput { state: ElementState::Pressed, button: MouseButton::Left, .. } if self.control => {
                return Some(Intent::Focus);
            }
            WindowEvent::MouseInput { state: ElementState::Pressed, button, .. } => {
                let may_click = *button == MouseButton::Left && self.drag.is_none() && !self.shift;
                self.click = self.cursor.filter(|_| may_click);
                self.drag = Some(*button);
            }
            WindowEvent::MouseInput { state: ElementState::Released, button: MouseButton::Left, .. } => {
                let clicked = self.click.take().map(|_| Intent::Select);
                self.let_go(event);
                return clicked;
            }
            WindowEvent::CursorMoved { position, .. } => {
                let at = DVec2::new(position.x, position.y);
                let mut from = self.cursor.replace(at);
                if let Some(pressed) = self.click {
                    if at.distance(pressed) <= CLICK * scale {
                        return None;
                    }
                    // A drag after all: the hand gets what it has moved so far.
                    self.click = None;
                    from = Some(pressed);
                }
                return self.dragged((at - from?) / height.max(1.0));
            }
            WindowEvent::MouseWheel { delta, .. } => {
                let lines = match delta {
                    MouseScrollDelta::LineDelta(_, y) => f64::from(*y),
                    MouseScrollDelta::PixelDelta(by) => by.y / LINE_PIXELS,
                };
                if self.control {
                    return Some(Intent::Magnify(lines.signum() as i32)).filter(|_| lines != 0.0);
                }
                return Some(Intent::Zoom(ZOOM_LINE.powf(lines.clamp(-20.0, 20.0))));
            }
            _ => self.let_go(event),
        }
        None
    }

    /// Takes an event that the panel wants for itself: only what ends is heard, so that nothing stays held.
    pub fn let_go(&mut self, event: &WindowEvent) {
        match event {
            WindowEvent::KeyboardInput {
                event: KeyEvent { physical_key: PhysicalKey::Code(code), state: ElementState::Released, .. },
                ..
            } => {
                self.held.remove(code);
            }
            WindowEvent::MouseInput { state: ElementState::Released, button, .. } if self.drag == Some(*button) => {
                (self.drag, self.click) = (None, None);
            }
            WindowEvent::CursorMoved { position, .. } => self.cursor = Some(DVec2::new(position.x, position.y)),
            WindowEvent::CursorLeft { .. } => self.cursor = None,
            WindowEvent::ModifiersChanged(modifiers) => self.modify(modifiers),
            WindowEvent::Focused(false) => {
                self.held.clear();
                (self.drag, self.click) = (None, None);
            }
            _ => {}
        }
    }

    fn modify(&mut self, modifiers: &Modifiers) {
        let state = modifiers.state();
        (self.shift, self.control) = (state.shift_key(), state.control_key());
        self.command = if cfg!(target_os = "macos") { state.super_key() } else { self.control };
    }

    /// Whether the scene is to be saved: by an event that the panel wants for itself, too.
    pub fn wants_save(&self, event: &WindowEvent) -> bool {
        matches!(event, WindowEvent::KeyboardInput { event, is_synthetic: false, .. } if self.wants_to_save(event))
    }

    fn wants_to_save(&self, event: &KeyEvent) -> bool {
        let is_s = matches!(&event.logical_key, Key::Character(text) if text.eq_ignore_ascii_case("s"));
        self.command && is_s && event.state == ElementState::Pressed && !event.repeat
    }

    /// Where the keys that are held fly to: right, up, forward.
    pub fn flight(&self) -> DVec3 {
        FLIGHT.iter().filter(|(key, _)| self.held.contains(key)).map(|(_, way)| *way).sum()
    }

    fn dragged(&self, by: DVec2) -> Option<Intent> {
        match self.drag? {
            MouseButton::Left if !self.shift => Some(Intent::Orbit(by * PI)),
            MouseButton::Left | MouseButton::Middle => Some(Intent::Pan(by)),
            MouseButton::Right => Some(Intent::Zoom((by.y * ZOOM_DRAG).exp())),
            _ => None,
        }
    }

    fn key(&mut self, event: &KeyEvent) -> Option<Intent> {
        let PhysicalKey::Code(code) = event.physical_key else { return None };
        if event.state == ElementState::Released {
            self.held.remove(&code);
            return None;
        }
        if self.command && matches!(event.logical_key, Key::Character(_)) {
            return self.wants_to_save(event).then_some(Intent::SaveEdits);
        }
        if FLIGHT.iter().any(|(key, _)| *key == code) {
            self.held.insert(code);
            return None;
        }
        if event.repeat {
            return None;
        }
        match &event.logical_key {
            Key::Named(named) => match named {
                NamedKey::F1 => Some(Intent::Help),
                NamedKey::F2 => Some(Intent::Panel),
                NamedKey::F5 => Some(Intent::Reload),
                NamedKey::F11 => Some(Intent::Fullscreen),
                NamedKey::F12 => Some(Intent::Save),
                NamedKey::Escape => Some(Intent::Quit),
                NamedKey::Space => Some(Intent::Pause),
                named if SILENT.contains(named) => None,
                named => Some(Intent::Unknown(format!("{named:?}"))),
            },
            Key::Character(text) => match text.to_lowercase().as_str() {
                "f" => Some(Intent::FrameAll),
                "r" => Some(Intent::Restart),
                "c" => Some(Intent::PrintCamera),
                "[" => Some(Intent::Member(-1)),
                "]" => Some(Intent::Member(1)),
                "p" => Some(Intent::Paths),
                "j" => Some(Intent::Judge),
                "v" => Some(Intent::Split),
                "b" => Some(Intent::Exposure(if self.shift { -0.5 } else { 0.5 })),
                " " => Some(Intent::Pause),
                other => Some(match other.parse::<usize>() {
                    Ok(place @ 1..=9) => Intent::Camera(place - 1),
                    _ => Intent::Unknown(text.to_uppercase()),
                }),
            },
            _ => None,
        }
    }
}
