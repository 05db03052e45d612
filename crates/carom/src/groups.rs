//! Groups: which bodies meet at all.

/// The groups that a body is in, and those that it collides with: one bit for each of 32 groups.
///
/// Two bodies collide if each is in a group that the other collides with. By default a body is in the first group
/// and collides with all.
///
/// ```
/// use carom::{DVec3, Groups, Sphere, World};
///
/// let ghost = Groups { groups: 0b10, collides_with: 0b10 };
/// let mut world = World::default();
/// let ball = Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X);
/// world.add_sphere(ball)?;
/// world.add_sphere(Sphere::new(DVec3::new(2.0, 0.0, 0.0), 0.5).with_groups(ghost))?;
/// assert!(world.step(5.0)?.impacts.is_empty());
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Groups {
    /// Groups that it is in.
    pub groups: u32,
    /// Groups that it collides with.
    pub collides_with: u32,
}

impl Default for Groups {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl Groups {
    /// Groups of a body in the first group that collides with all.
    pub const DEFAULT: Self = Self { groups: 1, collides_with: u32::MAX };

    /// Whether two bodies in these groups collide.
    #[inline]
    pub fn collides(self, other: Self) -> bool {
        self.groups & other.collides_with != 0 && other.groups & self.collides_with != 0
    }
}
