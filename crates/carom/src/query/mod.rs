//! Queries of the present world: the first body on the path of a ray or a sphere, and bodies near a place.

mod cast;
mod images;
mod tree;

use std::borrow::Cow;

use glam::DVec3;

use crate::bounds::Bounds;
use crate::detect::instant::Instant;
use crate::detect::sphere_surface;
use crate::error::{Error, InvalidValue, Subject};
use crate::groups::Groups;
use crate::id::{ColliderId, SphereId};
use crate::surface::{Form, Role};
use crate::validate;
use cast::Sweep;
use tree::{BodyTree, Item, Leaf};

/// A path in a periodic box crosses at most this many boxes: each costs a search.
const MOST_BOXES: f64 = 65_536.0;

/// A sphere or a collider.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Body {
    /// A sphere.
    Sphere(SphereId),
    /// A collider.
    Collider(ColliderId),
}

/// The first body that a ray or a moving sphere meets.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Hit {
    /// The body that is met.
    pub body: Body,
    /// The contact point on the surface of that body \[m\]; in a periodic box at the end of the unwrapped path,
    /// which may be outside.
    pub point: DVec3,
    /// Unit normal of that body there, out of it.
    pub normal: DVec3,
    /// Part of the path before the contact, 0 to 1; 0 where the body is overlapped at the start.
    pub fraction: f64,
}

/// A body near a place.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct NearBody {
    /// The body.
    pub body: Body,
    /// The nearest point of its surface \[m\]; in a periodic box that of the nearest image.
    pub point: DVec3,
    /// Unit normal of the body there, out of it.
    pub normal: DVec3,
    /// Distance of the surfaces \[m\]; negative where they overlap.
    pub distance: f64,
}

/// Which bodies a query finds: by default spheres and colliders, but no triggers.
///
/// ```
/// use carom::QueryFilter;
///
/// let only_walls = QueryFilter::default().with_spheres(false);
/// assert!(only_walls.colliders && !only_walls.triggers);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct QueryFilter {
    /// Whether it finds spheres.
    pub spheres: bool,
    /// Whether it finds colliders that deflect.
    pub colliders: bool,
    /// Whether it finds triggers.
    pub triggers: bool,
    /// A sphere that it passes over, such as the one from which a ray starts.
    pub except: Option<SphereId>,
    /// The groups that it is in and collides with, as if it were a body; by default all of both.
    pub groups: Groups,
}

impl Default for QueryFilter {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl QueryFilter {
    /// Spheres and colliders that deflect.
    pub const DEFAULT: Self = Self {
        spheres: true,
        colliders: true,
        triggers: false,
        except: None,
        groups: Groups { groups: u32::MAX, collides_with: u32::MAX },
    };

    /// Returns the filter with spheres included or left out.
    pub fn with_spheres(self, spheres: bool) -> Self {
        Self { spheres, ..self }
    }

    /// Returns the filter with deflecting colliders included or left out.
    pub fn with_colliders(self, colliders: bool) -> Self {
        Self { colliders, ..self }
    }

    /// Returns the filter with triggers included or left out.
    pub fn with_triggers(self, triggers: bool) -> Self {
        Self { triggers, ..self }
    }

    /// Returns the filter for what a body in these groups collides with.
    pub fn with_groups(self, groups: Groups) -> Self {
        Self { groups, ..self }
    }

    /// Returns the filter without this sphere.
    pub fn without_sphere(self, sphere: SphereId) -> Self {
        Self { except: Some(sphere), ..self }
    }
}

/// Queries of the present state of a world, with its bodies sorted once, for many queries between two steps.
///
/// ```
/// use carom::{Body, DVec3, QueryFilter, Sphere, World};
///
/// let mut world = World::default();
/// let ball = world.add_sphere(Sphere::new(DVec3::new(5.0, 0.0, 0.0), 1.0))?;
/// let queries = world.queries();
/// let hit = queries.cast_ray(DVec3::ZERO, DVec3::new(8.0, 0.0, 0.0), &QueryFilter::default())?;
/// let hit = hit.expect("the ball is on the way");
/// assert_eq!((hit.body, hit.fraction), (Body::Sphere(ball), 0.5));
/// assert_eq!((hit.point, hit.normal), (DVec3::new(4.0, 0.0, 0.0), DVec3::NEG_X));
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Clone)]
pub struct Queries<'a> {
    now: Instant<'a>,
    /// All bodies sorted by place; `None` where each query tests those near it one by one.
    sorted: Option<BodyTree>,
    /// Edges of the periodic box \[m\]; infinite along an open axis.
    period: DVec3,
}

impl<'a> Queries<'a> {
    /// Queries of a world at one instant; the bodies are `sorted` by place, or tested one by one.
    pub(crate) fn of(now: Instant<'a>, sorted: bool) -> Self {
        let period = now.system.settings.boundary.period();
        let tree = || {
            let (bounded, unbounded) = images::bodies(&now, period, None);
            BodyTree::of(bounded, unbounded, true)
        };
        Self { sorted: sorted.then(tree), now, period }
    }

    /// Returns a tree of all bodies within a region, and possibly others.
    fn bodies_near(&self, region: &Bounds) -> Cow<'_, BodyTree> {
        let of_query = || {
            let (bounded, unbounded) = images::bodies(&self.now, self.period, Some(region));
            Cow::Owned(BodyTree::of(bounded, unbounded, false))
        };
        self.sorted.as_ref().map_or_else(of_query, Cow::Borrowed)
    }

    /// The first body that a ray meets from `origin` \[m\] along `way` to its end \[m\].
    ///
    /// A rectangle is met from its front. Of several bodies at one place, a sphere comes before a collider, and a
    /// smaller id before a larger one.
    ///
    /// # Errors [`Error::Invalid`] if a number is not finite, or the path crosses more than 65,536 periodic boxes.
    pub fn cast_ray(
        &self,
        origin: DVec3,
        way: DVec3,
        filter: &QueryFilter,
    ) -> Result<Option<Hit>, Error> {
        self.check_way(("origin", origin), way)?;
        Ok(self.first_on_way(origin, 0.0, way, filter))
    }

    /// The first body that a sphere with this `radius` \[m\] meets on a straight path from `center` along `way` to
    /// its end \[m\].
    ///
    /// # Errors
    /// As [`Self::cast_ray`], and if the radius is not positive or, in a periodic box, larger than its
    /// shortest edge.
    pub fn cast_sphere(
        &self,
        center: DVec3,
        radius: f64,
        way: DVec3,
        filter: &QueryFilter,
    ) -> Result<Option<Hit>, Error> {
        self.check_radius(radius)?;
        self.check_way(("center", center), way)?;
        Ok(self.first_on_way(center, radius, way, filter))
    }

    /// The body nearest to a point \[m\], if its surface is not farther away than `within` \[m\], which may be
    /// infinite. The distance of a body that contains the point is negative. Points behind a rectangle do not find
    /// it.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the point is not finite, or `within` negative or no number.
    pub fn nearest(
        &self,
        point: DVec3,
        within: f64,
        filter: &QueryFilter,
    ) -> Result<Option<NearBody>, Error> {
        validate::finite("point", point)
            .and_then(|()| validate::require(within >= 0.0, "within", "zero or positive", within))
            .map_err(refused)?;
        let wrapped = images::wrapped(point, self.period);
        // Whatever is nearest has an image within half a box along each axis.
        let half = self.period.min(DVec3::splat(2.0 * within)) * 0.5;
        let region = Bounds::around(wrapped, half);
        let tree = self.bodies_near(&around(wrapped, within));
        let mut nearest: Option<(NearBody, Item)> = None;
        for shift in images::shifts(&region, tree.bounds(), self.period) {
            let place = wrapped - shift;
            let mut limit = nearest.map_or(within, |(it, _)| it.distance);
            let bound = |bounds: &Bounds| bounds.distance_below(place);
            tree.search(&bound, &mut limit, &mut |leaf, limit| {
                let Some(found) = self.near_body(leaf, place, 0.0, shift, filter) else { return };
                let is_nearer = |(best, item): &(NearBody, Item)| {
                    found.distance < best.distance
                        || (found.distance == best.distance && leaf.item < *item)
                };
                if found.distance <= within && nearest.as_ref().is_none_or(is_nearer) {
                    nearest = Some((found, leaf.item));
                    *limit = found.distance.max(0.0).min(*limit);
                }
            });
        }
        Ok(nearest.map(|(found, _)| NearBody { point: found.point + (point - wrapped), ..found }))
    }

    /// The bodies that touch or overlap a sphere at `center` with this `radius` \[m\]: spheres first, each kind
    /// in the order of ids, each body once.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the place is not finite, the radius not positive or, in a periodic box, larger
    /// than its shortest edge.
    pub fn overlapping(
        &self,
        center: DVec3,
        radius: f64,
        filter: &QueryFilter,
    ) -> Result<Vec<NearBody>, Error> {
        self.check_radius(radius)?;
        validate::finite("center", center).map_err(refused)?;
        let wrapped = images::wrapped(center, self.period);
        let region = Bounds::around(wrapped, DVec3::splat(radius));
        let tree = self.bodies_near(&around(wrapped, radius));
        let mut found: Vec<(NearBody, Item)> = Vec::new();
        for shift in images::shifts(&region, tree.bounds(), self.period) {
            let place = wrapped - shift;
            let mut limit = radius;
            let bound = |bounds: &Bounds| bounds.distance_below(place);
            tree.search(&bound, &mut limit, &mut |leaf, _| {
                let near = self.near_body(leaf, place, radius, shift, filter);
                let near = near.filter(|near| near.distance <= 0.0);
                found.extend(near.map(|near| (near, leaf.item)));
            });
        }
        // Of surfaces of one body at one distance the first is kept, since the order of the search depends on the
        // tree.
        found.sort_by(|(a, of_a), (b, of_b)| {
            a.body.cmp(&b.body).then(a.distance.total_cmp(&b.distance)).then(of_a.cmp(of_b))
        });
        found.dedup_by_key(|(near, _)| near.body);
        let moved = |near: NearBody| NearBody { point: near.point + (center - wrapped), ..near };
        Ok(found.into_iter().map(|(near, _)| moved(near)).collect())
    }

    /// The separation of a body from a sphere at `place`, relative to the image at the offset `shift` \[m\].
    fn near_body(
        &self,
        leaf: &Leaf,
        place: DVec3,
        radius: f64,
        shift: DVec3,
        filter: &QueryFilter,
    ) -> Option<NearBody> {
        if !self.is_found(leaf, shift, filter) {
            return None;
        }
        let separation = sphere_surface(&self.form_of(leaf.item), place - leaf.shift, radius)?;
        Some(NearBody {
            body: self.body_of(leaf.item),
            point: separation.point + leaf.shift + shift,
            normal: separation.normal,
            distance: separation.distance,
        })
    }

    /// The first body on the path of a sphere; a ray has no radius.
    fn first_on_way(
        &self,
        center: DVec3,
        radius: f64,
        way: DVec3,
        filter: &QueryFilter,
    ) -> Option<Hit> {
        let tree = self.bodies_near(&Sweep::new(center, radius, way).bounds());
        for piece in images::pieces(center, way, self.period) {
            let sweep = Sweep::new(piece.start, radius, piece.way);
            let mut first: Option<(Hit, Item)> = None;
            for shift in images::shifts(&sweep.bounds(), tree.bounds(), self.period) {
                let sweep = sweep.seen_from(shift);
                let mut limit = first.map_or(1.0, |(hit, _)| hit.fraction);
                tree.search(&|bounds| sweep.reaches(bounds), &mut limit, &mut |leaf, limit| {
                    if !self.is_found(leaf, shift, filter) {
                        return;
                    }
                    let (form, own) = (self.form_of(leaf.item), sweep.seen_from(leaf.shift));
                    let encloses = matches!(leaf.item, Item::Surface(surface)
                        if self.now.system.surfaces[surface as usize].role == Role::Encloses);
                    let Some((fraction, contact)) = own.meet(&form, encloses) else { return };
                    let is_earlier = |(hit, item): &(Hit, Item)| {
                        fraction < hit.fraction || (fraction == hit.fraction && leaf.item < *item)
                    };
                    if first.as_ref().is_none_or(is_earlier) {
                        let point = contact.point + leaf.shift + shift;
                        let body = self.body_of(leaf.item);
                        let hit = Hit { body, point, normal: contact.normal, fraction };
                        first = Some((hit, leaf.item));
                        *limit = fraction.min(*limit);
                    }
                });
            }
            if let Some((hit, _)) = first {
                let fraction = piece.fraction_at(hit.fraction);
                return Some(Hit { fraction, point: hit.point + piece.unwrapped, ..hit });
            }
        }
        None
    }

    /// Whether a filter accepts a body, or its image at this offset \[m\].
    fn is_found(&self, leaf: &Leaf, shift: DVec3, filter: &QueryFilter) -> bool {
        if !leaf.has_images && shift != DVec3::ZERO {
            return false;
        }
        let system = &self.now.system;
        match leaf.item {
            Item::Sphere(sphere) => {
                let id = system.spheres.id[sphere as usize];
                let groups = system.spheres.groups(sphere as usize);
                filter.spheres && filter.except != Some(id) && filter.groups.collides(groups)
            }
            Item::Surface(surface) => {
                let surface = &system.surfaces[surface as usize];
                let is_of_kind = match surface.role {
                    Role::Reports => filter.triggers,
                    Role::Deflects | Role::Encloses => filter.colliders,
                };
                is_of_kind && filter.groups.collides(surface.groups)
            }
        }
    }

    fn body_of(&self, item: Item) -> Body {
        match item {
            Item::Sphere(sphere) => Body::Sphere(self.now.system.spheres.id[sphere as usize]),
            Item::Surface(surface) => {
                Body::Collider(self.now.system.surfaces[surface as usize].collider)
            }
        }
    }

    fn form_of(&self, item: Item) -> Form {
        match item {
            Item::Sphere(sphere) => {
                let index = sphere as usize;
                let radius = self.now.system.spheres.radius[index];
                Form::Sphere { center: self.now.motion.position[index], radius }
            }
            Item::Surface(surface) => self.now.system.surfaces[surface as usize].form.clone(),
        }
    }

    fn check_way(&self, (field, start): (&'static str, DVec3), way: DVec3) -> Result<(), Error> {
        let boxes = (way.abs() / self.period).max_element();
        let requirement = "at most 65,536 boxes long in a periodic box";
        validate::finite(field, start)
            .and_then(|()| validate::finite("way", way))
            .and_then(|()| validate::require(boxes <= MOST_BOXES, "way", requirement, way))
            .map_err(refused)
    }

    fn check_radius(&self, radius: f64) -> Result<(), Error> {
        let fits = radius <= self.period.min_element();
        let requirement = "at most the shortest edge of the periodic box";
        validate::positive("radius", radius)
            .and_then(|()| validate::require(fits, "radius", requirement, radius))
            .map_err(refused)
    }
}

fn refused(invalid: InvalidValue) -> Error {
    invalid.about(Subject::Query)
}

/// Bounds of the places up to a distance from a point \[m\], wider by more than rounding.
fn around(point: DVec3, distance: f64) -> Bounds {
    let slack = 1e-9 * (point.abs().max_element() + distance);
    Bounds::around(point, DVec3::splat(distance + slack))
}
