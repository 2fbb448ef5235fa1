//! What hides a light from light sampling is what hides it from a path that finds it by chance: covers close before lamps, lamps in one
//! place, lamps in the plane of their ceiling.

use glam::{UVec2, Vec3};
use lucerna::components::{Energy, Material};
use lucerna::gpu::Runtime;
use lucerna::layout::trace::TraceParams;
use lucerna::prepare::material;
use lucerna::shader::Library;

use crate::rooms::{Room, matte};
use crate::support;
use crate::support::plant::plant;

use super::{batch, compare, gpu_sums, samples};

/// A floor of 4 x 4 under lamps of 3 x 3 at height 1, all of them moved and scaled, seen from the side.
struct Stage {
    /// From the floor's middle, before scaling.
    offset: Vec3,
    scale: f32,
    one_sided: bool,
    /// Radiances of lamps in one place.
    lamps: Vec<Vec3>,
    /// A black sheet so far below them, by part of the height, or above, if negative.
    gap: Option<f32>,
}

const PLAIN: Stage = Stage { offset: Vec3::ZERO, scale: 1.0, one_sided: false, lamps: Vec::new(), gap: None };

impl Stage {
    fn room(&self) -> Room {
        let place = |p: Vec3| (p + self.offset) * self.scale;
        let mut room = Room::default();
        let floor = room.material(matte(Vec3::splat(0.5), Vec3::ZERO));
        let (x, z) = (Vec3::X * self.scale, Vec3::Z * self.scale);
        room.quad(place(Vec3::new(-2.0, 0.0, 2.0)), 4.0 * x, -4.0 * z, floor);
        for emission in &self.lamps {
            let glow = Material { emission: *emission, one_sided: self.one_sided, ..Material::BLACK };
            let lamp = room.material(material::pack(&glow, Energy::Preserve));
            room.quad(place(Vec3::new(-1.5, 1.0, -1.5)), 3.0 * x, 3.0 * z, lamp);
        }
        if let Some(gap) = self.gap {
            let cover = room.material(matte(Vec3::ZERO, Vec3::ZERO));
            room.quad(place(Vec3::new(-2.0, 1.0 - gap, 2.0)), 4.0 * x, -4.0 * z, cover);
        }
        room
    }

    fn params(&self, room: &Room, layers: u32) -> TraceParams {
        let position = (Vec3::new(0.0, 0.6, 3.0) + self.offset) * self.scale;
        TraceParams { position, layers, max_depth: 2, ..room.params(UVec2::splat(8)) }
    }

    /// The mean radiance that light sampling finds.
    fn sampled(&self, library: Library) -> f64 {
        let room = Room { next_event: true, ..self.room() };
        let mut rig = Runtime::new(support::gpu(), library);
        room.load(&mut rig);
        let got = samples(&mut rig, &self.params(&room, 64));
        got.iter().map(|sample| sample.rgb.as_dvec3().element_sum()).sum::<f64>() / got.len() as f64
    }

    /// Whether light sampling and chance agree in every block and channel.
    fn agrees(&self, library: Library) -> Result<(), String> {
        let room = self.room();
        let params = self.params(&room, 3200);
        let mut found = support::rig();
        room.load(&mut found);
        let sampling = Room { next_event: true, ..room };
        let sampled_params = self.params(&sampling, 3200);
        let mut sampled = Runtime::new(support::gpu(), library);
        sampling.load(&mut sampled);
        compare(
            |i| gpu_sums(&mut sampled, &TraceParams { seed: 2, ..batch(&sampled_params, i) }),
            |i| gpu_sums(&mut found, &batch(&params, i)),
        )
    }
}

/// The kernel with shadow rays that end 2^-16 of their length before the light, as they did once.
fn ending_early() -> Library {
    let parts = [
        ("passes/trace/shadow", "offset / far, far * drawn.end)", "offset / far, far * (1.0 - 0x1p-16))"),
        (
            "passes/trace/shadow",
            "hit.triangle == connection.triangle || (hit.triangle == NO_HIT && connection.ends_before)",
            "hit.triangle == NO_HIT",
        ),
    ];
    parts.iter().fold(Library::shipped(), |library, (module, right, wrong)| plant(library, module, right, wrong))
}

/// Floats tell heights near 1 apart by 6e-8, and t by a few of that: from 1e-6 on, every cover is before its lamp.
#[test]
fn a_cover_hides_a_lamp_however_close() {
    let lamps = vec![Vec3::splat(5.0)];
    for scale in [1.0, 1e-6, 1e6] {
        for gap in [1e-6, 1e-5, 1e-4, 1e-3] {
            let stage = Stage { lamps: lamps.clone(), gap: Some(gap), scale, ..PLAIN };
            assert_eq!(stage.sampled(Library::shipped()), 0.0, "a gap of {gap:e}, scaled by {scale:e}");
        }
    }
    // Far from the origin floats are coarser.
    let stage = Stage { lamps: lamps.clone(), gap: Some(1e-3), offset: Vec3::new(100.0, -50.0, 70.0), ..PLAIN };
    assert_eq!(stage.sampled(Library::shipped()), 0.0);
    // Above the lamp it hides nothing.
    let open = Stage { lamps: lamps.clone(), gap: None, ..PLAIN }.sampled(Library::shipped());
    let above = Stage { lamps: lamps.clone(), gap: Some(-1e-5), ..PLAIN }.sampled(Library::shipped());
    assert!(open > 0.0 && (above / open - 1.0).abs() < 1e-6, "{above} beside {open}");
    let stage = Stage { lamps, gap: Some(1e-5), ..PLAIN };
    assert!(stage.sampled(ending_early()) > 0.05 * open, "a shadow ray that ends early went unnoticed");
}

/// Gaps that floats can't resolve: which of the two a ray meets first is rounding's to say, and says the same to both estimators.
#[test]
fn covers_within_rounding_and_coincident_lamps_look_the_same_to_both_estimators() {
    let (red, green, blue) = (Vec3::new(5.0, 0.5, 0.5), Vec3::new(0.5, 5.0, 0.5), Vec3::new(0.5, 0.5, 5.0));
    let stages = [
        Stage { lamps: vec![red], gap: Some(0.0), ..PLAIN },
        Stage { lamps: vec![red], gap: Some(f32::EPSILON / 2.0), ..PLAIN },
        Stage { lamps: vec![red], gap: Some(1e-7), one_sided: true, ..PLAIN },
        Stage { lamps: vec![red, green], ..PLAIN },
        Stage { lamps: vec![red, green, blue], one_sided: true, ..PLAIN },
        // A lamp in the plane of its ceiling.
        Stage { lamps: vec![red, red], gap: Some(0.0), scale: 1e-3, ..PLAIN },
    ];
    for (case, stage) in stages.iter().enumerate() {
        stage.agrees(Library::shipped()).unwrap_or_else(|why| panic!("case {case}: {why}"));
    }
    assert!(stages[3].agrees(ending_early()).is_err(), "lamps counted twice went unnoticed");
}
