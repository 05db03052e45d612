//! Which contacts bear an impact: the active sets of the impact law.

/// The projections of which the law `Reflection` makes its answer, each with the contacts that bear it.
#[derive(Debug, Clone, Default)]
pub(in crate::tangent) struct Plan {
    pub layers: Vec<Layer>,
    /// What bears the plastic answer after friction; none if nothing closes then.
    pub plastic: Option<Vec<usize>>,
}

/// A layer of restitution.
#[derive(Debug, Clone)]
pub(in crate::tangent) struct Layer {
    /// Restitution at its end; contacts of less are plastic.
    pub level: f64,
    pub projections: Vec<Vec<usize>>,
}
