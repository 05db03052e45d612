//! Pixels on their way from the graphics device into memory.

use std::sync::{Arc, OnceLock};

use crate::gpu::GpuError;
use crate::picture::Picture;

/// Rows are copied from textures at multiples of this many bytes.
const ALIGNMENT: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;

/// A picture that the device draws, and that arrives when it has done so.
#[derive(Debug)]
pub struct Readback {
    buffer: wgpu::Buffer,
    size: [u32; 2],
    /// Set once the device has answered.
    answer: Arc<OnceLock<Result<(), wgpu::BufferAsyncError>>>,
}

impl Readback {
    /// Begins to copy a texture of 4 bytes a pixel into memory.
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

    /// Waits until the device has drawn. Pages cannot wait: there, see [`Self::arrived`].
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device fails.
    pub fn wait(&self, device: &wgpu::Device) -> Result<(), GpuError> {
        device.poll(wgpu::PollType::wait_indefinitely()).map(drop).map_err(lost)
    }

    /// Whether [`Self::picture`] has an answer. Does not wait.
    pub fn arrived(&self, device: &wgpu::Device) -> bool {
        // In a page with WebGL nothing else polls the device; a device that does not answer has an
        // error as its answer.
        let asked = device.poll(wgpu::PollType::Poll);
        self.answer.get().is_some() || asked.is_err()
    }

    /// The picture, once it has arrived.
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
        let pixels = lines.flat_map(|line| &line[..used]).copied().collect();
        Ok(Picture { width, height, pixels })
    }
}

fn lost(error: impl std::fmt::Display) -> GpuError {
    GpuError::Lost(error.to_string())
}

fn aligned_row(width: u32) -> u32 {
    (4 * width).next_multiple_of(ALIGNMENT)
}
