//! Finding contacts among many spheres, at one instant.

use glam::DVec3;

use super::broad_phase::BroadPhase;
use super::surface_tree::Bounds;
use super::{ContactState, Separation, classify, sphere_sphere, sphere_surface};
use crate::bodies::Motion;
use crate::integrate;
use crate::surface::Role;
use crate::system::System;

/// Up to this many spheres the loop over all pairs is faster than arranging them first.
const FEW: usize = 16;

/// All spheres in the states `motion`, at `time` \[s\] of the world's clock.
#[derive(Clone, Copy)]
pub(crate) struct Instant<'a> {
    pub system: System<'a>,
    pub motion: &'a Motion,
    pub time: f64,
}

/// Two bodies, by index. Pairs of spheres sort before spheres at surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Bodies {
    /// Spheres 1 and 2, the smaller index first.
    Pair(u32, u32),
    /// A fixed surface, which is body 1, and a sphere, which is body 2.
    Surface { sphere: u32, surface: u32 },
}

/// Two bodies and how they stand to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Contact {
    pub bodies: Bodies,
    pub separation: Separation,
    pub state: ContactState,
}

impl Contact {
    /// The one or two spheres of the contact.
    pub fn spheres(&self) -> impl Iterator<Item = u32> + use<> {
        let (first, second) = match self.bodies {
            Bodies::Pair(i, j) => (i, Some(j)),
            Bodies::Surface { sphere, .. } => (sphere, None),
        };
        std::iter::once(first).chain(second)
    }
}

impl Instant<'_> {
    /// The contact of spheres `i` and `j`, whichever comes first.
    fn pair(&self, i: u32, j: u32, tolerance: f64) -> Contact {
        let (first, second) = (i.min(j), i.max(j));
        let (i, j) = (first as usize, second as usize);
        let Motion { position, velocity } = self.motion;
        let radii = [self.system.spheres.radius[i], self.system.spheres.radius[j]];
        let separation = sphere_sphere([position[i], position[j]], radii);
        let normal = separation.normal;
        let acceleration = |k| integrate::acceleration(&self.system, self.motion, k, self.time);
        let state = classify(
            separation.distance,
            tolerance,
            (velocity[j] - velocity[i]).dot(normal),
            || (acceleration(j) - acceleration(i)).dot(normal),
        );
        Contact { bodies: Bodies::Pair(first, second), separation, state }
    }

    /// The contact of a sphere with a surface, if it is on the side that collides.
    fn surface(&self, sphere: u32, surface: u32, tolerance: f64) -> Option<Contact> {
        let i = sphere as usize;
        let form = &self.system.surfaces[surface as usize].form;
        let center = self.motion.position[i];
        let separation = sphere_surface(form, center, self.system.spheres.radius[i])?;
        let normal = separation.normal;
        let state =
            classify(separation.distance, tolerance, self.motion.velocity[i].dot(normal), || {
                integrate::acceleration(&self.system, self.motion, i, self.time).dot(normal)
            });
        Some(Contact { bodies: Bodies::Surface { sphere, surface }, separation, state })
    }

    /// The contact of two bodies, if they are on the sides that collide.
    pub fn contact(&self, bodies: Bodies, tolerance: f64) -> Option<Contact> {
        match bodies {
            Bodies::Pair(i, j) => Some(self.pair(i, j, tolerance)),
            Bodies::Surface { sphere, surface } => self.surface(sphere, surface, tolerance),
        }
    }

    /// Visits every surface, of roles for which `wanted` holds, near a sphere with its contact.
    fn for_each_surface(
        &self,
        sphere: u32,
        tolerance: f64,
        near: &mut Vec<u32>,
        wanted: impl Fn(Role) -> bool,
        mut visit: impl FnMut(Contact),
    ) {
        let i = sphere as usize;
        self.system.tree.near(&reach(&self.system, self.motion, i, tolerance), near);
        for &surface in near.iter() {
            if wanted(self.system.surfaces[surface as usize].role)
                && let Some(contact) = self.surface(sphere, surface, tolerance)
            {
                visit(contact);
            }
        }
    }
}

/// Bounds of a sphere, widened by `margin` \[m\].
pub(crate) fn reach(system: &System, motion: &Motion, index: usize, margin: f64) -> Bounds {
    let half = DVec3::splat(system.spheres.radius[index] + margin);
    Bounds::around(motion.position[index], half)
}

/// Working memory of the searches below; holds nothing between them but the arrangement that
/// [`of_everyone`] makes and [`of_moved`] looks into.
#[derive(Debug, Clone, Default)]
pub(crate) struct Search {
    everyone: BroadPhase,
    some: BroadPhase,
    near: Vec<u32>,
}

/// Contacts that are not `Separate` among all spheres and solid surfaces, sorted by bodies.
pub(crate) fn of_everyone(
    instant: &Instant,
    tolerance: f64,
    search: &mut Search,
    contacts: &mut Vec<Contact>,
) {
    contacts.clear();
    let count = instant.system.spheres.id.len() as u32;
    if instant.system.settings.spheres_collide {
        search.everyone.rebuild((0..count).map(|i| at(instant, i)), tolerance);
        search.everyone.for_each_pair(|i, j| keep(instant.pair(i, j, tolerance), contacts));
    }
    of_surfaces(instant, 0..count, tolerance, &mut search.near, contacts);
    contacts.sort_unstable_by_key(|contact| contact.bodies);
}

/// Pairs of spheres that overlap by more than `tolerance`, however they move, sorted by bodies.
pub(crate) fn of_overlapping_pairs(
    instant: &Instant,
    tolerance: f64,
    search: &mut Search,
    contacts: &mut Vec<Contact>,
) {
    contacts.clear();
    if !instant.system.settings.spheres_collide {
        return;
    }
    let mut keep = |i, j| {
        let contact = instant.pair(i, j, 0.0);
        if contact.separation.distance < -tolerance {
            contacts.push(contact);
        }
    };
    let everyone = 0..instant.system.spheres.id.len() as u32;
    if everyone.len() <= FEW {
        for_each_pair(everyone, &mut keep);
    } else {
        search.some.rebuild(everyone.map(|i| at(instant, i)), 0.0);
        search.some.for_each_pair(&mut keep);
    }
    contacts.sort_unstable_by_key(|contact| contact.bodies);
}

/// Visits pairs of spheres, then spheres and solid surfaces, that overlap by more than
/// `tolerance`, however they move.
pub(crate) fn of_overlaps(
    instant: &Instant,
    tolerance: f64,
    search: &mut Search,
    mut visit: impl FnMut(&Contact),
) {
    let mut pairs = Vec::new();
    of_overlapping_pairs(instant, tolerance, search, &mut pairs);
    pairs.iter().for_each(&mut visit);
    for sphere in 0..instant.system.spheres.id.len() as u32 {
        instant.for_each_surface(
            sphere,
            0.0,
            &mut search.near,
            |role| role != Role::Reports,
            |contact| {
                if contact.separation.distance < -tolerance {
                    visit(&contact);
                }
            },
        );
    }
}

/// Contacts that are not `Separate` among some spheres, and of those with solid surfaces.
pub(crate) fn of_some(
    instant: &Instant,
    members: &[u32],
    tolerance: f64,
    search: &mut Search,
    contacts: &mut Vec<Contact>,
) {
    contacts.clear();
    if instant.system.settings.spheres_collide {
        if members.len() <= FEW {
            for_each_pair(members.iter().copied(), |i, j| {
                keep(instant.pair(i, j, tolerance), contacts);
            });
        } else {
            search.some.rebuild(members.iter().map(|&i| at(instant, i)), tolerance);
            search.some.for_each_pair(|i, j| keep(instant.pair(i, j, tolerance), contacts));
        }
    }
    of_surfaces(instant, members.iter().copied(), tolerance, &mut search.near, contacts);
    contacts.sort_unstable_by_key(|contact| contact.bodies);
}

fn for_each_pair(spheres: impl Iterator<Item = u32> + Clone, mut visit: impl FnMut(u32, u32)) {
    let mut rest = spheres;
    while let Some(i) = rest.next() {
        rest.clone().for_each(|j| visit(i, j));
    }
}

/// Spheres that are elsewhere than [`of_everyone`] last saw them.
pub(crate) struct Moved<'a> {
    pub list: &'a [u32],
    pub contains: &'a dyn Fn(u32) -> bool,
}

/// Contacts that are not `Separate` of moved spheres with anyone and with solid surfaces.
pub(crate) fn of_moved(
    instant: &Instant,
    moved: &Moved,
    tolerance: f64,
    search: &mut Search,
    contacts: &mut Vec<Contact>,
) {
    of_some(instant, moved.list, tolerance, search, contacts);
    if instant.system.settings.spheres_collide {
        let Search { everyone, some, .. } = search;
        some.rebuild(moved.list.iter().map(|&i| at(instant, i)), tolerance);
        everyone.for_each_pair_with(some, |i, j| {
            if !(moved.contains)(i) {
                keep(instant.pair(i, j, tolerance), contacts);
            }
        });
        contacts.sort_unstable_by_key(|contact| contact.bodies);
    }
}

/// Whether a sphere at `center` with `radius` \[m\] touches or overlaps a solid surface.
pub(crate) fn meets_surface(system: &System, center: DVec3, radius: f64) -> bool {
    let mut near = Vec::new();
    system.tree.near(&Bounds::around(center, DVec3::splat(radius)), &mut near);
    near.iter().map(|&index| &system.surfaces[index as usize]).any(|surface| {
        let separation = sphere_surface(&surface.form, center, radius);
        surface.role != Role::Reports
            && separation.is_some_and(|separation| separation.distance <= 0.0)
    })
}

/// Contacts of all spheres with triggers: at most `tolerance` \[m\] apart, whichever way they move.
pub(crate) fn of_triggers(
    instant: &Instant,
    tolerance: f64,
    search: &mut Search,
    mut visit: impl FnMut(Contact),
) {
    if !instant.system.surfaces.iter().any(|surface| surface.role == Role::Reports) {
        return;
    }
    for sphere in 0..instant.system.spheres.id.len() as u32 {
        instant.for_each_surface(
            sphere,
            tolerance,
            &mut search.near,
            |role| role == Role::Reports,
            |contact| {
                if contact.separation.distance <= tolerance {
                    visit(contact);
                }
            },
        );
    }
}

fn of_surfaces(
    instant: &Instant,
    members: impl Iterator<Item = u32>,
    tolerance: f64,
    near: &mut Vec<u32>,
    contacts: &mut Vec<Contact>,
) {
    if instant.system.surfaces.is_empty() {
        return;
    }
    for sphere in members {
        instant.for_each_surface(
            sphere,
            tolerance,
            near,
            |role| role == Role::Deflects,
            |contact| {
                keep(contact, contacts);
            },
        );
    }
}

fn at(instant: &Instant, i: u32) -> (u32, DVec3, f64) {
    (i, instant.motion.position[i as usize], instant.system.spheres.radius[i as usize])
}

fn keep(contact: Contact, contacts: &mut Vec<Contact>) {
    if contact.state != ContactState::Separate {
        contacts.push(contact);
    }
}
