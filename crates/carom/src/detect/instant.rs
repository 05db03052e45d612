//! All spheres at one instant, and the contact state of any two bodies.

use glam::DVec3;

use super::contact::{Bodies, Contact};
use super::passage::is_passing;
use super::surface_tree::SurfaceTree;
use super::{Separation, classify, sphere_sphere, sphere_surface};
use crate::bodies::Motion;
use crate::bounds::Bounds;
use crate::collider::Collider;
use crate::integrate;
use crate::surface::Role;
use crate::system::System;

/// All spheres in the states `motion`, at `time` \[s\] of the world's clock.
#[derive(Clone, Copy)]
pub(crate) struct Instant<'a> {
    pub system: System<'a>,
    pub motion: &'a Motion,
    pub time: f64,
}

impl Instant<'_> {
    /// The contact of spheres `i` and `j`, whichever comes first.
    pub fn pair(&self, i: u32, j: u32, tolerance: f64) -> Contact {
        let (first, second) = (i.min(j), i.max(j));
        let (i, j) = (first as usize, second as usize);
        let Motion { position, velocity, .. } = self.motion;
        let radii = self.system.contact_radii([first, second]);
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

    /// Whether the sphere of an overlap came from behind, through a surface that is open from there, if from the front
    /// none sinks in.
    pub fn came_from_behind(&self, bodies: Bodies, separation: &Separation) -> bool {
        let Bodies::Surface { sphere, surface } = bodies else { return false };
        let form = &self.system.surfaces[surface as usize].form;
        is_passing(form, separation, self.system.spheres.radius[sphere as usize])
    }

    /// Whether the sphere of an overlap leaves a mesh that is open from behind.
    pub fn leaves_open_mesh(&self, bodies: Bodies, separation: &Separation) -> bool {
        let Bodies::Surface { sphere, surface } = bodies else { return false };
        let (surface, sphere) = (&self.system.surfaces[surface as usize], sphere as usize);
        let collider = self.system.colliders.list().get(surface.collider.0);
        let velocity = self.motion.velocity[sphere];
        let relative = velocity - surface.motion.velocity_at(separation.point);
        collider.is_some_and(Collider::is_open_mesh) && relative.dot(separation.normal) > 0.0
    }

    /// The contact of two bodies, if they are on the sides that collide.
    pub fn contact(&self, bodies: Bodies, tolerance: f64) -> Option<Contact> {
        match bodies {
            Bodies::Pair(i, j) => Some(self.pair(i, j, tolerance)),
            Bodies::Surface { sphere, surface } => self.surface(sphere, surface, tolerance),
        }
    }

    /// Visits every surface of a tree, of roles for which `wanted` holds, near a sphere with its contact.
    pub fn for_each_surface(
        &self,
        sphere: u32,
        tolerance: f64,
        (tree, near): (&SurfaceTree, &mut Vec<u32>),
        wanted: impl Fn(Role) -> bool,
        mut visit: impl FnMut(Contact),
    ) {
        let i = sphere as usize;
        tree.near(&reach(&self.system, self.motion, i, tolerance), near);
        for &surface in near.iter() {
            if wanted(self.system.surfaces[surface as usize].role)
                && let Some(contact) = self.surface(sphere, surface, tolerance)
                && self.system.meets_surface(sphere, surface)
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
