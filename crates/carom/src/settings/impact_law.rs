use std::fmt::{self, Display};

/// How the impacts of one instant are answered where several bodies touch.
///
/// All of them keep momentum, never gain energy, only push, and leave no contact closing. For a
/// single contact they are one and the same. `docs/physics/impacts.md`, "Impacts at one instant",
/// compares them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum ImpactLaw {
    /// Pair after pair, in the order of the contacts, until no contact closes. The result depends
    /// on the order, and breaks symmetries.
    Sequential,
    /// Newton's law of restitution at all contacts at once (Moreau 1988; Glocker 2001). Keeps
    /// symmetries; does not pass impacts on, as a Newton's cradle does.
    Simultaneous,
    /// Generalized reflection (Smith, Kaufman, Vouga, Tamstorf, Grinspun 2012). Keeps symmetries
    /// and passes impacts on.
    #[default]
    Reflection,
}

impl Display for ImpactLaw {
    /// As scene files write it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Sequential => "sequential",
            Self::Simultaneous => "simultaneous",
            Self::Reflection => "reflection",
        })
    }
}
