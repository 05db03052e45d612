//! Who touches whom at one instant.

use std::collections::BTreeMap;

use glam::DVec3;

use super::cluster::Cluster;
use super::group::{Group, Member};
use super::periodic;
use super::stage::Stage;
use super::timeline::Timeline;
use super::vicinity::Vicinity;
use crate::detect::contact::Bodies;
use crate::detect::{Separation, sphere_rectangle_known_in_front, sphere_sphere, sphere_surface};
use crate::norm::Norm;
use crate::respond::TouchingContact;
use crate::surface::{Form, Rectangle, Surface, SurfaceMotion};

/// Bodies touch when the gap between them is below this many roundings of their coordinates: what
/// the time of an impact and the way to it leave uncertain.
pub(super) const TOUCHING: f64 = 256.0 * f64::EPSILON;
/// Relative rounding of a time at which two bodies may be said to meet: that of the clock, and of the
/// sums that lead to it.
pub(super) const CLOCK_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Two bodies that touch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    pub bodies: Bodies,
    /// Places of the spheres among the members; the first body may be a surface.
    pub first: Option<usize>,
    pub second: usize,
    /// Unit normal from body 1 to body 2.
    pub normal: DVec3,
    /// Where on body 1 \[m\].
    pub point: DVec3,
    /// Between the two surfaces \[m\]: nearly 0.
    pub gap: f64,
    /// How the normal turns when the spheres slide.
    pub bend: Bend,
    /// Of the surface, were it to reach as far as the centre of body 2 \[m/s\]: along the normal it is
    /// the same where they touch. 0 where body 1 is a sphere.
    pub surface_velocity: DVec3,
    /// Of the surface \[rad/s\].
    pub surface_spin: DVec3,
    /// Acceleration of the gap from the turning of the surface, without sliding, is its part along
    /// the normal \[m/s²\].
    pub surface_pull: DVec3,
    /// From where the position of body 2 counts to where that of body 1 does \[m\].
    pub shift: DVec3,
    /// Predicted, so not in doubt.
    pub is_given: bool,
    /// The contact has lasted up to now.
    pub has_lasted: bool,
}

/// How the normal of a contact turns when the bodies slide along each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Bend {
    /// Not at all: a plane.
    Flat,
    /// About a point, this far from the centre of body 2 \[m\].
    Round(f64),
    /// About an edge in this direction, this far from the centre of body 2 \[m\].
    Edge(DVec3, f64),
}

impl Bend {
    /// Velocity along which the normal turns, and the distance about which it does.
    pub fn turning(&self, tangential: DVec3) -> Option<(DVec3, f64)> {
        match *self {
            Self::Flat => None,
            Self::Round(distance) => Some((tangential, distance)),
            Self::Edge(direction, distance) => {
                Some((tangential - tangential.dot(direction) * direction, distance))
            }
        }
    }
}

impl Touch {
    /// Places of its spheres among the members.
    pub fn places(&self) -> impl Iterator<Item = usize> + use<> {
        self.first.into_iter().chain([self.second])
    }

    /// The part of a vector across the normal.
    pub fn across(&self, vector: DVec3) -> DVec3 {
        vector - vector.dot(self.normal) * self.normal
    }

    /// Velocity of body 2 relative to body 1 \[m/s\].
    pub fn relative_velocity(&self, members: &[Member]) -> DVec3 {
        let first = self.first.map_or(self.surface_velocity, |first| members[first].velocity);
        members[self.second].velocity - first
    }

    /// Its part along the normal: negative where the bodies close.
    pub fn normal_velocity(&self, members: &[Member]) -> f64 {
        self.relative_velocity(members).dot(self.normal)
    }

    /// Velocity of sliding along which its normal turns \[m/s\]: zero on a plane.
    pub fn sliding(&self, members: &[Member]) -> DVec3 {
        let tangential = self.across(self.relative_velocity(members));
        self.bend.turning(tangential).map_or(DVec3::ZERO, |(velocity, _)| velocity)
    }

    /// Whether its normal turns, because bodies slide along each other or the surface turns.
    pub fn bends(&self) -> bool {
        self.bend != Bend::Flat || self.surface_spin != DVec3::ZERO
    }

    /// Whether the surface moves, and so does work on the sphere.
    pub fn does_work(&self) -> bool {
        self.surface_velocity != DVec3::ZERO || self.surface_spin != DVec3::ZERO
    }

    /// As the impact laws take it, restitution 0.
    pub fn contact(&self) -> TouchingContact {
        TouchingContact {
            first: self.first,
            second: self.second,
            normal: self.normal,
            surface_velocity: self.surface_velocity,
            restitution: 0.0,
        }
    }

    /// The same two bodies in other places; `None` where they no longer face each other.
    pub fn measured_at(&self, stage: &Stage, members: &[Member], time: f64) -> Option<Self> {
        let second = &members[self.second];
        match self.bodies {
            Bodies::Pair(..) => {
                let first = &members[self.first?];
                let centers = [first.position, second.position + self.shift];
                let separation = sphere_sphere(centers, [first.kind.radius, second.kind.radius]);
                let distance = (centers[1] - centers[0]).norm();
                Some(Self { bend: Bend::Round(distance), ..self.with(separation) })
            }
            Bodies::Surface { surface, .. } => {
                let (form, motion) = stage.surface_at(surface, time);
                let center = second.position + self.shift;
                let separation = separation(&form, center, second.kind.radius, self.is_given)?;
                let bend = bend_of(&form, center, &separation);
                Some(Self { bend, ..self.with(separation).with_motion(&motion, center) })
            }
        }
    }

    fn with(self, separation: Separation) -> Self {
        let Separation { distance, normal, point } = separation;
        Self { gap: distance, normal, point, ..self }
    }

    /// Seen from a frame that moves and turns with the surface, at the centre of the sphere.
    fn with_motion(self, motion: &SurfaceMotion, center: DVec3) -> Self {
        let surface_velocity = motion.velocity_at(center);
        let spin = motion.angular_velocity;
        // What turns with the surface is drawn towards the axis.
        let surface_pull = -spin.cross(spin.cross(center - motion.origin));
        Self { surface_velocity, surface_spin: spin, surface_pull, ..self }
    }

    /// The bodies, not yet measured.
    fn between(
        bodies: Bodies,
        first: Option<usize>,
        second: usize,
        Found { shift, is_given }: Found,
    ) -> Self {
        Self {
            is_given,
            has_lasted: false,
            bodies,
            first,
            second,
            shift,
            normal: DVec3::ZERO,
            point: DVec3::ZERO,
            gap: 0.0,
            bend: Bend::Flat,
            surface_velocity: DVec3::ZERO,
            surface_spin: DVec3::ZERO,
            surface_pull: DVec3::ZERO,
        }
    }
}

/// How a sphere stands to a surface; to be in front may be given, whatever rounding says.
pub(super) fn separation(
    form: &Form,
    center: DVec3,
    radius: f64,
    is_given: bool,
) -> Option<Separation> {
    match form {
        Form::Rectangle(rectangle) if is_given => {
            Some(sphere_rectangle_known_in_front(rectangle, center, radius))
        }
        form => sphere_surface(form, center, radius),
    }
}

/// How the normal turns where a sphere about `center` \[m\] touches a surface.
fn bend_of(form: &Form, center: DVec3, separation: &Separation) -> Bend {
    let distance = (center - separation.point).norm();
    match form {
        Form::Sphere { center: fixed, .. } => Bend::Round((center - *fixed).norm()),
        Form::HalfSpace { .. } | Form::Box(_) => Bend::Flat,
        Form::Rectangle(rectangle) => {
            let [beyond_x, beyond_z] = beyond(rectangle, center);
            match (beyond_x >= 0.0, beyond_z >= 0.0) {
                (false, false) => Bend::Flat,
                (true, false) => Bend::Edge(rectangle.axis_z, distance),
                (false, true) => Bend::Edge(rectangle.axis_x, distance),
                (true, true) => Bend::Round(distance),
            }
        }
    }
}

/// How far a point is beyond the edges of a rectangle along its axes \[m\]; negative inside. At the
/// very edge it counts as beyond, so that what slides over it goes on.
pub(super) fn beyond(rectangle: &Rectangle, point: DVec3) -> [f64; 2] {
    let offset = point - rectangle.center;
    let slack = TOUCHING * (offset.norm() + rectangle.half_x + rectangle.half_z);
    [(rectangle.axis_x, rectangle.half_x), (rectangle.axis_z, rectangle.half_z)]
        .map(|(axis, half)| offset.dot(axis).abs() - half + slack)
}

/// Gap \[m\] up to which two bodies touch: rounding of their coordinates \[m\], and how far they move,
/// at a `speed` \[m/s\] to each other, in the rounding of the clock.
fn touching_gap(coordinates: f64, speed: f64, time: f64) -> f64 {
    TOUCHING * coordinates + CLOCK_ROUNDING * time.abs() * speed
}

/// Whether a sphere, by its centre \[m\], velocity \[m/s\] and radius \[m\], touches a surface or its
/// image, where a shift \[m\] brings it, at `time` \[s\].
pub(super) fn touches_surface(
    stage: &Stage,
    ((center, velocity), radius): ((DVec3, DVec3), f64),
    (surface, shift): (u32, DVec3),
    time: f64,
) -> bool {
    let Surface { form, motion, .. } = &stage.system.surfaces[surface as usize];
    if motion.is_at_rest() {
        // Where they touch, the point of the surface is no farther from the origin than that.
        let coordinates = 2.0 * (center.norm() + shift.norm() + radius);
        let gap = 2.0 * touching_gap(coordinates, velocity.norm(), time);
        if is_above(form, center - shift, radius + gap) {
            return false;
        }
    }
    let (form, motion) = stage.surface_at(surface, time);
    let Some(separation) = sphere_surface(&form, center - shift, radius) else { return false };
    let speed = (velocity - motion.velocity_at(separation.point)).norm();
    let coordinates = center.norm() + separation.point.norm() + radius;
    separation.distance <= touching_gap(coordinates, speed, time)
}

/// Whether a point is higher than that above the plane of a surface, or far behind it \[m\].
fn is_above(form: &Form, point: DVec3, height: f64) -> bool {
    match form {
        Form::HalfSpace { point: origin, normal } => (point - *origin).dot(*normal) > height,
        Form::Rectangle(face) => (point - face.center).dot(face.normal).abs() > height,
        Form::Sphere { .. } | Form::Box(_) => false,
    }
}

/// Gathers the spheres at `seeds`, whatever touches them at `time` \[s\], what touches that, and so
/// on, clusters as a whole. `merged` contacts count as touching, too.
pub(super) fn gather(
    timeline: &Timeline,
    stage: &Stage,
    seeds: &[u32],
    surface: Option<u32>,
    merged: &[Bodies],
    time: f64,
) -> Group {
    let mut gathering = Gathering { timeline, stage, time, ..Gathering::empty(timeline, stage) };
    seeds.iter().for_each(|&seed| gathering.join(seed));
    if let [first, second] = *seeds {
        gathering.connect_nearest(first, second);
    }
    if let (Some(surface), [slot]) = (surface, seeds) {
        gathering.connect_surface(*slot, surface, true);
    }
    for &bodies in merged {
        gathering.connect_bodies(bodies);
        for index in bodies.spheres() {
            gathering.join(timeline.slot_of[index as usize]);
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
pub(super) fn gather_cluster(
    timeline: &Timeline,
    stage: &Stage,
    cluster: &Cluster,
    time: f64,
) -> Group {
    let mut gathering = Gathering { time, ..Gathering::empty(timeline, stage) };
    gathering.join_members(cluster);
    gathering.finish()
}

/// How two bodies were found to touch.
#[derive(Clone, Copy)]
struct Found {
    /// From where the position of body 2 counts to where that of body 1 does \[m\].
    shift: DVec3,
    /// Predicted, so not in doubt.
    is_given: bool,
}

/// A group while it is gathered.
struct Gathering<'a> {
    timeline: &'a Timeline,
    stage: &'a Stage<'a>,
    time: f64,
    /// By index, so in order.
    members: BTreeMap<u32, Member>,
    touches: BTreeMap<Bodies, Found>,
    /// Slots of members whose surroundings were not looked at yet.
    frontier: Vec<u32>,
}

impl<'a> Gathering<'a> {
    fn empty(timeline: &'a Timeline, stage: &'a Stage<'a>) -> Self {
        let (members, touches) = (BTreeMap::new(), BTreeMap::new());
        Self { timeline, stage, time: 0.0, members, touches, frontier: Vec::new() }
    }

    fn join(&mut self, slot: u32) {
        let index = self.timeline.index_of[slot as usize];
        if self.members.contains_key(&index) {
            return;
        }
        let (position, velocity) = self.timeline.state_of(slot, self.time);
        let kind = *self.timeline.free_kind_of(slot);
        self.members.insert(index, Member { slot, position, velocity, kind });
        self.frontier.push(slot);
    }

    /// Whether the box is periodic along an axis.
    fn has_images(&self) -> bool {
        self.stage.period != DVec3::INFINITY
    }

    /// Notes that two spheres touch, with the shift from where the second one counts to where the
    /// first does.
    fn connect(&mut self, slots: [u32; 2], shift: DVec3) {
        let is_given = false;
        let indices = slots.map(|slot| self.timeline.index_of[slot as usize]);
        let shift = if indices[0] < indices[1] { shift } else { -shift };
        self.touches.entry(Bodies::pair(indices)).or_insert(Found { shift, is_given });
    }

    /// Two spheres touch, whatever rounding says: those that were predicted to meet now, or stay in
    /// contact. In a periodic box, the nearest images do.
    fn connect_nearest(&mut self, first: u32, second: u32) {
        let shift = if self.has_images() {
            let place = |slot| self.timeline.state_of(slot, self.time).0;
            let offset = place(second) - place(first);
            periodic::folded(offset, self.stage.period) - offset
        } else {
            DVec3::ZERO
        };
        self.connect([first, second], shift);
    }

    /// Notes that a sphere and a surface touch, whatever rounding says: in a periodic box, the nearest
    /// image of the surface.
    fn connect_surface(&mut self, slot: u32, surface: u32, is_given: bool) {
        let sphere = self.timeline.index_of[slot as usize];
        let bodies = Bodies::Surface { sphere, surface };
        if !self.has_images() {
            self.touches.entry(bodies).or_insert(Found { shift: DVec3::ZERO, is_given });
            return;
        }
        let place = self.timeline.state_of(slot, self.time).0;
        let distance = |shift: DVec3| {
            let (form, _) = self.stage.surface_at(surface, self.time);
            let separation = sphere_surface(&form, place - shift, 0.0);
            separation.map_or(f64::INFINITY, |separation| separation.distance)
        };
        let images = self.timeline.surfaces_near(slot).filter(|near| near.0 == surface);
        let nearest = images.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
        if let Some((_, shift)) = nearest {
            self.touches.entry(bodies).or_insert(Found { shift: -shift, is_given });
        }
    }

    fn touch_spheres(&mut self, slot: u32) {
        if !self.stage.system.settings.spheres_collide {
            return;
        }
        let timeline = self.timeline;
        let kind = *timeline.kind_of(slot);
        let (place, velocity) = timeline.state_of(slot, self.time);
        let mut found = Vec::new();
        let mut around = Vicinity::default();
        timeline.neighbours.find(slot, kind.level, &mut around);
        for neighbour in around.others(slot) {
            let (near, shift) = (neighbour.slot(), timeline.neighbours.shift_of(slot, neighbour));
            let (near_place, near_velocity) = timeline.state_of(near, self.time);
            let radius_sum = kind.radius + timeline.kind_of(near).radius;
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
        let sphere = timeline.index_of[slot as usize];
        let state = timeline.state_of(slot, self.time);
        let radius = timeline.kind_of(slot).radius;
        for (surface, shift) in timeline.surfaces_near(slot) {
            if touches_surface(self.stage, (state, radius), (surface, shift), self.time) {
                let bodies = Bodies::Surface { sphere, surface };
                let found = Found { shift: -shift, is_given: false };
                self.touches.entry(bodies).or_insert(found);
            }
        }
    }

    /// A cluster is in a group as a whole.
    fn join_cluster(&mut self, slot: u32) {
        let timeline = self.timeline;
        let Some(number) = timeline.kind_of(slot).cluster else { return };
        self.join_members(timeline.clusters.get(number));
    }

    fn join_members(&mut self, cluster: &Cluster) {
        cluster.members.iter().for_each(|&member| self.join(member));
        cluster.contacts.iter().for_each(|&bodies| self.connect_bodies(bodies));
    }

    /// Notes that two bodies touch, whatever the gap between them.
    fn connect_bodies(&mut self, bodies: Bodies) {
        let slot_of = |index: u32| self.timeline.slot_of[index as usize];
        match bodies {
            Bodies::Pair(first, second) => self.connect_nearest(slot_of(first), slot_of(second)),
            Bodies::Surface { sphere, surface } => {
                self.connect_surface(slot_of(sphere), surface, false);
            }
        }
    }

    fn finish(self) -> Group {
        let Self { stage, time, .. } = self;
        let places: BTreeMap<u32, usize> =
            self.members.keys().enumerate().map(|(place, &index)| (index, place)).collect();
        let members: Vec<Member> = self.members.into_values().collect();
        let touches = self.touches.into_iter().filter_map(|(bodies, found)| {
            let (first, second) = match bodies {
                Bodies::Pair(first, second) => (Some(places[&first]), places[&second]),
                Bodies::Surface { sphere, .. } => (None, places[&sphere]),
            };
            let has_lasted = self.timeline.has_lasted(bodies);
            let touch = Touch { has_lasted, ..Touch::between(bodies, first, second, found) };
            touch.measured_at(stage, &members, time)
        });
        let touches = touches.collect();
        let fastest = members.iter().map(|member| member.velocity.norm()).fold(0.0, f64::max);
        Group { time, members, touches, fastest }
    }
}
