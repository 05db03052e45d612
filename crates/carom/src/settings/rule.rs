use super::{Bisect, Contact, Discrete, Exact};

/// Step rule: how a world advances by a frame.
///
/// ```
/// use carom::{Bisect, Collider, DVec3, Discrete, Error, Exact, Pose, Rule, Settings, Shape};
/// use carom::{Sphere, World};
///
/// /// Height of a sphere after a frame in which it crosses a rectangle at height 0.
/// fn height(rule: impl Into<Rule>) -> Result<f64, Error> {
///     let mut world = World::new(Settings::default().with_rule(rule))?;
///     let plate = Shape::Rectangle { size_x: 1.0, size_z: 1.0 };
///     world.add_collider(Collider::new(plate, Pose::at(DVec3::ZERO)))?;
///     let fast = Sphere::new(DVec3::Y, 0.1).with_velocity(DVec3::new(0.0, -20.0, 0.0));
///     let fast = world.add_sphere(fast)?;
///     world.step(0.1)?;
///     Ok(world.sphere(fast)?.position.y)
/// }
///
/// assert!(height(Exact::default())? > 0.0);
/// // It was above the rectangle before the frame, and is below it after.
/// assert!(height(Bisect::default())? < 0.0);
/// assert!(height(Discrete::default())? < 0.0);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Rule {
    /// The course's rule: move every sphere by the frame, then answer what overlaps at its end.
    ///
    /// Fast, but contacts are found late, and a sphere that crosses a surface within a frame
    /// passes through it.
    Discrete(Discrete),
    /// The tutorial's rule: where spheres intersect at the end of the frame, wind them back, find
    /// the time of contact by bisection, answer it there and go on with the rest of the frame.
    ///
    /// A contact that begins and ends within a frame is still missed.
    Bisect(Bisect),
    /// Carom's own rule: spheres fly in closed form from one event to the next, and every impact happens at its own
    /// time, however many there are in a frame and however fast they are. A frame only sets when results are read.
    Exact(Exact),
    /// The rule for heaps, friction and games: frames are cut into sub-steps, and in each the contacts
    /// of all spheres are solved together. Its cost does not depend on how many impacts there are.
    ///
    /// Times of impact are those of a sub-step, and overlaps small but not zero.
    Contact(Contact),
}

impl Rule {
    /// Returns whether friction acts under the rule.
    pub fn has_friction(&self) -> bool {
        matches!(self, Self::Exact(_) | Self::Contact(_))
    }
}

impl Default for Rule {
    fn default() -> Self {
        Self::Exact(Exact::default())
    }
}

impl From<Discrete> for Rule {
    fn from(parameters: Discrete) -> Self {
        Self::Discrete(parameters)
    }
}

impl From<Bisect> for Rule {
    fn from(parameters: Bisect) -> Self {
        Self::Bisect(parameters)
    }
}

impl From<Exact> for Rule {
    fn from(parameters: Exact) -> Self {
        Self::Exact(parameters)
    }
}

impl From<Contact> for Rule {
    fn from(parameters: Contact) -> Self {
        Self::Contact(parameters)
    }
}
