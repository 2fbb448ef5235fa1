//! Scenes by number of triangles, for benchmarks and tests. Right-handed, y up; the same on every machine.

use std::collections::HashMap;

use glam::{DVec3, Vec2, Vec3};

use crate::components::MeshData;

/// Corners of a triangle, counter-clockwise seen from the side it faces.
pub type Corners = [Vec3; 3];

/// Where the camera of [`spheres`] stands, what it looks at, and its vertical field of view in degrees: Cornell
/// University's, through the room's open front.
pub const SPHERES_VIEW: (Vec3, Vec3, f32) = (Vec3::new(278.0, 273.0, -800.0), Vec3::new(278.0, 273.0, 0.0), 39.307_71);

/// Uniform numbers from a seed: Steele, Lea, Flood: Fast splittable pseudorandom number generators (2014).
pub struct SplitMix(pub u64);

impl SplitMix {
    /// The next 64 random bits.
    pub fn next_u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// In [low, high).
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// Two triangles a quad.
fn quads(corners: &[[[f32; 3]; 4]]) -> Vec<Corners> {
    corners.iter().map(|quad| quad.map(Vec3::from)).flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
}

/// The walls and the light of Cornell University's box, in millimetres: 12 triangles, the front open.
pub fn cornell_room() -> Vec<Corners> {
    quads(&[
        [[552.8, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 559.2], [549.6, 0.0, 559.2]],
        [[556.0, 548.8, 0.0], [556.0, 548.8, 559.2], [0.0, 548.8, 559.2], [0.0, 548.8, 0.0]],
        [[549.6, 0.0, 559.2], [0.0, 0.0, 559.2], [0.0, 548.8, 559.2], [556.0, 548.8, 559.2]],
        [[0.0, 0.0, 559.2], [0.0, 0.0, 0.0], [0.0, 548.8, 0.0], [0.0, 548.8, 559.2]],
        [[552.8, 0.0, 0.0], [549.6, 0.0, 559.2], [556.0, 548.8, 559.2], [556.0, 548.8, 0.0]],
        [[343.0, 548.3, 227.0], [343.0, 548.3, 332.0], [213.0, 548.3, 332.0], [213.0, 548.3, 227.0]],
    ])
}

/// The unit sphere by subdivision of the icosahedron: 20 * 4^level triangles.
pub fn icosphere(level: u32) -> Vec<[DVec3; 3]> {
    const FACES: [[usize; 3]; 20] = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    let p = (1.0 + 5f64.sqrt()) / 2.0;
    let planes = [[-1.0, p, 0.0], [1.0, p, 0.0], [-1.0, -p, 0.0], [1.0, -p, 0.0]];
    let turned = |turn: usize| planes.map(|v| std::array::from_fn(|axis| v[(axis + turn) % 3]));
    let vertices: Vec<DVec3> =
        [turned(0), turned(2), turned(1)].concat().into_iter().map(|v| DVec3::from_array(v).normalize()).collect();
    let mut triangles = FACES.map(|face| face.map(|i| vertices[i])).to_vec();
    for _ in 0..level {
        triangles = triangles
            .into_iter()
            .flat_map(|[a, b, c]| {
                let [ab, bc, ca] = [(a + b).normalize(), (b + c).normalize(), (c + a).normalize()];
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    triangles
}

/// Exactly `triangles` triangles: the room, if that many, and in it icospheres at random places, overlapping; the last
/// sphere may be cut short. Half a million triangles and more are of finer spheres.
pub fn spheres(triangles: u32, seed: u64) -> Vec<Corners> {
    let base = icosphere(if triangles < 500_000 { 3 } else { 4 });
    let mut out = cornell_room();
    let wanted = triangles as usize;
    let count = wanted.saturating_sub(out.len()).div_ceil(base.len());
    let mut random = SplitMix(seed);
    for _ in 0..count {
        let centre =
            DVec3::new(random.range(60.0, 490.0), random.range(50.0, 480.0), random.range(60.0, 500.0)).as_vec3();
        let radius = (random.range(0.5, 1.0) * 220.0 / (count as f64).cbrt()) as f32;
        out.extend(base.iter().map(|corners| corners.map(|v| v.as_vec3() * radius + centre)));
    }
    out.truncate(wanted);
    out
}

/// Exactly `triangles` triangles of a height field 800 wide, hills upon hills of octave noise.
pub fn terrain(triangles: u32, seed: u64) -> Vec<Corners> {
    let wanted = triangles as usize;
    let cells = ((triangles as f64 / 2.0).sqrt().ceil() as usize).max(1);
    let mut random = SplitMix(seed);
    let octaves: Vec<[f64; 5]> = (0..24)
        .map(|octave| {
            let frequency = 0.01 * 1.35f64.powi(octave);
            let turn = random.range(0.0, std::f64::consts::TAU);
            let height = 22.0 * (0.01 / frequency).powf(0.95);
            [frequency * turn.cos(), frequency * turn.sin(), random.range(0.0, 6.3), random.range(0.0, 6.3), height]
        })
        .collect();
    let height = |x: f64, z: f64| -> f64 {
        octaves.iter().map(|[u, v, p, q, h]| h * (x * u + z * v + p).sin() * (z * u - x * v + q).sin()).sum()
    };
    let point = |i: usize, k: usize| {
        let at = Vec2::new(i as f32, k as f32) * (800.0 / cells as f32) - 400.0;
        Vec3::new(at.x, height(f64::from(at.x), f64::from(at.y)) as f32, at.y)
    };
    let mut rows: Vec<Vec3> = (0..=cells).map(|i| point(i, 0)).collect();
    let mut out = Vec::with_capacity(wanted + 2 * cells);
    for k in 1..=cells {
        let next: Vec<Vec3> = (0..=cells).map(|i| point(i, k)).collect();
        for i in 0..cells {
            let [a, b, c, d] = [rows[i], next[i], next[i + 1], rows[i + 1]];
            out.extend([[a, b, c], [a, c, d]]);
        }
        rows = next;
    }
    out.truncate(wanted);
    out
}

/// The same triangles as a mesh of shared corners.
pub fn to_mesh(triangles: &[Corners]) -> MeshData {
    let mut mesh = MeshData::default();
    let mut known: HashMap<[u32; 3], u32> = HashMap::new();
    for corners in triangles {
        let index = corners.map(|corner| {
            *known.entry(corner.to_array().map(f32::to_bits)).or_insert_with(|| {
                mesh.positions.push(corner.as_dvec3());
                mesh.positions.len() as u32 - 1
            })
        });
        mesh.triangles.push(index);
    }
    mesh
}
