//! Dense packings and fluids, for `carom.pack`.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use carom::Boundary;
use carom_scene::pack::{Packed, Recipe, Sizes};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::shaped;
use crate::failure::Failure;
use crate::stop::Watch;
use crate::threads::among_all;

/// Returns the radii of spheres of these sizes [m], as `carom pack --sizes` draws them.
#[pyfunction]
pub fn radii_of_sizes<'py>(
    py: Python<'py>,
    sizes: &str,
    count: usize,
    seed: u64,
) -> Result<Bound<'py, PyArray1<f64>>, Failure> {
    let sizes: Sizes = sizes.parse().map_err(|problem| Failure::value("sizes", problem))?;
    Ok(sizes.radii(count, seed).into_pyarray(py))
}

/// Packs spheres with these radii [m]; returns what `carom.Packing` has, by name.
#[pyfunction]
pub fn pack_spheres<'py>(
    py: Python<'py>,
    radii: Vec<f64>,
    packing_fraction: f64,
    seed: u64,
    growth: f64,
    pressure: Option<f64>,
    equilibrate: Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let recipe = Recipe { radii, seed, packing_fraction, pressure, growth, equilibrate };
    let watch = Watch::begin();
    let count = recipe.radii.len();
    let packed = py.detach(|| {
        among_all(count, &watch, || {
            let mut world = recipe.start()?;
            world.set_stop_request(Some(watch.request()));
            recipe.pack(world)
        })
    });
    let packed = packed.map_err(Failure::from)?;
    if let Some(shortfall) = packed.shortfall(&recipe) {
        let problem = format!("{shortfall}: a smaller `growth` packs denser");
        return Err(Failure::value("packing_fraction", problem).into());
    }
    described(py, &packed)
}

fn described<'py>(py: Python<'py>, packed: &Packed) -> PyResult<Bound<'py, PyDict>> {
    let Packed { world, compressed, fluid, rattlers } = packed;
    let spheres = world.spheres();
    let count = spheres.len();
    let rows = |vectors: &[carom::DVec3]| {
        let values = vectors.iter().flat_map(|it| it.to_array()).collect();
        shaped(py, values, vec![count, 3])
    };
    let size = match world.settings().boundary {
        Boundary::Periodic { size } => size.to_array(),
        Boundary::Open => [f64::INFINITY; 3],
    };
    let values = PyDict::new(py);
    values.set_item("positions", rows(spheres.positions())?)?;
    values.set_item("velocities", rows(spheres.velocities())?)?;
    values.set_item("radii", PyArray1::from_slice(py, spheres.radii()))?;
    values.set_item("masses", PyArray1::from_slice(py, spheres.masses()))?;
    values.set_item("box", PyArray1::from_slice(py, &size))?;
    values.set_item("packing_fraction", compressed.packing_fraction)?;
    values.set_item("pressure", fluid.pressure)?;
    values.set_item("collision_rate", fluid.collision_rate)?;
    values.set_item("collisions", compressed.collisions)?;
    values.set_item("rattlers", *rattlers)?;
    values.set_item("state_hash", world.state_hash().to_string())?;
    Ok(values)
}
