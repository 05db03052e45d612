//! Explicit schemes: what they ask of the acceleration, and what they make of it.

use glam::DVec3;

use super::kinematics::Kinematics;

/// Stages of any scheme at most.
pub(super) const MOST_STAGES: usize = 4;

/// An explicit scheme. It is the same for one sphere by itself and for all of them side by side: the state
/// of each follows from its own start and its own accelerations.
pub(super) trait Scheme {
    /// Number of evaluations of the acceleration in a step, up to [`MOST_STAGES`].
    const STAGES: usize;
    /// Order of the error over a given time.
    const ORDER: u32;
    /// Weights of the accelerations of the stages in the change of the velocity, by the length of the step.
    const WEIGHTS: [f64; MOST_STAGES];

    /// The time from the start \[s\] and the state at which the next acceleration is due, after those that
    /// are `known` \[m/s²\].
    fn stage(start: Kinematics, h: f64, known: &[DVec3]) -> (f64, Kinematics);

    /// The state after `h` \[s\], from the accelerations of all stages \[m/s²\].
    fn end(start: Kinematics, h: f64, known: &[DVec3]) -> Kinematics;
}

/// The state of one sphere after `h` \[s\] under an acceleration `a(t, state)` \[m/s²\].
pub(super) fn advance<S: Scheme>(
    start: Kinematics,
    h: f64,
    acceleration: impl Fn(f64, Kinematics) -> DVec3,
) -> Kinematics {
    let mut known = [DVec3::ZERO; MOST_STAGES];
    for number in 0..S::STAGES {
        let (t, at) = S::stage(start, h, &known[..number]);
        known[number] = acceleration(t, at);
    }
    S::end(start, h, &known[..S::STAGES])
}
