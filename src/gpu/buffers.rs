//! Buffers by name.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use super::{Gpu, GpuError};
use crate::layout::trace::MaterialRecord;

/// The storage buffers that passes name. A buffer grows when more is asked of it, and then loses what it held.
#[derive(Default)]
pub struct Buffers {
    named: HashMap<&'static str, Slot>,
    /// What the last read came through: making one takes longer than reading by it.
    staging: Mutex<Option<wgpu::Buffer>>,
}

struct Slot {
    buffer: wgpu::Buffer,
    /// Bytes that were asked for.
    bytes: u64,
    /// Bytes that are bound: what was asked for, rounded up.
    size: u64,
    /// Unlike for every buffer ever made under this name: what bind groups are cached by.
    generation: u64,
}

/// WGSL's runtime-sized arrays need room for at least one element; every shared struct but parameters fits.
const SMALLEST: u64 = 128;

/// Bytes of the largest buffer for reading that is kept.
const MOST_STAGED: u64 = 256 << 20;

const _: () = assert!(size_of::<MaterialRecord>() as u64 <= SMALLEST, "the largest element of an array");

impl Buffers {
    /// Makes sure that `name` holds at least `bytes`. Returns true if the buffer is a new one, filled with zeros.
    pub fn reserve(&mut self, gpu: &Gpu, name: &'static str, bytes: u64) -> Result<bool, GpuError> {
        let size = bytes.next_multiple_of(16).max(SMALLEST);
        let limits = &gpu.limits;
        let caps = [(limits.max_storage_buffer_binding_size, "one binding"), (limits.max_buffer_size, "one buffer")];
        for (limit, what) in caps {
            if size > limit {
                return Err(GpuError::TooLarge { name, need: size, limit, adapter: gpu.info.name.clone(), what });
            }
        }
        let old = self.named.get_mut(name);
        let generation = old.as_ref().map_or(0, |slot| slot.generation + 1);
        if let Some(slot) = old
            && slot.buffer.size() >= size
        {
            (slot.bytes, slot.size) = (bytes, size);
            return Ok(false);
        }
        self.named.remove(name);
        let buffer = gpu.guarded_room(name, &format!("buffer `{name}` of {size} bytes"), || {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(name),
                size,
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::INDIRECT
                    | wgpu::BufferUsages::COPY_SRC
                    | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        })?;
        self.named.insert(name, Slot { buffer, bytes, size, generation });
        Ok(true)
    }

    /// Fills `name` from the start, making room first.
    pub fn upload(&mut self, gpu: &Gpu, name: &'static str, bytes: &[u8]) -> Result<(), GpuError> {
        self.reserve(gpu, name, bytes.len() as u64)?;
        self.write(gpu, name, 0, bytes)
    }

    /// Overwrites a part of `name`. `offset` and length are multiples of 4.
    pub fn write(&self, gpu: &Gpu, name: &'static str, offset: u64, bytes: &[u8]) -> Result<(), GpuError> {
        let Some(slot) = self.named.get(name) else {
            return Err(GpuError::NoBuffer { pass: "upload", buffer: name });
        };
        // In pieces, since wgpu stages each write in a buffer of its size, which has a limit of its own.
        const PIECE: usize = 64 << 20;
        for (i, piece) in bytes.chunks(PIECE).enumerate() {
            gpu.queue.write_buffer(&slot.buffer, offset + (i * PIECE) as u64, piece);
            if bytes.len() > PIECE {
                gpu.queue.submit([]);
            }
        }
        Ok(())
    }

    /// Copies all of `from` to `to`, making room first; nothing if there is no `from`.
    pub fn copy(&mut self, gpu: &Gpu, from: &'static str, to: &'static str) -> Result<(), GpuError> {
        let bytes = self.size(from);
        if bytes == 0 {
            return Ok(());
        }
        self.reserve(gpu, to, bytes)?;
        let (source, target) = (&self.named[from].buffer, &self.named[to].buffer);
        gpu.guarded("a copy", || {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            encoder.copy_buffer_to_buffer(source, 0, target, 0, bytes.next_multiple_of(4));
            gpu.queue.submit([encoder.finish()]);
        })
    }

    pub(super) fn get(&self, name: &str) -> Option<(&wgpu::Buffer, u64, u64)> {
        self.named.get(name).map(|slot| (&slot.buffer, slot.size, slot.generation))
    }

    /// Copies `bytes` of `name` back from `offset` on, a multiple of 4, waiting for all that was submitted before; `look` is shown them.
    pub fn read<R>(
        &self,
        gpu: &Gpu,
        name: &'static str,
        (offset, bytes): (u64, u64),
        look: impl FnOnce(&[u8]) -> R,
    ) -> Result<R, GpuError> {
        let Some(slot) = self.named.get(name).filter(|slot| slot.size >= offset.saturating_add(bytes)) else {
            return Err(GpuError::NoBuffer { pass: "readback", buffer: name });
        };
        if bytes == 0 {
            return Ok(look(&[]));
        }
        let size = bytes.next_multiple_of(4);
        let staging = self.staging(gpu, size)?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(&slot.buffer, offset, &staging, 0, size);
        gpu.queue.submit([encoder.finish()]);
        let (sender, receiver) = std::sync::mpsc::channel();
        staging.map_async(wgpu::MapMode::Read, ..size, move |result| {
            let _ = sender.send(result);
        });
        gpu.wait()?;
        let failed = |reason: String| GpuError::Validation { what: format!("reading `{name}` back"), reason };
        receiver.recv().map_err(|e| failed(e.to_string()))?.map_err(|e| failed(e.to_string()))?;
        let view = staging.get_mapped_range(..size).map_err(|e| failed(e.to_string()))?;
        let seen = look(&view[..bytes as usize]);
        drop(view);
        staging.unmap();
        if staging.size() <= MOST_STAGED {
            *self.staging.lock().unwrap_or_else(PoisonError::into_inner) = Some(staging);
        }
        Ok(seen)
    }

    /// A buffer of at least `size` bytes to read by: the last one, if it is large enough.
    fn staging(&self, gpu: &Gpu, size: u64) -> Result<wgpu::Buffer, GpuError> {
        let kept = self.staging.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(kept) = kept.filter(|kept| kept.size() >= size) {
            return Ok(kept);
        }
        gpu.guarded("a readback buffer", || {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("readback"),
                size,
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        })
    }

    /// Bytes that were asked for under `name`; 0 if there is none.
    pub fn size(&self, name: &str) -> u64 {
        self.named.get(name).map_or(0, |slot| slot.bytes)
    }
}
