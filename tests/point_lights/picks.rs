//! Which light a number says, and what is left of it: by the kernel's code, against the twin.

use glam::Vec4;
use lucerna::cpu::cdf::draw_index;
use lucerna::gpu::Runtime;
use lucerna::layout::cdf::{CdfEntry, HALF_STEP};
use lucerna::layout::light::LightRecord;
use lucerna::layout::trace::TraceParams;
use lucerna::passes::{Binding, Pass, Recording, Size};
use lucerna::prepare::cdf::cdf_table;
use lucerna::scene::generate::SplitMix;
use lucerna::shader::Library;

use crate::support;
use crate::support::plant::planted;

/// Numbers, evenly from 0 to 1: at every 2^8 steps of those that are drawn.
const NUMBERS: u32 = 1 << 16;

const PROBE: &str = "
import package::gen::{TraceParams};
import package::passes::trace::connect::{pick_light};

@group(0) @binding(0) var<storage, read> params: TraceParams;
@group(0) @binding(1) var<storage, read_write> probed: array<vec4<f32>>;

@compute @workgroup_size(64)
fn pick_lights(@builtin(global_invocation_id) id: vec3<u32>) {
    let drawn = pick_light(params, f32(id.x) * 0x1p-16);
    probed[id.x] = vec4<f32>(f32(drawn.index), drawn.rest, 0.0, 0.0);
}
";

static PICK: Pass = Pass {
    name: "pick_lights",
    module: "tests/picks",
    entry: "pick_lights",
    features: &[],
    bindings: &[
        Binding::params("TraceParams"),
        Binding::write("probed", "array<vec4<f32>>"),
        Binding::read("lights", "array<vec4<u32>>"),
    ],
    makes: &[],
    twin: lucerna::passes::Twin::None("of a test"),
};

/// Of each number the light, and what is left of the number.
fn picks(library: Library, table: &[CdfEntry]) -> Vec<(usize, f32)> {
    let record = |entry: &CdfEntry| LightRecord { end: entry.end, first: entry.first, ..LightRecord::default() };
    let lights: Vec<LightRecord> = table.iter().map(record).collect();
    let params = TraceParams { lights: lights.len() as u32, ..TraceParams::default() };
    let mut rig = Runtime::new(support::gpu(), library.with("tests/picks", PROBE));
    rig.set_features(&["lights"]);
    rig.upload("lights", &lights).unwrap();
    rig.reserve("probed", 16 * u64::from(NUMBERS)).unwrap();
    let mut recording = Recording::default();
    recording.run(&PICK, Size::Items(NUMBERS.into())).params(&params);
    rig.play(&recording).unwrap();
    let rows: Vec<Vec4> = rig.read_some("probed", NUMBERS as usize).unwrap();
    rows.iter().map(|row| (row.x as usize, row.y)).collect()
}

/// How many numbers are of another light than by the twin, or have another rest. Half a step of the numbers may be lost: Mesa adds it first,
/// where it is rounded.
fn wrong(library: Library, table: &[CdfEntry]) -> usize {
    let is_wrong = |(i, (index, rest)): (usize, (usize, f32))| {
        let u = i as f64 / f64::from(NUMBERS);
        let right = draw_index(table.len(), u, |index| (table[index].end, table[index].first));
        let start = if right.0 > 0 { table[right.0 - 1].end } else { 0.0 };
        let half_step = f64::from(HALF_STEP) / f64::from(table[right.0].end - start);
        index != right.0 || (f64::from(rest) - right.1).abs() > 1e-6 + 1.01 * half_step
    };
    picks(library, table).into_iter().enumerate().filter(|pick| is_wrong(*pick)).count()
}

#[test]
fn the_kernel_picks_as_its_twin_does() {
    for lights in [1, 2, 3, 77, 1 << 10, (1 << 16) + 1] {
        let mut random = SplitMix(lights);
        let weights: Vec<f64> = (0..lights).map(|i| if i % 5 == 3 { 0.0 } else { random.unit() }).collect();
        assert_eq!(wrong(Library::shipped(), &cdf_table(&weights)), 0, "{lights} lights");
    }
    let table = cdf_table(&[3.0, 1.0, 0.0, 2.0, 5.0]);
    for (right, mistaken) in [
        ("start = light_end(low - 1u)", "start = 0.999 * light_end(low - 1u)"),
        ("high = light_first(bucket + 1u)", "high = light_first(bucket)"),
        ("(u < light_end(middle))", "(u <= light_end(middle))"),
    ] {
        let table = if mistaken.contains("<=") { cdf_table(&[1.0, 2.0, 1.0]) } else { table.clone() };
        assert!(wrong(planted("passes/trace/connect", right, mistaken), &table) > 0, "{mistaken} went unnoticed");
    }
}
