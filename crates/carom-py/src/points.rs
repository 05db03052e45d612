//! Passes many spheres between Python and scenes as arrays, without text or an object for each.

use carom::{DVec3, Sphere, World};
use carom_scene::scene::{self, Finish};
use carom_scene::{Paint, Palette};
use numpy::{PyArray1, PyArrayDyn, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arguments;
use crate::arrays::shaped;
use crate::failure::Failure;
use crate::quantity::{Column, Quantity};
use crate::setting::{Label, sphere_at};

/// Number of spheres; their quantities in the order of [`Quantity::OF_A_SPHERE`], with the defaults
/// of [`carom::Sphere::new`] for missing ones; red, green and blue of each, NaN if it has no
/// colour; finishes; labels in the order of [`Label::ALL`].
pub type Given<'py> = (
    usize,
    [Option<Bound<'py, PyAny>>; Quantity::OF_A_SPHERE.len()],
    Option<Bound<'py, PyAny>>,
    Option<Vec<String>>,
    [Option<PyReadonlyArray1<'py, u64>>; Label::ALL.len()],
);

/// Quantities, colours, finishes and labels as in [`Given`].
pub type SphereColumns<'py> = (
    Vec<Bound<'py, PyArrayDyn<f64>>>,
    Option<Bound<'py, PyArrayDyn<f64>>>,
    Option<Vec<String>>,
    Vec<Option<Bound<'py, PyArray1<u64>>>>,
);

/// Reads the given spheres and the look of each.
///
/// # Errors
/// As [`arguments::array`], and [`Failure`] for an unknown finish, or a label with too many bits.
pub fn read(
    (count, quantities, colors, finishes, labels): Given<'_>,
) -> PyResult<(Vec<Sphere>, Vec<Paint>)> {
    let read = |(quantity, values): (Quantity, Option<_>)| {
        let array = |values| arguments::array(quantity.name(), &values, &quantity.shape(count));
        Some(array(values?).map(|values| (quantity, values)))
    };
    let given = Quantity::OF_A_SPHERE.into_iter().zip(quantities);
    let columns: Vec<Column> = given.filter_map(read).collect::<PyResult<_>>()?;
    let mut spheres: Vec<Sphere> = (0..count).map(|index| sphere_at(&columns, index)).collect();
    for (label, values) in Label::ALL.into_iter().zip(labels) {
        let Some(values) = values else { continue };
        for (sphere, &value) in spheres.iter_mut().zip(values.as_slice()?) {
            *sphere = label.changed(*sphere, value)?;
        }
    }
    let colors =
        colors.map(|colors| arguments::array("colors", &colors, &[count, 3])).transpose()?;
    let finishes = finishes.unwrap_or_default();
    let finishes = finishes.iter().map(|name| finish(name));
    let finishes: Vec<Finish> = finishes.collect::<Result<_, Failure>>()?;
    let paint = |index: usize| {
        let color = colors.as_ref().map(|all| [0, 1, 2].map(|part| all[3 * index + part]));
        let color = color.filter(|color| !color[0].is_nan());
        Paint { color, finish: finishes.get(index).copied().unwrap_or_default() }
    };
    Ok((spheres, (0..count).map(paint).collect()))
}

/// Returns spheres in the form of scenes.
pub fn described((spheres, paints): (Vec<Sphere>, Vec<Paint>)) -> Vec<scene::Sphere> {
    let both = spheres.iter().zip(paints);
    both.map(|(sphere, paint)| scene::Sphere::of(sphere).painted(paint)).collect()
}

/// Returns all spheres of a world as arrays.
///
/// # Errors
/// If NumPy has no memory for them.
pub fn columns<'py>(
    py: Python<'py>,
    world: &World,
    palette: &Palette,
) -> PyResult<SphereColumns<'py>> {
    let spheres = world.spheres();
    let array = |quantity: Quantity| {
        let shape = quantity.shape(spheres.len());
        let mut values = vec![0.0; shape.iter().product()];
        quantity.write(spheres, &mut values);
        shaped(py, values, shape)
    };
    let arrays = Quantity::OF_A_SPHERE.into_iter().map(array).collect::<PyResult<_>>()?;
    let paints: Vec<Paint> = spheres.ids().iter().map(|id| palette.own(id.number())).collect();
    let color = |paint: &Paint| paint.color.unwrap_or([f64::NAN; 3]);
    let has_colors = paints.iter().any(|paint| paint.color.is_some());
    let colors = has_colors.then(|| paints.iter().flat_map(color).collect());
    let colors = colors.map(|all| shaped(py, all, vec![spheres.len(), 3])).transpose()?;
    let has_finishes = paints.iter().any(|paint| paint.finish != Finish::default());
    let finishes = has_finishes.then(|| paints.iter().map(|paint| name(paint.finish)).collect());
    let finishes = finishes.transpose()?;
    let labels = Label::ALL.into_iter().map(|label| {
        let values = (0..spheres.len()).map(|index| label.of(&spheres.get(index)));
        let values: Vec<u64> = values.collect();
        let usual = label.of(&Sphere::new(DVec3::ZERO, 1.0));
        values.iter().any(|&value| value != usual).then(|| PyArray1::from_vec(py, values))
    });
    let labels = labels.collect();
    Ok((arrays, colors, finishes, labels))
}

fn finish(name: &str) -> Result<Finish, Failure> {
    let text = serde_json::Value::String(name.to_owned());
    serde_json::from_value(text).map_err(|error| Failure::value("finishes", error))
}

fn name(finish: Finish) -> Result<String, Failure> {
    let text = serde_json::to_value(finish)?;
    Ok(text.as_str().unwrap_or_default().to_owned())
}
