//! The brightest paths of a pixel are asked for, traced again, drawn as the camera sees them, and taken away.

use egui::pos2;
use glam::DVec2;

use super::alike::is_alike;
use super::brightest::{SAMPLES, brightest, colours};
use super::paths::{Asked, PathLine, PathLines, Paths, ShownPaths};
use super::session::Session;
use crate::engine::EngineError;

impl Session {
    /// Shows the brightest paths of the pixel that is looked at; takes them away where some are shown.
    pub(super) fn toggle_paths(&mut self) {
        if self.hide_paths() {
            return;
        }
        let (Some(pixel), Some((film, _))) = (self.looked_at(), self.engine.settings()) else {
            return self.notify("point at a pixel, and press P: its brightest paths are shown".to_owned());
        };
        let pixel = pixel + film.window().min;
        self.paths.asked = Some(Asked { pixel, told: false });
        self.notify(format!("tracing {SAMPLES} samples of pixel {},{} again", pixel.x, pixel.y));
        self.activity.working = true;
    }

    /// Takes the paths away. Says whether there were any.
    pub(super) fn hide_paths(&mut self) -> bool {
        let shown = self.paths.is_shown();
        self.paths = Paths::default();
        if shown {
            self.draw_again();
        }
        shown
    }

    /// Traces the pixel that was asked for, once a frame has said so: compiling may take a while.
    pub(super) fn trace_paths(&mut self) -> Result<(), EngineError> {
        let Some(asked) = &mut self.paths.asked else { return Ok(()) };
        self.activity.working = true;
        if !std::mem::replace(&mut asked.told, true) || !self.tracing.is_whole() {
            return Ok(());
        }
        let pixel = asked.pixel;
        self.paths.asked = None;
        let traced = self.engine.trace_paths(pixel, 0..SAMPLES);
        let Some(traced) = self.survive("tracing paths again", traced)? else { return Ok(()) };
        let film = self.engine.film();
        let Some(film) = self.survive("reading the film", film)? else { return Ok(()) };
        let paths = brightest(&traced, self.scene_size());
        let name = self.name().to_owned();
        let scene = self.engine.describe(&name);
        let shown = self.shown(&scene, &film);
        let commands = paths.iter().map(|path| shown.replay(pixel, path.sample)).collect();
        let bad = traced.iter().filter(|path| path.radiance.is_none()).count();
        match paths.as_slice() {
            [] => self.notify(format!("none of {SAMPLES} samples of pixel {},{} brings light", pixel.x, pixel.y)),
            [..] => self.notify(format!(
                "{} of {SAMPLES} paths of pixel {},{}: P or Esc takes them away",
                paths.len(),
                pixel.x,
                pixel.y
            )),
        }
        let (colours, restarts) = (colours(&paths), self.film_restarts_so_far());
        let (hidden, seen_from) = (Vec::new(), None);
        self.paths.shown =
            Some(ShownPaths { pixel, paths, colours, bad, commands, scene, restarts, hidden, seen_from });
        Ok(())
    }

    /// Takes paths away that are of a scene that was edited since. The camera may move: paths are where they were.
    pub(super) fn outdate_paths(&mut self) {
        let restarts = self.film_restarts_so_far();
        let Some(shown) = self.paths.shown.as_mut().filter(|shown| shown.restarts != restarts) else { return };
        shown.restarts = restarts;
        let name = shown.scene.name.clone();
        if !is_alike(&self.engine.describe(&name), &shown.scene) {
            self.hide_paths();
        }
    }

    fn film_restarts_so_far(&self) -> u64 {
        self.engine.entered().get("restart_film").copied().unwrap_or(0)
    }

    /// The lines of the paths that are shown, as the camera sees them.
    pub(super) fn path_lines(&mut self) -> Result<Option<PathLines>, EngineError> {
        let camera = self.viewpoint.camera;
        let Some(shown) = &self.paths.shown else { return Ok(None) };
        if shown.seen_from != Some(camera) && !self.viewpoint.moved {
            let middles: Vec<_> =
                shown.paths.iter().flat_map(|path| &path.pieces).map(|piece| piece.middle()).collect();
            let hidden = self.engine.hidden(&middles);
            let hidden = self.survive("looking for what hides paths", hidden)?.unwrap_or_default();
            if let Some(shown) = &mut self.paths.shown {
                (shown.hidden, shown.seen_from) = (hidden, Some(camera));
            }
        }
        let Some((film, _)) = self.engine.settings() else { return Ok(None) };
        let (size, area, points) = (self.engine.window_size(), self.area(), self.screen.scale());
        let (origin, extent) = self.fit().place(size, area);
        let on_window = |at: DVec2| {
            let at = (at - film.window().min.as_dvec2()).as_vec2() / size.as_vec2() * extent + origin;
            pos2(at.x / points, at.y / points)
        };
        let Some(shown) = &self.paths.shown else { return Ok(None) };
        let mut hidden = shown.hidden.iter().copied();
        let mut lines = Vec::new();
        for (path, colour) in shown.paths.iter().zip(&shown.colours) {
            for piece in &path.pieces {
                let hidden = hidden.next().unwrap_or(false);
                if let Some(ends) = piece.on_film(&camera, film.size) {
                    let ends = ends.map(on_window);
                    lines.push(PathLine { ends, colour: *colour, to_light: piece.to_light, hidden });
                }
            }
        }
        // The brightest lie above the others, and what is seen above what is hidden.
        lines.reverse();
        lines.sort_by_key(|line| !line.hidden);
        Ok(Some(PathLines { lines }))
    }
}
