//! Friction in the impact of a group, in dual numbers.

use super::model::{Given, Model};
use crate::friction::Slip;
use crate::real::{Real, Vector};
use crate::tangent::dual::Dual;

/// Sweeps over the contacts, at most.
const MOST_SWEEPS: usize = 4000;
/// Impulses have converged when they change by less than this part of the largest that friction allows.
const SETTLED: f64 = 1e-15;
/// An impulse at the limit of friction, up to this part of it, may stick or slip.
const AT_LIMIT: f64 = 1e-9;
/// Normals are the same if their product is larger: far from rounding.
const SAME_NORMAL: f64 = 1.0 - 1e-12;

/// A contact that got a normal impulse.
struct Rubbing {
    number: usize,
    limit: Dual,
    impulse: Vector<Dual>,
    target: Vector<Dual>,
}

/// The motion of all spheres.
struct Turning<'a> {
    model: &'a Model,
    given: &'a Given,
    velocities: &'a mut [Vector<Dual>],
    spins: &'a mut [Vector<Dual>],
}

/// Applies friction to the motion of a group that got normal impulses \[N s\], by the sweeps of the law itself, whose
/// derivatives converge with them. Returns changes that have to be zero for it to be differentiable.
pub(super) fn apply(
    model: &Model,
    given: &Given,
    impulses: &[Dual],
    (velocities, spins): (&mut [Vector<Dual>], &mut [Vector<Dual>]),
) -> Vec<f64> {
    let mut motion = Turning { model, given, velocities, spins };
    let acts = |&number: &usize| {
        impulses[number].value > 0.0 && model.contacts[number].sliding.value > 0.0
    };
    let numbers: Vec<usize> = (0..impulses.len()).filter(acts).collect();
    let zero = given.normals[0] * Dual::constant(0.0);
    let rubbing = |&number: &usize| Rubbing {
        number,
        limit: given.sliding[number] * impulses[number],
        impulse: zero,
        target: motion.target(number, impulses),
    };
    let mut contacts: Vec<Rubbing> = numbers.iter().map(rubbing).collect();
    let before = [motion.velocities.to_vec(), motion.spins.to_vec()];
    let energy = sweep(&mut motion, &mut contacts);
    let gives_back = |it: &Rubbing| it.target.value().length_squared() > 0.0;
    if contacts.len() > 1 && energy > 0.0 && contacts.iter().any(gives_back) {
        motion.velocities.copy_from_slice(&before[0]);
        motion.spins.copy_from_slice(&before[1]);
        contacts.iter_mut().for_each(|it| (it.impulse, it.target) = (zero, zero));
        sweep(&mut motion, &mut contacts);
    }
    let at_limit = contacts.iter().filter_map(|it| {
        let wanted = motion.wanted(it);
        let size = wanted.length_squared();
        let size = if size.value > 0.0 { size.sqrt() } else { return None };
        let off = size - it.limit;
        (off.value.abs() <= AT_LIMIT * it.limit.value)
            .then(|| off.change / given.masses[model.contacts[it.number].second].value)
    });
    at_limit.collect()
}

/// Brings the slip of each contact in turn to its target, as near as friction allows. Returns the change of the kinetic
/// energy \[J\].
fn sweep(motion: &mut Turning, contacts: &mut [Rubbing]) -> f64 {
    let largest = contacts.iter().map(|it| it.limit.value).fold(0.0, f64::max);
    let (mut energy, mut before) = (0.0, [f64::INFINITY; 2]);
    for _ in 0..MOST_SWEEPS {
        let (mut moved, mut size) = ([0.0_f64; 2], 0.0_f64);
        for contact in contacts.iter_mut() {
            let slip = motion.slip(contact.number);
            let wanted = motion.wanted(contact);
            let squared = wanted.length_squared();
            let limited = if squared.value > contact.limit.value * contact.limit.value {
                wanted * (contact.limit / squared.sqrt())
            } else {
                wanted
            };
            let change = limited - contact.impulse;
            contact.impulse = limited;
            motion.push(contact.number, change);
            let mean = slip + motion.slip(contact.number);
            energy += 0.5 * change.dot(mean).value;
            moved = [moved[0].max(change.value().length()), moved[1].max(change.change().length())];
            size = size.max(limited.change().length());
        }
        let is_settled = moved[0] <= SETTLED * largest && moved[1] <= SETTLED * size;
        let is_rounding = moved[0] <= 1e3 * SETTLED * largest
            && moved[1] <= 1e3 * SETTLED * size
            && moved[0] >= before[0]
            && moved[1] >= before[1];
        if is_settled || is_rounding {
            break;
        }
        before = moved;
    }
    energy
}

impl Turning<'_> {
    /// Returns the velocity with which the surface of body 2 slides along that of body 1 \[m/s\].
    fn slip(&self, number: usize) -> Vector<Dual> {
        let contact = &self.model.contacts[number];
        let normal = self.given.normals[number];
        let rim = |body: usize| self.spins[body] * self.given.radii[body];
        let mut turning = rim(contact.second);
        let first = match contact.first {
            Some(first) => {
                turning = turning + rim(first);
                self.velocities[first]
            }
            None => self.given.surfaces[number],
        };
        let relative = self.velocities[contact.second] - first;
        relative - normal * relative.dot(normal) - turning.cross(normal)
    }

    /// Returns the impulse that would bring the slip of a contact to its target.
    fn wanted(&self, contact: &Rubbing) -> Vector<Dual> {
        contact.impulse - (self.slip(contact.number) - contact.target) * self.mass(contact.number)
    }

    /// Returns the mass that a slip has to be stopped of \[kg\].
    fn mass(&self, number: usize) -> Dual {
        let contact = &self.model.contacts[number];
        let first = contact.first.map(|first| self.mobility(first));
        let sum =
            first.map_or(self.mobility(contact.second), |it| it + self.mobility(contact.second));
        Dual::constant(1.0) / sum
    }

    fn mobility(&self, body: usize) -> Dual {
        let factor = 1.0 + 1.0 / self.model.members[body].inertia_factor;
        Dual::constant(factor) / self.given.masses[body]
    }

    /// Returns the slip that friction would leave if it were large enough \[m/s\].
    fn target(&self, number: usize, impulses: &[Dual]) -> Vector<Dual> {
        let contact = &self.model.contacts[number];
        let slip = self.slip(number);
        if contact.friction.cushion == 0.0 {
            return slip * Dual::constant(-contact.friction.tangential_restitution);
        }
        let one = Dual::constant(1.0);
        let of_first = contact.first.map(|first| one / self.given.masses[first]);
        let of_second = one / self.given.masses[contact.second];
        let lightness = of_first.map_or(of_second, |it| it + of_second);
        let normal = self.given.normals[number];
        let is_same = |&it: &usize| {
            let other = &self.model.contacts[it];
            (other.first, other.second) == (contact.first, contact.second)
                && other.normal.dot(contact.normal) > SAME_NORMAL
        };
        let pushed = (0..impulses.len()).filter(is_same).map(|it| impulses[it]);
        let change = pushed.fold(Dual::constant(0.0), |sum, it| sum + it) * lightness;
        let other = contact.first.map_or(self.given.surfaces[number], |it| self.velocities[it]);
        let approach = change - (self.velocities[contact.second] - other).dot(normal);
        let by_bodies = self.given.restitutions[number].change;
        let restitution = Dual::new(
            contact.law.at(approach.value),
            by_bodies + contact.law.slope(approach.value) * approach.change,
        );
        let squared = slip.length_squared();
        let speed = if squared.value > 0.0 { squared.sqrt() } else { Dual::constant(0.0) };
        let mobility_ratio = (one / self.mass(number) / lightness).value;
        let slipping = Slip {
            speed: speed.value,
            change: change.value,
            restitution: restitution.value,
            mobility_ratio,
        };
        let sliding = self.given.sliding[number];
        let Some(impact) = contact.friction.compliant(&slipping) else { return slip };
        let found = impact.reversal();
        let incidence = (one + restitution) * speed / (sliding * change);
        let by = found.by[0] * incidence.change + found.by[1] * restitution.change;
        slip * Dual::new(-found.value, -by)
    }

    /// Adds to the impulse of friction at a contact.
    fn push(&mut self, number: usize, impulse: Vector<Dual>) {
        let contact = &self.model.contacts[number];
        let turning = self.given.normals[number].cross(impulse);
        let one = Dual::constant(1.0);
        let mut push = |body: usize, side: f64| {
            let mass = self.given.masses[body];
            let moment_per_radius =
                mass * self.given.radii[body] * self.model.members[body].inertia_factor;
            self.velocities[body] = self.velocities[body] + impulse * (one / mass * side);
            self.spins[body] = self.spins[body] - turning * (one / moment_per_radius);
        };
        push(contact.second, 1.0);
        if let Some(first) = contact.first {
            push(first, -1.0);
        }
    }
}
