//! Components: spheres on curves that forces connect, whose steps are taken together.

use std::collections::BTreeMap;

use educe::Educe;
use glam::DVec3;

use crate::connected::Connected;
use crate::forces::{Spring, SpringEnd};
use crate::system::System;

/// Evaluations of the forces on the spheres of a component that are allowed in a tick: this many in total, or this
/// many for each sphere if that is more. Beyond it, rough steps lead to the end of the tick.
const MOST_EVALUATIONS: u64 = 1 << 16;
const MOST_FOR_EACH: u64 = 1 << 8;
/// Allowed evaluations for each sphere with each event that begins new steps: the first may be tried some times, and the
/// next one becomes longer again.
const MOST_FOR_EVENT: u64 = 1 << 10;
/// Allowed evaluations in a tick where forces act between all spheres: close passages take many short steps.
const MOST_WITH_SHORT_STEPS: u64 = 1 << 18;

/// Allowed evaluations where only contacts bend the flights, at once, and in each tick in the long run: such spheres can be
/// in a zone instead.
const MOST_BEFORE_ZONE: u64 = 1 << 17;
const BEFORE_ZONE_IN_A_TICK: u64 = 1 << 14;

/// A sphere that is in no component.
const NONE: u32 = u32::MAX;

/// Spheres connected by springs, directly or through others, or all spheres where forces act between all; a single
/// sphere if nothing connects it.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Component {
    /// Members by index, ascending.
    pub members: Vec<u32>,
    /// Springs in the order in which they entered the world.
    pub springs: Vec<PlacedSpring>,
    /// Whether the flight of a member began again since the last step.
    is_due: bool,
    /// The number of the tick of the last step.
    tick: f64,
    /// Evaluations of the forces on a sphere in this tick, and those left of earlier ones.
    evaluations: u64,
    /// Evaluations that the events of this tick allow beyond those of every tick.
    allowed_for_events: u64,
}

/// A spring, with the places of its ends among the members.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct PlacedSpring {
    pub spring: Spring,
    pub first: u32,
    /// `None` at a fixed point.
    pub second: Option<u32>,
}

impl Component {
    /// Several components as one, for a step.
    pub fn joined<'a>(components: impl Iterator<Item = &'a Self>) -> Self {
        let mut joined = Self::default();
        for Self { members, springs, .. } in components {
            let before = joined.members.len() as u32;
            let moved = springs.iter().map(|placed| PlacedSpring {
                first: placed.first + before,
                second: placed.second.map(|second| second + before),
                ..*placed
            });
            joined.springs.extend(moved);
            joined.members.extend_from_slice(members);
        }
        joined
    }
}

impl PlacedSpring {
    /// Place \[m\] and velocity \[m/s\] of the second end; `state_of` returns those of a sphere by its place.
    pub fn state_of_second(&self, state_of: impl Fn(u32) -> [DVec3; 2]) -> [DVec3; 2] {
        match (self.second, self.spring.to) {
            (Some(place), _) => state_of(place),
            (None, SpringEnd::Point(point)) => [point, DVec3::ZERO],
            (None, SpringEnd::Sphere(_)) => state_of(self.first),
        }
    }
}

/// The components of all spheres that fly on curves, by their forces or along persistent contacts.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Components {
    /// Number of the component of each sphere, by index of the sphere.
    of_spheres: Vec<u32>,
    components: Vec<Component>,
    /// Numbers of the components that are due.
    due: Vec<u32>,
    /// Allowed evaluations of a component in a tick, or `MOST_FOR_EACH` times its spheres if that is more.
    most_evaluations: u64,
}

impl Components {
    /// The components of the spheres on curves; `is_curved` decides by index.
    pub fn of(system: &System, is_curved: impl Fn(usize) -> bool) -> Self {
        let ids = &system.spheres.id;
        let place = |id| ids.binary_search(&id).ok();
        let springs: Vec<(Spring, usize, Option<usize>)> = system
            .springs()
            .filter_map(|spring| {
                let second = match spring.to {
                    SpringEnd::Sphere(id) => Some(place(id)?),
                    SpringEnd::Point(_) => None,
                };
                Some((*spring, place(spring.sphere)?, second))
            })
            .collect();
        let mut connected = Connected::new(ids.len());
        for &(_, first, second) in &springs {
            connected.join(first, second.unwrap_or(first));
        }
        if system.moves_all_together() {
            (0..ids.len()).for_each(|index| connected.join(0, index));
        }
        let mut components: BTreeMap<usize, Component> = BTreeMap::new();
        let mut place_of = vec![NONE; ids.len()];
        for index in (0..ids.len()).filter(|&index| is_curved(index)) {
            let component = components.entry(connected.root_of(index)).or_default();
            place_of[index] = component.members.len() as u32;
            component.members.push(index as u32);
        }
        for (spring, first, second) in springs {
            if let Some(component) = components.get_mut(&connected.root_of(first)) {
                let [first, second] = [Some(first), second].map(|it| it.map(|it| place_of[it]));
                let first = first.unwrap_or(NONE);
                component.springs.push(PlacedSpring { spring, first, second });
            }
        }
        let components: Vec<Component> = components.into_values().collect();
        let mut of_spheres = if components.is_empty() { Vec::new() } else { place_of };
        for (number, component) in (0u32..).zip(&components) {
            component.members.iter().for_each(|&index| of_spheres[index as usize] = number);
        }
        let most_evaluations =
            if system.moves_all_together() { MOST_WITH_SHORT_STEPS } else { MOST_EVALUATIONS };
        Self { of_spheres, components, due: Vec::new(), most_evaluations }
    }

    /// Adds the sphere with this index, of `count`, as a component of its own, unless it is in one.
    pub fn add_single(&mut self, index: u32, count: usize) {
        if self.of_sphere(index).is_none() {
            self.of_spheres.resize(count, NONE);
            self.of_spheres[index as usize] = self.components.len() as u32;
            self.components.push(Component { members: vec![index], ..Component::default() });
        }
    }

    /// Number of components.
    pub fn len(&self) -> u32 {
        self.components.len() as u32
    }

    pub fn get(&self, number: u32) -> &Component {
        &self.components[number as usize]
    }

    /// The number of the component of a sphere, by its index.
    pub fn of_sphere(&self, index: u32) -> Option<u32> {
        let number = self.of_spheres.get(index as usize).copied();
        number.filter(|&number| number != NONE)
    }

    /// Whether the sphere with this index takes its steps together with others.
    #[inline]
    pub fn has_companions(&self, index: u32) -> bool {
        self.of_sphere(index).is_some_and(|number| self.get(number).members.len() > 1)
    }

    /// Whether there are springs in the component of a sphere, by its index.
    pub fn have_springs(&self, index: u32) -> bool {
        self.of_sphere(index).is_some_and(|number| !self.get(number).springs.is_empty())
    }

    /// Notes that the flight of the sphere with this index restarted, so that its companions' flights must, too.
    pub fn note(&mut self, index: u32) {
        let Some(number) = self.of_sphere(index) else { return };
        let component = &mut self.components[number as usize];
        if component.members.len() > 1 && !component.is_due {
            component.is_due = true;
            self.due.push(number);
        }
    }

    /// Returns whether the flight of a member began again since the last step.
    pub fn is_due(&self, number: u32) -> bool {
        self.get(number).is_due
    }

    /// A component that is due, if there is one.
    #[inline]
    pub fn next_due(&self) -> Option<u32> {
        self.due.first().copied()
    }

    /// Notes that a step of a component begins, in the tick with this number. Returns whether the step must be a
    /// rough one, because the work of the tick is spent: less where `only_contacts` bend the flights.
    pub fn begin_step(&mut self, number: u32, tick: f64, only_contacts: bool) -> bool {
        let component = &mut self.components[number as usize];
        let for_each = MOST_FOR_EACH * component.members.len() as u64;
        if component.tick != tick {
            let ticks = if only_contacts { tick - component.tick } else { f64::INFINITY };
            let regained = (ticks * BEFORE_ZONE_IN_A_TICK as f64) as u64;
            let of_events = component.allowed_for_events;
            component.evaluations =
                component.evaluations.saturating_sub(regained.saturating_add(of_events));
            (component.tick, component.allowed_for_events) = (tick, 0);
        }
        if component.is_due {
            component.is_due = false;
            component.allowed_for_events += MOST_FOR_EVENT * component.members.len() as u64;
            self.due.retain(|&other| other != number);
        }
        let most = if only_contacts { MOST_BEFORE_ZONE } else { self.most_evaluations };
        let allowed = most.max(for_each) + component.allowed_for_events;
        component.evaluations > allowed
    }

    /// Counts evaluations of the forces on spheres of a component.
    pub fn charge(&mut self, number: u32, evaluations: u64) {
        self.components[number as usize].evaluations += evaluations;
    }
}
