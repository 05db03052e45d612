//! Pictures without any window.

use crate::camera::Camera;
use crate::drawing::Drawing;
use crate::gpu::{Gpu, GpuError};
use crate::picture::Picture;
use crate::quality::Quality;
use crate::renderer::Renderer;
use crate::target::Target;

/// Draws pictures of one size into memory.
#[derive(Debug)]
pub struct Offscreen {
    gpu: Gpu,
    renderer: Renderer,
    target: Target,
    readback: wgpu::Buffer,
}

/// Rows are copied from textures at multiples of this many bytes.
const ALIGNMENT: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;

impl Offscreen {
    /// A device of its own, for pictures of this width and height in pixels.
    ///
    /// # Errors
    /// [`GpuError`] if there is no device, or none for pictures of this size.
    pub fn new(size: [u32; 2], quality: Quality) -> Result<Self, GpuError> {
        Self::on(pollster::block_on(Gpu::open())?, size, quality)
    }

    /// Likewise on a device that is there already.
    ///
    /// # Errors
    /// [`GpuError::Size`]
    pub fn on(gpu: Gpu, size: [u32; 2], quality: Quality) -> Result<Self, GpuError> {
        let renderer = Renderer::new(&gpu.device, quality);
        let (target, readback) = textures(&gpu, &renderer, size)?;
        Ok(Self { gpu, renderer, target, readback })
    }

    /// Draws pictures of this size from now on.
    ///
    /// # Errors
    /// [`GpuError::Size`]; then the size stays as it was.
    pub fn resize(&mut self, size: [u32; 2]) -> Result<(), GpuError> {
        if size != self.target.size() {
            (self.target, self.readback) = textures(&self.gpu, &self.renderer, size)?;
        }
        Ok(())
    }

    /// The device it draws with.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// The picture that the camera sees.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device fails.
    pub fn draw(&mut self, drawing: &Drawing, camera: &Camera) -> Result<Picture, GpuError> {
        let Gpu { device, queue, .. } = &self.gpu;
        self.renderer.draw(device, queue, drawing, camera, &self.target);
        let [width, height] = self.target.size();
        let row = aligned_row(width);
        let mut encoder = device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            self.target.picture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.readback,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row),
                    rows_per_image: None,
                },
            },
            self.target.picture.size(),
        );
        queue.submit([encoder.finish()]);
        self.readback.map_async(wgpu::MapMode::Read, .., |_| {});
        let waited = device.poll(wgpu::PollType::wait_indefinitely()).map_err(lost);
        let pixels = waited.and_then(|_| read(&self.readback, row, 4 * width));
        // Whatever happened, the next picture is read into it again.
        self.readback.unmap();
        Ok(Picture { width, height, pixels: pixels? })
    }
}

/// The bytes of all rows, `used` of the `row` bytes of each.
fn read(readback: &wgpu::Buffer, row: u32, used: u32) -> Result<Vec<u8>, GpuError> {
    let bytes = readback.get_mapped_range(..).map_err(lost)?;
    let lines = bytes.chunks_exact(row as usize);
    Ok(lines.flat_map(|line| &line[..used as usize]).copied().collect())
}

fn lost(error: impl std::fmt::Display) -> GpuError {
    GpuError::Lost(error.to_string())
}

fn aligned_row(width: u32) -> u32 {
    (4 * width).next_multiple_of(ALIGNMENT)
}

fn textures(
    gpu: &Gpu,
    renderer: &Renderer,
    size: [u32; 2],
) -> Result<(Target, wgpu::Buffer), GpuError> {
    let largest = gpu.device.limits().max_texture_dimension_2d;
    let [width, height] = size;
    if !(1..=largest).contains(&width) || !(1..=largest).contains(&height) {
        return Err(GpuError::Size { width, height, largest });
    }
    let readback = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("pixels"),
        size: u64::from(aligned_row(width)) * u64::from(height),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    Ok((renderer.target(&gpu.device, size), readback))
}
