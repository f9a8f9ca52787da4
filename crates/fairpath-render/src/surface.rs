//! The renderer of surfaces: a mesh on the device, a camera and a look come in, a texture goes out.

use crate::camera::Camera;
use crate::error::RenderError;
use crate::gpu_mesh::{GpuMesh, Vertex, YAxis};
use crate::look::{Finish, Look, Room, linear};
use crate::target::{DEPTH_FORMAT, PICTURE_FORMAT, Target, samples};
use bytemuck::{Pod, Zeroable};
use fairpath_curve::trig;
use fairpath_shape::Mesh;
use glam::{Mat4, Vec3, Vec4};

/// The lamps of a room. Colours are light in proportion, the others strengths.
struct Lamps {
    sky: Vec3,
    ground: Vec3,
    key: f32,
    rim: f32,
    gloss: f32,
}

/// White walls: the shadows are half as bright as the lights.
const BRIGHT: Lamps =
    Lamps { sky: Vec3::new(0.46, 0.49, 0.54), ground: Vec3::new(0.21, 0.17, 0.15), key: 0.74, rim: 0.16, gloss: 0.17 };
/// A studio: the sky is weak and the rim is strong, so that the surface stands out from the dark.
const DARK: Lamps = Lamps {
    sky: Vec3::new(0.17, 0.20, 0.25),
    ground: Vec3::new(0.045, 0.038, 0.036),
    key: 0.62,
    rim: 1.25,
    gloss: 0.15,
};

/// What the shader is told once for a picture, in its layout.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Scene {
    clip_from_local: Mat4,
    view_from_local: Mat4,
    material: Vec4,
    sky: Vec4,
    ground: Vec4,
    zebra: Vec4,
}

/// A picture that was drawn.
#[derive(Clone, Copy, Debug)]
pub struct Drawn<'a> {
    /// The picture, in [`PICTURE_FORMAT`](crate::PICTURE_FORMAT).
    pub view: &'a wgpu::TextureView,
    /// Whether it is another texture than that of the picture before, so that whoever shows it has to be given it anew.
    pub is_new_texture: bool,
}

/// Draws surfaces into a texture of its own.
///
/// It needs no more than WebGL 2 has: no compute shaders, no storage buffers.
#[derive(Debug)]
pub struct SurfaceRenderer {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::RenderPipeline,
    scene: wgpu::Buffer,
    bindings: wgpu::BindGroup,
    samples: u32,
    target: Option<Target>,
}

impl SurfaceRenderer {
    /// A renderer for a device; in an egui application, that of `egui_wgpu::RenderState`, with its adapter and queue.
    #[must_use]
    pub fn new(adapter: &wgpu::Adapter, device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let scene = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("scene"),
            size: size_of::<Scene>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("scene"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: scene.as_entire_binding() }],
        });
        let samples = samples(adapter);
        let pipeline = pipeline(device, &layout, samples);
        Self { device: device.clone(), queue: queue.clone(), pipeline, scene, bindings, samples, target: None }
    }

    /// Copies meshes, which are drawn as one, to the device. Once is enough until they change.
    ///
    /// `y` is where the y axis of their coordinates points.
    ///
    /// # Errors
    /// [`RenderError`] where there is no triangle, a mesh is not sound enough to be drawn, or the device cannot hold it.
    pub fn upload(&self, meshes: &[&Mesh], y: YAxis) -> Result<GpuMesh, RenderError> {
        GpuMesh::new(&self.device, meshes, y)
    }

    /// Draws a picture of `size_px`, width and height. The texture is that of the picture before if the size is the same.
    ///
    /// # Errors
    /// [`RenderError::BadSize`] where a side is 0 or longer than the device can.
    pub fn render(
        &mut self,
        mesh: &GpuMesh,
        camera: &Camera,
        size_px: [u32; 2],
        look: &Look,
    ) -> Result<Drawn<'_>, RenderError> {
        let kept = self.target.take().filter(|target| target.size() == size_px);
        let is_new_texture = kept.is_none();
        let target = match kept {
            Some(target) => target,
            None => Target::new(&self.device, size_px, self.samples)?,
        };
        let [width, height] = size_px.map(f64::from);
        let scene = scene(mesh, camera, width / height, look);
        self.queue.write_buffer(&self.scene, 0, bytemuck::bytes_of(&scene));
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        target.pass(&mut encoder, look.background.map(|byte| f64::from(byte) / 255.0), |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &self.bindings, &[]);
            pass.set_vertex_buffer(0, mesh.vertices.slice(..));
            pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..mesh.corners, 0, 0..1);
        });
        self.queue.submit([encoder.finish()]);
        Ok(Drawn { view: self.target.insert(target).picture_view(), is_new_texture })
    }

    /// Samples to a pixel: 4, or 1 where the device has no more.
    #[must_use]
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// The picture that was drawn last.
    #[cfg(not(target_arch = "wasm32"))]
    pub(crate) fn picture(&self) -> Option<&wgpu::Texture> {
        self.target.as_ref().map(Target::picture)
    }
}

fn pipeline(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, samples: u32) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::include_wgsl!("shaders/surface.wgsl"));
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("surface"),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    let vertices = wgpu::VertexBufferLayout {
        array_stride: size_of::<Vertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &Vertex::ATTRIBUTES,
    };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("surface"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("place_corner"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(vertices)],
        },
        // Counterclockwise from outside; both sides are drawn, since an eye that comes close may look from inside.
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState { count: samples, ..wgpu::MultisampleState::default() },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("shade"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(PICTURE_FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// Everything in f64 until here.
fn scene(mesh: &GpuMesh, camera: &Camera, aspect: f64, look: &Look) -> Scene {
    let bounds = mesh.bounds();
    let view_from_local = camera.view_from_local(&bounds);
    let lamps = match look.room {
        Room::Bright => BRIGHT,
        Room::Dark => DARK,
    };
    let zebra = match look.finish {
        Finish::Clay => Vec4::ZERO,
        Finish::Zebra(zebra) => {
            let (sin, cos) = if zebra.axis_rad.is_finite() { trig::sin_cos(zebra.axis_rad) } else { (0.0, 1.0) };
            Vec4::new(-sin as f32, cos as f32, 0.0, f32::from(zebra.pairs.max(1)))
        }
    };
    Scene {
        clip_from_local: (camera.clip_from_view(&bounds, aspect) * view_from_local).as_mat4(),
        view_from_local: view_from_local.as_mat4(),
        material: Vec3::from(linear(look.material)).extend(lamps.gloss),
        sky: lamps.sky.extend(lamps.key),
        ground: lamps.ground.extend(lamps.rim),
        zebra,
    }
}
