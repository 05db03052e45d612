/// How positions and velocities advance by a time step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Integrator {
    /// Velocity first, then position with the new velocity. First order, symplectic.
    #[default]
    SemiImplicitEuler,
    /// Position with the old velocity, then velocity. First order; gains energy.
    ExplicitEuler,
    /// Position by its Taylor series, velocity by the mean acceleration. Second order.
    VelocityVerlet,
    /// The classical four-stage Runge-Kutta scheme. Fourth order.
    RungeKutta4,
}
