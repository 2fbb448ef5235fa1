//! `lucerna doctor`: what there is to draw with.

use crate::app::shared::output;
use crate::app::{Exit, Failure};
use crate::gpu::{AdapterSummary, Gpu, adapters};

/// Bytes of the largest buffer below which scenes of a million triangles don't fit.
const COMFORTABLE: u64 = 128 << 20;

/// Lists the adapters, and opens the one that a render would use.
pub fn run() -> Result<Exit, Failure> {
    let adapters = adapters();
    let mut text = format!("lucerna {}\n", env!("CARGO_PKG_VERSION"));
    for (number, adapter) in adapters.iter().enumerate() {
        text += &described(number, adapter);
    }
    output::print(&text)?;
    let gpu = Gpu::open()?;
    if let Some(folder) = gpu.kept_pipelines() {
        output::print(&format!("what its driver compiles is kept in {}\n", folder.display()))?;
    }
    output::print(&format!("ready: renders use {}\n", gpu.name()))?;
    Ok(Exit::Done)
}

fn described(number: usize, adapter: &AdapterSummary) -> String {
    let mark = if adapter.chosen { "*" } else { " " };
    let mib = |bytes: u64| format!("{} MiB", bytes >> 20);
    let mut text = format!(
        "{mark} {number}: {} ({}, {})\n     driver: {}\n     buffers: {}, bound {} at a time\n     \
         workgroups: {} invocations, {} KiB\n     times of single passes: {}\n",
        adapter.name,
        adapter.backend,
        adapter.kind,
        adapter.driver,
        mib(adapter.max_buffer),
        mib(adapter.max_binding),
        adapter.max_workgroup_size,
        adapter.max_workgroup_memory >> 10,
        if adapter.timestamps { "yes" } else { "no" },
    );
    if adapter.kind == "Cpu" {
        text += "     note: this draws on the processor; a graphics card's own driver is a hundred times faster\n";
    }
    if adapter.max_binding <= COMFORTABLE {
        text += "     note: scenes of more than about a million triangles don't fit its buffers\n";
    }
    text
}
