//! Rays through the GPU's traversal, of any tree, and through what it is compared with.

use crate::cpu::intersect::Fma;
use crate::cpu::tree::Tree;
use crate::gpu::{Gpu, GpuError, Runtime};
use crate::layout::ray::{ExtendParams, Hit, Ray};
use crate::layout::tree::{Node, Triangle, root};
use crate::passes::{Pass, Recording, Size, Twin, extend};
use crate::stress::lab::Lab;

/// `extend` without a tree: every leaf is tested, by the function that the walk uses.
static EXTEND_BRUTE: Pass = Pass {
    name: "extend_brute",
    module: "passes/trace/extend_brute",
    entry: "extend_brute",
    features: &[],
    bindings: extend::EXTEND.bindings,
    makes: &[],
    twin: Twin::None("of a stress"),
};

/// The closest hits of two triangles and more as paths find them in scenes of at most 32.
static EXTEND_FEW: Pass = Pass {
    name: "extend_few",
    module: "passes/trace/extend_few",
    entry: "extend_few",
    features: &[],
    bindings: extend::EXTEND.bindings,
    makes: &[],
    twin: Twin::None("of a stress"),
};

/// Rays at once, as buffers hold them.
pub const AT_ONCE: u64 = 1 << 20;

/// How a device rounds fma().
pub fn device_fma(gpu: &Gpu) -> Fma {
    if gpu.rounds_twice() { Fma::Unfused } else { Fma::Fused }
}

/// A runtime that has a tree and traces rays in it.
pub struct Tracer {
    rig: Runtime,
    root: u32,
}

impl Tracer {
    pub fn new(lab: &Lab) -> Self {
        let library = lab.library().clone();
        let library = library.with("passes/trace/extend_brute", include_str!("extend_brute.wgsl"));
        let library = library.with("passes/trace/extend_few", include_str!("extend_few.wgsl"));
        Self { rig: Runtime::new(lab.gpu().clone(), library), root: 0 }
    }

    /// As on a device that is the processor in disguise, whatever this one is.
    pub fn on_software(lab: &Lab) -> Self {
        let mut tracer = Self::new(lab);
        tracer.rig.set_features(&["software"]);
        tracer
    }

    /// A traversal whose stack holds `size` entries.
    pub fn with_stack(lab: &Lab, size: u32) -> Self {
        let config = format!("const STACK_SIZE: u32 = {size}u;\nconst VISITS_PER_LEAF: u32 = 3u;\n");
        let mut tracer = Self::new(lab);
        let library = tracer.rig.library().clone().with("lib/traverse_config", &config);
        tracer.rig = Runtime::new(lab.gpu().clone(), library);
        tracer
    }

    /// Holds a tree from now on.
    pub fn load(&mut self, tree: &Tree) -> Result<(), GpuError> {
        let or_default = |nodes: &[Node]| if nodes.is_empty() { vec![Node::default()] } else { nodes.to_vec() };
        self.rig.upload("nodes", &or_default(&tree.nodes))?;
        let leaves = if tree.leaves.is_empty() { vec![Triangle::default()] } else { tree.leaves.clone() };
        self.rig.upload("leaves", &leaves)?;
        self.root = root(tree.leaves.len() as u32);
        Ok(())
    }

    fn run<T: bytemuck::AnyBitPattern + Send>(
        &mut self,
        pass: &'static Pass,
        rays: &[Ray],
        out: &'static str,
    ) -> Result<Vec<T>, GpuError> {
        for (name, bytes) in extend::buffers(rays.len() as u32) {
            self.rig.reserve(name, bytes)?;
        }
        if !rays.is_empty() {
            self.rig.upload("rays", rays)?;
        }
        let mut recording = Recording::default();
        let params = ExtendParams { count: rays.len() as u32, root: self.root };
        recording.run(pass, Size::Items(rays.len() as u64)).params(&params);
        self.rig.play(&recording)?;
        self.rig.read_some(out, rays.len())
    }

    /// The hits that the tree leads to.
    pub fn extend(&mut self, rays: &[Ray]) -> Result<Vec<Hit>, GpuError> {
        self.run(&extend::EXTEND, rays, "hits")
    }

    /// The hits among all leaves.
    pub fn brute(&mut self, rays: &[Ray]) -> Result<Vec<Hit>, GpuError> {
        self.run(&EXTEND_BRUTE, rays, "hits")
    }

    /// Of a tree of 2 to 32 leaves.
    pub fn few(&mut self, rays: &[Ray]) -> Result<Vec<Hit>, GpuError> {
        self.run(&EXTEND_FEW, rays, "hits")
    }

    /// 1 for each ray that hits anything.
    pub fn occluded(&mut self, rays: &[Ray]) -> Result<Vec<u32>, GpuError> {
        self.run(&extend::OCCLUDED, rays, "occlusion")
    }
}

/// What of a hit must be the same whatever the tree: all but the leaf's place and the number of steps.
pub fn bits(hit: &Hit) -> [u32; 4] {
    [hit.t.to_bits(), hit.triangle, hit.b1.to_bits(), hit.b2.to_bits()]
}

/// How many hits are others.
pub fn others(got: &[Hit], expected: &[Hit]) -> u64 {
    got.iter().zip(expected).filter(|(a, b)| bits(a) != bits(b)).count() as u64
        + got.len().abs_diff(expected.len()) as u64
}
