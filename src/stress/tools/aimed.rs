//! Rays that are made where they are traced, so that a thousand million of them need no room.

use crate::gpu::{GpuError, Runtime};
use crate::layout::tree::root;
use crate::passes::{Binding, Pass, Recording, Size, Twin, clear};
use crate::scene::generate::Corners;
use crate::stress::lab::Lab;
use crate::stress::tools::trees::{Cut, build};

gpu_struct! {
    /// What rays are aimed at.
    pub struct AimedParams {
        /// Number of the first ray, and how many there are.
        pub first: u32,
        pub count: u32,
        pub seed: u32,
        pub root: u32,
        pub leaves: u32,
        /// Triangles from this index on have no area.
        pub sound: u32,
        pub pad0: u32,
        pub pad1: u32,
    }
}

static AIM: Pass = Pass {
    name: "aim",
    module: "passes/trace/aimed",
    entry: "aim",
    features: &[],
    bindings: &[
        Binding::read("nodes", "array<vec4<u32>>"),
        Binding::read("leaves", "array<vec4<u32>>"),
        Binding::params("AimedParams"),
        Binding::write("aimed", "array<atomic<u32>>"),
    ],
    makes: &[],
    twin: Twin::None("of a stress"),
};

/// What became of rays that should hit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Aimed {
    pub rays: u64,
    pub missed: u64,
    /// Hits of triangles without area.
    pub degenerate: u64,
}

/// Traces so many rays from around the origin at edges and corners of triangles that enclose it, of which those from `sound` on have no
/// area. `done` is told how many are traced.
pub fn aim(lab: &Lab, triangles: &[Corners], sound: usize, rays: u64, done: impl Fn(u64)) -> Result<Aimed, GpuError> {
    let library = lab.library().clone().with_layouts(&[&AimedParams::LAYOUT], &[]);
    let mut rig = Runtime::new(lab.gpu().clone(), library.with("passes/trace/aimed", include_str!("aimed.wgsl")));
    let tree = build(triangles, Cut::Median);
    rig.upload("nodes", &tree.nodes)?;
    rig.upload("leaves", &tree.leaves)?;
    rig.reserve("aimed", 8)?;
    let leaves = tree.leaves.len() as u32;
    // A dispatch of a second at most.
    let at_once = if lab.is_software() { 1 << 18 } else { 1 << 26 };
    let mut all = Aimed::default();
    while all.rays < rays {
        let count = (rays - all.rays).min(at_once) as u32;
        // Numbers of 32 bits and then others by the seed.
        let params = AimedParams {
            first: all.rays as u32,
            count,
            seed: (all.rays >> 32) as u32,
            root: root(leaves),
            leaves,
            sound: sound as u32,
            ..AimedParams::default()
        };
        let mut recording = Recording::default();
        clear(&mut recording, "aimed", 0, 2);
        recording.run(&AIM, Size::Items(u64::from(count))).params(&params);
        rig.play(&recording)?;
        let [missed, degenerate]: [u32; 2] = rig.read_one("aimed", 0)?;
        all.rays += u64::from(count);
        (all.missed, all.degenerate) = (all.missed + u64::from(missed), all.degenerate + u64::from(degenerate));
        done(all.rays);
    }
    Ok(all)
}
