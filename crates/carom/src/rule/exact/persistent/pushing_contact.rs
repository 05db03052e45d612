//! The contact of two spheres on planes that push each other: its normal force and its friction
//! (`docs/physics/persistent-contacts.md`).

use glam::{DMat3, DVec3};

use super::pushed_sphere::{Push, PushedSphere, Response};
use crate::norm::Norm;
use crate::work::Work;

/// Forces count as found once they change by less than this part of the largest: some hundred roundings.
const SETTLED: f64 = 256.0 * f64::EPSILON;
/// Where sweeps over many contacts end without that, changes below this part of the largest are taken.
const ACCEPTED: f64 = 1e-9;
/// Sweeps over the contacts, at most. Without friction each is one of Gauss and Seidel, and converges.
const MOST_SWEEPS: usize = 1000;
/// Steps of the methods for one contact, at most. Where the spheres keep their states one step is exact.
const MOST_STEPS: usize = 16;
/// Accelerations count as zero below this part of those at work: some roundings.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The contact of two pushed spheres.
#[derive(Debug, Clone, Copy)]
pub(super) struct PushingContact {
    /// Places of both among the spheres.
    pub places: [usize; 2],
    /// Unit normal from sphere 1 to sphere 2.
    pub normal: DVec3,
    /// Coefficient of sliding friction.
    pub friction: f64,
    /// Direction in which the surface of sphere 2 slides along that of sphere 1; `None` where it does not.
    pub slides: Option<DVec3>,
    /// Acceleration of the gap, along the normal, and of the slip that come from the turning of the normal
    /// \[m/s²\].
    pub bias: DVec3,
}

/// The two spheres of a contact, with what other contacts do to them.
struct Pair<'a> {
    contact: &'a PushingContact,
    spheres: [&'a PushedSphere; 2],
    pushes: [Push; 2],
}

/// Returns the forces of contacts on their second spheres \[N\], beginning from `forces`, and the responses of
/// all spheres to them; `None` where they are not found.
///
/// With w the acceleration of a gap and N the normal force: `N >= 0`, `w >= 0`, `N w = 0`
/// ([`contact_forces`](crate::respond::contact_forces)). Friction is `μ N` against the slip, or keeps the slip
/// at zero with less. Each sphere answers all forces on it ([`PushedSphere::response`]), so planes and
/// contacts feel each other.
pub(super) fn forces(
    work: &Work,
    spheres: &[PushedSphere],
    contacts: &[PushingContact],
    forces: &mut [DVec3],
) -> Option<Vec<Response>> {
    let mut changed = 0.0;
    for _ in 0..MOST_SWEEPS {
        let mut largest = 0.0_f64;
        changed = 0.0;
        for (number, contact) in contacts.iter().enumerate() {
            let pushes =
                contact.places.map(|place| push_on(place, spheres, contacts, forces, number));
            let pair = Pair { contact, spheres: contact.places.map(|it| &spheres[it]), pushes };
            let force = pair.force(forces[number])?;
            changed = f64::max(changed, (force - forces[number]).norm());
            largest = largest.max(force.norm());
            forces[number] = force;
        }
        changed = if largest > 0.0 { changed / largest } else { 0.0 };
        let goes_on = work.spend(contacts.len() as u64);
        if contacts.len() == 1 || changed <= SETTLED || !goes_on {
            changed = 0.0;
            break;
        }
    }
    let all = contacts.len();
    let response = |(place, sphere): (usize, &PushedSphere)| {
        sphere.response(push_on(place, spheres, contacts, forces, all))
    };
    (changed <= ACCEPTED).then(|| spheres.iter().enumerate().map(response).collect())
}

/// The push of all contacts but one, by its number, on the sphere at a place.
fn push_on(
    place: usize,
    spheres: &[PushedSphere],
    contacts: &[PushingContact],
    forces: &[DVec3],
    but: usize,
) -> Push {
    let mut push = Push::default();
    for (number, (contact, &force)) in contacts.iter().zip(forces).enumerate() {
        if number == but || force == DVec3::ZERO {
            continue;
        }
        let pair = contact.places.map(|place| &spheres[place]);
        let [first, second] = contact.pushes(pair, force);
        if contact.places[0] == place {
            push = push.plus(first);
        } else if contact.places[1] == place {
            push = push.plus(second);
        }
    }
    push
}

impl Push {
    fn plus(self, other: Self) -> Self {
        Self { force: self.force + other.force, torque: self.torque + other.torque }
    }
}

impl PushingContact {
    /// The pushes on both spheres of a force on the second one \[N\].
    fn pushes(&self, spheres: [&PushedSphere; 2], force: DVec3) -> [Push; 2] {
        // The normal points out of the first sphere and into the second one.
        let turning = -self.normal.cross(force);
        let torques = spheres.map(|sphere| sphere.radius * turning);
        [Push { force: -force, torque: torques[0] }, Push { force, torque: torques[1] }]
    }

    fn across(&self, vector: DVec3) -> DVec3 {
        vector - vector.dot(self.normal) * self.normal
    }
}

impl Pair<'_> {
    /// The force on the second sphere \[N\], near `known`; `None` where it is not found.
    fn force(&self, known: DVec3) -> Option<DVec3> {
        let PushingContact { normal, friction, slides, .. } = *self.contact;
        let opening = self.rate(DVec3::ZERO).dot(normal);
        if opening >= -ROUNDING * self.scale() {
            return Some(DVec3::ZERO);
        }
        let size = known.dot(normal);
        let start = [opening, if size > 0.0 { size } else { -opening * self.mass() }];
        match slides {
            _ if friction == 0.0 => self.force_along(normal, start),
            Some(direction) => self.force_along(normal - friction * direction, start),
            None => self.force_where_it_sticks(known, start),
        }
    }

    /// The force along a direction, with one along the normal in it, under which the gap does not open, by the
    /// secant method from the acceleration of the gap without it \[m/s²\] and its size \[N\], about.
    fn force_along(&self, direction: DVec3, [opening, about]: [f64; 2]) -> Option<DVec3> {
        let enough = ROUNDING * self.scale();
        let (mut last, mut rate_before, mut size) = (0.0, opening, about);
        for _ in 0..MOST_STEPS {
            let rate = self.rate(size * direction).dot(self.contact.normal);
            if rate.abs() <= enough {
                return Some(size * direction);
            }
            let slope = (rate - rate_before) / (size - last);
            if slope.is_nan() || slope <= 0.0 {
                return None;
            }
            (last, rate_before) = (size, rate);
            size = (size - rate / slope).max(0.0);
        }
        None
    }

    /// The force under which neither the gap opens nor the surfaces begin to slide, or if that takes more
    /// friction than there is, that under which they begin to.
    fn force_where_it_sticks(&self, known: DVec3, start: [f64; 2]) -> Option<DVec3> {
        let PushingContact { normal, friction, .. } = *self.contact;
        if let Some(force) = self.force_without_slip(known) {
            let across = self.contact.across(force);
            if across.norm() <= friction * force.dot(normal) {
                return Some(force);
            }
        }
        // Friction acts against the slip that begins under it.
        let mut along = normal;
        let mut force = self.force_along(along, start)?;
        for _ in 0..MOST_STEPS {
            let slip = self.contact.across(self.rate(force));
            if slip.norm() <= ROUNDING * self.scale() {
                break;
            }
            let next = normal - friction * (slip / slip.norm());
            if (next - along).norm() <= SETTLED {
                break;
            }
            along = next;
            force = self.force_along(along, start)?;
        }
        Some(force)
    }

    /// The force under which neither the gap nor the slip changes, by Newton's method from `known`.
    fn force_without_slip(&self, known: DVec3) -> Option<DVec3> {
        let enough = ROUNDING * self.scale();
        let unit = self.mass() * self.scale();
        let mut force = known;
        for _ in 0..MOST_STEPS {
            let rate = self.rate(force);
            if rate.norm() <= enough {
                return Some(force);
            }
            let column = |axis: DVec3| (self.rate(force + unit * axis) - rate) / unit;
            let change = DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z));
            let inverse = change.inverse();
            if !inverse.is_finite() {
                return None;
            }
            force -= inverse * rate;
        }
        None
    }

    /// Acceleration of the gap, along the normal, and of the slip under a force on the second sphere \[m/s²\].
    fn rate(&self, force: DVec3) -> DVec3 {
        let [first, second] = self.responses(force);
        let [r1, r2] = self.spheres.map(|sphere| sphere.radius);
        let turning = r1 * first.angular_acceleration + r2 * second.angular_acceleration;
        let relative = second.acceleration - first.acceleration;
        relative - turning.cross(self.contact.normal) + self.contact.bias
    }

    fn responses(&self, force: DVec3) -> [Response; 2] {
        let [first, second] = self.contact.pushes(self.spheres, force);
        [
            self.spheres[0].response(self.pushes[0].plus(first)),
            self.spheres[1].response(self.pushes[1].plus(second)),
        ]
    }

    /// Accelerations at work \[m/s²\].
    fn scale(&self) -> f64 {
        let of = |place: usize| {
            let (sphere, push) = (self.spheres[place], self.pushes[place]);
            sphere.acceleration.norm() + push.force.norm() / sphere.mass
        };
        of(0) + of(1) + self.contact.bias.norm()
    }

    /// The mass that a force moves \[kg\].
    fn mass(&self) -> f64 {
        let [first, second] = self.spheres.map(|sphere| sphere.mass);
        first.min(second) / (1.0 + first.min(second) / first.max(second))
    }
}
