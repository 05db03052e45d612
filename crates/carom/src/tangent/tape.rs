//! A record of a run that is evaluated backwards.

use glam::DVec3;

use super::error::DerivativeError;
use super::followed::Followed;
use super::margin::Margin;
use super::replay::Piece;
use super::state::SphereTangent;
use super::variation::Variation;
use crate::id::SphereId;
use crate::world::World;

/// Record of the flights and impacts of a run. It gives the gradient of a number with respect to the whole initial
/// state at once.
///
/// Available for the same worlds as [`Tangents`](crate::Tangents). It holds some 660 bytes for an impact, 24 for a
/// flight between two, some 350 for a stretch of sliding, rolling or rest, and some 2,600 for each step of a sphere on a
/// curve.
///
/// ```
/// use carom::{Collider, DVec3, Pose, Shape, Sphere, SphereTangent, Tape, World};
///
/// let mut world = World::default();
/// world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)))?;
/// let start = Sphere::new(DVec3::new(0.0, 3.0, 0.0), 1.0).with_velocity(DVec3::new(1.0, -2.0, 0.0));
/// let ball = world.add_sphere(start)?;
/// let mut tape = Tape::start(&world)?;
/// tape.step(&mut world, 2.0)?;
/// // By what does the height at the end change?
/// let height = SphereTangent { position: DVec3::Y, ..SphereTangent::default() };
/// let gradient = tape.gradient(&[(ball, height)])?;
/// assert_eq!(gradient.sphere(ball).position, DVec3::NEG_Y);
/// assert_eq!(gradient.sphere(ball).velocity, DVec3::new(0.0, -2.0, 0.0));
/// # Ok::<(), carom::DerivativeError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Tape {
    pieces: Vec<Piece>,
    /// For each sphere, the index of its last linear map, if that is a flight.
    last_flights: Vec<Option<usize>>,
    followed: Followed,
}

impl Tape {
    /// Starts with the present state of a world.
    ///
    /// # Errors
    /// [`DerivativeError::Unsupported`] if the world has something whose derivatives are not known.
    pub fn start(world: &World) -> Result<Self, DerivativeError> {
        let followed = Followed::start(world)?;
        let last_flights = vec![None; followed.ids.len()];
        Ok(Self { pieces: Vec::new(), last_flights, followed })
    }

    /// Advances the world by `dt` \[s\] and records the step. A change of the world from outside since the last
    /// step has no derivative of its own.
    ///
    /// # Errors
    /// Those of [`Tangents::step`](crate::Tangents::step).
    pub fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DerivativeError> {
        let pieces = self.followed.step(world, dt)?;
        self.last_flights.resize(self.followed.ids.len(), None);
        pieces.into_iter().for_each(|piece| self.record(piece));
        Ok(())
    }

    /// Appends a linear map; consecutive flights of one sphere become one.
    fn record(&mut self, piece: Piece) {
        match &piece {
            Piece::Flight { place, time, drag_rate } => {
                if let Some(last) = self.last_flights[*place]
                    && let Piece::Flight { time: so_far, drag_rate: before, .. } =
                        &mut self.pieces[last]
                    && before == drag_rate
                {
                    *so_far += time;
                    return;
                }
                self.last_flights[*place] = Some(self.pieces.len());
            }
            Piece::Supported(flight) => {
                if let Some(last) = self.last_flights[flight.place]
                    && let Piece::Supported(before) = &mut self.pieces[last]
                    && before.goes_on_with(flight)
                {
                    (before.time, before.ending) = (before.time + flight.time, flight.ending);
                    before.after = flight.after;
                    return;
                }
                self.last_flights[flight.place] = Some(self.pieces.len());
            }
            // A later flight is not joined with one before the change.
            Piece::InputChange(change) => self.last_flights[change.place] = None,
            Piece::Departure(it) => self.last_flights[it.place] = None,
            Piece::Cornered(it) => self.last_flights[it.place] = None,
            Piece::Curved(_) | Piece::Tightening(_) | Piece::Passage(_) => {}
            // Directions are checked, gradients are of those that pass.
            Piece::Loose(_) => return,
            Piece::Impact(saltation) => {
                for sphere in saltation.spheres() {
                    self.last_flights[sphere.place] = None;
                }
            }
            Piece::Group(group) => {
                group.places.iter().for_each(|&place| self.last_flights[place] = None);
            }
        }
        self.pieces.push(piece);
    }

    /// Returns the gradient of a number with respect to the initial state. `derivatives` are those of the number
    /// with respect to the final motion of spheres; spheres that are missing there count as zero.
    ///
    /// Where a ball met bodies that touch without being pressed together, [`Margin::interval`] is 0 and the gradient is
    /// the derivative along changes that keep them in touch; no other changes have one.
    ///
    /// # Errors
    /// [`DerivativeError::UnknownSphere`] if one of the spheres is not in the record; the error that ended the record.
    pub fn gradient(
        &self,
        derivatives: &[(SphereId, SphereTangent)],
    ) -> Result<Variation, DerivativeError> {
        self.followed.check()?;
        let mut spheres = vec![SphereTangent::default(); self.followed.ids.len()];
        for &(id, derivative) in derivatives {
            spheres[self.followed.place_of(id)?] = derivative;
        }
        let mut gradient = Variation::default();
        let mut accelerations = vec![DVec3::ZERO; spheres.len()];
        for piece in self.pieces.iter().rev() {
            match *piece {
                Piece::Flight { place, time, drag_rate } => {
                    let over = Piece::propagator(time, drag_rate);
                    accelerations[place] += spheres[place].fly_back(over);
                }
                Piece::Supported(ref flight) => flight.pass_back(&mut spheres, &mut gradient),
                Piece::InputChange(ref change) => change.pass_back(&spheres, &mut gradient),
                Piece::Curved(ref flight) => {
                    flight.pass_back(&mut spheres, (&mut gradient, &mut accelerations));
                }
                Piece::Tightening(ref thread) => thread.pass_back(&mut spheres, &mut gradient),
                Piece::Cornered(ref flight) => flight.pass_back(&mut spheres, &mut gradient),
                Piece::Departure(ref departure) => departure.pass_back(&mut spheres, &mut gradient),
                Piece::Passage(ref passage) => passage.pass_back(&mut spheres, &mut gradient),
                Piece::Impact(ref saltation) => saltation.pass_back(&mut spheres, &mut gradient),
                Piece::Loose(_) => {}
                Piece::Group(ref group) => group.pass_back(&mut spheres, &mut gradient),
            }
        }
        for ((&id, by), acceleration) in self.followed.ids.iter().zip(&spheres).zip(accelerations) {
            gradient.acceleration += acceleration;
            let sphere = gradient.sphere_mut(id);
            sphere.position += by.position;
            sphere.velocity += by.velocity;
            sphere.angular_velocity += by.angular_velocity;
            sphere.acceleration += acceleration;
        }
        Ok(gradient)
    }

    /// Returns the number of recorded impacts.
    pub fn impacts(&self) -> usize {
        self.pieces
            .iter()
            .filter(|piece| matches!(piece, Piece::Impact(_) | Piece::Group(_)))
            .count()
    }

    /// Returns how near the run came to where derivatives end.
    pub fn margin(&self) -> Margin {
        self.followed.margin
    }
}
