//! From a row of the pass table to a compute pipeline: linked, checked against its row, compiled, kept.

use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::{Gpu, GpuError};
use crate::passes::{Access, Pass};
use crate::shader::{EntryPoint, Features, Library, Linked, ResourceKind};

/// A compiled pass.
pub struct Pipeline {
    pub(super) compute: wgpu::ComputePipeline,
    pub(super) layout: wgpu::BindGroupLayout,
    pub(super) entry: EntryPoint,
    /// Unlike for every pipeline ever made: what bind groups are cached by.
    pub(super) serial: u64,
}

/// Pipelines by pass and by those features that its import closure names.
pub struct Pipelines {
    library: Library,
    kept: HashMap<(&'static str, Features), Arc<Pipeline>>,
    /// What a scene's features come down to for a pass, so that a known pass is not linked again.
    keys: HashMap<&'static str, (Features, Arc<Pipeline>)>,
    serial: AtomicU64,
}

impl Pipelines {
    pub fn new(library: Library) -> Self {
        Self { library, kept: HashMap::new(), keys: HashMap::new(), serial: AtomicU64::new(0) }
    }

    /// The pipeline of `pass` under `features`, compiled if need be.
    pub fn get(&mut self, gpu: &Gpu, pass: &'static Pass, features: &Features) -> Result<Arc<Pipeline>, GpuError> {
        if let Some(pipeline) = self.known(pass, features) {
            return Ok(pipeline.clone());
        }
        let (key, pipeline) = self.make(gpu, pass, features)?;
        self.keep(pass, features, key, &pipeline);
        Ok(pipeline)
    }

    /// Compiles all that is missing of `passes`, each in a thread of its own: drivers compile in parallel.
    pub fn prepare(&mut self, gpu: &Gpu, passes: &[&'static Pass], features: &Features) -> Result<(), GpuError> {
        let mut missing: Vec<&'static Pass> = Vec::new();
        for pass in passes {
            if self.known(pass, features).is_none() && missing.iter().all(|m| m.name != pass.name) {
                missing.push(pass);
            }
        }
        let this = &*self;
        let made: Vec<_> = std::thread::scope(|scope| {
            let threads: Vec<_> = missing.iter().map(|pass| scope.spawn(|| this.make(gpu, pass, features))).collect();
            threads.into_iter().map(|thread| thread.join()).collect()
        });
        for (pass, made) in missing.into_iter().zip(made) {
            let (key, pipeline) = made.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
            self.keep(pass, features, key, &pipeline);
        }
        Ok(())
    }

    fn known(&self, pass: &Pass, features: &Features) -> Option<&Arc<Pipeline>> {
        self.keys.get(pass.name).filter(|(key, _)| key == features).map(|(_, pipeline)| pipeline)
    }

    /// Links a pass, and compiles it if no other features came down to the same.
    fn make(&self, gpu: &Gpu, pass: &'static Pass, features: &Features) -> Result<(Features, Arc<Pipeline>), GpuError> {
        let linked = self.library.link(pass.module, features)?;
        let key = linked.features.clone();
        if let Some(pipeline) = self.kept.get(&(pass.name, key.clone())) {
            return Ok((key, pipeline.clone()));
        }
        let serial = self.serial.fetch_add(1, Ordering::Relaxed);
        Ok((key, Arc::new(compile(gpu, pass, linked, features, serial)?)))
    }

    fn keep(&mut self, pass: &'static Pass, features: &Features, key: Features, pipeline: &Arc<Pipeline>) {
        self.kept.insert((pass.name, key), pipeline.clone());
        self.keys.insert(pass.name, (features.clone(), pipeline.clone()));
    }
}

/// Whether a binding is the pass's parameters.
fn is_params(pass: &Pass, binding: &str) -> bool {
    pass.bindings.iter().any(|row| row.name == binding && row.access == Access::Params)
}

/// The entry point that a row names, if the row says just what the shader uses. Everything is found by name, so only the
/// sets must agree.
pub fn checked_entry(pass: &Pass, linked: &Linked, features: &Features) -> Result<EntryPoint, GpuError> {
    let fail = |reason: String| Err(GpuError::Mismatch { pass: pass.name, reason });
    let Some(entry) = linked.entry(pass.entry) else {
        return fail(format!("`{}` has no entry point `{}`", pass.module, pass.entry));
    };
    let expected = || pass.bindings.iter().filter(|b| b.is_there(|feature| features.contains(feature)));
    for row in expected() {
        let Some(found) = entry.bindings.iter().find(|b| b.name == row.name) else {
            return fail(format!("the row names `{}`, and `{}` does not use it", row.name, entry.name));
        };
        let kind = match row.access {
            Access::Read | Access::Params => ResourceKind::StorageRead,
            Access::Write => ResourceKind::StorageReadWrite,
        };
        if found.kind != kind || found.ty != row.ty {
            return fail(format!(
                "`{}` is {kind:?} of {} in the row, and {:?} of {} in the shader",
                row.name, row.ty, found.kind, found.ty
            ));
        }
        if found.group != 0 {
            return fail(format!("`{}` is in group {}; passes use group 0", row.name, found.group));
        }
    }
    match entry.bindings.iter().find(|b| expected().all(|row| row.name != b.name)) {
        Some(extra) => fail(format!("`{}` uses `{}`, and the row does not name it", entry.name, extra.name)),
        None => Ok(entry),
    }
}

fn compile(
    gpu: &Gpu,
    pass: &'static Pass,
    linked: Linked,
    features: &Features,
    serial: u64,
) -> Result<Pipeline, GpuError> {
    let entry = checked_entry(pass, &linked, features)?;
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
    let Linked { module, .. } = linked;
    gpu.guarded(&format!("pipeline `{}`", pass.name), || {
        let descriptor = wgpu::ShaderModuleDescriptor {
            label: Some(pass.module),
            source: wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(module)),
        };
        let mut checks = wgpu::ShaderRuntimeChecks::checked();
        checks.force_loop_bounding = false;
        // SAFETY: every loop of the shipped shaders has a bound of its own (naga's would cost 11 % and counts to 2^64).
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
            cache: None,
        });
        Pipeline { compute, layout, entry, serial }
    })
}
