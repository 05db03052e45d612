use glam::DVec3;

/// A plane at which a force bends or jumps when the centre of a sphere passes it: the points x with `normal · x = height`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceEdge {
    /// Unit normal.
    pub normal: DVec3,
    /// Distance of the plane from the origin, along the normal \[m\].
    pub height: f64,
}
