//! Lights without extent: the f64 path tracer against what is known, and the engine against it.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec3, UVec2, Vec3};
use lucerna::components::{Environment, Integrator, Material, Passage, PointLight, Sampler, SpotCone, Transform};
use lucerna::scene::generate::to_mesh;
use lucerna::scene::{MeshEntry, SceneDescription};

use crate::support::stage::{Stage, matte, quad};

use super::engine::{judge, yard};
use super::{coated, pane, rough};

fn spot(position: DVec3, look_at: DVec3, intensity: Vec3) -> PointLight {
    PointLight { position, intensity, cone: Some(SpotCone { look_at, angle: 60.0, blend: 0.5 }) }
}

#[test]
fn the_oracle_has_the_inverse_square_law() {
    let lamp = DVec3::new(0.3, 0.8, 0.1);
    let mut stage = Stage::new(UVec2::ONE, 2, DVec3::new(0.0, 1.0, 1.0), DVec3::ZERO);
    stage.fov_y(1e-6);
    stage.part(&quad(Vec3::new(-2.0, 0.0, 2.0), Vec3::X * 4.0, Vec3::Z * -4.0), matte(Vec3::splat(0.5)));
    stage.light(PointLight { position: lamp, intensity: Vec3::new(1.0, 2.0, 4.0), cone: None });
    let got = stage.oracle().render(0..1, 1, 1, &|_, _| ()).mean[0];
    let right = 0.5 / PI * DVec3::new(1.0, 2.0, 4.0) * lamp.y / lamp.length().powi(3);
    assert!((got / right - 1.0).abs().max_element() < 1e-6, "{got}, not {right}");
}

/// The yard at dusk: a point and two spots, some of it behind a pane and a veil.
fn lit(glazed: bool) -> SceneDescription {
    let mut scene = yard(12, Environment::Constant(Vec3::new(0.02, 0.03, 0.05)));
    let point = PointLight { position: DVec3::new(0.5, 1.5, 1.0), intensity: Vec3::new(4.0, 3.0, 2.0), cone: None };
    scene.lights.insert("bulb".to_owned(), point);
    scene.lights.insert("left".to_owned(), spot(DVec3::new(-3.0, 4.0, 2.0), DVec3::ZERO, Vec3::new(9.0, 20.0, 30.0)));
    scene.lights.insert("right".to_owned(), spot(DVec3::new(4.0, 3.0, 3.0), DVec3::ZERO, Vec3::new(30.0, 20.0, 9.0)));
    if glazed {
        let veil = Material { passage: Passage::SeeThrough(0.4), filter: Vec3::new(1.0, 0.8, 0.9), ..rough() };
        for (name, material, x) in [("pane", pane(), 2.0), ("veil", veil, -2.0), ("second", pane(), 2.5)] {
            scene.materials.insert(name.to_owned(), material.into());
            let part = quad(Vec3::new(x, 0.1, -2.0), 5.0 * Vec3::Y, Vec3::new(0.5, 0.0, 5.0));
            let geometry = Arc::new(to_mesh(&part));
            let mesh = MeshEntry { geometry, transform: Transform::default(), material: name.to_owned() };
            scene.meshes.insert(name.to_owned(), mesh);
        }
    }
    scene
}

#[test]
fn equals_the_engine_under_point_lights() {
    for integrator in [Integrator::Path, Integrator::Bsdf] {
        judge("a yard under spots", lit(false), integrator, Sampler::Sobol, 128);
    }
    let mut shiny = lit(false);
    let name = shiny.materials.keys().next().expect("a material").clone();
    shiny.materials.insert(name, coated().into());
    judge("a coated yard under spots", shiny, Integrator::Path, Sampler::Pcg, 128);
}

#[test]
fn equals_the_engine_under_point_lights_behind_panes() {
    judge("a glazed yard under spots", lit(true), Integrator::Path, Sampler::Sobol, 256);
}
