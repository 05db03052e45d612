//! Queries of a world between steps: rays, nearby bodies, and the future path of a sphere.

use std::sync::Arc;

use glam::DVec3;

use super::World;
use crate::colliders::Colliders;
use crate::detect::instant::Instant;
use crate::error::Error;
use crate::id::SphereId;
use crate::path::PredictedPath;
use crate::query::{Hit, NearBody, Queries, QueryFilter};
use crate::step;

/// Sorting all bodies costs about as much as this many queries that test them one by one.
const FEW: usize = 8;

impl World {
    /// All spheres and surfaces in their present state.
    pub(crate) fn now(&self) -> Instant<'_> {
        self.state.now()
    }

    /// The present colliders, shared with the world until it changes its own.
    pub(crate) fn shared_colliders(&self) -> Arc<Colliders> {
        self.state.colliders.clone()
    }

    /// Sorts all bodies by place, for many queries of the present state: a query among 10,000 spheres then takes
    /// some microseconds.
    pub fn queries(&self) -> Queries<'_> {
        Queries::of(self.state.now(), true)
    }

    /// Returns the queries of the present state for `count` questions. For many questions the bodies are sorted as by
    /// [`Self::queries`]. The results are the same to the bit.
    pub fn queries_for(&self, count: usize) -> Queries<'_> {
        Queries::of(self.state.now(), count > FEW)
    }

    /// The first body that a ray meets from `origin` along `way` to its end \[m\]. For many rays, [`Self::queries`]
    /// sorts the bodies once; the results are the same to the bit.
    ///
    /// ```
    /// use carom::{Collider, DVec3, Pose, QueryFilter, Shape, World};
    ///
    /// let mut world = World::default();
    /// let floor = world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)))?;
    /// let down = DVec3::new(0.0, -8.0, 0.0);
    /// let hit = world.cast_ray(DVec3::new(3.0, 2.0, 0.0), down, &QueryFilter::default())?;
    /// let hit = hit.expect("the floor is below");
    /// assert_eq!((hit.fraction, hit.point, hit.normal), (0.25, DVec3::new(3.0, 0.0, 0.0), DVec3::Y));
    /// # Ok::<(), carom::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Queries::cast_ray`].
    pub fn cast_ray(
        &self,
        origin: DVec3,
        way: DVec3,
        filter: &QueryFilter,
    ) -> Result<Option<Hit>, Error> {
        Queries::of(self.state.now(), false).cast_ray(origin, way, filter)
    }

    /// The first body that a sphere of this `radius` meets on a straight path from `center` along `way` to its end
    /// \[m\].
    ///
    /// # Errors
    /// Those of [`Queries::cast_sphere`].
    pub fn cast_sphere(
        &self,
        center: DVec3,
        radius: f64,
        way: DVec3,
        filter: &QueryFilter,
    ) -> Result<Option<Hit>, Error> {
        Queries::of(self.state.now(), false).cast_sphere(center, radius, way, filter)
    }

    /// The body nearest to a point, if its surface is not farther away than `within` \[m\].
    ///
    /// # Errors
    /// Those of [`Queries::nearest`].
    pub fn nearest(
        &self,
        point: DVec3,
        within: f64,
        filter: &QueryFilter,
    ) -> Result<Option<NearBody>, Error> {
        Queries::of(self.state.now(), false).nearest(point, within, filter)
    }

    /// The bodies that touch or overlap a sphere at `center` with this `radius` \[m\].
    ///
    /// # Errors
    /// Those of [`Queries::overlapping`].
    pub fn overlapping(
        &self,
        center: DVec3,
        radius: f64,
        filter: &QueryFilter,
    ) -> Result<Vec<NearBody>, Error> {
        Queries::of(self.state.now(), false).overlapping(center, radius, filter)
    }

    /// Predicts the path of a sphere for `horizon` \[s\], or up to its impact number `most_impacts`, without a
    /// step: pieces in closed form, and what it meets.
    /// All other spheres continue their present flights, except those that the sphere strikes. While nothing else
    /// interferes, steps under the rule `exact` give the same positions and velocities to the bit, and the same
    /// impacts. Colliders continue their present motion; emitters emit nothing. Under other rules the path is that
    /// of `exact`.
    ///
    /// The other spheres keep to the flights that they are on, but for those that the sphere strikes. While
    /// nothing else interferes, steps under the rule `exact` give the same places and velocities to the bit,
    /// and the same impacts. Colliders move on from where they are now; emitters emit nothing. Under other
    /// rules the path is that of `exact`.
    ///
    /// ```
    /// use carom::{Collider, DVec3, Gravity, Pose, Shape, Sphere, World};
    ///
    /// let mut world = World::default();
    /// world.add_force(Gravity::new(DVec3::new(0.0, -10.0, 0.0)))?;
    /// world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)))?;
    /// let ball = world.add_sphere(Sphere::new(DVec3::new(0.0, 1.05, 0.0), 1.0))?;
    /// let path = world.predict(ball, 1.0, 2)?;
    /// assert!((path.impacts[0].time - 0.1).abs() < 1e-14);
    /// world.step(0.25)?;
    /// assert_eq!(path.position_at(0.25), Some(world.sphere(ball)?.position));
    /// # Ok::<(), carom::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Unknown`] if the sphere is not in the world; [`Error::Invalid`] if the horizon is not positive and
    /// finite, and with springs or forces that are not linear, whose motion has no closed form;
    /// [`Error::Stopped`] on a stop request.
    pub fn predict(
        &self,
        sphere: SphereId,
        horizon: f64,
        most_impacts: usize,
    ) -> Result<PredictedPath, Error> {
        let index = self.index_of(sphere)?;
        step::predict(&self.state, index, horizon, most_impacts, self.stop_request.as_ref())
    }
}
