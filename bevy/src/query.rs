//! Questions about the present state.

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use bevy_math::{DVec3, Ray3d};
use carom::{Body, Error, QueryFilter};

use crate::components::PhysicsBody;
use crate::convert::{to_bevy, to_carom};
use crate::physics::CaromWorld;

/// Rays, moving spheres and neighbours, in systems.
///
/// The world is that after the last step: what a program changed since is not in it. For many questions at once,
/// [`carom::World::queries`] of [`CaromWorld`] sorts the bodies first.
///
/// ```
/// use bevy_ecs::prelude::*;
/// use bevy_math::{Dir3, Ray3d, Vec3};
/// use carom_bevy::SpatialQuery;
/// use carom_bevy::carom::QueryFilter;
///
/// fn aim(query: SpatialQuery) -> Result {
///     let down = Ray3d { origin: Vec3::Y, direction: Dir3::NEG_Y };
///     if let Some(hit) = query.cast_ray(down, 10.0, &QueryFilter::default())? {
///         println!("{} is {} m below", hit.entity, hit.distance);
///     }
///     Ok(())
/// }
/// ```
#[derive(SystemParam)]
pub struct SpatialQuery<'w, 's> {
    physics: Res<'w, CaromWorld>,
    bodies: Query<'w, 's, &'static PhysicsBody>,
}

/// The first body on a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyHit {
    /// The body that is met.
    pub entity: Entity,
    /// Length of the path before the contact \[m\]; 0 where the body is overlapped at its start.
    pub distance: f64,
    /// Contact point on the surface of that body \[m\].
    pub point: DVec3,
    /// Unit normal of that body there, out of it.
    pub normal: DVec3,
}

/// A body near a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestBody {
    /// The body.
    pub entity: Entity,
    /// Distance of the surfaces \[m\]; negative where they overlap.
    pub distance: f64,
    /// The nearest point of its surface \[m\].
    pub point: DVec3,
    /// Unit normal of the body there, out of it.
    pub normal: DVec3,
}

impl SpatialQuery<'_, '_> {
    /// Returns the first body that a ray meets within `distance` \[m\].
    ///
    /// # Errors
    /// Those of [`carom::Queries::cast_ray`].
    pub fn cast_ray(
        &self,
        ray: Ray3d,
        distance: f64,
        filter: &QueryFilter,
    ) -> Result<Option<BodyHit>, Error> {
        let origin = to_carom(ray.origin.as_dvec3());
        let hit = self.physics.cast_ray(origin, way(ray, distance), filter)?;
        Ok(hit.and_then(|hit| self.hit(&hit, distance)))
    }

    /// Returns the first body that a sphere with this `radius` \[m\] meets, whose centre moves along a ray by
    /// `distance` \[m\].
    ///
    /// # Errors
    /// Those of [`carom::Queries::cast_sphere`].
    pub fn cast_sphere(
        &self,
        ray: Ray3d,
        radius: f64,
        distance: f64,
        filter: &QueryFilter,
    ) -> Result<Option<BodyHit>, Error> {
        let center = to_carom(ray.origin.as_dvec3());
        let hit = self.physics.cast_sphere(center, radius, way(ray, distance), filter)?;
        Ok(hit.and_then(|hit| self.hit(&hit, distance)))
    }

    /// Returns the body nearest to a point \[m\], if its surface is not farther away than `within` \[m\].
    ///
    /// # Errors
    /// Those of [`carom::Queries::nearest`].
    pub fn nearest(
        &self,
        point: DVec3,
        within: f64,
        filter: &QueryFilter,
    ) -> Result<Option<NearestBody>, Error> {
        let found = self.physics.nearest(to_carom(point), within, filter)?;
        Ok(found.and_then(|body| self.near(&body)))
    }

    /// Returns the bodies that touch or overlap a sphere with this `radius` about `center` \[m\].
    ///
    /// # Errors
    /// Those of [`carom::Queries::overlapping`].
    pub fn overlapping(
        &self,
        center: DVec3,
        radius: f64,
        filter: &QueryFilter,
    ) -> Result<Vec<NearestBody>, Error> {
        let found = self.physics.overlapping(to_carom(center), radius, filter)?;
        Ok(found.iter().filter_map(|body| self.near(body)).collect())
    }

    /// Returns a filter that passes over a ball, such as the one from which a ray starts.
    pub fn without(&self, filter: QueryFilter, ball: Entity) -> QueryFilter {
        match self.bodies.get(ball).map(PhysicsBody::body) {
            Ok(Body::Sphere(id)) => filter.without_sphere(id),
            _ => filter,
        }
    }

    fn hit(&self, hit: &carom::Hit, distance: f64) -> Option<BodyHit> {
        let entity = self.physics.entity(hit.body)?;
        let distance = distance * hit.fraction;
        Some(BodyHit { entity, distance, point: to_bevy(hit.point), normal: to_bevy(hit.normal) })
    }

    fn near(&self, body: &carom::NearBody) -> Option<NearestBody> {
        Some(NearestBody {
            entity: self.physics.entity(body.body)?,
            distance: body.distance,
            point: to_bevy(body.point),
            normal: to_bevy(body.normal),
        })
    }
}

/// The path along a ray; the direction is made a unit vector to the digits of `f64`.
fn way(ray: Ray3d, distance: f64) -> carom::DVec3 {
    to_carom(ray.direction.as_dvec3().normalize() * distance)
}
