//! A compute pipeline, made of a linked pass.

use super::pipeline_cache::Slot;
use super::{Gpu, GpuError};
use crate::passes::{Access, Pass};
use crate::shader::{EntryPoint, ResourceKind, SHADER_VALUES};

/// A compiled pass.
pub struct Pipeline {
    pub(super) compute: wgpu::ComputePipeline,
    pub(super) layout: wgpu::BindGroupLayout,
    pub(super) entry: EntryPoint,
    /// Unlike for every pipeline ever made: what bind groups are cached by.
    pub(super) serial: u32,
    /// Equal for equal code.
    pub(super) fingerprint: u64,
    /// It is of an edited shader.
    pub(super) edited: bool,
    /// Its loops end after so many rounds, as those of edited shaders do.
    pub(super) limited: bool,
}

/// Makes the pipeline of a pass, and the layout of its bind group; from what was kept of it, where that is there.
pub(super) fn build(
    gpu: &Gpu,
    pass: &'static Pass,
    entry: &EntryPoint,
    module: naga::Module,
    kept: Option<&Slot>,
) -> Result<(wgpu::ComputePipeline, wgpu::BindGroupLayout), GpuError> {
    let entries: Vec<_> = entry
        .bindings
        .iter()
        .map(|b| wgpu::BindGroupLayoutEntry {
            binding: b.binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: match b.kind {
                    ResourceKind::StorageRead => wgpu::BufferBindingType::Storage { read_only: true },
                    ResourceKind::StorageReadWrite => wgpu::BufferBindingType::Storage { read_only: false },
                },
                has_dynamic_offset: is_params(pass, &b.name),
                min_binding_size: None,
            },
            count: None,
        })
        .collect();
    gpu.guarded(&format!("pipeline `{}`", pass.name), || {
        let descriptor = wgpu::ShaderModuleDescriptor {
            label: Some(pass.module),
            source: wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(module)),
        };
        let mut checks = wgpu::ShaderRuntimeChecks::checked();
        checks.force_loop_bounding = false;
        // SAFETY: every loop of the shipped shaders has a bound of its own, and those of edited ones were given one
        // (naga's would cost 11 % and counts to 2^64).
        let module = unsafe { gpu.device.create_shader_module_trusted(descriptor, checks) };
        let layout = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(pass.name), entries: &entries });
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(pass.name),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let compute = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(pass.name),
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some(pass.entry),
            // Every shipped kernel writes its workgroup memory before it reads it.
            compilation_options: wgpu::PipelineCompilationOptions {
                zero_initialize_workgroup_memory: false,
                ..Default::default()
            },
            cache: kept.map(|slot| &slot.cache),
        });
        (compute, layout)
    })
}

/// Whether a binding is what a call brings along: the pass's own parameters, or those of shaders.
fn is_params(pass: &Pass, binding: &str) -> bool {
    binding == SHADER_VALUES || pass.bindings.iter().any(|row| row.name == binding && row.access == Access::Params)
}
