use glam::DVec3;

/// Change of the velocity along the normal \[m/s\] of a sphere that hits a fixed surface,
/// `-(1 + e) v·n`; `None` if it is not closing.
///
/// Source: the course's collision response; `docs/physics/impacts.md`, "Impact on a fixed surface".
///
/// - `velocity` \[m/s\] of the sphere; `normal`: unit vector from the surface to the sphere
/// - `restitution` e in \[0, 1\]
pub fn reflection(velocity: DVec3, normal: DVec3, restitution: f64) -> Option<f64> {
    let normal_velocity = velocity.dot(normal);
    (normal_velocity < 0.0).then(|| -(1.0 + restitution) * normal_velocity)
}
