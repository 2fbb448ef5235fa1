//! Editing sampling code must show within a blink: the budget of compiling the kernel that holds it, cold.

use std::process::Command;
use std::time::{Duration, Instant};

use glam::UVec2;
use lucerna::cpu::rng::Source;

use crate::rooms::{Room, trace_batch, trace_reused_batch};
use crate::support;
use crate::support::patience::processor_time;

/// From text to the first dispatch done: a GPU, lavapipe on 2 cores, and that of Mesa 25, whose code is three times as fast and
/// takes three times as long to make.
const BUDGETS: [Duration; 3] = [Duration::from_millis(350), Duration::from_millis(400), Duration::from_millis(1300)];

/// The machine may be busy: two threads of one core, or its caches, shared with others. The least of several runs counts.
/// The kernel is over both (MEASUREMENTS.md: 0.6 to 0.7 s on busy cores, 0.30 to 0.45 s on a GPU beside other tests), so this guards what
/// there is.
const NOISE: f64 = 2.75;

/// A coat is another lobe, and the kernel has its code twice: where light is asked, and where a direction is drawn.
const COATED: f64 = 1.5;

/// Variable of the child that gives everything a coat.
const COAT: &str = "LUCERNA_TEST_COAT";

/// Where paths are reused there is a second kernel, with the walk and the surface once more, compiled behind the first here.
const REUSED: f64 = 2.0;

/// Variable of the child whose paths are reused.
const REUSE: &str = "LUCERNA_TEST_REUSE";

/// Times in the child's output.
const MARK: &str = "path kernel, cold, milliseconds: ";

/// Processor time of this process so far where the system tells it (in steps of 10 ms), else of the wall's clock.
fn clock() -> Duration {
    static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    let start = START.get_or_init(Instant::now);
    let taken = processor_time(std::process::id()).filter(|_| support::gpu().is_software());
    taken.unwrap_or_else(|| start.elapsed())
}

/// Which of the budgets is meant.
fn kind_of_driver() -> usize {
    let gpu = support::gpu();
    let version =
        gpu.info.driver_info.strip_prefix("Mesa ").and_then(|info| info.split('.').next()?.parse::<u32>().ok());
    match (gpu.is_software(), version) {
        (false, _) => 0,
        (true, Some(25..)) => 2,
        (true, _) => 1,
    }
}

/// Links, compiles and first runs the kernel with every feature of a Cornell box, where everything may have a coat.
fn compile(coat: f32, reuse: bool) -> Duration {
    let mut room = Room { roulette: true, reuse, next_event: true, sampler: Source::Sobol, ..Room::cornell() };
    room.materials.iter_mut().for_each(|material| (material.coat, material.coat_alpha) = (coat, 0.1 * coat));
    let mut rig = support::rig();
    room.load(&mut rig).unwrap();
    let params = room.params(UVec2::splat(8));
    rig.wait().unwrap();
    let start = clock();
    match reuse {
        true => trace_reused_batch(&mut rig, &params, false),
        false => trace_batch(&mut rig, &params),
    }
    rig.wait().unwrap();
    clock() - start
}

#[test]
#[ignore = "runs in processes of their own, started by the test below"]
fn compile_alone() {
    let coat = std::env::var(COAT).map_or(0.0, |coat| coat.parse().unwrap());
    let reuse = std::env::var_os(REUSE).is_some_and(|on| on == "true");
    let took: Vec<_> = (0..5).map(|_| compile(coat, reuse).as_millis().to_string()).collect();
    println!("\n{MARK}{}", took.join(" "));
}

/// The least of five cold times.
fn least(coat: f32, reuse: bool) -> Duration {
    let child = Command::new(std::env::current_exe().unwrap())
        .args(["compile::compile_alone", "--exact", "--ignored", "--nocapture"])
        .envs([
            ("MESA_SHADER_CACHE_DISABLE", "true"),
            ("__GL_SHADER_DISK_CACHE", "0"),
            ("LUCERNA_PIPELINE_CACHE", "off"),
            (COAT, &coat.to_string()),
            (REUSE, &reuse.to_string()),
        ])
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&child.stdout);
    let times = text.lines().find_map(|line| line.strip_prefix(MARK)).unwrap_or_else(|| panic!("no times in: {text}"));
    println!("coat {coat}, reuse {reuse}, {MARK}{times}");
    Duration::from_millis(times.split(' ').map(|ms| ms.parse::<u64>().unwrap()).min().unwrap())
}

#[test]
fn the_path_kernel_compiles_within_its_budget() {
    let budget = BUDGETS[kind_of_driver()].mul_f64(NOISE);
    for (coat, reuse, factor) in [(0.0, false, 1.0), (1.0, false, COATED), (0.0, true, REUSED)] {
        let least = least(coat, reuse);
        assert!(
            least <= budget.mul_f64(factor),
            "the path kernel, coat {coat}, reuse {reuse}, took {least:?} to compile, cold"
        );
    }
}
