//! Entities to triangles in world space, f64.

use std::collections::HashMap;

use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};

use super::bsdf::Facing;
use super::random::Random;
use super::substance::{Substance, Textures};
use super::tangents::Tangents;
use super::tree::{Hit, Tree};
use crate::components::{
    Active, Camera, Environment, Film, Focus, Geometry, Lens, Maps, Material, MeshData, Render, Transform, UsesMaterial,
};

/// Why a world can't be rendered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OracleError {
    #[error("the scene has no film")]
    NoFilm,
    #[error("the scene has no camera")]
    NoCamera,
    #[error("the film has no pixels, or the crop reaches beyond it")]
    EmptyFilm,
}

/// Cosine at which a shading normal is just seen.
const LEAST_FACING: f64 = 1.0 / 32.0;

pub struct Scene {
    pub triangles: Vec<Triangle>,
    pub tree: Tree,
    pub substances: Vec<Substance>,
    pub environment: Option<Environment>,
    pub film: Film,
    pub max_depth: u32,
    camera: Camera,
}

pub struct Triangle {
    pub corners: [DVec3; 3],
    /// Unit length, or zero; none where the mesh has none.
    normals: Option<[DVec3; 3]>,
    /// Texture coordinates, v up; all 0 where the mesh has none.
    uvs: [DVec2; 3],
    /// Where a map of relief needs them.
    tangents: Option<Box<Tangents>>,
    pub substance: usize,
}

impl Scene {
    /// Meshes in the order of their names; those without a material get the default one.
    pub fn read(world: &mut World) -> Result<Self, OracleError> {
        let (film, render) = world.query::<(&Film, &Render)>().iter(world).next().ok_or(OracleError::NoFilm)?;
        let (film, render) = (*film, *render);
        let window = film.window();
        if window.min.cmpge(window.max).any() || window.max.cmpgt(film.size).any() {
            return Err(OracleError::EmptyFilm);
        }
        let mut cameras = world.query::<(&Name, &Camera, Has<Active>)>();
        let first = |(name, _, active): &(&Name, &Camera, bool)| (!active, name.as_str().to_owned());
        let camera = *cameras.iter(world).min_by_key(first).ok_or(OracleError::NoCamera)?.1;
        let mut environments = world.query::<(&Name, &Environment)>();
        let environment = environments.iter(world).min_by_key(|e| e.0.as_str().to_owned()).map(|e| e.1.clone());

        let mut meshes = world.query::<(&Name, &Geometry, Option<&Transform>, Option<&UsesMaterial>)>();
        let mut materials = world.query_filtered::<(Entity, &Material, Option<&Maps>), With<Name>>();
        let world: &World = world;
        let mut textures = Textures::new(world);
        let none = Maps::default();
        let mut substances = vec![Substance::new(&Material::default(), &none, &mut textures, &render)];
        let mut index = HashMap::new();
        for (entity, material, maps) in materials.iter(world) {
            index.insert(entity, substances.len());
            substances.push(Substance::new(material, maps.unwrap_or(&none), &mut textures, &render));
        }
        let mut sorted: Vec<_> = meshes.iter(world).collect();
        sorted.sort_by_key(|mesh| mesh.0.as_str());
        let mut triangles = Vec::new();
        for (_, geometry, transform, material) in sorted {
            let substance = material.and_then(|m| index.get(&m.0)).copied().unwrap_or(0);
            let transform = transform.copied().unwrap_or_default();
            let first = triangles.len();
            triangles.extend(place(&geometry.0, transform, substance));
            if substances[substance].has_relief() {
                let found = Tangents::of(&geometry.0, &transform.0);
                for (triangle, tangents) in triangles[first..].iter_mut().zip(found) {
                    triangle.tangents = tangents.map(Box::new);
                }
            }
        }
        let tree = Tree::new(triangles.iter().map(|t| t.corners));
        Ok(Self { triangles, tree, substances, environment, film, max_depth: render.max_depth.max(1), camera })
    }

    /// Origin and unit direction of a ray through a point of the whole film, in pixels from its top left corner: from any point of the lens.
    pub fn camera_ray(&self, at: DVec2, random: &mut Random) -> (DVec3, DVec3) {
        let camera = &self.camera;
        let forward = (camera.look_at - camera.position).normalize_or(DVec3::NEG_Z);
        let right = forward.cross(camera.up).normalize_or(forward.any_orthonormal_vector());
        let size = self.film.size.as_dvec2();
        let half = (0.5 * camera.fov_y.to_radians()).tan();
        let (x, y) = (half * (2.0 * at.x - size.x) / size.y, half * (1.0 - 2.0 * at.y / size.y));
        let Lens { aperture, focus, shift } = camera.lens;
        let (x, y) = (x + 2.0 * half * shift.x, y + 2.0 * half * shift.y);
        let up = right.cross(forward);
        if aperture <= 0.0 {
            return (camera.position, (forward + x * right + y * up).normalize());
        }
        let looked_at = (camera.look_at - camera.position).dot(forward);
        let distance = match focus {
            Focus::LookAt => looked_at,
            Focus::Distance(distance) => distance,
            Focus::At(point) => Some((point - camera.position).dot(forward)).filter(|d| *d > 0.0).unwrap_or(looked_at),
        };
        let (radius, angle) = (aperture * random.unit().sqrt(), std::f64::consts::TAU * random.unit());
        let origin = camera.position + radius * (angle.cos() * right + angle.sin() * up);
        let sharp = camera.position + distance * (forward + x * right + y * up);
        (origin, (sharp - origin).normalize())
    }

    /// The first surface on the way of a ray. Surfaces with holes are there by chance, for each ray anew.
    pub fn closest(&self, origin: DVec3, direction: DVec3, random: &mut Random) -> Option<Hit> {
        self.tree.closest(origin, direction, |hit| self.substance(hit).is_there(self.uv(hit), random))
    }

    /// The surface that a ray of this direction hits.
    pub fn facing(&self, hit: &Hit, direction: DVec3, random: &mut Random) -> Facing {
        let (triangle, wo) = (&self.triangles[hit.triangle as usize], -direction);
        let front = triangle.winding().normalize();
        let from_behind = front.dot(wo) < 0.0;
        let geometric = if from_behind { -front } else { front };
        let smooth = triangle.smooth_normal(hit.b);
        let on_mesh = smooth.unwrap_or(front);
        let side = if on_mesh.dot(geometric) < 0.0 { -1.0 } else { 1.0 };
        let mut shading = side * on_mesh;
        if let (Some(local), Some(tangents)) = (self.substance(hit).relief(self.uv(hit), random), &triangle.tangents) {
            let bent = side * tangents.bend(local, on_mesh, hit.b);
            // The facet stays in front of what the picture says.
            shading = turned(bent, shading.dot(geometric), geometric);
        } else if smooth.is_none() {
            return Facing { wo, shading, geometric, from_behind };
        }
        // A normal that looks away from its viewer is turned until it is just seen, if the triangle is.
        shading = turned(shading, wo.dot(geometric), wo);
        Facing { wo, shading, geometric, from_behind }
    }

    /// What a triangle is made of.
    pub fn substance(&self, hit: &Hit) -> &Substance {
        &self.substances[self.triangles[hit.triangle as usize].substance]
    }

    /// Texture coordinates.
    pub fn uv(&self, hit: &Hit) -> DVec2 {
        let [a, b, c] = self.triangles[hit.triangle as usize].uvs;
        a + hit.b[0] * (b - a) + hit.b[1] * (c - a)
    }

    /// Radiance that a hit surface sends back along the ray.
    pub fn emitted(&self, hit: &Hit, direction: DVec3) -> DVec3 {
        let substance = self.substance(hit);
        let from_behind = self.triangles[hit.triangle as usize].winding().dot(direction) > 0.0;
        if substance.one_sided() && from_behind { DVec3::ZERO } else { substance.emission(self.uv(hit)) }
    }
}

/// A unit normal, turned to a direction by as little as makes its cosine to that [`LEAST_FACING`], or `most` where that is less.
fn turned(normal: DVec3, most: f64, direction: DVec3) -> DVec3 {
    let lack = most.min(LEAST_FACING) - direction.dot(normal);
    if lack > 0.0 { (normal + lack * direction).normalize() } else { normal }
}

impl Triangle {
    /// Twice the area long, to the side from where the corners are counter-clockwise.
    pub fn winding(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// None where a corner has no normal, or they cancel.
    fn smooth_normal(&self, b: [f64; 2]) -> Option<DVec3> {
        let normals = self.normals.filter(|normals| !normals.contains(&DVec3::ZERO))?;
        let n = (1.0 - b[0] - b[1]) * normals[0] + b[0] * normals[1] + b[1] * normals[2];
        (n.length_squared() >= 1e-6).then(|| n.normalize())
    }
}

/// A mesh's triangles in world space.
fn place(mesh: &MeshData, transform: Transform, substance: usize) -> impl Iterator<Item = Triangle> + '_ {
    let turn = transform.0.matrix3.inverse().transpose();
    let normal = move |i: u32| (turn * mesh.normals[i as usize].as_dvec3()).normalize_or_zero();
    mesh.triangles.iter().enumerate().map(move |(i, corners)| Triangle {
        corners: corners.map(|i| transform.0.transform_point3(mesh.positions[i as usize])),
        normals: mesh.normal_triangles.get(i).map(|corners| corners.map(normal)),
        uvs: mesh
            .uv_triangles
            .get(i)
            .map_or([DVec2::ZERO; 3], |corners| corners.map(|i| mesh.uvs[i as usize].as_dvec2())),
        tangents: None,
        substance,
    })
}
