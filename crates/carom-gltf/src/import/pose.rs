//! Where nodes are.

use carom::{DQuat, DVec3};
use carom_scene::import::shortened;
use glam::DMat3;

use crate::document::Node;

/// Place, rotation and scale of a node in the world.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pose {
    /// \[m\]
    pub position: DVec3,
    /// Of length 1.
    pub rotation: DQuat,
    /// What the local axes become in the world, lengths included.
    axes: [DVec3; 3],
    /// The scale as the file says it, where no parent changes any number.
    written_scale: Option<DVec3>,
}

impl Pose {
    /// The world itself.
    pub const WORLD: Self = Self {
        position: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        axes: [DVec3::X, DVec3::Y, DVec3::Z],
        written_scale: Some(DVec3::ONE),
    };

    /// The pose of a child of a node at this pose; `None` where its numbers make no pose.
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

    /// The pose at a local point, turned by a local rotation.
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

    /// Lengths along the local axes of what is 1 long in the local frame; negative where it is mirrored.
    pub fn scale(&self) -> DVec3 {
        self.written_scale.unwrap_or_else(|| {
            let [x, y, z] = self.local_axes();
            DVec3::new(x.x, y.y, z.z)
        })
    }

    /// Whether the scales of its parents shear it.
    pub fn is_sheared(&self) -> bool {
        // Numbers have 24 bits: what they shear by is round-off up to this part of the scale.
        const ROUNDOFF: f64 = 1e-5;
        let [x, y, z] = self.local_axes();
        let beside = [x.y, x.z, y.x, y.z, z.x, z.y];
        beside.iter().any(|part| part.abs() > ROUNDOFF * self.scale().abs().max_element())
    }

    /// The position as a scene has it: without the round-off of parents.
    pub fn written_position(&self) -> [f64; 3] {
        let position = self.position.to_array();
        if self.written_scale.is_some() { position } else { shortened(position) }
    }

    /// A length as a scene has it, which this pose has scaled.
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

/// A number that other programs wrote with all digits of its 32 bits, with as few as it needs: 0.1 for
/// 0.10000000149011612. All others as they are.
pub(super) fn written(number: f64) -> f64 {
    let narrow = number as f32;
    let is_narrow = f64::from(narrow) == number;
    if is_narrow { narrow.to_string().parse().unwrap_or(number) } else { number }
}

/// The rotation of axes that scales and shears may have changed: that keeps the direction of y, and the side
/// of x.
fn rotation_of([x, y, z]: [DVec3; 3]) -> DQuat {
    let y = y.try_normalize().or_else(|| z.cross(x).try_normalize()).unwrap_or(DVec3::Y);
    let x = (x - y * x.dot(y)).try_normalize().unwrap_or_else(|| y.any_orthonormal_vector());
    DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y))).normalize()
}
