//! Coarse meshes with smooth normals.

use std::f32::consts::{PI, TAU};

use glam::{Mat3, Vec3};

use super::room::Room;
use crate::layout::trace::Shading;

/// Corners of a triangle, and the normals there.
pub type Smooth = ([Vec3; 3], [Vec3; 3]);

/// A mesh over a grid of `columns` by `rows` cells, from where each corner and its normal are; both parameters in 0 to 1.
pub fn grid(columns: usize, rows: usize, at: impl Fn(f32, f32) -> (Vec3, Vec3)) -> Vec<Smooth> {
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
pub fn ball(columns: usize, rows: usize) -> Vec<Smooth> {
    grid(columns, rows, |u, v| {
        let ((sin, cos), (sin_turn, cos_turn)) = ((PI * v).sin_cos(), (TAU * u).sin_cos());
        let n = Vec3::new(sin * cos_turn, cos, sin * sin_turn);
        (n, n)
    })
}

pub fn torus(columns: usize, rows: usize) -> Vec<Smooth> {
    let tip = Mat3::from_rotation_x(0.9);
    grid(columns, rows, |u, v| {
        let ((sin, cos), (sin_turn, cos_turn)) = ((TAU * v.fract()).sin_cos(), (TAU * u).sin_cos());
        let n = Vec3::new(cos * cos_turn, -sin, cos * sin_turn);
        (tip * (0.7 * Vec3::new(cos_turn, 0.0, sin_turn) + 0.3 * n), tip * n)
    })
}

/// A cube with the normals of a ball: they lean by up to 55 degrees.
pub fn cube() -> Vec<Smooth> {
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

pub fn backwards(mesh: Vec<Smooth>) -> Vec<Smooth> {
    mesh.into_iter().map(|(points, normals)| (points, normals.map(|n| -n))).collect()
}

pub fn meshes() -> Vec<(&'static str, Vec<Smooth>)> {
    vec![
        ("ball of 8 x 6", ball(8, 6)),
        ("ball of 12 x 8", ball(12, 8)),
        ("ball of 16 x 12", ball(16, 12)),
        ("torus", torus(12, 8)),
        ("cube", cube()),
        ("normals inwards", backwards(ball(10, 7))),
    ]
}

pub fn add(room: &mut Room, mesh: &[Smooth], centre: Vec3, radius: f32, material: u32) {
    room.shading.resize(room.triangles.len(), Shading::default());
    for (points, normals) in mesh {
        room.triangle(points.map(|p| centre + radius * p), material);
        room.shading.push(Shading::pack(*normals));
    }
}
