//! Random samples of scenes of every kind: kernel and twin walk the same path, and where they part it is rounding.

use glam::UVec2;
use lucerna::cpu::replay::Why;
use lucerna::engine::Replay;
use lucerna::scene::SceneDescription;
use lucerna::shader::Library;

use super::{SIZE, open, scene_with};
use crate::support::dice::Dice;
use crate::support::plant::planted;
use crate::textures::garden::Garden;

/// Of 200 samples, those that may part by more than the twin's shaken walks make of rounding: a number in some ten thousand is a little beyond
/// the widest of ninety-six.
const UNEXPLAINED: usize = 2;

/// Samples of pixels, by chance.
fn chosen(count: usize, seed: u64) -> Vec<(UVec2, u32)> {
    let mut dice = Dice(seed);
    let mut below = |end: u32| (dice.unit() * f64::from(end)) as u32;
    (0..count).map(|_| (UVec2::new(below(SIZE.x), below(SIZE.y)), below(1000))).collect()
}

fn replays(description: &SceneDescription, library: Library, count: usize) -> Vec<Replay> {
    open(library, description).replay_all(&chosen(count, 7)).unwrap()
}

/// What is told of a sample that should have been explained.
fn told(replay: &Replay) -> String {
    let (parting, twin) = (&replay.verdict.comparison.parting, &replay.verdict.twin);
    let at = parting.as_ref().map_or(0, |parting| parting.turn);
    let [ours, right] = [replay.gpu.get(at), twin.get(at)];
    format!("{} {}: {:?}, {parting:?}\n{ours:#?}\n{right:#?}", replay.pixel, replay.sample, replay.verdict.why)
}

fn six_scenes() -> [(&'static str, SceneDescription); 6] {
    let shipped = |name| (name, scene_with(name, &[]));
    let [data, cornell, glass, teapot] = ["cornell-data", "cornell-box", "glass", "teapot-daylight"].map(shipped);
    let sky = scene_with("glass", &[("environment", "Sky(sun: (40, 60))")]);
    [data, cornell, glass, teapot, ("under a sky", sky), ("garden", Garden::full(SIZE).description)]
}

#[test]
fn a_thousand_samples_are_the_twins_or_rounding_parts_them() {
    for (name, description) in six_scenes() {
        let all = replays(&description, Library::shipped(), 200);
        assert_eq!(all.len(), 200);
        let parted: Vec<&Replay> = all.iter().filter(|replay| replay.verdict.comparison.parting.is_some()).collect();
        let unexplained: Vec<String> =
            parted.iter().filter(|replay| !replay.verdict.is_explained()).map(|replay| told(replay)).collect();
        assert!(unexplained.len() <= UNEXPLAINED, "{name}: {} of 200\n{}", unexplained.len(), unexplained.join("\n"));
        // A path parts where an edge or a threshold lies within rounding: of a scene in which everything does, nothing would be compared.
        assert!(parted.len() <= 10, "{name}: {} of 200 part", parted.len());
        let rays: usize = all.iter().map(|replay| replay.gpu.len()).sum();
        assert!(rays > 300, "{name}: {rays} rays in all");
    }
}

#[test]
fn what_is_compared_is_bounded_by_a_few_roundings() {
    // Else the bounds could be as wide as to hold for anything.
    let all = replays(&scene_with("cornell-data", &[]), Library::shipped(), 50);
    for row in all.iter().flat_map(|replay| &replay.verdict.comparison.turns).flat_map(|turn| &turn.rows) {
        if ["direction", "throughput", "t", "drawn direction", "drawn weight"].contains(&row.name) {
            assert!(row.explained < 1e-3, "{}: {}", row.name, row.explained);
        }
    }
}

#[test]
fn an_error_of_a_thousandth_is_named_where_it_is() {
    for (module, right, wrong, name) in [
        ("lib/bsdf/lambert", "return kd * (INV_PI", "return kd * (1.001 * INV_PI", "light's f cos"),
        ("passes/trace/connect", "return area_pdf * (t * t", "return 1.001 * area_pdf * (t * t", "light's pdf"),
        (
            "lib/sampling",
            "return Angle(sqrt(1.0 - u), sqrt(u));",
            "return Angle(sqrt(1.0 - 0.999 * u), sqrt(0.999 * u));",
            "drawn direction",
        ),
        (
            "passes/trace/path",
            "(*state).throughput /= survival;",
            "(*state).throughput /= 1.001 * survival;",
            "throughput",
        ),
    ] {
        let all = replays(&scene_with("cornell-box", &[]), planted(module, right, wrong), 40);
        let named = |replay: &&Replay| {
            let parting = replay.verdict.comparison.parting.as_ref();
            parting.is_some_and(|parting| parting.name == name) && replay.verdict.why == Some(Why::Unexplained)
        };
        let found = all.iter().filter(named).count();
        assert!(found >= 3, "{wrong} in {module}: {found} of 40");
    }
}
