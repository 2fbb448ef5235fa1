//! Tells what a save makes anew, and when its first pixels are there.

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;

use super::state::{Reload, Taken};
use crate::components::{Film, Name};
use crate::gpu::GpuTable;
use crate::layout::trace::MaterialRecord;
use crate::systems::code::restart_for_code;
use crate::systems::resources::{Batch, Device, Displayed, FilmProgress, Governor, MaterialSlot, Shot, Tree};
use crate::watch::{ReloadEvent, Restarts};

/// What a reload may make start anew.
#[derive(SystemParam)]
pub struct Made<'w, 's> {
    tree: ResMut<'w, Tree>,
    progress: Single<'w, 's, &'static mut FilmProgress, With<Film>>,
    displayed: Res<'w, Displayed>,
    governor: ResMut<'w, Governor>,
}

/// Has made anew what other code makes, beside what extraction found, and tells both.
pub fn tell_what_restarts(mut reload: ResMut<Reload>, mut made: Made) {
    if !made.progress.begun {
        // The film that is aside is one of another scene, or seen from elsewhere.
        reload.trial.film = None;
    }
    let code = std::mem::take(&mut reload.code_restarts);
    restart_for_code(code, &mut made.tree, &mut made.progress, &mut made.governor);
    let restarts = Restarts {
        tree: !made.tree.built,
        film: !made.progress.begun,
        picture: code.picture || made.displayed.is_changed() && !made.displayed.is_added(),
    };
    for Taken { saved, files, warnings } in std::mem::take(&mut reload.taken) {
        if restarts != Restarts::default() {
            reload.awaited.get_or_insert(saved);
        }
        reload.events.push(ReloadEvent::Reloaded { files, restarts, warnings, since_save: saved.elapsed() });
    }
    let refused = std::mem::take(&mut reload.refused);
    reload.events.extend(refused);
}

/// Tells the first pixels that came of a save, and has the code of surfaces linted.
pub fn tell_first_pixels(
    mut reload: ResMut<Reload>,
    batch: Res<Batch>,
    progress: Single<&FilmProgress, With<Film>>,
    device: Res<Device>,
    shot: Res<Shot>,
    records: Res<GpuTable<MaterialRecord>>,
    materials: Query<(&Name, &MaterialSlot)>,
) {
    if (!batch.is_empty() || progress.shown.is_some())
        && let Some(saved) = reload.awaited.take()
    {
        reload.events.push(ReloadEvent::FirstPixels { since_save: saved.elapsed() });
        let mut named: Vec<(u32, &Name)> = materials.iter().map(|(name, slot)| (slot.0, name)).collect();
        named.sort_by_key(|(slot, _)| *slot);
        let record = |(slot, name): (u32, &Name)| Some((name.to_string(), *records.rows().get(slot as usize)?));
        let materials = named.into_iter().filter_map(record).collect();
        reload.linter.start(&device.0, materials, shot.reuses());
    }
}
