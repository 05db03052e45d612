//! Search: when neighbours are found again, and the contacts that are made of them.

pub(crate) mod near_moving;

use glam::DVec3;

use self::near_moving::NearMoving;
use crate::bounds::Bounds;
use crate::collider::Shape;
use crate::detect::contact::Bodies;
use crate::detect::sphere_surface;
use crate::detect::surface_tree;
use crate::interval::Interval;
use crate::parallel;
use crate::report::StepReport;
use crate::rule::contact::accelerate;
use crate::rule::contact::contacts::batch::{ContactKinds, Impulses, Pair};
use crate::rule::contact::contacts::dormant;
use crate::rule::contact::contacts::images::Image;
use crate::rule::contact::contacts::materials::{ContactMaterial, Materials};
use crate::rule::contact::contacts::surfaces::SurfaceContact;
use crate::rule::contact::places::{Places, offsets};
use crate::rule::contact::slabs::search::{self, Search};
use crate::rule::contact::slabs::warm_start::WarmStart;
use crate::rule::contact::slabs::{self, Slab, Slabs};
use crate::rule::contact::slots::Slots;
use crate::rule::contact::slots::row::Row;
use crate::rule::contact::solver::{Scratch, Solver};
use crate::rule::contact::sub_step::SubStep;
use crate::rule::periodic::image_shift;
use crate::surface::{Form, Role};
use crate::system::System;

/// Overlap of a sphere that is not pressed to a surface, as a part of its radius, beyond which it came from behind
/// before the solver knew it.
const WITHIN: f64 = 0.1;

/// Two images are equally near whose squared distances differ by less than this part.
const ROUNDING: f64 = 1e-9;

/// Sorts spheres by place, finds those that may touch, and makes contacts of them that start from their former
/// impulses.
pub(crate) fn search(
    system: &System,
    frame: Interval,
    sub_step: &SubStep,
    solver: &mut Solver,
    scratch: &mut Scratch,
    report: &mut StepReport,
) {
    let Scratch { search, warm_start } = scratch;
    match solver.warm_start.take() {
        Some(collected) => *warm_start = collected,
        None => collect(solver, warm_start),
    }
    let Solver { slots, slabs, watched, dormant, places, .. } = solver;
    solver.is_stale = false;
    solver.incidence.clear();
    slots.wrap();
    let approaches = NearMoving::approaches(system, slots, places, frame.h);
    let approaches = (!system.surfaces.is_empty()).then_some(&approaches[..]);
    let near = |place: &Row, distance: f64| surfaces_near(system, place, distance);
    solver.drift = search.arrange(slots, [frame.h, sub_step.h], approaches, near);
    divide(slots, slabs, search);
    if !dormant.is_empty() {
        let places = search.places();
        dormant::renumber(dormant, |slot| places[slot]);
        dormant::renew(dormant, &slots.sleeps);
    }
    watched.clear();
    if system.settings.spheres_collide {
        search.find_pairs(slots, slabs);
        search.find_image_pairs(slots, slabs);
        if !system.spheres.groups.is_empty() {
            let meet = |[first, second]: &[u32; 2]| {
                system.spheres_meet(slots.index[*first as usize], slots.index[*second as usize])
            };
            for slab in &mut slabs.list {
                slab.pairs.retain(meet);
                slab.image_pairs.retain(|pair| meet(&pair.slots));
            }
        }
        if slots.asleep() > 0 {
            for slab in &mut slabs.list {
                watch_sleepers(slots, &mut slab.pairs, watched);
                slab.image_pairs.iter().for_each(|it| watch(slots, it.slots, watched));
            }
        }
    }
    let reach = Search::reach(slots) + solver.drift.reach;
    places.find_images(system.surfaces, slots.period, reach);
    let (drift, left) = (solver.drift.reach, frame.h - sub_step.time);
    let moving = NearMoving::find(system, slots, places, |slot, fastest| {
        let row = slots.position[slot];
        let reach = row.number() + slots.reference[slot].number() + drift;
        reach + left * fastest.around(row.vector(), reach, left)
    });
    let known = Known {
        system,
        slots,
        warm_start,
        before: search.from(),
        materials: &solver.materials,
        kinds: solver.kinds,
        places: &solver.places,
        moving: &moving,
        drift,
        left,
    };
    known.add_contacts(slabs);
    if slots.shear.is_some() {
        // Spheres that were wrapped have other velocities.
        solver.energy_before = accelerate::kinetic_energy_of(slots, slabs);
    }
    report.work.searches += 1;
    report.work.pair_tests += search.take_tests();
}

/// Returns the number of surfaces up to a distance \[m\] from a sphere with this row of centre and radius; 0 where all
/// are few.
fn surfaces_near(system: &System, place: &Row, distance: f64) -> usize {
    if system.surfaces.len() <= search::MOST_SURFACES {
        return 0;
    }
    let reach = DVec3::splat(place.number() + distance);
    system.tree.count_near(&Bounds::around(place.vector(), reach))
}

/// Saves the impulses of all contacts that stay awake.
fn collect(solver: &Solver, warm_start: &mut WarmStart) {
    let Solver { slots, slabs, dormant, .. } = solver;
    warm_start.collect(slabs, slots.len(), |slot| slot as u32);
    let mut woken = dormant.iter().filter(|contact| contact.wakes(&slots.sleeps)).peekable();
    if woken.peek().is_some() {
        warm_start.collect_dormant(woken, slots.len(), |slot| slot as u32);
    }
}

/// Divides the slots into slabs, without contacts.
fn divide(slots: &Slots, slabs: &mut Slabs, search: &Search) {
    let starts = search.runs(slabs::count(slots.len()));
    slabs.list.resize_with(starts.len() - 1, Slab::default);
    for (slab, bounds) in slabs.list.iter_mut().zip(starts.windows(2)) {
        (slab.start, slab.end) = (bounds[0], bounds[1]);
    }
    for number in 0..slabs.list.len() {
        let next_end = slabs.list[(number + 1).min(slabs.list.len() - 1)].end;
        let slab = &mut slabs.list[number];
        slab.batches.clear(next_end - slab.start);
        slab.surfaces.clear();
        slab.pairs.clear();
        slab.image_pairs.clear();
    }
    slabs.far.end = slots.len();
    slabs.far.batches.clear(slots.len());
}

/// Removes the pairs of which both sleep, and notes those of which one does.
fn watch_sleepers(slots: &Slots, pairs: &mut Vec<[u32; 2]>, watched: &mut Vec<[u32; 2]>) {
    pairs.retain(|&pair| {
        watch(slots, pair, watched);
        pair.iter().any(|&slot| !slots.sleeps[slot as usize])
    });
}

/// Notes a pair of which one sleeps and the other does not.
fn watch(slots: &Slots, [first, second]: [u32; 2], watched: &mut Vec<[u32; 2]>) {
    match [first, second].map(|slot| slots.sleeps[slot as usize]) {
        [false, true] => watched.push([second, first]),
        [true, false] => watched.push([first, second]),
        [true, true] | [false, false] => {}
    }
}

/// The input for making contacts.
#[derive(Clone, Copy)]
struct Known<'a> {
    system: &'a System<'a>,
    slots: &'a Slots,
    warm_start: &'a WarmStart,
    /// The slot of each sphere before the search.
    before: &'a [u32],
    materials: &'a Materials,
    kinds: ContactKinds,
    places: &'a Places,
    moving: &'a NearMoving,
    /// Longest common path until the next search \[m\].
    drift: f64,
    /// What is left of the frame \[s\].
    left: f64,
}

impl Known<'_> {
    /// Makes the contacts of all slabs in parallel: first those that press, so that most others come into batches
    /// with little work for sweeps.
    fn add_contacts(&self, slabs: &mut Slabs) {
        let Slabs { list, far } = slabs;
        let ends: Vec<usize> = list.iter().map(|slab| slab.end).collect();
        let tasks: Vec<_> = list.iter_mut().enumerate().collect();
        parallel::for_each(tasks, |(number, slab)| {
            let next_end = ends[(number + 1).min(ends.len() - 1)];
            let Slab { start, batches, pairs, image_pairs, .. } = &mut *slab;
            let mut unloaded = Vec::new();
            let mut is_far = |slots: [u32; 2], image: Image| {
                let is_far = slots[1] as usize >= next_end;
                if !is_far {
                    let pair = self.pair(slots, image, *start);
                    if pair.impulses.is_some() {
                        batches.push(&pair, self.kinds);
                    } else {
                        unloaded.push(pair);
                    }
                }
                is_far
            };
            pairs.retain(|&slots| is_far(slots, Image::OWN));
            image_pairs.retain(|pair| is_far(pair.slots, pair.image));
            unloaded.iter().for_each(|pair| batches.push(pair, self.kinds));
            self.add_surfaces(slab);
        });
        for slots in list.iter_mut().flat_map(|slab| slab.pairs.drain(..)) {
            far.batches.push(&self.pair(slots, Image::OWN, 0), self.kinds);
        }
        for pair in list.iter_mut().flat_map(|slab| slab.image_pairs.drain(..)) {
            far.batches.push(&self.pair(pair.slots, pair.image, 0), self.kinds);
        }
    }

    /// The pair of the spheres in two slots, counted from the start of a run, where the second one touches by this
    /// image.
    #[inline(always)]
    fn pair(&self, slots: [u32; 2], Image { shift, slide }: Image, start: usize) -> Pair {
        let at = self.slots;
        let [first, second] = slots.map(|slot| slot as usize);
        let is_nearest = !self.kinds.images || self.is_nearest([first, second], shift);
        let indices = [at.index[first], at.index[second]];
        let spins = [at.spin.get(first), at.spin.get(second)];
        Pair {
            slots: slots.map(|slot| slot - start as u32),
            radii: at.contact_radii([first, second], self.system),
            inverse_masses: [at.velocity[first].number(), at.velocity[second].number()],
            inverse_inertias: spins.map(|row| row.map_or(0.0, |row| row.number())),
            material: self.materials.of_pair(indices, self.system),
            impulses: if is_nearest {
                self.warm_start.of_pair([self.before[first], self.before[second]])
            } else {
                Impulses::default()
            },
            shift,
            slide,
        }
    }

    /// Whether no other image of the second sphere, shifted otherwise \[m\], is nearer to the first: impulses are kept
    /// by pair.
    fn is_nearest(&self, [first, second]: [usize; 2], shift: DVec3) -> bool {
        let [from, to] = [first, second].map(|slot| self.slots.position[slot].vector());
        let nearest = self.slots.offset([first, second]);
        (to + shift - from).length_squared() <= (1.0 + ROUNDING) * nearest.length_squared()
    }

    /// Makes contacts of the spheres of a slab with the surfaces that they may touch until the next
    /// search.
    fn add_surfaces(&self, slab: &mut Slab) {
        let slots = self.slots;
        let mut near = Vec::new();
        let some_move = self.places.are_moving();
        let awake = (slab.start..slab.end).filter(|&slot| !slots.sleeps[slot]);
        for slot in awake {
            let (center, radius) = (slots.position[slot].vector(), slots.position[slot].number());
            let margin = slots.reference[slot].number() + self.drift;
            let bounds = Bounds::around(center, DVec3::splat(radius + margin));
            self.system.tree.near(&bounds, &mut near);
            if self.kinds.images {
                self.add_images(&bounds, &mut near);
            }
            if some_move {
                self.add_moving(slot, &mut near);
            }
            for &surface in near.iter() {
                if self.may_touch(slot, surface) {
                    let relative = (slot - slab.start) as u32;
                    slab.surfaces.push(self.contact(slot, relative, surface));
                }
            }
        }
    }

    /// Adds the images of surfaces near some bounds \[m\].
    fn add_images(&self, bounds: &Bounds, near: &mut Vec<u32>) {
        let period = self.slots.period;
        let mut others = Vec::new();
        for offset in offsets(period, 1) {
            let shift = image_shift(offset.map(i32::from), period);
            let bounds = Bounds { min: bounds.min - shift, max: bounds.max - shift };
            self.system.tree.near(&bounds, &mut others);
            let numbers = others.iter().filter_map(|&it| self.places.number_of_image(it, offset));
            near.extend(numbers);
        }
    }

    /// Adds the surfaces that move and are near a sphere, by its slot, in place of those whose bounds were near at the
    /// start of the frame.
    fn add_moving(&self, slot: usize, near: &mut Vec<u32>) {
        let surfaces = self.system.surfaces;
        near.retain(|&it| {
            let own = self.places.surface_of(it);
            surfaces[own as usize].motion.is_at_rest()
        });
        near.extend(self.moving.of(slot));
        near.sort_unstable();
        near.dedup();
    }

    /// Whether a sphere and a surface may touch until the next search, or the end of the frame.
    fn may_touch(&self, slot: usize, surface: u32) -> bool {
        let own = self.places.surface_of(surface);
        let deflects = self.system.surfaces[own as usize].role == Role::Deflects;
        if !deflects || !self.system.meets_surface(self.slots.index[slot], own) {
            return false;
        }
        let (center, radius) =
            (self.slots.position[slot].vector(), self.slots.position[slot].number());
        let mut margin = self.slots.reference[slot].number() + self.drift;
        let (form, motion) = self.places.at_start(surface);
        let moves = !motion.is_at_rest();
        if moves {
            let arm = (center - motion.origin).length() + radius + margin;
            margin += self.places.fastest_within(surface, arm, self.left) * self.left;
        }
        let are_bounds_near = || {
            let reach = Bounds::around(center, DVec3::splat(radius + margin));
            surface_tree::bounds(form).is_none_or(|bounds| bounds.overlap(&reach))
        };
        // Of the many features of a mesh that are near, few are the nearest one after so short a way.
        let is_of_mesh = || {
            let collider = self.system.surfaces[own as usize].collider;
            let collider = self.system.colliders.list().get(collider.0);
            collider.is_some_and(|it| matches!(it.shape, Shape::Mesh(_)))
        };
        let is_far = match form {
            Form::Facet(it) => !it.may_be_met(center, radius, margin),
            Form::Edge(it) => !it.may_be_met(center, radius, margin),
            Form::Corner(it) => !it.may_be_met(center, radius, margin),
            _ => false,
        };
        if is_far && is_of_mesh() {
            return false;
        }
        match (sphere_surface(form, center, radius), form) {
            (Some(separation), _) => separation.distance <= margin,
            // From just behind a rectangle, a sphere may come round its edge.
            (None, Form::Rectangle(rectangle)) => {
                (center - rectangle.center).dot(rectangle.normal) >= -margin
                    && (!moves || are_bounds_near())
            }
            (None, Form::Band(band)) => {
                band.seen_from(center).front >= -margin && (!moves || are_bounds_near())
            }
            (None, Form::Facet(_) | Form::Edge(_) | Form::Corner(_)) => {
                is_of_mesh() || are_bounds_near()
            }
            (None, _) => true,
        }
    }

    /// Whether a sphere that does not press on an open surface overlaps it as only one from behind does.
    fn is_within(&self, slot: usize, surface: u32) -> bool {
        let (form, _) = self.places.at_start(surface);
        let place = self.slots.position[slot];
        let separation = sphere_surface(form, place.vector(), place.number());
        form.is_open() && separation.is_some_and(|it| it.distance < -WITHIN * place.number())
    }

    fn contact(&self, slot: usize, relative: u32, surface: u32) -> SurfaceContact {
        let sphere = self.slots.index[slot];
        let own = self.places.surface_of(surface);
        let bodies = Bodies::Surface { sphere, surface: own };
        let material = ContactMaterial::of(bodies, self.system);
        let mut contact = SurfaceContact::new(relative, surface, material);
        let (form, motion) = self.places.at_start(surface);
        if self.system.surfaces[own as usize].course.is_none() && motion.is_at_rest() {
            contact.clearance = clearance(form, self.slots.position[slot].vector());
        }
        contact.kick = self.system.surfaces[own as usize].kick;
        contact.impulses = self.warm_start.of_surface(self.before[slot], surface);
        contact.passes = self.warm_start.passes(self.before[slot], surface)
            || (!contact.impulses.is_some() && self.is_within(slot, surface));
        contact
    }
}

/// Returns how far a centre \[m\] may go before it can be in the region of a feature of a mesh; 0 where that is not
/// known.
fn clearance(form: &Form, center: DVec3) -> f64 {
    match form {
        Form::Facet(it) => it.clearance(center),
        // Spheres come to a border from behind, too.
        Form::Edge(it) if !it.is_border => it.clearance(center),
        Form::Corner(it) => it.clearance(center),
        _ => 0.0,
    }
}
