//! Draws pictures for the interface.

use std::sync::{Arc, Mutex};

use carom_render::{
    Camera, Drawing, Gpu, GpuError, Offscreen, Quality, Readback, Renderer, Target,
};
use egui::{Context, TextureId, Ui, Vec2};
use egui_wgpu::{RenderState, wgpu};

use crate::page;

/// The graphics device of the interface, with a renderer for all its pictures.
pub struct Studio {
    state: RenderState,
    renderer: Renderer,
    /// Target for saved pictures; created at the first use.
    offscreen: Option<Offscreen>,
    /// Error of the device since the last [`Studio::failure`].
    failure: Arc<Mutex<Option<String>>>,
    dropped: Dropped,
}

/// Records errors of the device. The default would end the program; the scene can continue.
fn listen(device: &wgpu::Device, failure: &Arc<Mutex<Option<String>>>) {
    let note = |failure: &Arc<Mutex<Option<String>>>, text: String| {
        if let Ok(mut failure) = failure.lock() {
            *failure = Some(text);
        }
    };
    let lost = Arc::clone(failure);
    device.set_device_lost_callback(move |reason, text| {
        // The device is destroyed when the program ends; that is no error.
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
    shown: Option<Rendered>,
}

struct Rendered {
    target: Target,
    texture: TextureId,
    /// Collects the texture when it is no longer needed.
    dropped: Dropped,
}

/// Textures that are shown for the last time in the present frame.
type Dropped = Arc<Mutex<Vec<TextureId>>>;

impl Drop for Rendered {
    fn drop(&mut self) {
        if let Ok(mut dropped) = self.dropped.lock() {
            dropped.push(self.texture);
        }
    }
}

impl Canvas {
    /// Returns the texture, if anything was drawn into it.
    pub fn texture(&self) -> Option<TextureId> {
        self.shown.as_ref().map(|shown| shown.texture)
    }
}

impl Studio {
    /// Makes a studio on the device that draws the interface.
    pub fn new(state: RenderState, quality: Quality) -> Self {
        let failure = Arc::new(Mutex::new(None));
        listen(&state.device, &failure);
        let renderer = Renderer::new(&state.device, quality);
        Self { state, renderer, offscreen: None, failure, dropped: Dropped::default() }
    }

    /// Starts a frame of the interface and frees textures that are no longer shown.
    pub fn begin_frame(&mut self) {
        let dropped = self.dropped.lock().map(|mut dropped| std::mem::take(&mut *dropped));
        let mut interface = self.state.renderer.write();
        dropped.unwrap_or_default().iter().for_each(|texture| interface.free_texture(texture));
    }

    /// Returns the graphics device.
    pub fn device(&self) -> &wgpu::Device {
        &self.state.device
    }

    /// Returns an error of the device since the last call: it was lost, or is out of memory.
    pub fn failure(&self) -> Option<String> {
        self.failure.lock().ok()?.take()
    }

    /// Draws into a canvas of this size in pixels.
    pub fn draw(&mut self, canvas: &mut Canvas, size: Vec2, drawing: &Drawing, camera: &Camera) {
        let RenderState { device, queue, .. } = &self.state;
        let largest = device.limits().max_texture_dimension_2d;
        let size = [size.x, size.y].map(|edge| (edge.round() as u32).clamp(1, largest));
        let samples = self.renderer.quality().samples;
        let is_fitting =
            |shown: &Rendered| shown.target.size() == size && shown.target.samples() == samples;
        if !canvas.shown.as_ref().is_some_and(is_fitting) {
            let target = self.renderer.target(device, size);
            let view = target.picture.create_view(&Default::default());
            let linear = wgpu::FilterMode::Linear;
            let mut interface = self.state.renderer.write();
            let texture = interface.register_native_texture(device, &view, linear);
            canvas.shown = Some(Rendered { target, texture, dropped: Arc::clone(&self.dropped) });
        }
        if let Some(Rendered { target, .. }) = &canvas.shown {
            self.renderer.draw(device, queue, drawing, camera, target);
        }
    }

    /// Starts to draw a page of the interface of this size in points, in the colours of the window
    /// `like`.
    pub fn page(&self, like: &Context, size: Vec2, content: impl FnMut(&mut Ui)) -> Readback {
        page::draw(&self.state, like, size, content)
    }

    /// Starts to draw a picture of this size in pixels in the best quality.
    ///
    /// # Errors
    /// [`GpuError::Size`], [`GpuError::Memory`]
    pub fn picture(
        &mut self,
        size: [u32; 2],
        drawing: &Drawing,
        camera: &Camera,
    ) -> Result<Readback, GpuError> {
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
        offscreen.begin(drawing, camera)
    }
}
