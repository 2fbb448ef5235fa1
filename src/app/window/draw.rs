//! What a frame of a session draws: the picture there is, the panel beside it, what lies over it, the title. What was done in the panel is followed.

use std::time::{Duration, Instant};

use super::legend;
use super::mark;
use super::panel::edits::{EditsAction, EditsShown};
use super::panel::{FamilyContext, Outcome, PanelContext};
use super::paths;
use super::paths::ShownPaths;
use super::session::Session;
use super::tracing::Rest;
use crate::components::Camera;
use crate::engine::{EngineError, Progress};
use crate::gpu::{Drawn, Placement};

/// Time between two changes of the title.
const TITLE: Duration = Duration::from_millis(500);

impl Session {
    /// Draws the picture there is, and what lies over it.
    pub(super) fn draw(&mut self) -> Result<(), EngineError> {
        let begin = Instant::now();
        let placement = Placement { fit: self.fit(), area: self.area() };
        let name = self.name().to_owned();
        let mark = self.mark();
        let lines = self.path_lines()?;
        let (view, scene_size) = (self.viewpoint.camera, self.scene_size());
        let Session {
            screen, engine, overlay, panel, judgement, edits, members, thumbs, selected, errors, paths, ..
        } = self;
        let mut outcome = Outcome::default();
        let (paint, again) = screen.run_ui(|ui| {
            if panel.open {
                let family = members.as_ref().map(|members| FamilyContext { members, shown: &name, thumbs });
                let (camera, selected) = (&view, selected.as_deref());
                let edits = EditsShown::of(edits, judgement);
                let errors = errors.shown();
                let paths = paths.shown.as_ref();
                let context = PanelContext { camera, scene_size, family, selected, paths, edits, errors };
                outcome.add(panel.show(ui, engine, context));
            }
            if let Some(lines) = &lines {
                paths::draw(ui.ctx(), ui.available_rect_before_wrap(), lines);
            }
            errors.draw(ui.ctx(), ui.available_rect_before_wrap(), placement.fit);
            if let Some(mark) = &mark {
                mark::draw(ui.ctx(), ui.available_rect_before_wrap(), mark);
            }
            let of_paths = paths.shown.as_ref().filter(|shown| !shown.paths.is_empty()).map(ShownPaths::legend);
            let of_view = || legend::legend(engine.view(), engine.view_reach(), &engine.material_names());
            if !panel.open
                && let Some(legend) = of_paths.or_else(of_view)
            {
                legend::draw::over(ui.ctx(), ui.available_rect_before_wrap(), legend);
            }
            overlay.show(ui.ctx(), ui.available_rect_before_wrap(), judgement.line());
        });
        self.activity.redraw = screen.draw(engine, placement, paint)? == Drawn::Later;
        // Else the next step would take the time of drawing for that of its samples.
        self.gpu.wait()?;
        if let Some(action) = outcome.errors {
            self.follow_errors_action(action)?;
        }
        self.follow_panel(outcome);
        // egui says by the longest of times that it wants nothing.
        self.activity.ui_again = begin.checked_add(again).filter(|_| again < Duration::from_secs(3600));
        self.set_title();
        Ok(())
    }

    /// Goes on from what was done in the panel.
    fn follow_panel(&mut self, outcome: Outcome) {
        let now = Instant::now();
        if outcome.moved {
            self.tracing.pace.moved(now);
        }
        if outcome.edited || outcome.moved {
            self.touch(now);
            self.step_aside();
            self.wake_film();
        }
        if let Some(lens) = outcome.lens {
            self.set_view(Camera { lens, ..self.viewpoint.camera }, now);
        }
        if let Some(name) = outcome.camera {
            self.choose_camera(&name, now);
        }
        if outcome.save {
            self.save_edits();
        }
        if let Some(said) = outcome.said {
            self.notify(said);
        }
        if outcome.paths {
            self.toggle_paths();
        }
        if let Some(name) = outcome.member {
            self.choose_member(&name);
        }
        match outcome.edits {
            Some(EditsAction::GoBack(row)) => self.go_back_to(row),
            Some(EditsAction::Judge(on)) => self.set_automatic(on),
            None => {}
        }
    }

    /// Says in the title how far the film is, twice a second and when it is finished.
    fn set_title(&mut self) {
        let Some(progress) = self.tracing.progress else { return };
        if !progress.finished && self.titled.is_some_and(|at| at.elapsed() < TITLE) {
            return;
        }
        self.titled = Some(Instant::now());
        let Progress { spp, target, .. } = progress;
        let name = self.place_of(self.name());
        let of = if self.engine.is_endless() { String::new() } else { format!(" of {target}") };
        let rest = match self.tracing.rest {
            Some(Rest::Paused) => ", paused",
            Some(Rest::Fine) => ", as fine as 8 bits show",
            None if self.judgement.has_device() => ", rests while the edit is judged",
            None => "",
        };
        self.window.set_title(&format!("{name}: {spp}{of} spp{rest} (F1 for keys) - Lucerna"));
    }
}
