//! A window's surface: the picture, and the user interface over it.

use std::sync::Arc;

use glam::UVec2;

use super::picture::PictureDrawing;
use super::{Gpu, GpuError, Placement, Runtime, device};
use crate::shader::Library;

/// A window to draw on, of any window library.
pub type Target = Arc<dyn wgpu::DisplayAndWindowHandle>;

/// What egui wants drawn over the picture.
#[derive(Default)]
pub struct Paint {
    pub primitives: Vec<egui::ClippedPrimitive>,
    pub textures: egui::TexturesDelta,
    pub pixels_per_point: f32,
}

/// Whether a frame reached the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawn {
    Yes,
    /// The window was not ready for it: draw again a little later.
    Later,
}

/// What is drawn on, and with what.
pub struct Surface {
    gpu: Arc<Gpu>,
    instance: wgpu::Instance,
    target: Target,
    surface: wgpu::Surface<'static>,
    configuration: wgpu::SurfaceConfiguration,
    picture: PictureDrawing,
    ui: egui_wgpu::Renderer,
}

impl Surface {
    /// Opens the best adapter that can present to a window, or the one `LUCERNA_ADAPTER` names, and makes the window ready
    /// to be drawn on. `size` in pixels.
    pub fn open(target: Target, size: UVec2, library: &Library) -> Result<(Arc<Gpu>, Surface), GpuError> {
        let instance = device::instance();
        let surface = create(&instance, &target)?;
        let (gpu, adapter) = Gpu::open_for(&instance, &surface)?;
        let capabilities = surface.get_capabilities(&adapter);
        // The picture and egui's colours are sRGB codes already: the window must take them as they are.
        let plain = [wgpu::TextureFormat::Bgra8Unorm, wgpu::TextureFormat::Rgba8Unorm];
        let format = plain.into_iter().find(|format| capabilities.formats.contains(format));
        let format = format.ok_or_else(|| GpuError::CannotPresent { adapter: gpu.info.name.clone() })?;
        let configuration = wgpu::SurfaceConfiguration {
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            format,
            color_space: wgpu::SurfaceColorSpace::Auto,
            width: size.x.max(1),
            height: size.y.max(1),
            present_mode: wgpu::PresentMode::Fifo,
            desired_maximum_frame_latency: 2,
            alpha_mode: wgpu::CompositeAlphaMode::Auto,
            view_formats: Vec::new(),
        };
        let picture = PictureDrawing::new(&gpu, library, format)?;
        let options = egui_wgpu::RendererOptions { dithering: false, ..Default::default() };
        let ui = gpu
            .guarded("the renderer of the user interface", || egui_wgpu::Renderer::new(&gpu.device, format, options))?;
        let mut surface = Surface { gpu: gpu.clone(), instance, target, surface, configuration, picture, ui };
        surface.resize(size)?;
        Ok((gpu, surface))
    }

    /// Takes up the window's size in pixels; nothing, while a side is 0.
    pub fn resize(&mut self, size: UVec2) -> Result<(), GpuError> {
        if size.min_element() == 0 {
            return Ok(());
        }
        let most = self.gpu.limits.max_texture_dimension_2d;
        (self.configuration.width, self.configuration.height) = (size.x.min(most), size.y.min(most));
        self.configure()
    }

    /// Pixels.
    pub fn size(&self) -> UVec2 {
        UVec2::new(self.configuration.width, self.configuration.height)
    }

    fn configure(&self) -> Result<(), GpuError> {
        self.gpu.guarded("the window's surface", || self.surface.configure(&self.gpu.device, &self.configuration))
    }

    /// Draws a frame and presents it: the runtime's `picture`, of the size `shown`, or the last one where there is none. `paint` may
    /// cover what `placement` leaves.
    pub fn draw(
        &mut self,
        runtime: &Runtime,
        shown: Option<UVec2>,
        placement: Placement,
        mut paint: Paint,
    ) -> Result<Drawn, GpuError> {
        // Taken up whether or not there is a frame: egui sends each texture once, and asserts that none is dropped.
        let freed = std::mem::take(&mut paint.textures.free);
        for (id, deltas) in &std::mem::take(&mut paint.textures.set) {
            for delta in deltas {
                self.ui.update_texture(&self.gpu.device, &self.gpu.queue, *id, delta);
            }
        }
        let drawn = match self.frame()? {
            Some(frame) => {
                let suboptimal = frame.suboptimal;
                self.encode(&frame.texture, runtime, shown, placement, &paint)?;
                self.gpu.queue.present(frame.texture);
                if suboptimal {
                    self.configure()?;
                }
                Drawn::Yes
            }
            None => Drawn::Later,
        };
        for id in &freed {
            self.ui.free_texture(id);
        }
        self.gpu.check_lost()?;
        Ok(drawn)
    }

    /// The next frame of the window, unless it has none now. A surface that no longer fits is made ready for the next time.
    fn frame(&mut self) -> Result<Option<Frame>, GpuError> {
        use wgpu::CurrentSurfaceTexture as Current;
        match self.gpu.guarded("the window's next frame", || self.surface.get_current_texture())? {
            Current::Success(texture) => return Ok(Some(Frame { texture, suboptimal: false })),
            Current::Suboptimal(texture) => return Ok(Some(Frame { texture, suboptimal: true })),
            Current::Timeout | Current::Occluded => {}
            Current::Outdated | Current::Validation => self.configure()?,
            Current::Lost => {
                self.gpu.check_lost()?;
                self.surface = create(&self.instance, &self.target)?;
                self.configure()?;
            }
        }
        Ok(None)
    }

    fn encode(
        &mut self,
        texture: &wgpu::SurfaceTexture,
        runtime: &Runtime,
        shown: Option<UVec2>,
        placement: Placement,
        paint: &Paint,
    ) -> Result<(), GpuError> {
        let (gpu, size) = (self.gpu.clone(), self.size());
        let screen =
            egui_wgpu::ScreenDescriptor { size_in_pixels: size.to_array(), pixels_per_point: paint.pixels_per_point };
        gpu.guarded("a frame", || {
            let view = texture.texture.create_view(&Default::default());
            let bound = self.picture.bind(&gpu, runtime, shown, placement);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut commands =
                self.ui.update_buffers(&gpu.device, &gpu.queue, &mut encoder, &paint.primitives, &screen);
            let mut pass = encoder
                .begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: Some("window"),
                    color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                        view: &view,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations {
                            load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                            store: wgpu::StoreOp::Store,
                        },
                    })],
                    ..Default::default()
                })
                .forget_lifetime();
            self.picture.draw(&mut pass, &bound);
            self.ui.render(&mut pass, &paint.primitives, &screen);
            drop(pass);
            self.picture.keep(&gpu, &mut encoder, runtime, shown);
            commands.push(encoder.finish());
            gpu.queue.submit(commands);
        })
    }
}

/// A frame that was acquired.
struct Frame {
    texture: wgpu::SurfaceTexture,
    /// It can be shown, but the surface is to be configured anew.
    suboptimal: bool,
}

fn create(instance: &wgpu::Instance, target: &Target) -> Result<wgpu::Surface<'static>, GpuError> {
    instance.create_surface(target.clone()).map_err(|error| GpuError::NoSurface { reason: error.to_string() })
}
