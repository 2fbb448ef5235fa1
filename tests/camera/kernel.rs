//! The kernel's lens against the twin, and scenes that have none.

use std::time::Duration;

use glam::DVec2;
use lucerna::components::{Camera, Focus, Lens};
use lucerna::cpu::rng::Source;
use lucerna::shader::Library;
use lucerna::{Engine, scene};

use crate::path::{against_twin, sees_mistakes, small};
use crate::rooms::Room;
use crate::support;

/// Sharp well before the room's middle.
const WIDE: Lens = Lens { aperture: 0.25, focus: Focus::Distance(2.4), shift: DVec2::new(0.1, -0.05) };

#[test]
fn a_lens_equals_the_f64_twin() {
    for (roulette, sampler, next_event) in [(false, Source::Pcg, false), (true, Source::Sobol, true)] {
        let room = Room { roulette, sampler, next_event, lens: WIDE, ..Room::cornell() };
        assert!(room.features().contains(&"lens"));
        against_twin(&room, Library::shipped(), &small(&room))
            .unwrap_or_else(|why| panic!("{sampler:?}, lights asked {next_event}: {why}"));
    }
}

#[test]
fn a_wrong_lens_is_seen() {
    let room = Room { lens: WIDE, ..Room::cornell() };
    let mistakes = [
        ("lib/camera", "camera.position + offset", "camera.position + 0.8 * offset"),
        ("lib/camera", "offset / camera.focus", "0.8 * offset / camera.focus"),
        ("lib/camera", "concentric_disk(u)", "abs(concentric_disk(u))"),
    ];
    sees_mistakes(&room, &mistakes);
}

#[test]
fn without_an_aperture_a_camera_is_a_pinhole_to_the_bit() {
    let path = std::path::Path::new("assets/scenes/cornell-data.ron");
    let defines =
        [("film.size", "(24, 16)"), ("render.spp", "2")].map(|(path, value)| scene::Define::given(path, value));
    let description = scene::load(path, &defines).unwrap().description;
    let film = |lens: Lens| {
        let mut description = description.clone();
        description.cameras.values_mut().for_each(|camera| *camera = Camera { lens, ..*camera });
        let mut engine = Engine::open(support::gpu(), Library::shipped(), &description).unwrap();
        while !engine.step(Duration::from_millis(100)).unwrap().finished {}
        engine.film().unwrap().rgb
    };
    let pinhole = film(Lens::default());
    assert_eq!(film(Lens { focus: Focus::Distance(3.0), ..Lens::default() }), pinhole);
    assert_ne!(film(Lens { aperture: 20.0, ..Lens::default() }), pinhole);
    assert_ne!(film(Lens { shift: DVec2::X * 0.2, ..Lens::default() }), pinhole);
}
