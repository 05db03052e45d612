//! Friction in impacts: impulses across the normal.

use glam::DVec3;

use crate::friction::{ContactFriction, Slip};
use crate::norm::Norm;
use crate::restitution::ContactRestitution;
use crate::sum::Sum;
use crate::work::Work;

/// Impulses count as found once they change by less than this part of the largest that friction allows.
const SETTLED: f64 = f64::EPSILON;
/// Impulses that stay as they are up to this part of the momentum at hand change by rounding of the velocities.
const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// Normals are the same if their product is larger: far from rounding.
const SAME_NORMAL: f64 = 1.0 - 1e-12;
/// Sweeps over the contacts of a group, at most. Each takes kinetic energy, so any number will do.
const MOST_SWEEPS: usize = 1000;

/// A sphere that friction acts on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SpinningSphere {
    /// Radius \[m\].
    pub radius: f64,
    /// Mass \[kg\].
    pub mass: f64,
    /// Moment of inertia divided by m r².
    pub inertia_factor: f64,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
    /// Angular velocity \[rad/s\].
    pub angular_velocity: DVec3,
}

/// A contact that got a normal impulse.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrictionContact {
    /// Index of sphere 1 among the spheres; none if body 1 is a surface.
    pub first: Option<usize>,
    /// Index of sphere 2.
    pub second: usize,
    /// Unit vector from body 1 to body 2.
    pub normal: DVec3,
    /// Velocity of the surface where it is touched \[m/s\]; zero if body 1 is a sphere.
    pub surface_velocity: DVec3,
    pub friction: ContactFriction,
    /// Restitution along the normal.
    pub restitution: ContactRestitution,
    /// Impulse on body 2 along the normal \[N s\].
    pub normal_impulse: f64,
    /// Impulse of friction on body 2, across the normal \[N s\].
    pub impulse: DVec3,
}

impl SpinningSphere {
    /// Kinetic energy of rotation \[J\].
    pub fn rotational_energy(&self) -> f64 {
        let speed = self.radius * self.angular_velocity.norm();
        0.5 * self.inertia_factor * self.mass * speed * speed
    }

    /// Speed of the fastest point of its surface, at most \[m/s\].
    fn surface_speed(&self) -> f64 {
        self.velocity.norm() + self.radius * self.angular_velocity.norm()
    }

    /// Returns the velocity that a unit of impulse across the normal gives the surface of the
    /// sphere \[1/kg\].
    fn mobility(&self) -> f64 {
        (1.0 + 1.0 / self.inertia_factor) / self.mass
    }

    /// Changes its motion by an impulse \[N s\] across the normal, which points away from it by this
    /// `side`, 1 or -1.
    fn push(&mut self, normal: DVec3, impulse: DVec3, side: f64) {
        self.velocity += impulse / self.mass;
        let moment_per_radius = self.inertia_factor * self.mass * self.radius;
        self.angular_velocity += side * normal.cross(impulse) / moment_per_radius;
    }
}

impl FrictionContact {
    /// Velocity with which the surface of body 2 slides along that of body 1 \[m/s\].
    fn slip(&self, spheres: &[SpinningSphere]) -> DVec3 {
        let second = &spheres[self.second];
        let mut relative = second.velocity - self.surface_velocity;
        let mut turning = second.radius * second.angular_velocity;
        if let Some(first) = self.first {
            relative -= spheres[first].velocity;
            turning += spheres[first].radius * spheres[first].angular_velocity;
        }
        relative - relative.dot(self.normal) * self.normal - turning.cross(self.normal)
    }

    /// The mass that a slip has to be stopped of \[kg\].
    fn mass(&self, spheres: &[SpinningSphere]) -> f64 {
        let first = self.first.map_or(0.0, |first| spheres[first].mobility());
        1.0 / (first + spheres[self.second].mobility())
    }

    /// The mass of a slip times the speeds of the surfaces \[N s\].
    fn momentum(&self, spheres: &[SpinningSphere]) -> f64 {
        let places = self.first.into_iter().chain([self.second]);
        let speeds: f64 = places.map(|place| spheres[place].surface_speed()).sum();
        self.mass(spheres) * (speeds + self.surface_velocity.norm())
    }

    /// The slip that friction would leave if it were large enough \[m/s\], in an impact with these contacts.
    fn target(&self, contacts: &[Self], spheres: &[SpinningSphere]) -> DVec3 {
        let slip = self.slip(spheres);
        if self.friction.cushion == 0.0 {
            return -self.friction.tangential_restitution * slip;
        }
        let second = &spheres[self.second];
        let first = self.first.map(|first| &spheres[first]);
        let lightness = 1.0 / second.mass + first.map_or(0.0, |first| 1.0 / first.mass);
        let other = first.map_or(self.surface_velocity, |first| first.velocity);
        // Both faces of an edge bear a part of its impulse.
        let is_same = |it: &&Self| {
            (it.first, it.second) == (self.first, self.second)
                && it.normal.dot(self.normal) > SAME_NORMAL
        };
        let pushed: f64 = contacts.iter().filter(is_same).map(|it| it.normal_impulse).sum();
        let change = pushed * lightness;
        let approach = change - (second.velocity - other).dot(self.normal);
        let slipping = Slip {
            speed: slip.norm(),
            change,
            restitution: self.restitution.at(approach),
            mobility_ratio: 1.0 / (self.mass(spheres) * lightness),
        };
        -self.friction.reversal(&slipping) * slip
    }

    /// The largest impulse of friction \[N s\].
    fn limit(&self) -> f64 {
        self.friction.sliding * self.normal_impulse
    }

    /// Adds to the impulse of friction.
    fn push(&mut self, spheres: &mut [SpinningSphere], change: DVec3) {
        self.impulse += change;
        spheres[self.second].push(self.normal, change, -1.0);
        if let Some(first) = self.first {
            spheres[first].push(self.normal, -change, 1.0);
        }
    }
}

/// Applies friction to contacts that got normal impulses. Returns the change of kinetic energy \[J\], <= 0
/// but for rounding, measured against the surfaces.
///
/// The impulses are those of least kinetic energy, each at most the coefficient of friction times the
/// normal impulse; the tangential restitution of a contact turns part of its slip round. For one contact
/// that is Walton's law, `J = -s/|s| min((1 + b) m |s|, mu Jn)` with the slip s and `1/m = Σ (1 + 1/k)/m_i`
/// (Foerster, Louge, Chang and Allia, Phys. Fluids 6, 1108 (1994)).
pub(crate) fn apply_friction(
    work: &Work,
    contacts: &mut [FrictionContact],
    spheres: &mut [SpinningSphere],
) -> f64 {
    let largest = contacts.iter().map(FrictionContact::limit).fold(0.0, f64::max);
    if largest == 0.0 {
        return 0.0;
    }
    if contacts.len() == 1 {
        let target = contacts[0].target(contacts, spheres);
        return sweeps(work, contacts, spheres, &[target], largest);
    }
    let targets = contacts.iter().map(|contact| contact.target(contacts, spheres));
    let targets: Vec<DVec3> = targets.collect();
    let (before, free) = (spheres.to_vec(), contacts.to_vec());
    let change = sweeps(work, contacts, spheres, &targets, largest);
    if change <= 0.0 || targets.iter().all(|&target| target == DVec3::ZERO) {
        return change;
    }
    // What one contact gives back, another one need not have taken.
    spheres.copy_from_slice(&before);
    contacts.copy_from_slice(&free);
    sweeps(work, contacts, spheres, &vec![DVec3::ZERO; contacts.len()], largest)
}

/// Sweeps over the contacts, each of which gets the impulse that brings its slip to the target \[m/s\] or as
/// near to that as friction allows, with the others as they are.
fn sweeps(
    work: &Work,
    contacts: &mut [FrictionContact],
    spheres: &mut [SpinningSphere],
    targets: &[DVec3],
    largest: f64,
) -> f64 {
    let mut energy = Sum::default();
    let momenta = contacts.iter().map(|contact| contact.momentum(spheres));
    let rounding = ROUNDING * momenta.fold(0.0, f64::max);
    let mut moved_before = f64::INFINITY;
    for _ in 0..MOST_SWEEPS {
        let mut moved = 0.0_f64;
        for (contact, &target) in contacts.iter_mut().zip(targets) {
            let slip = contact.slip(spheres);
            let wanted = contact.impulse - contact.mass(spheres) * (slip - target);
            let (size, limit) = (wanted.norm(), contact.limit());
            let limited = if size > limit { wanted * (limit / size) } else { wanted };
            let change = limited - contact.impulse;
            contact.push(spheres, change);
            // An impulse does the work of the mean slip.
            energy.add(0.5 * change.dot(slip + contact.slip(spheres)));
            moved = moved.max(change.norm());
        }
        let is_rounding = moved <= rounding && moved >= moved_before;
        moved_before = moved;
        let is_settled = contacts.len() == 1 || moved <= SETTLED * largest || is_rounding;
        if is_settled || !work.spend(contacts.len() as u64) {
            break;
        }
    }
    energy.value()
}
