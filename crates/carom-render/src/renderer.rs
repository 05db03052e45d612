//! Draws drawings into pictures on a graphics device.

use std::ops::Range;

use carom::DVec3;
use glam::Vec3;

use crate::bounds::Bounds;
use crate::camera::Camera;
use crate::cutaway;
use crate::drawing::{Drawing, Pattern};
use crate::framing::Framing;
use crate::instances::Instances;
use crate::pipelines::{GLOBALS, Pipelines};
use crate::quality::Quality;
use crate::shadow::LightView;
use crate::target::{DEPTH_FORMAT, Target};

/// Draws [`Drawing`]s into [`Target`]s.
#[derive(Debug)]
pub struct Renderer {
    quality: Quality,
    pipelines: Pipelines,
    globals: wgpu::Buffer,
    lights: [Light; 2],
    picture_group: wgpu::BindGroup,
    instances: Instances,
    buffers: Buffers,
}

/// Resources for the shadow map of a light.
#[derive(Debug)]
struct Light {
    uniforms: wgpu::Buffer,
    group: wgpu::BindGroup,
    map: wgpu::TextureView,
}

/// Instance buffers on the device.
#[derive(Debug, Default)]
struct Buffers {
    balls: Option<wgpu::Buffer>,
    faces: Option<wgpu::Buffer>,
    boxes: Option<wgpu::Buffer>,
    arrows: Option<wgpu::Buffer>,
    grid: Option<wgpu::Buffer>,
}

impl Renderer {
    /// Makes a renderer of this quality.
    pub fn new(device: &wgpu::Device, quality: Quality) -> Self {
        let pipelines = Pipelines::new(device, quality.samples);
        let maps = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shadow maps"),
            size: wgpu::Extent3d {
                width: quality.shadow_texels,
                height: quality.shadow_texels,
                depth_or_array_layers: 2,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: DEPTH_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let globals = uniforms(device, GLOBALS);
        let picture_group = picture_group(device, &pipelines, &globals, &maps);
        let lights = [0, 1].map(|layer| Light::new(device, &pipelines, &maps, layer));
        Self {
            quality,
            pipelines,
            globals,
            lights,
            picture_group,
            instances: Instances::default(),
            buffers: Buffers::default(),
        }
    }

    /// Returns the quality.
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// Makes textures for pictures of this size in pixels; an edge of 0 becomes 1.
    pub fn target(&self, device: &wgpu::Device, size: [u32; 2]) -> Target {
        Target::new(device, size.map(|edge| edge.max(1)), self.quality.samples)
    }

    /// Draws what the camera sees; the picture is complete when the queue's work is done.
    pub fn draw(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        drawing: &Drawing,
        camera: &Camera,
        target: &Target,
    ) {
        let framing = drawing.framing.or_else(|| Framing::of_drawing(drawing));
        let framing = framing.unwrap_or(Framing::UNIT);
        let seen = shadowed(drawing, camera, &framing);
        let whole_map = self.quality.shadow_texels;
        let texels = map_texels(drawing, seen.1).map(|texels| texels.min(whole_map));
        let [sun, sky] = [(drawing.light.to_sun, texels[0]), (DVec3::Y, texels[1])]
            .map(|(to_light, texels)| LightView::around(seen, to_light, camera.position, texels));
        let sharpness = 0.5 * f64::from(target.size()[1]) / (0.5 * camera.vertical_fov).tan();
        self.instances.pack(drawing, camera.position, &framing, sharpness);
        self.buffers.fill(device, queue, &self.instances);
        let globals = globals(drawing, &framing, camera, target, self.quality, [&sun, &sky]);
        queue.write_buffer(&self.globals, 0, bytemuck::cast_slice(&globals));
        for (light, view) in self.lights.iter().zip([&sun, &sky]) {
            queue.write_buffer(&light.uniforms, 0, bytemuck::cast_slice(&view.packed()));
        }
        let mut encoder = device.create_command_encoder(&Default::default());
        for (light, texels) in self.lights.iter().zip(texels) {
            self.draw_shadows(&mut encoder, light, texels);
        }
        self.draw_picture(&mut encoder, target);
        queue.submit([encoder.finish()]);
    }

    /// Draws the shadow map of a light, `texels` along each edge.
    fn draw_shadows(&self, encoder: &mut wgpu::CommandEncoder, light: &Light, texels: u32) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadows"),
            depth_stencil_attachment: Some(depth_attachment(&light.map, 1.0, true)),
            ..Default::default()
        });
        pass.set_viewport(0.0, 0.0, texels as f32, texels as f32, 0.0, 1.0);
        pass.set_bind_group(0, &light.group, &[]);
        let Self { pipelines, instances, buffers, .. } = self;
        let [balls, faces, boxes] = instances.casting;
        draw(&mut pass, &pipelines.sphere_shadows, 4, &buffers.balls, balls);
        draw(&mut pass, &pipelines.surface_shadows, 6, &buffers.faces, faces);
        draw(&mut pass, &pipelines.surface_shadows, 36, &buffers.boxes, boxes);
    }

    fn draw_picture(&self, encoder: &mut wgpu::CommandEncoder, target: &Target) {
        let (view, resolve_target) = match &target.sampled {
            Some(sampled) => (sampled, Some(&target.picture_view)),
            None => (&target.picture_view, None),
        };
        let store =
            if resolve_target.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store },
            })],
            depth_stencil_attachment: Some(depth_attachment(&target.depth, 0.0, false)),
            ..Default::default()
        });
        pass.set_bind_group(0, &self.picture_group, &[]);
        let Self { pipelines, instances, buffers, .. } = self;
        draw(&mut pass, &pipelines.surfaces, 6, &buffers.faces, instances.faces.len());
        draw(&mut pass, &pipelines.surfaces, 36, &buffers.boxes, instances.boxes.len());
        let (glass, balls) = (instances.glass_balls, instances.balls.len());
        let small = glass + instances.small_balls;
        draw_some(&mut pass, &pipelines.spheres, 4, &buffers.balls, small..balls);
        draw_some(&mut pass, &pipelines.small_spheres, 8, &buffers.balls, glass..small);
        draw(&mut pass, &pipelines.arrows, 9, &buffers.arrows, instances.arrows.len());
        pass.set_pipeline(&pipelines.sky);
        pass.draw(0..3, 0..1);
        let grids = usize::from(instances.grid.is_some());
        draw(&mut pass, &pipelines.grid, 4, &buffers.grid, grids);
        draw(&mut pass, &pipelines.glass, 4, &buffers.balls, glass);
    }
}

impl Light {
    fn new(device: &wgpu::Device, pipelines: &Pipelines, maps: &wgpu::Texture, layer: u32) -> Self {
        let uniforms = uniforms(device, 28);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("light"),
            layout: &pipelines.light_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniforms.as_entire_binding() }],
        });
        let map = maps.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: layer,
            array_layer_count: Some(1),
            ..Default::default()
        });
        Self { uniforms, group, map }
    }
}

impl Buffers {
    fn fill(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, instances: &Instances) {
        let Instances { balls, faces, boxes, arrows, grid, .. } = instances;
        fill(&mut self.balls, device, queue, bytemuck::cast_slice(balls));
        fill(&mut self.faces, device, queue, bytemuck::cast_slice(faces));
        fill(&mut self.boxes, device, queue, bytemuck::cast_slice(boxes));
        fill(&mut self.arrows, device, queue, bytemuck::cast_slice(arrows));
        fill(&mut self.grid, device, queue, bytemuck::cast_slice(grid.as_slice()));
    }
}

/// Writes bytes into a buffer; replaces the buffer with a larger one if they do not fit.
fn fill(
    buffer: &mut Option<wgpu::Buffer>,
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    bytes: &[u8],
) {
    if bytes.is_empty() {
        return;
    }
    let needed = bytes.len() as u64;
    let fitting = buffer.take().filter(|buffer| buffer.size() >= needed);
    let fitting = fitting.unwrap_or_else(|| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("instances"),
            size: needed.next_power_of_two(),
            usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    });
    queue.write_buffer(&fitting, 0, bytes);
    *buffer = Some(fitting);
}

fn uniforms(device: &wgpu::Device, numbers: usize) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("uniforms"),
        size: 4 * numbers as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn picture_group(
    device: &wgpu::Device,
    pipelines: &Pipelines,
    globals: &wgpu::Buffer,
    maps: &wgpu::Texture,
) -> wgpu::BindGroup {
    let maps = maps.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    });
    let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("shadows"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        compare: Some(wgpu::CompareFunction::LessEqual),
        ..Default::default()
    });
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("picture"),
        layout: &pipelines.picture_layout,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: globals.as_entire_binding() },
            wgpu::BindGroupEntry {
                binding: 1,
                resource: wgpu::BindingResource::TextureView(&maps),
            },
            wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(&sampler) },
        ],
    })
}

fn depth_attachment(
    view: &wgpu::TextureView,
    farthest: f32,
    keep: bool,
) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    let store = if keep { wgpu::StoreOp::Store } else { wgpu::StoreOp::Discard };
    let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(farthest), store };
    wgpu::RenderPassDepthStencilAttachment { view, depth_ops: Some(ops), stencil_ops: None }
}

fn draw(
    pass: &mut wgpu::RenderPass,
    pipeline: &wgpu::RenderPipeline,
    vertices: u32,
    buffer: &Option<wgpu::Buffer>,
    count: usize,
) {
    draw_some(pass, pipeline, vertices, buffer, 0..count);
}

fn draw_some(
    pass: &mut wgpu::RenderPass,
    pipeline: &wgpu::RenderPipeline,
    vertices: u32,
    buffer: &Option<wgpu::Buffer>,
    instances: Range<usize>,
) {
    if let Some(buffer) = buffer
        && !instances.is_empty()
    {
        pass.set_pipeline(pipeline);
        pass.set_vertex_buffer(0, buffer.slice(..));
        pass.draw(0..vertices, instances.start as u32..instances.end as u32);
    }
}

/// Returns centre and radius \[m\] of the space whose shadows are drawn. Balls that have flown far
/// away are left out, because they would leave few texels for the others.
fn shadowed(drawing: &Drawing, camera: &Camera, framing: &Framing) -> (DVec3, f64) {
    // In distances of the eye from the middle of the scene.
    const REACH: f64 = 1.5;
    let focus = framing.whole.center();
    let reach = REACH * (focus - camera.position).length().max(framing.whole.radius());
    let near = drawing.balls.iter().filter(|ball| ball.center.distance(focus) < reach);
    let near = near.map(|ball| Bounds::from_sphere(ball.center, ball.radius));
    let seen = Bounds::around(near.chain([framing.whole])).unwrap_or(framing.whole);
    (seen.center(), seen.radius().min(2.0 * reach))
}

/// Returns the texels along an edge of the maps of sun and sky for a space of this radius \[m\]. A
/// mean ball gets just enough texels for soft shadow edges: narrow ones for the sun, wide ones for
/// the sky.
fn map_texels(drawing: &Drawing, radius: f64) -> [u32; 2] {
    const TEXELS_OF_BALL: [f64; 2] = [24.0, 4.0];
    const FEWEST: f64 = 64.0;
    // The number changes in steps, not with every ball that appears.
    const STEP: f64 = 32.0;
    let casting = drawing.balls.iter().filter(|ball| ball.pattern != Pattern::Glowing);
    let (count, sum) = casting.fold((0.0, 0.0), |(count, sum), it| (count + 1.0, sum + it.radius));
    TEXELS_OF_BALL.map(|of_ball| {
        let texels = of_ball * 2.0 * radius * count / f64::max(sum, f64::MIN_POSITIVE);
        ((texels.max(FEWEST) / STEP).ceil() * STEP) as u32
    })
}

/// Returns the box relative to the eye in which half-spaces other than the ground are drawn \[m\].
/// It is a little larger than the scene, so that walls at its sides are not cut off.
fn room(framing: &Framing, camera: &Camera) -> [Vec3; 2] {
    const MARGIN: f64 = 0.04;
    let Bounds { min, max } = framing.whole.grown(MARGIN * framing.whole.radius());
    [min, max].map(|corner| (corner - camera.position).as_vec3())
}

/// Returns the uniforms of a picture, in the order of the shader's `Globals`.
fn globals(
    drawing: &Drawing,
    framing: &Framing,
    camera: &Camera,
    target: &Target,
    quality: Quality,
    [sun, sky]: [&LightView; 2],
) -> [f32; GLOBALS] {
    let [width, height] = target.size().map(|edge| edge as f32);
    let aspect = width / height;
    let [right, up] = camera.edges(aspect);
    let light = &drawing.light;
    let of = |vector: Vec3, last: f32| vector.extend(last).to_array();
    let yes = |is: bool| if is { 1.0 } else { 0.0 };
    let room = room(framing, camera);
    let matrices = [camera.clip_from_eye(aspect), sun.map_from_eye, sky.map_from_eye];
    let vectors = [
        of(light.to_sun.as_vec3(), sun.texel),
        of(light.sun.into(), yes(quality.soft_shadows)),
        of(light.zenith.into(), sky.texel),
        of(light.horizon.into(), yes(quality.samples > 1)),
        of(light.ground.into(), sky.part_of(quality.shadow_texels)),
        of(camera.ahead().as_vec3(), sun.part_of(quality.shadow_texels)),
        of(right, 0.0),
        of(up, 0.0),
        [width, height, 1.0 / quality.shadow_texels as f32, light.fill()],
        // Inclines go farther, as the balls that roll down them do.
        of(room[0], framing.whole.radius() as f32),
        of(room[1], 0.0),
    ];
    let cuts = cutaway::cuts(drawing, camera.position);
    let mut numbers = [0.0; GLOBALS];
    let parts = matrices.iter().flat_map(|matrix| matrix.to_cols_array());
    for (place, number) in
        numbers.iter_mut().zip(parts.chain(vectors.into_iter().chain(cuts).flatten()))
    {
        *place = number;
    }
    numbers
}
