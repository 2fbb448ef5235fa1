//! Textures to words and records: those that a mesh's material uses, by the order of their names.

use std::collections::{BTreeMap, BTreeSet};

use bevy_ecs::prelude::*;

use super::step::Step;
use crate::components::{Geometry, Maps, Name, Texture, UsesMaterial};
use crate::gpu::GpuTable;
use crate::layout::texture::TextureRecord;
use crate::prepare::texture::{brightest, halvings, pack, words};
use crate::systems::resources::{Device, Everything, Policy, Texel, TextureSlot, TextureUse, Textures};
use crate::systems::run::counted;

type Touched = Or<(Changed<Texture>, Changed<Maps>, Changed<UsesMaterial>)>;
type Renamed = (With<Texture>, Changed<Name>);
type Picture<'a> = (Entity, &'a Name, &'a Texture, Option<&'a TextureSlot>);

pub fn add_systems(schedule: &mut Schedule) {
    let system = extract_textures.pipe(counted("extract_textures"));
    schedule.add_systems(system.run_if(textures_changed).in_set(Step::Textures));
}

/// A texture, or what uses it, came, went, changed or was renamed; or the greatest size is another.
#[expect(clippy::too_many_arguments, reason = "a condition's arguments are what it reads")]
fn textures_changed(
    everything: Res<Everything>,
    policy: Res<Policy>,
    touched: Query<(), Touched>,
    renamed: Query<(), Renamed>,
    mut gone: RemovedComponents<Texture>,
    mut unmapped: RemovedComponents<Maps>,
    mut unset: RemovedComponents<UsesMaterial>,
    mut unmeshed: RemovedComponents<Geometry>,
    mut unnamed: RemovedComponents<Name>,
) -> bool {
    let removed = gone.read().count() + unmapped.read().count() + unset.read().count();
    let removed = removed + unmeshed.read().count() + unnamed.read().count();
    everything.0 || removed > 0 || policy.is_changed() || !touched.is_empty() || !renamed.is_empty()
}

/// A texture and where it is to be.
struct Plan<'a> {
    entity: Entity,
    name: &'a str,
    texture: &'a Texture,
    held: Option<&'a TextureSlot>,
    /// For the greatest size, and for want of room.
    halvings: [u32; 2],
    words: u64,
}

impl Plan<'_> {
    /// Whether its words are there already.
    fn is_held(&self) -> bool {
        self.held.is_some_and(|slot| {
            let same = std::sync::Arc::ptr_eq(&slot.source.image, &self.texture.image);
            same && slot.source.is_read_as(self.texture) && slot.halvings == self.halvings.iter().sum::<u32>()
        })
    }
}

/// Packs what is another texture than its slot says, in the place of what it was where it fits there.
#[expect(clippy::too_many_arguments, reason = "a system's arguments are what it reads and writes")]
fn extract_textures(
    pictures: Query<Picture>,
    uses: Query<&UsesMaterial, With<Geometry>>,
    maps: Query<&Maps>,
    policy: Res<Policy>,
    device: Res<Device>,
    mut records: ResMut<GpuTable<TextureRecord>>,
    mut texels: ResMut<GpuTable<Texel>>,
    mut textures: ResMut<Textures>,
    mut commands: Commands,
) {
    let materials: BTreeSet<Entity> = uses.iter().map(|uses| uses.0).collect();
    let used: BTreeSet<Entity> = materials.iter().filter_map(|e| maps.get(*e).ok()).flat_map(Maps::all).collect();
    let emit: BTreeSet<Entity> = maps.iter().filter_map(|maps| maps.emission).collect();
    let (mut plans, mut found) = (Vec::new(), Textures::default());
    for (entity, name, texture, held) in &pictures {
        if used.contains(&entity) {
            let halvings = [halvings(texture, policy.texture_size), 0];
            let words = words(texture, halvings[0]);
            plans.push(Plan { entity, name: name.as_str(), texture, held, halvings, words });
        } else {
            found.unused += 1;
            found.unused_bytes += 4 * words(texture, halvings(texture, policy.texture_size));
            if held.is_some() {
                commands.entity(entity).remove::<TextureSlot>();
            }
        }
    }
    plans.sort_by_key(|plan| (plan.name, plan.entity));
    let room = device.0.gpu().most_bytes().min(u64::from(u32::MAX)) / 4;
    make_fit(&mut plans, room);
    let places = place(&plans, room);
    let mut moved = moved(&plans, &places, texels.rows());
    let end = places.iter().zip(&plans).map(|(first, plan)| first + plan.words).max().unwrap_or(0);
    if end as usize != texels.len() {
        texels.resize(end as usize);
    }
    let mut all = Vec::with_capacity(plans.len());
    for ((plan, first), index) in plans.iter().zip(places).zip(0..) {
        let total: u32 = plan.halvings.iter().sum();
        let held = plan.held.filter(|slot| plan.is_held() && u64::from(slot.record.first) == first);
        // To find it is to read every texel.
        let known = plan.held.filter(|_| plan.is_held()).and_then(|slot| slot.brightest);
        let brightest = emit.contains(&plan.entity).then(|| known.unwrap_or_else(|| brightest(plan.texture)));
        let slot = match held {
            Some(slot) => TextureSlot { index, brightest, ..slot.clone() },
            None => {
                let (record, packed) = moved.remove(&plan.entity).unwrap_or_else(|| pack(plan.texture, total));
                let record = TextureRecord { first: first as u32, ..record };
                texels.write(first as usize, packed.into_iter().map(Texel));
                TextureSlot { index, record, halvings: total, source: plan.texture.clone(), brightest }
            }
        };
        found.halved_bytes += 4 * (words(plan.texture, 0) - plan.words);
        all.push(slot.record);
        found.brightest.push(slot.brightest.unwrap_or(0.0));
        found.uses.push(TextureUse {
            name: plan.name.to_owned(),
            size: plan.texture.image.size,
            halvings: total,
            for_room: plan.halvings[1],
            bytes: 4 * plan.words,
        });
        if held.is_none_or(|old| old.index != index || old.brightest != brightest) {
            commands.entity(plan.entity).insert(slot);
        }
    }
    if !records.holds(&all) {
        records.set(all);
    }
    textures.set_if_neq(found);
}

/// The records and words of textures that are there already, but to be elsewhere: their places may become those of others.
fn moved(plans: &[Plan], places: &[u64], texels: &[Texel]) -> BTreeMap<Entity, (TextureRecord, Vec<u32>)> {
    let words = |(plan, first): (&Plan, &u64)| {
        let record = plan.held.filter(|slot| plan.is_held() && u64::from(slot.record.first) != *first)?.record;
        let held = texels.get(record.first as usize..)?.get(..plan.words as usize)?;
        Some((plan.entity, (record, bytemuck::cast_slice(held).to_vec())))
    };
    plans.iter().zip(places).filter_map(words).collect()
}

/// Halves the largest textures until all of them fit.
fn make_fit(plans: &mut [Plan], room: u64) {
    let mut sum: u64 = plans.iter().map(|plan| plan.words).sum();
    while sum > room {
        let Some(largest) = plans.iter_mut().max_by_key(|plan| plan.words) else { return };
        largest.halvings[1] += 1;
        let less = words(largest.texture, largest.halvings.iter().sum());
        if less >= largest.words {
            return;
        }
        sum -= largest.words - less;
        largest.words = less;
    }
}

/// First words: what is there stays where it is, and what is new goes into the first gap that it fits. One after another by name where that
/// would reach beyond the room.
fn place(plans: &[Plan], room: u64) -> Vec<u64> {
    let kept = |plan: &&Plan| plan.is_held();
    let range = |plan: &Plan, first: u64| (first, first + plan.words);
    let mut taken: Vec<(u64, u64)> = Vec::new();
    for plan in plans.iter().filter(kept) {
        taken.extend(plan.held.map(|slot| range(plan, slot.record.first.into())));
    }
    taken.sort_unstable();
    let mut places = Vec::with_capacity(plans.len());
    for plan in plans {
        if let Some(slot) = plan.held.filter(|_| plan.is_held()) {
            places.push(u64::from(slot.record.first));
            continue;
        }
        let mut first = 0;
        let mut at = 0;
        while at < taken.len() && taken[at].0 < first + plan.words {
            first = taken[at].1;
            at += 1;
        }
        taken.insert(at, range(plan, first));
        places.push(first);
    }
    if taken.last().is_none_or(|(_, end)| *end <= room) {
        return places;
    }
    let mut next = 0;
    plans
        .iter()
        .map(|plan| {
            next += plan.words;
            next - plan.words
        })
        .collect()
}
