//! One mesh in thousands of places, scaled and mirrored.

use std::sync::Arc;

use glam::{DAffine3, DQuat, DVec3, UVec2, Vec3};

use crate::components::{Camera, Environment, MeshData, Render, Transform};
use crate::scene::generate::{SplitMix, icosphere};
use crate::scene::{MeshEntry, SceneDescription};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::described::{empty, matte};

pub static ROW: Row = Row {
    name: "instances",
    holds: "ten thousand places of one mesh, scaled by 1e-3 to 1e3 and mirrored, look as one mesh of all their triangles",
    quantity: "pixels that differ",
    most: 0.0,
    unit: "triangles",
    sizes: [80_000, 800_000, 800_000],
    measure,
};

/// Triangles of the mesh.
const TRIANGLES: usize = 80;

/// A place for each, the more of space the larger it is.
fn places(count: usize) -> Vec<DAffine3> {
    let mut random = SplitMix(77);
    let place = |i: usize| {
        let scale = 10f64.powf(random.range(-3.0, 3.0));
        let mirrored = if i.is_multiple_of(2) { scale } else { -scale };
        let axis = DVec3::new(random.range(-1.0, 1.0), random.range(-1.0, 1.0), random.range(-1.0, 1.0)).normalize();
        let way = DVec3::new(random.range(-1.0, 1.0), random.range(-1.0, 1.0), random.range(-1.0, 1.0)).normalize();
        DAffine3::from_scale_rotation_translation(
            DVec3::new(mirrored, scale, 0.7 * scale),
            DQuat::from_axis_angle(axis, random.range(0.0, 6.0)),
            way * (1.5 * scale + 4.0) + way * random.range(0.0, 3.0) * scale,
        )
    };
    (0..count).map(place).collect()
}

fn scene(meshes: impl IntoIterator<Item = MeshEntry>) -> SceneDescription {
    let camera = Camera {
        position: DVec3::ZERO,
        look_at: DVec3::new(1.0, 0.2, 0.3),
        up: DVec3::Y,
        fov_y: 90.0,
        ..Camera::default()
    };
    let mut scene = empty(UVec2::splat(64), camera);
    scene.render = Render { spp: 4, max_depth: 4, ..Render::default() };
    scene.environment = Some(Environment::Constant(Vec3::new(0.5, 0.7, 1.0)));
    scene.materials.insert("grey".to_owned(), matte(Vec3::splat(0.6)).into());
    // Names are in the order of the places.
    scene.meshes = meshes.into_iter().enumerate().map(|(i, mesh)| (format!("{i:06}"), mesh)).collect();
    scene
}

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let places = places(size as usize / TRIANGLES);
    let corners = icosphere(1);
    let indices = |first: u32| (0..corners.len() as u32).map(move |i| [0, 1, 2].map(|k| first + 3 * i + k));
    let ball = Arc::new(MeshData {
        positions: corners.iter().flatten().copied().collect(),
        triangles: indices(0).collect(),
        ..MeshData::default()
    });
    let entry = |geometry: Arc<MeshData>, place| MeshEntry {
        geometry,
        transform: Transform(place),
        material: "grey".to_owned(),
    };
    let instances = lab.film(&scene(places.iter().map(|place| entry(ball.clone(), *place))))?;
    lab.tell(1, 2);
    let mut flat = MeshData::default();
    for place in &places {
        let first = flat.positions.len() as u32;
        flat.positions.extend(ball.positions.iter().map(|corner| place.transform_point3(*corner)));
        flat.triangles.extend(indices(first));
    }
    let whole = lab.film(&scene([entry(Arc::new(flat), DAffine3::IDENTITY)]))?;
    let differ = instances.pixels.iter().zip(&whole.pixels).filter(|(a, b)| a != b).count();
    let sky = whole.rgb.iter().filter(|rgb| **rgb == [0.5, 0.7, 1.0]).count();
    if sky * 10 > 9 * whole.rgb.len() {
        return Err(StressError::Broken("hardly anything is seen".to_owned()));
    }
    Ok(Measured::new(differ as f64, size).noted(format!("of {}; {} places", whole.rgb.len(), places.len())))
}
