//! Pictures inside the interface.

use std::sync::{Arc, Mutex};

use carom_render::{Camera, Drawing, Gpu, GpuError, Offscreen, Picture, Quality, Renderer, Target};
use egui::{TextureId, Vec2};
use egui_wgpu::{RenderState, wgpu};

/// The graphics device of the interface, with a renderer for all its pictures.
pub struct Studio {
    state: RenderState,
    renderer: Renderer,
    /// For pictures that are saved; made when first needed.
    offscreen: Option<Offscreen>,
    /// What went wrong on the device since it was asked.
    failure: Arc<Mutex<Option<String>>>,
}

/// Notes what goes wrong on the device, instead of ending the program: the scene goes on.
fn listen(device: &wgpu::Device, failure: &Arc<Mutex<Option<String>>>) {
    let note = |failure: &Arc<Mutex<Option<String>>>, text: String| {
        if let Ok(mut failure) = failure.lock() {
            *failure = Some(text);
        }
    };
    let lost = Arc::clone(failure);
    device.set_device_lost_callback(move |reason, text| {
        // That it ends with the program is no failure.
        if reason != wgpu::DeviceLostReason::Destroyed {
            note(&lost, format!("the graphics device was lost: {text}"));
        }
    });
    let failed = Arc::clone(failure);
    device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
        note(&failed, format!("the graphics device failed: {error}"));
    }));
}

/// A picture in the interface.
#[derive(Default)]
pub struct Canvas {
    shown: Option<(Target, TextureId)>,
}

impl Canvas {
    /// What it shows, if anything was drawn into it.
    pub fn texture(&self) -> Option<TextureId> {
        self.shown.as_ref().map(|(_, texture)| *texture)
    }
}

impl Studio {
    /// A studio on the device that draws the interface.
    pub fn new(state: RenderState, quality: Quality) -> Self {
        let failure = Arc::new(Mutex::new(None));
        listen(&state.device, &failure);
        let renderer = Renderer::new(&state.device, quality);
        Self { state, renderer, offscreen: None, failure }
    }

    /// What went wrong on the device since this was asked last: lost, or out of memory.
    pub fn failure(&self) -> Option<String> {
        self.failure.lock().ok()?.take()
    }

    /// How much work goes into its pictures.
    pub fn quality(&self) -> Quality {
        self.renderer.quality()
    }

    /// Changes how much work goes into its pictures.
    pub fn set_quality(&mut self, quality: Quality) {
        if quality != self.quality() {
            self.renderer = Renderer::new(&self.state.device, quality);
        }
    }

    /// Draws into a canvas of this size in pixels.
    pub fn draw(&mut self, canvas: &mut Canvas, size: Vec2, drawing: &Drawing, camera: &Camera) {
        let RenderState { device, queue, .. } = &self.state;
        let largest = device.limits().max_texture_dimension_2d;
        let size = [size.x, size.y].map(|edge| (edge.round() as u32).clamp(1, largest));
        let samples = self.quality().samples;
        let is_fitting = |(target, _): &(Target, TextureId)| {
            target.size() == size && target.samples() == samples
        };
        if !canvas.shown.as_ref().is_some_and(is_fitting) {
            let target = self.renderer.target(device, size);
            let view = target.picture.create_view(&Default::default());
            let mut interface = self.state.renderer.write();
            if let Some((_, old)) = canvas.shown.take() {
                interface.free_texture(&old);
            }
            let linear = wgpu::FilterMode::Linear;
            let texture = interface.register_native_texture(device, &view, linear);
            canvas.shown = Some((target, texture));
        }
        if let Some((target, _)) = &canvas.shown {
            self.renderer.draw(device, queue, drawing, camera, target);
        }
    }

    /// A picture of this size in pixels, as fine as can be.
    ///
    /// # Errors
    /// [`GpuError`] for a size that cannot be drawn, or a lost device.
    pub fn picture(
        &mut self,
        size: [u32; 2],
        drawing: &Drawing,
        camera: &Camera,
    ) -> Result<Picture, GpuError> {
        let offscreen = match &mut self.offscreen {
            Some(offscreen) => {
                offscreen.resize(size)?;
                offscreen
            }
            None => {
                let gpu = Gpu {
                    adapter: self.state.adapter.get_info().name,
                    device: self.state.device.clone(),
                    queue: self.state.queue.clone(),
                };
                self.offscreen.insert(Offscreen::on(gpu, size, Quality::FINE)?)
            }
        };
        offscreen.draw(drawing, camera)
    }
}
