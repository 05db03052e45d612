//! Components and resources that programs set.

use bevy_ecs::prelude::*;
use bevy_math::DVec3;
use bevy_transform::components::Transform;
use carom::{Body, Pose, Shape, Sphere};

/// A ball: a moving sphere of the physics.
///
/// Its place and orientation are in `Transform`, its velocities in [`LinearVelocity`] and [`AngularVelocity`]; those
/// in the [`Sphere`] are not used. The scale of `Transform` does not change the radius. A change of any of these
/// components takes effect in the next step.
///
/// ```
/// use carom_bevy::Ball;
///
/// let ball = Ball::new(0.1).with(|sphere| sphere.with_density(7800.0).with_restitution(0.9));
/// assert!((ball.0.kilograms() - 32.67).abs() < 0.01);
/// ```
#[derive(Component, Debug, Clone, Copy, PartialEq)]
#[require(Transform, LinearVelocity, AngularVelocity)]
pub struct Ball(pub Sphere);

impl Ball {
    /// A solid ball of 1 kg with this radius \[m\].
    pub fn new(radius: f64) -> Self {
        Self(Sphere::new(carom::DVec3::ZERO, radius))
    }

    /// Returns the ball with other properties: mass, restitution, friction, groups and all that a [`Sphere`] has.
    #[must_use]
    pub fn with(self, change: impl FnOnce(Sphere) -> Sphere) -> Self {
        Self(change(self.0))
    }
}

/// A collider: a surface off which balls bounce, or a sensor.
///
/// Its place is in `Transform`, also as a child of other entities; the pose in the [`carom::Collider`] is not used. It
/// is at rest, or moves
/// - by its `Transform`, with [`Kinematic`];
/// - by its velocity or its motion in closed form ([`carom::Collider::moving`], [`carom::Collider::with_motion`]); the
///   physics then sets its `Transform`.
///
/// The scale of `Transform` does not change the shape.
///
/// ```
/// use carom_bevy::Collider;
///
/// let bumper = Collider::cylinder(0.05, 0.1).with(|it| it.with_restitution(0.9).with_kick(1.0));
/// let gate = Collider::cuboid(0.1, 0.1, 0.1).as_sensor();
/// assert!(gate.0.trigger && !bumper.0.trigger);
/// ```
#[derive(Component, Debug, Clone, PartialEq)]
#[require(Transform)]
pub struct Collider(pub carom::Collider);

impl Collider {
    /// A solid collider of this shape at rest, with restitution 1.
    pub fn new(shape: Shape) -> Self {
        Self(carom::Collider::new(shape, Pose::at(carom::DVec3::ZERO)))
    }

    /// A fixed sphere with this radius \[m\].
    pub fn sphere(radius: f64) -> Self {
        Self::new(Shape::Sphere { radius })
    }

    /// A box with these full lengths along x, y and z \[m\].
    pub fn cuboid(x: f64, y: f64, z: f64) -> Self {
        Self::new(Shape::Box { size: carom::DVec3::new(x, y, z) })
    }

    /// Everything below the local xz plane.
    pub fn half_space() -> Self {
        Self::new(Shape::HalfSpace)
    }

    /// A solid cylinder about the local y axis, with this radius and height \[m\].
    pub fn cylinder(radius: f64, height: f64) -> Self {
        Self::new(Shape::Cylinder { radius, height })
    }

    /// All within a radius \[m\] of a line of this length \[m\] along local y.
    pub fn capsule(radius: f64, length: f64) -> Self {
        Self::new(Shape::Capsule { radius, length })
    }

    /// A hollow box without a lid, with these full lengths along x, y and z \[m\].
    pub fn open_box(x: f64, y: f64, z: f64) -> Self {
        let open = carom::Sides { top: true, ..carom::Sides::NONE };
        Self::new(Shape::Container { size: carom::DVec3::new(x, y, z), open })
    }

    /// Returns the collider as a sensor: it deflects nothing and reports by [`SensorEvent`](crate::SensorEvent).
    #[must_use]
    pub fn as_sensor(self) -> Self {
        self.with(carom::Collider::as_trigger)
    }

    /// Returns the collider with other properties: restitution, friction, motion and all that a [`carom::Collider`]
    /// has.
    #[must_use]
    pub fn with(self, change: impl FnOnce(carom::Collider) -> carom::Collider) -> Self {
        Self(change(self.0))
    }
}

/// Makes a [`Collider`] from the triangles of the `Mesh3d` of the entity once its asset is there.
///
/// The scale of the entity and of its parents is applied. Triangles whose orientations differ, and edges with more
/// than two triangles, are named in a warning; a mesh that cannot be a collider in a
/// [`PhysicsError`](crate::PhysicsError).
#[derive(Component, Debug, Clone, PartialEq)]
#[require(Transform)]
pub struct ColliderFromMesh {
    /// The collider to make; its shape is not used.
    pub collider: Collider,
    /// Whether balls pass triangles from behind, where the mesh is not closed.
    pub is_one_sided: bool,
}

impl Default for ColliderFromMesh {
    fn default() -> Self {
        Self { collider: Collider::half_space(), is_one_sided: false }
    }
}

/// A collider that its `Transform` moves: it reaches a changed `Transform` within the next step, and balls feel its
/// velocity. Without this component a changed `Transform` moves a collider at once.
#[derive(Component, Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Kinematic;

/// Velocity of a ball \[m/s\]. Each step reads and writes it.
#[derive(Component, Debug, Clone, Copy, Default, PartialEq)]
pub struct LinearVelocity(pub DVec3);

impl LinearVelocity {
    /// A velocity with these components \[m/s\].
    pub fn new(x: f64, y: f64, z: f64) -> Self {
        Self(DVec3::new(x, y, z))
    }
}

/// Angular velocity of a ball, along the axis of rotation \[rad/s\]. Each step reads and writes it.
#[derive(Component, Debug, Clone, Copy, Default, PartialEq)]
pub struct AngularVelocity(pub DVec3);

impl AngularVelocity {
    /// An angular velocity with these components \[rad/s\].
    pub fn new(x: f64, y: f64, z: f64) -> Self {
        Self(DVec3::new(x, y, z))
    }
}

/// Force on one ball \[N\], until it is changed or removed.
#[derive(Component, Debug, Clone, Copy, Default, PartialEq)]
pub struct ExternalForce(pub DVec3);

/// Acceleration of gravity \[m/s²\]: 9.81 along -y unless given. Without this resource there is none.
#[derive(Resource, Debug, Clone, Copy, PartialEq)]
pub struct Gravity(pub DVec3);

impl Default for Gravity {
    fn default() -> Self {
        Self(DVec3::new(0.0, -9.81, 0.0))
    }
}

/// The sphere or collider of the physics that an entity stands for; set by the plugin.
#[derive(Component, Debug, Clone, Copy, PartialEq)]
#[component(clone_behavior = Ignore)]
pub struct PhysicsBody {
    pub(crate) body: Body,
    /// `Transform` of the entity as the physics last read or wrote it.
    pub(crate) local: Transform,
    /// Place in the world as the physics last read it.
    pub(crate) global: Transform,
}

impl PhysicsBody {
    /// Returns its id in the [`CaromWorld`](crate::CaromWorld).
    pub fn body(&self) -> Body {
        self.body
    }
}
