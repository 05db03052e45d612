//! Islands: the spheres of a cascade, and all contacts that they may get in it.

use super::body::Body;
use super::link::Link;
use crate::rule::contact::slabs::incidence::Origin;
use crate::rule::contact::slots::Slots;
use crate::rule::contact::solver::Solver;
use crate::rule::contact::sub_step::SubStep;

/// Largest number of spheres of a small island.
pub const MOST_BODIES: usize = 48;
/// Largest number of spheres of an island in which something presses. In a heap an impact is small beside what presses,
/// and sweeps are good enough.
const MOST_PRESSED: usize = 24;
/// Largest number of contacts of a small island.
const MOST_LINKS: usize = 512;
/// Largest number of spheres and of contacts of an island in which nothing presses; larger ones, and large heaps, are
/// left to the sweeps.
const MOST_FLYING: usize = 1 << 16;
/// A sphere may get this many times as far in a cascade as by itself: what a heavy one hits flies off at twice its
/// speed.
pub const REACH: f64 = 2.0;

/// Spheres and their contacts.
#[derive(Debug, Clone, Default)]
pub struct Island {
    pub bodies: Vec<Body>,
    pub links: Vec<Link>,
}

impl Island {
    /// Whether it can be followed as a whole.
    pub fn is_small(&self) -> bool {
        self.bodies.len() <= MOST_BODIES && self.links.len() <= MOST_LINKS
    }

    /// Whether it is no longer gathered.
    fn is_too_large(&self, presses: bool) -> bool {
        let [bodies, links] = [self.bodies.len(), self.links.len()];
        presses && bodies > MOST_PRESSED
            || !self.is_small() && (presses || bodies.max(links) > MOST_FLYING)
    }

    /// Largest speed of a body \[m/s\].
    pub fn top_speed(&self) -> f64 {
        self.bodies.iter().map(Body::speed).fold(0.0, f64::max)
    }
}

/// A slot of no body in [`Gathering::places`].
const NOWHERE: u32 = u32::MAX;

/// Gathers the islands of a sub-step.
pub struct Gathering {
    /// What the search found of each sphere, by slot.
    seen: Vec<Seen>,
    /// Places of spheres in the island that grows, by slot.
    places: Vec<u32>,
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
        Self {
            seen: vec![Seen::Never; spheres],
            places: vec![NOWHERE; spheres],
            islands: Vec::new(),
        }
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
            for body in &growing.island.bodies {
                self.places[body.slot as usize] = NOWHERE;
            }
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
        &mut self,
        solver: &Solver,
        (seed, joined): (usize, &[usize]),
        sub_step: &SubStep,
    ) -> Growing {
        let slots = &solver.slots;
        let Self { seen, places, islands } = self;
        let mut growing = Growing::default();
        growing.add(slots, places, seed);
        for island in joined.iter().filter_map(|&number| islands[number].as_ref()) {
            for body in island.bodies.iter().filter(|body| body.is_awake()) {
                growing.add(slots, places, body.slot as usize);
            }
        }
        let [mut next, mut checked_bodies, mut checked_links] = [0; 3];
        let mut presses = false;
        while next < growing.island.bodies.len() {
            let body = growing.island.bodies[next];
            if body.inverse_mass > 0.0 {
                for &origin in solver.incidence.of(body.slot as usize) {
                    growing.follow(solver, places, (next, origin), sub_step);
                }
            }
            next += 1;
            let Island { bodies, links } = &growing.island;
            let (new_bodies, new_links) = (&bodies[checked_bodies..], &links[checked_links..]);
            [checked_bodies, checked_links] = [bodies.len(), links.len()];
            let awake = new_bodies.iter().filter(|body| body.is_awake());
            let mut seen = awake.map(|body| seen[body.slot as usize]);
            let is_driven = new_links.iter().any(|link| link.is_driven);
            presses |= new_links.iter().any(Link::pressed);
            let is_too_large = growing.island.is_too_large(presses);
            if is_too_large || is_driven || seen.clone().any(|it| it == Seen::TooLarge) {
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
    fn add(&mut self, slots: &Slots, places: &mut [u32], slot: usize) -> usize {
        let place = &mut places[slot];
        if *place == NOWHERE {
            let body = Body::of(slots, slot);
            self.speed = self.speed.max(body.speed());
            *place = self.island.bodies.len() as u32;
            self.island.bodies.push(body);
        }
        *place as usize
    }

    /// Adds a contact of a body that may close in the sub-step, and the other sphere.
    fn follow(
        &mut self,
        solver: &Solver,
        places: &mut [u32],
        (own, origin): (usize, Origin),
        sub_step: &SubStep,
    ) {
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
                let place = places[other] as usize;
                let is_known = place < own && self.island.bodies[place].is_awake();
                let reach = REACH * sub_step.h * self.speed.max(Body::of(slots, other).speed());
                let is_near = link.bears || link.gap_between(slots) <= reach;
                if is_known || other == own_slot || !is_near {
                    return;
                }
                let other = self.add(slots, places, other);
                let is_first = link.slots[0] as usize == own_slot;
                let [first, second] = if is_first { [own, other] } else { [other, own] };
                (link.first, link.second) = (Some(first), second);
                self.island.links.push(link);
            }
        }
    }
}
