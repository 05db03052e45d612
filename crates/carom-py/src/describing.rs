//! Telling what is in a world, as JSON. Infinite numbers are `null`.

use carom::SphereId;
use carom_scene::scene::{Collider, Sphere, Spring};
use carom_scene::{Paint, Scene};
use pyo3::prelude::*;

use crate::arguments;
use crate::engine::{Engine, Inner};
use crate::failure::Failure;
use crate::points;

#[pymethods]
impl Engine {
    /// How the world is stepped.
    #[pyo3(name = "_simulation_json")]
    fn simulation_json(&self, py: Python<'_>) -> PyResult<String> {
        json(&self.lock(py)?.described.simulation)
    }

    /// Forces by their ids.
    #[pyo3(name = "_forces_json")]
    fn forces_json(&self, py: Python<'_>) -> PyResult<String> {
        let inner = &*self.lock(py)?;
        let ids = inner.world.forces().map(|(id, _)| id.number());
        json(&ids.zip(&inner.described.forces).collect::<Vec<_>>())
    }

    /// Colliders by their ids, where they are now.
    #[pyo3(name = "_colliders_json")]
    fn colliders_json(&self, py: Python<'_>) -> PyResult<String> {
        let inner = &*self.lock(py)?;
        let ids = inner.world.colliders().map(|(id, _)| id.number());
        json(&ids.zip(colliders_now(inner)).collect::<Vec<_>>())
    }

    /// Emitters by their ids.
    #[pyo3(name = "_emitters_json")]
    fn emitters_json(&self, py: Python<'_>) -> PyResult<String> {
        let inner = &*self.lock(py)?;
        let ids = inner.world.emitters().map(|(id, _)| id.number());
        json(&ids.zip(&inner.described.emitters).collect::<Vec<_>>())
    }

    /// One sphere.
    #[pyo3(name = "_sphere_json")]
    fn sphere_json(&self, py: Python<'_>, id: &Bound<'_, PyAny>) -> PyResult<String> {
        let id = arguments::id("sphere", id)?;
        let inner = &mut *self.lock(py)?;
        let sphere = inner.world.sphere(SphereId::from_number(id)).map_err(Failure::from)?;
        inner.follow_colors();
        json(&described(&sphere, inner.palette.own(id)))
    }

    /// The text of a scene that begins as the world is now, but for its spheres and springs, and these, springs in
    /// JSON: time begins at 0 there, and emitters begin anew.
    #[pyo3(name = "_scene")]
    fn scene<'py>(&self, py: Python<'py>) -> PyResult<(String, points::Told<'py>, String)> {
        let inner = &mut *self.lock(py)?;
        inner.follow_colors();
        let mut scene = (*inner.described).clone();
        scene.colliders = colliders_now(inner);
        // Rules that find contacts late let spheres overlap; a scene has to admit it.
        if !scene.simulation.allow_overlap {
            let (spheres, springs) = (spheres_now(inner), Spring::all_of(&inner.world));
            let whole = Scene { spheres, springs, ..scene.clone() };
            scene.simulation.allow_overlap = whole.world().is_err();
        }
        let springs = json(&Spring::all_of(&inner.world))?;
        Ok((scene.to_toml(), points::told(py, &inner.world, &inner.palette)?, springs))
    }
}

/// A description as JSON.
pub fn json(it: &impl serde::Serialize) -> PyResult<String> {
    Ok(serde_json::to_string(it).map_err(Failure::from)?)
}

/// The colliders of a world, where they are now.
fn colliders_now(inner: &Inner) -> Vec<Collider> {
    let poses = inner.world.colliders().map(|(_, collider)| collider.pose);
    let moved = |(collider, pose): (&Collider, carom::Pose)| Collider {
        position: pose.position.to_array(),
        rotation: pose.rotation.to_array(),
        ..collider.clone()
    };
    inner.described.colliders.iter().zip(poses).map(moved).collect()
}

/// The spheres of a world, each with its own colour if it has one.
fn spheres_now(inner: &Inner) -> Vec<Sphere> {
    let spheres = inner.world.spheres();
    let paint = |id: &SphereId| inner.palette.own(id.number());
    let rows = spheres.ids().iter().enumerate();
    rows.map(|(i, id)| described(&spheres.get(i), paint(id))).collect()
}

/// A sphere as scene files write it.
fn described(sphere: &carom::Sphere, paint: Paint) -> Sphere {
    Sphere::of(sphere).painted(paint)
}
