//! Bodies and their images in a periodic box, for queries.

use glam::DVec3;

use super::tree::{Item, Leaf};
use crate::bounds::Bounds;
use crate::detect::instant::Instant;
use crate::detect::surface_tree;
use crate::settings::nearest_image;

/// Images are tested up to this many boxes away. A body counts where its middle is in the box, so that a larger
/// body has an image that is nearer than those beyond.
const FARTHEST_IMAGE: f64 = 2.0;

/// The bodies of an instant, with and without bounds, in a box with these edges \[m\]. Where there are no images,
/// surfaces outside of a `region` may be left out.
pub(super) fn bodies(
    now: &Instant,
    period: DVec3,
    region: Option<&Bounds>,
) -> (Vec<Leaf>, Vec<Leaf>) {
    let (mut bounded, mut unbounded) = (Vec::new(), Vec::new());
    let radii = &now.system.spheres.radius;
    for (sphere, (&center, &radius)) in (0..).zip(now.motion.position.iter().zip(radii)) {
        let slack = 1e-12 * (center.abs().max_element() + radius);
        let bounds = Bounds::around(center, DVec3::splat(radius + slack));
        bounded.push(in_box(Item::Sphere(sphere), bounds, period));
    }
    for number in surfaces(now, region.filter(|_| period == DVec3::INFINITY)) {
        let (surface, item) = (&now.system.surfaces[number as usize], Item::Surface(number));
        match surface_tree::bounds(&surface.form) {
            Some(bounds) if surface.motion.is_at_rest() => {
                bounded.push(in_box(item, bounds, period));
            }
            // As in a step, moving surfaces have no images.
            Some(bounds) => {
                bounded.push(Leaf { bounds, item, shift: DVec3::ZERO, has_images: false });
            }
            None => {
                let bounds = Bounds::around(DVec3::ZERO, DVec3::INFINITY);
                unbounded.push(Leaf { bounds, item, shift: DVec3::ZERO, has_images: false });
            }
        }
    }
    (bounded, unbounded)
}

/// Indices of all surfaces, ascending, or of those whose bounds overlap a region \[m\].
fn surfaces(now: &Instant, region: Option<&Bounds>) -> Vec<u32> {
    let Some(region) = region else { return (0..now.system.surfaces.len() as u32).collect() };
    let mut near = Vec::new();
    now.system.tree.near(region, &mut near);
    near
}

/// A body with its middle wrapped into the box.
fn in_box(item: Item, bounds: Bounds, period: DVec3) -> Leaf {
    let middle = bounds.center();
    let shift = wrapped(middle, period) - middle;
    let bounds = Bounds { min: bounds.min + shift, max: bounds.max + shift };
    Leaf { bounds, item, shift, has_images: true }
}

/// The image of a place in the box about the origin \[m\].
pub(super) fn wrapped(place: DVec3, period: DVec3) -> DVec3 {
    if period == DVec3::INFINITY { place } else { nearest_image(place, period) }
}

/// A piece of a path, not longer than the box along any axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    /// Where it starts, in the box \[m\].
    pub start: DVec3,
    /// Displacement \[m\].
    pub way: DVec3,
    /// Offset from there to its place on the whole path \[m\].
    pub unwrapped: DVec3,
    number: u32,
    count: u32,
}

impl Piece {
    /// Part of the whole path at a part of this piece, both from 0 to 1.
    pub fn fraction_at(&self, part: f64) -> f64 {
        (f64::from(self.number) + part) / f64::from(self.count)
    }
}

/// The pieces of a path from a place, all \[m\].
pub(super) fn pieces(start: DVec3, way: DVec3, period: DVec3) -> impl Iterator<Item = Piece> {
    let count = (way.abs() / period).max_element().ceil().max(1.0) as u32;
    (0..count).map(move |number| {
        let place = start + way * (f64::from(number) / f64::from(count));
        let start = wrapped(place, period);
        Piece { start, way: way / f64::from(count), unwrapped: place - start, number, count }
    })
}

/// Offsets \[m\] of images of `bodies` that may reach a region.
pub(super) fn shifts(
    region: &Bounds,
    bodies: Option<&Bounds>,
    period: DVec3,
) -> impl Iterator<Item = DVec3> {
    // Bodies without bounds are tested once.
    let own = Bounds { min: region.min, max: region.max };
    let bodies = bodies.copied().unwrap_or(own);
    let numbers = |axis: usize| {
        if period[axis].is_finite() {
            let low = ((region.min[axis] - bodies.max[axis]) / period[axis]).ceil();
            let high = ((region.max[axis] - bodies.min[axis]) / period[axis]).floor();
            // The box itself is always one of them.
            low.clamp(-FARTHEST_IMAGE, 0.0) as i32..=high.clamp(0.0, FARTHEST_IMAGE) as i32
        } else {
            0..=0
        }
    };
    let [xs, ys, zs] = [0, 1, 2].map(numbers);
    let period = DVec3::select(period.is_finite_mask(), period, DVec3::ZERO);
    xs.flat_map(move |x| {
        let zs = zs.clone();
        ys.clone().flat_map(move |y| zs.clone().map(move |z| [x, y, z]))
    })
    .map(move |boxes| DVec3::from_array(boxes.map(f64::from)) * period)
}
