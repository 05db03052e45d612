//! Derivatives of a run under the rule `exact` with respect to its initial state, exact through impacts.
//!
//! Between impacts the motion is known in closed form, and so is its derivative. An impact maps small changes of
//! the motion before it linearly to small changes after it; the map includes the change of the time of the impact.

mod along_curves;
mod coefficients;
mod cornered;
mod curve_section;
mod curved;
mod curves;
mod departure;
mod dry_motion;
mod dual;
mod edge_passage;
mod error;
mod followed;
mod group;
mod groups;
mod holding;
mod input_rates;
mod known;
mod law;
mod linearized;
mod margin;
mod on_planes;
mod replay;
mod saltation;
mod saltation_back;
mod start;
mod state;
mod supported;
mod tape;
mod tightening;
mod touched;
mod variation;

use glam::DVec3;

pub use error::DerivativeError;
pub use margin::Margin;
pub use state::SphereTangent;
pub use tape::Tape;
pub use variation::{ColliderVariation, SphereVariation, SpringVariation, Variation};

use crate::id::{ColliderId, SphereId};
use crate::world::World;
use followed::Followed;
use input_rates::InputRates;
use replay::Piece;

/// What is refused of rotations.
const TURNED: &str = "rotations of colliders that move, bear spheres, or are met by groups";

/// Derivatives in some directions, advanced together with a world: the change of the motion of each sphere when the
/// initial state changes in a direction.
///
/// Available for worlds under the rule `exact` whose spheres fly freely, on springs or under forces with
/// [`Force::derivatives`](crate::Force::derivatives), or slide, roll and rest on single planes, or between smooth ones, and
/// meet each other and surfaces one at a time, with or without friction. A ball may meet a group of bodies that touch, as in a cradle or a rack of
/// billiards, along directions that keep these in touch. Anything without a derivative is an error. The formulas are in `docs/physics/derivatives.md`.
///
/// ```
/// use carom::{Collider, DVec3, Pose, Shape, Sphere, Tangents, Variation, World};
///
/// let mut world = World::default();
/// world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)))?;
/// let start = Sphere::new(DVec3::new(0.0, 3.0, 0.0), 1.0).with_velocity(DVec3::new(1.0, -2.0, 0.0));
/// let ball = world.add_sphere(start)?;
/// let higher = Variation::default().with_position(ball, DVec3::Y);
/// let mut tangents = Tangents::new(&world, vec![higher])?;
/// tangents.step(&mut world, 2.0)?;
/// // A ball that starts higher comes later, and is lower after its bounce.
/// assert_eq!(tangents.sphere(0, ball)?.position, DVec3::NEG_Y);
/// # Ok::<(), carom::DerivativeError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Tangents {
    directions: Vec<Variation>,
    /// For each direction, the derivative of each sphere in the order of the world's arrays.
    spheres: Vec<Vec<SphereTangent>>,
    /// For each direction, the change of the acceleration of each sphere \[m/s²\].
    accelerations: Vec<Vec<DVec3>>,
    followed: Followed,
}

impl Tangents {
    /// Starts with the present state of a world.
    ///
    /// # Errors
    /// [`DerivativeError::Unsupported`] if the world has something whose derivatives are not known, among them masses
    /// and radii where forces without `derivatives` depend on them; an error that names a sphere or collider that is not in it.
    pub fn new(world: &World, directions: Vec<Variation>) -> Result<Self, DerivativeError> {
        let followed = Followed::start(world)?;
        for direction in &directions {
            check(world, &followed, direction)?;
        }
        let of_direction = |direction: &Variation| {
            followed.ids.iter().map(|&id| direction.sphere(id).motion()).collect()
        };
        let spheres = directions.iter().map(of_direction).collect();
        let accelerations = vec![Vec::new(); directions.len()];
        let mut tangents = Self { directions, spheres, accelerations, followed };
        tangents.add_spheres();
        Ok(tangents)
    }

    /// Adds spheres that were added to the world: no change of the start changes how they begin.
    fn add_spheres(&mut self) {
        let Self { directions, spheres, accelerations, followed } = self;
        for ((direction, spheres), all) in directions.iter().zip(spheres).zip(accelerations) {
            spheres.resize(followed.ids.len(), SphereTangent::default());
            let added = followed.ids.iter().skip(all.len());
            all.extend(added.map(|&id| direction.acceleration + direction.sphere(id).acceleration));
        }
    }

    /// Advances the world by `dt` \[s\], and the derivatives with it. A change of the world from outside since the
    /// last step has no derivative of its own.
    ///
    /// # Errors
    /// Those of [`World::step`], which leave all as it was. [`DerivativeError::Simultaneous`] and
    /// [`DerivativeError::PersistentContact`] where there is no derivative: the world has taken the step, and every later
    /// call gives that error again.
    pub fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DerivativeError> {
        let pieces = self.followed.step(world, dt)?;
        self.add_spheres();
        let accelerations = self.accelerations.iter().map(Vec::as_slice);
        let directions = self.directions.iter().zip(accelerations);
        for (direction, spheres) in directions.zip(&mut self.spheres) {
            if let Err(error) = pass(&pieces, direction, spheres, self.followed.began) {
                self.followed.lose(error.clone());
                return Err(error);
            }
        }
        Ok(())
    }

    /// Returns the present derivative of the motion of a sphere in the direction with this index.
    ///
    /// # Errors
    /// [`DerivativeError::UnknownSphere`] if it is not followed.
    ///
    /// # Panics
    /// If there is no such direction.
    pub fn sphere(
        &self,
        direction: usize,
        sphere: SphereId,
    ) -> Result<SphereTangent, DerivativeError> {
        Ok(self.spheres[direction][self.followed.place_of(sphere)?])
    }

    /// Returns the present derivatives of the motion of all spheres in the direction with this index, in the order
    /// of their ids.
    ///
    /// # Panics
    /// If there is no such direction.
    pub fn spheres(&self, direction: usize) -> &[SphereTangent] {
        &self.spheres[direction]
    }

    /// Returns the number of directions.
    pub fn len(&self) -> usize {
        self.directions.len()
    }

    /// Returns whether there is no direction.
    pub fn is_empty(&self) -> bool {
        self.directions.is_empty()
    }

    /// Returns how near the run came to where derivatives end.
    pub fn margin(&self) -> Margin {
        self.followed.margin
    }

    /// Makes the derivatives of the motion of all spheres orthonormal, one direction after the other (Gram and
    /// Schmidt), in a norm in which a change of `length` \[m\] equals one of `speed` \[m/s\] and spins do not
    /// count. Returns the length of each before that. Their logarithms, summed over a run and divided by its time,
    /// are the Lyapunov exponents (Benettin, Galgani, Giorgilli and Strelcyn, Meccanica 15, 9 (1980)).
    pub fn orthonormalize(&mut self, length: f64, speed: f64) -> Vec<f64> {
        let dot = |one: &[SphereTangent], other: &[SphereTangent]| -> f64 {
            let product = |(a, b): (&SphereTangent, &SphereTangent)| {
                a.position.dot(b.position) / (length * length)
                    + a.velocity.dot(b.velocity) / (speed * speed)
            };
            one.iter().zip(other).map(product).sum()
        };
        let mut lengths = Vec::with_capacity(self.spheres.len());
        for number in 0..self.spheres.len() {
            let (done, rest) = self.spheres.split_at_mut(number);
            let this = &mut rest[0];
            for other in done.iter() {
                let share = dot(this, other);
                for (tangent, along) in this.iter_mut().zip(other) {
                    tangent.position -= share * along.position;
                    tangent.velocity -= share * along.velocity;
                }
            }
            let size = dot(this, this).sqrt();
            for tangent in this.iter_mut() {
                tangent.position /= size;
                tangent.velocity /= size;
                tangent.angular_velocity = DVec3::ZERO;
            }
            lengths.push(size);
        }
        lengths
    }
}

/// Applies the linear maps of a step to the derivatives in one direction. `began` is the start of the derivatives on the
/// world's clock \[s\].
///
/// # Errors
/// [`DerivativeError::Simultaneous`] where the direction parts bodies that touch.
fn pass(
    pieces: &[Piece],
    (direction, accelerations): (&Variation, &[DVec3]),
    spheres: &mut [SphereTangent],
    began: f64,
) -> Result<(), DerivativeError> {
    for piece in pieces {
        match *piece {
            Piece::Flight { place, time, drag_rate } => {
                spheres[place].fly(Piece::propagator(time, drag_rate), accelerations[place]);
            }
            Piece::Supported(ref flight) => {
                are_not_turned(direction, [flight.collider])?;
                flight.pass(direction, spheres);
            }
            Piece::InputChange(ref change) => change.pass(direction, spheres),
            Piece::Curved(ref flight) => flight.pass((direction, accelerations), spheres),
            Piece::Tightening(ref thread) => thread.pass(direction, spheres),
            Piece::Cornered(ref flight) => {
                are_not_turned(direction, flight.colliders())?;
                flight.pass(direction, spheres);
            }
            Piece::Departure(ref departure) => {
                are_not_turned(direction, [departure.collider])?;
                departure.pass(direction, spheres);
            }
            Piece::Passage(ref passage) => passage.pass(direction, spheres),
            Piece::Impact(ref saltation) => saltation.pass(direction, spheres),
            Piece::Loose(ref contact) => {
                if !contact.stays(direction, spheres) {
                    let (sphere, time) = (contact.second.1, began + contact.time);
                    return Err(DerivativeError::Simultaneous { sphere, time });
                }
            }
            Piece::Group(ref group) => {
                if group.turns(direction) {
                    return Err(DerivativeError::Unsupported(TURNED));
                }
                if !group.pass(direction, spheres) {
                    let (sphere, time) = (group.second, began + group.time);
                    return Err(DerivativeError::Simultaneous { sphere, time });
                }
            }
        }
    }
    Ok(())
}

/// Returns an error if a direction turns one of these colliders.
fn are_not_turned(
    direction: &Variation,
    colliders: impl IntoIterator<Item = ColliderId>,
) -> Result<(), DerivativeError> {
    let turns = |id: ColliderId| direction.collider(id).rotation != DVec3::ZERO;
    let is_turned = colliders.into_iter().any(turns);
    if is_turned { Err(DerivativeError::Unsupported(TURNED)) } else { Ok(()) }
}

/// Returns an error if a direction changes something that is not in the world, or a quantity that its forces depend
/// on.
fn check(world: &World, followed: &Followed, direction: &Variation) -> Result<(), DerivativeError> {
    let system = world.now().system;
    let curved = known::curved(&system);
    for (id, change) in direction.spheres() {
        let place = followed.place_of(id)?;
        if curved[place] || change.radius == 0.0 && change.mass == 0.0 {
            continue;
        }
        if InputRates::of(&system, place).is_some_and(|rates| !rates.are_known()) {
            let what = "radii and masses where forces depend on them";
            return Err(DerivativeError::Unsupported(what));
        }
    }
    let is_known = |id| world.collider(id).map_err(|_| DerivativeError::UnknownCollider(id));
    for (id, change) in direction.colliders() {
        let collider = is_known(id)?;
        let moves = collider.velocity != DVec3::ZERO
            || collider.angular_velocity != DVec3::ZERO
            || collider.surface_velocity != DVec3::ZERO
            || !collider.motion.is_empty();
        if moves && change.rotation != DVec3::ZERO {
            return Err(DerivativeError::Unsupported(TURNED));
        }
    }
    let is_there = |id| world.spring(id).map_err(|_| DerivativeError::UnknownSpring(id));
    direction.springs().try_for_each(|(id, _)| is_there(id).map(|_| ()))
}
