//! Small scenes of components for the f64 path tracer.

use std::sync::Arc;

use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3, UVec2, Vec3};
use lucerna::components::{
    self, Active, Camera, Environment, EnvironmentMap, Film, Geometry, Lens, Material, MeshData, PointLight, Render,
    Transform, UsesMaterial,
};
use lucerna::oracle::Oracle;
use lucerna::scene::MtlMaterial;
use lucerna::scene::generate::{Corners, icosphere, to_mesh};

/// A world that is filled part by part.
pub struct Stage {
    world: World,
    parts: usize,
}

pub fn matte(kd: Vec3) -> Material {
    Material { diffuse: kd, ..Material::default() }
}

pub fn glowing(emission: Vec3) -> Material {
    Material { diffuse: Vec3::ZERO, emission, ..Material::default() }
}

/// The parallelogram of a corner and two edges; its normal is their cross product.
pub fn quad(corner: Vec3, e: Vec3, f: Vec3) -> [Corners; 2] {
    [[corner, corner + e, corner + e + f], [corner, corner + e + f, corner + f]]
}

impl Stage {
    /// A film, and a camera of 42 degrees.
    pub fn new(size: UVec2, max_depth: u32, position: DVec3, look_at: DVec3) -> Self {
        let mut world = World::new();
        let camera = Camera { position, look_at, up: DVec3::Y, fov_y: 42.0, ..Camera::default() };
        world.spawn((Name::new("eye"), camera, Active));
        world.spawn((Name::new("film"), Film { size, ..Film::default() }, Render { max_depth, ..Render::default() }));
        Self { world, parts: 0 }
    }

    /// Vertical, degrees.
    pub fn fov_y(&mut self, degrees: f64) {
        for mut camera in self.world.query::<&mut Camera>().iter_mut(&mut self.world) {
            camera.fov_y = degrees;
        }
    }

    pub fn lens(&mut self, lens: Lens) {
        for mut camera in self.world.query::<&mut Camera>().iter_mut(&mut self.world) {
            camera.lens = lens;
        }
    }

    pub fn sky(&mut self, environment: Environment) {
        self.world.spawn((Name::new("sky"), environment));
    }

    pub fn light(&mut self, light: PointLight) {
        self.world.spawn((Name::new("light"), light));
    }

    pub fn mesh(&mut self, mesh: MeshData, material: Material) {
        self.parts += 1;
        let material = self.world.spawn((Name::new(format!("material {}", self.parts)), material)).id();
        let name = Name::new(format!("mesh {}", self.parts));
        self.world.spawn((name, Geometry(Arc::new(mesh)), Transform::default(), UsesMaterial(material)));
    }

    pub fn part(&mut self, triangles: &[Corners], material: Material) {
        self.mesh(to_mesh(triangles), material);
    }

    /// The walls of a box from -1 to 1, seen from inside: x-, x+, y-, y+, z-, z+; none where there is no material.
    pub fn walls(&mut self, materials: [Option<Material>; 6]) {
        for (side, material) in materials.into_iter().enumerate() {
            let Some(material) = material else { continue };
            let axis = side / 2;
            let sign = if side % 2 == 0 { -1.0 } else { 1.0 };
            let (e, f) = (Vec3::AXES[(axis + 1) % 3], Vec3::AXES[(axis + 2) % 3]);
            let (e, f) = if sign < 0.0 { (e, f) } else { (f, e) };
            self.part(&quad(Vec3::AXES[axis] * sign - e - f, 2.0 * e, 2.0 * f), material);
        }
    }

    /// A ball with smooth normals.
    pub fn ball(&mut self, centre: DVec3, radius: f64, material: Material) {
        let corners = icosphere(2);
        let triangles: Vec<[u32; 3]> = (0..corners.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mesh = MeshData {
            positions: corners.iter().flatten().map(|n| centre + radius * n).collect(),
            triangles: triangles.clone(),
            normals: corners.iter().flatten().map(|n| n.as_vec3()).collect(),
            normal_triangles: triangles,
            ..MeshData::default()
        };
        self.mesh(mesh, material);
    }

    /// A room open to the viewer: red and green walls, a large light in the ceiling, and in it two balls.
    pub fn room(size: UVec2, balls: [Material; 2]) -> Self {
        let mut stage = Self::new(size, 6, DVec3::new(0.1, 0.05, 3.4), DVec3::ZERO);
        let white = Some(matte(Vec3::splat(0.73)));
        let (red, green) = (Some(matte(Vec3::new(0.63, 0.1, 0.1))), Some(matte(Vec3::new(0.14, 0.45, 0.2))));
        stage.walls([red, green, white, white, white, None]);
        stage.part(&quad(Vec3::new(-0.7, 0.98, -0.7), Vec3::X * 1.4, Vec3::Z * 1.4), glowing(Vec3::splat(4.0)));
        let [left, right] = balls;
        stage.ball(DVec3::new(-0.45, -0.5, -0.3), 0.45, left);
        stage.ball(DVec3::new(0.45, -0.55, 0.3), 0.4, right);
        stage
    }

    /// All of it, with every component of scenes known.
    pub fn world(&mut self) -> &World {
        components::register(&mut self.world);
        self.world.register_component::<MtlMaterial>();
        &self.world
    }

    pub fn oracle(&mut self) -> Oracle {
        Oracle::new(&mut self.world).unwrap()
    }
}

/// A sky of 8 x 4 pixels, each another colour, one of them bright and one black.
pub fn sky_map() -> Environment {
    let size = UVec2::new(8, 4);
    let mut pixels: Vec<Vec3> =
        (0..size.x * size.y).map(|i| Vec3::new(0.3, 0.2 + 0.02 * i as f32, 0.1 * (i % 5) as f32 + 0.1)).collect();
    pixels[11] = Vec3::new(8.0, 6.0, 5.0);
    pixels[20] = Vec3::ZERO;
    Environment::Map {
        image: Arc::new(EnvironmentMap { size, pixels }),
        strength: 0.8,
        tint: Vec3::ONE,
        turn: DMat3::IDENTITY,
    }
}
