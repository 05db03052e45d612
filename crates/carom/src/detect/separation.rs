use glam::DVec3;

/// Distance and direction between two bodies.
///
/// Body 1 is the collider, or the first sphere of a pair; body 2 is a sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separation {
    /// Distance between the two surfaces \[m\]; negative where they overlap.
    pub distance: f64,
    /// Unit normal, from body 1 to body 2.
    pub normal: DVec3,
    /// Where the surface of body 1 is nearest to body 2 \[m\].
    pub point: DVec3,
}

impl Separation {
    /// Between the point `point` of body 1 and a sphere about `center`; `normal_at_zero` where
    /// the centre falls on the point and no direction is left.
    pub(super) fn from_point(
        point: DVec3,
        center: DVec3,
        radius: f64,
        normal_at_zero: DVec3,
    ) -> Self {
        let offset = center - point;
        let length = offset.dot(offset).sqrt();
        let normal = if length > 0.0 { offset / length } else { normal_at_zero };
        Self { distance: length - radius, normal, point }
    }
}
