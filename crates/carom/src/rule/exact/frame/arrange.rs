//! The arrangement: the spheres in order of place, and their neighbours.

use crate::rule::exact::events::Schedule;
use crate::rule::exact::flights::Flights;
use crate::rule::exact::neighbours::clearance::Clearance;
use crate::rule::exact::neighbours::{Contents, Neighbours, SURFACES_PER_SPHERE, Sliding};
use crate::rule::exact::timeline::Timeline;
use crate::rule::exact::zones;
use crate::shear::Shear;
use crate::surface::Role;
use crate::system::System;

/// In a periodic box, spheres are ordered by place again after this many cell crossings per sphere: seldom enough
/// to cost little, often enough that neighbours stay near each other in memory.
const CROSSINGS_PER_ARRANGEMENT: u64 = 10;
/// Cell crossings per sphere before spheres are ordered again, where all fit into the fast caches in any order.
const CROSSINGS_OF_FEW: u64 = 100;
/// On open axes the spheres are ordered again after this many events per sphere: they may have gathered in
/// outermost cells, which no sphere leaves.
const EVENTS_PER_ARRANGEMENT: u64 = 24;

/// Orders the spheres by place and finds their neighbours as of `time` \[s\]. All predictions become void.
pub(crate) fn arrange(timeline: &mut Timeline, system: &System, time: f64) {
    timeline.moving_surfaces = (0u32..)
        .zip(system.surfaces)
        .filter(|(_, surface)| surface.role == Role::Deflects && !surface.motion.is_at_rest())
        .map(|(number, _)| number)
        .collect();
    // The old schedule is dropped first, so that two never are in memory.
    timeline.schedule = Schedule::default();
    timeline.neighbours = Neighbours::default();
    timeline.flights.make_room_to_grow(time, system.settings.boundary.period());
    let order = contents(&timeline.flights, system, time).curve_order();
    if order.windows(2).any(|pair| pair[0] > pair[1]) {
        timeline.flights.reorder(&order);
        timeline.work.reorder(&order);
    }
    wrap_sheared(timeline, system, time);
    timeline.neighbours = Neighbours::new(contents(&timeline.flights, system, time));
    let sliding_until = timeline.neighbours.sliding().map_or(f64::INFINITY, |it| it.until);
    timeline.neighbours_until = timeline.flights.room_until().min(sliding_until);
    timeline.clearances.clear();
    let Timeline { flights, moving_surfaces, .. } = timeline;
    if flights.hold_forces && moving_surfaces.is_empty() && !system.surfaces.is_empty() {
        timeline.clearances.resize(flights.bodies.len(), Clearance::NONE);
    }
    (timeline.events, timeline.cell_crossings) = (0, 0);
    zones::find_near(timeline);
}

/// Begins flights, at `time` \[s\], of the spheres that have left a box in steady shear along y since theirs began.
fn wrap_sheared(timeline: &mut Timeline, system: &System, time: f64) {
    let Some(shear) = Shear::of(system.settings) else { return };
    for slot in 0..timeline.flights.bodies.len() as u32 {
        let (position, velocity) = timeline.flights.state_of(slot, time);
        if position.y.abs() > 0.5 * shear.period.y {
            let [position, velocity] = shear.wrapped([position, velocity], time);
            timeline.flights.bodies[slot as usize].begin_flight(position, velocity, time);
            timeline.note_flight(slot);
        }
    }
}

/// The images of a box in steady shear, for neighbours found at `time` \[s\].
fn sliding(flights: &Flights, system: &System, time: f64) -> Option<Sliding> {
    // Along an open axis the box counts as a cube.
    let edges = system.settings.boundary.period();
    let depth = if edges.z.is_finite() { edges.z } else { edges.x };
    let spacing = libm::cbrt(edges.x * edges.y * depth / flights.bodies.len().max(1) as f64);
    Shear::of(system.settings).map(|shear| Sliding::from(shear, spacing, time))
}

fn contents<'a>(flights: &'a Flights, system: &System<'a>, time: f64) -> Contents<'a> {
    Contents {
        flights,
        time,
        period: system.settings.boundary.period(),
        sliding: sliding(flights, system, time),
        surfaces: system.surfaces,
        tree: system.tree,
        spheres_collide: system.settings.spheres_collide,
        groups: &system.spheres.groups,
        index_of: &flights.index_of,
    }
}

/// Numbers of events and cell crossings after which the spheres are ordered again.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArrangementDue {
    events: u64,
    cell_crossings: u64,
}

impl ArrangementDue {
    /// The numbers for these spheres.
    pub fn of(timeline: &Timeline, system: &System) -> Self {
        // Finding the surfaces near each cell takes long where there are many.
        let of_surfaces = system.surfaces.len() / SURFACES_PER_SPHERE;
        let count = timeline.flights.bodies.len().max(of_surfaces) as u64;
        let is_closed = system.settings.boundary.period().is_finite();
        match (is_closed, timeline.are_many()) {
            (true, true) => Self::after_crossings(CROSSINGS_PER_ARRANGEMENT * count),
            (true, false) => Self::after_crossings(CROSSINGS_OF_FEW * count),
            (false, _) => Self { events: EVENTS_PER_ARRANGEMENT * count, cell_crossings: u64::MAX },
        }
    }

    /// Whether the spheres must be ordered now.
    #[inline(always)]
    pub fn is_now(self, timeline: &Timeline) -> bool {
        timeline.events > self.events || timeline.cell_crossings > self.cell_crossings
    }

    /// Whether the spheres must be ordered after so many more events, and cell crossings among them.
    pub fn is_after(self, timeline: &Timeline, events: u64, cell_crossings: u64) -> bool {
        timeline.events + events > self.events
            || timeline.cell_crossings + cell_crossings > self.cell_crossings
    }

    fn after_crossings(cell_crossings: u64) -> Self {
        Self { events: u64::MAX, cell_crossings }
    }
}
