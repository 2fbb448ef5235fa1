//! All that it takes to run recordings: one device, buffers by name, pipelines, the player and its clock.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::code::{Code, Values};
use super::compiler::Compiler;
use super::pipelines::Pipelines;
use super::player::{PARAMS, Player, Stage};
use super::timing::Timer;
use super::{Buffers, DeviceMemory, Gpu, GpuError, PassTiming};
use crate::parallel;
use crate::passes::{Pass, Recording};
use crate::shader::{ErrorKind, Features, LOOP_FAULTS, Library, Parameter, Probe, ShaderError};

/// Runs recordings on one device.
pub struct Runtime {
    gpu: Arc<Gpu>,
    buffers: Buffers,
    pipelines: Pipelines,
    player: Player,
    features: Features,
    timer: Option<Timer>,
    uploads: BTreeMap<&'static str, u64>,
}

impl Runtime {
    /// No buffers yet, no features but those of how the device rounds, no timing.
    pub fn new(gpu: Arc<Gpu>, library: Library) -> Self {
        Self {
            pipelines: Pipelines::new(gpu.clone(), library),
            features: gpu.rounding_features().iter().map(|f| (*f).to_owned()).collect(),
            gpu,
            buffers: Buffers::default(),
            player: Player::default(),
            timer: None,
            uploads: BTreeMap::new(),
        }
    }

    pub fn gpu(&self) -> &Arc<Gpu> {
        &self.gpu
    }

    /// The code that passes are linked from.
    pub fn library(&self) -> &Library {
        self.pipelines.library()
    }

    /// The features that modules are linked with from now on, beside those of how the device rounds.
    pub fn set_features<S: AsRef<str>>(&mut self, features: &[S]) {
        let rounding = self.gpu.rounding_features().iter().copied();
        self.features = features.iter().map(AsRef::as_ref).chain(rounding).map(str::to_owned).collect();
    }

    /// All parameters that the library declares, by name.
    pub fn parameters(&self) -> &Arc<[Parameter]> {
        self.pipelines.parameters()
    }

    /// All names that the library shows numbers by, in order: the place of one is its number.
    pub fn probes(&self) -> &Arc<[Probe]> {
        self.pipelines.probes()
    }

    /// What parameters are set to.
    pub fn values(&self) -> &Values {
        self.pipelines.values()
    }

    /// Whether any pass in use reads a parameter.
    pub fn is_read(&self, parameter: &str) -> bool {
        self.pipelines.is_read(parameter)
    }

    /// Sets parameters from now on. Returns the passes in use that read another value than before.
    pub fn set_values(&mut self, values: Values) -> Vec<&'static Pass> {
        self.pipelines.set_values(values)
    }

    /// Times every dispatch from now on, where the device can.
    pub fn set_timing(&mut self, on: bool) {
        self.timer = if on { Timer::new(&self.gpu) } else { None };
    }

    /// Makes sure that a buffer holds at least `bytes`; true if it is new and so all zeros.
    pub fn reserve(&mut self, name: &'static str, bytes: u64) -> Result<bool, GpuError> {
        self.let_go(name, bytes);
        self.buffers.reserve(&self.gpu, name, bytes)
    }

    /// Has nothing keep a buffer that is to give way to one that holds `bytes`, so that the device has its memory for that.
    fn let_go(&mut self, name: &'static str, bytes: u64) {
        if self.buffers.replaces(name, bytes) {
            self.player.forget(name);
        }
    }

    /// Drops a buffer, and what keeps its memory; nothing if there is none.
    pub fn release(&mut self, name: &'static str) {
        self.player.forget(name);
        self.buffers.release(name);
    }

    /// Fills a buffer from the start, making room first.
    pub fn upload<T: bytemuck::NoUninit>(&mut self, name: &'static str, items: &[T]) -> Result<(), GpuError> {
        *self.uploads.entry(name).or_default() += size_of_val(items) as u64;
        self.let_go(name, size_of_val(items) as u64);
        self.buffers.upload(&self.gpu, name, bytemuck::cast_slice(items))
    }

    /// Overwrites items of a buffer, the first of them at `index`.
    pub fn write<T: bytemuck::NoUninit>(
        &mut self,
        name: &'static str,
        index: u64,
        items: &[T],
    ) -> Result<(), GpuError> {
        let offset = index * size_of::<T>() as u64;
        *self.uploads.entry(name).or_default() += size_of_val(items) as u64;
        self.buffers.write(&self.gpu, name, offset, bytemuck::cast_slice(items))
    }

    /// Submits a recording.
    pub fn play(&mut self, recording: &Recording) -> Result<(), GpuError> {
        if let Some(timer) = self.timer.as_mut().filter(|t| t.is_full()) {
            timer.collect(&self.gpu)?;
        }
        self.buffers.reserve(&self.gpu, LOOP_FAULTS, 8)?;
        let stage =
            Stage { gpu: &self.gpu, buffers: &self.buffers, pipelines: &mut self.pipelines, features: &self.features };
        let before = self.player.params_sent();
        let played = self.player.play(stage, recording, self.timer.as_mut());
        *self.uploads.entry(PARAMS).or_default() += self.player.params_sent() - before;
        played
    }

    /// Compiles what recordings need, all at once, without running them.
    pub fn prepare(&mut self, recordings: &[&Recording]) -> Result<(), GpuError> {
        self.pipelines.prepare(&passes(recordings), &self.features)
    }

    /// Whether `prepare` would have to compile something.
    pub fn lacks(&self, recordings: &[&Recording]) -> bool {
        self.pipelines.lacks(&passes(recordings), &self.features)
    }

    /// Whether a recording, once prepared, would run the code that this binary was built with, and nobody's edits.
    pub fn runs_shipped(&self, recording: &Recording) -> bool {
        self.pipelines.are_shipped(&passes(&[recording]))
    }

    /// What compiles edited shaders for this runtime, on any thread.
    pub fn compiler(&self) -> Compiler {
        self.pipelines.compiler().clone()
    }

    /// Runs other code from now on. Returns the code that was run until now, and the passes whose code is another.
    pub fn replace(&mut self, code: Code) -> (Code, Vec<&'static Pass>) {
        self.pipelines.replace(code)
    }

    /// Copies a buffer's contents to another, which is made as large; nothing if there is no such buffer.
    pub fn copy(&mut self, from: &'static str, to: &'static str) -> Result<(), GpuError> {
        self.let_go(to, self.buffers.size(from));
        self.buffers.copy(&self.gpu, from, to)
    }

    /// Says whether a loop of an edited shader had to be ended in what was played since the last call.
    pub fn check_loops(&mut self) -> Result<(), GpuError> {
        if !self.pipelines.is_limited() || self.buffers.size(LOOP_FAULTS) == 0 {
            return Ok(());
        }
        let [invocations, number] = self.read_some::<[u32; 2]>(LOOP_FAULTS, 1)?[0];
        if invocations == 0 {
            return Ok(());
        }
        self.write(LOOP_FAULTS, 0, &[0u32; 2])?;
        let Some(place) = self.pipelines.place_of_loop(number) else { return Ok(()) };
        let message = format!("this loop does not end: it was stopped in {invocations} invocations");
        let help = "every loop needs a bound that it reaches within a few thousand rounds";
        let error = ShaderError::of(ErrorKind::Loop, place, message);
        Err(ShaderError { help: Some(help.into()), ..error }.into())
    }

    /// Waits until all that was submitted is done.
    pub fn wait(&self) -> Result<(), GpuError> {
        self.gpu.wait()
    }

    /// The first `count` items of a buffer, after all that was submitted.
    pub fn read_some<T>(&self, name: &'static str, count: usize) -> Result<Vec<T>, GpuError>
    where
        T: bytemuck::AnyBitPattern + Send,
    {
        self.buffers.read(&self.gpu, name, (0, (count * size_of::<T>()) as u64), copied)
    }

    /// What `look` makes of the first `count` items of a buffer, after all that was submitted.
    pub fn look_at<T, R>(&self, name: &'static str, count: usize, look: impl FnOnce(&[T]) -> R) -> Result<R, GpuError>
    where
        T: bytemuck::AnyBitPattern + Send,
    {
        let look = |bytes: &[u8]| match bytemuck::try_cast_slice(bytes) {
            Ok(items) => look(items),
            // What is mapped may begin anywhere.
            Err(_) => look(&copied(bytes)),
        };
        self.buffers.read(&self.gpu, name, (0, (count * size_of::<T>()) as u64), look)
    }

    /// One item of a buffer, after all that was submitted.
    pub fn read_one<T: bytemuck::AnyBitPattern>(&self, name: &'static str, index: u64) -> Result<T, GpuError> {
        let size = size_of::<T>() as u64;
        self.buffers.read(&self.gpu, name, (index * size, size), bytemuck::pod_read_unaligned)
    }

    /// A buffer by its name.
    pub(super) fn buffer(&self, name: &str) -> Option<&wgpu::Buffer> {
        self.buffers.get(name).map(|(buffer, ..)| buffer)
    }

    /// As many whole items as a buffer holds, after all that was submitted.
    pub fn read<T: bytemuck::AnyBitPattern + Send>(&self, name: &'static str) -> Result<Vec<T>, GpuError> {
        self.read_some(name, self.buffers.size(name) as usize / size_of::<T>())
    }

    /// How often each pass was dispatched so far.
    pub fn dispatches(&self) -> &BTreeMap<&'static str, u64> {
        self.player.counts()
    }

    /// Bytes written to each buffer so far; `params` are the parameters of dispatches.
    pub fn uploads(&self) -> &BTreeMap<&'static str, u64> {
        &self.uploads
    }

    /// Bind groups that are kept for recordings to come.
    pub fn bind_groups(&self) -> usize {
        self.player.bind_groups()
    }

    /// What is held on the device.
    pub fn memory(&self) -> DeviceMemory {
        DeviceMemory { held: self.buffers.held(), buffers: self.buffers.sizes() }
    }

    /// GPU time by pass since the last call; empty without timing.
    pub fn timings(&mut self) -> Result<Vec<PassTiming>, GpuError> {
        let Some(timer) = &mut self.timer else { return Ok(Vec::new()) };
        timer.collect(&self.gpu)?;
        Ok(timer.take())
    }

    /// Milliseconds of a pass in the last recording that it was in; none where that was not timed, or not read yet.
    pub fn last_milliseconds(&self, pass: &str) -> Option<f64> {
        self.timer.as_ref().and_then(|timer| timer.last(pass))
    }

    /// First to last timestamp of each submission since the last call, milliseconds; empty without timing.
    pub fn spans(&mut self) -> Result<Vec<f64>, GpuError> {
        let Some(timer) = &mut self.timer else { return Ok(Vec::new()) };
        timer.collect(&self.gpu)?;
        Ok(timer.take_spans())
    }
}

/// Items that a thread copies at once.
const PIECE: usize = 1 << 16;

/// Whole items of some bytes, which may begin anywhere.
fn copied<T: bytemuck::AnyBitPattern + Send>(bytes: &[u8]) -> Vec<T> {
    let size = size_of::<T>();
    let mut items: Vec<T> = bytemuck::zeroed_vec(bytes.len() / size);
    parallel::fill(&mut items, PIECE, |first, piece| {
        let from = bytes[first * size..].chunks_exact(size);
        piece.iter_mut().zip(from).for_each(|(item, bytes)| *item = bytemuck::pod_read_unaligned(bytes));
    });
    items
}

/// The passes of recordings, by call.
fn passes(recordings: &[&Recording]) -> Vec<&'static Pass> {
    recordings.iter().flat_map(|recording| recording.calls()).map(|call| call.pass).collect()
}
