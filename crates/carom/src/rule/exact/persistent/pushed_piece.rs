//! A piece of path of spheres on planes that push each other with friction (`docs/physics/persistent-contacts.md`).

use glam::DVec3;

use super::accelerations::Accelerations;
use super::piece::{TURN, turning_time};
use super::pushed_sphere::Response;
use super::pushed_spheres::{Direction, Directions, Forces, PushedSpheres};
use super::sliding::sliding_time;
use crate::norm::Norm;
use crate::rule::exact::contacts::{Member, Touch};

/// A velocity stays on a straight line if the transverse part of its rate is below this part of the accelerations
/// at work: rounding.
const STRAIGHT: f64 = 1e-13;
/// A direction turns over a piece by the angle that moves a sphere aside by this part of its radius, but by at
/// least a thousandth and at most the next constant \[rad\]: slips that end turn fast.
const MOST_ASIDE: f64 = 1e-10;
const LARGEST_TURN: f64 = 0.05;
/// Part of the time to its end for which a velocity that also turns is followed in one piece.
const PART_TO_END: f64 = 0.5;

/// The motion of spheres that push each other over a piece of path.
pub(super) struct PushedPiece {
    /// The spheres at the start of the piece.
    pub members: Vec<Member>,
    pub rates: Vec<Rates>,
    /// How long that holds \[s\].
    pub valid_for: f64,
    /// Work of belts at the start, where friction ends slips at once \[J\].
    pub belt_work: f64,
}

/// Rates of change of the motion of a sphere.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Rates {
    /// \[m/s²\]
    pub acceleration: DVec3,
    /// \[rad/s²\]
    pub angular_acceleration: DVec3,
    /// Power of belts on it \[W\].
    pub collider_power: f64,
}

/// How long the direction of a velocity that friction opposes lasts.
#[derive(Clone, Copy)]
struct Lifetime {
    /// \[s\]
    valid_for: f64,
    /// Whether the direction does not turn, and the velocity ends at zero if it ends.
    is_straight: bool,
}

impl Lifetime {
    const ENDLESS: Self = Self { valid_for: f64::INFINITY, is_straight: true };

    /// The lifetime of a velocity \[m/s\] with its rate of change \[m/s²\], for a sphere of this radius \[m\] and
    /// accelerations of this size \[m/s²\].
    fn of([velocity, rate]: [DVec3; 2], radius: f64, scale: f64) -> Self {
        let speed = velocity.norm();
        let direction = velocity / speed;
        let along = rate.dot(direction);
        let aside = (rate - along * direction).norm();
        let ends = if along < 0.0 { speed / -along } else { f64::INFINITY };
        if aside <= STRAIGHT * (rate.norm() + scale) {
            return Self { valid_for: ends, is_straight: true };
        }
        // The way aside is a twelfth of turn³ speed²/aside.
        let unseen = libm::cbrt(12.0 * MOST_ASIDE * radius * aside / (speed * speed));
        let turns = unseen.clamp(TURN, LARGEST_TURN) * speed / aside;
        Self { valid_for: turns.min(PART_TO_END * ends), is_straight: false }
    }
}

impl PushedSpheres<'_> {
    /// Returns the next piece of path. It lasts while nothing that the forces depend on turns by a thousandth, ends
    /// or begins. Over the piece, velocities and angular velocities change by as much as on the true path; places
    /// are right to the third order. `None` where no forces hold the contacts.
    pub fn piece(mut self) -> Option<PushedPiece> {
        self.close_gaps();
        let belt_work = self.end_slow_motion() + self.stop_along_normals();
        let mut directions = self.directions();
        let start = self.forces(&self.group.members, self.group.time, &directions, &self.known)?;
        if start.responses.iter().any(|response| response.normal_force < 0.0) {
            // A sphere is lifted off its plane.
            return None;
        }
        let lifetimes = self.lifetimes(&directions, &start);
        let ends = lifetimes.valid_for();
        let turns = self.turning_time(&start);
        let valid_for = ends.min(turns).max(self.least_duration());
        let rates = if turns == f64::INFINITY && lifetimes.are_straight() {
            self.rates_of(&start)
        } else {
            lifetimes.fix(&mut directions, &start, valid_for);
            self.mean_rates(&directions, &start, valid_for)?
        };
        let valid_for = valid_for.min(self.time_on_planes(&rates)).max(self.least_duration());
        Some(PushedPiece { members: self.group.members, rates, valid_for, belt_work })
    }

    /// Time \[s\] in which the normal of a contact turns by a thousandth.
    fn turning_time(&self, start: &Forces) -> f64 {
        let members = &self.group.members;
        let parts = self.pushing().iter().zip(&start.on_second).flat_map(|(touch, force)| {
            touch.places().map(|place| force.norm() / members[place].species.mass)
        });
        let largest = parts.fold(0.0, f64::max);
        let each = start.responses.iter().map(|response| response.acceleration).collect();
        let accelerations = Accelerations { each, largest };
        turning_time(members, self.pushing(), &accelerations, f64::INFINITY)
    }

    /// Time \[s\] until a sphere may reach the end of a face.
    fn time_on_planes(&self, rates: &[Rates]) -> f64 {
        let each = rates.iter().map(|rate| rate.acceleration).collect();
        let accelerations = Accelerations { each, largest: 0.0 };
        sliding_time(self.context, &self.group, &self.group.touches, &accelerations)
    }

    fn lifetimes(&self, directions: &Directions, start: &Forces) -> Lifetimes {
        let places = 0..self.group.members.len();
        Lifetimes {
            spheres: places.map(|place| self.sphere_lifetimes(place, directions, start)).collect(),
            contacts: self
                .pushing()
                .iter()
                .enumerate()
                .map(|it| self.of_contact(it, start))
                .collect(),
        }
    }

    /// The lifetimes of the velocities that friction of the plane opposes, for the sphere at a place.
    fn sphere_lifetimes(
        &self,
        place: usize,
        directions: &Directions,
        start: &Forces,
    ) -> SphereLifetimes {
        let members = &self.group.members;
        let (response, sphere) = (start.responses[place], start.spheres[place]);
        let angular_velocity = members[place].angular_velocity;
        let velocity = self.velocity_on_plane(place, &members[place]);
        let is = |direction: Direction| direction != Direction::None;
        let (slides, moves) = (is(directions.slides[place]), is(directions.moves[place]));
        let lifetime =
            |both: [DVec3; 2]| Lifetime::of(both, sphere.radius, sphere.acceleration.norm());
        let slip_rate = response.acceleration
            - sphere.radius * response.angular_acceleration.cross(sphere.normal);
        let plane = self.planes[place].filter(|_| slides && sphere.friction.sliding > 0.0);
        let rolling = Some(velocity).filter(|_| moves && !slides && sphere.friction.rolling > 0.0);
        let spin = angular_velocity.dot(sphere.normal);
        let spin_rate = response.angular_acceleration.dot(sphere.normal);
        let spin_ends = sphere.friction.spinning > 0.0 && spin * spin_rate < 0.0;
        SphereLifetimes {
            slides: plane.map_or(Lifetime::ENDLESS, |plane| {
                lifetime([self.slip(members, &plane), slip_rate])
            }),
            moves: rolling
                .map_or(Lifetime::ENDLESS, |velocity| lifetime([velocity, response.acceleration])),
            spin: if spin_ends { -spin / spin_rate } else { f64::INFINITY },
        }
    }

    /// The lifetime of the slip in a pushing contact, by its number.
    fn of_contact(&self, (number, touch): (usize, &Touch), start: &Forces) -> Lifetime {
        let contact = &start.contacts[number];
        if contact.slides.is_none() || contact.friction == 0.0 {
            return Lifetime::ENDLESS;
        }
        let responds = |place: usize| (start.responses[place], start.spheres[place].radius);
        let rate = contact.rate(contact.first.map(responds), responds(contact.second));
        let spheres = || touch.places().map(|place| &start.spheres[place]);
        let radius = spheres().map(|sphere| sphere.radius).fold(f64::INFINITY, f64::min);
        let scale = spheres().map(|sphere| sphere.acceleration.norm()).sum();
        Lifetime::of([self.slip(&self.group.members, touch), touch.across(rate)], radius, scale)
    }

    /// Mean accelerations \[m/s²\] and angular accelerations \[rad/s²\] over a piece of `h` \[s\], by the method
    /// of Runge and Kutta.
    fn mean_rates(&self, directions: &Directions, start: &Forces, h: f64) -> Option<Vec<Rates>> {
        let mut forces = start.on_second.clone();
        let mut stage: Vec<[DVec3; 3]> = Vec::new();
        let mut sum = vec![Rates::default(); self.group.members.len()];
        for (part, weight) in [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
            let members = self.moved(&stage, part * h);
            let found = self.forces(&members, self.group.time + part * h, directions, &forces)?;
            let rates = self.rates_of(&found);
            for (sum, rates) in sum.iter_mut().zip(&rates) {
                sum.acceleration += weight / 6.0 * rates.acceleration;
                sum.angular_acceleration += weight / 6.0 * rates.angular_acceleration;
                sum.collider_power += weight / 6.0 * rates.collider_power;
            }
            let of = |(member, it): (&Member, &Rates)| {
                [member.velocity, it.acceleration, it.angular_acceleration]
            };
            stage = members.iter().zip(&rates).map(of).collect();
            forces = found.on_second;
        }
        Some(sum)
    }

    /// The spheres after `h` \[s\] with these velocities, accelerations and angular accelerations.
    fn moved(&self, rates: &[[DVec3; 3]], h: f64) -> Vec<Member> {
        let mut members = self.group.members.clone();
        for (member, [velocity, acceleration, angular_acceleration]) in
            members.iter_mut().zip(rates)
        {
            member.position += h * *velocity;
            member.velocity += h * *acceleration;
            member.angular_velocity += h * *angular_acceleration;
        }
        members
    }

    fn rates_of(&self, forces: &Forces) -> Vec<Rates> {
        let of = |(place, response): (usize, &Response)| Rates {
            acceleration: response.acceleration,
            angular_acceleration: response.angular_acceleration,
            collider_power: self.collider_power(place, forces),
        };
        forces.responses.iter().enumerate().map(of).collect()
    }
}

struct SphereLifetimes {
    slides: Lifetime,
    moves: Lifetime,
    /// \[s\]
    spin: f64,
}

/// How long the directions that friction opposes last.
struct Lifetimes {
    spheres: Vec<SphereLifetimes>,
    contacts: Vec<Lifetime>,
}

impl Lifetimes {
    fn all(&self) -> impl Iterator<Item = Lifetime> {
        let lifetimes = self.spheres.iter().flat_map(|sphere| [sphere.slides, sphere.moves]);
        lifetimes.chain(self.contacts.iter().copied())
    }

    /// \[s\]
    fn valid_for(&self) -> f64 {
        let spins = self.spheres.iter().map(|sphere| sphere.spin);
        self.all().map(|it| it.valid_for).chain(spins).fold(f64::INFINITY, f64::min)
    }

    fn are_straight(&self) -> bool {
        self.all().all(|lifetime| lifetime.is_straight)
    }

    /// Fixes the directions of velocities that end within a piece of this length \[s\]: at zero they have none.
    fn fix(&self, directions: &mut Directions, start: &Forces, valid_for: f64) {
        let fix = |direction: &mut Direction, lifetime: Lifetime, now: Option<DVec3>| {
            if let Some(now) = now
                && lifetime.is_straight
                && lifetime.valid_for <= valid_for
            {
                *direction = Direction::Fixed(now);
            }
        };
        for (place, (lifetimes, sphere)) in self.spheres.iter().zip(&start.spheres).enumerate() {
            fix(&mut directions.slides[place], lifetimes.slides, sphere.slides);
            fix(&mut directions.moves[place], lifetimes.moves, sphere.moves);
        }
        let contacts = directions.contacts.iter_mut().zip(&self.contacts).zip(&start.contacts);
        for ((direction, &lifetime), contact) in contacts {
            fix(direction, lifetime, contact.slides);
        }
    }
}
