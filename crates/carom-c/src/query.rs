//! Queries of a world between steps: rays, moving spheres, near bodies.

use carom::{Body, DVec3, Error, Groups, Hit, NearBody, Queries, QueryFilter, SphereId};

use crate::pointer::{Out, Plain, Room, Rows, RowsMut, Strided, read};
use crate::sphere::{refuse_too_many, refused};
use crate::status::{CaromStatus, Failure, call};
use crate::world::CaromWorld;

/// Which bodies a query finds. carom_query_filter() returns one with default values. Null in its
/// place stands for that one, too.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CaromQueryFilter {
    /// 1 to find spheres, else 0.
    pub spheres: u32,
    /// 1 to find colliders that deflect, else 0.
    pub colliders: u32,
    /// 1 to find triggers, else 0.
    pub triggers: u32,
    /// 1 to leave out the sphere `without_sphere`, else 0.
    pub leaves_out_sphere: u32,
    /// Id of the sphere that is left out.
    pub without_sphere: u64,
    /// Groups that the query is in, one bit for each, as if it were a body.
    pub groups: u32,
    /// Groups that the query collides with, one bit for each.
    pub collides_with: u32,
}

// SAFETY: a structure of numbers.
unsafe impl Plain for CaromQueryFilter {}

impl From<CaromQueryFilter> for QueryFilter {
    fn from(given: CaromQueryFilter) -> Self {
        let groups = Groups { groups: given.groups, collides_with: given.collides_with };
        let filter = Self::default()
            .with_spheres(given.spheres != 0)
            .with_colliders(given.colliders != 0)
            .with_triggers(given.triggers != 0)
            .with_groups(groups);
        match given.leaves_out_sphere {
            0 => filter,
            _ => filter.without_sphere(SphereId::from_number(given.without_sphere)),
        }
    }
}

/// A ray.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromRay {
    /// Where it starts [m].
    pub origin: [f64; 3],
    /// From there to its end [m].
    pub way: [f64; 3],
}

// SAFETY: a structure of numbers.
unsafe impl Plain for CaromRay {}

/// A sphere that moves straight.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromMovingSphere {
    /// Centre where it starts [m].
    pub center: [f64; 3],
    /// Radius [m], > 0.
    pub radius: f64,
    /// From there to its end [m].
    pub way: [f64; 3],
}

// SAFETY: a structure of numbers.
unsafe impl Plain for CaromMovingSphere {}

/// What a ray or a moving sphere meets first.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromHit {
    /// 1 if it meets a body, 0 if it meets nothing; then all other fields are 0.
    pub is_hit: u32,
    /// 1 if the body is a collider, 0 if it is a sphere.
    pub is_collider: u32,
    /// Id of the body.
    pub body: u64,
    /// Point on the surface of the body [m].
    pub point: [f64; 3],
    /// Unit normal of the body there, out of it.
    pub normal: [f64; 3],
    /// Part of the way before, 0 to 1.
    pub fraction: f64,
}

/// A body near a place.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromNearBody {
    /// 1 if there is a body, 0 if there is none; then all other fields are 0.
    pub is_found: u32,
    /// 1 if the body is a collider, 0 if it is a sphere.
    pub is_collider: u32,
    /// Id of the body.
    pub body: u64,
    /// The nearest point of its surface [m].
    pub point: [f64; 3],
    /// Unit normal of the body there, out of it.
    pub normal: [f64; 3],
    /// Distance of the surfaces [m], negative if they overlap.
    pub distance: f64,
}

/// Returns whether a body is a collider, and its id.
fn kind_and_id(body: Body) -> (u32, u64) {
    match body {
        Body::Collider(collider) => (1, collider.number()),
        Body::Sphere(sphere) => (0, sphere.number()),
    }
}

fn hit(hit: Option<Hit>) -> CaromHit {
    let Some(Hit { body, point, normal, fraction, .. }) = hit else { return CaromHit::default() };
    let ((is_collider, body), is_hit) = (kind_and_id(body), 1);
    let (point, normal) = (point.to_array(), normal.to_array());
    CaromHit { is_hit, is_collider, body, point, normal, fraction }
}

fn near(near: &NearBody) -> CaromNearBody {
    let ((is_collider, body), is_found) = (kind_and_id(near.body), 1);
    let (point, normal) = (near.point.to_array(), near.normal.to_array());
    CaromNearBody { is_found, is_collider, body, point, normal, distance: near.distance }
}

/// Writes the first body on each path of an array, which has this name, into `hits`.
fn write_hits<P: Plain>(
    world: CaromWorld,
    (name, paths): (&'static str, Rows<P>),
    mut hits: RowsMut<CaromHit>,
    cast: impl Fn(&Queries, P) -> Result<Option<Hit>, Error>,
) -> Result<(), Failure> {
    let found = world.with(|inner| {
        let paths: Vec<P> = paths.values().collect();
        let queries = inner.world.queries_for(paths.len());
        let cast = |(row, path)| cast(&queries, path).map_err(|error| refused(name, row, error));
        paths.into_iter().enumerate().map(cast).collect::<Result<Vec<_>, _>>()
    })?;
    found.into_iter().enumerate().for_each(|(row, it)| hits.set_row(row, [hit(it)]));
    Ok(())
}

/// Returns the filter behind a pointer of the program.
///
/// # Safety
/// `filter` is null, or can be read.
unsafe fn filter_of(filter: *const CaromQueryFilter) -> Result<QueryFilter, Failure> {
    match filter.is_null() {
        true => Ok(QueryFilter::default()),
        // SAFETY: the caller promises that it can be read.
        false => Ok(unsafe { read(filter, "filter") }?.into()),
    }
}

/// Returns a filter that finds spheres and colliders, but no triggers.
#[unsafe(no_mangle)]
pub extern "C" fn carom_query_filter() -> CaromQueryFilter {
    CaromQueryFilter {
        spheres: 1,
        colliders: 1,
        triggers: 0,
        leaves_out_sphere: 0,
        without_sphere: 0,
        groups: u32::MAX,
        collides_with: u32::MAX,
    }
}

/// Reads what `count` rays meet first into `hits`, which has room for as many; both are without
/// gaps. A rectangle is met from its front only. One call with many rays is much faster than as
/// many calls.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_cast_rays(
    world: CaromWorld,
    rays: *const CaromRay,
    count: usize,
    filter: *const CaromQueryFilter,
    hits: *mut CaromHit,
) -> CaromStatus {
    call(|| {
        refuse_too_many(count)?;
        let array = Strided { stride: 0, count };
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let rays = unsafe { Rows::new(rays, array, 1, "rays") }?;
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let hits = unsafe { RowsMut::new(hits, array, 1, "hits") }?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let filter = unsafe { filter_of(filter) }?;
        write_hits(world, ("rays", rays), hits, |queries, ray: CaromRay| {
            let [origin, way] = [ray.origin, ray.way].map(DVec3::from_array);
            queries.cast_ray(origin, way, &filter)
        })
    })
}

/// Reads what `count` moving spheres meet first into `hits`, in the way of carom_world_cast_rays().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_cast_spheres(
    world: CaromWorld,
    spheres: *const CaromMovingSphere,
    count: usize,
    filter: *const CaromQueryFilter,
    hits: *mut CaromHit,
) -> CaromStatus {
    call(|| {
        refuse_too_many(count)?;
        let array = Strided { stride: 0, count };
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let spheres = unsafe { Rows::new(spheres, array, 1, "spheres") }?;
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let hits = unsafe { RowsMut::new(hits, array, 1, "hits") }?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let filter = unsafe { filter_of(filter) }?;
        write_hits(world, ("spheres", spheres), hits, |queries, moving: CaromMovingSphere| {
            let [center, way] = [moving.center, moving.way].map(DVec3::from_array);
            queries.cast_sphere(center, moving.radius, way, &filter)
        })
    })
}

/// Reads the body nearest to a point, three numbers [m], if its surface is at most `within` [m]
/// away, which may be infinite.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_nearest(
    world: CaromWorld,
    point: *const f64,
    within: f64,
    filter: *const CaromQueryFilter,
    nearest: *mut CaromNearBody,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride: 0, count: 1 };
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let point = unsafe { Rows::new(point, array, 3, "point") }?.row::<3>(0);
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut place = unsafe { Out::new(nearest, "nearest") }?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let filter = unsafe { filter_of(filter) }?;
        let point = DVec3::from_array(point);
        let found = world.with(|inner| Ok(inner.world.nearest(point, within, &filter)?))?;
        place.set(found.as_ref().map_or_else(CaromNearBody::default, near));
        Ok(())
    })
}

/// Reads the bodies that touch or overlap a sphere, whose `way` is not used: spheres first, then
/// colliders, in the order of ids. Writes their number to `count`; if `bodies` is null, only that.
/// More than `capacity` bodies, which are without gaps, are an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_overlapping(
    world: CaromWorld,
    sphere: *const CaromMovingSphere,
    filter: *const CaromQueryFilter,
    bodies: *mut CaromNearBody,
    capacity: usize,
    count: *mut usize,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride: 0, count: capacity };
        // SAFETY: the caller's array and pointer are null or valid, as the header demands.
        let room = unsafe { Room::new(bodies, array, count, "bodies") }?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let CaromMovingSphere { center, radius, .. } = unsafe { read(sphere, "sphere") }?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let filter = unsafe { filter_of(filter) }?;
        let center = DVec3::from_array(center);
        let found = world.with(|inner| Ok(inner.world.overlapping(center, radius, &filter)?))?;
        room.fill(found.iter().map(near))
    })
}
