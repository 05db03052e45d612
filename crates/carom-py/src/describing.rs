//! Describes the contents of a world as JSON. Infinite numbers are `null`.

use carom::SphereId;
use carom_scene::scene::{Collider, Sphere, Spring};
use carom_scene::{Paint, Scene};
use pyo3::prelude::*;

use crate::arguments;
use crate::engine::Engine;
use crate::failure::Failure;
use crate::inner::Inner;
use crate::points;

#[pymethods]
impl Engine {
    /// Returns the simulation settings.
    #[pyo3(name = "_simulation_json")]
    fn simulation_json(&self, py: Python<'_>) -> PyResult<String> {
        json(&self.lock(py)?.described.simulation)
    }

    /// Returns the pairs of materials.
    #[pyo3(name = "_material_pairs_json")]
    fn material_pairs_json(&self, py: Python<'_>) -> PyResult<String> {
        json(&self.lock(py)?.described.material_pairs)
    }

    /// Returns the forces with their ids.
    #[pyo3(name = "_forces_json")]
    fn forces_json(&self, py: Python<'_>) -> PyResult<String> {
        let inner = &*self.lock(py)?;
        let ids = inner.world.forces().map(|(id, _)| id.number());
        json(&ids.zip(&inner.described.forces).collect::<Vec<_>>())
    }

    /// Returns the colliders with their ids and present poses.
    #[pyo3(name = "_colliders_json")]
    fn colliders_json(&self, py: Python<'_>) -> PyResult<String> {
        let inner = &*self.lock(py)?;
        let ids = inner.world.colliders().map(|(id, _)| id.number());
        json(&ids.zip(colliders_now(inner)).collect::<Vec<_>>())
    }

    /// Returns the emitters with their ids.
    #[pyo3(name = "_emitters_json")]
    fn emitters_json(&self, py: Python<'_>) -> PyResult<String> {
        let inner = &*self.lock(py)?;
        let ids = inner.world.emitters().map(|(id, _)| id.number());
        json(&ids.zip(&inner.described.emitters).collect::<Vec<_>>())
    }

    /// Returns one sphere.
    #[pyo3(name = "_sphere_json")]
    fn sphere_json(&self, py: Python<'_>, id: &Bound<'_, PyAny>) -> PyResult<String> {
        let id = arguments::id("sphere", id)?;
        let inner = &mut *self.lock(py)?;
        let sphere = inner.world.sphere(SphereId::from_number(id)).map_err(Failure::from)?;
        inner.follow_colors();
        json(&described(&sphere, inner.palette.own(id)))
    }

    /// Returns the present world as the text of a scene without spheres and springs, then the
    /// spheres as arrays, then the springs as JSON. In that scene time starts at 0, and emitters
    /// start again.
    #[pyo3(name = "_scene")]
    fn scene<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(String, points::SphereColumns<'py>, String)> {
        let inner = &mut *self.lock(py)?;
        inner.follow_colors();
        let mut scene = (*inner.described).clone();
        let time = inner.world.time();
        scene.colliders = colliders_now(inner).iter().map(|it| it.beginning_at(time)).collect();
        // Rules that detect contacts late let spheres overlap, which a scene must allow.
        if !scene.simulation.allow_overlap {
            let (spheres, springs) = (spheres_now(inner), Spring::all_of(&inner.world));
            let whole = Scene { spheres, springs, ..scene.clone() };
            scene.simulation.allow_overlap = whole.world().is_err();
        }
        let springs = json(&Spring::all_of(&inner.world))?;
        Ok((scene.to_toml(), points::columns(py, &inner.world, &inner.palette)?, springs))
    }
}

/// Returns a description as JSON.
pub fn json(it: &impl serde::Serialize) -> PyResult<String> {
    Ok(serde_json::to_string(it).map_err(Failure::from)?)
}

/// Returns the colliders of a world with their present poses.
fn colliders_now(inner: &Inner) -> Vec<Collider> {
    let Inner { world, described, .. } = inner;
    let described = described.colliders.iter().zip(world.colliders());
    described.map(|(described, (_, collider))| described.now(collider)).collect()
}

/// Returns the spheres of a world, each with its own colour if it has one.
fn spheres_now(inner: &Inner) -> Vec<Sphere> {
    let spheres = inner.world.spheres();
    let paint = |id: &SphereId| inner.palette.own(id.number());
    let rows = spheres.ids().iter().enumerate();
    let described = |(i, id)| {
        let sphere = spheres.get(i);
        let material = inner.described.material_name(sphere.material);
        Sphere { material, ..described(&sphere, paint(id)) }
    };
    rows.map(described).collect()
}

/// Returns a sphere in the form of scene files.
fn described(sphere: &carom::Sphere, paint: Paint) -> Sphere {
    Sphere::of(sphere).painted(paint)
}
