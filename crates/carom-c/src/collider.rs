//! Colliders, the surfaces that spheres bounce off.

use carom::{Collider, ColliderId, DQuat, DVec3, Motion, Pose, Shape, Sides};
use carom_scene::scene;

use crate::motion::vector;
use crate::pointer::{Out, Plain, read, tell};
use crate::sphere::{coefficients, friction_of};
use crate::status::{CaromStatus, Failure, call};
use crate::world::{CaromWorld, Inner};

/// The shape of a collider in its own frame.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CaromShape {
    /// A sphere of `radius`.
    Sphere = 0,
    /// A rectangle of size[0] by size[2] in the local xz plane, which faces local +y. Spheres pass
    /// through it from behind.
    Rectangle = 1,
    /// Everything below the local xz plane.
    HalfSpace = 2,
    /// A box of `size`.
    Box = 3,
    /// A hollow box of `size`: spheres bounce off its walls on both sides. The walls in
    /// `open_sides` are missing.
    Container = 4,
    /// A shape that arrays or the text of a scene describe. carom_world_set_collider() keeps it.
    Other = 5,
}

/// A side of a box in its own frame: a bit of `open_sides`.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CaromSide {
    /// Towards -x.
    Left = 1,
    /// Towards +x.
    Right = 2,
    /// Towards -y.
    Bottom = 4,
    /// Towards +y.
    Top = 8,
    /// Towards -z.
    Back = 16,
    /// Towards +z.
    Front = 32,
}

/// A collider: a shape that spheres do not move, at rest or in motion. carom_collider() returns one
/// with default values.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CaromCollider {
    /// The shape (CaromShape).
    pub shape: i32,
    /// 1 for a trigger, which reports spheres but does not deflect them; 0 for a solid collider.
    pub trigger: u32,
    /// Missing walls of a container: bits (CaromSide).
    pub open_sides: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Radius of a sphere [m], > 0.
    pub radius: f64,
    /// Full lengths along local x, y, z [m], each > 0 if the shape has it.
    pub size: [f64; 3],
    /// Origin of the local frame [m].
    pub position: [f64; 3],
    /// Rotation from the local frame to the world: a quaternion x, y, z, w of any length but zero.
    pub rotation: [f64; 4],
    /// Velocity of the origin [m/s]; steps move the collider.
    pub velocity: [f64; 3],
    /// Angular velocity about the origin [rad/s].
    pub angular_velocity: [f64; 3],
    /// Coefficient of restitution in [0, 1].
    pub restitution: f64,
    /// Coefficient of friction, >= 0; not a number (NAN) if the touching body decides.
    pub friction: f64,
    /// Coefficient of rolling friction, as `friction`.
    pub rolling_friction: f64,
    /// Coefficient of spinning friction, as `friction`.
    pub spinning_friction: f64,
    /// Coefficient of tangential restitution in [0, 1], or not a number.
    pub tangential_restitution: f64,
}

// SAFETY: a structure of numbers.
unsafe impl Plain for CaromCollider {}

impl From<Collider> for CaromCollider {
    fn from(collider: Collider) -> Self {
        let (mut radius, mut size, mut open_sides) = (1.0, [1.0; 3], 0);
        let shape = match collider.shape {
            Shape::Sphere { radius: own } => {
                radius = own;
                CaromShape::Sphere
            }
            Shape::Rectangle { size_x, size_z } => {
                size = [size_x, 1.0, size_z];
                CaromShape::Rectangle
            }
            Shape::HalfSpace => CaromShape::HalfSpace,
            Shape::Box { size: own } => {
                size = own.to_array();
                CaromShape::Box
            }
            Shape::Container { size: own, open } => {
                (size, open_sides) = (own.to_array(), bits(open));
                CaromShape::Container
            }
            _ => CaromShape::Other,
        };
        let [friction, rolling_friction, spinning_friction, tangential_restitution] =
            coefficients(collider.friction);
        Self {
            shape: shape as i32,
            trigger: collider.trigger.into(),
            open_sides,
            reserved: 0,
            radius,
            size,
            position: collider.pose.position.to_array(),
            rotation: collider.pose.rotation.to_array(),
            velocity: collider.velocity.to_array(),
            angular_velocity: collider.angular_velocity.to_array(),
            restitution: collider.restitution,
            friction,
            rolling_friction,
            spinning_friction,
            tangential_restitution,
        }
    }
}

/// Returns the bits of sides.
fn bits(sides: Sides) -> u32 {
    let bits = sides.to_array().into_iter().enumerate();
    bits.map(|(bit, is_there)| u32::from(is_there) << bit).sum()
}

impl CaromCollider {
    /// Converts to the collider of the physics, without checking numbers. `before` supplies the
    /// shape if arrays or text describe it.
    fn physical(&self, before: Option<Shape>) -> Result<Collider, Failure> {
        let invalid = |problem: &str| Failure::new(CaromStatus::Invalid, problem);
        let size = DVec3::from_array(self.size);
        let is = |shape: CaromShape| self.shape == shape as i32;
        let shape = if is(CaromShape::Sphere) {
            Shape::Sphere { radius: self.radius }
        } else if is(CaromShape::Rectangle) {
            Shape::Rectangle { size_x: size.x, size_z: size.z }
        } else if is(CaromShape::HalfSpace) {
            Shape::HalfSpace
        } else if is(CaromShape::Box) {
            Shape::Box { size }
        } else if is(CaromShape::Container) {
            Shape::Container { size, open: self.open()? }
        } else if let Some(before) = before.filter(|_| is(CaromShape::Other)) {
            before
        } else {
            let problem = format!("there is no shape {}", self.shape);
            return Err(Failure::new(CaromStatus::Argument, problem));
        };
        if self.trigger > 1 || self.reserved != 0 {
            return Err(invalid("`trigger` must be 0 or 1, and `reserved` 0"));
        }
        let position = DVec3::from_array(self.position);
        let pose = Pose::at(position).rotated(DQuat::from_array(self.rotation));
        let (velocity, angular_velocity) = (self.velocity, self.angular_velocity);
        let collider = Collider::new(shape, pose)
            .moving(DVec3::from_array(velocity), DVec3::from_array(angular_velocity))
            .with_restitution(self.restitution)
            .with_friction(friction_of([
                self.friction,
                self.rolling_friction,
                self.spinning_friction,
                self.tangential_restitution,
            ]));
        Ok(if self.trigger == 1 { collider.as_trigger() } else { collider })
    }

    /// Converts to a collider of a shape that arrays hold.
    pub(crate) fn of_shape(&self, shape: Shape) -> Result<Collider, Failure> {
        if self.shape != CaromShape::Other as i32 {
            let problem = "`shape` must be CAROM_SHAPE_OTHER, as the arrays are the shape";
            return Err(Failure::new(CaromStatus::Argument, problem));
        }
        self.physical(Some(shape))
    }

    /// Returns the sides of a container without a wall.
    fn open(&self) -> Result<Sides, Failure> {
        let invalid = |problem: &str| Failure::new(CaromStatus::Invalid, problem);
        let open = Sides::from_array([0, 1, 2, 3, 4, 5].map(|bit| self.open_sides >> bit & 1 == 1));
        if self.open_sides != bits(open) {
            return Err(invalid("`open_sides` must be bits of sides"));
        }
        match open {
            Sides::ALL => Err(invalid("`open_sides` must leave one wall at least")),
            open => Ok(open),
        }
    }
}

/// Returns the collider with the motion that it has in the world, which its structure cannot hold.
fn with_motion(collider: Collider, motion: Motion) -> Collider {
    if motion.is_empty() { collider } else { collider.with_motion(motion) }
}

/// Writes a collider into a description, which keeps its name, colour and finish.
fn describe(collider: &Collider, described: &mut scene::Collider) {
    match collider.shape {
        Shape::Sphere { radius } => described.shape = scene::Shape::Sphere { radius },
        Shape::Rectangle { size_x, size_z } => {
            described.shape = scene::Shape::Rectangle { size_x, size_z };
        }
        Shape::HalfSpace => described.shape = scene::Shape::HalfSpace,
        Shape::Box { size } => described.shape = scene::Shape::Box { size: size.to_array() },
        Shape::Container { size, open } => {
            let open = SIDES.into_iter().zip(open.to_array()).filter(|(_, is_open)| *is_open);
            let (size, open) = (size.to_array(), open.map(|(side, _)| side).collect());
            described.shape = scene::Shape::Container { size, open };
        }
        // A shape that arrays or text describe is in the description already.
        _ => {}
    }
    let pose = collider.motion.rest().unwrap_or(collider.pose);
    described.position = pose.position.to_array();
    described.rotation = pose.rotation.to_array();
    described.motion = collider.motion.parts().iter().filter_map(scene::Motion::of).collect();
    if collider.motion.is_empty() {
        described.velocity = collider.velocity.to_array();
        described.angular_velocity = collider.angular_velocity.to_array();
    }
    described.surface_velocity = collider.surface_velocity.to_array();
    described.restitution = collider.restitution;
    described.trigger = collider.trigger;
    described.set_surface_friction(collider.friction);
}

/// All sides, in the order of [`Sides::to_array`].
const SIDES: [scene::Side; 6] = [
    scene::Side::Left,
    scene::Side::Right,
    scene::Side::Bottom,
    scene::Side::Top,
    scene::Side::Back,
    scene::Side::Front,
];

/// Returns a solid half-space below y = 0, at rest, with restitution 1 and without its own
/// friction. Its `radius` and `size` are 1 m.
#[unsafe(no_mangle)]
pub extern "C" fn carom_collider() -> CaromCollider {
    Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).into()
}

/// Adds a collider. Writes its id to `id`, which may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_add_collider(
    world: CaromWorld,
    collider: *const CaromCollider,
    id: *mut u64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let collider = unsafe { read(collider, "collider") }?.physical(None)?;
        let number = add(world, collider, scene::Shape::HalfSpace)?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        unsafe { tell(id, number) };
        Ok(())
    })
}

/// Adds a collider and its description. `shape` is its shape in scene files where the collider's own does not
/// determine that. Returns its id.
pub(crate) fn add(
    world: CaromWorld,
    collider: Collider,
    shape: scene::Shape,
) -> Result<u64, Failure> {
    world.with(|inner| {
        let mut described = scene::Collider::new(shape);
        describe(&collider, &mut described);
        let id = inner.world.add_collider(collider)?;
        inner.described.change_colliders(|all| all.push(described));
        Ok(id.number())
    })
}

/// Reads a collider in its present pose by its id.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_collider(
    world: CaromWorld,
    id: u64,
    collider: *mut CaromCollider,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut place = unsafe { Out::new(collider, "collider") }?;
        let collider =
            world.with(|inner| Ok(inner.world.collider(ColliderId::from_number(id))?))?;
        place.set(collider.into());
        Ok(())
    })
}

/// Replaces all properties of a collider, which keeps its id; it moves at once.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_set_collider(
    world: CaromWorld,
    id: u64,
    collider: *const CaromCollider,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let collider = unsafe { read(collider, "collider") }?;
        world.with(|inner| {
            let own = ColliderId::from_number(id);
            // What programs in C cannot name stays as it is.
            let before = inner.world.collider(own)?;
            let (kick, groups, user_data) = (before.kick, before.groups, before.user_data);
            let collider = collider.physical(Some(before.shape))?;
            let collider = collider.with_kick(kick).with_groups(groups).with_user_data(user_data);
            let mut collider = collider.with_surface_velocity(before.surface_velocity);
            collider.cushion = before.cushion;
            collider.captures = before.captures && collider.trigger;
            replace(inner, own, with_motion(collider, before.motion))
        })
    })
}

/// Sets the velocity of the material of a collider along its surface, three numbers [m/s] in its own
/// coordinates, as of a conveyor belt: friction feels it, and the shape stays.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_set_surface_velocity(
    world: CaromWorld,
    collider: u64,
    velocity: *const f64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let velocity = unsafe { vector(velocity, "velocity") }?;
        world.with(|inner| {
            let own = ColliderId::from_number(collider);
            let collider = inner.world.collider(own)?;
            replace(inner, own, collider.with_surface_velocity(velocity))
        })
    })
}

/// Replaces a collider, and its description.
pub(crate) fn replace(
    inner: &mut Inner,
    own: ColliderId,
    collider: Collider,
) -> Result<(), Failure> {
    inner.world.set_collider(own, collider)?;
    let collider = inner.world.collider(own)?;
    let place = inner.world.colliders().position(|(other, _)| other == own);
    inner.described.change_colliders(|all| {
        let described = place.and_then(|place| all.get_mut(place));
        described.into_iter().for_each(|described| describe(&collider, described));
    });
    Ok(())
}

/// Removes a collider.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_remove_collider(world: CaromWorld, id: u64) -> CaromStatus {
    call(|| {
        world.with(|inner| {
            let place = inner.world.colliders().position(|(own, _)| own.number() == id);
            let place = place.ok_or_else(|| Failure::unknown("collider", id))?;
            inner.world.remove_collider(ColliderId::from_number(id))?;
            inner.described.change_colliders(|all| drop(all.remove(place)));
            Ok(())
        })
    })
}
