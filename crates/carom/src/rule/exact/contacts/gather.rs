//! Gathering a group: what touches at one instant, what touches that, and so on.

use std::collections::BTreeMap;

use glam::DVec3;

use super::group::Group;
use super::member::Member;
use super::ring::with_sides;
use super::separation::{has_at, holding_mesh, touching_distance, touching_gap};
use super::touch::{Touch, TouchOrigin};
use crate::detect::contact::Bodies;
use crate::detect::sphere_surface;
use crate::norm::Norm;
use crate::rule::exact::contacts::contact_scale::{MOST_MISSED, TOUCHING};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::features::has;
use crate::rule::exact::flights::Cluster;
use crate::rule::exact::neighbours::NeighbourBuffer;
use crate::rule::exact::predict::moving::Around;
use crate::rule::exact::timeline::Timeline;
use crate::rule::periodic;
use crate::surface::PARALLEL;

/// Angle \[rad\] between the normals of flush faces, at most, rounding included.
const FLUSH: f64 = 2e-9;

/// Gathers the spheres at `seeds`, whatever touches them at `time` \[s\], what touches that, and so
/// on, clusters as a whole. `joined` contacts count as touching, too.
pub(crate) fn gather(
    timeline: &Timeline,
    context: &StepContext,
    seeds: &[u32],
    surface: Option<u32>,
    joined: &[Bodies],
    time: f64,
) -> Group {
    let mut gathering =
        Gathering { timeline, context, time, ..Gathering::empty(timeline, context) };
    seeds.iter().for_each(|&seed| gathering.join(seed));
    if let [first, second] = *seeds {
        gathering.connect_nearest(first, second);
    }
    if let (Some(surface), [slot]) = (surface, seeds) {
        gathering.connect_predicted(*slot, surface);
    }
    for &bodies in joined {
        gathering.connect_bodies(bodies);
        for index in bodies.spheres() {
            gathering.join(timeline.flights.slot_of[index as usize]);
        }
    }
    while let Some(slot) = gathering.frontier.pop() {
        gathering.touch_spheres(slot);
        gathering.touch_surfaces(slot);
        gathering.join_cluster(slot);
    }
    gathering.finish()
}

/// A cluster at `time` \[s\]: its spheres and their persistent contacts.
pub(crate) fn gather_cluster(
    timeline: &Timeline,
    context: &StepContext,
    cluster: &Cluster,
    time: f64,
) -> Group {
    let mut gathering = Gathering { time, ..Gathering::empty(timeline, context) };
    gathering.join_members(cluster);
    gathering.finish()
}

/// A group while it is gathered.
struct Gathering<'a> {
    timeline: &'a Timeline,
    context: &'a StepContext<'a>,
    time: f64,
    /// Members by index, and so in order.
    members: BTreeMap<u32, Member>,
    touches: BTreeMap<Bodies, TouchOrigin>,
    /// Slots of members whose neighbours were not searched yet.
    frontier: Vec<u32>,
}

impl<'a> Gathering<'a> {
    fn empty(timeline: &'a Timeline, context: &'a StepContext<'a>) -> Self {
        let (members, touches) = (BTreeMap::new(), BTreeMap::new());
        Self { timeline, context, time: 0.0, members, touches, frontier: Vec::new() }
    }

    fn join(&mut self, slot: u32) {
        let index = self.timeline.flights.index_of[slot as usize];
        if self.members.contains_key(&index) {
            return;
        }
        self.members.insert(index, Member::at(&self.timeline.flights, slot, self.time));
        self.frontier.push(slot);
    }

    /// Whether the box is periodic along an axis.
    fn has_images(&self) -> bool {
        self.context.period != DVec3::INFINITY
    }

    /// Notes that two spheres touch, with the shift from the second one's position to its image beside the first.
    fn connect(&mut self, slots: [u32; 2], shift: DVec3) {
        let is_predicted = false;
        let indices = slots.map(|slot| self.timeline.flights.index_of[slot as usize]);
        let shift = if indices[0] < indices[1] { shift } else { -shift };
        self.touches.entry(Bodies::pair(indices)).or_insert(TouchOrigin {
            shift,
            is_predicted,
            is_handed_over: false,
        });
    }

    /// Connects two spheres that touch by prediction or persistent contact, whatever rounding says. In a periodic
    /// box their nearest images touch.
    fn connect_nearest(&mut self, first: u32, second: u32) {
        let shift = if self.has_images() {
            let place = |slot| self.timeline.flights.state_of(slot, self.time).0;
            let offset = place(second) - place(first);
            periodic::wrapped(offset, self.context.period) - offset
        } else {
            DVec3::ZERO
        };
        self.connect([first, second], shift);
    }

    /// Notes that a sphere and a surface touch, whatever rounding says: in a periodic box, the nearest
    /// image of the surface.
    fn connect_surface(
        &mut self,
        slot: u32,
        surface: u32,
        [is_predicted, is_handed_over]: [bool; 2],
    ) {
        let sphere = self.timeline.flights.index_of[slot as usize];
        let bodies = Bodies::Surface { sphere, surface };
        if !self.has_images() {
            let shift = DVec3::ZERO;
            let found = TouchOrigin { shift, is_predicted, is_handed_over };
            self.touches.entry(bodies).or_insert(found);
            return;
        }
        let place = self.timeline.flights.state_of(slot, self.time).0;
        let distance = |shift: DVec3| {
            let (form, _) = self.context.surface_at(surface, self.time);
            let separation = sphere_surface(&form, place - shift, 0.0);
            separation.map_or(f64::INFINITY, |separation| separation.distance)
        };
        let images = self.timeline.images_of(self.context.system, slot, surface);
        let nearest = images.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
        if let Some((_, shift)) = nearest {
            let found = TouchOrigin { shift: -shift, is_predicted, is_handed_over };
            self.touches.entry(bodies).or_insert(found);
        }
    }

    fn touch_spheres(&mut self, slot: u32) {
        if !self.context.system.settings.spheres_collide {
            return;
        }
        let timeline = self.timeline;
        let species = *timeline.flights.species_of(slot);
        let (place, velocity) = timeline.flights.state_of(slot, self.time);
        let mut found = Vec::new();
        let mut around = NeighbourBuffer::default();
        timeline.neighbours.find(slot, species.level, &mut around);
        for neighbour in around.others(slot) {
            let (near, shift) = (neighbour.slot(), timeline.neighbours.shift_of(slot, neighbour));
            if timeline.flights.is_stepped(near) {
                // What meets it joins its zone.
                continue;
            }
            let (near_place, near_velocity) = timeline.flights.state_of(near, self.time);
            let flights = &timeline.flights;
            let radius_sum = flights.contact_distance([&species, flights.species_of(near)]);
            let gap = (near_place + shift - place).norm() - radius_sum;
            let coordinates = place.norm() + near_place.norm() + radius_sum;
            let speed = (near_velocity - velocity).norm();
            if gap <= touching_gap(coordinates, speed, self.time) {
                found.push((near, shift));
            }
        }
        for (near, shift) in found {
            self.connect([slot, near], shift);
            self.join(near);
        }
    }

    fn touch_surfaces(&mut self, slot: u32) {
        let timeline = self.timeline;
        let sphere = timeline.flights.index_of[slot as usize];
        let member = self.members[&sphere];
        let mesh = holding_mesh(timeline, self.context, slot, self.time);
        let radius = member.species.radius;
        let around = Around::touching(member.position, radius, self.time);
        for near @ (surface, shift) in self.context.surfaces_near(timeline, slot, around) {
            let whole = self.context.system.surfaces[surface as usize].whole;
            let mesh = mesh.filter(|mesh| mesh.whole == whole);
            let (is_handed_over, is_left) = (mesh.is_some(), mesh.is_some_and(|it| it.is_left));
            let missed = if is_left { MOST_MISSED * member.species.radius } else { 0.0 };
            let distance = touching_distance(self.context, &member, near, missed, self.time);
            // A part that the sphere came behind does not hold it: a one-sided mesh is passed from there.
            if distance.is_some_and(|it| !is_left || it >= -2.0 * missed) {
                let bodies = Bodies::Surface { sphere, surface };
                let found = TouchOrigin { shift: -shift, is_predicted: false, is_handed_over };
                self.touches.entry(bodies).or_insert(found);
            }
        }
    }

    /// A cluster is in a group as a whole.
    fn join_cluster(&mut self, slot: u32) {
        let timeline = self.timeline;
        let Some(number) = timeline.flights.species_of(slot).cluster else { return };
        self.join_members(timeline.flights.clusters.get(number));
    }

    fn join_members(&mut self, cluster: &Cluster) {
        cluster.members.iter().for_each(|&member| self.join(member));
        cluster.contacts.iter().for_each(|&bodies| self.connect_bodies(bodies));
    }

    /// Notes that two bodies touch, whatever the gap between them.
    fn connect_bodies(&mut self, bodies: Bodies) {
        let slot_of = |index: u32| self.timeline.flights.slot_of[index as usize];
        match bodies {
            Bodies::Pair(first, second) => self.connect_nearest(slot_of(first), slot_of(second)),
            Bodies::Surface { sphere, surface } => {
                let slot = slot_of(sphere);
                // Else it goes on over another part of a mesh.
                if has_at(self.timeline, self.context, slot, surface, self.time) {
                    self.connect_surface(slot, surface, [false; 2]);
                }
            }
        }
    }

    /// Notes that a sphere meets a surface as predicted. A part of the mesh that the sphere lies on does not count
    /// before the sphere reaches it.
    fn connect_predicted(&mut self, slot: u32, surface: u32) {
        let mesh = holding_mesh(self.timeline, self.context, slot, self.time);
        let whole = self.context.system.surfaces[surface as usize].whole;
        let is_held = mesh.is_some_and(|mesh| mesh.whole == whole);
        if !is_held || has_at(self.timeline, self.context, slot, surface, self.time) {
            self.connect_surface(slot, surface, [true, is_held]);
        }
    }

    fn finish(self) -> Group {
        let Self { context, time, .. } = self;
        let places: BTreeMap<u32, usize> =
            self.members.keys().enumerate().map(|(place, &index)| (index, place)).collect();
        let members: Vec<Member> = self.members.into_values().collect();
        let measured = self.touches.into_iter().filter_map(|(bodies, found)| {
            let (first, second) = match bodies {
                Bodies::Pair(first, second) => (Some(places[&first]), places[&second]),
                Bodies::Surface { sphere, .. } => (None, places[&sphere]),
            };
            let has_persisted = self.timeline.flights.are_held_together(bodies);
            let touch = Touch { has_persisted, ..Touch::between(bodies, first, second, found) };
            let touch = touch.measured_at(context, &members, time)?;
            Some(if found.is_handed_over { touch.handed_over(&members) } else { touch })
        });
        let flights = &self.timeline.flights;
        let sides_of = |touch: Touch| {
            let cluster = flights.species_of(members[touch.second].slot).cluster;
            let cluster = cluster.map(|number| flights.clusters.get(number));
            let known = cluster.into_iter().flat_map(|it| it.sides_of(touch.bodies)).collect();
            with_sides(context, &members, touch, known, time)
        };
        let mut touches: Vec<Touch> = measured.flat_map(sides_of).collect();
        leave_out_doubles(context, &members, &mut touches);
        leave_out_seams(context, &members, &mut touches);
        let fastest = members.iter().map(|member| member.velocity.norm()).fold(0.0, f64::max);
        Group { time, members, touches, fastest }
    }
}

/// Removes all but one of the flush faces that a sphere touches. The face under its centre stays. Of several that lie
/// upon each other in the same place, the one it has been on stays, or the first.
fn leave_out_doubles(context: &StepContext, members: &[Member], touches: &mut Vec<Touch>) {
    let surface = |touch: &Touch| match touch.bodies {
        Bodies::Surface { surface, .. } => Some(&context.system.surfaces[surface as usize]),
        Bodies::Pair(..) => None,
    };
    let are_flush = |one: &Touch, other: &Touch| {
        let whole = |touch: &Touch| surface(touch).map(|it| it.whole);
        one.second == other.second
            && whole(one) == whole(other)
            && !one.is_curved()
            && !other.is_curved()
            && (one.normal - other.normal).norm() <= FLUSH
    };
    let is_under = |touch: &Touch| {
        let Member { position, velocity, .. } = members[touch.second];
        let state = [position + touch.shift, velocity - touch.form_velocity()];
        surface(touch).is_some_and(|it| has(&it.form, state))
    };
    let are_one = |one: &Touch, other: &Touch| {
        let Member { position, species, .. } = &members[one.second];
        let coordinates = position.norm() + species.radius + one.point.norm();
        (one.normal - other.normal).norm() <= PARALLEL
            && (one.gap - other.gap).abs() <= 2.0 * TOUCHING * coordinates
    };
    let rank = |touch: &Touch| (!is_under(touch), !touch.has_persisted, touch.bodies);
    let mut left: Vec<Touch> = Vec::with_capacity(touches.len());
    for touch in touches.iter() {
        let of_sphere = left.iter_mut().rev().take_while(|it| it.second == touch.second);
        let is_surface = surface(touch).is_some();
        let is_double = |it: &Touch| {
            let are_both_under = || is_under(it) && is_under(touch);
            are_flush(it, touch) && (!are_both_under() || are_one(it, touch))
        };
        match of_sphere.into_iter().find(|it| is_surface && is_double(it)) {
            Some(other) if rank(touch) < rank(other) => *other = *touch,
            Some(_) => {}
            None => left.push(*touch),
        }
    }
    *touches = left;
}

/// Removes edges that spheres touch together with a plane, up to rounding: two coplanar faces meet there.
fn leave_out_seams(context: &StepContext, members: &[Member], touches: &mut Vec<Touch>) {
    let is_at_rest = |touch: &Touch| touch.first.is_none() && !touch.does_work();
    if !touches.iter().any(|touch| is_at_rest(touch) && touch.is_curved()) {
        return;
    }
    let planes: Vec<Touch> =
        touches.iter().filter(|touch| is_at_rest(touch) && !touch.is_curved()).copied().collect();
    let is_seam = |touch: &Touch| {
        let Member { position, species, .. } = &members[touch.second];
        let is_same = |plane: &Touch| {
            let forms = [plane.bodies, touch.bodies].map(|bodies| coordinates_of(context, bodies));
            let coordinates = position.norm() + species.radius + forms[0] + forms[1];
            let apart = (plane.point - touch.point).norm();
            plane.second == touch.second && apart <= 4.0 * TOUCHING * coordinates
        };
        touch.is_curved() && is_at_rest(touch) && planes.iter().any(is_same)
    };
    touches.retain(|touch| !is_seam(touch));
}

/// Size of the coordinates of the surface among two bodies \[m\].
fn coordinates_of(context: &StepContext, bodies: Bodies) -> f64 {
    match bodies {
        Bodies::Surface { surface, .. } => {
            context.system.surfaces[surface as usize].form.coordinates()
        }
        Bodies::Pair(..) => 0.0,
    }
}
