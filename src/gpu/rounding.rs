//! How a device rounds WGSL's `fma()`: once, or the product and then the sum. The language leaves that open, and no limit or feature tells.

use std::sync::mpsc::channel;

use super::GpuError;

/// The feature of code that makes products exact from halves, where no fused instruction does.
pub const HALVES: &str = "halves";

const LABEL: Option<&str> = Some("rounding");

/// Bytes of the numbers that the kernel reads, the first of which it replaces.
const BYTES: u64 = 12;

/// Asks the device, in one dispatch: whether 1 + 2^-12 squared, less what that rounds to, is 0.
pub(super) fn rounds_twice(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<bool, GpuError> {
    let failed = |reason: String| GpuError::Validation { what: "asking how the device rounds".to_owned(), reason };
    let filters = [wgpu::ErrorFilter::OutOfMemory, wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::Internal];
    let scopes = filters.map(|filter| device.push_error_scope(filter));
    let answer = submit(device, queue);
    for scope in scopes.into_iter().rev() {
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(failed(error.to_string()));
        }
    }
    let (sender, receiver) = channel();
    answer.map_async(wgpu::MapMode::Read, .., move |result| {
        let _ = sender.send(result);
    });
    device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| GpuError::Lost { reason: error.to_string() })?;
    receiver.recv().map_err(|error| failed(error.to_string()))?.map_err(|error| failed(error.to_string()))?;
    let bytes = answer.get_mapped_range(..).map_err(|error| failed(error.to_string()))?;
    Ok(bytes.iter().all(|byte| *byte == 0))
}

/// Runs the kernel, and has what it leaves copied to where it can be read.
fn submit(device: &wgpu::Device, queue: &wgpu::Queue) -> wgpu::Buffer {
    let buffer = |size, usage| {
        device.create_buffer(&wgpu::BufferDescriptor { label: LABEL, size, usage, mapped_at_creation: false })
    };
    let usages = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
    let words = buffer(BYTES, usages);
    let answer = buffer(4, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
    let step = 2f32.powi(-12);
    queue.write_buffer(&words, 0, bytemuck::cast_slice(&[1.0 + step, 1.0 + step, -1.0 - 2.0 * step]));
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: LABEL,
        source: wgpu::ShaderSource::Wgsl(include_str!("rounding.wgsl").into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: LABEL,
        layout: None,
        module: &module,
        entry_point: None,
        compilation_options: Default::default(),
        cache: None,
    });
    let bound = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: LABEL,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: words.as_entire_binding() }],
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &bound, &[]);
    pass.dispatch_workgroups(1, 1, 1);
    drop(pass);
    encoder.copy_buffer_to_buffer(&words, 0, &answer, 0, 4);
    queue.submit([encoder.finish()]);
    answer
}
