//! Render pipelines of the device, one for each kind of thing drawn.

use crate::cutaway::MOST_CUTS;
use crate::target::{COLOR_FORMAT, DEPTH_FORMAT};

const LIGHT: &str = include_str!("shaders/light.wgsl");
const PLACES: &str = include_str!("shaders/places.wgsl");

/// Number of floats in the uniforms of a picture.
pub(crate) const GLOBALS: usize = 3 * 16 + (11 + MOST_CUTS) * 4;

/// The pipelines, and the layouts of what they read.
#[derive(Debug)]
pub(crate) struct Pipelines {
    pub spheres: wgpu::RenderPipeline,
    pub small_spheres: wgpu::RenderPipeline,
    pub glass: wgpu::RenderPipeline,
    pub surfaces: wgpu::RenderPipeline,
    pub arrows: wgpu::RenderPipeline,
    pub sky: wgpu::RenderPipeline,
    pub grid: wgpu::RenderPipeline,
    pub sphere_shadows: wgpu::RenderPipeline,
    pub surface_shadows: wgpu::RenderPipeline,
    pub picture_layout: wgpu::BindGroupLayout,
    pub light_layout: wgpu::BindGroupLayout,
}

/// The parts of a pipeline.
struct Parts<'a> {
    label: &'a str,
    source: String,
    entries: [&'a str; 2],
    /// Vertex attributes of four floats in an instance, and floats from one instance to the next.
    attributes: u32,
    stride: u32,
    topology: wgpu::PrimitiveTopology,
    depth: wgpu::DepthStencilState,
    /// How a colour is blended with the picture; `None` replaces what is there.
    blend: Option<wgpu::BlendState>,
    /// Whether alpha sets how many samples of a pixel are covered, which smooths outlines. A shader
    /// that writes depth writes one depth for all samples.
    is_smoothed: bool,
}

impl Pipelines {
    pub fn new(device: &wgpu::Device, samples: u32) -> Self {
        let picture_layout = picture_layout(device);
        let light_layout = layout(device, "light", &[uniform(0)]);
        let lit = |label, source: &str, attributes, topology| {
            // Sky and grid are behind everything; glass hides nothing.
            let is_solid = !matches!(label, "sky" | "grid" | "glass");
            let is_small = label == "small spheres";
            let is_clear = matches!(label, "grid" | "glass");
            Parts {
                label,
                source: format!("{LIGHT}{PLACES}{source}"),
                entries: match label {
                    "glass" => ["vertex", "glass"],
                    "small spheres" => ["small_vertex", "small_fragment"],
                    _ => ["vertex", "fragment"],
                },
                attributes,
                stride: attributes,
                topology,
                depth: depth_state(wgpu::CompareFunction::GreaterEqual, is_solid),
                blend: is_clear.then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                is_smoothed: !is_clear && !is_small,
            }
        };
        let (strip, list) =
            (wgpu::PrimitiveTopology::TriangleStrip, wgpu::PrimitiveTopology::TriangleList);
        let picture = |parts| picture_pipeline(device, &picture_layout, samples, &parts);
        let shadow = |label, entries, attributes, stride, topology| {
            let parts = Parts {
                label,
                source: format!("{PLACES}{}", include_str!("shaders/shadow.wgsl")),
                entries,
                attributes,
                stride,
                topology,
                depth: depth_state(wgpu::CompareFunction::Less, true),
                blend: None,
                is_smoothed: false,
            };
            shadow_pipeline(device, &light_layout, &parts)
        };
        Self {
            spheres: picture(lit("spheres", include_str!("shaders/sphere.wgsl"), 3, strip)),
            small_spheres: picture(lit(
                "small spheres",
                include_str!("shaders/sphere.wgsl"),
                3,
                strip,
            )),
            glass: picture(lit("glass", include_str!("shaders/sphere.wgsl"), 3, strip)),
            surfaces: picture(lit("surfaces", include_str!("shaders/surface.wgsl"), 4, list)),
            arrows: picture(lit("arrows", include_str!("shaders/arrow.wgsl"), 3, list)),
            sky: picture(lit("sky", include_str!("shaders/sky.wgsl"), 0, list)),
            grid: picture(lit("grid", include_str!("shaders/grid.wgsl"), 2, strip)),
            sphere_shadows: shadow(
                "shadows of spheres",
                ["sphere_vertex", "sphere_fragment"],
                2,
                3,
                strip,
            ),
            surface_shadows: shadow("shadows of surfaces", ["surface_vertex", ""], 3, 4, list),
            picture_layout,
            light_layout,
        }
    }
}

fn uniform(binding: u32) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    }
}

fn layout(
    device: &wgpu::Device,
    label: &str,
    entries: &[wgpu::BindGroupLayoutEntry],
) -> wgpu::BindGroupLayout {
    let label = Some(label);
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries })
}

fn picture_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let fragment = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty,
        count: None,
    };
    let maps = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Depth,
        view_dimension: wgpu::TextureViewDimension::D2Array,
        multisampled: false,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison);
    layout(device, "picture", &[uniform(0), fragment(1, maps), fragment(2, sampler)])
}

fn depth_state(compare: wgpu::CompareFunction, writes: bool) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(writes),
        depth_compare: Some(compare),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

fn picture_pipeline(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    samples: u32,
    parts: &Parts,
) -> wgpu::RenderPipeline {
    let multisample = wgpu::MultisampleState {
        count: samples,
        mask: !0,
        alpha_to_coverage_enabled: samples > 1 && parts.is_smoothed,
    };
    let colors = [Some(wgpu::ColorTargetState {
        format: COLOR_FORMAT,
        blend: parts.blend,
        // Pictures are opaque: alpha is only the coverage and is not stored.
        write_mask: wgpu::ColorWrites::COLOR,
    })];
    pipeline(device, layout, parts, multisample, &colors)
}

fn shadow_pipeline(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    parts: &Parts,
) -> wgpu::RenderPipeline {
    pipeline(device, layout, parts, wgpu::MultisampleState::default(), &[])
}

fn pipeline(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    parts: &Parts,
    multisample: wgpu::MultisampleState,
    colors: &[Option<wgpu::ColorTargetState>],
) -> wgpu::RenderPipeline {
    let label = Some(parts.label);
    let source = wgpu::ShaderSource::Wgsl(parts.source.as_str().into());
    let module = &device.create_shader_module(wgpu::ShaderModuleDescriptor { label, source });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label,
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    let attributes: Vec<_> = (0..parts.attributes)
        .map(|i| wgpu::VertexAttribute {
            format: wgpu::VertexFormat::Float32x4,
            offset: 16 * u64::from(i),
            shader_location: i,
        })
        .collect();
    let instances = [Some(wgpu::VertexBufferLayout {
        array_stride: 16 * u64::from(parts.stride),
        step_mode: wgpu::VertexStepMode::Instance,
        attributes: &attributes,
    })];
    let [vertex, fragment] = parts.entries;
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label,
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: Default::default(),
            buffers: if attributes.is_empty() { &[] } else { &instances },
        },
        primitive: wgpu::PrimitiveState { topology: parts.topology, ..Default::default() },
        depth_stencil: Some(parts.depth.clone()),
        multisample,
        fragment: (!fragment.is_empty()).then(|| wgpu::FragmentState {
            module,
            entry_point: Some(fragment),
            compilation_options: Default::default(),
            targets: colors,
        }),
        multiview_mask: None,
        cache: None,
    })
}
