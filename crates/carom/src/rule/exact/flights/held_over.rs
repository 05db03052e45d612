//! What persistent contacts do over a step: when one opens, when friction changes how it acts, and when a sphere reaches
//! another part of a surface.

use glam::DVec3;

use super::curve::HeldCurve;
use super::curve_contacts::{CurveContacts, Moving};
use super::friction_choice::OPENS;
use super::friction_state::FrictionState;
use super::joint_field::JointField;
use super::touched::Touched;
use crate::integrate::crossing::first_positive;
use crate::integrate::field::{Field, Start, Values};
use crate::integrate::gauss_radau::{self, NODES, Step};
use crate::polynomial_flight::{ORDERS, PolynomialAcceleration, PolynomialFlight, TERMS};
use crate::rule::exact::features::time_on_curve;

/// Part of a step after which a contact that pulls from the start opens, and a sphere at the end of a face leaves it.
const SOONEST: f64 = 1e-6;

/// What persistent contacts do in a step.
pub(super) struct HeldOver {
    /// One per place; none without contacts.
    pub curves: Vec<HeldCurve>,
    /// Time from the start \[s\] at which a contact of each cluster opens, or a sphere reaches
    /// another part of a surface; infinite where none does.
    pub releases: Vec<f64>,
    /// Time from the start \[s\] at which friction changes how it acts in a contact; infinite if it does not.
    pub change: f64,
    /// Whether friction jams spheres, so that no forces hold their contacts.
    pub is_jammed: bool,
}

/// A bound of what a contact can do.
struct Bound {
    /// Place of its cluster, if the contact opens there; else friction changes how it acts.
    opens: Option<usize>,
    least: f64,
    /// What is bounded, at the nodes of a step.
    values: [f64; TERMS],
}

/// What is found at the nodes of a step.
struct AtNodes {
    /// Acceleration of each sphere without contacts \[m/s²\].
    free: Vec<[DVec3; TERMS]>,
    /// Power of moving surfaces on each sphere \[W\].
    power: Vec<[f64; TERMS]>,
    /// Acceleration of each sphere that touches a surface, as seen from there \[m/s²\].
    seen: Vec<[DVec3; TERMS]>,
    bounds: Vec<Bound>,
    is_jammed: bool,
}

impl JointField<'_> {
    /// Follows the persistent contacts over a step.
    pub fn held_over(&mut self, start: &Start, step: &Step) -> HeldOver {
        if self.contacts.is_empty() {
            let (curves, releases) = (Vec::new(), Vec::new());
            return HeldOver { curves, releases, change: f64::INFINITY, is_jammed: false };
        }
        let length = step.accelerations[0].length;
        let AtNodes { free, power, seen, bounds, is_jammed } = self.at_nodes(start, step);
        let curve = |(free, power)| HeldCurve {
            free: polynomial(free, length),
            collider_power: gauss_radau::through_nodes(power),
        };
        let curves = free.into_iter().zip(power).map(curve).collect();
        let mut releases = vec![f64::INFINITY; self.contacts.len()];
        let mut change = f64::INFINITY;
        for Bound { opens, least, values } in bounds {
            let part = first_below(gauss_radau::through_nodes(values), least);
            let time = part.map_or(f64::INFINITY, |part| part * length);
            let first = opens.map_or(&mut change, |cluster| &mut releases[cluster]);
            *first = first.min(time);
        }
        for (&Touched { cluster, sphere, shift, form, moving, is_on_ring }, seen) in
            self.touched.iter().zip(seen)
        {
            let state = [start.positions[sphere] + shift, start.velocities[sphere]];
            let [position, velocity] = match moving {
                Some(surface) => surface.seen_from(state, start.time),
                None => state,
            };
            let acceleration = match moving {
                Some(_) => polynomial(seen, length),
                None => step.accelerations[sphere],
            };
            let flight = PolynomialFlight { position, velocity, acceleration };
            let time = time_on_curve(form, &flight, is_on_ring);
            if time < length {
                releases[cluster] = releases[cluster].min(time.max(SOONEST * length));
            }
        }
        HeldOver { curves, releases, change, is_jammed }
    }

    /// Finds the forces at the nodes of a step.
    fn at_nodes(&mut self, start: &Start, step: &Step) -> AtNodes {
        let count = self.alone.len();
        let length = step.accelerations[0].length;
        let mut found = AtNodes {
            free: vec![[DVec3::ZERO; TERMS]; count],
            power: vec![[0.0; TERMS]; count],
            seen: vec![[DVec3::ZERO; TERMS]; self.touched.len()],
            bounds: Vec::new(),
            is_jammed: false,
        };
        for (node, &s) in NODES.iter().enumerate() {
            let time = start.time + s * length;
            let state = |place: usize| {
                let (position, velocity) = (start.positions[place], start.velocities[place]);
                let acceleration = step.accelerations[place];
                PolynomialFlight { position, velocity, acceleration }.after(s * length)
            };
            let all = 0..step.accelerations.len();
            let (positions, velocities): (Vec<DVec3>, Vec<DVec3>) = all.map(state).unzip();
            let mut values = Values::of(positions.len());
            self.evaluate_forces(time, &positions, &velocities, &mut values);
            let free = found.free.iter_mut().zip(&values.accelerations);
            free.for_each(|(free, &at)| free[node] = at);
            let states = [&positions[..], &velocities[..]];
            self.add_contacts(time, states, &mut values);
            found.is_jammed |= self.contacts.iter().any(CurveContacts::are_jammed);
            for contacts in &self.contacts {
                for (number, contact) in contacts.contacts.iter().enumerate() {
                    let power = contacts.power_of_surface(number, &self.spheres);
                    found.power[contact.second][node] += power;
                }
            }
            for (touched, seen) in self.touched.iter().zip(&mut found.seen) {
                let &Touched { sphere, shift, moving, .. } = touched;
                let Some(surface) = moving else { continue };
                let (center, velocity) = (positions[sphere] + shift, velocities[sphere]);
                let motion = [center, velocity, values.accelerations[sphere]];
                seen[node] = surface.at(time).acceleration_seen(motion);
            }
            if node == 0 {
                found.bounds = self.bounds(&values);
            }
            let margins = self.margins(time, states);
            let bounds = found.bounds.iter_mut().zip(margins);
            bounds.for_each(|(bound, at)| bound.values[node] = at);
        }
        found
    }

    /// The bounds of what contacts can do, at the start of a step with these accelerations \[m/s²\].
    fn bounds(&self, at: &Values) -> Vec<Bound> {
        let mut bounds = Vec::new();
        for (cluster, contacts) in self.contacts.iter().enumerate() {
            let bound = |opens, least: f64| Bound { opens, least, values: [0.0; TERMS] };
            for (number, contact) in contacts.contacts.iter().enumerate() {
                let second = contact.second;
                let least = OPENS * self.alone[second].mass * at.sizes[second];
                bounds.push(bound(Some(cluster), -least));
                match contacts.states[number] {
                    FrictionState::None => {}
                    FrictionState::Rolls => bounds.push(bound(None, 0.0)),
                    FrictionState::Slides { most_back, most, .. } => {
                        bounds.push(bound(None, -most_back));
                        if most < f64::INFINITY {
                            bounds.push(bound(None, -most));
                        }
                    }
                }
            }
        }
        bounds
    }

    /// How far all contacts are from what they can do, in the order of their bounds: the normal force \[N\], then what
    /// friction may add \[N\], or the slip along its first direction \[m/s\].
    fn margins(&self, time: f64, states: [&[DVec3]; 2]) -> Vec<f64> {
        let moving = Moving::of(time, states, self.spheres.len());
        let mut margins = Vec::new();
        for contacts in &self.contacts {
            for (number, &state) in contacts.states.iter().enumerate() {
                margins.push(contacts.forces[number].0);
                match state {
                    FrictionState::None => {}
                    FrictionState::Rolls => margins.push(contacts.margin_of_rolling(number)),
                    FrictionState::Slides { direction, most, .. } => {
                        let slip = contacts.slip(number, moving, &self.spheres).dot(direction);
                        margins.push(slip);
                        if most < f64::INFINITY {
                            margins.push(-slip);
                        }
                    }
                }
            }
        }
        margins
    }
}

/// The acceleration with these values at the nodes of a step of some length \[s\] \[m/s²\].
fn polynomial(values: [DVec3; TERMS], length: f64) -> PolynomialAcceleration {
    let carried = [DVec3::ZERO; 2];
    let coefficients = gauss_radau::through_nodes(values);
    let through_all = PolynomialAcceleration { length, coefficients, carried };
    if through_all.is_finite() {
        return through_all;
    }
    // A rough step reaches to where forces are not finite.
    let mut coefficients = [DVec3::ZERO; TERMS];
    coefficients[0] = values[0];
    PolynomialAcceleration { length, coefficients, carried }
}

/// First `s` in `[0, 1]` at which a polynomial is below a bound, a moment later at least than 0.
fn first_below(coefficients: [f64; TERMS], bound: f64) -> Option<f64> {
    let value = |s: f64| coefficients.iter().rev().fold(0.0, |sum, c| sum * s + c);
    let slope = |s: f64| {
        let terms = coefficients.iter().zip(ORDERS).skip(1).rev();
        terms.fold(0.0, |sum, (c, k)| sum * s + k * c)
    };
    if value(0.0) < bound {
        return Some(SOONEST);
    }
    let terms = coefficients.iter().zip(ORDERS);
    let curvature = terms.map(|(c, k)| k * (k - 1.0).max(0.0) * c.abs()).sum();
    first_positive(|s| [bound - value(s), -slope(s)], curvature, 1.0)
}
