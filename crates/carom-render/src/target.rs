//! Textures that a picture is drawn into.

/// Format of finished pictures. Shaders encode sRGB themselves, because not every device can show a
/// texture of one format as another.
pub const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Textures of one size: the picture, its depth, and the samples if a pixel has several.
#[derive(Debug)]
pub struct Target {
    /// The finished picture, [`COLOR_FORMAT`].
    pub picture: wgpu::Texture,
    pub(crate) picture_view: wgpu::TextureView,
    pub(crate) depth: wgpu::TextureView,
    pub(crate) sampled: Option<wgpu::TextureView>,
    samples: u32,
}

impl Target {
    /// Makes textures of this size in pixels, each edge at least 1, with `samples` per pixel.
    pub(crate) fn new(device: &wgpu::Device, [width, height]: [u32; 2], samples: u32) -> Self {
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let texture = |label, format, sample_count, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size,
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let drawn = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let used = drawn | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let picture = texture("picture", COLOR_FORMAT, 1, used);
        let view = |texture: wgpu::Texture| texture.create_view(&Default::default());
        Self {
            picture_view: picture.create_view(&Default::default()),
            picture,
            depth: view(texture("depth", DEPTH_FORMAT, samples, drawn)),
            samples,
            sampled: (samples > 1).then(|| view(texture("samples", COLOR_FORMAT, samples, drawn))),
        }
    }

    /// Returns the samples per pixel.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Returns width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.picture.width(), self.picture.height()]
    }
}
