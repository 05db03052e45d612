use super::Integrator;

/// Parameters of the rule `discrete`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Discrete {
    /// The scheme that moves spheres over a frame.
    pub integrator: Integrator,
}

impl Discrete {
    /// Returns the parameters with this integrator.
    pub fn with_integrator(self, integrator: Integrator) -> Self {
        Self { integrator }
    }
}
