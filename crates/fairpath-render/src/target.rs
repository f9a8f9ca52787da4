//! What is drawn into: a texture that others may show, its depths, and several samples to a pixel where the device has them.

use crate::error::RenderError;

/// Format of the pictures: bytes of sRGB that shaders read as they are.
///
/// egui blends the bytes of textures without decoding them and takes no other format for textures of others
/// (`egui_wgpu::Renderer::register_native_texture`). With `Rgba8UnormSrgb`, they would be decoded on the way and appear too dark.
pub const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Format of the depths: floating, since they are stored in reverse.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Samples to a pixel, where the device can.
const SAMPLES: u32 = 4;

/// How many samples to a pixel an adapter can draw and merge, in both formats.
pub(crate) fn samples(adapter: &wgpu::Adapter) -> u32 {
    let can = |format, resolve: bool| {
        let flags = adapter.get_texture_format_features(format).flags;
        let merges = flags.contains(wgpu::TextureFormatFeatureFlags::MULTISAMPLE_RESOLVE);
        flags.sample_count_supported(SAMPLES) && (merges || !resolve)
    };
    if can(PICTURE_FORMAT, true) && can(DEPTH_FORMAT, false) { SAMPLES } else { 1 }
}

/// Textures of one size.
#[derive(Debug)]
pub(crate) struct Target {
    size: [u32; 2],
    /// For pictures without a window, which a browser has none of.
    #[cfg(not(target_arch = "wasm32"))]
    picture: wgpu::Texture,
    picture_view: wgpu::TextureView,
    /// Several samples to a pixel, merged into the picture; none where the picture itself is drawn into.
    sampled: Option<wgpu::TextureView>,
    depth: wgpu::TextureView,
}

impl Target {
    /// # Errors
    /// [`RenderError::BadSize`] for sizes that the device cannot hold.
    pub(crate) fn new(device: &wgpu::Device, size: [u32; 2], samples: u32) -> Result<Self, RenderError> {
        let [width, height] = size;
        let limit = device.limits().max_texture_dimension_2d;
        if !size.iter().all(|side| (1..=limit).contains(side)) {
            return Err(RenderError::BadSize { width, height, limit });
        }
        let texture = |label, format, sample_count, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let drawn = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let shown = drawn | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let picture = texture("picture", PICTURE_FORMAT, 1, shown);
        let sampled = (samples > 1).then(|| view(&texture("samples", PICTURE_FORMAT, samples, drawn)));
        let depth = view(&texture("depths", DEPTH_FORMAT, samples, drawn));
        Ok(Self {
            size,
            picture_view: view(&picture),
            #[cfg(not(target_arch = "wasm32"))]
            picture,
            sampled,
            depth,
        })
    }

    pub(crate) fn size(&self) -> [u32; 2] {
        self.size
    }

    #[cfg(not(target_arch = "wasm32"))]
    pub(crate) fn picture(&self) -> &wgpu::Texture {
        &self.picture
    }

    pub(crate) fn picture_view(&self) -> &wgpu::TextureView {
        &self.picture_view
    }

    /// A pass that fills everything with a colour, from 0 to 1 as screens take it, and then draws what `draw` draws.
    pub(crate) fn pass(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        background: [f64; 3],
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let [r, g, b] = background;
        let store = if self.sampled.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store };
        let colours = wgpu::RenderPassColorAttachment {
            view: self.sampled.as_ref().unwrap_or(&self.picture_view),
            depth_slice: None,
            resolve_target: self.sampled.as_ref().map(|_| &self.picture_view),
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: 1.0 }), store },
        };
        // Reversed: 0 is infinitely far away.
        let depths = wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(colours)],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(depths),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        draw(&mut pass);
    }
}
