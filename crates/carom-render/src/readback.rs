//! Copies of pictures from the graphics device into memory.

use std::sync::{Arc, OnceLock};

use crate::gpu::GpuError;
use crate::picture::Picture;

/// Rows of texture copies start at multiples of this many bytes.
const ALIGNMENT: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;

/// A picture that the device is still drawing; it can be read when the device has finished.
#[derive(Debug)]
pub struct Readback {
    buffer: wgpu::Buffer,
    size: [u32; 2],
    /// Set when the device has answered.
    answer: Arc<OnceLock<Result<(), wgpu::BufferAsyncError>>>,
}

impl Readback {
    /// Starts to copy a texture of 4 bytes a pixel into memory.
    pub fn begin(device: &wgpu::Device, queue: &wgpu::Queue, texture: &wgpu::Texture) -> Self {
        let size = [texture.width(), texture.height()];
        let row = aligned_row(size[0]);
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("pixels"),
            size: u64::from(row) * u64::from(size[1]),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row),
                    rows_per_image: None,
                },
            },
            texture.size(),
        );
        queue.submit([encoder.finish()]);
        let answer = Arc::new(OnceLock::new());
        let told = Arc::clone(&answer);
        buffer.map_async(wgpu::MapMode::Read, .., move |result| drop(told.set(result)));
        Self { buffer, size, answer }
    }

    /// Waits until the device has finished. A web page cannot wait; it calls [`Self::arrived`].
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device fails.
    pub fn wait(&self, device: &wgpu::Device) -> Result<(), GpuError> {
        device.poll(wgpu::PollType::wait_indefinitely()).map(drop).map_err(lost)
    }

    /// Returns whether [`Self::picture`] can return a result. Does not wait.
    pub fn arrived(&self, device: &wgpu::Device) -> bool {
        // On a page with WebGL nothing else polls the device. If polling fails, the result is an
        // error.
        let asked = device.poll(wgpu::PollType::Poll);
        self.answer.get().is_some() || asked.is_err()
    }

    /// Returns the picture after it has arrived.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device failed, or has not drawn it yet.
    pub fn picture(self) -> Result<Picture, GpuError> {
        match self.answer.get() {
            Some(Ok(())) => {}
            Some(Err(error)) => return Err(lost(error)),
            None => return Err(lost("it did not answer")),
        }
        let [width, height] = self.size;
        let bytes = self.buffer.get_mapped_range(..).map_err(lost)?;
        let lines = bytes.chunks_exact(aligned_row(width) as usize);
        let used = 4 * width as usize;
        let mut pixels = Vec::with_capacity(used * height as usize);
        lines.for_each(|line| pixels.extend_from_slice(&line[..used]));
        Ok(Picture { width, height, pixels })
    }
}

fn lost(error: impl std::fmt::Display) -> GpuError {
    GpuError::Lost(error.to_string())
}

fn aligned_row(width: u32) -> u32 {
    (4 * width).next_multiple_of(ALIGNMENT)
}
