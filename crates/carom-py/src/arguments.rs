//! Reads single arguments from Python; every error names its argument.

use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::{PyException, PyOverflowError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyTuple};

use crate::failure::Failure;

/// Reads anything that NumPy turns into an array of numbers, broadcasts it to `shape`, and returns
/// it in C order.
///
/// # Errors
/// `TypeError` if they are no numbers, [`Failure`] for another shape; both name the argument
/// `name`.
pub fn array(name: &str, values: &Bound<'_, PyAny>, shape: &[usize]) -> PyResult<Vec<f64>> {
    // What programs pass in each step needs no conversion.
    if let Ok(array) = values.cast::<PyArrayDyn<f64>>()
        && array.shape() == shape
        && let Ok(array) = array.try_readonly()
        && let Ok(numbers) = array.as_slice()
    {
        return Ok(numbers.to_vec());
    }
    let numpy = values.py().import("numpy")?;
    let no_numbers = |what: &str| {
        let message = format!("{name}: must be an array of numbers, not {what}");
        PyTypeError::new_err(message)
    };
    let py = values.py();
    let array = numpy.call_method1("asarray", (values,)).map_err(|error| {
        unless_stopped(py, error, || no_numbers("a list of rows of different lengths"))
    })?;
    let dtype = array.getattr("dtype")?;
    // Floating-point numbers, signed and unsigned integers.
    if !["f", "i", "u"].contains(&dtype.getattr("kind")?.extract::<String>()?.as_str()) {
        return Err(no_numbers(&format!("of {dtype}")));
    }
    let own: Vec<usize> = array.getattr("shape")?.extract()?;
    let spread = numpy.call_method1("broadcast_to", (&array, shape.to_vec()));
    let spread = spread.map_err(|error| {
        let (wanted, own) = (written(shape), written(&own));
        unless_stopped(py, error, || {
            Failure::value(name, format_args!("must be of shape {wanted}, not {own}")).into()
        })
    })?;
    let numbers =
        spread.call_method1("astype", ("float64", "C"))?.cast_into::<PyArrayDyn<f64>>()?;
    Ok(numbers.to_vec()?)
}

/// Returns the error about an argument, or the KeyboardInterrupt that arrived during a NumPy call.
fn unless_stopped(py: Python<'_>, error: PyErr, refusal: impl FnOnce() -> PyErr) -> PyErr {
    if error.is_instance_of::<PyException>(py) { refusal() } else { error }
}

/// Reads a number.
///
/// # Errors
/// `TypeError` if it is none.
pub fn number(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    if value.is_instance_of::<PyBool>() {
        return Err(wrong_kind(name, "a number", value));
    }
    value.extract().map_err(|_| wrong_kind(name, "a number", value))
}

/// Reads an optional number.
///
/// # Errors
/// As [`number`].
pub fn optional_number(name: &str, value: Option<&Bound<'_, PyAny>>) -> PyResult<Option<f64>> {
    value.map(|value| number(name, value)).transpose()
}

/// Reads a count.
///
/// # Errors
/// `TypeError` if it is no whole number, [`Failure`] if it is negative or too large.
pub fn count(name: &str, value: &Bound<'_, PyAny>) -> PyResult<u64> {
    let py = value.py();
    if value.is_instance_of::<PyBool>() {
        return Err(wrong_kind(name, "a whole number", value));
    }
    value.extract().map_err(|error: PyErr| match error.is_instance_of::<PyOverflowError>(py) {
        true => Failure::value(name, format_args!("must be in [0, 2^64), not {value}")).into(),
        false => wrong_kind(name, "a whole number", value),
    })
}

/// Reads an id; `kind` is what it identifies, for example `"sphere"`.
///
/// # Errors
/// `TypeError` if it is no whole number, [`Failure`] if it cannot be an id.
pub fn id(kind: &str, value: &Bound<'_, PyAny>) -> PyResult<u64> {
    let py = value.py();
    value.extract().map_err(|error: PyErr| match error.is_instance_of::<PyOverflowError>(py) {
        true => Failure::unknown(kind, value).into(),
        false => wrong_kind("id", "a whole number", value),
    })
}

/// Refuses positional arguments of `method`; `example` shows the call with names.
///
/// # Errors
/// `TypeError` if there are any.
pub fn none_unnamed(method: &str, unnamed: &Bound<'_, PyTuple>, example: &str) -> PyResult<()> {
    if unnamed.is_empty() {
        return Ok(());
    }
    let given = unnamed.get_item(0)?.repr()?;
    let message = format!("{method}({given}): say what {given} is by its name, like {example}");
    Err(PyTypeError::new_err(message))
}

fn wrong_kind(name: &str, wanted: &str, value: &Bound<'_, PyAny>) -> PyErr {
    let kind = value.get_type();
    let kind = kind.name().map_or_else(|_| "something else".to_owned(), |it| it.to_string());
    PyTypeError::new_err(format!("{name}: must be {wanted}, not {kind}"))
}

/// Formats a shape as Python does.
fn written(shape: &[usize]) -> String {
    let lengths: Vec<String> = shape.iter().map(ToString::to_string).collect();
    match lengths.as_slice() {
        [one] => format!("({one},)"),
        all => format!("({})", all.join(", ")),
    }
}
