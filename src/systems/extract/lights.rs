//! Emitting triangles to the table by which they are asked directly.

use bevy_ecs::prelude::*;

use crate::components::{Integrator, Render};
use crate::layout::light::LightTable;
use crate::layout::trace::MaterialRecord;
use crate::systems::state::{Dirty, MeshSlot, PackedScene, Pending};

/// Makes the table anew where triangles, records or the integrator changed; sends it on if it is not what it was. A scene
/// whose integrator asks no light directly has none.
pub fn extract_changed_lights(
    meshes: Query<&MeshSlot>,
    renders: Query<Ref<Render>>,
    mut scene: ResMut<PackedScene>,
    mut pending: ResMut<Pending>,
    mut dirty: ResMut<Dirty>,
) {
    if scene.lights_sent && !dirty.tree && !dirty.film && !renders.iter().any(|render| render.is_changed()) {
        return;
    }
    let asked = renders.iter().any(|render| render.integrator == Integrator::Path);
    let emits = |record: &MaterialRecord| record.emission.max_element() > 0.0;
    let table = match asked && scene.records.iter().any(emits) {
        true => {
            let shining = |entity: &&Entity| {
                meshes.get(**entity).is_ok_and(|slot| scene.records.get(slot.material as usize).is_some_and(emits))
            };
            let slots = scene.meshes.iter().filter(shining).filter_map(|entity| meshes.get(*entity).ok());
            LightTable::new(slots.flat_map(|slot| slot.triangles(scene.origin)), &scene.records)
        }
        false => LightTable::default(),
    };
    if !scene.lights_sent || table != scene.lights {
        scene.lights_sent = true;
        pending.lights = Some(table.lights.clone());
        scene.lights = table;
        dirty.film = true;
    }
}
