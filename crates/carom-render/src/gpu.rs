//! The graphics device.

use thiserror::Error;

/// Why nothing can be drawn.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GpuError {
    /// There is no graphics driver.
    #[error(
        "no graphics adapter found; a software driver is enough (Debian, Ubuntu: apt-get install \
         mesa-vulkan-drivers; Fedora: dnf install mesa-vulkan-drivers): {0}"
    )]
    NoAdapter(#[from] wgpu::RequestAdapterError),
    /// The adapter opens no device.
    #[error("the graphics adapter {adapter} cannot be used: {source}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// The cause.
        source: wgpu::RequestDeviceError,
    },
    /// The device was lost, or is out of memory.
    #[error("the graphics device failed: {0}")]
    Lost(String),
    /// The picture has no pixels, or is larger than the device can draw.
    #[error("a picture of {width} x {height} pixels cannot be drawn: between 1 and {largest} each")]
    Size {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Largest edge in pixels.
        largest: u32,
    },
    /// The device has too little memory for the picture.
    #[error("there is too little graphics memory for a picture of {width} x {height} pixels")]
    Memory {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
}

/// A device to draw with, and the queue of its work.
#[derive(Debug, Clone)]
pub struct Gpu {
    /// Name of the adapter.
    pub adapter: String,
    /// The device.
    pub device: wgpu::Device,
    /// The queue of its work.
    pub queue: wgpu::Queue,
}

impl Gpu {
    /// Calls `make` and returns its result, if the device has the memory for a picture of this size
    /// in pixels.
    ///
    /// # Errors
    /// [`GpuError::Memory`]
    pub(crate) fn if_it_fits<T>(
        &self,
        [width, height]: [u32; 2],
        make: impl FnOnce() -> T,
    ) -> Result<T, GpuError> {
        // A texture without memory makes everything built on it invalid, too.
        let invalid = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let made = make();
        let [memory, invalid] = [memory.pop(), invalid.pop()].map(|error| {
            // A page cannot wait for the answer; there, the failure shows when the picture is
            // drawn.
            if cfg!(target_arch = "wasm32") { None } else { pollster::block_on(error) }
        });
        match memory.or(invalid) {
            Some(_) => Err(GpuError::Memory { width, height }),
            None => Ok(made),
        }
    }

    /// Opens the fastest device, without a window.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`] if no driver is installed, [`GpuError::NoDevice`].
    pub async fn open() -> Result<Self, GpuError> {
        let adapter = match adapter(wgpu::Backends::PRIMARY).await {
            Ok(adapter) => adapter,
            // OpenGL is the last choice: without a display it prints warnings.
            Err(_) => adapter(wgpu::Backends::all()).await?,
        };
        let name = adapter.get_info().name;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("carom"),
            // All limits of the adapter, so that pictures may be as large as it can draw.
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let opened = adapter.request_device(&descriptor).await;
        let (device, queue) =
            opened.map_err(|source| GpuError::NoDevice { adapter: name.clone(), source })?;
        Ok(Self { adapter: name, device, queue })
    }
}

/// Returns the fastest adapter of these backends.
async fn adapter(backends: wgpu::Backends) -> Result<wgpu::Adapter, wgpu::RequestAdapterError> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    let options = wgpu::RequestAdapterOptions {
        power_preference: wgpu::PowerPreference::HighPerformance,
        ..Default::default()
    };
    wgpu::Instance::new(descriptor).request_adapter(&options).await
}
