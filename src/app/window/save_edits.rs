//! Ctrl+S in a session: what was changed in the window goes into the scene's file, and the user is told.

use super::scene_file::{Kept, Saved, Unsaved, save, save_model};
use super::session::Session;
use crate::app::shared::failure::{rendered, show};
use crate::app::shared::output;
use crate::scene::SceneDescription;

impl Session {
    /// Saves what was changed, and says what was written, or why nothing was.
    pub(super) fn save_edits(&mut self) {
        match self.try_save_edits() {
            Ok(saved) => self.follow_own_save(saved),
            Err(unsaved) => {
                show(&unsaved);
                self.notify(rendered(&unsaved, false).trim_end().to_owned());
            }
        }
    }

    fn try_save_edits(&mut self) -> Result<Saved, Unsaved> {
        let name = self.name().to_owned();
        let mut now = self.engine.describe(&name);
        // The engine's camera follows the view in the next frame.
        now.cameras.insert(now.active.clone(), self.viewpoint.camera);
        let opened = self.opened();
        let description = self.engine.saved_scene().unwrap_or(&opened.description).clone();
        let text = self.engine.saved_text().filter(|text| text.file().is_some()).unwrap_or(&opened.text).clone();
        if self.family().is_some() {
            let scene = text.file().unwrap_or(&opened.path).to_path_buf();
            return Err(Unsaved::Member { member: name, family: opened.path.clone(), scene });
        }
        if self.is_found() {
            return Err(Unsaved::Found { name, path: opened.path.clone() });
        }
        match text.file() {
            Some(_) => {
                let now = of_file(now, &description);
                save(&Kept { text, description }, self.kept.as_ref(), &now)
            }
            None => {
                let path = opened.path.clone();
                save_model(&path, &description, self.kept.as_ref(), &now)
            }
        }
    }

    fn follow_own_save(&mut self, saved: Saved) {
        let Saved { path, edited, is_new, kept } = saved;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let mut lines = vec![match is_new {
            true => format!("{}: a scene file of what is seen; open that from now on", path.display()),
            false => format!("{name}: {}", edited.summary()),
        }];
        lines.extend(edited.left_out.iter().map(|left| format!("not saved: {}", rendered(left, false).trim_end())));
        lines.extend(edited.notes.iter().map(|note| rendered(note, false).trim_end().to_owned()));
        let text = lines.join("\n");
        output::note(&text);
        self.notify(text);
        if !edited.is_unchanged() && !is_new {
            self.saved_here = Some(path);
        }
        self.kept = Some(kept);
    }
}

/// A scene as it is in the window, without what the window decides: the film has the window's size, and cameras that were left are where the file
/// has them.
fn of_file(now: SceneDescription, file: &SceneDescription) -> SceneDescription {
    let mut now = now;
    now.film.size = file.film.size;
    for (name, camera) in &mut now.cameras {
        if let Some(held) = file.cameras.get(name).filter(|_| *name != now.active) {
            *camera = *held;
        }
    }
    now
}
