//! Lights without extent: a surface asks every one of them.

use bevy_ecs::prelude::*;
use glam::DVec3;

use super::bsdf::{Bsdf, Facing};
use super::random::Random;
use super::scene::Scene;
use crate::components::PointLight;

/// All of them.
pub struct PointLights(Vec<PointLight>);

impl PointLights {
    pub fn read(world: &mut World) -> Self {
        let mut query = world.query::<(&Name, &PointLight)>();
        let mut named: Vec<_> = query.iter(world).map(|(name, light)| (name.as_str().to_owned(), *light)).collect();
        named.sort_by(|a, b| a.0.cmp(&b.0));
        Self(named.into_iter().map(|(_, light)| light).collect())
    }

    /// What a surface reflects of all points. Light goes straight on through up to `passes` surfaces, where a draw from them does.
    pub fn ask(
        &self,
        scene: &Scene,
        at: DVec3,
        facing: &Facing,
        bsdf: &Bsdf,
        passes: u32,
        random: &mut Random,
    ) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for light in &self.0 {
            let to = light.position - at;
            let wi = to.normalize_or_zero();
            let (value, _) = bsdf.evaluate(facing, wi);
            let sent = value * intensity(light, -wi) / to.length_squared().max(f64::MIN_POSITIVE);
            if sent != DVec3::ZERO {
                sum += sent * part_that_arrives(scene, at, light.position, passes, random);
            }
        }
        sum
    }
}

/// What goes straight on from the one point to the other.
fn part_that_arrives(scene: &Scene, from: DVec3, to: DVec3, passes: u32, random: &mut Random) -> DVec3 {
    let direction = (to - from).normalize();
    let (mut at, mut part) = (from, DVec3::ONE);
    for met in 0..=passes {
        let before = |hit: &super::tree::Hit| hit.t < (1.0 - 1e-9) * (to - at).length();
        let Some(hit) = scene.closest(at, direction, random).filter(before) else { return part };
        if met == passes {
            break;
        }
        let facing = scene.facing(&hit, direction, random);
        let bsdf = scene.substance(&hit).bsdf(scene.uv(&hit), random);
        match bsdf.draw(&facing, random) {
            Some(draw) if draw.pdf == 0.0 && draw.wi == direction => part *= draw.weight,
            _ => break,
        }
        at += hit.t * direction;
    }
    DVec3::ZERO
}

/// W/sr in a direction away from the light: whole within the inner cone of a spot, none beyond the outer one, and in between by the cubic of
/// the cosine that is flat at both ends.
fn intensity(light: &PointLight, direction: DVec3) -> DVec3 {
    let whole = light.intensity.as_dvec3();
    let Some(cone) = light.cone else { return whole };
    let cos = direction.dot((cone.look_at - light.position).normalize());
    let edge = 0.5 * cone.angle.to_radians();
    let (least, most) = (edge.cos(), (edge * (1.0 - cone.blend)).cos());
    if cos >= most {
        return whole;
    }
    if cos <= least {
        return DVec3::ZERO;
    }
    let part = (cos - least) / (most - least);
    whole * part * part * (3.0 - 2.0 * part)
}
