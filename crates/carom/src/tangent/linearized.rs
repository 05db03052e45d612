//! Forces on spheres that fly on curves, linearised about their motion.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3};

use super::edge_passage::Side;
use super::tightening::Tightening;
use super::variation::Variation;
use crate::forces::{self, ForceDerivatives, PullDerivatives, SphereState, Spring, SpringEnd};
use crate::id::{SphereId, SpringId};
use crate::settings::nearest_image;
use crate::system::System;

/// Largest difference between a jump of an acceleration and that which a thread explains, as a part of it.
const SAME_JUMP: f64 = 1e-6;

/// Accelerations of some spheres, linear in small changes of their states and of what the forces depend on.
#[derive(Debug, Clone, Default)]
pub(super) struct Linearized {
    /// How the accelerations depend on states.
    pub couplings: Vec<Coupling>,
    /// How they depend on all else.
    pub influences: Vec<Influence>,
    /// The accelerations themselves \[m/s²\].
    pub accelerations: Vec<DVec3>,
}

/// Derivative of the acceleration of one sphere by the state of one. Spheres are numbered as among those that fly
/// together.
#[derive(Debug, Clone, Copy)]
pub(super) struct Coupling {
    /// The sphere that is accelerated, and the one on which that depends.
    pub spheres: [usize; 2],
    /// \[1/s²\]
    pub by_position: DMat3,
    /// \[1/s\]
    pub by_velocity: DMat3,
}

/// Derivative of the acceleration of one sphere by an input.
#[derive(Debug, Clone, Copy)]
pub(super) struct Influence {
    /// Number of the sphere that is accelerated.
    pub sphere: usize,
    pub input: Input,
    /// \[m/s²\] for a unit of the input.
    pub rate: DVec3,
}

/// A number of the initial state on which forces depend.
#[derive(Debug, Clone, Copy)]
pub(super) enum Input {
    Radius(SphereId),
    Mass(SphereId),
    Stiffness(SpringId),
    RestLength(SpringId),
    Damping(SpringId),
}

impl Input {
    /// Returns the change of the number in a direction.
    pub fn of(self, direction: &Variation) -> f64 {
        match self {
            Self::Radius(sphere) => direction.sphere(sphere).radius,
            Self::Mass(sphere) => direction.sphere(sphere).mass,
            Self::Stiffness(spring) => direction.spring(spring).stiffness,
            Self::RestLength(spring) => direction.spring(spring).rest_length,
            Self::Damping(spring) => direction.spring(spring).damping,
        }
    }

    /// Returns the derivative by the number in a gradient.
    pub fn in_gradient(self, gradient: &mut Variation) -> &mut f64 {
        match self {
            Self::Radius(sphere) => &mut gradient.sphere_mut(sphere).radius,
            Self::Mass(sphere) => &mut gradient.sphere_mut(sphere).mass,
            Self::Stiffness(spring) => &mut gradient.spring_mut(spring).stiffness,
            Self::RestLength(spring) => &mut gradient.spring_mut(spring).rest_length,
            Self::Damping(spring) => &mut gradient.spring_mut(spring).damping,
        }
    }
}

/// Spheres that fly together on curves, and what acts on them.
#[derive(Clone)]
pub(super) struct Companions<'a> {
    system: System<'a>,
    /// Indices of the spheres in the arrays of the world.
    pub places: &'a [usize],
    /// Springs at these spheres, with the numbers of their ends; `None` for one at a fixed point.
    springs: Vec<(SpringId, Spring, usize, Option<usize>)>,
    /// For each sphere, the sides of the edges of forces on which it flies; empty where its position decides.
    pub sides: Vec<Vec<Side>>,
}

/// Sums of derivatives, before they are divided by masses.
#[derive(Default)]
struct Sums {
    couplings: BTreeMap<[usize; 2], ForceDerivatives>,
    influences: Vec<Influence>,
}

impl Sums {
    fn add(&mut self, spheres: [usize; 2], derivatives: &ForceDerivatives) {
        let sum = self.couplings.entry(spheres).or_insert(ForceDerivatives::ZERO);
        sum.by_position += derivatives.by_position;
        sum.by_velocity += derivatives.by_velocity;
        sum.by_radius += derivatives.by_radius;
        sum.by_mass += derivatives.by_mass;
    }
}

impl<'a> Companions<'a> {
    /// Returns the spheres at some places with all springs at them; `None` if a spring leads to another sphere.
    pub fn of(system: System<'a>, places: &'a [usize]) -> Option<Self> {
        let number = |id: SphereId| {
            let place = system.spheres.id.binary_search(&id).ok()?;
            places.iter().position(|&it| it == place)
        };
        let mut springs = Vec::new();
        for (id, spring) in system.numbered_springs() {
            let second = match spring.to {
                SpringEnd::Sphere(id) => Some(number(id)),
                SpringEnd::Point(_) => None,
            };
            match (number(spring.sphere), second) {
                (None, None | Some(None)) => {}
                (Some(first), None) => springs.push((id, *spring, first, None)),
                (Some(first), Some(Some(second))) => {
                    springs.push((id, *spring, first, Some(second)));
                }
                _ => return None,
            }
        }
        Some(Self { system, places, springs, sides: Vec::new() })
    }

    /// Returns the damped thread that is at its rest length in this state \[m\], \[m/s\], to a `part` of that, and
    /// lengthens; with accelerations lost there by index, `None` if there is not just one.
    pub fn tightening(
        &self,
        states: [&[DVec3]; 2],
        (part, jumps): (f64, &[(usize, DVec3)]),
    ) -> Option<Tightening> {
        let mut found = None;
        for &(thread, ref spring, first, second) in &self.springs {
            let [offset, velocity] = self.stretch(spring, [Some(first), second], states);
            let direction = offset.normalize_or_zero();
            let lengthening = velocity.dot(direction);
            let off = (offset.length() - spring.rest_length).abs();
            let begins = spring.only_pulls && spring.damping > 0.0 && lengthening > 0.0;
            if !begins || off > part * spring.rest_length {
                continue;
            }
            let ends = (self.places[first], second.map(|second| self.places[second]));
            // Its damper begins to pull.
            let pull = spring.damping * lengthening * direction;
            let mass = |place: usize| self.system.spheres.mass[place];
            let explains = jumps.iter().all(|&(place, lost)| {
                let gained = match place {
                    it if it == ends.0 => pull / mass(it),
                    it if Some(it) == ends.1 => -pull / mass(it),
                    _ => DVec3::ZERO,
                };
                (gained + lost).length() <= SAME_JUMP * (gained.length() + lost.length())
                    || lost.length() <= SAME_JUMP * pull.length() / mass(place)
            });
            if found.is_some() || !explains {
                return None;
            }
            let jumps = jumps.to_vec();
            found = Some(Tightening { thread, ends, direction, lengthening, jumps });
        }
        found
    }

    /// Replaces threads by springs that act as they do in this state \[m\], \[m/s\] as long as they stay taut or slack.
    pub fn fix_threads(&mut self, states: [&[DVec3]; 2]) {
        let mut springs = std::mem::take(&mut self.springs);
        springs.retain_mut(|(_, spring, first, second)| {
            let [offset, velocity] = self.stretch(spring, [Some(*first), *second], states);
            let acts = !spring.only_pulls || spring.pull(offset, velocity) != DVec3::ZERO;
            spring.only_pulls = false;
            acts
        });
        self.springs = springs;
    }

    /// Fixes the sides of edges on which spheres fly to those in this state \[m\], \[m/s\].
    pub fn fix_sides(&mut self, states: [&[DVec3]; 2]) {
        let sides = self.states(states).map(|state| Side::all(&self.system, &state)).collect();
        self.sides = sides;
    }

    /// Returns the forces at a time on the world's clock \[s\], linearised about these positions \[m\] and velocities
    /// \[m/s\]; `None` if a derivative is not known.
    pub fn linearized(&self, states: [&[DVec3]; 2], time: f64) -> Option<Linearized> {
        let accelerations = self.accelerations(states, time);
        let mut sums = Sums::default();
        for (number, state) in self.states(states).enumerate() {
            for (_, force) in self.system.forces.iter() {
                sums.add([number; 2], &force.derivatives(&state, time)?);
            }
        }
        for &(id, ref spring, first, second) in &self.springs {
            let [offset, velocity] = self.stretch(spring, [Some(first), second], states);
            let pull = spring.pull_derivatives(offset, velocity)?;
            self.add_spring(id, (first, second), &pull, &mut sums);
        }
        self.add_interactions(states, time, &mut sums).then_some(())?;
        Some(self.divided(sums, accelerations))
    }

    /// Returns the accelerations at a time on the world's clock \[s\] \[m/s²\].
    pub fn accelerations(&self, states: [&[DVec3]; 2], time: f64) -> Vec<DVec3> {
        let alone = self.states(states).map(|it| forces::total(self.system.forces, &it, time));
        let mut forces: Vec<DVec3> = alone.collect();
        for &(_, ref spring, first, second) in &self.springs {
            let [offset, velocity] = self.stretch(spring, [Some(first), second], states);
            let pull = spring.pull(offset, velocity);
            forces[first] += pull;
            if let Some(second) = second {
                forces[second] -= pull;
            }
        }
        if let Some(interactions) = self.system.interactions.filter(|_| self.are_all()) {
            let spheres = self.system.states(states);
            interactions.add_forces_without_springs(&spheres, time, &mut forces);
        }
        let of = |(number, force): (usize, DVec3)| {
            let place = self.places[number];
            let applied = self.system.spheres.applied_acceleration(place).unwrap_or_default();
            force / self.system.spheres.mass[place] + applied
        };
        forces.into_iter().enumerate().map(of).collect()
    }

    /// Returns whether these are all spheres of the world, in its order.
    fn are_all(&self) -> bool {
        self.places.len() == self.system.spheres.id.len() && self.places.is_sorted()
    }

    fn states<'b>(
        &'b self,
        [positions, velocities]: [&'b [DVec3]; 2],
    ) -> impl Iterator<Item = SphereState> + use<'a, 'b> {
        let spheres = self.system.spheres;
        let kept = |number: usize| {
            let sides = self.sides.get(number).into_iter().flatten();
            sides.fold(positions[number], |position, side| side.keep(position))
        };
        self.places.iter().enumerate().map(move |(number, &place)| SphereState {
            position: kept(number),
            velocity: velocities[number],
            radius: spheres.radius[place],
            mass: spheres.mass[place],
        })
    }

    /// Returns the offset \[m\] and the relative velocity \[m/s\] of the second end of a spring.
    fn stretch(
        &self,
        spring: &Spring,
        ends: [Option<usize>; 2],
        [positions, velocities]: [&[DVec3]; 2],
    ) -> [DVec3; 2] {
        let state = |end: Option<usize>| match (end, spring.to) {
            (Some(number), _) => [positions[number], velocities[number]],
            (None, SpringEnd::Point(point)) => [point, DVec3::ZERO],
            (None, SpringEnd::Sphere(_)) => [DVec3::ZERO; 2],
        };
        let [[from, velocity], [to, other]] = ends.map(state);
        let period = self.system.settings.boundary.period();
        [nearest_image(to - from, period), other - velocity]
    }

    fn add_spring(
        &self,
        id: SpringId,
        (first, second): (usize, Option<usize>),
        pull: &PullDerivatives,
        sums: &mut Sums,
    ) {
        let of = |sign: f64| ForceDerivatives {
            by_position: sign * pull.by_offset,
            by_velocity: sign * pull.by_velocity,
            ..ForceDerivatives::ZERO
        };
        let mut ends = vec![(first, 1.0)];
        ends.extend(second.map(|second| (second, -1.0)));
        for &(end, sign) in &ends {
            for &(other, other_sign) in &ends {
                // The force on the first end grows with the place of the second, and falls with its own.
                sums.add([end, other], &of(-sign * other_sign));
            }
            let by = [
                (Input::Stiffness(id), pull.by_stiffness),
                (Input::RestLength(id), pull.by_rest_length),
                (Input::Damping(id), pull.by_damping),
            ];
            let influence =
                |(input, rate): (Input, DVec3)| Influence { sphere: end, input, rate: sign * rate };
            sums.influences.extend(by.map(influence));
        }
    }

    /// Adds the derivatives of forces between all spheres; returns whether they are known.
    fn add_interactions(&self, states: [&[DVec3]; 2], time: f64, sums: &mut Sums) -> bool {
        let Some(interactions) = self.system.interactions.filter(|it| !it.are_springs()) else {
            return true;
        };
        let spheres = self.system.states(states);
        self.are_all()
            && interactions.list().all(|interaction| {
                interaction.add_derivatives(&spheres, time, &mut |places, derivatives| {
                    sums.add(places, derivatives);
                })
            })
    }

    /// Returns accelerations for sums of forces.
    fn divided(&self, sums: Sums, accelerations: Vec<DVec3>) -> Linearized {
        let spheres = self.system.spheres;
        let mass = |number: usize| spheres.mass[self.places[number]];
        let id = |number: usize| spheres.id[self.places[number]];
        let of_spring = |it: Influence| Influence { rate: it.rate / mass(it.sphere), ..it };
        let mut influences: Vec<Influence> = sums.influences.into_iter().map(of_spring).collect();
        let mut couplings = Vec::new();
        for ([on, of], force) in sums.couplings {
            couplings.push(Coupling {
                spheres: [on, of],
                by_position: (1.0 / mass(on)) * force.by_position,
                by_velocity: (1.0 / mass(on)) * force.by_velocity,
            });
            let by_mass = force.by_mass / mass(on);
            let lighter = if on == of { accelerations[on] / mass(on) } else { DVec3::ZERO };
            let by_radius = force.by_radius / mass(on);
            for (input, rate) in
                [(Input::Mass(id(of)), by_mass - lighter), (Input::Radius(id(of)), by_radius)]
            {
                influences.push(Influence { sphere: on, input, rate });
            }
        }
        influences.retain(|it| it.rate != DVec3::ZERO);
        Linearized { couplings, influences, accelerations }
    }
}
