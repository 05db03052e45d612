//! Pictures that are drawn to be saved.

use carom_render::{GpuError, Picture, Readback};
use egui_wgpu::wgpu::Device;

/// A picture that is being drawn; one part for each of the rules shown.
#[derive(Debug)]
pub struct Snapshot {
    pub parts: Vec<Readback>,
}

impl Snapshot {
    /// Whether [`Self::picture`] has an answer.
    pub fn is_ready(&self, device: &Device) -> bool {
        // To wait is the shortest way, but a page cannot.
        let may_wait = cfg!(not(target_arch = "wasm32"));
        self.parts.iter().all(|part| {
            if may_wait {
                // What goes wrong is what the picture says.
                drop(part.wait(device));
            }
            may_wait || part.arrived(device)
        })
    }

    /// The picture.
    ///
    /// # Errors
    /// [`GpuError`] if the device failed.
    pub fn picture(self) -> Result<Picture, GpuError> {
        let parts: Result<Vec<Picture>, GpuError> =
            self.parts.into_iter().map(Readback::picture).collect();
        parts.map(|parts| Picture::side_by_side(&parts))
    }
}
