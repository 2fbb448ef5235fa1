//! Draws the picture to a window, or the last one while there is none.

use glam::{IVec2, UVec2, Vec2};

use super::{Gpu, GpuError, Runtime};
use crate::layout::window::WindowParams;
use crate::shader::{Features, Library, on_large_stack};

/// The module that draws it.
const MODULE: &str = "window/picture";

/// How a picture of another shape than its area of the window lies on that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// Over all of the area.
    Fill,
    /// As large as it gets, in its own shape, with black beside it.
    Letterbox,
    /// Each pixel as a square of so many window pixels a side, the picture's top left at `origin`.
    Pixels { scale: u32, origin: IVec2 },
}

impl Fit {
    /// Where a picture lies on an area of so many pixels: top left corner and size, in window pixels.
    pub fn place(self, picture: UVec2, area: UVec2) -> (Vec2, Vec2) {
        let (picture, area) = (picture.max(UVec2::ONE).as_vec2(), area.as_vec2());
        let extent = match self {
            Fit::Fill => area,
            Fit::Letterbox => picture * (area / picture).min_element(),
            Fit::Pixels { scale, origin } => return (origin.as_vec2(), picture * scale as f32),
        };
        (0.5 * (area - extent), extent)
    }
}

/// How the picture lies on the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    pub fit: Fit,
    /// The pixels that it has, from the window's top left.
    pub area: UVec2,
}

/// The pipeline, and a copy of the last picture: a film has none from when it starts anew until a step succeeds.
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
                entries: &[0, 1].map(storage),
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

    /// Says what is drawn next: the `picture` buffer, if it holds a picture, of the size `shown`; else the
    /// last one, in its own shape.
    pub fn bind(&self, gpu: &Gpu, runtime: &Runtime, shown: Option<UVec2>, placement: Placement) -> wgpu::BindGroup {
        let Placement { fit, area } = placement;
        let picture = shown.and_then(|size| Some((runtime.buffer("picture")?, size, fit)));
        let (picture, size, fit) = picture.unwrap_or((&self.last, self.last_size, Fit::Letterbox));
        let (origin, extent) = fit.place(size, area);
        let params = WindowParams { origin, extent, size };
        gpu.queue.write_buffer(&self.params, 0, bytemuck::bytes_of(&params));
        let buffers = [&self.params, picture];
        let entry = |binding: usize| wgpu::BindGroupEntry {
            binding: binding as u32,
            resource: buffers[binding].as_entire_binding(),
        };
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(MODULE),
            layout: &self.layout,
            entries: &[0, 1].map(entry),
        })
    }

    pub fn draw(&self, pass: &mut wgpu::RenderPass, bound: &wgpu::BindGroup) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, bound, &[]);
        pass.draw(0..3, 0..1);
    }

    /// Keeps a picture, if there is one.
    pub fn keep(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, runtime: &Runtime, shown: Option<UVec2>) {
        let size = shown.unwrap_or(UVec2::ZERO);
        let bytes = u64::from(size.x) * u64::from(size.y) * 4;
        let Some(picture) = runtime.buffer("picture").filter(|picture| bytes > 0 && picture.size() >= bytes) else {
            return;
        };
        if self.last.size() < bytes {
            self.last = buffer(gpu, "last picture", bytes);
        }
        encoder.copy_buffer_to_buffer(picture, 0, &self.last, 0, bytes);
        self.last_size = size;
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
