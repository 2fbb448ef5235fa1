//! What each key and gesture does.

use std::path::Path;
use std::time::Instant;

use winit::window::Fullscreen;

use super::controls::Intent;
use super::session::Session;
use super::tracing::Rest;
use super::{cameras, navigate, snapshot};
use crate::app::shared::failure::show;
use crate::app::shared::output;
use crate::components::{Camera, Film};
use crate::engine::EngineError;
use crate::scene::edit;
use crate::scene::settings::MOST_STOPS;

/// The nearest that zooming comes to its target, and the farthest that it goes, in sizes of the scene.
const ZOOM_RANGE: [f64; 2] = [1e-4, 1e3];

impl Session {
    /// Does what the user wants.
    pub(super) fn act(&mut self, intent: Intent) -> Result<(), EngineError> {
        let now = Instant::now();
        match intent {
            Intent::Orbit(angle) => self.set_view(navigate::orbit(self.viewpoint.camera, angle), now),
            Intent::Pan(shift) => self.set_view(navigate::pan(self.viewpoint.camera, shift), now),
            Intent::Zoom(factor) => {
                let range = ZOOM_RANGE.map(|bound| bound * self.scene_size());
                self.set_view(navigate::zoom(self.viewpoint.camera, factor, range), now);
            }
            Intent::Magnify(times) => self.magnify(times),
            Intent::Focus => self.focus(now)?,
            Intent::Select => self.select()?,
            Intent::Paths => self.toggle_paths(),
            Intent::FrameAll => self.frame_all(now),
            Intent::Camera(place) => {
                let names: Vec<String> = self.engine.read(cameras::all).into_keys().collect();
                match names.get(place) {
                    Some(name) => self.choose_camera(name, now),
                    None => self.notify(format!("there is no camera {}: the last is {}", place + 1, names.len())),
                }
            }
            Intent::Member(by) => self.step_member(by),
            Intent::Restart => {
                self.engine.restart_film();
                self.resume();
            }
            Intent::Pause => self.toggle_pause(),
            Intent::Exposure(stops) => self.expose(stops),
            Intent::PrintCamera => self.print_camera(),
            Intent::SaveEdits => self.save_edits(),
            Intent::Help => {
                self.overlay.help = !self.overlay.help;
                self.draw_again();
            }
            Intent::Panel => {
                self.panel.toggle(&mut self.engine);
                self.draw_again();
            }
            Intent::Reload => {
                self.engine.reload();
                self.resume();
            }
            Intent::Judge => self.toggle_judging(),
            Intent::Split => self.toggle_split(),
            Intent::Fullscreen => {
                let full = self.window.fullscreen().is_some();
                self.window.set_fullscreen((!full).then_some(Fullscreen::Borderless(None)));
            }
            Intent::Save => {
                self.saving = true;
                self.draw_again();
            }
            Intent::Unknown(key) => self.notify(format!("{key} does nothing here: F1 shows the keys")),
            Intent::Quit if self.hide_paths() => {}
            Intent::Quit => self.quit(),
        }
        Ok(())
    }

    /// Lets the film rest until it starts anew or goes on.
    fn toggle_pause(&mut self) {
        let paused = self.tracing.rest.is_none() && self.tracing.progress.is_some_and(|progress| !progress.finished);
        let spp = self.tracing.progress.map_or(0, |progress| progress.spp);
        match (paused, self.tracing.rest) {
            (true, _) => self.notify(format!("paused at {spp} spp: Space goes on")),
            (false, Some(_)) => self.notify(format!("goes on from {spp} spp")),
            (false, None) => return self.notify(format!("finished at {spp} spp: there is nothing to pause")),
        }
        self.rest(paused.then_some(Rest::Paused));
    }

    /// Focuses to what is seen under the pointer, as the engine's camera sees it.
    fn focus(&mut self, now: Instant) -> Result<(), EngineError> {
        let Some(pixel) = self.pixel_under_pointer() else { return Ok(()) };
        let seen = self.engine.inspect(pixel);
        let seen = self.survive("focusing", seen)?.flatten();
        match seen.and_then(|pixel| pixel.surface) {
            Some(surface) => {
                let view = navigate::focus(self.viewpoint.camera, surface.distance);
                let pinhole = view.lens.aperture == 0.0;
                let why = if pinhole { "; all is sharp until this camera has an aperture (F2)" } else { "" };
                self.notify(format!("focus at {:.4} on {}{why}", surface.distance, surface.mesh));
                self.set_view(view, now);
            }
            None => self.notify("there is nothing here to focus to".to_owned()),
        }
        Ok(())
    }

    pub(super) fn set_view(&mut self, view: Camera, now: Instant) {
        self.touch(now);
        self.step_aside();
        self.viewpoint.move_to(view);
        self.tracing.pace.moved(now);
    }

    /// Looks through a camera of the scene, from where the scene's file has it.
    pub(super) fn choose_camera(&mut self, name: &str, now: Instant) {
        let held = self.engine.read(cameras::all).get(name).copied();
        if let Some(home) = self.viewpoint.homes.get(name).copied().or(held) {
            self.engine.edit(|world| cameras::choose(world, name, home));
            self.follow_camera(now);
        }
    }

    fn frame_all(&mut self, now: Instant) {
        let (low, high) = self.engine.bounds();
        let size = self.area().as_dvec2();
        self.set_view(navigate::frame(self.viewpoint.camera, low, high, size.x / size.y.max(1.0)), now);
    }

    fn expose(&mut self, stops: f32) {
        let exposure = self.engine.edit(|world| {
            let mut film = world.query::<&mut Film>().iter_mut(world).next()?;
            film.exposure = (film.exposure + stops).clamp(-MOST_STOPS, MOST_STOPS);
            Some(film.exposure)
        });
        if let Some(exposure) = exposure {
            self.notify(format!("exposure {exposure:+} stops"));
            self.wake_film();
        }
    }

    fn print_camera(&mut self) {
        let Some((name, _)) = self.engine.camera() else { return };
        let line = edit::camera_line(&name, &self.viewpoint.camera);
        self.screen.copy(line.clone());
        match output::write(&format!("{line}\n")) {
            Ok(()) => self.notify("the camera is on the clipboard, and was printed to the terminal".to_owned()),
            Err(error) => self.notify(format!("stdout: {error}")),
        }
    }

    /// Saves the film. A file that can't be written is no reason to stop.
    pub(super) fn save(&mut self) -> Result<(), EngineError> {
        let film = self.engine.film();
        let Some(film) = self.survive("saving", film)? else { return Ok(()) };
        let name = self.name().to_owned();
        let scene = self.engine.describe(&name);
        let shown = self.shown(&scene, &film);
        let (names, failures) = snapshot::save(Path::new("result"), &shown);
        let repeat = shown.repeat();
        if !names.is_empty() {
            let lacks = if repeat.lacks_edits { " (without what was edited in the panel)" } else { "" };
            let saved = format!("saved {}; again{lacks}:\n{}", names.join(" and "), repeat.line);
            output::note(&saved);
            self.notify(saved);
        }
        for failure in failures {
            self.notify(failure.to_string());
            show(&failure);
        }
        Ok(())
    }
}
