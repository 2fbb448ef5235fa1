//! The kernel against its f64 twin, path by path, and the errors that this shows.

use glam::{UVec2, Vec3};
use lucerna::cpu::rng::Source;
use lucerna::layout::trace::TraceParams;
use lucerna::shader::Library;

use crate::rooms::{Room, matte};
use crate::support;

use super::{against_twin, block_sums, furnace, gpu_sums, inside, samples, sees_mistakes, small};

#[test]
fn equals_the_f64_twin() {
    for (roulette, sampler, next_event) in [
        (false, Source::Pcg, false),
        (true, Source::Sobol, false),
        (false, Source::Pcg, true),
        (true, Source::Sobol, true),
    ] {
        let room = Room { roulette, sampler, next_event, ..Room::cornell() };
        against_twin(&room, Library::shipped(), &small(&room))
            .unwrap_or_else(|why| panic!("roulette {roulette}, {sampler:?}, lights asked {next_event}: {why}"));
    }
}

#[test]
fn an_error_of_one_percent_is_seen() {
    let found = Room::cornell();
    let asked = Room { next_event: true, ..Room::cornell() };
    sees_mistakes(
        &found,
        &[
            ("lib/bsdf/mixture", "at.value / at.pdf", "1.01 * at.value / at.pdf"),
            ("lib/light", "select(material.emission,", "select(0.99 * material.emission,"),
            ("lib/bsdf/phong", "0.5 * INV_PI * (n + 1.0)", "0.505 * INV_PI * (n + 1.0)"),
        ],
    );
    sees_mistakes(
        &asked,
        &[
            ("lib/light", "return 1.0 / (1.0 + ratio * ratio);", "return 1.01 / (1.0 + ratio * ratio);"),
            ("passes/trace/connect", "return area_pdf * (t * t", "return 1.02 * area_pdf * (t * t"),
            ("lib/bsdf/lambert", "return kd * (INV_PI", "return kd * (1.01 * INV_PI"),
        ],
    );
}

#[test]
fn a_single_material_needs_no_other_features() {
    // Without `phong`, `emitters` and `normals` the kernel is another module; the environment alone gives light.
    let mut room = Room { environment: Vec3::new(1.0, 2.0, 0.5), ..Room::default() };
    let grey = room.material(matte(Vec3::new(0.5, 0.7, 0.2), Vec3::ZERO));
    room.walls([Some(grey), Some(grey), Some(grey), Some(grey), Some(grey), None]);
    assert_eq!(room.features(), ["environment", "few_triangles"]);
    against_twin(&room, Library::shipped(), &small(&room)).unwrap();
}

#[test]
fn rays_are_counted_as_the_twin_counts_them() {
    let room = Room { roulette: true, ..Room::cornell() };
    let mut rig = support::rig();
    room.load(&mut rig).unwrap();
    // Deep enough to show lavapipe's limit of loop iterations, were it ever crossed.
    let params = TraceParams { max_depth: 1024, layers: 4, ..room.params(UVec2::splat(24)) };
    let rays: u64 = gpu_sums(&mut rig, &params).iter().map(|s| s.1).sum();
    let twin = room.twin();
    let right: u64 = block_sums(&params, |layer, p| {
        let traced = twin.sample(&params, p, layer);
        (traced.radiance, traced.rays)
    })
    .iter()
    .map(|s| s.1)
    .sum();
    // Of these 2,304 paths a handful may part at an edge, by a few rays each.
    assert!(rays.abs_diff(right) <= right / 500, "{rays} rays, the twin {right}");

    let white = furnace(1.0, 1.0);
    white.load(&mut rig).unwrap();
    let params = inside(&white, UVec2::splat(8), 1024);
    assert!(samples(&mut rig, &params).iter().all(|s| s.info == 1024), "a path of 1,024 segments was cut short");
}
