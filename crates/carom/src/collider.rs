//! Fixed colliders: shapes that spheres bounce off.

use glam::DVec3;

use crate::collider_motion::{Course, Motion};
use crate::error::InvalidValue;
use crate::friction::Friction;
use crate::groups::Groups;
use crate::mesh::Mesh;
use crate::pose::Pose;
use crate::restitution::RestitutionLaw;
use crate::validate;

/// Form of a collider in its own frame.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Shape {
    /// A sphere about the origin.
    Sphere {
        /// Radius \[m\], > 0.
        radius: f64,
    },
    /// A rectangle in the local xz plane about the origin, with edges and corners. Its front
    /// faces local +y; a sphere whose centre is behind it passes.
    Rectangle {
        /// Full length along local x \[m\], > 0.
        size_x: f64,
        /// Full length along local z \[m\], > 0.
        size_z: f64,
    },
    /// Everything below the local xz plane; solid however deep a sphere is in it.
    HalfSpace,
    /// A box about the origin, made of six outward rectangles.
    Box {
        /// Full lengths along local x, y, z \[m\], each > 0.
        size: DVec3,
    },
    /// A hollow box about the origin: walls without thickness, off which spheres bounce on either
    /// side.
    Container {
        /// Full lengths along local x, y, z \[m\], each > 0.
        size: DVec3,
        /// Where there is no wall.
        open: Sides,
    },
    /// A solid cylinder about the local y axis, half of it above the origin.
    Cylinder {
        /// Radius \[m\], > 0.
        radius: f64,
        /// Full length along local y \[m\], > 0.
        height: f64,
    },
    /// A solid cone, or the frustum of one, about the local y axis, half of its height above the origin.
    Cone {
        /// Radius at the lower end \[m\], >= 0.
        bottom_radius: f64,
        /// Radius at the upper end \[m\], >= 0. One of the two is > 0.
        top_radius: f64,
        /// Full length along local y \[m\], > 0.
        height: f64,
    },
    /// All within a radius of a line along local y about the origin.
    Capsule {
        /// Radius \[m\], > 0.
        radius: f64,
        /// Length of the line \[m\], > 0: the capsule is longer by twice the radius.
        length: f64,
    },
    /// A disc in the local xz plane about the origin. Its front faces local +y; a sphere whose centre is behind it
    /// passes.
    Disc {
        /// Radius \[m\], > 0.
        radius: f64,
    },
    /// A solid ring about the local y axis: all within a radius of a circle in the local xz plane.
    Torus {
        /// Radius of the circle \[m\], larger than that of the tube.
        ring_radius: f64,
        /// Radius of the tube \[m\], > 0.
        tube_radius: f64,
    },
    /// A hollow cylinder about the local y axis, half of it above the origin: a wall without thickness, off which
    /// spheres bounce on either side.
    Pipe {
        /// Radius \[m\], > 0.
        radius: f64,
        /// Full length along local y \[m\], > 0.
        length: f64,
        /// Which ends a disc closes.
        closed: Ends,
    },
    /// A hollow sphere about the origin that is open towards local +y: a wall without thickness, off which spheres
    /// bounce on either side.
    Bowl {
        /// Radius \[m\], > 0.
        radius: f64,
        /// Angle between local +y and the rim, as seen from the origin \[rad\], in [0, π): 0 of a whole sphere, π/2 of
        /// half of one.
        opening: f64,
    },
    /// A hollow cone about the local y axis, half of its height above the origin and open at both ends: a wall without
    /// thickness, off which spheres bounce on either side.
    Funnel {
        /// Radius of the lower opening \[m\], >= 0.
        bottom_radius: f64,
        /// Radius of the upper opening \[m\], >= 0. One of the two is > 0.
        top_radius: f64,
        /// Full length along local y \[m\], > 0.
        height: f64,
    },
    /// A surface of triangles, or a height field.
    Mesh(Mesh),
}

/// Some of the two ends of a pipe.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ends {
    /// Towards -y.
    pub bottom: bool,
    /// Towards +y.
    pub top: bool,
}

impl Ends {
    /// No end.
    pub const NONE: Self = Self { bottom: false, top: false };
    /// Both ends.
    pub const BOTH: Self = Self { bottom: true, top: true };
}

/// Some of the six sides of a box, in its own frame.
///
/// ```
/// use carom::Sides;
///
/// let open = Sides { top: true, ..Sides::NONE };
/// assert_eq!(open, Sides::from_array([false, false, false, true, false, false]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sides {
    /// Towards -x.
    pub left: bool,
    /// Towards +x.
    pub right: bool,
    /// Towards -y.
    pub bottom: bool,
    /// Towards +y.
    pub top: bool,
    /// Towards -z.
    pub back: bool,
    /// Towards +z.
    pub front: bool,
}

impl Sides {
    /// No side.
    pub const NONE: Self = Self::from_array([false; 6]);
    /// All sides.
    pub const ALL: Self = Self::from_array([true; 6]);

    /// Creates the sides from one flag each, towards -x, +x, -y, +y, -z, +z.
    pub const fn from_array([left, right, bottom, top, back, front]: [bool; 6]) -> Self {
        Self { left, right, bottom, top, back, front }
    }

    /// Whether those towards -x, +x, -y, +y, -z, +z are among them.
    pub const fn to_array(self) -> [bool; 6] {
        let Self { left, right, bottom, top, back, front } = self;
        [left, right, bottom, top, back, front]
    }
}

/// A shape in the world that no impact moves, at rest or moved by a program.
///
/// ```
/// use carom::{Collider, DQuat, DVec3, Pose, Shape, Sphere, World};
///
/// // A wall that faces the sphere, and comes towards it.
/// let towards_sphere = DQuat::from_rotation_arc(DVec3::Y, DVec3::NEG_X);
/// let wall = Collider::new(Shape::HalfSpace, Pose::at(DVec3::X).rotated(towards_sphere))
///     .moving(DVec3::NEG_X, DVec3::ZERO)
///     .with_restitution(0.5);
/// let mut world = World::default();
/// let id = world.add_collider(wall)?;
/// let sphere = world.add_sphere(Sphere::new(DVec3::ZERO, 0.5))?;
/// world.step(1.0)?;
/// assert_eq!(world.collider(id)?.pose.position, DVec3::ZERO);
/// // It leaves the wall with half the speed at which they met.
/// assert!((world.sphere(sphere)?.velocity.x + 1.5).abs() < 1e-12);
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Collider {
    /// Form in the local frame.
    pub shape: Shape,
    /// Place of the local frame in the world.
    pub pose: Pose,
    /// Velocity of the origin of the local frame \[m/s\]; a step moves the pose on.
    pub velocity: DVec3,
    /// Angular velocity about the origin of the local frame, along the axis of rotation \[rad/s\].
    pub angular_velocity: DVec3,
    /// Velocity of the material along the surface \[m/s\], in the local frame: that of a conveyor belt. The shape stays
    /// where its motion puts it. Friction acts against the velocity of the material, which is that of the surface plus
    /// the part of this across the normal; without friction it has no effect.
    pub surface_velocity: DVec3,
    /// Motion, if it is not steady. In a world, pose, velocity and angular velocity are then those of the motion at
    /// the present time; a new pose there moves the whole motion.
    pub motion: Motion,
    /// Coefficient of restitution in \[0, 1\].
    pub restitution: f64,
    /// Law of restitution, instead of `restitution`: `None` unless given.
    pub restitution_law: Option<RestitutionLaw>,
    /// Friction at its surface; `None` in each coefficient unless given.
    pub friction: Friction,
    /// Compliance of the surface, if it has any: the frequency of its vibration across the normal divided by that along
    /// it, in \[1, 2\]. Friction in impacts then follows Stronge's law instead of the tangential restitution: the
    /// contact slips, sticks and slips as its two springs are pressed and relax.
    ///
    /// Source: W. J. Stronge, Impact Mechanics, Cambridge 2000, section 5.1. 1.7 in pooltool, for cushions of a pool
    /// table.
    pub cushion: Option<f64>,
    /// A trigger reports contact and deflects nothing.
    pub trigger: bool,
    /// Whether a sphere that enters this trigger leaves the world at the end of the step, as in the pocket of a billiard
    /// table. Its energy is in [`EnergyAccount::emission`](crate::EnergyAccount::emission).
    pub captures: bool,
    /// Speed \[m/s\], >= 0, that an impact adds along the normal, as the bumpers of a pinball machine do: a sphere
    /// that comes with v leaves with `e v + kick`. Its energy is in
    /// [`EnergyAccount::kicks`](crate::EnergyAccount::kicks).
    pub kick: f64,
    /// Groups of spheres with which it collides, or which a trigger reports.
    pub groups: Groups,
    /// Number of its material for [`World::set_material_pairs`](crate::World::set_material_pairs); 0, for none, unless
    /// given.
    pub material: u8,
    /// A number for the program; the physics does not use it.
    pub user_data: u64,
}

impl Collider {
    /// A solid collider with restitution 1.
    pub fn new(shape: Shape, pose: Pose) -> Self {
        Self {
            shape,
            pose,
            velocity: DVec3::ZERO,
            angular_velocity: DVec3::ZERO,
            surface_velocity: DVec3::ZERO,
            motion: Motion::default(),
            restitution: 1.0,
            restitution_law: None,
            friction: Friction::default(),
            cushion: None,
            trigger: false,
            captures: false,
            kick: 0.0,
            groups: Groups::DEFAULT,
            material: 0,
            user_data: 0,
        }
    }

    /// Whether it is a mesh that spheres pass from behind.
    pub(crate) fn is_open_mesh(&self) -> bool {
        matches!(&self.shape, Shape::Mesh(mesh) if mesh.is_one_sided() && !mesh.is_closed())
    }

    /// Returns the collider with this shape.
    pub fn with_shape(self, shape: Shape) -> Self {
        Self { shape, ..self }
    }

    /// Returns the collider in this pose.
    pub fn with_pose(self, pose: Pose) -> Self {
        Self { pose, ..self }
    }

    /// Returns the collider with this motion: velocity \[m/s\] of its origin, angular velocity \[rad/s\]
    /// about it. Spheres feel the velocity of the surface where they meet it.
    pub fn moving(self, velocity: DVec3, angular_velocity: DVec3) -> Self {
        Self { velocity, angular_velocity, ..self }
    }

    /// Returns the collider with this velocity of its material along the surface \[m/s\], in its own frame.
    ///
    /// ```
    /// use carom::{Collider, DVec3, Gravity, Pose, Shape, Sphere, World};
    ///
    /// let belt = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))
    ///     .with_surface_velocity(DVec3::X)
    ///     .with_friction(0.5);
    /// let mut world = World::default();
    /// world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0)))?;
    /// world.add_collider(belt)?;
    /// let ball = world.add_sphere(Sphere::new(0.1 * DVec3::Y, 0.1).with_restitution(0.0))?;
    /// world.step(1.0)?;
    /// // A ball that is laid on a belt slides and then rolls at 2/7 of the belt's speed.
    /// assert!((world.sphere(ball)?.velocity.x - 2.0 / 7.0).abs() < 1e-12);
    /// # Ok::<(), carom::Error>(())
    /// ```
    pub fn with_surface_velocity(self, surface_velocity: DVec3) -> Self {
        Self { surface_velocity, ..self }
    }

    /// Returns the collider with this motion; several motions act one after the other.
    pub fn with_motion(self, motion: impl Into<Motion>) -> Self {
        Self { motion: motion.into(), velocity: DVec3::ZERO, angular_velocity: DVec3::ZERO, ..self }
    }

    /// Returns the collider with this coefficient of restitution, without a law.
    pub fn with_restitution(self, restitution: f64) -> Self {
        Self { restitution, restitution_law: None, ..self }
    }

    /// Returns the collider with this law of restitution.
    pub fn with_restitution_law(self, law: RestitutionLaw) -> Self {
        Self { restitution_law: Some(law), ..self }
    }

    /// Returns the collider of this material.
    pub fn with_material(self, material: u8) -> Self {
        Self { material, ..self }
    }

    /// Returns the collider with this friction: a coefficient, or a [`Friction`].
    pub fn with_friction(self, friction: impl Into<Friction>) -> Self {
        Self { friction: friction.into(), ..self }
    }

    /// Returns the collider with a compliant surface of this frequency ratio.
    ///
    /// ```
    /// use carom::{Collider, DVec3, Pose, Shape, Sphere, World};
    ///
    /// let cushion = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
    /// let mut world = World::default();
    /// world.add_collider(cushion.with_friction(0.5).with_cushion(1.3))?;
    /// let ball = Sphere::new(DVec3::Y, 0.03).with_velocity(DVec3::new(0.1, -2.0, 0.0));
    /// let ball = world.add_sphere(ball)?;
    /// world.step(1.0)?;
    /// // A steep impact sticks, and the spring along the surface reverses the slip.
    /// let after = world.sphere(ball)?;
    /// let slip = after.velocity.x + 0.03 * after.angular_velocity.z;
    /// assert!(-0.1 < slip && slip < -0.05);
    /// # Ok::<(), carom::Error>(())
    /// ```
    pub fn with_cushion(self, frequency_ratio: f64) -> Self {
        Self { cushion: Some(frequency_ratio), ..self }
    }

    /// Returns the collider as a trigger.
    pub fn as_trigger(self) -> Self {
        Self { trigger: true, ..self }
    }

    /// Returns the collider as a trigger that takes out the spheres that enter it.
    ///
    /// ```
    /// use carom::{Collider, DVec3, Pose, Shape, Sphere, World};
    ///
    /// let mut world = World::default();
    /// let pocket = Collider::new(Shape::Sphere { radius: 0.1 }, Pose::at(DVec3::X));
    /// world.add_collider(pocket.capturing())?;
    /// let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.1).with_velocity(DVec3::X))?;
    /// let report = world.step(1.0)?;
    /// assert!((report.sensor_events[0].time - 0.8).abs() < 1e-15);
    /// assert_eq!(report.retired, [ball]);
    /// assert!(world.spheres().is_empty());
    /// # Ok::<(), carom::Error>(())
    /// ```
    pub fn capturing(self) -> Self {
        Self { trigger: true, captures: true, ..self }
    }

    /// Returns the collider with a kick: it adds this speed \[m/s\] along the normal in every impact.
    pub fn with_kick(self, kick: f64) -> Self {
        Self { kick, ..self }
    }

    /// Returns the collider in these groups.
    pub fn with_groups(self, groups: Groups) -> Self {
        Self { groups, ..self }
    }

    /// Returns the collider with this number of the program's own.
    pub fn with_user_data(self, user_data: u64) -> Self {
        Self { user_data, ..self }
    }

    /// Returns its pose at a time on the world's clock \[s\], by its motion; without a motion its present pose.
    pub fn pose_at(&self, time: f64) -> Pose {
        self.course(time).map_or(self.pose, |course| course.place(0.0).0)
    }

    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        self.shape.validate()?;
        self.pose.validate()?;
        validate::finite("velocity", self.velocity)?;
        validate::finite("angular_velocity", self.angular_velocity)?;
        validate::finite("surface_velocity", self.surface_velocity)?;
        self.motion.validate()?;
        self.validate_velocities()?;
        validate::unit_interval("restitution", self.restitution)?;
        self.restitution_law.map_or(Ok(()), |law| law.validate())?;
        validate::non_negative("kick", self.kick)?;
        let is_known = self.cushion.is_none_or(|ratio| (1.0..=2.0).contains(&ratio));
        validate::require(is_known, "cushion", "in [1, 2]", self.cushion.unwrap_or_default())?;
        let is_possible = self.trigger || !self.captures;
        validate::require(is_possible, "captures", "false for what is no trigger", true)?;
        self.friction.validate()
    }
}

impl Collider {
    /// Returns an error for velocities beside a motion, which sets them.
    fn validate_velocities(&self) -> Result<(), InvalidValue> {
        let are_given = !self.motion.is_empty() && self.motion.rest().is_none();
        let requirement = "zero where there is a `motion`, which may have a steady part";
        for (field, value) in
            [("velocity", self.velocity), ("angular_velocity", self.angular_velocity)]
        {
            validate::require(!are_given || value == DVec3::ZERO, field, requirement, value)?;
        }
        Ok(())
    }

    /// Returns the motion of the collider from `time` \[s\] on; `None` if it moves by its
    /// velocities.
    pub(crate) fn course(&self, time: f64) -> Option<Course> {
        (!self.motion.is_empty()).then(|| Course::new(self.motion.clone(), self.pose, time))
    }

    /// Whether it does not stay where it is.
    pub(crate) fn moves(&self) -> bool {
        let has_velocity = self.velocity != DVec3::ZERO || self.angular_velocity != DVec3::ZERO;
        has_velocity || !self.motion.is_empty()
    }

    /// Moves the collider to its place at `time` \[s\] by its motion. A new collider rests at its pose; one with a
    /// new pose takes its motion along.
    pub(crate) fn follow_motion(&mut self, time: f64) {
        let Some(course) = self.course(time) else { return };
        let (pose, motion) = course.place(0.0);
        (self.motion, self.pose) = (self.motion.about(course.rest(), pose), pose);
        (self.velocity, self.angular_velocity) = (motion.velocity, motion.angular_velocity);
    }
}

impl Shape {
    fn validate(&self) -> Result<(), InvalidValue> {
        match *self {
            Self::Sphere { radius } | Self::Disc { radius } => validate::positive("radius", radius),
            Self::Rectangle { size_x, size_z } => {
                validate::positive("size_x", size_x)?;
                validate::positive("size_z", size_z)
            }
            Self::HalfSpace | Self::Mesh(_) => Ok(()),
            Self::Box { size } | Self::Container { size, .. } => {
                validate::positive("size.x", size.x)?;
                validate::positive("size.y", size.y)?;
                validate::positive("size.z", size.z)
            }
            Self::Cylinder { radius, height } => {
                validate::positive("radius", radius)?;
                validate::positive("height", height)
            }
            Self::Capsule { radius, length } | Self::Pipe { radius, length, .. } => {
                validate::positive("radius", radius)?;
                validate::positive("length", length)
            }
            Self::Cone { bottom_radius, top_radius, height }
            | Self::Funnel { bottom_radius, top_radius, height } => {
                validate::non_negative("bottom_radius", bottom_radius)?;
                validate::non_negative("top_radius", top_radius)?;
                validate::positive("top_radius", bottom_radius.max(top_radius))?;
                validate::positive("height", height)
            }
            Self::Torus { ring_radius, tube_radius } => {
                validate::positive("tube_radius", tube_radius)?;
                validate::positive("ring_radius", ring_radius)?;
                let is_ring = ring_radius > tube_radius;
                validate::require(is_ring, "ring_radius", "larger than tube_radius", ring_radius)
            }
            Self::Bowl { radius, opening } => {
                validate::positive("radius", radius)?;
                let is_open = (0.0..std::f64::consts::PI).contains(&opening);
                validate::require(is_open, "opening", "at least 0 and less than pi", opening)
            }
        }
    }
}
