use std::fmt::{self, Display};

/// How the impacts of one instant are answered where several bodies touch.
///
/// All laws conserve momentum, never gain energy, only push, and leave no contact closing. For a single contact
/// they agree. `docs/physics/impacts.md`, "Impacts at one instant", compares them.
///
/// ```
/// use carom::{DVec3, Error, Exact, ImpactLaw, Settings, Sphere, World};
///
/// /// Speeds of a row of three spheres that touch, after another one has hit the first.
/// fn speeds(law: ImpactLaw) -> Result<[f64; 4], Error> {
///     let rule = Exact::default().with_impact_law(law);
///     let mut world = World::new(Settings::default().with_rule(rule))?;
///     let at = |x| Sphere::new(DVec3::new(x, 0.0, 0.0), 0.5);
///     world.add_sphere(at(-1.5).with_velocity(DVec3::X))?;
///     for x in [0.0, 1.0, 2.0] {
///         world.add_sphere(at(x))?;
///     }
///     world.step(1.0)?;
///     Ok([0, 1, 2, 3].map(|index| world.spheres().velocities()[index].x))
/// }
///
/// // As in Newton's cradle, the last one flies off.
/// assert_eq!(speeds(ImpactLaw::Reflection)?, [0.0, 0.0, 0.0, 1.0]);
/// // Here the first bounces back, and the row moves on as a whole.
/// assert_eq!(speeds(ImpactLaw::Simultaneous)?, [-0.5, 0.5, 0.5, 0.5]);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
    /// Writes the law as scene files do.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Sequential => "sequential",
            Self::Simultaneous => "simultaneous",
            Self::Reflection => "reflection",
        })
    }
}
