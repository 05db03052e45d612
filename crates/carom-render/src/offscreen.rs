//! Pictures drawn without a window.

use crate::camera::Camera;
use crate::drawing::Drawing;
use crate::gpu::{Gpu, GpuError};
use crate::picture::Picture;
use crate::quality::Quality;
use crate::readback::Readback;
use crate::renderer::Renderer;
use crate::target::Target;

/// Draws pictures of one size into memory.
#[derive(Debug)]
pub struct Offscreen {
    gpu: Gpu,
    renderer: Renderer,
    target: Target,
}

impl Offscreen {
    /// Opens a device for pictures of this width and height in pixels.
    ///
    /// # Errors
    /// [`GpuError`] if there is no device, or if it cannot draw pictures of this size.
    pub fn new(size: [u32; 2], quality: Quality) -> Result<Self, GpuError> {
        Self::on(pollster::block_on(Gpu::open())?, size, quality)
    }

    /// Draws with an open device.
    ///
    /// # Errors
    /// [`GpuError::Size`], [`GpuError::Memory`]
    pub fn on(gpu: Gpu, size: [u32; 2], quality: Quality) -> Result<Self, GpuError> {
        let renderer = Renderer::new(&gpu.device, quality);
        let target = target(&gpu, &renderer, size)?;
        Ok(Self { gpu, renderer, target })
    }

    /// Changes the size of later pictures.
    ///
    /// # Errors
    /// [`GpuError::Size`], [`GpuError::Memory`]; the size then stays as it was.
    pub fn resize(&mut self, size: [u32; 2]) -> Result<(), GpuError> {
        if size != self.target.size() {
            self.target = target(&self.gpu, &self.renderer, size)?;
        }
        Ok(())
    }

    /// Returns the device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Draws the picture that the camera sees and waits for it.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device fails, [`GpuError::Memory`].
    pub fn draw(&mut self, drawing: &Drawing, camera: &Camera) -> Result<Picture, GpuError> {
        let readback = self.begin(drawing, camera)?;
        self.finish(readback)
    }

    /// Waits for a picture that [`Self::begin`] started.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device fails.
    pub fn finish(&self, readback: Readback) -> Result<Picture, GpuError> {
        readback.wait(&self.gpu.device)?;
        readback.picture()
    }

    /// Starts to draw the picture that the camera sees, without waiting for it.
    ///
    /// # Errors
    /// [`GpuError::Memory`]
    pub fn begin(&mut self, drawing: &Drawing, camera: &Camera) -> Result<Readback, GpuError> {
        let Self { gpu, renderer, target } = self;
        let Gpu { device, queue, .. } = &*gpu;
        renderer.draw(device, queue, drawing, camera, target);
        gpu.if_it_fits(target.size(), || Readback::begin(device, queue, &target.picture))
    }
}

/// Makes the textures for pictures of this size in pixels.
fn target(gpu: &Gpu, renderer: &Renderer, size: [u32; 2]) -> Result<Target, GpuError> {
    let largest = gpu.device.limits().max_texture_dimension_2d;
    let [width, height] = size;
    if !(1..=largest).contains(&width) || !(1..=largest).contains(&height) {
        return Err(GpuError::Size { width, height, largest });
    }
    gpu.if_it_fits(size, || renderer.target(&gpu.device, size))
}
