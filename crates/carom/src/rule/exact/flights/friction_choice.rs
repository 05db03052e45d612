//! The choice of what friction does in each contact over a step.

use glam::DVec3;

use super::curve_contacts::{ContactSphere, CurveContact, CurveContacts, Moving};
use super::friction_state::FrictionState;
use crate::integrate::field::Values;
use crate::norm::Norm;

/// Part of the speeds in a contact below which a slip counts as none: more than rounding leaves of one that ends.
const SLOW: f64 = 1e-9;
/// Part of the relative speeds in a contact below which friction keeps its direction over a step, that of the slip in the
/// middle. Where a slip begins or ends, its direction may turn ever faster the smaller it is, and no step of finite length
/// follows.
const SMALL: f64 = 1e-3;
/// Most times that the directions of small slips are found, each of which depends on the others.
const MOST_TURNS: usize = 8;
/// Directions of friction that differ by less than this are the same.
const SAME_DIRECTION: f64 = 1e-6;
/// A slip ends a step of constant direction where it exceeds that part by this factor.
const BEYOND: f64 = 1.01;
/// Part of a slip that counts as none below which its direction is rounding.
const LEAST: f64 = 1e-3;
/// Part of the largest friction by which a contact that rolls may exceed it.
const EXCESS: f64 = 1e-9;
/// A persistent contact opens where it pulls with more than this part of the forces at work: the spheres then part for
/// certain. Until then its force does no work.
pub(super) const OPENS: f64 = 1e-9;
/// Friction is the largest possible if no more than this part is missing: rounding.
const ROUNDING: f64 = 1e-12;
/// The relaxation has converged when forces change by less than this part of the largest.
const CONVERGED: f64 = 1e-13;
/// Part of the forces at work below which contact forces do not converge further: they are rounding of the former.
const HARDLY_PRESSES: f64 = 1e-2;
/// Most changes of states after it.
const MOST_CHANGES: usize = 8;
/// Most sweeps of the relaxation.
const MOST_SWEEPS: usize = 1000;

/// Below which speeds a slip counts as none or as small \[m/s\].
#[derive(Debug, Clone, Copy)]
struct SlipLimits {
    none: f64,
    small: f64,
}

impl CurveContacts<'_> {
    /// Chooses the states of all contacts for a step of some length \[s\] that begins with this motion and these
    /// accelerations without contacts \[m/s²\]: what slides goes on, and what does not begins to slide where rolling takes
    /// more than the largest friction.
    pub fn choose_states(
        &mut self,
        moving: Moving,
        spheres: &[ContactSphere],
        free: &Values,
        length: f64,
    ) {
        if !self.have_friction() {
            return;
        }
        // The contacts were found to press with friction against the slips that there are, of which those count as none
        // that are so beside the whole acceleration.
        let net: Vec<f64> = free.accelerations.iter().map(|it| it.norm()).collect();
        for (length, sizes) in [(length, &free.sizes), (0.0, &free.sizes), (0.0, &net)] {
            let limits = self.states_by_slip(moving, spheres, sizes);
            let at = self.states_over((moving, spheres), free, &limits, length);
            if self.hardest_pull(spheres, &at.sizes).is_none() {
                return;
            }
        }
    }

    /// Changes the states by slip, within these limits of each contact, to those for a step of some length \[s\]. Returns
    /// the accelerations with them \[m/s²\].
    fn states_over(
        &mut self,
        (moving, spheres): (Moving, &[ContactSphere]),
        free: &Values,
        limits: &[SlipLimits],
        length: f64,
    ) -> Values {
        let at = self.turn_until_settled(moving, spheres, free, length);
        for (slack, contact) in self.slack.iter_mut().zip(&self.contacts) {
            *slack = OPENS * spheres[contact.second].mass * at.sizes[contact.second];
        }
        let pulls = self.hardest_pull(spheres, &at.sizes).is_some();
        let none_begins = vec![false; limits.len()];
        if !pulls && self.contacts_that_break(&none_begins, moving, spheres, &at).is_empty() {
            return at;
        }
        if pulls {
            // Friction may allow several solutions: that of the search for contacts that press.
            self.forces.fill((0.0, DVec3::ZERO));
        }
        self.relax(moving, spheres, free);
        let begins = self.begin_slips(limits, moving, spheres);
        self.change_broken(begins, limits, (moving, spheres), free)
    }

    /// Finds the directions of small slips, each of which depends on the others. Returns the accelerations with them
    /// \[m/s²\].
    fn turn_until_settled(
        &mut self,
        moving: Moving,
        spheres: &[ContactSphere],
        free: &Values,
        length: f64,
    ) -> Values {
        let mut at = self.accelerations_with(moving, spheres, free);
        for _ in 0..MOST_TURNS {
            let turn = self.turn_small_slips(moving, spheres, &at.accelerations, length);
            if turn > 0.0 {
                at = self.accelerations_with(moving, spheres, free);
            }
            if turn <= SAME_DIRECTION {
                break;
            }
        }
        at
    }

    /// The accelerations with contacts \[m/s²\].
    fn accelerations_with(
        &mut self,
        moving: Moving,
        spheres: &[ContactSphere],
        free: &Values,
    ) -> Values {
        let mut at = free.clone();
        self.add(moving, spheres, &mut at);
        at
    }

    /// Begins a slip in each contact that rolls with the largest friction. Returns in which.
    fn begin_slips(
        &mut self,
        limits: &[SlipLimits],
        moving: Moving,
        spheres: &[ContactSphere],
    ) -> Vec<bool> {
        let mut begins = vec![false; limits.len()];
        for number in 0..self.contacts.len() {
            let (normal_force, friction) = self.forces[number];
            let largest = self.contacts[number].friction * normal_force;
            let is_largest = largest > 0.0 && friction.norm() >= (1.0 - ROUNDING) * largest;
            if self.states[number] == FrictionState::Rolls && is_largest {
                begins[number] = true;
                self.begin_slip(number, limits[number], moving, spheres);
            }
        }
        begins
    }

    /// Changes the states of contacts that roll with too much friction, or in which friction moves the surfaces where a
    /// slip `begins`. Returns the accelerations with contacts \[m/s²\].
    fn change_broken(
        &mut self,
        mut begins: Vec<bool>,
        limits: &[SlipLimits],
        (moving, spheres): (Moving, &[ContactSphere]),
        free: &Values,
    ) -> Values {
        let mut at = self.accelerations_with(moving, spheres, free);
        for _ in 0..MOST_CHANGES {
            let broken = self.contacts_that_break(&begins, moving, spheres, &at);
            if broken.is_empty() {
                break;
            }
            for number in broken {
                if begins[number] {
                    self.states[number] = FrictionState::Rolls;
                } else {
                    self.begin_slip(number, limits[number], moving, spheres);
                }
                begins[number] = !begins[number];
            }
            at = self.accelerations_with(moving, spheres, free);
        }
        at
    }

    /// The contact that pulls most, beyond rounding of the sizes of accelerations \[m/s²\]; `None` if none pulls.
    pub fn hardest_pull(&self, spheres: &[ContactSphere], sizes: &[f64]) -> Option<usize> {
        let beyond = |number: &usize| {
            let place = self.contacts[*number].second;
            self.forces[*number].0 + OPENS * spheres[place].mass * sizes[place]
        };
        let pulling = (0..self.contacts.len()).filter(|number| beyond(number) < 0.0);
        pulling.min_by(|one, other| beyond(one).total_cmp(&beyond(other)))
    }

    /// The contacts that roll with more than the largest friction, and those of the ones where slip `begins` in which
    /// friction would move the surfaces.
    fn contacts_that_break(
        &self,
        begins: &[bool],
        moving: Moving,
        spheres: &[ContactSphere],
        at: &Values,
    ) -> Vec<usize> {
        let breaks = |&number: &usize| match self.states[number] {
            FrictionState::Rolls => {
                let friction = self.forces[number].1.norm();
                let largest = (1.0 + 0.5 * EXCESS) * self.largest_friction(number);
                // Without friction a slip would have no direction, though a pull allows less than none.
                friction > 0.0 && friction > largest + 0.5 * self.slack[number]
            }
            FrictionState::Slides { direction, .. } if begins[number] => {
                let sliding = self.sliding(number, moving, spheres, &at.accelerations);
                sliding.dot(direction) < 0.0
            }
            _ => false,
        };
        (0..self.contacts.len()).filter(breaks).collect()
    }

    /// Begins a slip against the present friction of a contact.
    fn begin_slip(
        &mut self,
        number: usize,
        limits: SlipLimits,
        moving: Moving,
        spheres: &[ContactSphere],
    ) {
        let friction = self.forces[number].1;
        let slip = self.slip(number, moving, spheres).norm();
        self.states[number] = FrictionState::Slides {
            direction: -friction / friction.norm(),
            least: f64::INFINITY,
            most_back: 2.0 * slip + 10.0 * LEAST * limits.none,
            most: BEYOND * limits.small,
        };
    }

    /// Sets the direction of friction on small slips to that in the middle of a step, or of what is left of it.
    /// Returns the largest change of a direction.
    ///
    /// With the deceleration c by friction and the acceleration p of the slip s by all else, friction along the unit
    /// vector of `s + p T` leaves the slip in that direction after T, and ends it where `|s + p T| = c T`.
    fn turn_small_slips(
        &mut self,
        moving: Moving,
        spheres: &[ContactSphere],
        accelerations: &[DVec3],
        length: f64,
    ) -> f64 {
        let mut turn = 0.0f64;
        for number in 0..self.contacts.len() {
            let FrictionState::Slides { direction, least, most_back, most } = self.states[number]
            else {
                continue;
            };
            if least < f64::INFINITY {
                continue;
            }
            let (contact, normal) = (&self.contacts[number], self.normals[number]);
            let slip = self.slip(number, moving, spheres);
            let braking = contact.friction * self.forces[number].0 * self.response(number, spheres);
            let sliding = self.sliding(number, moving, spheres, accelerations);
            let other = sliding - sliding.dot(normal) * normal + braking * direction;
            // Up to where it ends, friction is against the slip that there is.
            let turned_back = -0.5 * slip.length_squared() / slip.dot(other);
            let turned_back = if turned_back > 0.0 { turned_back } else { f64::INFINITY };
            let time = time_to_end(slip, other, braking).min(0.5 * length).min(turned_back);
            let middle = slip + time * other;
            let speed = middle.norm();
            if speed > 0.0 {
                turn = turn.max((middle / speed - direction).norm());
                let direction = middle / speed;
                self.states[number] = FrictionState::Slides { direction, least, most_back, most };
            }
        }
        turn
    }

    /// How far a contact that rolls is from sliding: the largest friction, with what counts as rounding, less its own
    /// \[N\].
    pub fn margin_of_rolling(&self, number: usize) -> f64 {
        let most = (1.0 + EXCESS) * self.largest_friction(number) + self.slack[number];
        most - self.forces[number].1.norm()
    }

    /// The largest friction in a contact \[N\]. Up to where it opens, its normal force is below zero by the slack.
    fn largest_friction(&self, number: usize) -> f64 {
        self.contacts[number].friction * (self.forces[number].0 + self.slack[number])
    }

    /// The acceleration of the slip of a contact for a unit of friction \[1/kg\].
    fn response(&self, number: usize, spheres: &[ContactSphere]) -> f64 {
        let of_end = |(place, _): (usize, f64)| {
            let ContactSphere { mass, inertia_factor, .. } = spheres[place];
            (1.0 + 1.0 / inertia_factor) / mass
        };
        self.contacts[number].ends().map(of_end).sum()
    }

    /// Finds the forces of contacts that may open, under these accelerations without contacts \[m/s²\]. Returns the
    /// accelerations with them.
    pub fn unilateral(
        &mut self,
        moving: Moving,
        spheres: &[ContactSphere],
        free: &Values,
    ) -> Vec<DVec3> {
        self.states_by_slip(moving, spheres, &free.sizes);
        self.forces.fill((0.0, DVec3::ZERO));
        self.relax(moving, spheres, free)
    }

    /// Sets the states by whether surfaces slide beside the speeds and these accelerations \[m/s²\]. Returns the limits of
    /// the slip in each contact.
    fn states_by_slip(
        &mut self,
        moving: Moving,
        spheres: &[ContactSphere],
        accelerations: &[f64],
    ) -> Vec<SlipLimits> {
        self.measure(moving);
        let limits_of = |number: usize| self.slip_limits(number, moving, spheres, accelerations);
        let limits: Vec<SlipLimits> = (0..self.contacts.len()).map(limits_of).collect();
        for (number, &SlipLimits { none, small }) in limits.iter().enumerate() {
            let slip = self.slip(number, moving, spheres);
            let speed = slip.norm();
            self.states[number] = if self.contacts[number].friction == 0.0 {
                FrictionState::None
            } else if speed <= none {
                FrictionState::Rolls
            } else {
                let direction = slip / speed;
                let (least, most) = match speed <= small {
                    true => (f64::INFINITY, BEYOND * small),
                    false => (LEAST * none, f64::INFINITY),
                };
                FrictionState::Slides { direction, least, most_back: 0.0, most }
            };
        }
        limits
    }

    /// The limits of the slip in a contact of spheres with these accelerations \[m/s²\].
    fn slip_limits(
        &self,
        number: usize,
        moving: Moving,
        spheres: &[ContactSphere],
        accelerations: &[f64],
    ) -> SlipLimits {
        let ends = || self.contacts[number].ends().map(|(place, _)| place);
        let falls = |place: usize| (accelerations[place] * spheres[place].radius).sqrt();
        let falls: f64 = ends().map(falls).sum();
        let speed = |place: usize| {
            let turning = spheres[place].radius * moving.angular_velocities[place].norm();
            moving.velocities[place].norm() + turning
        };
        let speeds: f64 = ends().map(speed).sum();
        let across = self.across(number, moving).norm();
        let relative = across + self.spin(number, moving, spheres).norm();
        let none = SLOW * (speeds + falls);
        SlipLimits { none, small: (SMALL * (relative + falls)).max(none) }
    }

    /// Relaxes the forces until none pulls, friction is at most the largest, and no contact closes or slides that need
    /// not. Returns the accelerations \[m/s²\].
    ///
    /// Source: Moreau, Comput. Methods Appl. Mech. Eng. 177, 329 (1999), section 7; Jean, ibid., 235.
    fn relax(&mut self, moving: Moving, spheres: &[ContactSphere], free: &Values) -> Vec<DVec3> {
        let mut accelerations = free.accelerations.clone();
        let at_work = |contact: &CurveContact| {
            let forces = contact.ends().map(|(place, _)| spheres[place].mass * free.sizes[place]);
            forces.fold(0.0, f64::max)
        };
        let least = HARDLY_PRESSES * self.contacts.iter().map(at_work).fold(0.0, f64::max);
        for number in 0..self.contacts.len() {
            let (normal_force, friction) = self.forces[number];
            let normal_force = normal_force.max(0.0);
            let friction = self.within(number, normal_force, friction);
            self.forces[number] = (0.0, DVec3::ZERO);
            self.set_force(number, (normal_force, friction), spheres, &mut accelerations);
        }
        for _ in 0..MOST_SWEEPS {
            let (mut change, mut largest) = (0.0f64, 0.0f64);
            for number in 0..self.contacts.len() {
                let by = self.relax_one(number, moving, spheres, &mut accelerations);
                change = change.max(by);
                largest = largest.max(self.forces[number].0);
            }
            if change <= CONVERGED * largest.max(least) {
                break;
            }
        }
        accelerations
    }

    /// Relaxes one contact. Returns how much its force changes \[N\].
    fn relax_one(
        &mut self,
        number: usize,
        moving: Moving,
        spheres: &[ContactSphere],
        accelerations: &mut [DVec3],
    ) -> f64 {
        let contact = &self.contacts[number];
        let (normal_force, friction) = self.forces[number];
        let opening = self.opening(number, moving, accelerations);
        let normal = self.normals[number];
        let sliding = self.sliding(number, moving, spheres, accelerations);
        let sliding = sliding - sliding.dot(normal) * normal;
        let part = |place: usize| 1.0 / spheres[place].mass;
        let along_normal: f64 = contact.ends().map(|it| part(it.0)).sum();
        let along = self.response(number, spheres);
        let new_normal = (normal_force - opening / along_normal).max(0.0);
        let new_friction = self.within(number, new_normal, friction - sliding / along);
        let change = (new_normal - normal_force).abs() + (new_friction - friction).norm();
        self.set_force(number, (new_normal, new_friction), spheres, accelerations);
        change
    }

    /// The friction that a contact with this normal force allows \[N\].
    fn within(&self, number: usize, normal_force: f64, friction: DVec3) -> DVec3 {
        let largest = self.contacts[number].friction * normal_force;
        match self.states[number] {
            FrictionState::None => DVec3::ZERO,
            FrictionState::Slides { direction, .. } => -largest * direction,
            FrictionState::Rolls => {
                let size = friction.norm();
                if size > largest { friction * (largest / size) } else { friction }
            }
        }
    }

    /// Sets the force of a contact \[N\] and updates the accelerations.
    fn set_force(
        &mut self,
        number: usize,
        force: (f64, DVec3),
        spheres: &[ContactSphere],
        accelerations: &mut [DVec3],
    ) {
        let (normal_force, friction) = self.forces[number];
        let normal = self.normals[number];
        let change = (force.0 - normal_force) * normal + (force.1 - friction);
        self.forces[number] = force;
        let has_torque = self.states[number] != FrictionState::None;
        self.contacts[number].push((normal, change), has_torque, spheres, accelerations);
    }
}

/// When friction ends a slip \[m/s\] that it leaves in its direction, with the acceleration by all else and the deceleration
/// by friction \[m/s²\]; infinite if it does not.
fn time_to_end(slip: DVec3, other: DVec3, braking: f64) -> f64 {
    // |s|²/T² + 2 s·p/T = c² - p²
    let rest = (braking - other.norm()) * (braking + other.norm());
    if rest <= 0.0 {
        return f64::INFINITY;
    }
    let along = slip.dot(other);
    (along + (along * along + slip.length_squared() * rest).sqrt()) / rest
}
