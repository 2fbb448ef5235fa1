//! Whole scenes as files would describe them, made without files.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DAffine3, DVec3, UVec2, Vec2, Vec3};

use crate::components::{
    Camera, Environment, Film, Lobe, Material, MeshData, Passage, Render, ShaderValues, Transform,
};
use crate::scene::generate::{Corners, icosphere, to_mesh};
use crate::scene::{MeshEntry, SceneDescription};

/// A film and a camera.
pub fn empty(size: UVec2, camera: Camera) -> SceneDescription {
    SceneDescription {
        name: "stress".to_owned(),
        meshes: BTreeMap::new(),
        materials: BTreeMap::new(),
        textures: BTreeMap::new(),
        cameras: BTreeMap::from([("eye".to_owned(), camera)]),
        active: "eye".to_owned(),
        lights: BTreeMap::new(),
        film: Film { size, ..Film::default() },
        render: Render { max_depth: 6, ..Render::default() },
        shader: ShaderValues::default(),
        environment: None,
    }
}

/// Adds a mesh of a material of its own.
pub fn add(description: &mut SceneDescription, name: &str, mesh: MeshData, place: DAffine3, material: Material) {
    description.materials.insert(name.to_owned(), material.into());
    let mesh = MeshEntry { geometry: Arc::new(mesh), transform: Transform(place), material: name.to_owned() };
    description.meshes.insert(name.to_owned(), mesh);
}

/// The parallelogram of a corner and two edges, in texture coordinates from 0 to 1; its normal is their cross product.
pub fn quad(corner: Vec3, e: Vec3, f: Vec3) -> MeshData {
    let triangles = vec![[0, 1, 2], [0, 2, 3]];
    MeshData {
        positions: [corner, corner + e, corner + e + f, corner + f].map(|p| p.as_dvec3()).to_vec(),
        uvs: vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y],
        uv_triangles: triangles.clone(),
        triangles,
        ..MeshData::default()
    }
}

/// A ball with smooth normals.
pub fn ball(centre: DVec3, radius: f64) -> MeshData {
    let corners = icosphere(2);
    let triangles: Vec<[u32; 3]> = (0..corners.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    MeshData {
        positions: corners.iter().flatten().map(|n| centre + radius * n).collect(),
        triangles: triangles.clone(),
        normals: corners.iter().flatten().map(|n| n.as_vec3()).collect(),
        normal_triangles: triangles,
        ..MeshData::default()
    }
}

pub fn matte(kd: Vec3) -> Material {
    Material { diffuse: kd, ..Material::default() }
}

/// What a room has in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// Two balls, one rough metal and one glazed.
    Rough,
    /// Two balls, of glass and a mirror.
    Smooth,
}

/// A room open to the viewer under a dim sky: red and green walls, a large light below the ceiling, two balls. All of it, the camera
/// too, is put where `place` says; that keeps angles.
pub fn room(size: UVec2, inside: Inside, place: DAffine3) -> SceneDescription {
    let at = |p: DVec3| place.transform_point3(p);
    let (position, look_at) = (at(DVec3::new(0.1, 0.05, 3.4)), at(DVec3::ZERO));
    let mut scene = empty(size, Camera { position, look_at, up: DVec3::Y, fov_y: 42.0, ..Camera::default() });
    scene.environment = Some(Environment::Constant(Vec3::new(0.2, 0.25, 0.3)));
    let white = matte(Vec3::splat(0.73));
    let (red, green) = (matte(Vec3::new(0.63, 0.1, 0.1)), matte(Vec3::new(0.14, 0.45, 0.2)));
    for (side, material) in [red, green, white, white, white].into_iter().enumerate() {
        let (axis, sign) = (side / 2, if side % 2 == 0 { -1.0 } else { 1.0 });
        let (e, f) = (Vec3::AXES[(axis + 1) % 3], Vec3::AXES[(axis + 2) % 3]);
        let (e, f) = if sign < 0.0 { (e, f) } else { (f, e) };
        add(
            &mut scene,
            &format!("wall {side}"),
            quad(Vec3::AXES[axis] * sign - e - f, 2.0 * e, 2.0 * f),
            place,
            material,
        );
    }
    let lamp = Material { diffuse: Vec3::ZERO, emission: Vec3::splat(4.0), ..Material::default() };
    add(&mut scene, "lamp", quad(Vec3::new(-0.7, 0.98, -0.7), Vec3::X * 1.4, Vec3::Z * 1.4), place, lamp);
    let [left, right] = match inside {
        Inside::Rough => [
            Material { diffuse: Vec3::new(0.9, 0.6, 0.3), metallic: 1.0, lobe: Lobe::Ggx(0.5), ..Material::default() },
            Material { specular: Vec3::splat(0.3), lobe: Lobe::Phong(30.0), ..matte(Vec3::splat(0.5)) },
        ],
        Inside::Smooth => [
            Material { passage: Passage::Glass(1.5), filter: Vec3::new(0.9, 1.0, 0.95), ..Material::default() },
            Material { specular: Vec3::splat(0.8), lobe: Lobe::Mirror, ..matte(Vec3::splat(0.1)) },
        ],
    };
    add(&mut scene, "left", ball(DVec3::new(-0.45, -0.5, -0.3), 0.45), place, left);
    add(&mut scene, "right", ball(DVec3::new(0.45, -0.55, 0.3), 0.4), place, right);
    scene
}

/// The room without its lamp, and a thousand small ones in a grid below its ceiling, in three colours.
pub fn thousand_lights(size: UVec2) -> SceneDescription {
    let mut scene = room(size, Inside::Rough, DAffine3::IDENTITY);
    scene.meshes.remove("lamp");
    for (colour, emission) in
        [Vec3::new(9.0, 2.0, 1.0), Vec3::new(1.0, 8.0, 2.0), Vec3::new(2.0, 3.0, 30.0)].into_iter().enumerate()
    {
        let grid = |i: usize| Vec3::new((i % 10) as f32, (i / 100) as f32, (i / 10 % 10) as f32);
        let triangles: Vec<Corners> = (0..1000)
            .filter(|i| i % 3 == colour)
            .map(|i| grid(i) * Vec3::new(0.15, -0.04, 0.15) + Vec3::new(-0.7, 0.9, -0.7))
            .map(|at| [at, at + 0.01 * Vec3::X, at + 0.01 * (Vec3::Z + 0.3 * Vec3::Y)])
            .collect();
        let lamp = Material { emission, ..matte(Vec3::splat(0.3)) };
        add(&mut scene, &format!("lamps {colour}"), to_mesh(&triangles), DAffine3::IDENTITY, lamp);
    }
    scene
}
