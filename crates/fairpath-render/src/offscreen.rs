//! Pictures without a window: a graphics device of one's own, and what it has drawn as bytes.

use crate::camera::Camera;
use crate::error::RenderError;
use crate::gpu_mesh::{GpuMesh, YAxis};
use crate::look::Look;
use crate::surface::SurfaceRenderer;
use fairpath_shape::Mesh;

/// Bytes of a pixel.
const PIXEL: u32 = 4;

/// Which device to draw on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Adapter {
    /// The best that there is: a graphics card, or software where there is none.
    Best,
    /// Software, for pictures that do not depend on a graphics card.
    Software,
}

/// A picture as bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width and height, px.
    pub size_px: [u32; 2],
    /// Red, green, blue and opacity of sRGB of each pixel, row by row from the top, in each from the left.
    pub rgba: Vec<u8>,
}

/// A device without a window, and its renderer.
///
/// It asks for no more than WebGL 2 has, so what it draws can be drawn in a browser.
#[derive(Debug)]
pub struct Offscreen {
    device: wgpu::Device,
    queue: wgpu::Queue,
    adapter: String,
    renderer: SurfaceRenderer,
}

impl Offscreen {
    /// Opens a device. The environment variable `WGPU_BACKEND` (`vulkan`, `gl` …) chooses how it is driven.
    ///
    /// # Errors
    /// [`RenderError::NoDevice`] where there is none.
    pub fn new(adapter: Adapter) -> Result<Self, RenderError> {
        pollster::block_on(Self::open(adapter))
    }

    async fn open(adapter: Adapter) -> Result<Self, RenderError> {
        let none = |problem: String| RenderError::NoDevice { problem };
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let wanted = wgpu::RequestAdapterOptions {
            force_fallback_adapter: adapter == Adapter::Software,
            ..wgpu::RequestAdapterOptions::default()
        };
        let adapter = instance.request_adapter(&wanted).await.map_err(|e| none(e.to_string()))?;
        let info = adapter.get_info();
        let description = wgpu::DeviceDescriptor {
            label: Some("offscreen"),
            required_limits: wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits()),
            ..wgpu::DeviceDescriptor::default()
        };
        let (device, queue) = adapter.request_device(&description).await.map_err(|e| none(e.to_string()))?;
        let renderer = SurfaceRenderer::new(&adapter, &device, &queue);
        Ok(Self { adapter: format!("{} ({}, {})", info.name, info.backend, info.driver_info), device, queue, renderer })
    }

    /// Name and driver of what draws.
    #[must_use]
    pub fn adapter(&self) -> &str {
        &self.adapter
    }

    /// The renderer, as one for a window would be used.
    pub fn renderer(&mut self) -> &mut SurfaceRenderer {
        &mut self.renderer
    }

    /// As [`SurfaceRenderer::upload`].
    ///
    /// # Errors
    /// As there.
    pub fn upload(&self, meshes: &[&Mesh], y: YAxis) -> Result<GpuMesh, RenderError> {
        self.renderer.upload(meshes, y)
    }

    /// Draws a picture and waits until it is there.
    ///
    /// # Errors
    /// [`RenderError::BadSize`] for sizes that the device cannot hold, [`RenderError::ReadBack`] when the picture cannot be fetched.
    pub fn picture(
        &mut self,
        mesh: &GpuMesh,
        camera: &Camera,
        size_px: [u32; 2],
        look: &Look,
    ) -> Result<Picture, RenderError> {
        self.renderer.render(mesh, camera, size_px, look)?;
        Ok(Picture { size_px, rgba: self.fetch(size_px)? })
    }

    /// Draws a picture and waits for the device, as whoever measures times must.
    ///
    /// # Errors
    /// [`RenderError::BadSize`] for sizes that the device cannot hold, [`RenderError::ReadBack`] when the device is lost.
    pub fn draw(&mut self, mesh: &GpuMesh, camera: &Camera, size_px: [u32; 2], look: &Look) -> Result<(), RenderError> {
        self.renderer.render(mesh, camera, size_px, look)?;
        self.wait()
    }

    fn wait(&self) -> Result<(), RenderError> {
        let done = self.device.poll(wgpu::PollType::wait_indefinitely());
        done.map(drop).map_err(|e| RenderError::ReadBack { problem: e.to_string() })
    }

    fn fetch(&self, [width, height]: [u32; 2]) -> Result<Vec<u8>, RenderError> {
        let fail = |problem: String| RenderError::ReadBack { problem };
        let texture = self.renderer.picture().ok_or_else(|| fail("nothing was drawn".into()))?;
        // Rows are copied in whole multiples of so many bytes.
        let row = (width * PIXEL).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let size = u64::from(row) * u64::from(height);
        if size > self.device.limits().max_buffer_size {
            return Err(fail(format!("its {size} bytes are more than the device copies at once")));
        }
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture"),
            size,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
            },
            texture.size(),
        );
        self.queue.submit([encoder.finish()]);
        let (tell, told) = std::sync::mpsc::channel();
        buffer.map_async(wgpu::MapMode::Read, .., move |mapped| {
            // Nobody listens any more only where the device was lost, and then there is an error already.
            tell.send(mapped).ok();
        });
        self.wait()?;
        told.recv().map_err(|e| fail(e.to_string()))?.map_err(|e| fail(e.to_string()))?;
        let bytes = buffer.get_mapped_range(..).map_err(|e| fail(e.to_string()))?;
        let rows = bytes.chunks_exact(row as usize);
        Ok(rows.flat_map(|row| &row[..(width * PIXEL) as usize]).copied().collect())
    }
}
