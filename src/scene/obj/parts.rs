//! Groups of faces to meshes: values numbered by their first use, polygons triangulated.

use std::collections::HashMap;
use std::ops::Range;

use glam::{DVec3, Vec3};

use super::faces::Group;
use super::geometry::{Corners, FaceRun, Values, resolved};
use crate::components::MeshData;
use crate::parallel;
use crate::scene::bounds::Bounds;
use crate::scene::triangulate::Triangulator;

/// Values that a thread takes at once.
const PIECE: usize = 1 << 16;

/// Faces that a thread triangulates at once.
const FACES: usize = 1 << 15;

/// Where a group refers to values that are further apart than so many times its corners, they are numbered by hashing.
const SPARSE: usize = 16;

/// One mesh for each group that has faces, by group number, and the least and greatest coordinates of all.
pub fn collect(groups: &[Group], values: &Values, lists: &[Corners]) -> (Vec<(usize, MeshData)>, Bounds) {
    // Each kind of value of each group by itself: most files have few groups.
    let kinds = parallel::map(3 * groups.len(), |task| {
        let (group, kind) = (&groups[task / 3], task % 3);
        let used = [true, group.uvs, group.normals][kind];
        if used { Numbered::of(&group.runs, kind, lists) } else { Numbered::default() }
    });
    let mut kinds = kinds.into_iter();
    let mut three = || [0, 1, 2].map(|_| kinds.next().unwrap_or_default());
    let numbered: Vec<[Numbered; 3]> = groups.iter().map(|_| three()).collect();
    let meshes: Vec<MeshData> =
        groups.iter().zip(numbered).map(|(group, numbered)| mesh(group, numbered, values, lists)).collect();
    let mut bounds = Bounds::default();
    for mesh in &meshes {
        let boxes = parallel::map(mesh.positions.len().div_ceil(PIECE), |piece| {
            Bounds::of(mesh.positions.iter().skip(piece * PIECE).take(PIECE).copied())
        });
        bounds = boxes.into_iter().fold(bounds, Bounds::around);
    }
    (meshes.into_iter().enumerate().filter(|(_, mesh)| !mesh.triangles.is_empty()).collect(), bounds)
}

/// The values of one kind that the corners of a group refer to.
#[derive(Default)]
struct Numbered {
    /// The values' numbers in the file, by first use.
    used: Vec<u32>,
    /// For each corner, its place in `used`.
    corners: Vec<u32>,
}

impl Numbered {
    fn of(runs: &[FaceRun], kind: usize, lists: &[Corners]) -> Self {
        let indices = || {
            runs.iter().flat_map(|run| {
                let start = run.starts[kind] as usize;
                let written = &lists[run.source as usize].indices[kind][start..start + run.corners as usize];
                written.iter().map(|index| resolved(*index, run.before[kind]))
            })
        };
        let count = runs.iter().map(|run| run.corners as usize).sum();
        let (low, high) = indices().fold((u32::MAX, 0), |(low, high), index| (low.min(index), high.max(index)));
        let mut numbered = Self { used: Vec::new(), corners: Vec::with_capacity(count) };
        let width = (high as usize + 1).saturating_sub(low as usize);
        if width > SPARSE.saturating_mul(count) {
            let mut numbers = HashMap::new();
            indices().for_each(|index| numbered.add(index, numbers.entry(index).or_insert(NONE)));
        } else {
            let mut numbers = vec![NONE; width];
            indices().for_each(|index| numbered.add(index, &mut numbers[(index - low) as usize]));
        }
        numbered
    }

    /// Adds a corner; `number` is that of its value, if it has one yet.
    fn add(&mut self, index: u32, number: &mut u32) {
        if *number == NONE {
            *number = self.used.len() as u32;
            self.used.push(index);
        }
        self.corners.push(*number);
    }

    /// The values themselves.
    fn pick<T: Copy + Default + Send + Sync>(&self, values: &[T]) -> Vec<T> {
        let mut picked = vec![T::default(); self.used.len()];
        parallel::fill(&mut picked, PIECE, |first, piece| {
            piece.iter_mut().zip(&self.used[first..]).for_each(|(to, index)| *to = values[*index as usize]);
        });
        picked
    }
}

/// The number of a value that has none.
const NONE: u32 = u32::MAX;

/// The mesh of a group.
fn mesh(group: &Group, numbered: [Numbered; 3], values: &Values, lists: &[Corners]) -> MeshData {
    let mut mesh = MeshData { positions: numbered[0].pick(&values.positions), ..MeshData::default() };
    let [positions, uvs, normals] = numbered;
    if group.uvs {
        mesh.uvs = uvs.pick(&values.uvs);
    }
    if group.normals {
        mesh.normals = normals.pick(&values.normals);
    }
    let arities = |run: &FaceRun| &lists[run.source as usize].arities[run.faces.start as usize..run.faces.end as usize];
    let lists = [positions.corners, uvs.corners, normals.corners];
    let [triangles, uv_triangles, normal_triangles] =
        if group.runs.iter().all(|run| run.corners == 3 * run.faces.len() as u32) {
            lists.map(in_threes)
        } else {
            let arities: Vec<u16> = group.runs.iter().flat_map(arities).copied().collect();
            let corners = triangulate(&arities, &lists[0], &mesh.positions);
            let pick = |list: Vec<u32>| match list.is_empty() {
                true => Vec::new(),
                false => corners.iter().map(|triangle| triangle.map(|corner| list[corner as usize])).collect(),
            };
            lists.map(pick)
        };
    (mesh.triangles, mesh.uv_triangles) = (triangles, uv_triangles);
    mesh.normal_triangles = normal_triangles;
    if mesh.normals.contains(&Vec3::ZERO) {
        replace_normals(&mut mesh);
    }
    mesh
}

/// A list of corners, three a triangle, without copying where that can be.
fn in_threes(corners: Vec<u32>) -> Vec<[u32; 3]> {
    bytemuck::allocation::try_cast_vec(corners).unwrap_or_else(|(_, corners)| corners.as_chunks().0.to_vec())
}

/// The triangles of polygons, by the numbers of their corners in a list of all.
fn triangulate(arities: &[u16], corners: &[u32], positions: &[DVec3]) -> Vec<[u32; 3]> {
    let lengths = arities.chunks(FACES).map(|faces| faces.iter().map(|arity| usize::from(*arity)).sum::<usize>());
    let starts: Vec<usize> = lengths
        .scan(0, |end, length| {
            let start = *end;
            *end += length;
            Some(start)
        })
        .collect();
    let piece = |number: usize| {
        let mut triangulator = Triangulator::default();
        let (mut polygon, mut cut, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        let mut start = starts[number];
        for arity in &arities[number * FACES..arities.len().min((number + 1) * FACES)] {
            let range: Range<usize> = start..start + usize::from(*arity);
            polygon.clear();
            polygon.extend(corners[range].iter().map(|corner| positions[*corner as usize]));
            cut.clear();
            triangulator.run(&polygon, &mut cut);
            triangles.extend(cut.iter().map(|triangle: &[u32; 3]| triangle.map(|corner| start as u32 + corner)));
            start += usize::from(*arity);
        }
        triangles
    };
    parallel::map(starts.len(), piece).concat()
}

/// In place of normals without a direction, the triangles' own.
fn replace_normals(mesh: &mut MeshData) {
    for (normals, corners) in mesh.normal_triangles.iter_mut().zip(&mesh.triangles) {
        for normal in normals {
            if mesh.normals[*normal as usize] == Vec3::ZERO {
                let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
                *normal = mesh.normals.len() as u32;
                mesh.normals.push((b - a).cross(c - a).try_normalize().unwrap_or(DVec3::Y).as_vec3());
            }
        }
    }
}
