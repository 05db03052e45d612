//! Where things are: Unity's left-handed frame, and how it becomes a right-handed one.

use carom::{DQuat, DVec3};
use carom_scene::import::shortened;

/// Place, rotation and scale of an object in the world, in Unity's frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pose {
    /// In m.
    pub position: DVec3,
    /// Of unit length.
    pub rotation: DQuat,
    /// What the local axes become in the world, lengths included.
    axes: [DVec3; 3],
}

impl Pose {
    /// The world itself.
    pub const WORLD: Self = Self {
        position: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        axes: [DVec3::X, DVec3::Y, DVec3::Z],
    };

    /// What lies at this place, with this rotation and scale, in the frame of `self`.
    pub fn child(&self, position: DVec3, rotation: DQuat, scale: DVec3) -> Self {
        let axes = [DVec3::X * scale.x, DVec3::Y * scale.y, DVec3::Z * scale.z];
        Self {
            position: self.point(position),
            rotation: (self.rotation * rotation).normalize(),
            axes: axes.map(|axis| self.vector(rotation * axis)),
        }
    }

    /// A local point in the world.
    pub fn point(&self, local: DVec3) -> DVec3 {
        self.position + self.vector(local)
    }

    /// Lengths along the local axes, of what is 1 long in the local frame; Unity's `lossyScale`.
    pub fn scale(&self) -> DVec3 {
        let local = self.local_axes();
        DVec3::new(local[0].x, local[1].y, local[2].z).abs()
    }

    /// Whether the scales of its parents shear it.
    pub fn is_sheared(&self) -> bool {
        // Unity's numbers have 24 bits: what they shear by is round-off up to this part of the scale.
        const ROUNDOFF: f64 = 1e-5;
        let [x, y, z] = self.local_axes();
        let beside = [x.y, x.z, y.x, y.z, z.x, z.y];
        beside.iter().any(|part| part.abs() > ROUNDOFF * self.scale().max_element())
    }

    fn local_axes(&self) -> [DVec3; 3] {
        self.axes.map(|axis| self.rotation.inverse() * axis)
    }

    fn vector(&self, local: DVec3) -> DVec3 {
        self.axes[0] * local.x + self.axes[1] * local.y + self.axes[2] * local.z
    }
}

/// A place or velocity of Unity in a right-handed frame: z mirrored, and numbers as short as Unity's own.
pub(crate) fn mirrored(vector: DVec3) -> [f64; 3] {
    shortened(DVec3::new(vector.x, vector.y, -vector.z).to_array())
}

/// A rotation of Unity in a right-handed frame.
pub(crate) fn mirrored_rotation(rotation: DQuat) -> [f64; 4] {
    let DQuat { x, y, z, w } = rotation;
    // Two decimals more than Unity's numbers have.
    [-x, -y, z, w].map(|part| rounded(part, 1e9))
}

/// A number with so many steps per unit.
pub(crate) fn rounded(number: f64, per_unit: f64) -> f64 {
    let rounded = libm::rint(number * per_unit) / per_unit;
    // No -0.
    rounded + 0.0
}
