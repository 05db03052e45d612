//! Pictures to be saved, while they are drawn.

use carom_render::{GpuError, Picture, Readback};
use egui_wgpu::wgpu::Device;

/// A picture that is being drawn; one part for each rule shown.
#[derive(Debug)]
pub struct Snapshot {
    pub parts: Vec<Readback>,
}

impl Snapshot {
    /// Returns whether [`Self::picture`] has a result.
    pub fn is_ready(&self, device: &Device) -> bool {
        // Waiting is the fastest, but a web page cannot wait.
        let may_wait = cfg!(not(target_arch = "wasm32"));
        self.parts.iter().all(|part| {
            if may_wait {
                // `picture` returns the error.
                drop(part.wait(device));
            }
            may_wait || part.arrived(device)
        })
    }

    /// Returns the picture, with its parts side by side.
    ///
    /// # Errors
    /// [`GpuError`] if the device failed.
    pub fn picture(self) -> Result<Picture, GpuError> {
        let parts: Result<Vec<Picture>, GpuError> =
            self.parts.into_iter().map(Readback::picture).collect();
        parts.map(|parts| Picture::side_by_side(&parts))
    }
}
