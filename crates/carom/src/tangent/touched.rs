//! The surface that a sphere meets in an impact.

use glam::DVec3;

use super::saltation::{Colliding, TouchedSurface};
use crate::colliders::Colliders;
use crate::detect::sphere_surface;
use crate::id::ColliderId;
use crate::report::Impact;
use crate::rule::exact::curvature_of;
use crate::surface::Role;

/// Largest difference between two unit normals of one contact that were computed in two ways.
const SAME_NORMAL: f64 = 1e-6;

/// Returns the surface of a collider that a sphere touches in an impact.
pub(super) fn touched(
    colliders: &Colliders,
    (collider, impact): (ColliderId, &Impact),
    sphere: &Colliding,
) -> Option<(u32, TouchedSurface)> {
    let deflecting = colliders.surfaces().iter().enumerate();
    let candidates = deflecting
        .filter(|(_, it)| it.collider == collider && it.role == Role::Deflects)
        .filter_map(|(number, surface)| {
            let (form, motion) = surface.after(impact.time);
            let separation = sphere_surface(&form, sphere.position, sphere.radius)?;
            let off = (separation.normal - impact.normal).length();
            Some((off, number, form, motion, separation))
        });
    let nearest = candidates
        .filter(|it| it.0 <= SAME_NORMAL && it.4.distance.abs() <= SAME_NORMAL * sphere.radius)
        .min_by(|a, b| a.0.total_cmp(&b.0));
    let (_, number, form, motion, separation) = nearest?;
    let beside = sphere.velocity - motion.velocity_at(separation.point);
    let curvature = curvature_of(&form, [sphere.position, beside], &separation);
    let [acceleration, angular_acceleration] = motion
        .drive
        .map_or([DVec3::ZERO; 2], |drive| [drive.acceleration, drive.angular_acceleration]);
    let is_still = motion.is_at_rest() && motion.belt == DVec3::ZERO;
    let pose = colliders.list().get(collider.0).filter(|_| is_still).map(|it| it.pose.position);
    let touched = TouchedSurface {
        collider,
        origin: motion.origin,
        velocity: motion.velocity,
        angular_velocity: motion.angular_velocity,
        acceleration,
        angular_acceleration,
        belt: motion.belt,
        pivot: pose,
        curvature,
    };
    Some((number as u32, touched))
}
