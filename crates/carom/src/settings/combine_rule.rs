/// Coefficient of restitution of a contact, from those of the two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum CombineRule {
    /// `e1 e2`: with a sphere of 1, the collider's value governs.
    #[default]
    Product,
    /// The smaller of the two.
    Minimum,
    /// The larger of the two.
    Maximum,
    /// `(e1 + e2) / 2`.
    Average,
}
