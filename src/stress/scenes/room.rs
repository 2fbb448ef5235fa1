//! Small scenes as the path kernel gets them.

use crate::components::{Camera, Crop, Energy, Lens, Lobe, Material, Passage};
use crate::cpu::path::PathScene;
use crate::cpu::rng::Source;
use crate::cpu::tree;
use crate::gpu::{GpuError, Runtime};
use crate::layout::film::film_exponent;
use crate::layout::light::{LightTable, PointLightRecord};
use crate::layout::sky::{SkyTable, Sun};
use crate::layout::trace::{MaterialRecord, Shading, TraceParams};
use crate::layout::tree::{Triangle, root};
use crate::passes::trace;
use crate::prepare::camera;
use crate::prepare::lighting::Lighting;
use crate::prepare::{material, point};
use glam::{DMat3, DVec3, UVec2, Vec3};

/// A scene as the trace kernel gets it.
#[derive(Clone, Default)]
pub struct Room {
    pub triangles: Vec<Triangle>,
    pub materials: Vec<MaterialRecord>,
    /// In scene order, or empty.
    pub shading: Vec<Shading>,
    pub environment: Vec3,
    /// A picture of the sky, in place of the constant environment.
    pub sky: Option<SkyTable>,
    /// From directions of that picture to those of the scene.
    pub sky_turn: DMat3,
    /// Beside that picture.
    pub sun: Option<Sun>,
    /// Asked directly by both integrators.
    pub points: Vec<PointLightRecord>,
    pub roulette: bool,
    /// Paths are reused within tiles.
    pub reuse: bool,
    pub sampler: Source,
    /// Integrator `Path`: lights are asked directly.
    pub next_event: bool,
    /// Of the camera that looks in.
    pub lens: Lens,
}

/// A diffuse material that may emit.
pub fn matte(kd: Vec3, emission: Vec3) -> MaterialRecord {
    material::pack(&Material { diffuse: kd, emission, ..Material::BLACK }, Energy::Preserve)
}

/// A material of both lobes.
pub fn shiny(kd: Vec3, ks: Vec3, ns: f32) -> MaterialRecord {
    material::pack(&Material { diffuse: kd, specular: ks, lobe: Lobe::Phong(ns), ..Material::BLACK }, Energy::Preserve)
}

impl Room {
    pub fn material(&mut self, record: MaterialRecord) -> u32 {
        self.materials.push(record);
        self.materials.len() as u32 - 1
    }

    pub fn triangle(&mut self, [a, b, c]: [Vec3; 3], material: u32) {
        let index = self.triangles.len() as u32;
        self.triangles.push(Triangle { a, b, c, index, material, flags: 0 });
    }

    /// The parallelogram of a corner and two edges; its normal is their cross product.
    pub fn quad(&mut self, corner: Vec3, e: Vec3, f: Vec3, material: u32) {
        self.triangle([corner, corner + e, corner + e + f], material);
        self.triangle([corner, corner + e + f, corner + f], material);
    }

    /// The walls of a box from -1 to 1, seen from inside: x-, x+, y-, y+, z-, z+; none where there is no material.
    pub fn walls(&mut self, materials: [Option<u32>; 6]) {
        for (side, material) in materials.into_iter().enumerate() {
            let Some(material) = material else { continue };
            let axis = side / 2;
            let sign = if side % 2 == 0 { -1.0 } else { 1.0 };
            let (e, f) = (Vec3::AXES[(axis + 1) % 3], Vec3::AXES[(axis + 2) % 3]);
            let (e, f) = if sign < 0.0 { (e, f) } else { (f, e) };
            self.quad(Vec3::AXES[axis] * sign - e - f, 2.0 * e, 2.0 * f, material);
        }
    }

    /// A ball of triangles with smooth normals on it and flat ones on all that came before.
    pub fn ball(&mut self, centre: Vec3, radius: f32, material: u32) {
        self.shading.resize(self.triangles.len(), Shading::default());
        const RINGS: usize = 8;
        let point = |i: usize, j: usize| {
            let (theta, phi) =
                (std::f32::consts::PI * i as f32 / RINGS as f32, std::f32::consts::PI * j as f32 / RINGS as f32);
            Vec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin())
        };
        for i in 0..RINGS {
            for j in 0..2 * RINGS {
                let corners = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
                for normals in [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]] {
                    self.triangle(normals.map(|n| centre + radius * n), material);
                    self.shading.push(Shading::pack(normals));
                }
            }
        }
    }

    /// A lamp above all that is outdoors, behind a ball.
    pub fn lamp(&mut self) {
        let light = self.material(matte(Vec3::ZERO, Vec3::new(4.0, 3.0, 2.0)));
        self.quad(Vec3::new(-1.0, 1.2, -0.5), Vec3::X, Vec3::Z, light);
        self.shading.resize(self.triangles.len(), Shading::default());
    }

    /// The seed's room in small: red and green walls, a glossy block, a shiny ball, a light in the ceiling.
    pub fn cornell() -> Self {
        let mut room = Self { environment: Vec3::new(0.1, 0.2, 0.3), ..Self::default() };
        let white = room.material(matte(Vec3::splat(0.73), Vec3::ZERO));
        let red = room.material(matte(Vec3::new(0.63, 0.06, 0.05), Vec3::ZERO));
        let green = room.material(matte(Vec3::new(0.14, 0.45, 0.09), Vec3::ZERO));
        let light = room.material(matte(Vec3::ZERO, Vec3::splat(10.0)));
        let block = room.material(shiny(Vec3::splat(0.4), Vec3::splat(0.5), 33.0));
        let ball = room.material(shiny(Vec3::splat(0.6), Vec3::splat(0.3), 25.0));
        room.walls([Some(red), Some(green), Some(white), Some(white), Some(white), None]);
        room.quad(Vec3::new(-0.5, 0.98, -0.5), Vec3::X, Vec3::Z, light);
        let (e, f, up) = (Vec3::new(0.5, 0.0, 0.3), Vec3::new(-0.3, 0.0, 0.5), Vec3::Y * 1.2);
        let corner = Vec3::new(-0.5, -0.999, -0.7);
        for (c, e, f) in [(corner, up, e), (corner, f, up), (corner + e, up, f), (corner + f, e, up)] {
            room.quad(c, e, f, block);
        }
        room.quad(corner + up, f, e, block);
        room.ball(Vec3::new(0.45, -0.6, 0.3), 0.39, ball);
        room
    }

    /// The same room with a glass ball, a mirror, a sheet of rough metal and a veil.
    pub fn glass() -> Self {
        let mut room = Self { environment: Vec3::new(0.3, 0.4, 0.5), ..Self::default() };
        let pack = |values: Material| material::pack(&values, Energy::Preserve);
        let white = room.material(matte(Vec3::splat(0.73), Vec3::ZERO));
        let red = room.material(matte(Vec3::new(0.63, 0.06, 0.05), Vec3::ZERO));
        let glow = room.material(matte(Vec3::splat(0.2), Vec3::new(1.0, 1.5, 2.0)));
        let mirror = room.material(pack(Material {
            diffuse: Vec3::splat(0.2),
            specular: Vec3::new(0.7, 0.6, 0.5),
            lobe: Lobe::Mirror,
            ..Material::BLACK
        }));
        let metal =
            Material { diffuse: Vec3::new(0.9, 0.6, 0.3), lobe: Lobe::Ggx(0.5), metallic: 1.0, ..Material::BLACK };
        let metal = room.material(pack(metal));
        let veil = Material {
            passage: Passage::SeeThrough(0.6),
            filter: Vec3::new(0.9, 0.7, 0.8),
            diffuse: Vec3::splat(0.3),
            ..Material::BLACK
        };
        let veil = room.material(pack(veil));
        let glass = Material { passage: Passage::Glass(1.5), filter: Vec3::new(0.9, 1.0, 0.95), ..Material::BLACK };
        let glass = room.material(pack(glass));
        room.walls([Some(red), Some(glow), Some(white), Some(glow), Some(white), None]);
        room.quad(Vec3::new(-0.9, -0.9, -0.9), Vec3::new(1.0, 0.0, -0.05), Vec3::Y * 1.5, mirror);
        room.quad(Vec3::new(0.2, -0.95, -0.3), Vec3::new(0.7, 0.1, 0.0), Vec3::new(0.0, 0.3, -0.6), metal);
        room.quad(Vec3::new(0.1, -0.2, 0.4), Vec3::new(0.8, 0.0, 0.1), Vec3::Y, veil);
        room.ball(Vec3::new(-0.3, -0.5, 0.2), 0.45, glass);
        room
    }

    /// A camera that looks in through the open side, and all else that the kernel is told.
    pub fn params(&self, size: UVec2) -> TraceParams {
        let mut params = TraceParams {
            environment: self.environment,
            layers: 1,
            max_depth: 8,
            root: root(self.triangles.len() as u32),
            seed: 1,
            ..TraceParams::default()
        };
        let view = Camera {
            position: DVec3::new(0.1, 0.05, 3.2),
            look_at: DVec3::ZERO,
            up: DVec3::Y,
            fov_y: 42.0,
            lens: self.lens,
        };
        camera::aim(&mut params, &view, size, DVec3::ZERO);
        camera::crop(&mut params, Crop { min: UVec2::ZERO, max: size });
        camera::fit_film(&mut params, self.exponent());
        let table = self.lights();
        let lighting = Lighting {
            lights: table.lights.len() as u32,
            light_density: table.density,
            points_alone: !self.next_event,
            sky: self.sky.as_ref().map_or(UVec2::ZERO, |sky| sky.size),
            sky_turn: self.sky_turn.as_mat3(),
            sky_power: self.sky_power(),
            sun: self.sun,
        };
        lighting.write(&mut params, 1.0);
        params
    }

    /// The lights that are asked directly.
    pub fn lights(&self) -> LightTable {
        let asked = if self.next_event { &self.triangles[..] } else { &[] };
        let sent = asked.iter().map(|triangle| (*triangle, self.materials[triangle.material as usize].emission));
        LightTable::of(sent, &self.materials, &self.points)
    }

    /// Of the sky as it is asked directly.
    fn sky_power(&self) -> f64 {
        self.sky.as_ref().filter(|_| self.next_event).map_or(0.0, |sky| sky.power)
    }

    /// Exponent of a film for this scene.
    pub fn exponent(&self) -> i32 {
        let sun = self.sun.map_or(Vec3::ZERO, |sun| sun.radiance);
        let brightest = sun.max(self.environment).max(Vec3::splat(self.sky.as_ref().map_or(0.0, |sky| sky.brightest)));
        let brightest =
            brightest.max(Vec3::splat(point::brightest(self.points.iter().copied(), Vec3::NEG_ONE, Vec3::ONE)));
        film_exponent(trace::largest_emission(&self.materials, &[], &[], brightest))
    }

    pub fn features(&self) -> Vec<&'static str> {
        let normals = !self.shading.is_empty();
        let (materials, environment, roulette) = (&self.materials[..], self.environment, self.roulette);
        let lights = !self.lights().lights.is_empty();
        let sobol = self.sampler == Source::Sobol;
        let (sky, sky_light) = (self.sky.is_some(), self.sky_power() > 0.0);
        trace::Needs {
            adaptive: false,
            materials,
            maps: &[],
            triangles: self.triangles.len() as u32,
            environment,
            sky,
            sky_light,
            sun: self.sun.is_some(),
            normals,
            roulette,
            reuse: self.reuse,
            lights,
            point_lights: !self.points.is_empty(),
            lens: self.lens.aperture > 0.0,
            sobol,
        }
        .features()
    }

    /// Uploads the scene and its tree, and switches its features on.
    pub fn load(&self, rig: &mut Runtime) -> Result<(), GpuError> {
        let tree = tree::build(&self.triangles);
        if let Some(sky) = &self.sky {
            rig.upload("sky", &sky.cells)?;
            rig.upload("sky_cdf", &sky.cdf)?;
        }
        if !self.lights().lights.is_empty() {
            rig.upload("lights", &self.lights().lights)?;
        }
        rig.upload("leaves", &tree.leaves)?;
        rig.upload("nodes", &tree.nodes)?;
        rig.upload("materials", &self.materials)?;
        if !self.shading.is_empty() {
            rig.upload("shading", &self.shading)?;
        }
        rig.set_features(&self.features());
        Ok(())
    }

    /// The f64 twin's view of it.
    pub fn twin(&self) -> PathScene<'_> {
        let mut scene = PathScene::new(&self.triangles, &self.materials);
        scene.shading = &self.shading;
        scene.roulette = self.roulette;
        scene.lights = (self.next_event || !self.points.is_empty()).then(|| self.lights());
        scene.sampler = self.sampler;
        scene.sky = self.sky.as_ref();
        scene.sky_turn = self.sky_turn;
        scene
    }
}
