//! Plays a recording: one command buffer, one compute pass, every parameter in one buffer.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use super::pipeline::Pipeline;
use super::pipelines::Pipelines;
use super::timing::Timer;
use super::{Buffers, Gpu, GpuError};
use crate::passes::{Access, Call, Recording, Size};
use crate::shader::{Features, LOOP_FAULTS, SHADER_VALUES};

/// What identifies a bind group: its pipeline, and each buffer by name and generation.
type BindKey = (u32, Vec<(&'static str, u64)>);

/// More cached bind groups than this, and all are dropped: some are of what is bound no more.
const KEPT_BIND_GROUPS: usize = 512;

/// Name of the buffer that holds the parameters of a recording.
pub(super) const PARAMS: &str = "params";

/// Turns recordings into submissions, and counts what it issued.
#[derive(Default)]
pub struct Player {
    bind_groups: HashMap<BindKey, wgpu::BindGroup>,
    params: Option<wgpu::Buffer>,
    params_generation: u64,
    params_sent: u64,
    counts: BTreeMap<&'static str, u64>,
}

/// A call and what is to be sent for it.
struct Given<'a> {
    call: &'a Call,
    pipeline: Arc<Pipeline>,
    /// Words of the shaders' parameters that it reads.
    values: Vec<u32>,
}

/// A call with all that its dispatch needs.
struct Ready<'a> {
    call: &'a Call,
    pipeline: Arc<Pipeline>,
    bind_group: wgpu::BindGroup,
    /// Where in the buffer of parameters its own are, and those of shaders: of the bindings that it has, in order.
    offsets: Vec<u32>,
}

/// What the player works with.
pub(super) struct Stage<'a> {
    pub gpu: &'a Gpu,
    pub buffers: &'a Buffers,
    pub pipelines: &'a mut Pipelines,
    pub features: &'a Features,
}

impl Player {
    /// How often each pass was dispatched so far.
    pub fn counts(&self) -> &BTreeMap<&'static str, u64> {
        &self.counts
    }

    /// Bytes of parameters sent so far.
    pub fn params_sent(&self) -> u64 {
        self.params_sent
    }

    /// Drops the bind groups of a buffer, which would keep its memory.
    pub(super) fn forget(&mut self, buffer: &str) {
        self.bind_groups.retain(|(_, bound), _| bound.iter().all(|(name, _)| *name != buffer));
    }

    /// Bind groups that are kept.
    pub(super) fn bind_groups(&self) -> usize {
        self.bind_groups.len()
    }

    /// Submits all dispatches of a recording, in order.
    pub(super) fn play(
        &mut self,
        stage: Stage,
        recording: &Recording,
        timer: Option<&mut Timer>,
    ) -> Result<(), GpuError> {
        let calls: Vec<&Call> = recording.calls().collect();
        if recording.is_empty() {
            return Ok(());
        }
        let mut given = Vec::with_capacity(calls.len());
        for call in calls {
            let pipeline = stage.pipelines.get(call.pass, stage.features)?;
            let reads_values = pipeline.entry.bindings.iter().any(|bound| bound.name == SHADER_VALUES);
            let values = if reads_values { stage.pipelines.words(call.pass) } else { Vec::new() };
            given.push(Given { call, pipeline, values });
        }
        let offsets = self.upload_params(stage.gpu, &given)?;
        let mut ready = Vec::with_capacity(given.len());
        for (Given { call, pipeline, .. }, offsets) in given.into_iter().zip(offsets) {
            let bind_group = self.bind(stage.gpu, stage.buffers, call, &pipeline)?;
            ready.push(Ready { call, pipeline, bind_group, offsets });
        }
        stage.gpu.guarded("a submission", || encode(&stage, recording.zeroed(), &ready, timer))??;
        for r in &ready {
            *self.counts.entry(r.call.pass.name).or_default() += 1;
        }
        stage.gpu.check_lost()
    }

    /// Packs the parameters of all calls into one buffer. Returns each call's offsets in it: of its own, and of those of shaders.
    fn upload_params(&mut self, gpu: &Gpu, calls: &[Given]) -> Result<Vec<Vec<u32>>, GpuError> {
        let align = gpu.limits.min_storage_buffer_offset_alignment as usize;
        let mut bytes: Vec<u8> = Vec::new();
        let mut offsets = Vec::with_capacity(calls.len());
        for Given { call, values, .. } in calls {
            let mut places = Vec::new();
            for block in [&call.params, bytemuck::cast_slice(values)].into_iter().filter(|block| !block.is_empty()) {
                bytes.resize(bytes.len().next_multiple_of(align), 0);
                places.push(bytes.len() as u32);
                bytes.extend_from_slice(block);
                self.params_sent += block.len() as u64;
            }
            offsets.push(places);
        }
        // Room behind the last block, since a binding's size is rounded up to 16 bytes.
        bytes.resize((bytes.len() + 16).next_multiple_of(align), 0);
        let size = bytes.len() as u64;
        if self.params.as_ref().is_none_or(|b| b.size() < size) {
            self.params = Some(gpu.guarded("the parameter buffer", || {
                gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some(PARAMS),
                    size: size.next_power_of_two().max(4096),
                    usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
                    mapped_at_creation: false,
                })
            })?);
            self.params_generation += 1;
        }
        if let Some(params) = &self.params {
            gpu.queue.write_buffer(params, 0, &bytes);
        }
        Ok(offsets)
    }

    fn bind(
        &mut self,
        gpu: &Gpu,
        buffers: &Buffers,
        call: &Call,
        pipeline: &Pipeline,
    ) -> Result<wgpu::BindGroup, GpuError> {
        let mut key = Vec::with_capacity(pipeline.entry.bindings.len());
        let mut entries = Vec::with_capacity(pipeline.entry.bindings.len());
        for row in call.pass.bindings {
            let Some(found) = pipeline.entry.bindings.iter().find(|b| b.name == row.name) else { continue };
            if row.access == Access::Params {
                let buffer = self.params.as_ref().expect("invariant: parameters are uploaded before binding");
                key.push((PARAMS, self.params_generation));
                entries.push(entry(found.binding, buffer, u64::from(found.size).next_multiple_of(16)));
            } else {
                let name = call.buffer(row.name);
                let Some((buffer, size, generation)) = buffers.get(name) else {
                    return Err(GpuError::NoBuffer { pass: call.pass.name, buffer: name });
                };
                key.push((name, generation ^ (size << 20)));
                entries.push(entry(found.binding, buffer, size));
            }
        }
        if let Some(found) = pipeline.entry.bindings.iter().find(|b| b.name == SHADER_VALUES) {
            let buffer = self.params.as_ref().expect("invariant: parameters are uploaded before binding");
            key.push((SHADER_VALUES, self.params_generation));
            entries.push(entry(found.binding, buffer, u64::from(found.size).next_multiple_of(16)));
        }
        if let Some(found) = pipeline.entry.bindings.iter().find(|b| b.name == LOOP_FAULTS) {
            let Some((buffer, size, generation)) = buffers.get(LOOP_FAULTS) else {
                return Err(GpuError::NoBuffer { pass: call.pass.name, buffer: LOOP_FAULTS });
            };
            key.push((LOOP_FAULTS, generation));
            entries.push(entry(found.binding, buffer, size));
        }
        let key = (pipeline.serial, key);
        if let Some(group) = self.bind_groups.get(&key) {
            return Ok(group.clone());
        }
        if self.bind_groups.len() >= KEPT_BIND_GROUPS {
            self.bind_groups.clear();
        }
        let group = gpu.guarded(&format!("bindings of `{}`", call.pass.name), || {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(call.pass.name),
                layout: &pipeline.layout,
                entries: &entries,
            })
        })?;
        self.bind_groups.insert(key, group.clone());
        Ok(group)
    }
}

fn entry(binding: u32, buffer: &wgpu::Buffer, size: u64) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry {
        binding,
        resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer,
            offset: 0,
            size: std::num::NonZeroU64::new(size),
        }),
    }
}

/// All dispatches in one compute pass: a pass for each would cost 15 times more processor time.
fn encode(
    stage: &Stage,
    zeroed: &[(&'static str, u64)],
    ready: &[Ready],
    mut timer: Option<&mut Timer>,
) -> Result<(), GpuError> {
    let gpu = stage.gpu;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    for (name, bytes) in zeroed {
        let Some((buffer, ..)) = stage.buffers.get(name) else {
            return Err(GpuError::NoBuffer { pass: "zero", buffer: name });
        };
        encoder.clear_buffer(buffer, 0, Some(*bytes));
    }
    if let Some(timer) = timer.as_deref_mut() {
        timer.begin(gpu, ready.iter().map(|r| r.call.pass.name).collect());
    }
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("recording"),
            timestamp_writes: timer.as_deref().and_then(Timer::whole_pass),
        });
        for r in ready {
            pass.set_pipeline(&r.pipeline.compute);
            pass.set_bind_group(0, &r.bind_group, &r.offsets);
            if let Some(timer) = timer.as_deref_mut() {
                timer.stamp(&mut pass);
            }
            dispatch(stage, &mut pass, r)?;
            if let Some(timer) = timer.as_deref_mut() {
                timer.stamp(&mut pass);
            }
        }
    }
    if let Some(timer) = timer {
        timer.resolve(&mut encoder);
    }
    gpu.queue.submit([encoder.finish()]);
    Ok(())
}

fn dispatch(stage: &Stage, pass: &mut wgpu::ComputePass, ready: &Ready) -> Result<(), GpuError> {
    let most = u64::from(stage.gpu.limits.max_compute_workgroups_per_dimension);
    let size = ready.pipeline.entry.workgroup_size;
    let groups = match ready.call.size {
        Size::Items(n) => fold(n.div_ceil(u64::from(size[0])), most),
        Size::Pixels { width, height, layers } => [width.div_ceil(size[0]), height.div_ceil(size[1]), layers],
        Size::Groups([x, 1, 1]) => fold(u64::from(x), most),
        Size::Groups(groups) => groups,
        Size::Indirect { buffer, offset } => {
            let Some((buffer, ..)) = stage.buffers.get(buffer) else {
                return Err(GpuError::NoBuffer { pass: ready.call.pass.name, buffer });
            };
            pass.dispatch_workgroups_indirect(buffer, offset);
            return Ok(());
        }
    };
    pass.dispatch_workgroups(groups[0], groups[1], groups[2]);
    Ok(())
}

/// Workgroups in one dimension, folded into two where the device takes fewer.
fn fold(groups: u64, most: u64) -> [u32; 3] {
    let rows = groups.div_ceil(most).max(1);
    [groups.div_ceil(rows) as u32, rows as u32, 1]
}
