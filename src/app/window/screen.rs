//! The window as something to draw on: its surface, and the user interface's input and output.

use std::sync::Arc;
use std::time::Duration;

use glam::UVec2;
use winit::event::WindowEvent;
use winit::window::Window;

use crate::engine::{Engine, EngineError};
use crate::gpu::{Drawn, Gpu, GpuError, Paint, Placement, Surface};
use crate::shader::Library;

/// A window's surface, and egui on it.
pub struct Screen {
    window: Arc<Window>,
    surface: Surface,
    state: egui_winit::State,
}

impl Screen {
    /// Opens a device that can present to the window.
    pub fn open(window: &Arc<Window>, library: &Library) -> Result<(Arc<Gpu>, Screen), GpuError> {
        let (gpu, surface) = Surface::open(window.clone(), physical_size(window), library)?;
        let context = egui::Context::default();
        // Dark whatever the desktop says: a bright frame changes how a picture is seen.
        context.set_theme(egui::Theme::Dark);
        // Bright enough to be read over any picture.
        context.all_styles_mut(|style| {
            style.visuals.widgets.noninteractive.fg_stroke.color = egui::Color32::from_gray(205)
        });
        let scale = Some(window.scale_factor() as f32);
        let side = Some(gpu.limits.max_texture_dimension_2d as usize);
        let state = egui_winit::State::new(context, egui::ViewportId::ROOT, window, scale, None, side);
        Ok((gpu, Screen { window: window.clone(), surface, state }))
    }

    /// Lets the user interface have an event. Says whether it keeps it to itself, and whether it wants to be drawn.
    pub fn event(&mut self, event: &WindowEvent) -> egui_winit::EventResponse {
        self.state.on_window_event(&self.window, event)
    }

    /// Drops what was heard, where there is no user interface to hear it.
    pub fn forget_events(&mut self) {
        self.state.egui_input_mut().events.clear();
    }

    /// Puts a text on the clipboard.
    pub fn copy(&mut self, text: String) {
        self.state.set_clipboard_text(text);
    }

    /// Takes up the window's size.
    pub fn resize(&mut self) -> Result<(), GpuError> {
        self.surface.resize(physical_size(&self.window))
    }

    /// Runs the user interface. Returns what it looks like, and after which time it wants to be drawn again.
    pub fn run_ui(&mut self, show: impl FnMut(&mut egui::Ui)) -> (Paint, Duration) {
        let input = self.state.take_egui_input(&self.window);
        let context = self.state.egui_ctx().clone();
        let output = context.run_ui(input, show);
        self.state.handle_platform_output(&self.window, output.platform_output);
        let again = output.viewport_output.get(&egui::ViewportId::ROOT).map_or(Duration::MAX, |v| v.repaint_delay);
        let paint = Paint {
            primitives: context.tessellate(output.shapes, output.pixels_per_point),
            textures: output.textures_delta,
            pixels_per_point: output.pixels_per_point,
        };
        (paint, again)
    }

    /// Pixels of the window a point of the user interface, as it was last run.
    pub fn scale(&self) -> f32 {
        self.state.egui_ctx().pixels_per_point()
    }

    /// Draws the engine's picture on an area of the window, from its top left, and the user interface over it.
    pub fn draw(&mut self, engine: &Engine, placement: Placement, paint: Paint) -> Result<Drawn, EngineError> {
        self.window.pre_present_notify();
        engine.draw(&mut self.surface, placement, paint)
    }
}

/// The window's inner size in pixels; a side is 0 while it is minimised, on some systems.
pub fn physical_size(window: &Window) -> UVec2 {
    let size = window.inner_size();
    UVec2::new(size.width, size.height)
}
