//! Queries of a world between steps.

use carom::{Body, DVec3, Groups, Hit, NearBody, QueryFilter, SphereId};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::failure::Failure;
use crate::world::World;

/// Which bodies a query finds.
#[wasm_bindgen]
#[derive(Debug, Clone, Copy, Default)]
pub struct Filter(QueryFilter);

#[wasm_bindgen]
impl Filter {
    /// Makes the filter that finds spheres and colliders, but no triggers.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets whether it finds spheres, colliders that deflect, and triggers.
    #[wasm_bindgen(js_name = setKinds)]
    pub fn set_kinds(&mut self, spheres: bool, colliders: bool, triggers: bool) {
        let filter = self.0.with_spheres(spheres).with_colliders(colliders);
        self.0 = filter.with_triggers(triggers);
    }

    /// Sets the groups that it is in and collides with.
    #[wasm_bindgen(js_name = setGroups)]
    pub fn set_groups(&mut self, groups: u32, collides_with: u32) {
        self.0 = self.0.with_groups(Groups { groups, collides_with });
    }

    /// Makes it pass over a sphere.
    #[wasm_bindgen(js_name = setWithoutSphere)]
    pub fn set_without_sphere(&mut self, id: f64) {
        self.0 = self.0.without_sphere(SphereId::from_number(id as u64));
    }
}

/// Queries. Vectors are three numbers each. Results are rows of numbers: 1 if the body is a
/// collider or 0 if it is a sphere, its id, point, normal, and fraction or distance.
#[wasm_bindgen]
impl World {
    /// Casts rays from `origins` along `ways` \[m\]. Returns a row for each; NaN if it meets nothing.
    ///
    /// # Errors
    /// [`Failure`] if a number is not finite, or a ray crosses too many periodic boxes.
    #[wasm_bindgen(js_name = castRays)]
    pub fn cast_rays(
        &self,
        origins: &[f64],
        ways: &[f64],
        filter: Filter,
    ) -> Result<Vec<f64>, Failure> {
        let (origins, ways) = (vectors(origins), vectors(ways));
        let queries = self.world.queries_for(origins.len());
        let mut table = Vec::with_capacity(COLUMNS * origins.len());
        for (&origin, &way) in origins.iter().zip(&ways) {
            push_hit(&mut table, queries.cast_ray(origin, way, &filter.0)?);
        }
        Ok(table)
    }

    /// Casts a sphere from `center` along a `way` with a `radius`, all \[m\]. Returns a row; NaN if
    /// it meets nothing.
    ///
    /// # Errors
    /// [`Failure`] as [`Self::cast_rays`], and if the radius is not positive.
    #[wasm_bindgen(js_name = castSphere)]
    pub fn cast_sphere(
        &self,
        center: &[f64],
        radius: f64,
        way: &[f64],
        filter: Filter,
    ) -> Result<Vec<f64>, Failure> {
        let mut table = Vec::with_capacity(COLUMNS);
        for (center, way) in vectors(center).into_iter().zip(vectors(way)) {
            push_hit(&mut table, self.world.cast_sphere(center, radius, way, &filter.0)?);
        }
        Ok(table)
    }

    /// Returns a row with the body nearest to a point \[m\], up to `within` \[m\] away; NaN if there is
    /// none.
    ///
    /// # Errors
    /// [`Failure`] if the point is not finite, or `within` negative or no number.
    pub fn nearest(&self, point: &[f64], within: f64, filter: Filter) -> Result<Vec<f64>, Failure> {
        let mut table = Vec::with_capacity(COLUMNS);
        for point in vectors(point) {
            match self.world.nearest(point, within, &filter.0)? {
                Some(near) => push_near(&mut table, &near),
                None => table.extend(NOTHING),
            }
        }
        Ok(table)
    }

    /// Returns a row for each body that touches or overlaps a sphere at `center` with a `radius`
    /// \[m\].
    ///
    /// # Errors
    /// [`Failure`] if the centre is not finite, or the radius not positive.
    pub fn overlapping(
        &self,
        center: &[f64],
        radius: f64,
        filter: Filter,
    ) -> Result<Vec<f64>, Failure> {
        let mut table = Vec::new();
        for center in vectors(center) {
            let found = self.world.overlapping(center, radius, &filter.0)?;
            found.iter().for_each(|near| push_near(&mut table, near));
        }
        Ok(table)
    }
}

/// Numbers per row; `web/package/src/queries.js` reads them.
const COLUMNS: usize = 9;
/// The row of a query that finds nothing.
const NOTHING: [f64; COLUMNS] = [f64::NAN; COLUMNS];

fn push_hit(table: &mut Vec<f64>, hit: Option<Hit>) {
    let Some(hit) = hit else { return table.extend(NOTHING) };
    push(table, hit.body, [hit.point, hit.normal]);
    table.push(hit.fraction);
}

fn push_near(table: &mut Vec<f64>, near: &NearBody) {
    push(table, near.body, [near.point, near.normal]);
    table.push(near.distance);
}

fn push(table: &mut Vec<f64>, body: Body, vectors: [DVec3; 2]) {
    table.extend(match body {
        Body::Collider(collider) => [1.0, collider.number() as f64],
        Body::Sphere(sphere) => [0.0, sphere.number() as f64],
    });
    table.extend(vectors.iter().flat_map(|vector| vector.to_array()));
}

fn vectors(numbers: &[f64]) -> Vec<DVec3> {
    numbers.chunks_exact(3).map(DVec3::from_slice).collect()
}
