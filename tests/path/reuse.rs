//! Paths that are reused within tiles: against the twin, and against paths that are not.

use glam::UVec2;
use lucerna::cpu::rng::Source;
use lucerna::layout::trace::TraceParams;
use lucerna::shader::Library;
use lucerna::stress::tools::paths::{self, Sums, twin_reusing};

use crate::rooms::Room;
use crate::support;
use crate::support::plant::plant;

use super::{compare, small};

/// The two kernels' sums of batch `i`.
fn reusing(room: &Room, library: Library, params: &TraceParams) -> impl FnMut(usize) -> Sums {
    let mut sums = paths::reusing(&support::gpu(), library, room, params).unwrap();
    move |i| sums(i).unwrap()
}

fn rooms() -> [(&'static str, Room); 4] {
    let asked = |room: Room| Room { next_event: true, roulette: true, sampler: Source::Sobol, ..room };
    [
        ("cornell", asked(Room::cornell())),
        ("cornell, independent numbers", Room { sampler: Source::Pcg, roulette: false, ..asked(Room::cornell()) }),
        ("lights are hit", Room { next_event: false, ..asked(Room::cornell()) }),
        ("glass", asked(Room::glass())),
    ]
}

#[test]
fn equals_the_f64_twin() {
    for (name, room) in rooms() {
        // Neither side is one of whole blocks: tiles at the film's edge lack pixels.
        let params = TraceParams { layers: 4, ..room.params(UVec2::new(27, 21)) };
        compare(reusing(&room, Library::shipped(), &params), twin_reusing(&room, &params))
            .unwrap_or_else(|why| panic!("{name}: {why}"));
    }
}

#[test]
fn what_is_wrong_with_the_weights_is_seen() {
    let room = Room { next_event: true, ..Room::cornell() };
    let params = TraceParams { layers: 4, ..small(&room) };
    let sums: Vec<_> = (0..crate::statistics::BATCHES).map(twin_reusing(&room, &params)).collect();
    let unseen_counts = [
        ("density = select(0.0, link.pdf,", "density = select(-link.pdf, link.pdf,"),
        ("total += densities[local * TILE_PIXELS + m];", "total += abs(densities[local * TILE_PIXELS + m]);"),
    ];
    let by_two_percent =
        [("density = select(0.0, link.pdf,", "density = select(0.0, link.pdf * select(1.0, 1.02, slot == 5u),")];
    let too_bright = [("link.value = at.value * by_area;", "link.value = 1.01 * at.value * by_area;")];
    for wrong in [&unseen_counts[..], &by_two_percent, &too_bright] {
        let library = wrong
            .iter()
            .fold(Library::shipped(), |library, (right, wrong)| plant(library, "passes/trace/gather", right, wrong));
        let seen = compare(reusing(&room, library, &params), |i| sums[i].clone());
        assert!(seen.is_err(), "{wrong:?} went unnoticed");
    }
}
