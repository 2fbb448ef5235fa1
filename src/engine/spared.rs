//! What was not done for the film that there is.

use bevy_ecs::prelude::*;

use crate::systems::resources::{Device, DoneBefore, Spared, Spent, Textures};
use crate::systems::table_bytes;

/// What was there already, or what nothing needs.
pub fn spared(world: &World) -> Spared {
    let (device, before) = (&world.resource::<Device>().0, world.resource::<DoneBefore>());
    let (spent, textures) = (world.resource::<Spent>(), world.resource::<Textures>());
    let count = |of: &std::collections::BTreeMap<&'static str, u64>, name| of.get(name).copied().unwrap_or(0);
    let sent = |name| count(device.uploads(), name) - count(&before.uploads, name);
    let left = table_bytes(world).map(|(name, bytes)| (name, bytes.saturating_sub(sent(name))));
    let passes = before.dispatches.iter().filter(|(name, ran)| count(device.dispatches(), name) == **ran);
    Spared {
        unused_textures: textures.unused,
        unused_texture_bytes: textures.unused_bytes,
        halved_texture_bytes: textures.halved_bytes,
        uploads: left.filter(|(_, bytes)| *bytes > 0).collect(),
        passes: passes.map(|(name, _)| (*name, device.last_milliseconds(name))).collect(),
        build_milliseconds: (spent.build > 0.0 && spent.build == before.build).then_some(1e3 * spent.last_build),
    }
}
