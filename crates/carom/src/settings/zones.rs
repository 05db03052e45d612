/// Whether the rule `exact` steps spheres in contact whose single impacts would take too much work.
///
/// ```
/// use carom::{Collider, DVec3, Error, Exact, Force, Gravity, Pose, Settings, Shape, Sphere, World, Zones};
///
/// /// The spheres that were stepped while a block of balls fell into a box.
/// fn stepped(zones: Zones) -> Result<u32, Error> {
///     let exact = Exact::default().with_zones(zones).with_zone_budget(100);
///     let mut world = World::new(Settings::default().with_rule(exact))?;
///     world.add_force(Gravity::new(-9.81 * DVec3::Y));
///     world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)))?;
///     for number in 0..8 {
///         let place = DVec3::new(0.2 * f64::from(number % 4), 0.5 + 0.2 * f64::from(number / 4), 0.0);
///         world.add_sphere(Sphere::new(place, 0.1).with_restitution(0.5))?;
///     }
///     let mut most = 0;
///     for _ in 0..30 {
///         most = most.max(world.step(1.0 / 60.0)?.zone_account.spheres);
///     }
///     Ok(most)
/// }
///
/// assert_eq!(stepped(Zones::Never)?, 0);
/// assert!(stepped(Zones::Automatic)? > 0);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Zones {
    /// Spheres whose contacts take more work than [`Exact::zone_budget`](crate::Exact::zone_budget) are
    /// stepped as by the rule `contact`, until they have come apart.
    #[default]
    Automatic,
    /// Every impact is answered, whatever it takes; more work than
    /// [`Exact::max_impacts`](crate::Exact::max_impacts) is an error.
    Never,
}
