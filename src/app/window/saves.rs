//! What was saved while the window is open: said in the window and in the terminal, and taken up by the view.

use std::time::{Duration, Instant};

use super::session::Session;
use crate::app::shared::failure::show;
use crate::app::shared::output;
use crate::watch::{ReloadEvent, Restarts};

impl Session {
    /// Follows the events of the engine's last step. Each failure goes to the terminal once, and stands over the picture
    /// until it is mended.
    pub(super) fn follow_saves(&mut self) {
        let events = self.engine.events();
        if events.is_empty() {
            return;
        }
        let member = self.follow_member();
        for event in events {
            match event {
                ReloadEvent::Failed { files, problems, since_save } => {
                    problems.iter().for_each(|problem| show(&*problem.diagnostic));
                    self.record_failed(&files, &problems, since_save);
                    self.draw_again();
                }
                ReloadEvent::Reloaded { files, restarts, .. }
                    if restarts == Restarts::default()
                        && self.saved_here.take_if(|own| files == [&**own]).is_some() =>
                {
                    // What was saved here is what is shown: that was said.
                    self.follow_files();
                }
                ReloadEvent::Reloaded { files, restarts, warnings, since_save } => {
                    self.saved_here = None;
                    warnings.iter().for_each(|warning| show(&*warning.diagnostic));
                    let names: Vec<_> = files.iter().filter_map(|file| file.file_name()).collect();
                    let what = match names.as_slice() {
                        _ if member.is_some() => member.clone().unwrap_or_default(),
                        [] => "everything".to_owned(),
                        [one] => one.to_string_lossy().into_owned(),
                        [one, others @ ..] => format!("{} and {} more", one.to_string_lossy(), others.len()),
                    };
                    self.step_aside();
                    let after = milliseconds(since_save);
                    let taken = format!("{what} taken up after {after}: {restarts} anew");
                    let more = self.record_taken(&files, restarts, since_save, member.is_some());
                    self.report(more.map_or(taken.clone(), |more| format!("{taken}; {more}")));
                    if restarts.film {
                        self.hide_paths();
                        self.tracing.began = Instant::now();
                    }
                    self.follow_files();
                }
                ReloadEvent::Compiling { since, given_up, .. } => {
                    let others = match given_up {
                        0 => String::new(),
                        count => format!(", beside {count} older that the driver has not ended"),
                    };
                    self.report(format!("compiling .. {} s{others}", since.as_secs()));
                }
                ReloadEvent::FirstPixels { since_save } => {
                    self.record_pixels(since_save);
                    self.report(format!("new pixels {} after the save", milliseconds(since_save)));
                }
                ReloadEvent::Linted { warnings, .. } => {
                    self.record_lint(&warnings);
                    warnings.iter().for_each(|warning| show(&*warning.diagnostic));
                    if let Some(first) = warnings.first() {
                        self.notify(first.diagnostic.to_string());
                    }
                    self.draw_again();
                }
            }
        }
    }

    /// The cameras that the keys go to are those of the file, and the view is where the file has put it, if it has.
    fn follow_files(&mut self) {
        if let Some(scene) = self.engine.saved_scene() {
            self.viewpoint.homes.clone_from(&scene.cameras);
        }
        let view = self.engine.camera().map(|(_, view)| view);
        if !self.viewpoint.moved && view != Some(self.viewpoint.camera) {
            self.follow_camera(Instant::now());
        }
        self.activity.working = true;
    }

    /// Says what the last step had to do to textures so that they fit.
    pub(super) fn follow_textures(&mut self) {
        let warnings = self.textures.fresh(self.engine.textures(), self.engine.halved_sky());
        if !warnings.is_empty() {
            self.report(warnings.iter().map(|warning| format!("warning: {warning}")).collect::<Vec<_>>().join("\n"));
        }
    }

    fn report(&mut self, text: String) {
        output::note(&text);
        self.notify(text);
    }
}

fn milliseconds(time: Duration) -> String {
    format!("{:.0} ms", time.as_secs_f64() * 1e3)
}
