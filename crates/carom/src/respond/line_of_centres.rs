use glam::DVec3;

/// Velocities \[m/s\] after two movable spheres hit each other, and the impulse \[N s\] between
/// them; `None` if they are not closing.
///
/// `j = -(1 + e) (v2 - v1)·n / (1/m1 + 1/m2)`, along the line of centres; tangential parts are
/// unchanged. Momentum is conserved always, kinetic energy for `e = 1`, both to round-off.
/// Source: conservation of momentum with Newton's law of restitution (Goldsmith, "Impact", 1960);
/// derived in `docs/physics/impacts.md`, "Impact of two spheres".
///
/// - `velocities` \[m/s\], `masses` \[kg\] of spheres 1 and 2
/// - `normal`: unit vector from 1 to 2; `restitution` e in \[0, 1\]
pub fn line_of_centres(
    velocities: [DVec3; 2],
    masses: [f64; 2],
    normal: DVec3,
    restitution: f64,
) -> Option<([DVec3; 2], f64)> {
    let [v1, v2] = velocities;
    let [m1, m2] = masses;
    let normal_velocity = (v2 - v1).dot(normal);
    if normal_velocity >= 0.0 {
        return None;
    }
    let impulse = -(1.0 + restitution) * normal_velocity * reduced_mass(masses);
    Some(([v1 - impulse / m1 * normal, v2 + impulse / m2 * normal], impulse))
}

/// Returns the reduced mass `m1 m2 / (m1 + m2)` \[kg\], in a form that neither overflows nor underflows.
pub(crate) fn reduced_mass([m1, m2]: [f64; 2]) -> f64 {
    m1.min(m2) / (1.0 + m1.min(m2) / m1.max(m2))
}
