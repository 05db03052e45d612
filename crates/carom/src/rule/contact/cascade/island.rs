//! Islands: the spheres of a cascade, and all contacts that they may get in it.

use super::body::Body;
use super::link::Link;
use crate::rule::contact::slabs::incidence::Origin;
use crate::rule::contact::slots::Slots;
use crate::rule::contact::solver::Solver;
use crate::rule::contact::sub_step::SubStep;

/// Largest number of spheres of an island; larger ones are left to the sweeps.
const MOST_BODIES: usize = 48;
/// Largest number of contacts of an island.
const MOST_LINKS: usize = 512;
/// A sphere may get this many times as far in a cascade as by itself: what a heavy one hits flies off at twice its
/// speed.
const REACH: f64 = 2.0;

/// Spheres and their contacts.
#[derive(Debug, Clone, Default)]
pub struct Island {
    pub bodies: Vec<Body>,
    pub links: Vec<Link>,
}

/// Gathers the islands of a sub-step.
pub struct Gathering {
    /// What the search found of each sphere, by slot.
    seen: Vec<Seen>,
    /// Islands by number; `None` for those that became a part of another.
    islands: Vec<Option<Island>>,
}

/// The state of a sphere in the search for islands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Seen {
    Never,
    /// The sphere is in the island with this number.
    In(usize),
    /// The island of the sphere is too large.
    TooLarge,
}

impl Gathering {
    /// Starts a search among this number of spheres.
    pub fn among(spheres: usize) -> Self {
        Self { seen: vec![Seen::Never; spheres], islands: Vec::new() }
    }

    /// Gathers the island about the sphere in a slot, unless the sphere is in one already or the island is too large.
    /// Islands that this one reaches become a part of it, unless they make it too large.
    pub fn gather(&mut self, solver: &Solver, seed: usize, sub_step: &SubStep) {
        if self.seen[seed] != Seen::Never {
            return;
        }
        let mut joined = Vec::new();
        loop {
            let growing = self.grow(solver, (seed, &joined), sub_step);
            if let Some(number) = growing.reaches {
                joined.push(number);
                continue;
            }
            let seen = if growing.is_whole {
                joined.iter().for_each(|&number| self.islands[number] = None);
                Seen::In(self.islands.len())
            } else {
                Seen::TooLarge
            };
            for body in growing.island.bodies.iter().filter(|body| body.inverse_mass > 0.0) {
                let of_body = &mut self.seen[body.slot as usize];
                if growing.is_whole || *of_body == Seen::Never {
                    *of_body = seen;
                }
            }
            self.islands.extend(growing.is_whole.then_some(Some(growing.island)));
            return;
        }
    }

    /// All islands, in the order of their last seeds.
    pub fn into_islands(self) -> impl Iterator<Item = Island> {
        self.islands.into_iter().flatten()
    }

    /// Follows contacts from a sphere and the islands `joined` on, until there are no more, they are too many, or they
    /// reach another island.
    fn grow(
        &self,
        solver: &Solver,
        (seed, joined): (usize, &[usize]),
        sub_step: &SubStep,
    ) -> Growing {
        let slots = &solver.slots;
        let mut growing = Growing::default();
        growing.add(slots, seed);
        for island in joined.iter().filter_map(|&number| self.islands[number].as_ref()) {
            let awake = island.bodies.iter().filter(|body| body.inverse_mass > 0.0);
            for body in awake {
                growing.add(slots, body.slot as usize);
            }
        }
        let mut next = 0;
        while next < growing.island.bodies.len() {
            let body = growing.island.bodies[next];
            if body.inverse_mass > 0.0 {
                for &origin in solver.incidence.of(body.slot as usize) {
                    growing.follow(solver, next, origin, sub_step);
                }
            }
            next += 1;
            let Island { bodies, links } = &growing.island;
            let awake = bodies.iter().filter(|body| body.inverse_mass > 0.0);
            let mut seen = awake.map(|body| self.seen[body.slot as usize]);
            let is_large = bodies.len() > MOST_BODIES || links.len() > MOST_LINKS;
            let is_driven = links.iter().any(|link| link.is_driven);
            if is_large || is_driven || seen.clone().any(|it| it == Seen::TooLarge) {
                return growing;
            }
            growing.reaches = seen.find_map(|it| match it {
                Seen::In(number) if !joined.contains(&number) => Some(number),
                _ => None,
            });
            if growing.reaches.is_some() {
                return growing;
            }
        }
        growing.is_whole = true;
        growing
    }
}

/// An island that grows.
#[derive(Debug, Default)]
struct Growing {
    island: Island,
    /// Largest speed in the island \[m/s\].
    speed: f64,
    /// Number of another island that this one reaches.
    reaches: Option<usize>,
    is_whole: bool,
}

impl Growing {
    /// The place of the sphere in a slot.
    fn add(&mut self, slots: &Slots, slot: usize) -> usize {
        let known = self.island.bodies.iter().position(|body| body.slot as usize == slot);
        known.unwrap_or_else(|| {
            let body = Body::of(slots, slot);
            self.speed = self.speed.max(body.velocity.length());
            self.island.bodies.push(body);
            self.island.bodies.len() - 1
        })
    }

    /// Adds a contact of a body that may close in the sub-step, and the other sphere.
    fn follow(&mut self, solver: &Solver, own: usize, origin: Origin, sub_step: &SubStep) {
        let slots = &solver.slots;
        let mut link = Link::of(solver, origin);
        let body = &self.island.bodies[own];
        match origin {
            Origin::Surface { .. } => {
                link.second = own;
                self.island.links.push(link);
            }
            Origin::Pair { .. } => {
                let other = link.slots.into_iter().find(|&it| it != body.slot).unwrap_or(body.slot)
                    as usize;
                let own_slot = body.slot as usize;
                let place = self.island.bodies.iter().position(|it| it.slot as usize == other);
                let is_known = place.is_some_and(|place| {
                    place < own && self.island.bodies[place].inverse_mass > 0.0
                });
                let reach =
                    REACH * sub_step.h * self.speed.max(slots.before[other].vector().length());
                let is_near = link.bears || link.gap_between(slots) <= reach;
                if is_known || other == own_slot || !is_near {
                    return;
                }
                let other = self.add(slots, other);
                let is_first = link.slots[0] as usize == own_slot;
                let [first, second] = if is_first { [own, other] } else { [other, own] };
                (link.first, link.second) = (Some(first), second);
                self.island.links.push(link);
            }
        }
    }
}
