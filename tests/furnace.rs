//! Coarse meshes with smooth normals where all around is equally bright: what is not absorbed comes back, whatever the normals say.

use std::f32::consts::{PI, TAU};

use glam::{Mat3, UVec2, Vec3};
use lucerna::components::{Energy, Lobe, Material, Passage};
use lucerna::layout::trace::{MaterialRecord, Shading, TraceParams};
use lucerna::prepare::material;
use lucerna::shader::Library;

use crate::path::{against_twin, compare_integrators, samples, small};
use crate::rooms::{Room, matte};
use crate::support;

/// Corners of a triangle, and the normals there.
type Smooth = ([Vec3; 3], [Vec3; 3]);

/// A mesh over a grid of `columns` by `rows` cells, from where each corner and its normal are; both parameters in 0 to 1.
fn grid(columns: usize, rows: usize, at: impl Fn(f32, f32) -> (Vec3, Vec3)) -> Vec<Smooth> {
    let corner = |i: usize, j: usize| at((j % columns) as f32 / columns as f32, i as f32 / rows as f32);
    let mut mesh = Vec::new();
    for i in 0..rows {
        for j in 0..columns {
            let cell = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            for [a, b, c] in [[0, 2, 1], [0, 3, 2]] {
                let (points, normals) = ([a, b, c].map(|k| cell[k].0), [a, b, c].map(|k| cell[k].1));
                // At a pole one of a cell's triangles is a line.
                if (points[1] - points[0]).cross(points[2] - points[0]).length() > 1e-6 {
                    mesh.push((points, normals));
                }
            }
        }
    }
    mesh
}

/// A ball around the origin.
fn ball(columns: usize, rows: usize) -> Vec<Smooth> {
    grid(columns, rows, |u, v| {
        let ((sin, cos), (sin_turn, cos_turn)) = ((PI * v).sin_cos(), (TAU * u).sin_cos());
        let n = Vec3::new(sin * cos_turn, cos, sin * sin_turn);
        (n, n)
    })
}

fn torus(columns: usize, rows: usize) -> Vec<Smooth> {
    let tip = Mat3::from_rotation_x(0.9);
    grid(columns, rows, |u, v| {
        let ((sin, cos), (sin_turn, cos_turn)) = ((TAU * v.fract()).sin_cos(), (TAU * u).sin_cos());
        let n = Vec3::new(cos * cos_turn, -sin, cos * sin_turn);
        (tip * (0.7 * Vec3::new(cos_turn, 0.0, sin_turn) + 0.3 * n), tip * n)
    })
}

/// A cube with the normals of a ball: they lean by up to 55 degrees.
fn cube() -> Vec<Smooth> {
    let turn = Mat3::from_rotation_x(0.5) * Mat3::from_rotation_y(0.6);
    let mut mesh = Vec::new();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let (e, f) = (Vec3::AXES[(axis + 1) % 3] * sign, Vec3::AXES[(axis + 2) % 3]);
            let corner = |x: f32, y: f32| turn * (Vec3::AXES[axis] * sign + e * x + f * y);
            let [a, b, c, d] = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
            for points in [[a, b, c], [a, c, d]] {
                mesh.push((points.map(|p| 0.57 * p), points.map(Vec3::normalize)));
            }
        }
    }
    mesh
}

fn backwards(mesh: Vec<Smooth>) -> Vec<Smooth> {
    mesh.into_iter().map(|(points, normals)| (points, normals.map(|n| -n))).collect()
}

fn meshes() -> Vec<(&'static str, Vec<Smooth>)> {
    vec![
        ("ball of 8 x 6", ball(8, 6)),
        ("ball of 16 x 12", ball(16, 12)),
        ("torus", torus(12, 8)),
        ("cube", cube()),
        ("normals inwards", backwards(ball(10, 7))),
    ]
}

fn add(room: &mut Room, mesh: &[Smooth], centre: Vec3, radius: f32, material: u32) {
    room.shading.resize(room.triangles.len(), Shading::default());
    for (points, normals) in mesh {
        room.triangle(points.map(|p| centre + radius * p), material);
        room.shading.push(Shading::pack(*normals));
    }
}

fn pack(values: Material) -> MaterialRecord {
    material::pack(&values, Energy::Preserve)
}

fn white(values: Material) -> MaterialRecord {
    pack(Material { specular: Vec3::ONE, ..values })
}

fn glass() -> MaterialRecord {
    pack(Material { passage: Passage::Glass(1.5), ..Material::BLACK })
}

/// A mesh of one material in a sky of 1, by pixel and sample: red, which is all of them.
fn in_the_open(mesh: &[Smooth], material: MaterialRecord, side: u32, layers: u32) -> Vec<Vec<f32>> {
    let mut room = Room { environment: Vec3::ONE, ..Room::default() };
    let material = room.material(material);
    add(&mut room, mesh, Vec3::ZERO, 1.0, material);
    let mut rig = support::rig();
    room.load(&mut rig);
    let got = samples(&mut rig, &TraceParams { layers, max_depth: 64, ..room.params(UVec2::splat(side)) });
    let pixels = (side * side) as usize;
    (0..pixels).map(|pixel| got.iter().skip(pixel).step_by(pixels).map(|sample| sample.rgb.x).collect()).collect()
}

#[test]
fn what_absorbs_nothing_is_invisible() {
    let half =
        Material { diffuse: Vec3::splat(0.5), specular: Vec3::splat(0.5), lobe: Lobe::Mirror, ..Material::BLACK };
    let surfaces = [
        ("mirror", white(Material { lobe: Lobe::Mirror, ..Material::BLACK })),
        ("chalk", pack(Material { diffuse: Vec3::ONE, ..Material::BLACK })),
        ("chalk and mirror", pack(half)),
        ("veil", pack(Material { diffuse: Vec3::ONE, passage: Passage::SeeThrough(0.4), ..Material::BLACK })),
    ];
    for (shape, mesh) in meshes() {
        for (surface, material) in surfaces {
            let pixels = in_the_open(&mesh, material, 24, 8);
            let off = pixels.iter().flatten().filter(|v| (**v - 1.0).abs() > 1e-5).count();
            // A direction in the very plane of a facet may be rounded to either side of it.
            assert!(off <= 1, "{shape}, {surface}: {off} of 4608 samples are off");
        }
    }
}

#[test]
fn glass_loses_a_sample_in_a_thousand_at_most() {
    for (shape, mesh) in meshes() {
        let pixels = in_the_open(&mesh, glass(), 24, 32);
        let off = pixels.iter().flatten().filter(|v| (**v - 1.0).abs() > 1e-4).count();
        // Some light is caught by total reflection for more than 64 segments, as it is in flat facets.
        assert!(off < 18, "{shape}: {off} of 18432 samples are off");
    }
}

#[test]
fn nearly_smooth_metal_loses_less_than_a_percent_of_any_pixel() {
    let metal = Material { diffuse: Vec3::ONE, metallic: 1.0, lobe: Lobe::Ggx(0.02), ..Material::BLACK };
    for (shape, mesh) in meshes() {
        for pixel in in_the_open(&mesh, pack(metal), 16, 256) {
            let mean = pixel.iter().sum::<f32>() / pixel.len() as f32;
            assert!((mean - 1.0).abs() < 0.01, "{shape}: a pixel of {mean}");
        }
    }
}

#[test]
fn rough_lobes_lose_what_a_fine_ball_loses() {
    let surfaces = [0.3, 0.6, 1.0].map(|roughness| Material { lobe: Lobe::Ggx(roughness), ..Material::BLACK });
    let phong = [10.0, 300.0].map(|ns| Material { lobe: Lobe::Phong(ns), ..Material::BLACK });
    for values in surfaces.into_iter().chain(phong) {
        // Loss of the mean pixel that is covered by it at all.
        let mean = |mesh: &[Smooth]| {
            let pixels: Vec<f32> =
                in_the_open(mesh, white(values), 24, 32).into_iter().flatten().filter(|v| *v != 1.0).collect();
            pixels.iter().sum::<f32>() / pixels.len() as f32
        };
        let (coarse, fine) = (mean(&ball(12, 8)), mean(&ball(96, 64)));
        // 9,000 samples of a deviation of 0.3 at most, twice: an error of 0.005, four of it. A coarse ball is seen under other angles.
        assert!(coarse > fine - 0.02, "{:?}: {coarse}, fine {fine}", values.lobe);
    }
}

#[test]
fn a_closed_ball_is_a_geometric_series_from_inside() {
    let glow = Material { emission: Vec3::ONE, ..Material::BLACK };
    let surfaces = [
        Material { diffuse: Vec3::splat(0.9), ..glow },
        Material { specular: Vec3::splat(0.9), lobe: Lobe::Mirror, ..glow },
        Material { diffuse: Vec3::splat(0.45), specular: Vec3::splat(0.45), lobe: Lobe::Mirror, ..glow },
    ];
    for (shape, mesh) in [("ball", ball(12, 8)), ("cube", cube()), ("normals inwards", backwards(ball(10, 7)))] {
        for values in surfaces {
            let mut room = Room::default();
            let wall = room.material(pack(values));
            add(&mut room, &mesh, Vec3::ZERO, 1.0, wall);
            let mut rig = support::rig();
            room.load(&mut rig);
            let at = TraceParams {
                position: Vec3::new(0.2, -0.1, 0.15),
                max_depth: 16,
                layers: 4,
                ..room.params(UVec2::splat(24))
            };
            let right: f64 = (0..16).map(|i| 0.9f64.powi(i)).sum();
            let got = samples(&mut rig, &at);
            let off = got.iter().filter(|sample| (f64::from(sample.rgb.x) / right - 1.0).abs() > 1e-4).count();
            assert!(off <= 2, "{shape}, {values:?}: {off} of {} samples are off", got.len());
        }
    }
}

/// Coarse balls of all lobes under a large light, in a room with an open side.
fn balls() -> Room {
    let mut room = Room { environment: Vec3::new(0.3, 0.4, 0.5), ..Room::default() };
    let wall = room.material(matte(Vec3::splat(0.7), Vec3::ZERO));
    let lamp = room.material(matte(Vec3::ZERO, Vec3::new(4.0, 3.0, 2.0)));
    room.walls([Some(wall), Some(wall), Some(wall), Some(wall), Some(wall), None]);
    room.quad(Vec3::new(-0.8, 0.9, -0.8), 1.6 * Vec3::X, 1.6 * Vec3::Z, lamp);
    let grey = Material { diffuse: Vec3::splat(0.4), specular: Vec3::splat(0.5), ..Material::BLACK };
    let surfaces = [
        Material { diffuse: Vec3::splat(0.9), ..Material::BLACK },
        Material { lobe: Lobe::Phong(30.0), ..grey },
        Material { lobe: Lobe::Ggx(0.4), ..grey },
        Material { lobe: Lobe::Mirror, ..grey },
    ];
    let meshes = [ball(8, 6), cube(), ball(7, 5), torus(9, 6)];
    for (i, (values, mesh)) in surfaces.into_iter().zip(meshes).enumerate() {
        let material = room.material(pack(values));
        add(
            &mut room,
            &mesh,
            Vec3::new(-0.45 + 0.9 * (i % 2) as f32, -0.5 + 0.9 * (i / 2) as f32, -0.2),
            0.42,
            material,
        );
    }
    room
}

#[test]
fn equals_the_f64_twin() {
    for next_event in [false, true] {
        let room = Room { next_event, ..balls() };
        against_twin(&room, Library::shipped(), &small(&room))
            .unwrap_or_else(|why| panic!("asked {next_event}: {why}"));
    }
}

#[test]
fn asking_lights_changes_no_mean() {
    compare_integrators(&balls()).unwrap();
}
