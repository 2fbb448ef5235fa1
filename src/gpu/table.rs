//! A GPU array with its contents on the CPU: rows that changed are sent, and all of them where the device has lost them.

use std::ops::Range;

use bevy_ecs::prelude::*;
use bytemuck::Pod;

use super::{GpuError, Runtime};

/// A type whose rows make one array on the device.
pub trait TableRow: Pod + Send + Sync + 'static {
    /// Name of the buffer, as passes bind it.
    const BUFFER: &'static str;
}

/// An array of rows, and which of them the device does not have yet.
///
/// It counts as changed, for systems that poll, when contents are written; sending them is no change.
#[derive(Resource)]
pub struct GpuTable<T: TableRow> {
    rows: Vec<T>,
    /// Rows to be sent, in order of writing.
    stale: Vec<Range<usize>>,
    /// Length that the buffer was last made for.
    reserved: usize,
}

impl<T: TableRow> Default for GpuTable<T> {
    fn default() -> Self {
        Self { rows: Vec::new(), stale: Vec::new(), reserved: 0 }
    }
}

impl<T: TableRow> GpuTable<T> {
    pub fn rows(&self) -> &[T] {
        &self.rows
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Whether these are the contents, bit by bit.
    pub fn holds(&self, rows: &[T]) -> bool {
        bytemuck::cast_slice::<T, u8>(&self.rows) == bytemuck::cast_slice::<T, u8>(rows)
    }

    /// Makes these the contents: rows of other bits are to be sent, all of them where their number is another.
    pub fn set(&mut self, rows: Vec<T>) {
        if rows.len() != self.rows.len() {
            self.rows = rows;
            self.send_all();
            return;
        }
        for (index, (old, new)) in self.rows.iter().zip(&rows).enumerate() {
            if bytemuck::bytes_of(old) != bytemuck::bytes_of(new) {
                match self.stale.last_mut().filter(|run| run.end == index) {
                    Some(run) => run.end += 1,
                    None => self.stale.push(index..index + 1),
                }
            }
        }
        self.rows = rows;
    }

    /// Cuts the contents to so many rows, or adds rows of zeros.
    pub fn resize(&mut self, len: usize) {
        self.rows.resize(len, T::zeroed());
        self.stale.retain_mut(|run| {
            run.end = run.end.min(len);
            run.start < run.end
        });
    }

    /// Overwrites rows from `first` on. They are within the length.
    pub fn write(&mut self, first: usize, rows: impl IntoIterator<Item = T>) {
        let mut end = first;
        for row in rows {
            self.rows[end] = row;
            end += 1;
        }
        if end > first {
            self.stale.push(first..end);
        }
    }

    /// Has all rows sent again: the device may not have them.
    pub fn send_all(&mut self) {
        self.stale.clear();
        self.stale.push(0..self.rows.len());
    }

    /// Whether there is something to send.
    pub fn is_stale(&self) -> bool {
        !self.stale.is_empty() || self.reserved != self.rows.len()
    }

    /// Sends what is stale; all rows where the buffer had to grow, and so lost what it held. An empty table has no buffer.
    pub fn upload(&mut self, device: &mut Runtime) -> Result<(), GpuError> {
        if !self.rows.is_empty() {
            if device.reserve(T::BUFFER, size_of_val(self.rows.as_slice()) as u64)? {
                self.send_all();
            }
            for run in &self.stale {
                device.write(T::BUFFER, run.start as u64, &self.rows[run.clone()])?;
            }
        }
        self.stale.clear();
        self.reserved = self.rows.len();
        Ok(())
    }
}
