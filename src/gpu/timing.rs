//! Time a pass took on the GPU, from timestamps around every dispatch.

use std::collections::BTreeMap;

use super::{Gpu, GpuError};

/// GPU time of one pass, summed over its dispatches.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTiming {
    pub name: &'static str,
    pub count: u64,
    pub milliseconds: f64,
}

/// Timestamps of submissions whose times were not read yet.
#[derive(Default)]
pub struct Timer {
    open: Option<Batch>,
    closed: Vec<Batch>,
    totals: BTreeMap<&'static str, (u64, f64)>,
    /// Milliseconds of each pass in the last submission that it was in.
    last: BTreeMap<&'static str, f64>,
    /// First to last timestamp of each submission since the last look, in milliseconds.
    spans: Vec<f64>,
}

struct Batch {
    names: Vec<&'static str>,
    queries: wgpu::QuerySet,
    next: u32,
    /// Stamps surround each dispatch; else only the whole compute pass.
    each: bool,
    resolved: wgpu::Buffer,
    readable: wgpu::Buffer,
}

/// wgpu's limit on the queries of a set.
const MOST_QUERIES: u32 = 4096;

/// Submissions kept unread before they are read anyway.
const MOST_UNREAD: usize = 64;

impl Timer {
    /// None where the device has no timestamps at all.
    pub fn new(gpu: &Gpu) -> Option<Self> {
        gpu.features.contains(wgpu::Features::TIMESTAMP_QUERY).then(Self::default)
    }

    pub(super) fn begin(&mut self, gpu: &Gpu, names: Vec<&'static str>) {
        let each = gpu.features.contains(wgpu::Features::TIMESTAMP_QUERY_INSIDE_PASSES)
            && names.len() as u32 * 2 <= MOST_QUERIES;
        let count = if each { names.len() as u32 * 2 } else { 2 };
        let size = u64::from(count) * 8;
        let buffer = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("timestamps"),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        self.open = Some(Batch {
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count,
            }),
            next: 0,
            each,
            names,
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            readable: buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST),
        });
    }

    pub(super) fn whole_pass(&self) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let batch = self.open.as_ref().filter(|b| !b.each)?;
        Some(wgpu::ComputePassTimestampWrites {
            query_set: &batch.queries,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        })
    }

    pub(super) fn stamp(&mut self, pass: &mut wgpu::ComputePass) {
        if let Some(batch) = self.open.as_mut().filter(|b| b.each) {
            pass.write_timestamp(&batch.queries, batch.next);
            batch.next += 1;
        }
    }

    pub(super) fn resolve(&mut self, encoder: &mut wgpu::CommandEncoder) {
        if let Some(batch) = self.open.take() {
            let count = if batch.each { batch.next } else { 2 };
            encoder.resolve_query_set(&batch.queries, 0..count, &batch.resolved, 0);
            encoder.copy_buffer_to_buffer(&batch.resolved, 0, &batch.readable, 0, u64::from(count) * 8);
            self.closed.push(batch);
        }
    }

    /// True if so many submissions are unread that they should be read now.
    pub(super) fn is_full(&self) -> bool {
        self.closed.len() >= MOST_UNREAD
    }

    /// Waits for the GPU, and adds up what it stamped.
    pub(super) fn collect(&mut self, gpu: &Gpu) -> Result<(), GpuError> {
        if self.closed.is_empty() {
            return Ok(());
        }
        for batch in &self.closed {
            batch.readable.map_async(wgpu::MapMode::Read, .., |_| ());
        }
        gpu.wait()?;
        let period = f64::from(gpu.queue.get_timestamp_period()) * 1e-6;
        for batch in std::mem::take(&mut self.closed) {
            let failed = |e: String| GpuError::Validation { what: "reading timestamps".to_owned(), reason: e };
            let view = batch.readable.get_mapped_range(..).map_err(|e| failed(e.to_string()))?;
            let stamps: Vec<u64> = view.chunks_exact(8).map(bytemuck::pod_read_unaligned).collect();
            let milliseconds = |from: usize, to: usize| stamps[to].saturating_sub(stamps[from]) as f64 * period;
            if batch.each {
                let mut sums: BTreeMap<&'static str, f64> = BTreeMap::new();
                for (i, name) in batch.names.iter().enumerate() {
                    let spent = milliseconds(2 * i, 2 * i + 1);
                    let total = self.totals.entry(name).or_default();
                    (total.0, total.1) = (total.0 + 1, total.1 + spent);
                    *sums.entry(name).or_default() += spent;
                }
                self.last.extend(sums);
                self.spans.push(milliseconds(0, 2 * batch.names.len() - 1));
            } else {
                for name in &batch.names {
                    self.totals.entry(name).or_default().0 += 1;
                }
                self.totals.entry("whole submissions").or_default().1 += milliseconds(0, 1);
                self.spans.push(milliseconds(0, 1));
            }
        }
        Ok(())
    }

    /// Sums since the last call, by pass name.
    pub(super) fn take(&mut self) -> Vec<PassTiming> {
        let totals = std::mem::take(&mut self.totals);
        totals.into_iter().map(|(name, (count, milliseconds))| PassTiming { name, count, milliseconds }).collect()
    }

    /// Milliseconds of a pass in the last submission that it was in and whose times were read.
    pub(super) fn last(&self, pass: &str) -> Option<f64> {
        self.last.get(pass).copied()
    }

    /// First to last timestamp of each submission since the last call, in milliseconds.
    pub(super) fn take_spans(&mut self) -> Vec<f64> {
        std::mem::take(&mut self.spans)
    }
}
