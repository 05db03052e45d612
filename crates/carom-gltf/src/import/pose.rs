//! Poses of nodes.

use carom::{DQuat, DVec3};
use carom_scene::import::shortened;
use glam::DMat3;

use crate::document::Node;

/// Position, rotation and scale of a node in the world.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pose {
    /// Position \[m\].
    pub position: DVec3,
    /// Rotation, normalized.
    pub rotation: DQuat,
    /// Images of the local axes in the world, including their lengths.
    axes: [DVec3; 3],
    /// Scale as stated in the file, if no parent changes any number.
    written_scale: Option<DVec3>,
}

impl Pose {
    /// Pose of the world.
    pub const WORLD: Self = Self {
        position: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        axes: [DVec3::X, DVec3::Y, DVec3::Z],
        written_scale: Some(DVec3::ONE),
    };

    /// Pose of a child node; `None` if its transformation is invalid.
    pub fn child(&self, node: &Node) -> Option<Self> {
        let numbers = |it: &[f64; 3]| DVec3::from_array(it.map(written));
        let (position, rotation, axes, scale) = match &node.matrix {
            Some(matrix) => {
                let column =
                    |i: usize| DVec3::new(matrix[4 * i], matrix[4 * i + 1], matrix[4 * i + 2]);
                let axes = [column(0), column(1), column(2)];
                (column(3), rotation_of(axes), axes, None)
            }
            None => {
                let scale = node.scale.as_ref().map_or(DVec3::ONE, numbers);
                let rotation = node.rotation.map_or(DQuat::IDENTITY, DQuat::from_array);
                let rotation = (rotation.length_squared() > 0.0).then(|| rotation.normalize())?;
                let axes = [DVec3::X * scale.x, DVec3::Y * scale.y, DVec3::Z * scale.z];
                let position = node.translation.as_ref().map_or(DVec3::ZERO, numbers);
                (position, rotation, axes.map(|axis| rotation * axis), Some(scale))
            }
        };
        let is_root = self.axes == Self::WORLD.axes && self.position == DVec3::ZERO;
        let child = Self {
            position: self.point(position),
            rotation: if is_root { rotation } else { (self.rotation * rotation).normalize() },
            axes: axes.map(|axis| self.vector(axis)),
            written_scale: scale.filter(|_| is_root && self.written_scale.is_some()),
        };
        let numbers = child.axes.into_iter().chain([child.position]);
        let is_finite = numbers.into_iter().all(DVec3::is_finite) && child.rotation.is_finite();
        is_finite.then_some(child)
    }

    /// Pose at a local point, with a local rotation.
    pub fn at(&self, point: DVec3, rotation: DQuat) -> Self {
        let is_unmoved = point == DVec3::ZERO && rotation == DQuat::IDENTITY;
        if is_unmoved {
            return *self;
        }
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        Self {
            position: self.point(point),
            rotation: (self.rotation * rotation).normalize(),
            axes: axes.map(|axis| self.vector(rotation * axis)),
            written_scale: None,
        }
    }

    /// Scale along the local axes; negative if mirrored.
    pub fn scale(&self) -> DVec3 {
        self.written_scale.unwrap_or_else(|| {
            let [x, y, z] = self.local_axes();
            DVec3::new(x.x, y.y, z.z)
        })
    }

    /// Whether the scales of its parents shear the node.
    pub fn is_sheared(&self) -> bool {
        // Numbers have 24 bits, so a smaller shear, relative to the scale, is a rounding error.
        const ROUNDOFF: f64 = 1e-5;
        let [x, y, z] = self.local_axes();
        let beside = [x.y, x.z, y.x, y.z, z.x, z.y];
        beside.iter().any(|part| part.abs() > ROUNDOFF * self.scale().abs().max_element())
    }

    /// Position for a scene, without the rounding errors of parents.
    pub fn written_position(&self) -> [f64; 3] {
        let position = self.position.to_array();
        if self.written_scale.is_some() { position } else { shortened(position) }
    }

    /// Scaled length for a scene, without the rounding errors of parents.
    pub fn written_length(&self, length: f64) -> f64 {
        if self.written_scale.is_some() { length } else { shortened([length])[0] }
    }

    fn local_axes(&self) -> [DVec3; 3] {
        self.axes.map(|axis| self.rotation.inverse() * axis)
    }

    fn point(&self, local: DVec3) -> DVec3 {
        self.position + self.vector(local)
    }

    fn vector(&self, local: DVec3) -> DVec3 {
        self.axes[0] * local.x + self.axes[1] * local.y + self.axes[2] * local.z
    }
}

/// Shortens a number that another program wrote with all digits of its 32 bits: 0.10000000149011612
/// becomes 0.1. Returns other numbers unchanged.
pub(super) fn written(number: f64) -> f64 {
    let narrow = number as f32;
    let is_narrow = f64::from(narrow) == number;
    if is_narrow { narrow.to_string().parse().unwrap_or(number) } else { number }
}

/// Rotation of axes that may be scaled and sheared. It keeps the direction of y, and the side of x.
fn rotation_of([x, y, z]: [DVec3; 3]) -> DQuat {
    let y = y.try_normalize().or_else(|| z.cross(x).try_normalize()).unwrap_or(DVec3::Y);
    let x = (x - y * x.dot(y)).try_normalize().unwrap_or_else(|| y.any_orthonormal_vector());
    DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y))).normalize()
}
