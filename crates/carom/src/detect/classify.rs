/// State of two bodies at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ContactState {
    /// Apart, or leaving each other: no collision.
    Separate,
    /// At touching distance, neither closing nor opening, and pressed together.
    Resting,
    /// At touching distance and closing.
    Colliding,
    /// Overlapping and closing.
    Intersecting,
}

/// The contact state of two bodies (`bisect` rule, `docs/physics/detection.md`).
///
/// - `distance` \[m\] between their surfaces, negative where they overlap
/// - `tolerance` \[m\]: a distance within plus or minus this is touching distance
/// - `normal_velocity` \[m/s\] of body 2 relative to body 1 along the normal from 1 to 2; closing
///   is negative
/// - `normal_acceleration` \[m/s²\] of body 2 relative to body 1 along the normal; computed only where
///   the velocity leaves the state open
pub fn classify(
    distance: f64,
    tolerance: f64,
    normal_velocity: f64,
    normal_acceleration: impl FnOnce() -> f64,
) -> ContactState {
    let closing = normal_velocity < 0.0;
    if distance > tolerance {
        ContactState::Separate
    } else if distance < -tolerance {
        // Stationary or moving apart is no collision: it was answered before.
        if closing { ContactState::Intersecting } else { ContactState::Separate }
    } else if closing {
        ContactState::Colliding
    } else if normal_velocity == 0.0 && normal_acceleration() < 0.0 {
        ContactState::Resting
    } else {
        ContactState::Separate
    }
}
