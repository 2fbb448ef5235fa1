//! The picture of the environment to pixels and the tables by which directions are drawn from it.

use std::sync::Arc;

use bevy_ecs::prelude::*;

use crate::components::{Environment, Name};
use crate::layout::sky::SkyTable;
use crate::systems::state::{Dirty, PackedScene, Pending, Sky};

/// Packs the environment's picture where it is another one, or of another strength.
pub fn extract_changed_sky(
    environments: Query<(&Name, &Environment)>,
    mut scene: ResMut<PackedScene>,
    mut pending: ResMut<Pending>,
    mut dirty: ResMut<Dirty>,
) {
    let first = environments.iter().min_by_key(|environment| environment.0.as_str());
    let Some((_, Environment::Map { image, strength })) = first else {
        if scene.sky.is_some() {
            scene.sky = None;
            dirty.film = true;
        }
        return;
    };
    let same = |sky: &Sky| Arc::ptr_eq(&sky.image, image) && sky.strength.to_bits() == strength.to_bits();
    if scene.sky_sent && scene.sky.as_ref().is_some_and(same) {
        return;
    }
    let table = SkyTable::new(image.size, &image.pixels, *strength);
    scene.sky = Some(Sky {
        image: image.clone(),
        strength: *strength,
        size: table.size,
        power: table.power,
        brightest: table.brightest,
    });
    scene.sky_sent = true;
    pending.sky = Some(table);
    dirty.film = true;
}
