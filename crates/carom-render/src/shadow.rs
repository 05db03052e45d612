//! How lights see a scene: the sun, and the sky straight above.

use carom::DVec3;
use glam::{Mat4, Vec3, Vec4};

/// Orthographic view along a light.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LightView {
    /// Transformation from positions relative to the eye to the light's map.
    pub map_from_eye: Mat4,
    /// The direction in which light travels, and two directions across it.
    pub axes: [Vec3; 3],
    /// Size of a texel \[m\].
    pub texel: f32,
    /// Texels along an edge.
    texels: u32,
}

impl LightView {
    /// Returns the view from the direction `to_light` (unit vector) that covers a ball of this
    /// centre and radius \[m\] with `texels` along an edge. It follows the ball in whole texels and
    /// grows in steps, so that edges of shadows do not move.
    pub fn around(
        (center, radius): (DVec3, f64),
        to_light: DVec3,
        eye: DVec3,
        texels: u32,
    ) -> Self {
        let side = if to_light.y.abs() > 0.99 { DVec3::X } else { DVec3::Y };
        let right = side.cross(to_light).normalize();
        let up = to_light.cross(right);
        // Steps of a quarter of an octave.
        let half = (radius.max(1e-6).log2() * 4.0).ceil() / 4.0;
        let half = half.exp2() * 1.02;
        let texel = 2.0 * half / f64::from(texels);
        let snap = |along: DVec3| (center.dot(along) / texel).round() * texel;
        let center = right * snap(right) + up * snap(up) + to_light * center.dot(to_light);
        let from_center = (center - eye).as_vec3();
        let axes = [right, up, to_light].map(|axis| axis.as_vec3());
        let scale = 1.0 / half as f32;
        // Rows: across, across, and depth from 0 (nearest to the light) to 1.
        let row = |axis: Vec3, scale: f32, offset: f32| {
            (axis * scale).extend(offset - axis.dot(from_center) * scale)
        };
        let rows = Mat4::from_cols(
            row(axes[0], scale, 0.0),
            row(axes[1], scale, 0.0),
            row(axes[2], -0.5 * scale, 0.5),
            Vec4::W,
        );
        Self {
            map_from_eye: rows.transpose(),
            axes: [-axes[2], axes[0], axes[1]],
            texel: texel as f32,
            texels,
        }
    }

    /// Returns the part of an edge that this view uses, in a map of `map_texels` along an edge.
    pub fn part_of(&self, map_texels: u32) -> f32 {
        self.texels as f32 / map_texels as f32
    }

    /// Packs the view for the shader.
    pub fn packed(&self) -> [f32; 28] {
        let mut packed = [0.0; 28];
        packed[..16].copy_from_slice(&self.map_from_eye.to_cols_array());
        for (place, axis) in packed[16..].chunks_exact_mut(4).zip(self.axes) {
            place[..3].copy_from_slice(&axis.to_array());
        }
        packed
    }
}
