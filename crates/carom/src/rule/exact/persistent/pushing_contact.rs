//! The contact of a sphere on a plane with another one, or with a second plane: its normal force and its friction
//! (`docs/physics/persistent-contacts.md`).

use glam::{DMat3, DVec3};

use super::pushed_sphere::{Push, PushedSphere, Response};
use crate::norm::Norm;
use crate::work::Work;

/// Forces have converged once they change by less than this part of the largest: some hundred roundings.
const SETTLED: f64 = 256.0 * f64::EPSILON;
/// After the last sweep, changes below this part of the largest are accepted.
const ACCEPTED: f64 = 1e-9;
/// Sweeps over the contacts, at most. Without friction each is one of Gauss and Seidel, and converges.
const MOST_SWEEPS: usize = 1000;
/// Sweeps after which forces take half steps only: where spheres begin or cease to slide, whole steps may
/// alternate.
const WHOLE_SWEEPS: usize = 64;
/// Steps of the methods for one contact, at most. Where the spheres keep their states one step is exact.
const MOST_STEPS: usize = 16;
/// Turns of the direction in which friction acts where a slip begins, at most.
const MOST_TURNS: usize = 64;
/// Accelerations below this part of those at work count as zero: some roundings.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The contact of two pushed spheres, or of one with a plane at rest.
#[derive(Debug, Clone, Copy)]
pub(super) struct PushingContact {
    /// Place of body 1 among the spheres; none if it is a plane.
    pub first: Option<usize>,
    /// Place of body 2.
    pub second: usize,
    /// Unit normal from body 1 to body 2.
    pub normal: DVec3,
    /// Coefficient of sliding friction.
    pub friction: f64,
    /// Direction in which the surface of body 2 slides along that of body 1; `None` where it does not.
    pub slides: Option<DVec3>,
    /// Accelerations of the gap and of the slip that the rotation of the normal causes \[m/s²\].
    pub bias: DVec3,
}

/// A contact with its bodies.
struct Pair<'a> {
    contact: &'a PushingContact,
    /// Side of the first body; `None` for a plane.
    first: Option<Side<'a>>,
    second: Side<'a>,
}

/// A sphere of a contact, with the push of its other contacts.
#[derive(Clone, Copy)]
struct Side<'a> {
    sphere: &'a PushedSphere,
    push: Push,
}

/// Returns the forces of contacts on their second bodies \[N\], beginning from `forces`, and the responses of
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
    for sweep in 0..MOST_SWEEPS {
        let part = if sweep < WHOLE_SWEEPS { 1.0 } else { 0.5 };
        let mut largest = 0.0_f64;
        changed = 0.0;
        for (number, contact) in contacts.iter().enumerate() {
            let side = |place: usize| Side {
                sphere: &spheres[place],
                push: push_on(place, spheres, contacts, forces, number),
            };
            let (first, second) = (contact.first.map(side), side(contact.second));
            let pair = Pair { contact, first, second };
            let force = pair.force(forces[number])?;
            let change = force - forces[number];
            changed = f64::max(changed, change.norm());
            largest = largest.max(force.norm());
            forces[number] = if part < 1.0 { forces[number] + part * change } else { force };
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
        if contact.second == place {
            push = push.plus(contact.push(&spheres[place], force));
        } else if contact.first == Some(place) {
            push = push.plus(contact.push_back(&spheres[place], force));
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
    /// The push on body 2 of a force on it \[N\].
    fn push(&self, sphere: &PushedSphere, force: DVec3) -> Push {
        Push { force, torque: -sphere.radius * self.normal.cross(force) }
    }

    /// The push on body 1 of a force on body 2 \[N\]: the normal points out of one and into the other.
    fn push_back(&self, sphere: &PushedSphere, force: DVec3) -> Push {
        Push { force: -force, ..self.push(sphere, force) }
    }

    /// Acceleration of the gap, along the normal, and of the slip \[m/s²\] for these responses of the bodies and
    /// their radii \[m\].
    pub fn rate(&self, first: Option<(Response, f64)>, second: (Response, f64)) -> DVec3 {
        let (mut relative, mut turning) = (DVec3::ZERO, DVec3::ZERO);
        if let Some((response, radius)) = first {
            relative -= response.acceleration;
            turning += radius * response.angular_acceleration;
        }
        let (response, radius) = second;
        relative += response.acceleration;
        turning += radius * response.angular_acceleration;
        relative - turning.cross(self.normal) + self.bias
    }

    fn across(&self, vector: DVec3) -> DVec3 {
        vector - vector.dot(self.normal) * self.normal
    }
}

impl Pair<'_> {
    /// The force on body 2 \[N\], near `known`; `None` where it is not found.
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

    /// The force along a direction, with a normal part of 1, under which the gap does not open. The secant method
    /// starts from the acceleration of the gap without the force \[m/s²\] and an estimate of the force \[N\].
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

    /// The force under which the gap does not open and the surfaces do not begin to slide. Where that takes more
    /// friction than there is, the force under which they begin to slide.
    fn force_where_it_sticks(&self, known: DVec3, start: [f64; 2]) -> Option<DVec3> {
        let PushingContact { normal, friction, .. } = *self.contact;
        if let Some(force) = self.force_without_slip(known) {
            let across = self.contact.across(force);
            if across.norm() <= friction * force.dot(normal) {
                return Some(force);
            }
        }
        // Friction acts against the slip that begins under it: steps of the size that stops a slip.
        let mut along = self.contact.across(known).normalize_or_zero();
        let mut force = known;
        for _ in 0..MOST_TURNS {
            force = self.force_along(normal + friction * along, start)?;
            let slip = self.contact.across(self.rate(force));
            let wanted = self.contact.across(force) - self.slip_mass() * slip;
            let next = wanted.normalize_or_zero();
            let turned = next - along;
            along = next;
            if turned.norm() <= SETTLED {
                break;
            }
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

    /// Computes the accelerations of the gap and of the slip that a force on body 2 causes \[m/s²\].
    fn rate(&self, force: DVec3) -> DVec3 {
        let Self { contact, first, second } = self;
        let responds = |side: &Side, push: Push| {
            (side.sphere.response(side.push.plus(push)), side.sphere.radius)
        };
        let first = first.as_ref().map(|it| responds(it, contact.push_back(it.sphere, force)));
        contact.rate(first, responds(second, contact.push(second.sphere, force)))
    }

    fn sides(&self) -> impl Iterator<Item = Side<'_>> {
        self.first.into_iter().chain([self.second])
    }

    /// Accelerations at work \[m/s²\].
    fn scale(&self) -> f64 {
        let of = |Side { sphere, push }: Side| {
            sphere.acceleration.norm() + push.force.norm() / sphere.mass
        };
        self.sides().map(of).sum::<f64>() + self.contact.bias.norm()
    }

    /// A lower bound of the mass that resists a change of the slip \[kg\]: that of spheres that are free to turn.
    fn slip_mass(&self) -> f64 {
        let mobility = |side: Side| (1.0 + 1.0 / side.sphere.inertia_factor) / side.sphere.mass;
        1.0 / self.sides().map(mobility).sum::<f64>()
    }

    /// The mass that a force moves \[kg\].
    fn mass(&self) -> f64 {
        let masses = || self.sides().map(|side| side.sphere.mass);
        let least = masses().fold(f64::INFINITY, f64::min);
        least / masses().map(|mass| least / mass).sum::<f64>()
    }
}
