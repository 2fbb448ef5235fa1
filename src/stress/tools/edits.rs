//! Random edits of a scene, each a function of dice and of the scene alone: what the law of edits is tried with.

use std::collections::BTreeMap;
use std::sync::Arc;

use bevy_ecs::component::Mutable;
use bevy_ecs::prelude::*;
use glam::{DAffine3, DQuat, DVec3, UVec2, Vec3};

use crate::components::{
    Adaptive, Camera, Crop, Energy, Environment, Film, Geometry, Integrator, Maps, Material, Name, PointLight, Render,
    Reuse, Sampler, Texels, Texture, TextureImage, Transform, UsesMaterial,
};
use crate::scene::generate::SplitMix;
use crate::scene::{self, MtlMaterial, SceneDescription};

/// Random choices.
pub struct Dice(SplitMix);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(SplitMix(seed))
    }

    /// Below `sides`, which is above 0.
    pub fn roll(&mut self, sides: u64) -> u64 {
        self.0.next_u64() % sides
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    /// One of several; none of none.
    pub fn pick<'a, T>(&mut self, items: &'a [T]) -> Option<&'a T> {
        let sides = items.len() as u64;
        (sides > 0).then(|| &items[self.roll(sides) as usize])
    }

    fn colour(&mut self) -> Vec3 {
        Vec3::new(self.unit() as f32, self.unit() as f32, self.unit() as f32)
    }
}

/// What is edited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Camera,
    Material,
    Lobe,
    Transform,
    MeshAdded,
    MeshRemoved,
    OtherMaterial,
    SceneAgain,
    Film,
    Settings,
    Estimator,
    Sky,
    Light,
    Texture,
    Map,
}

/// All kinds; those that are twice in it are made twice as often.
const KINDS: [Kind; 18] = [
    Kind::Camera,
    Kind::Material,
    Kind::Material,
    Kind::Lobe,
    Kind::Transform,
    Kind::Transform,
    Kind::MeshAdded,
    Kind::MeshRemoved,
    Kind::OtherMaterial,
    Kind::SceneAgain,
    Kind::Film,
    Kind::Settings,
    Kind::Estimator,
    Kind::Sky,
    Kind::Light,
    Kind::Light,
    Kind::Texture,
    Kind::Map,
];

/// Makes one edit, and says what it was. `file` is the scene that is applied again now and then. Where an edit of the kind
/// `unseen` writes a component, change detection does not hear of it; those that add or remove entities can't be hidden.
pub fn edit(world: &mut World, dice: &mut Dice, file: &SceneDescription, unseen: Option<Kind>) -> String {
    let kind = KINDS[dice.roll(KINDS.len() as u64) as usize];
    let hidden = unseen == Some(kind);
    let what = match kind {
        Kind::Camera => camera(world, dice, hidden),
        Kind::Material | Kind::Lobe => material(world, dice, kind, hidden),
        Kind::Transform | Kind::MeshAdded | Kind::MeshRemoved | Kind::OtherMaterial => mesh(world, dice, kind, hidden),
        Kind::SceneAgain => {
            scene::apply(world, file);
            Some("the first scene".to_owned())
        }
        Kind::Film => film(world, dice, hidden),
        Kind::Settings | Kind::Estimator => settings(world, dice, kind, hidden),
        Kind::Sky => Some(sky(world, dice)),
        Kind::Light => light(world, dice, hidden),
        Kind::Texture => texture(world, dice, hidden),
        Kind::Map => map(world, dice),
    };
    format!("{kind:?}: {}", what.unwrap_or_else(|| "there is none".to_owned()))
}

/// All entities of a kind that have a name, in the order of those.
fn all<T: Component>(world: &mut World) -> Vec<(String, Entity)> {
    let mut found: Vec<_> =
        world.query_filtered::<(&Name, Entity), With<T>>().iter(world).map(|(n, e)| (n.to_string(), e)).collect();
    found.sort();
    found
}

fn any<T: Component>(world: &mut World, dice: &mut Dice) -> Option<(String, Entity)> {
    dice.pick(&all::<T>(world)).cloned()
}

/// Changes a component, which `hidden` nobody is told of.
fn change<T: Component<Mutability = Mutable>>(
    world: &mut World,
    entity: Entity,
    hidden: bool,
    how: impl FnOnce(&mut T),
) {
    if let Some(mut held) = world.get_mut::<T>(entity) {
        if hidden { how(held.bypass_change_detection()) } else { how(&mut held) }
    }
}

fn camera(world: &mut World, dice: &mut Dice, hidden: bool) -> Option<String> {
    let (name, camera) = any::<Camera>(world, dice)?;
    let way = DVec3::new(dice.unit() - 0.5, dice.unit() - 0.5, 0.0);
    change(world, camera, hidden, |camera: &mut Camera| camera.position += way);
    Some(format!("`{name}` by {way}"))
}

fn material(world: &mut World, dice: &mut Dice, kind: Kind, hidden: bool) -> Option<String> {
    let (name, material) = any::<Material>(world, dice)?;
    if kind == Kind::Lobe {
        let specular = Vec3::splat(dice.roll(2) as f32 * 0.4);
        change(world, material, hidden, |material: &mut Material| material.specular = specular);
        return Some(format!("`{name}` with specular {specular}"));
    }
    let diffuse = dice.colour();
    let emission = if dice.roll(3) == 0 { Vec3::splat(dice.unit() as f32 * 8.0) } else { Vec3::ZERO };
    change(world, material, hidden, |material: &mut Material| {
        (material.diffuse, material.emission) = (diffuse, emission);
    });
    Some(format!("`{name}` with diffuse {diffuse}, emission {emission}"))
}

fn mesh(world: &mut World, dice: &mut Dice, kind: Kind, hidden: bool) -> Option<String> {
    let meshes = all::<Geometry>(world);
    let (name, mesh) = dice.pick(&meshes)?.clone();
    Some(match kind {
        Kind::Transform => {
            let turn = DQuat::from_rotation_y(dice.unit());
            let far = if dice.roll(6) == 0 { 1e4 } else { 0.3 };
            let place = DVec3::new(dice.unit() * far, 0.1 * dice.unit(), 0.0);
            let place_of = DAffine3::from_rotation_translation(turn, place);
            change(world, mesh, hidden, |transform: &mut Transform| transform.0 = place_of);
            format!("`{name}` to {place}")
        }
        Kind::MeshAdded => {
            let (other, material) = any::<Material>(world, dice)?;
            let geometry = world.get::<Geometry>(mesh)?.clone();
            let added = format!("added/{}", dice.roll(1 << 40));
            let place = Transform(DAffine3::from_translation(DVec3::splat(dice.unit() - 0.5)));
            world.spawn((Name::new(added.clone()), geometry, place, UsesMaterial(material)));
            format!("`{added}` like `{name}`, of `{other}`")
        }
        Kind::MeshRemoved if meshes.len() > 1 => {
            world.despawn(mesh);
            format!("`{name}`")
        }
        Kind::MeshRemoved => "none, for it is the last".to_owned(),
        _ => {
            let (other, material) = any::<Material>(world, dice)?;
            change(world, mesh, hidden, |uses: &mut UsesMaterial| uses.0 = material);
            format!("`{name}` of `{other}`")
        }
    })
}

fn film(world: &mut World, dice: &mut Dice, hidden: bool) -> Option<String> {
    let (_, film) = any::<Film>(world, dice)?;
    let size = UVec2::new(8 + dice.roll(16) as u32, 8 + dice.roll(16) as u32);
    let crop = (dice.roll(2) == 0).then_some(Crop { min: UVec2::new(1, 2), max: UVec2::new(7, 5) });
    change(world, film, hidden, |film: &mut Film| (film.size, film.crop) = (size, crop));
    Some(format!("{size}, {}", if crop.is_some() { "cropped" } else { "whole" }))
}

/// Settings that kernels get as numbers, or those by which they are compiled.
fn settings(world: &mut World, dice: &mut Dice, kind: Kind, hidden: bool) -> Option<String> {
    let (_, film) = any::<Render>(world, dice)?;
    let mut render = *world.get::<Render>(film)?;
    if kind == Kind::Estimator {
        match dice.roll(4) {
            0 => render.roulette = !render.roulette,
            1 => render.sampler = if render.sampler == Sampler::Pcg { Sampler::Sobol } else { Sampler::Pcg },
            2 => render.reuse = if render.reuse == Reuse::Off { Reuse::Tiles } else { Reuse::Off },
            _ if render.integrator == Integrator::Path => render.integrator = Integrator::Bsdf,
            _ => render.integrator = Integrator::Path,
        }
    } else {
        render.seed = dice.roll(1 << 32) as u32;
        render.max_depth = 1 + dice.roll(8) as u32;
        render.spp = 1 + dice.roll(3) as u32;
        render.energy = if dice.roll(2) == 0 { Energy::Preserve } else { Energy::AsWritten };
        // An adaptive film has 16 samples before it is one.
        render.adaptive = if dice.roll(8) == 0 { Adaptive::On } else { Adaptive::Off };
        if render.adaptive == Adaptive::On {
            render.spp += 20;
        }
    }
    change(world, film, hidden, |held: &mut Render| *held = render);
    Some(format!("{render:?}"))
}

fn sky(world: &mut World, dice: &mut Dice) -> String {
    match all::<Environment>(world).first() {
        Some((name, sky)) => {
            world.despawn(*sky);
            format!("`{name}` goes")
        }
        None => {
            let radiance = dice.colour();
            world.spawn((Name::new("sky"), Environment::Constant(radiance)));
            format!("of {radiance}")
        }
    }
}

/// A point light is added, moved or removed.
fn light(world: &mut World, dice: &mut Dice, hidden: bool) -> Option<String> {
    let position = DVec3::new(dice.unit() - 0.5, dice.unit(), dice.unit() - 0.5);
    let lights = all::<PointLight>(world);
    if lights.len() < 2 {
        let name = format!("light/{}", dice.roll(1 << 40));
        let intensity = dice.colour();
        world.spawn((Name::new(name.clone()), PointLight { position, intensity, cone: None }));
        return Some(format!("`{name}` at {position}, of {intensity}"));
    }
    let (name, light) = dice.pick(&lights)?.clone();
    if dice.roll(3) == 0 {
        world.despawn(light);
        return Some(format!("`{name}` goes"));
    }
    change(world, light, hidden, |light: &mut PointLight| light.position = position);
    Some(format!("`{name}` to {position}"))
}

/// A texture gets another picture, of the same size or not.
fn texture(world: &mut World, dice: &mut Dice, hidden: bool) -> Option<String> {
    let (name, texture) = any::<Texture>(world, dice)?;
    let size = *dice.pick(&[UVec2::new(4, 4), UVec2::new(16, 8), UVec2::new(33, 17)])?;
    let image = Arc::new(picture(size, dice));
    change(world, texture, hidden, |texture: &mut Texture| texture.image = image);
    Some(format!("`{name}` of {size}"))
}

/// A picture of random colours.
pub fn picture(size: UVec2, dice: &mut Dice) -> TextureImage {
    let mut texel = || [dice.roll(256) as u8, dice.roll(256) as u8, dice.roll(256) as u8, 255];
    TextureImage { size, texels: Texels::Rgba8((0..size.element_product()).map(|_| texel()).collect()) }
}

/// A map of a material goes off or on, as in a window's panel.
fn map(world: &mut World, dice: &mut Dice) -> Option<String> {
    let textures: BTreeMap<String, Entity> = all::<Texture>(world).into_iter().collect();
    let mut mapped = all::<MtlMaterial>(world);
    mapped.retain(|(_, entity)| world.get::<MtlMaterial>(*entity).is_some_and(|numbers| numbers.maps.kd.is_some()));
    let (name, entity) = dice.pick(&mapped)?.clone();
    let mut numbers = world.get::<MtlMaterial>(entity)?.clone();
    let map = numbers.maps.kd.as_mut()?;
    map.off = !map.off;
    let on = !map.off;
    let (material, maps) = numbers.rendered(&textures);
    change(world, entity, false, |held: &mut MtlMaterial| *held = numbers);
    change(world, entity, false, |held: &mut Material| *held = material);
    change(world, entity, false, |held: &mut Maps| *held = maps);
    Some(format!("of `{name}` {}", if on { "on" } else { "off" }))
}
