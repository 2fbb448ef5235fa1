//! Finding an adapter and opening it with all that it offers.

use std::sync::{Arc, Mutex};

use super::pipeline_cache::PipelineCache;
use super::rounding::{HALVES, rounds_twice};
use super::{GpuError, room};
use crate::shader::BALLOTS;

/// The environment variable that picks an adapter by its number in `lucerna doctor`.
const ADAPTER_VARIABLE: &str = "LUCERNA_ADAPTER";

/// The environment variable that has a device be taken for one with smaller buffers.
const BUFFER_VARIABLE: &str = "LUCERNA_MOST_BUFFER";

/// Bytes of a buffer that the variable can ask for at least: each fixed array fits.
const LEAST_BUFFER: u64 = 64 << 10;

/// Features that are used where they are there; each has a fallback.
fn wanted_features() -> wgpu::Features {
    wgpu::Features::SUBGROUP
        | wgpu::Features::PIPELINE_CACHE
        | wgpu::Features::TIMESTAMP_QUERY
        | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS
        | wgpu::Features::TIMESTAMP_QUERY_INSIDE_PASSES
}

/// An open device and its queue.
pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub info: wgpu::AdapterInfo,
    pub limits: wgpu::Limits,
    pub features: wgpu::Features,
    /// What was compiled in earlier starts.
    pub(super) pipeline_cache: Option<PipelineCache>,
    lost: Arc<Mutex<Option<String>>>,
    /// It rounds the product of `fma()`, and then the sum.
    rounds_twice: bool,
}

/// What `lucerna doctor` says of an adapter.
#[derive(Clone, Debug)]
pub struct AdapterSummary {
    pub name: String,
    pub backend: String,
    pub kind: String,
    pub driver: String,
    /// Largest buffer in bytes.
    pub max_buffer: u64,
    /// Largest part of a buffer one binding sees, in bytes.
    pub max_binding: u64,
    pub max_workgroup_memory: u32,
    pub max_workgroup_size: u32,
    /// Each pass can be timed by itself.
    pub timestamps: bool,
    /// What would be opened by default.
    pub chosen: bool,
}

pub(super) fn instance() -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
    descriptor.backends &= wgpu::Backends::PRIMARY;
    // Indirect counts come from our own passes, and are small by construction: wgpu's check would cost a dispatch each.
    descriptor.flags.remove(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL);
    wgpu::Instance::new(descriptor)
}

/// All adapters, discrete GPUs first, in a stable order.
fn ordered_adapters(instance: &wgpu::Instance) -> Vec<wgpu::Adapter> {
    let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    adapters.retain(|a| a.get_downlevel_capabilities().flags.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS));
    adapters.sort_by_key(|adapter| {
        let info = adapter.get_info();
        let rank = match info.device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Other => 3,
            wgpu::DeviceType::Cpu => 4,
        };
        (rank, info.device_pci_bus_id, info.name)
    });
    adapters
}

/// What the environment asks for, if it does: a variable that is empty, or blank, asks for nothing.
fn asked_adapter() -> Option<String> {
    let text = std::env::var_os(ADAPTER_VARIABLE)?.to_string_lossy().trim().to_owned();
    (!text.is_empty()).then_some(text)
}

/// The number of the adapter to open: the first, or the one the environment asks for.
fn chosen_index(adapters: &[wgpu::Adapter]) -> Result<usize, GpuError> {
    if adapters.is_empty() {
        return Err(GpuError::NoAdapter);
    }
    let Some(asked) = asked_adapter() else { return Ok(0) };
    let number = asked.parse().ok().filter(|number| *number < adapters.len());
    number.ok_or_else(|| {
        let name = |(number, adapter): (usize, &wgpu::Adapter)| {
            let info = adapter.get_info();
            format!("{number}: {} ({})", info.name, info.backend)
        };
        let known = adapters.iter().enumerate().map(name).collect::<Vec<_>>().join(", ");
        GpuError::NoSuchAdapter { variable: ADAPTER_VARIABLE, asked, known }
    })
}

/// Bytes that a buffer may have at most, where the environment says so.
fn asked_buffer() -> Result<Option<u64>, GpuError> {
    let Some(text) = std::env::var_os(BUFFER_VARIABLE) else { return Ok(None) };
    let asked = text.to_string_lossy().trim().to_owned();
    match asked.parse() {
        _ if asked.is_empty() => Ok(None),
        Ok(bytes) if bytes >= LEAST_BUFFER => Ok(Some(bytes)),
        _ => Err(GpuError::NoSuchBuffer { variable: BUFFER_VARIABLE, asked, least: LEAST_BUFFER }),
    }
}

/// What an adapter has, with buffers of so many bytes at most.
fn limits_of(adapter: &wgpu::Adapter, most: Option<u64>) -> wgpu::Limits {
    let mut limits = adapter.limits();
    if let Some(most) = most {
        // WGSL's arrays are bound in whole vectors.
        let most = most / 16 * 16;
        limits.max_buffer_size = limits.max_buffer_size.min(most);
        limits.max_storage_buffer_binding_size = limits.max_storage_buffer_binding_size.min(most);
        limits.max_uniform_buffer_binding_size = limits.max_uniform_buffer_binding_size.min(most);
    }
    limits
}

/// Lists the adapters, in the order of their numbers.
pub fn adapters() -> Vec<AdapterSummary> {
    let adapters = ordered_adapters(&instance());
    let chosen = chosen_index(&adapters).ok();
    let most = asked_buffer().ok().flatten();
    let summary = |(i, adapter): (usize, &wgpu::Adapter)| {
        let (info, limits) = (adapter.get_info(), limits_of(adapter, most));
        AdapterSummary {
            name: info.name,
            backend: info.backend.to_string(),
            kind: format!("{:?}", info.device_type),
            driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
            max_buffer: limits.max_buffer_size,
            max_binding: limits.max_storage_buffer_binding_size,
            max_workgroup_memory: limits.max_compute_workgroup_storage_size,
            max_workgroup_size: limits.max_compute_invocations_per_workgroup,
            timestamps: adapter.features().contains(wgpu::Features::TIMESTAMP_QUERY_INSIDE_PASSES),
            chosen: chosen == Some(i),
        }
    };
    adapters.iter().enumerate().map(summary).collect()
}

impl Gpu {
    /// Bytes of the largest array that a kernel can read.
    pub fn most_bytes(&self) -> u64 {
        self.limits.max_storage_buffer_binding_size.min(self.limits.max_buffer_size)
    }

    /// Refuses what a kernel could not read as one array of so many bytes.
    pub fn check_size(&self, name: &'static str, bytes: u64) -> Result<(), GpuError> {
        let limits =
            [(self.limits.max_storage_buffer_binding_size, "one binding"), (self.limits.max_buffer_size, "one buffer")];
        match limits.into_iter().find(|(limit, _)| bytes > *limit) {
            None => Ok(()),
            Some((limit, what)) => {
                Err(GpuError::TooLarge { name, need: bytes, limit, adapter: self.info.name.clone(), what })
            }
        }
    }

    /// Opens the best adapter, or the one `LUCERNA_ADAPTER` names, with its own limits.
    pub fn open() -> Result<Arc<Gpu>, GpuError> {
        let mut adapters = ordered_adapters(&instance());
        let adapter = adapters.swap_remove(chosen_index(&adapters)?);
        Self::open_adapter(&adapter, wanted_features())
    }

    /// Opens the adapter of a number, as [`adapters`] lists them, with its own limits.
    pub fn open_number(number: usize) -> Result<Arc<Gpu>, GpuError> {
        let adapters = ordered_adapters(&instance());
        let adapter = adapters.get(number).ok_or(GpuError::NoAdapter)?;
        Self::open_adapter(adapter, wanted_features())
    }

    /// Opens the best adapter that can present to a surface, or the one `LUCERNA_ADAPTER` names, with its own limits.
    pub(super) fn open_for(
        instance: &wgpu::Instance,
        surface: &wgpu::Surface,
    ) -> Result<(Arc<Gpu>, wgpu::Adapter), GpuError> {
        let mut adapters = ordered_adapters(instance);
        let mut index = chosen_index(&adapters)?;
        if !adapters[index].is_surface_supported(surface) {
            if asked_adapter().is_some() {
                return Err(GpuError::CannotPresent { adapter: adapters[index].get_info().name });
            }
            let presenter = adapters.iter().position(|adapter| adapter.is_surface_supported(surface));
            index = presenter.ok_or(GpuError::NoPresenter)?;
        }
        let adapter = adapters.swap_remove(index);
        Ok((Self::open_adapter(&adapter, wanted_features())?, adapter))
    }

    /// Opens the same adapter without any optional feature: what the fallbacks are tested on.
    pub fn open_plain() -> Result<Arc<Gpu>, GpuError> {
        let mut adapters = ordered_adapters(&instance());
        let adapter = adapters.swap_remove(chosen_index(&adapters)?);
        Self::open_adapter(&adapter, wgpu::Features::empty())
    }

    fn open_adapter(adapter: &wgpu::Adapter, wanted: wgpu::Features) -> Result<Arc<Gpu>, GpuError> {
        let info = adapter.get_info();
        let features = adapter.features() & wanted;
        let limits = limits_of(adapter, asked_buffer()?);
        let request = adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("lucerna"),
            required_features: features,
            required_limits: limits.clone(),
            memory_hints: wgpu::MemoryHints::Performance,
            ..Default::default()
        });
        let (device, queue) = pollster::block_on(request)
            .map_err(|e| GpuError::Device { adapter: info.name.clone(), reason: e.to_string() })?;
        let lost = Arc::new(Mutex::new(None));
        let reason = lost.clone();
        device.set_device_lost_callback(move |kind, message| {
            if kind != wgpu::DeviceLostReason::Destroyed {
                *reason.lock().unwrap_or_else(std::sync::PoisonError::into_inner) = Some(message);
            }
        });
        let pipeline_cache = PipelineCache::of(&info, features);
        let rounds_twice = rounds_twice(&device, &queue)?;
        Ok(Arc::new(Gpu { device, queue, info, limits, features, pipeline_cache, lost, rounds_twice }))
    }

    /// Adapter and driver in one line.
    pub fn name(&self) -> String {
        format!("{} ({}, {})", self.info.name, self.info.backend, self.info.driver_info)
    }

    /// True for adapters that are the processor in disguise.
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// Whether the process may end while the device is open. NVIDIA's driver has compiled shaders in its cache by the time they run, and takes
    /// a tenth of a second to close. Mesa's writes its cache in a thread that is waited for where devices are closed in order.
    pub fn may_be_left_open(&self) -> bool {
        self.info.driver == "NVIDIA"
    }

    /// The folder that keeps what the driver compiles, where one does.
    pub fn kept_pipelines(&self) -> Option<&std::path::Path> {
        self.pipeline_cache.as_ref().map(PipelineCache::folder)
    }

    /// Whether `fma()` rounds the product before the sum, as lavapipe's does.
    pub fn rounds_twice(&self) -> bool {
        self.rounds_twice
    }

    /// What all code is to know of how the device rounds, as features that it is linked with.
    pub(super) fn rounding_features(&self) -> &'static [&'static str] {
        if self.rounds_twice { &[HALVES] } else { &[] }
    }

    /// What shaders may know of the device, as features that they are linked with.
    pub fn shader_features(&self) -> &'static [&'static str] {
        match (self.is_software(), self.has_ballots()) {
            (false, false) => &[],
            (false, true) => &[BALLOTS],
            (true, false) => &["software"],
            (true, true) => &["software", BALLOTS],
        }
    }

    /// Whether subgroups have operations, and 32 threads whatever the driver chooses.
    fn has_ballots(&self) -> bool {
        let sizes = [self.info.subgroup_min_size, self.info.subgroup_max_size];
        self.features.contains(wgpu::Features::SUBGROUP) && sizes == [32, 32]
    }

    /// Waits until all that was submitted is done.
    pub fn wait(&self) -> Result<(), GpuError> {
        let polled = self.device.poll(wgpu::PollType::wait_indefinitely());
        self.check_lost()?;
        polled.map(|_| ()).map_err(|e| GpuError::Lost { reason: e.to_string() })
    }

    /// Says whether the device was lost since it was opened.
    pub fn check_lost(&self) -> Result<(), GpuError> {
        match &*self.lost.lock().unwrap_or_else(std::sync::PoisonError::into_inner) {
            Some(reason) => Err(GpuError::Lost { reason: reason.clone() }),
            None => Ok(()),
        }
    }

    /// Runs `work` so that any error wgpu raises in it comes back as a value.
    pub fn guarded<T>(&self, what: &str, work: impl FnOnce() -> T) -> Result<T, GpuError> {
        self.guarded_room("", what, work)
    }

    /// The same of work that makes room for a buffer of a name: without memory, the error says what makes that one smaller.
    pub fn guarded_room<T>(&self, buffer: &str, what: &str, work: impl FnOnce() -> T) -> Result<T, GpuError> {
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
        let value = work();
        for scope in [internal, validation] {
            if let Some(error) = pollster::block_on(scope.pop()) {
                return Err(GpuError::Validation { what: what.to_owned(), reason: error.to_string() });
            }
        }
        match pollster::block_on(memory.pop()) {
            Some(_) => Err(GpuError::OutOfMemory { what: what.to_owned(), smaller: room::smaller(buffer) }),
            None => Ok(value),
        }
    }
}
