//! Hold: no centre of a sphere passes a face, whatever contacts made of its motion.
//!
//! A sphere is seen from each surface, as if that were at rest: so a box that moves and turns is a box. The
//! way of its centre within a sub-step is straight there. What counts is whether that way passes the
//! surface: no margin, and no step short enough.

use glam::DVec3;

use super::contacts::surfaces::{self, SurfaceContact};
use super::neighbours::near_moving::NearMoving;
use super::places::Places;
use super::slabs::Slab;
use super::slabs::landings::Landings;
use super::slabs::search::MOST_SURFACES;
use super::slots::Run;
use super::slots::row::Row;
use super::slots::slab_totals::SlabTotals;
use super::solver::{Bounce, Solver, Turn};
use super::sub_step::SubStep;
use crate::band::Band;
use crate::bounds::Bounds;
use crate::contact_time;
use crate::flight::Flight;
use crate::mesh::Facet;
use crate::report::StepReport;
use crate::surface::{Form, Rectangle, Role, SurfaceMotion};
use crate::system::System;

/// Least distance of a centre in front of a surface, as a part of the radius, whatever presses on the sphere:
/// behind the surface nothing would push it back.
const LEAST_IN_FRONT: f64 = 0.5;
/// A path that passes an edge by less than this part of the radius passes the face: between two faces that share an
/// edge there is no gap, however numbers round. No centre is so near to an edge otherwise.
const BESIDE: f64 = 0.01;
/// Where spheres overlap by more than this part of the sum of radii, a correction may move them far.
const FAR_APART: f64 = 0.02;
/// Largest number of pushes from one surface to another in a corner.
const ROUNDS: usize = 16;

/// Holds back spheres whose centres would pass a surface in the sub-step. Velocities stay as they are.
pub(super) fn hold(
    system: &System,
    solver: &mut Solver,
    sub_step: &SubStep,
    report: &mut StepReport,
) {
    let Solver { slots, slabs, places, bounces, landings, drift, .. } = solver;
    let go_astray = slabs.iter().any(|it| it.totals.leaves || it.totals.overlap > FAR_APART);
    let (common, h) = (drift.way, sub_step.h);
    if go_astray {
        // Pushed by one surface, a sphere may come to another one.
        NearMoving::find(system, slots, places, |slot, fastest| {
            let row = slots.position[slot];
            let start = slots.reference.get(slot).map_or(row.vector(), |it| it.vector());
            let reach = 2.0 * (row.number() + (row.vector() - start).length());
            reach + h * fastest.around(row.vector(), reach, h)
        });
    }
    let index = if go_astray { slots.index.clone() } else { Vec::new() };
    let guard = Guard { system, places, index, bounces, landings, common, h, go_astray };
    slabs.each(slots, |mut run, slab| {
        let SlabTotals { energy, squeezed, .. } = guard.hold_all(&mut run, slab);
        (slab.totals.energy, slab.totals.squeezed) = (energy, squeezed);
    });
    report.energy_account.correction += slabs.list.iter().map(|it| it.totals.energy).sum::<f64>();
    let squeezed = slabs.list.iter().map(|slab| slab.totals.squeezed).sum::<u32>();
    report.contact_account.squeezed += squeezed;
}

/// The paths of spheres in the sub-step.
struct Guard<'a> {
    system: &'a System<'a>,
    places: &'a Places,
    /// Index of each slot in the arrays of the world; empty where no sphere goes astray.
    index: Vec<u32>,
    bounces: &'a [Bounce],
    /// Spheres that met bodies on the way, each at its time: what counts is the flight after the last.
    landings: &'a Landings,
    /// The common motion since the last search \[m\].
    common: DVec3,
    /// Length of the sub-step \[s\].
    h: f64,
    /// Whether spheres may have reached surfaces with which they have no contact.
    go_astray: bool,
}

impl Guard<'_> {
    /// Holds back the spheres of a slab. Returns the work against forces and the number of spheres.
    fn hold_all(&self, run: &mut Run, slab: &Slab) -> SlabTotals {
        let mut found = SlabTotals::default();
        let mut go_to = |run: &mut Run, slot: usize, end: Option<DVec3>| {
            let Some(end) = end else { return };
            let way = end - run.position[slot].vector();
            found.energy += surfaces::move_by(run, slot, way);
            found.squeezed += 1;
        };
        for contacts in slab.surfaces.chunk_by(|first, second| first.slot == second.slot) {
            let slot = contacts[0].slot as usize;
            if !self.is_astray(run, slot) {
                let end = self.held_by_contacts(run, slab.start, contacts);
                go_to(run, slot, end);
            }
        }
        if self.go_astray {
            for slot in (0..run.position.len()).filter(|&slot| !run.sleeps[slot]) {
                if self.is_astray(run, slot) {
                    let first = slab.surfaces.partition_point(|it| (it.slot as usize) < slot);
                    let own = slab.surfaces.get(first).filter(|it| it.slot as usize == slot);
                    // At the last search the sphere was in front of all surfaces without a contact.
                    let start = own.map_or(run.reference[slot].vector(), |it| it.start);
                    let start = self.start_of(slab.start + slot, start);
                    let way = (start, self.turn_of(slab.start + slot));
                    let mut surfaces =
                        self.surfaces_of(slab.start + slot, run.position[slot], start);
                    let own = slab.surfaces[first..].iter();
                    for passed in
                        own.take_while(|it| it.slot as usize == slot).filter(|it| it.passes)
                    {
                        surfaces.retain(|&it| it != passed.surface);
                    }
                    let end = self.held(run, slot, way, &surfaces);
                    go_to(run, slot, end);
                }
            }
        }
        found
    }

    /// The place at which the surfaces of its contacts hold a sphere.
    fn held_by_contacts(
        &self,
        run: &Run,
        first: usize,
        contacts: &[SurfaceContact],
    ) -> Option<DVec3> {
        let slot = contacts[0].slot as usize;
        let (end, radius) = (run.position[slot].vector(), run.position[slot].number());
        let turn = self.turn_of(first + slot);
        let start = self.start_of(first + slot, contacts[0].start);
        let passes = |contact: &SurfaceContact| {
            let beside = BESIDE * radius;
            if [start, end].iter().all(|&it| contact.is_clear(run, it, beside)) {
                return false;
            }
            let forms =
                [self.places.at_start(contact.surface).0, self.places.at_end(contact.surface).0];
            let way = Way { forms, centers: [start, end] };
            !contact.passes && way.pushed(LEAST_IN_FRONT * radius, beside).is_some()
        };
        if turn.is_none() && !contacts.iter().any(passes) {
            return None;
        }
        let blocking = contacts.iter().filter(|contact| !contact.passes);
        let surfaces: Vec<u32> = blocking.map(|contact| contact.surface).collect();
        self.held(run, slot, (start, turn), &surfaces)
    }

    /// The place at which a sphere is held on a straight path to its turning point and from there to its end.
    fn held(
        &self,
        run: &Run,
        slot: usize,
        (start, turn): (DVec3, Option<Turn>),
        surfaces: &[u32],
    ) -> Option<DVec3> {
        let (end, radius) = (run.position[slot].vector(), run.position[slot].number());
        let leg = |[from, to]: [f64; 2], centers| {
            held(&self.passages(surfaces, [from, to], centers), centers, radius)
        };
        // A sphere that would have passed something before its turning point did not get there.
        let turn = turn.filter(|it| leg([0.0, it.time], [start, it.place]).is_none());
        let Turn { time, place } = turn.unwrap_or(Turn { time: 0.0, place: start });
        leg([time, self.h], [place, end])
    }

    /// The passages of a centre \[m\] along surfaces between two times of the sub-step \[s\].
    fn passages(
        &self,
        surfaces: &[u32],
        [from, to]: [f64; 2],
        [start, _]: [DVec3; 2],
    ) -> Vec<Passage> {
        let passage = |&number: &u32| {
            let place = self.places.at_start(number);
            let (before, motion) = place.1.carry(place.0, from);
            let carried = motion.carried(start, to - from);
            let is_whole = to == self.h;
            let after = if is_whole {
                self.places.at_end(number).0.clone()
            } else {
                place.1.carry(place.0, to).0
            };
            Passage { before, after, carried }
        };
        surfaces.iter().map(passage).collect()
    }

    /// The numbers of the surfaces that deflect a sphere, by its slot, near its path from `start` \[m\]; all of them
    /// where they are few.
    fn surfaces_of(&self, slot: usize, end: Row, start: DVec3) -> Vec<u32> {
        let sphere = self.index[slot];
        let deflects = |it: &u32| {
            let own = self.places.surface_of(*it);
            self.system.surfaces[own as usize].role == Role::Deflects
                && self.system.meets_surface(sphere, own)
        };
        if self.system.surfaces.len() <= MOST_SURFACES {
            return self.places.all_known().filter(deflects).collect();
        }
        let path =
            Bounds::around(start, DVec3::ZERO).union(Bounds::around(end.vector(), DVec3::ZERO));
        // The sphere may be pushed from surface to surface.
        let beside = 2.0 * (end.number() + (end.vector() - start).length());
        let mut near = Vec::new();
        self.system.tree.near(&path.widened(beside), &mut near);
        let is_at_rest = |it: &u32| self.system.surfaces[*it as usize].motion.is_at_rest();
        let at_rest = near.into_iter().filter(is_at_rest);
        at_rest.chain(self.places.images_and_moving()).filter(deflects).collect()
    }

    /// Returns where a sphere was turned back, by its slot.
    fn turn_of(&self, slot: usize) -> Option<Turn> {
        let found = self.bounces.binary_search_by_key(&slot, |it| it.slot as usize);
        found.ok().and_then(|place| self.bounces[place].turn)
    }

    /// Start of the last straight path of a sphere, by its slot, which began the sub-step at `start` \[m\].
    fn start_of(&self, slot: usize, start: DVec3) -> DVec3 {
        self.landings.of(slot).map_or(start, |landed| landed.from)
    }

    /// Whether a sphere has left the margin within which its surfaces are known.
    fn is_astray(&self, run: &Run, slot: usize) -> bool {
        if !self.go_astray {
            return false;
        }
        let Some(reference) = run.reference.get(slot) else { return false };
        let way = run.position[slot].vector() - reference.vector() - self.common;
        way.length_squared() > reference.number() * reference.number()
    }
}

/// A surface before and after a sphere went past it, and where its centre would be if it had gone along \[m\].
pub(crate) struct Passage {
    pub before: Form,
    pub after: Form,
    pub carried: DVec3,
}

/// Place \[m\] at which a sphere of this radius \[m\] ends that would pass surfaces between two centres \[m\];
/// `None` if it passes none.
///
/// Each surface that it would pass pushes it along its normal, until none does. If that has no end, it goes
/// along with one of them: surfaces that move together never press it out. Between others that leave it no room,
/// it ends behind one.
pub(crate) fn held(passages: &[Passage], [start, end]: [DVec3; 2], radius: f64) -> Option<DVec3> {
    let (least, beside) = (LEAST_IN_FRONT * radius, BESIDE * radius);
    let pushed = |passage: &Passage, end: DVec3, least: f64| {
        let forms = [&passage.before, &passage.after];
        Way { forms, centers: [start, end] }.pushed(least, beside)
    };
    let mut held = end;
    for _ in 0..ROUNDS {
        let before = held;
        for passage in passages {
            held = pushed(passage, held, least).unwrap_or(held);
        }
        if held == before {
            return (held != end).then_some(held);
        }
    }
    let passes = |end: DVec3| passages.iter().any(|it| pushed(it, end, 0.0).is_some());
    let goes_along = || passages.iter().map(|it| it.carried).find(|&carried| !passes(carried));
    Some(if passes(held) { goes_along().unwrap_or(held) } else { held })
}

/// The path of a centre relative to a surface, with both at its start and its end.
#[derive(Clone, Copy)]
struct Way<'a> {
    forms: [&'a Form; 2],
    /// \[m\]
    centers: [DVec3; 2],
}

impl Way<'_> {
    /// Place of the centre at the `least` distance \[m\] in front of the surface, if it would come nearer. A path
    /// that is `beside` an edge by less than this \[m\] passes the surface.
    fn pushed(&self, least: f64, beside: f64) -> Option<DVec3> {
        let [start, end] = self.centers;
        match self.forms {
            [_, Form::HalfSpace { point, normal }] => {
                let missing = least - (end - *point).dot(*normal);
                (missing > 0.0).then(|| end + missing * *normal)
            }
            [Form::Rectangle(before), Form::Rectangle(after)] => {
                let missing = least - (end - after.center).dot(after.normal);
                let seen = || [local(before, start), local(after, end)];
                let is_held = missing > 0.0 && comes_through(after, seen(), least, beside);
                is_held.then(|| end + missing * after.normal)
            }
            [Form::Facet(before), Form::Facet(after)] => {
                let missing = least - after.height_of(end);
                let is_held = missing > 0.0
                    && before.height_of(start) >= 0.0
                    && comes_through_face([before, after], [start, end], least, beside);
                is_held.then(|| end + missing * after.frame.normal)
            }
            [Form::Sphere { center: before, .. }, Form::Sphere { center: after, radius }] => {
                let out = way_out([start - *before, end - *after], radius + least)?;
                Some(*after + out)
            }
            [Form::Band(before), Form::Band(after)] => {
                let start = after.carried_from(before, start);
                pushed_by_band(after, [start, end], least, beside)
            }
            _ => None,
        }
    }
}

/// Place of a centre at the `least` distance \[m\] in front of a surface of revolution, if its straight path would
/// come nearer to the face or pass `beside` it by less than this \[m\].
fn pushed_by_band(band: &Band, [start, end]: [DVec3; 2], least: f64, beside: f64) -> Option<DVec3> {
    let way = end - start;
    let before = band.seen_from(start);
    if before.front < 0.0 || before.distance > least + way.length() {
        return None;
    }
    let flight =
        Flight { position: start, velocity: way, acceleration: DVec3::ZERO, drag_rate: 0.0 };
    let form = Form::Band(*band).closed();
    let part = contact_time::sphere_surface(&flight, least, &form, &SurfaceMotion::REST, 1.0)?;
    let there = start + part * way;
    let reached = band.seen_from(there);
    if reached.room < -beside {
        return None;
    }
    // Along the face the centre moves freely, while it stays over the face.
    let over = band.face_seen_from(end);
    let along = end + (least - over.front).max(0.0) * over.normal;
    let stays = over.front < least
        && over.normal.dot(reached.normal) > 0.0
        && band.seen_from(along).room >= 0.0;
    Some(if stays { along } else { there })
}

/// A point in the coordinates of a rectangle, with y in front of it \[m\].
fn local(rectangle: &Rectangle, point: DVec3) -> DVec3 {
    let offset = point - rectangle.center;
    let Rectangle { axis_x, axis_z, normal, .. } = *rectangle;
    DVec3::new(offset.dot(axis_x), offset.dot(normal), offset.dot(axis_z))
}

/// Whether a point that was in front comes down to a height \[m\] over the rectangle, or `beside` it \[m\]. One that
/// rises may have come from behind.
fn comes_through(
    rectangle: &Rectangle,
    [start, end]: [DVec3; 2],
    height: f64,
    beside: f64,
) -> bool {
    if start.y < 0.0 || end.y >= height.min(start.y) {
        return false;
    }
    let part = if start.y > height { (start.y - height) / (start.y - end.y) } else { 0.0 };
    let there = start + part * (end - start);
    there.x.abs() <= rectangle.half_x + beside && there.z.abs() <= rectangle.half_z + beside
}

/// Whether a point that was in front of a face, where it was before, comes down to a height \[m\] over it, or `beside`
/// it \[m\]. One that rises may have come from behind.
fn comes_through_face(
    [before, after]: [&Facet; 2],
    [start, end]: [DVec3; 2],
    height: f64,
    beside: f64,
) -> bool {
    let (from, to) = (before.height_of(start), after.height_of(end));
    if to >= height.min(from) {
        return false;
    }
    let part = if from > height { (from - height) / (from - to) } else { 0.0 };
    let seen = |facet: &Facet, place: DVec3| place - facet.frame.center;
    let there = seen(before, start) + part * (seen(after, end) - seen(before, start));
    after.is_beside(after.frame.center + there, beside)
}

/// The place at a distance from the origin \[m\], on the side of the start, of a point that would come nearer on
/// a straight way.
fn way_out([start, end]: [DVec3; 2], distance: f64) -> Option<DVec3> {
    let way = end - start;
    let (along, length_squared) = (start.dot(way), way.length_squared());
    let room = start.length_squared() - distance * distance;
    if room < 0.0 {
        // From inside it may leave, but not through the middle.
        let is_same_side = start.dot(end) > 0.0;
        if is_same_side && end.length_squared() >= distance * distance {
            return None;
        }
        return Some(at_distance(if is_same_side { end } else { start }, distance));
    }
    let discriminant = along * along - length_squared * room;
    if along >= 0.0 || discriminant <= 0.0 {
        return None;
    }
    let enters = room / (discriminant.sqrt() - along);
    (enters < 1.0).then(|| at_distance(start + enters * way, distance))
}

/// The place in the direction of another one, at a distance from the origin \[m\].
fn at_distance(place: DVec3, distance: f64) -> DVec3 {
    let length = place.length();
    if length > 0.0 { place * (distance / length) } else { distance * DVec3::Y }
}
