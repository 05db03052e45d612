/// Coefficient of a contact, of restitution or friction, from those of the two bodies.
///
/// ```
/// use carom::CombineRule;
///
/// assert_eq!(CombineRule::Product.combine(0.5, 0.8), 0.4);
/// assert_eq!(CombineRule::Minimum.combine(0.5, 0.8), 0.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
    /// `sqrt(e1 e2)`.
    GeometricMean,
}
