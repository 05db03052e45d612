//! Poses in Unity's left-handed coordinates, and their conversion to right-handed ones.

use carom::{DQuat, DVec3};
use carom_scene::import::shortened;

/// Position, rotation and scale of an object in the world, in Unity's coordinates.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pose {
    /// Position \[m\].
    pub position: DVec3,
    /// Rotation, normalized.
    pub rotation: DQuat,
    /// Images of the local axes in the world, including their lengths.
    axes: [DVec3; 3],
}

impl Pose {
    /// Pose of the world.
    pub const WORLD: Self = Self {
        position: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        axes: [DVec3::X, DVec3::Y, DVec3::Z],
    };

    /// Pose of a child with this local position, rotation and scale.
    pub fn child(&self, position: DVec3, rotation: DQuat, scale: DVec3) -> Self {
        let axes = [DVec3::X * scale.x, DVec3::Y * scale.y, DVec3::Z * scale.z];
        Self {
            position: self.point(position),
            rotation: (self.rotation * rotation).normalize(),
            axes: axes.map(|axis| self.vector(rotation * axis)),
        }
    }

    /// Converts a local point to world coordinates.
    pub fn point(&self, local: DVec3) -> DVec3 {
        self.position + self.vector(local)
    }

    /// Absolute scale along the local axes; Unity's `lossyScale`.
    pub fn scale(&self) -> DVec3 {
        let local = self.local_axes();
        DVec3::new(local[0].x, local[1].y, local[2].z).abs()
    }

    /// Whether the scales of its parents shear the object.
    pub fn is_sheared(&self) -> bool {
        // Unity's numbers have 24 bits, so a smaller shear, relative to the scale, is a rounding
        // error.
        const ROUNDOFF: f64 = 1e-5;
        let [x, y, z] = self.local_axes();
        let beside = [x.y, x.z, y.x, y.z, z.x, z.y];
        beside.iter().any(|part| part.abs() > ROUNDOFF * self.scale().max_element())
    }

    /// Whether the scales mirror the object.
    pub fn is_mirrored(&self) -> bool {
        let [x, y, z] = self.axes;
        x.cross(y).dot(z) < 0.0
    }

    fn local_axes(&self) -> [DVec3; 3] {
        self.axes.map(|axis| self.rotation.inverse() * axis)
    }

    fn vector(&self, local: DVec3) -> DVec3 {
        self.axes[0] * local.x + self.axes[1] * local.y + self.axes[2] * local.z
    }
}

/// Converts a position or velocity of Unity to right-handed coordinates: mirrors z, and removes
/// rounding errors.
pub(crate) fn mirrored(vector: DVec3) -> [f64; 3] {
    shortened(DVec3::new(vector.x, vector.y, -vector.z).to_array())
}

/// Converts a rotation of Unity to right-handed coordinates.
pub(crate) fn mirrored_rotation(rotation: DQuat) -> [f64; 4] {
    let DQuat { x, y, z, w } = rotation;
    // Two decimals more than Unity's numbers have.
    [-x, -y, z, w].map(|part| rounded(part, 1e9))
}

/// Rounds a number to multiples of 1 / `per_unit`.
pub(crate) fn rounded(number: f64, per_unit: f64) -> f64 {
    let rounded = libm::rint(number * per_unit) / per_unit;
    // Turns -0 into 0.
    rounded + 0.0
}
