//! Draws the picture to a window, over the last one that was whole.

use glam::{UVec2, Vec2};

use super::{Gpu, GpuError, Runtime};
use crate::layout::window::WindowParams;
use crate::shader::{Features, Library, on_large_stack};

/// The module that draws it.
const MODULE: &str = "window/picture";

/// What of the `picture` buffer there is to show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shown {
    /// Pixels.
    pub size: UVec2,
    /// Rows from the top that show the film as it is; all of them once it has a whole sample.
    pub rows: u32,
}

/// How a picture of another shape than the window lies on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// Over all of the window.
    Fill,
    /// As large as it gets, in its own shape, with black beside it.
    Letterbox,
}

impl Fit {
    /// Where a picture lies: top left corner and size, in window pixels.
    pub fn place(self, picture: UVec2, window: UVec2) -> (Vec2, Vec2) {
        let (picture, window) = (picture.max(UVec2::ONE).as_vec2(), window.as_vec2());
        let extent = match self {
            Fit::Fill => window,
            Fit::Letterbox => picture * (window / picture).min_element(),
        };
        (0.5 * (window - extent), extent)
    }
}

/// The pipeline, and a copy of the last picture that was whole: a film that starts anew has no picture for a while.
pub(super) struct PictureDrawing {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    params: wgpu::Buffer,
    last: wgpu::Buffer,
    last_size: UVec2,
}

impl PictureDrawing {
    pub fn new(gpu: &Gpu, library: &Library, format: wgpu::TextureFormat) -> Result<Self, GpuError> {
        let module = library.link(MODULE, &Features::new())?.module;
        let make = || {
            let storage = |binding| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage { read_only: true },
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            };
            let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(MODULE),
                entries: &[0, 1, 2].map(storage),
            });
            Self {
                pipeline: pipeline(gpu, module, &layout, format),
                layout,
                params: buffer(gpu, "window parameters", size_of::<WindowParams>() as u64),
                last: buffer(gpu, "last picture", 4),
                last_size: UVec2::ZERO,
            }
        };
        on_large_stack(|| gpu.guarded("the pipeline that draws the picture", make))
    }

    /// Says what is drawn next, and where.
    pub fn bind(&self, gpu: &Gpu, runtime: &Runtime, shown: Shown, (origin, extent): (Vec2, Vec2)) -> wgpu::BindGroup {
        let picture = runtime.buffer("picture");
        let rows = if picture.is_some() { shown.rows } else { 0 };
        let params = WindowParams { origin, extent, size: shown.size, last_size: self.last_size, rows, pad: 0 };
        gpu.queue.write_buffer(&self.params, 0, bytemuck::bytes_of(&params));
        let buffers = [&self.params, picture.unwrap_or(&self.last), &self.last];
        let entry = |binding: usize| wgpu::BindGroupEntry {
            binding: binding as u32,
            resource: buffers[binding].as_entire_binding(),
        };
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(MODULE),
            layout: &self.layout,
            entries: &[0, 1, 2].map(entry),
        })
    }

    pub fn draw(&self, pass: &mut wgpu::RenderPass, bound: &wgpu::BindGroup) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, bound, &[]);
        pass.draw(0..3, 0..1);
    }

    /// Keeps a picture that is whole.
    pub fn keep(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, runtime: &Runtime, shown: Shown) {
        let bytes = u64::from(shown.size.x) * u64::from(shown.size.y) * 4;
        let Some(picture) = runtime.buffer("picture").filter(|picture| bytes > 0 && picture.size() >= bytes) else {
            return;
        };
        if shown.rows < shown.size.y {
            return;
        }
        if self.last.size() < bytes {
            self.last = buffer(gpu, "last picture", bytes);
        }
        encoder.copy_buffer_to_buffer(picture, 0, &self.last, 0, bytes);
        self.last_size = shown.size;
    }
}

fn buffer(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn pipeline(
    gpu: &Gpu,
    module: naga::Module,
    layout: &wgpu::BindGroupLayout,
    format: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(MODULE),
        source: wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(module)),
    });
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(MODULE),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(MODULE),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("corner"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("colour"),
            compilation_options: Default::default(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
