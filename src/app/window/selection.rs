//! The mesh that was clicked: chosen, and let go.

use egui::pos2;
use glam::DVec2;

use super::mark::Mark;
use super::outline;
use super::session::Session;
use crate::engine::EngineError;

impl Session {
    /// Selects the mesh that is seen under the pointer; lets go of it where it is selected already, or where there is none.
    pub(super) fn select(&mut self) -> Result<(), EngineError> {
        let Some(pixel) = self.pixel_under_pointer() else { return Ok(()) };
        let seen = self.engine.inspect(pixel);
        let seen = self.survive("selecting", seen)?.flatten().and_then(|pixel| pixel.surface);
        let mesh = seen.map(|surface| surface.mesh).filter(|mesh| self.selected.as_ref() != Some(mesh));
        if let Some(mesh) = &mesh {
            let hint = if self.panel.open { "" } else { "; F2 shows its material" };
            self.notify(format!("selected {mesh}{hint}"));
            self.panel.reveal_materials();
        }
        self.selected = mesh;
        self.draw_again();
        Ok(())
    }

    /// The mark of the selected mesh; none where nothing is selected, or what was is no longer there.
    pub(super) fn mark(&mut self) -> Option<Mark> {
        let name = self.selected.clone()?;
        let mesh = self.engine.mesh(&name)?;
        let film = self.engine.settings().map(|(film, _)| film)?;
        let (size, area, points) = (self.engine.window_size(), self.area(), self.screen.scale());
        let (origin, extent) = self.fit().place(size, area);
        let on_window = |at: DVec2| {
            let at = (at - film.window().min.as_dvec2()).as_vec2() / size.as_vec2() * extent + origin;
            pos2(at.x / points, at.y / points)
        };
        let edges = outline::edges(&self.viewpoint.camera, film.size, mesh.low, mesh.high);
        let name = mesh.material.map_or(name.clone(), |material| format!("{name}: {material}"));
        Some(Mark { lines: edges.into_iter().map(|edge| edge.map(on_window)).collect(), name })
    }
}
