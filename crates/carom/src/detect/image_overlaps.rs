//! Overlaps across the faces of a periodic box: of spheres with images of others, and of surfaces at rest.

use glam::DVec3;

use super::broad_phase::BroadPhase;
use super::contact::Bodies;
use super::instant::Instant;
use super::{Separation, sphere_surface};
use crate::bounds::Bounds;
use crate::settings::nearest_image;
use crate::shear::Shear;
use crate::surface::{Form, Role, Surface};

/// A sphere, or an image of one.
#[derive(Clone, Copy)]
struct Image {
    sphere: u32,
    center: DVec3,
    /// Whether it is the one in the box about the origin.
    is_own: bool,
}

/// Visits overlaps of more than `tolerance` \[m\] in a periodic box, with their depths; the same bodies perhaps
/// several times. Spheres for which `passes` holds pass a surface from behind.
pub(crate) fn visit(
    instant: &Instant,
    tolerance: f64,
    passes: impl Fn(Bodies, &Separation) -> bool,
    mut visit: impl FnMut(Bodies, f64),
) {
    let faces = Faces::of(instant);
    let centers = || (0..).zip(&instant.motion.position);
    let reach = |sphere: u32| instant.system.reach_of(sphere);
    let largest = centers().map(|(sphere, _)| reach(sphere)).fold(0.0, f64::max);
    let mut images = Vec::new();
    for (sphere, &center) in centers() {
        faces.add_images(sphere, center, reach(sphere) + largest, &mut images);
    }
    if instant.system.settings.spheres_collide {
        let mut broad_phase = BroadPhase::default();
        let all =
            (0..).zip(&images).map(|(place, image)| (place, image.center, reach(image.sphere)));
        broad_phase.rebuild(all, 0.0);
        broad_phase.for_each_pair(|i, j| {
            let [one, other] = [i, j].map(|place| &images[place as usize]);
            let [first, second] = instant.system.contact_radii([one.sphere, other.sphere]);
            let depth = first + second - one.center.distance(other.center);
            let is_seen = one.sphere != other.sphere && (one.is_own || other.is_own);
            let meet = instant.system.spheres_meet(one.sphere, other.sphere);
            if is_seen && meet && depth > tolerance {
                visit(Bodies::pair([one.sphere, other.sphere]), depth);
            }
        });
    }
    of_surfaces((instant, &faces), tolerance, passes, visit);
}

/// Visits surfaces at rest that images of spheres overlap.
fn of_surfaces(
    (instant, faces): (&Instant, &Faces),
    tolerance: f64,
    passes: impl Fn(Bodies, &Separation) -> bool,
    mut visit: impl FnMut(Bodies, f64),
) {
    let has_images =
        |it: &Surface| !matches!(it.form, Form::HalfSpace { .. }) && it.motion.is_at_rest();
    if !instant.system.surfaces.iter().any(has_images) {
        return;
    }
    let (mut images, mut near) = (Vec::new(), Vec::new());
    for (sphere, &radius) in (0..).zip(&instant.system.spheres.radius) {
        images.clear();
        // A surface may be of any size.
        let center = instant.motion.position[sphere as usize];
        faces.add_images(sphere, center, f64::INFINITY, &mut images);
        for Image { center, .. } in &images {
            near.clear();
            instant.system.tree.near(&Bounds::around(*center, DVec3::splat(radius)), &mut near);
            for &index in &near {
                let surface = &instant.system.surfaces[index as usize];
                let separation = sphere_surface(&surface.form, *center, radius);
                let bodies = Bodies::Surface { sphere, surface: index };
                let overlap = separation.filter(|it| !passes(bodies, it));
                let depth = overlap.map_or(0.0, |it| -it.distance);
                let meets =
                    surface.role != Role::Reports && instant.system.meets_surface(sphere, index);
                if has_images(surface) && meets && depth > tolerance {
                    visit(bodies, depth);
                }
            }
        }
    }
}

/// The box that repeats itself, at some time.
struct Faces {
    /// Edges of the box \[m\], infinite along open axes.
    period: DVec3,
    /// How far the box above has slid along x, at most half an edge \[m\].
    slide: f64,
}

impl Faces {
    fn of(instant: &Instant) -> Self {
        let settings = instant.system.settings;
        let period = settings.boundary.period();
        let slide = Shear::of(settings).map_or(0.0, |shear| {
            let rest = shear.slide(instant.time).1;
            rest - (rest / period.x).round() * period.x
        });
        Self { period, slide }
    }

    /// Adds a sphere where it is in the box about the origin, and its images that come within `reach` \[m\] of
    /// that box.
    fn add_images(&self, sphere: u32, center: DVec3, reach: f64, images: &mut Vec<Image>) {
        let Self { period, slide } = *self;
        let is_periodic = period.is_finite_mask();
        let center = nearest_image(center, period);
        let offsets = |axis: usize| if is_periodic.test(axis) { -1..=1 } else { 0..=0 };
        for x in offsets(0) {
            for y in offsets(1) {
                for z in offsets(2) {
                    let boxes = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
                    let mut shift = DVec3::select(is_periodic, boxes * period, DVec3::ZERO);
                    shift.x += boxes.y * slide;
                    let (place, is_own) = (center + shift, boxes == DVec3::ZERO);
                    if is_own || (place.abs() - reach).cmple(0.5 * period).all() {
                        images.push(Image { sphere, center: place, is_own });
                    }
                }
            }
        }
    }
}
