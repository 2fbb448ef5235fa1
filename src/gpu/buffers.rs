//! Buffers by name.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use super::{Gpu, GpuError, Held};
use crate::layout::trace::MaterialRecord;

/// The storage buffers that passes name. A buffer grows when more is asked of it, and then loses what it held.
#[derive(Default)]
pub struct Buffers {
    named: HashMap<&'static str, Slot>,
    /// What the last read came through: making one takes longer than reading by it.
    staging: Mutex<Option<wgpu::Buffer>>,
    held: Mutex<Held>,
    /// Buffers that were ever made.
    made: u64,
}

struct Slot {
    buffer: wgpu::Buffer,
    /// Bytes that were asked for.
    bytes: u64,
    /// Bytes that are bound: what was asked for, rounded up.
    size: u64,
    /// Unlike for every buffer ever made: what bind groups are cached by.
    generation: u64,
}

/// What a buffer that is read by is called where bytes are told.
const STAGING: &str = "readback";

/// WGSL's runtime-sized arrays need room for at least one element; every shared struct but parameters fits.
const SMALLEST: u64 = 128;

/// Bytes of the largest buffer for reading that is kept.
const MOST_STAGED: u64 = 256 << 20;

const _: () = assert!(size_of::<MaterialRecord>() as u64 <= SMALLEST, "the largest element of an array");

impl Buffers {
    /// Whether there is a buffer `name` that gives way to another one where it is to hold `bytes`.
    pub(super) fn replaces(&self, name: &str, bytes: u64) -> bool {
        self.named.get(name).is_some_and(|slot| slot.buffer.size() < rounded(bytes))
    }

    /// Drops the buffer `name`, if there is one.
    pub(super) fn release(&mut self, name: &str) {
        if let Some(old) = self.named.remove(name) {
            self.hold(|held| held.take(old.buffer.size()));
        }
    }

    /// Makes sure that `name` holds at least `bytes`. Returns true if the buffer is a new one, filled with zeros.
    pub fn reserve(&mut self, gpu: &Gpu, name: &'static str, bytes: u64) -> Result<bool, GpuError> {
        let size = rounded(bytes);
        gpu.check_size(name, size)?;
        if let Some(slot) = self.named.get_mut(name)
            && slot.buffer.size() >= size
        {
            (slot.bytes, slot.size) = (bytes, size);
            return Ok(false);
        }
        self.release(name);
        let others = self.held().now;
        let what = format!("buffer `{name}` of {size} bytes, beside {others} bytes in other buffers");
        let buffer = gpu.guarded_room(name, &what, || {
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
        self.named.insert(name, Slot { buffer, bytes, size, generation: self.made });
        self.made += 1;
        self.hold(|held| held.add(size));
        Ok(true)
    }

    /// Bytes of all buffers, that which is read by among them.
    pub fn held(&self) -> Held {
        *self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn hold(&self, change: impl FnOnce(&mut Held)) {
        change(&mut self.held.lock().unwrap_or_else(PoisonError::into_inner));
    }

    /// The buffers that there are, by name, with their bytes; the largest first.
    pub fn sizes(&self) -> Vec<(&'static str, u64)> {
        let kept = self.staging.lock().unwrap_or_else(PoisonError::into_inner).as_ref().map(wgpu::Buffer::size);
        let named = self.named.iter().map(|(name, slot)| (*name, slot.buffer.size()));
        let mut sizes: Vec<_> = named.chain(kept.map(|bytes| (STAGING, bytes))).collect();
        sizes.sort_by_key(|(name, bytes)| (std::cmp::Reverse(*bytes), *name));
        sizes
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
        if staging.size() > MOST_STAGED {
            self.hold(|held| held.take(staging.size()));
        } else {
            *self.staging.lock().unwrap_or_else(PoisonError::into_inner) = Some(staging);
        }
        Ok(seen)
    }

    /// A buffer of at least `size` bytes to read by: the last one, if it is large enough.
    fn staging(&self, gpu: &Gpu, size: u64) -> Result<wgpu::Buffer, GpuError> {
        let kept = self.staging.lock().unwrap_or_else(PoisonError::into_inner).take();
        match kept {
            Some(kept) if kept.size() >= size => return Ok(kept),
            Some(small) => self.hold(|held| held.take(small.size())),
            None => {}
        }
        let staging = gpu.guarded("a readback buffer", || {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(STAGING),
                size,
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        })?;
        self.hold(|held| held.add(size));
        Ok(staging)
    }

    /// Bytes that were asked for under `name`; 0 if there is none.
    pub fn size(&self, name: &str) -> u64 {
        self.named.get(name).map_or(0, |slot| slot.bytes)
    }
}

/// Bytes of a buffer that is to hold so many.
fn rounded(bytes: u64) -> u64 {
    bytes.next_multiple_of(16).max(SMALLEST)
}
