//! Where the picture lies on the window, how large its film is, and what of it the pointer is on.

use std::time::Instant;

use glam::UVec2;
use winit::event::{ElementState, WindowEvent};

use super::dock;
use super::screen::physical_size;
use super::session::Session;
use crate::components::Film;
use crate::gpu::Fit;

impl Session {
    /// Pixels of the window, from its top left, that the panel leaves to the picture.
    pub(super) fn area(&self) -> UVec2 {
        dock::picture_area(physical_size(&self.window), self.panel.width(), self.screen.scale())
    }

    /// Whether an event is a button or the wheel beside the picture.
    pub(super) fn is_for_panel(&self, event: &WindowEvent) -> bool {
        let begins = match event {
            WindowEvent::MouseInput { state, .. } => *state == ElementState::Pressed,
            WindowEvent::MouseWheel { .. } => true,
            _ => false,
        };
        let width = f64::from(self.area().x);
        begins && self.controls.cursor.is_some_and(|at| at.x >= width)
    }

    /// How the picture lies on its area.
    pub(super) fn fit(&mut self) -> Fit {
        self.magnifier.fit(self.plain_fit())
    }

    /// How it does by itself: a crop keeps its shape, any other film is as large as the area.
    fn plain_fit(&mut self) -> Fit {
        let crop = self.engine.settings().is_some_and(|(film, _)| film.crop.is_some());
        if crop { Fit::Letterbox } else { Fit::Fill }
    }

    /// Shows the picture's pixels larger, or smaller, about the pointer.
    pub(super) fn magnify(&mut self, times: i32) {
        let Some(pointer) = self.controls.cursor else { return };
        let (picture, area, plain) = (self.engine.window_size(), self.area(), self.plain_fit());
        self.magnifier.turn(times, pointer.as_vec2(), picture, area, plain);
        self.notify(match self.magnifier.scale() {
            Some(scale) => format!("pixels at {scale}:1"),
            None => "pixels at their own size".to_owned(),
        });
    }

    /// The pixel of the film that the pointer is on; none where another picture lies over it.
    pub(super) fn pixel_under_pointer(&mut self) -> Option<UVec2> {
        let (area, fit, size) = (self.area(), self.fit(), self.engine.window_size());
        let cursor = self.controls.cursor.filter(|at| at.cmplt(area.as_dvec2()).all())?.as_vec2();
        if self.overlay.beside.hides(cursor.x / area.x as f32) {
            return None;
        }
        let (origin, extent) = fit.place(size, area);
        let at = (cursor - origin) / extent * size.as_vec2();
        (at.cmpge(glam::Vec2::ZERO).all() && at.cmplt(size.as_vec2()).all()).then(|| at.as_uvec2())
    }

    /// The pixel that is looked at: under the pointer, or the last that it was on, so that it can be read while the pointer is elsewhere.
    pub(super) fn looked_at(&mut self) -> Option<UVec2> {
        let size = self.engine.window_size();
        let pixel = self.pixel_under_pointer().or(self.pixel);
        self.pixel = pixel.filter(|pixel| pixel.cmplt(size).all());
        self.pixel
    }

    /// Gives the film the size of its area.
    pub(super) fn fit_film(&mut self) {
        self.set_film_size(self.tracing.pace.film_size(self.area()));
    }

    /// A film without a crop is as large as its area; a crop is a part of a film of one size.
    fn set_film_size(&mut self, size: UVec2) {
        let changed = self.engine.edit(|world| {
            let mut films = world.query::<&mut Film>();
            let film = films.iter_mut(world).next().filter(|film| film.crop.is_none() && film.size != size);
            film.map(|mut film| film.size = size).is_some()
        });
        if changed {
            self.touch(Instant::now());
            self.step_aside();
            self.film_restarts(Instant::now());
        }
    }
}
