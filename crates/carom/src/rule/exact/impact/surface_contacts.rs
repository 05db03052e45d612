//! Surface contacts of a single sphere: what it touches, if only surfaces at rest at right angles to each other.
//! Then each acts as if there were no other.

use glam::DVec3;

use super::kick::kick_of;
use super::pair::NEARBY;
use crate::detect::Separation;
use crate::detect::contact::Bodies;
use crate::norm::Norm;
use crate::respond;
use crate::restitution::Coefficient;
use crate::rule::exact::contacts::contact_scale::ContactScale;
use crate::rule::exact::contacts::{
    Corner, HoldingMesh, MOST_PLANES, Member, Plane, holding_mesh, touches_surface,
};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::features;
use crate::rule::exact::pair_times::Neighbourhood;
use crate::rule::exact::persistent::{free_acceleration, is_back_within};
use crate::rule::exact::predict::moving::Around;
use crate::rule::exact::timeline::Timeline;
use crate::surface::Form;

/// Normals are at right angles if their product is smaller, and the same if they differ by less: far
/// more than the rounding of coordinates of some hundred radii.
const SAME_NORMAL: f64 = 1e-12;
/// Planes and something round, at most.
pub(super) const MOST_TOUCHED: usize = MOST_PLANES + 1;

/// A sphere at the instant of an impact, with what it touches.
pub(super) struct SingleSphere<'a> {
    pub member: Member,
    pub touched: SurfaceContacts<'a>,
}

/// What a sphere touches.
#[derive(Default)]
pub(super) struct SurfaceContacts<'a> {
    pub corner: Corner<'a>,
    round: Option<RoundFeature>,
}

/// An edge or a fixed sphere, off which a sphere bounces.
#[derive(Debug, Clone, Copy)]
struct RoundFeature {
    /// Two if they are faces that share the edge, else one twice.
    surfaces: [u32; 2],
    normal: DVec3,
    /// \[m\]
    point: DVec3,
}

/// Where a sphere touches a surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact {
    pub surface: u32,
    /// Unit normal from the surface to the sphere.
    pub normal: DVec3,
    /// \[m\]
    pub point: DVec3,
}

impl<'a> SurfaceContacts<'a> {
    /// Adds a surface that a sphere touches; `None` if it moves or depends on another one.
    fn add(&mut self, context: &StepContext<'a>, member: &Member, surface: u32) -> Option<()> {
        let surfaces = context.system.surfaces;
        if let Some(plane) = Plane::under(member.state(), surface, surfaces) {
            return self.corner.add(plane);
        }
        let it = &surfaces[surface as usize];
        let is_on_ring = || {
            let moves_to_side = |direction: DVec3| {
                features::side_of_ring(&it.form, [member.position, direction]).is_some()
            };
            moves_to_side(member.velocity) || moves_to_side(member.species.acceleration)
        };
        if matches!(it.form, Form::Facet(_)) || is_on_ring() {
            return None;
        }
        let separation =
            features::separation(&it.form, member.position, member.species.radius, true)?;
        let Separation { normal, point, .. } = separation;
        let surfaces = match self.round {
            _ if !it.motion.is_at_rest() => return None,
            None => [surface; 2],
            Some(RoundFeature { surfaces: [other, twin], normal: known, .. }) => {
                let is_same_solid = surfaces[other as usize].collider == it.collider;
                let is_shared = is_same_solid && (known - normal).norm() <= SAME_NORMAL;
                (is_shared && other == twin).then_some([other.min(surface), other.max(surface)])?
            }
        };
        self.round = Some(RoundFeature { surfaces, normal, point });
        Some(())
    }

    /// Whether one of the contacts is on a curve.
    pub fn is_curved(&self) -> bool {
        self.round.is_some()
    }

    /// The contacts of a sphere about `center` \[m\], ascending by surface.
    pub fn contacts(&self, center: DVec3) -> [Option<Contact>; MOST_TOUCHED] {
        let planes = self.corner.planes().map(|plane| {
            let Plane { surface, normal, .. } = plane;
            Contact { surface, normal, point: plane.foot_of(center) }
        });
        let round = self.round.iter().map(|&RoundFeature { surfaces, normal, point }| {
            let [surface, _] = surfaces;
            Contact { surface, normal, point }
        });
        let mut contacts = [None; MOST_TOUCHED];
        for (place, contact) in contacts.iter_mut().zip(planes.chain(round)) {
            *place = Some(contact);
        }
        contacts.sort_unstable_by_key(|contact| contact.map_or(u32::MAX, |it| it.surface));
        contacts
    }

    /// Whether a surface is among those `struck`, or shares an edge with one of them.
    pub fn is_struck(&self, struck: &[Option<u32>], surface: u32) -> bool {
        let edge = self.round.filter(|round| round.surfaces.contains(&surface));
        struck.contains(&Some(edge.map_or(surface, |edge| edge.surfaces[0])))
    }
}

/// The sphere at `slot` at `time` \[s\], if it touches nothing but the `surface` that it meets, its
/// persistent contacts and others, all of them at rest and at right angles to each other, and does not
/// stay at what is round.
pub(super) fn single_sphere<'a>(
    timeline: &Timeline,
    context: &mut StepContext<'a>,
    slot: u32,
    surface: Option<u32>,
    time: f64,
) -> Option<SingleSphere<'a>> {
    let cluster = timeline
        .flights
        .species_of(slot)
        .cluster
        .map(|number| timeline.flights.clusters.get(number));
    let is_held_with_others = cluster.is_some_and(|cluster| cluster.members.len() > 1);
    // In a periodic box the sphere may touch images.
    if is_held_with_others || context.period != DVec3::INFINITY {
        return None;
    }
    let whole = |surface: u32| context.system.surfaces[surface as usize].whole;
    let goes_on = |mesh: HoldingMesh| mesh.is_left || surface.map(whole) == Some(mesh.whole);
    if holding_mesh(timeline, context, slot, time).is_some_and(goes_on) {
        return None;
    }
    let member = Member::at(&timeline.flights, slot, time);
    let mut touched = SurfaceContacts::default();
    let around = Around::touching(member.position, member.species.radius, time);
    for found @ (near, _) in context.surfaces_near(timeline, slot, around) {
        let is_known = surface == Some(near) || timeline.flights.is_held_by(slot, near);
        if is_known || touches_surface(context, &member, found, time) {
            touched.add(context, &member, near)?;
        }
    }
    let is_felt_apart = match &touched.round {
        None => touched.corner.planes().next().is_some(),
        Some(round) => {
            let is_apart = |plane: Plane| plane.normal.dot(round.normal).abs() <= SAME_NORMAL;
            touched.corner.planes().all(is_apart)
                && bounces_off(timeline, context, &member, round, time)
        }
    };
    let search = &mut context.searches[0];
    let neighbourhood = Neighbourhood { position: member.position, time, margin: NEARBY };
    let is_alone = is_felt_apart && !search.is_near_any(timeline, slot, neighbourhood);
    is_alone.then_some(SingleSphere { member, touched })
}

/// Whether a sphere closes on a round feature and leaves it for longer than a contact lasts.
fn bounces_off(
    timeline: &Timeline,
    context: &StepContext,
    member: &Member,
    round: &RoundFeature,
    time: f64,
) -> bool {
    let Member { slot, velocity, species, .. } = *member;
    let approach_speed = -velocity.dot(round.normal);
    let touched = (slot, round.surfaces[0]);
    let restitution = restitution_of(timeline, context, touched, (round.normal, velocity), time);
    let leaves = restitution.value * approach_speed
        + kick_of(context, member, (round.surfaces[0], round.normal));
    let pull = free_acceleration(member).norm() + velocity.length_squared() / species.radius;
    let scale = ContactScale { is_elastic: restitution.is_elastic, ..member.scale(true) };
    let duration = context.duration_of(&scale, time);
    approach_speed > respond::rounding_of(velocity) && !is_back_within(duration, leaves, pull)
}

/// Restitution of an impact of a sphere with a velocity \[m/s\] on a surface at rest with this normal, at `time` \[s\].
pub(super) fn restitution_of(
    timeline: &Timeline,
    context: &StepContext,
    (slot, surface): (u32, u32),
    (normal, velocity): (DVec3, DVec3),
    time: f64,
) -> Coefficient {
    let bodies = Bodies::Surface { sphere: timeline.flights.index_of[slot as usize], surface };
    let approach_speed = -velocity.dot(normal);
    let restitution = respond::restitution_of(bodies, context.system).coefficient(approach_speed);
    context.restitution_at(timeline, [slot], velocity, restitution, time)
}
