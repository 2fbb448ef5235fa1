//! Rays through the GPU's traversal, of any tree, and through what it is compared with.

use lucerna::cpu::intersect::Fma;
use lucerna::cpu::tree::Tree;
use lucerna::gpu::Runtime;
use lucerna::layout::ray::{ExtendParams, Hit, Ray};
use lucerna::layout::tree::{Node, Triangle, root};
use lucerna::passes::{Binding, Pass, Recording, Size, extend};
use lucerna::shader::Library;

/// `extend` without a tree: every leaf is tested, by the function that the walk uses.
const BRUTE_WGSL: &str = "
import package::gen::{ExtendParams, Hit, Ray, LEAF_BIT, NO_HIT, NO_ROOT};
import package::lib::intersect::{prepare_query};
import package::passes::trace::leaf::{test_leaf};
import package::passes::trace::scene::{load_node, scene_extent};

@group(0) @binding(2) var<storage, read> params: ExtendParams;
@group(0) @binding(3) var<storage, read> rays: array<Ray>;
@group(0) @binding(4) var<storage, read_write> hits: array<Hit>;

@compute @workgroup_size(64)
fn extend_brute(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
                @builtin(local_invocation_index) lane: u32) {
    let index = (group.x + group.y * groups.x) * 64u + lane;
    if index >= params.count {
        return;
    }
    let ray = rays[index];
    var hit = Hit(ray.t_max, NO_HIT, 0u, 0.0, 0.0, 0u);
    if params.root != NO_ROOT && !all(ray.direction == vec3(0.0)) {
        let query = prepare_query(ray, scene_extent(params.root), 0u);
        var count = 1u;
        if params.root < LEAF_BIT {
            count = load_node(params.root).leaves;
        }
        for (var leaf = 0u; leaf < count; leaf += 1u) {
            test_leaf(query, leaf, &hit);
        }
    }
    hits[index] = hit;
}
";

static EXTEND_BRUTE: Pass = Pass {
    name: "extend_brute",
    module: "passes/trace/extend_brute",
    entry: "extend_brute",
    features: &[],
    bindings: extend::EXTEND.bindings,
    makes: &[],
    twin: lucerna::passes::Twin::None("of a test"),
};

/// The closest hits of two triangles and more as paths find them in scenes of at most 32.
const FEW_WGSL: &str = "
import package::gen::{ExtendParams, Hit, Ray, NO_CHANCE};
import package::passes::trace::few_boxes::{keep_boxes};
import package::passes::trace::scene::{scene_extent};
import package::passes::trace::traverse_few::{traverse_few};

@group(0) @binding(2) var<storage, read> params: ExtendParams;
@group(0) @binding(3) var<storage, read> rays: array<Ray>;
@group(0) @binding(4) var<storage, read_write> hits: array<Hit>;

@compute @workgroup_size(64)
fn extend_few(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>,
              @builtin(local_invocation_index) lane: u32) {
    keep_boxes(params.root, lane, 64u);
    let index = id.x + id.y * groups.x * 64u;
    if index < params.count {
        hits[index] = traverse_few(rays[index], params.root, scene_extent(params.root), 0.0, NO_CHANCE);
    }
}
";

static EXTEND_FEW: Pass = Pass {
    name: "extend_few",
    module: "passes/trace/extend_few",
    entry: "extend_few",
    features: &[],
    bindings: extend::EXTEND.bindings,
    makes: &[],
    twin: lucerna::passes::Twin::None("of a test"),
};

/// Word 0 becomes fma(1 + 2^-12, 1 + 2^-12, -1 - 2^-11), which is 2^-24 if rounded once, 0 if twice. It reads the
/// three, lest a compiler compute it.
const FMA_WGSL: &str = "
@group(0) @binding(0) var<storage, read_write> words: array<f32>;

@compute @workgroup_size(1)
fn probe_fma() {
    words[0] = fma(words[0], words[1], words[2]);
}
";

static PROBE_FMA: Pass = Pass {
    name: "probe_fma",
    module: "passes/probe_fma",
    entry: "probe_fma",
    features: &[],
    bindings: &[Binding::write("words", "array<f32>")],
    makes: &[],
    twin: lucerna::passes::Twin::None("of a test"),
};

/// How the device of the tests rounds fma().
pub fn device_fma() -> Fma {
    let library = Library::shipped().with("passes/probe_fma", FMA_WGSL);
    let mut rig = Runtime::new(super::gpu(), library);
    let step = 2f32.powi(-12);
    rig.upload("words", &[1.0 + step, 1.0 + step, -1.0 - 2.0 * step]).unwrap();
    let mut recording = Recording::default();
    recording.run(&PROBE_FMA, Size::Items(1));
    rig.play(&recording).unwrap();
    if rig.read_some::<f32>("words", 1).unwrap()[0] == 0.0 { Fma::Unfused } else { Fma::Fused }
}

/// A runtime that has a tree and traces rays in it.
pub struct Tracer {
    rig: Runtime,
    root: u32,
}

impl Tracer {
    pub fn new() -> Self {
        Self::with(Library::shipped())
    }

    fn with(library: Library) -> Self {
        let library = library.with("passes/trace/extend_brute", BRUTE_WGSL).with("passes/trace/extend_few", FEW_WGSL);
        Self { rig: Runtime::new(super::gpu(), library), root: 0 }
    }

    /// As on a device that is the processor in disguise, whatever this one is.
    pub fn on_software() -> Self {
        let mut tracer = Self::new();
        tracer.rig.set_features(&["software"]);
        tracer
    }

    /// A traversal whose stack holds `size` entries.
    pub fn with_stack(size: u32) -> Self {
        Self::with(Library::shipped().with(
            "lib/traverse_config",
            &format!("const STACK_SIZE: u32 = {size}u;\nconst VISITS_PER_LEAF: u32 = 3u;\n"),
        ))
    }

    pub fn load(&mut self, tree: &Tree) {
        let or_default = |nodes: &[Node]| if nodes.is_empty() { vec![Node::default()] } else { nodes.to_vec() };
        self.rig.upload("nodes", &or_default(&tree.nodes)).unwrap();
        let leaves = if tree.leaves.is_empty() { vec![Triangle::default()] } else { tree.leaves.clone() };
        self.rig.upload("leaves", &leaves).unwrap();
        self.root = root(tree.leaves.len() as u32);
    }

    fn run<T: bytemuck::AnyBitPattern + Send>(
        &mut self,
        pass: &'static Pass,
        rays: &[Ray],
        out: &'static str,
    ) -> Vec<T> {
        for (name, bytes) in extend::buffers(rays.len() as u32) {
            self.rig.reserve(name, bytes).unwrap();
        }
        if !rays.is_empty() {
            self.rig.upload("rays", rays).unwrap();
        }
        let mut recording = Recording::default();
        let params = ExtendParams { count: rays.len() as u32, root: self.root };
        recording.run(pass, Size::Items(rays.len() as u64)).params(&params);
        self.rig.play(&recording).unwrap();
        self.rig.read_some(out, rays.len()).unwrap()
    }

    pub fn extend(&mut self, rays: &[Ray]) -> Vec<Hit> {
        self.run(&extend::EXTEND, rays, "hits")
    }

    pub fn brute(&mut self, rays: &[Ray]) -> Vec<Hit> {
        self.run(&EXTEND_BRUTE, rays, "hits")
    }

    /// Of a tree of 2 to 32 leaves.
    pub fn few(&mut self, rays: &[Ray]) -> Vec<Hit> {
        self.run(&EXTEND_FEW, rays, "hits")
    }

    pub fn occluded(&mut self, rays: &[Ray]) -> Vec<u32> {
        self.run(&extend::OCCLUDED, rays, "occlusion")
    }
}
