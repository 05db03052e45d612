//! A span of time.

/// A step, or its part up to some time, on the world's clock \[s\].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Span {
    /// Beginning of the step.
    pub start: f64,
    /// Length of the step \[s\].
    pub length: f64,
    /// End of the part.
    pub end: f64,
}
