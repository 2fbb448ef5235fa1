//! What the rays of the kernel's paths bring, against the twin, path by path; and what comes of it.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3, UVec2, Vec3};
use lucerna::components::Daylight;
use lucerna::cpu::replay::Sample;
use lucerna::cpu::rng::Source;
use lucerna::cpu::sources::{Batch, Class, Emitters, Means, Tally, Way, brought, shares};
use lucerna::layout::sky::SkyTable;
use lucerna::layout::sources::{Contribution, LIGHT_POINT, LIGHT_SKY, LIGHT_SUN};
use lucerna::layout::trace::{RadianceSample, SAMPLE_BAD, TraceParams};
use lucerna::passes::{Recording, sources};
use lucerna::prepare::sun::sun_of;
use lucerna::shader::Library;

use crate::daylight::noon;
use crate::point_lights::glazed;
use crate::rooms::Room;
use crate::support;
use crate::support::plant::planted;

const SIZE: UVec2 = UVec2::new(20, 12);
const LAYERS: u32 = 8;
/// Contributions that are kept: a path of 8 segments has fewer.
const SLOTS: u32 = 16;
/// Of the paths, those that may part from the twin's at an edge or a threshold.
const MOST_PARTED: f64 = 0.01;

/// Rooms that have every way and every light among them, and which of these each has.
fn rooms() -> Vec<(&'static str, Room)> {
    let pixels: Vec<Vec3> = (0..32).map(|i| Vec3::new(0.1, 0.2, 0.3) * (1.0 + (i % 3) as f32)).collect();
    let sky = SkyTable::new(UVec2::new(8, 4), &pixels, Vec3::ONE);
    let outside = Room {
        sky: Some(sky),
        sky_turn: DMat3::IDENTITY,
        // It shines into the open side, and is large enough to be found.
        sun: sun_of(&Daylight { elevation: 30.0, azimuth: 180.0, sun_size: 20.0, ..noon() }),
        next_event: true,
        ..Room::glass()
    };
    let asked = Room { roulette: true, next_event: true, sampler: Source::Sobol, ..Room::cornell() };
    vec![("cornell", asked), ("found", Room::glass()), ("glazed", glazed()), ("outside", outside)]
}

struct Traced {
    params: TraceParams,
    samples: Vec<RadianceSample>,
    /// Of each path.
    lists: Vec<Vec<Contribution>>,
}

fn traced(room: &Room, library: Library) -> Traced {
    let params = TraceParams { layers: LAYERS, first_sample: 6, ..room.params(SIZE) };
    let mut rig = lucerna::gpu::Runtime::new(support::gpu(), library);
    room.load(&mut rig).unwrap();
    for (name, bytes) in sources::buffers(&params, SLOTS, None) {
        rig.reserve(name, bytes).unwrap();
    }
    let mut recording = Recording::default();
    sources::record(&mut recording, &params, None);
    rig.play(&recording).unwrap();
    let paths = (SIZE.x * SIZE.y * LAYERS) as usize;
    let counts: Vec<u32> = rig.read_some("brought_counts", paths).unwrap();
    let all: Vec<Contribution> = rig.read_some("brought", paths * SLOTS as usize).unwrap();
    let list = |place: usize| (0..counts[place] as usize).map(|slot| all[slot * paths + place]).collect();
    Traced { params, samples: rig.read_some("radiance", paths).unwrap(), lists: (0..paths).map(list).collect() }
}

fn twins(room: &Room, params: &TraceParams) -> Traced {
    let scene = room.twin();
    let mut traced = Traced { params: *params, samples: Vec::new(), lists: Vec::new() };
    for layer in 0..LAYERS {
        for i in 0..SIZE.x * SIZE.y {
            let pixel = UVec2::new(i % SIZE.x, i / SIZE.x);
            let of = Sample { pixel, sample: params.first_sample + layer, lends: false };
            let (list, walked) = brought(&scene, params, of);
            traced.samples.push(RadianceSample { rgb: walked.traced.radiance.as_vec3(), info: walked.traced.rays });
            traced.lists.push(list);
        }
    }
    traced
}

/// Which kind of light it is.
fn kind(light: u32) -> u32 {
    match light {
        LIGHT_SKY | LIGHT_SUN => light,
        light => light & LIGHT_POINT,
    }
}

fn ways(list: &[Contribution]) -> Vec<Contribution> {
    list.iter().map(|one| Contribution { rgb: Vec3::ZERO, ..*one }).collect()
}

/// Whether two paths bring the same, but for rounding.
fn alike(ours: &[Contribution], right: &[Contribution]) -> bool {
    let near =
        |(a, b): (&Contribution, &Contribution)| (a.rgb - b.rgb).abs().max_element() <= 2e-3 * b.rgb.max_element();
    ways(ours) == ways(right) && ours.iter().zip(right).all(near)
}

fn tally(traced: &Traced) -> Tally {
    let paths = traced.lists.len();
    let counts: Vec<u32> = traced.lists.iter().map(|list| list.len() as u32).collect();
    let longest = traced.lists.iter().map(Vec::len).max().unwrap();
    let mut brought = vec![Contribution::default(); paths * longest];
    for (place, list) in traced.lists.iter().enumerate() {
        list.iter().enumerate().for_each(|(slot, one)| brought[slot * paths + place] = *one);
    }
    let Traced { params, samples, .. } = traced;
    let batch = Batch { params, samples, counts: &counts, brought: &brought, reuses: false };
    let means = vec![[0.5; 3]; (SIZE.x * SIZE.y) as usize];
    let mut tally = Tally::default();
    let film = Means { min: UVec2::ZERO, size: SIZE, means: &means };
    assert_eq!(tally.add(&batch, film, &Emitters::new(vec![0])).len(), means.len());
    tally
}

#[test]
fn what_rays_bring_is_the_twins() {
    let mut seen: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for (name, room) in rooms() {
        let mut ours = traced(&room, Library::shipped());
        let right = twins(&room, &ours.params);
        let mut parted = 0;
        for place in 0..right.lists.len() {
            let sum: DVec3 = ours.lists[place].iter().map(|one| one.rgb.as_dvec3()).sum();
            let sample = ours.samples[place];
            assert_eq!(sample.info & SAMPLE_BAD, 0);
            let gap = (sum - sample.rgb.as_dvec3()).abs().max_element();
            assert!(gap <= 1e-5 * sum.max_element(), "{name}: all that a sample has is brought, {sum} {sample:?}");
            if !alike(&ours.lists[place], &right.lists[place]) {
                parted += 1;
                ours.lists[place] = right.lists[place].clone();
                ours.samples[place] = right.samples[place];
            }
            for one in &right.lists[place] {
                *seen.entry((one.way, kind(one.light))).or_default() += 1;
            }
        }
        assert!(parted as f64 <= MOST_PARTED * right.lists.len() as f64, "{name}: {parted} paths part");
        let [ours, right] = [ours, right].map(|traced| tally(&traced));
        assert!(ours.relmse() > 0.0 && (ours.relmse() / right.relmse() - 1.0).abs() < 1e-3);
        let of = |tally: &Tally| shares(tally, |class: &Class| *class).into_iter().collect::<BTreeMap<_, _>>();
        let (ours, right) = (of(&ours), of(&right));
        assert_eq!(ours.keys().collect::<Vec<_>>(), right.keys().collect::<Vec<_>>(), "{name}");
        for (class, share) in &right {
            assert!((ours[class].share - share.share).abs() < 1e-3, "{name}: {class:?} {share:?} {:?}", ours[class]);
        }
        let has = |way: Way| right.keys().any(|class| class.way == way);
        assert!(has(Way::Found) && (name == "found" || has(Way::Sampled)), "{name}");
    }
    // Meshes seen, sampled and found; sky and sun alike; points sampled alone. The sun is not in view.
    assert!(seen.len() >= 9, "ways and lights of every kind: {seen:?}");
}

#[test]
fn a_mistake_in_what_is_noted_is_seen() {
    let rooms: BTreeMap<&str, Room> = rooms().into_iter().collect();
    let module = "passes/trace/brought";
    for (name, module, right, wrong) in [
        ("cornell", module, "found.bounce + 1u", "found.bounce"),
        ("cornell", "passes/trace/path", "@if(sources) note_sampled_arrives();", ""),
        ("cornell", "passes/trace/path", "@if(sources) note_found(params, hit.triangle, (*state).direction);", ""),
        ("found", module, "found.through = NO_MATERIAL;\n        found.way", "found.way"),
        ("found", module, "    if (straight) {\n        return;\n    }\n", ""),
        ("glazed", "passes/trace/connect", "note_point(index)", "note_point(index ^ 1u)"),
        ("outside", module, "return LIGHT_SUN;", "return LIGHT_SKY;"),
    ] {
        let room = &rooms[name];
        let ours = traced(room, planted(module, right, wrong));
        let twin = twins(room, &ours.params);
        let parted = ours.lists.iter().zip(&twin.lists).filter(|(ours, right)| !alike(ours, right)).count();
        assert!(parted as f64 > MOST_PARTED * twin.lists.len() as f64, "{wrong} in {module}: {parted} paths part");
    }
}
