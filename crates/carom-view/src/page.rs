//! Draws a page of the interface into a picture, without a window.

use carom_render::{COLOR_FORMAT, Readback};
use egui::{Context, Rect, Theme, Ui, Vec2};
use egui_wgpu::{RenderState, Renderer, RendererOptions, ScreenDescriptor, wgpu};

use crate::fonts;

/// Resolution for slides and print, if the device can draw textures of that size.
const PIXELS_PER_POINT: f32 = 2.0;

/// Number of layout passes until all sizes are known.
const PASSES: usize = 3;

/// Starts to draw a page of this size in points, in the colours of the window `like`.
pub fn draw(
    RenderState { device, queue, .. }: &RenderState,
    like: &Context,
    size: Vec2,
    mut content: impl FnMut(&mut Ui),
) -> Readback {
    let context = Context::default();
    fonts::install(&context);
    for theme in [Theme::Light, Theme::Dark] {
        context.set_style_of(theme, like.style_of(theme));
    }
    context.set_theme(like.theme());
    let largest = device.limits().max_texture_dimension_2d as f32;
    let pixels_per_point = PIXELS_PER_POINT.min(largest / size.max_elem());
    context.set_pixels_per_point(pixels_per_point);
    let mut renderer = Renderer::new(device, COLOR_FORMAT, RendererOptions::default());
    let mut shapes = Vec::new();
    for _ in 0..PASSES {
        let screen_rect = Some(Rect::from_min_size(egui::Pos2::ZERO, size));
        let input = egui::RawInput { screen_rect, ..Default::default() };
        let mut output = context.run_ui(input, |ui| {
            ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
            content(ui);
        });
        for (id, images) in &output.textures_delta.set {
            images.iter().for_each(|image| renderer.update_texture(device, queue, *id, image));
        }
        output.textures_delta.clear();
        shapes = output.shapes;
    }
    let [width, height] = [size.x, size.y].map(|edge| (edge * pixels_per_point) as u32);
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("page"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: COLOR_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let screen = ScreenDescriptor { size_in_pixels: [width, height], pixels_per_point };
    let primitives = context.tessellate(shapes, pixels_per_point);
    let mut encoder = device.create_command_encoder(&Default::default());
    renderer.update_buffers(device, queue, &mut encoder, &primitives, &screen);
    let view = texture.create_view(&Default::default());
    let mut pass = encoder
        .begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("page"),
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
    renderer.render(&mut pass, &primitives, &screen);
    drop(pass);
    queue.submit([encoder.finish()]);
    Readback::begin(device, queue, &texture)
}
