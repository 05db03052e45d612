//! The parameters of a scene file, the formulas in which they occur, and numbers with units.
//!
//! A string that begins with `=` is a formula, wherever a number may stand, and one like `5 cm` a number with
//! a unit; its number takes its place before the scene is read.

use toml::{Table, Value};

use crate::error::Problem;
use crate::formula::{self, Names};
use crate::units::{self, Place};

/// The table of the parameters.
pub(crate) const TABLE: &str = "parameters";

/// Fields of a scene that are for people: what stands there is never a formula.
const TEXTS: [&str; 4] = ["name", "title", "description", "origin"];

/// What a string begins with that is a formula.
const MARK: char = '=';

/// Whole numbers up to this one are written as such: beyond, not every one is a number of 64 bits.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// Takes the parameters out of a scene, and puts numbers in the place of its formulas and of its numbers with
/// units. Gives the values of the parameters.
pub(crate) fn resolve(scene: &mut Table) -> Result<Vec<(String, f64)>, Problem> {
    let known = match scene.remove(TABLE) {
        Some(Value::Table(table)) => values(table)?,
        Some(_) => return Err(Problem::new(TABLE, "is no table of numbers")),
        None => Vec::new(),
    };
    let mut fields = scene.iter_mut().filter(|(name, _)| !TEXTS.contains(&name.as_str()));
    fields.try_for_each(|(name, value)| replace(value, name, &known))?;
    Ok(known)
}

/// What is wrong with a field of the scene itself, with the parameters among the names that an unknown one
/// may be meant for.
pub(crate) fn or_parameter(mut problem: String, known: &Names) -> String {
    if problem.starts_with("unknown field ") {
        known.iter().for_each(|(name, _)| problem.push_str(&format!(", `{name}`")));
    }
    problem
}

/// The values of the parameters, each computed from those before it.
fn values(table: Table) -> Result<Vec<(String, f64)>, Problem> {
    let mut known: Vec<(String, f64)> = Vec::new();
    for (name, mut value) in table {
        let path = format!("{TABLE}.{name}");
        if !formula::is_name(&name) {
            let problem = "a name has letters, digits and _, and begins with no digit";
            return Err(Problem::new(path, problem));
        }
        if formula::is_taken(&name) {
            return Err(Problem::new(path, format!("\"{name}\" has a meaning in formulas")));
        }
        replace(&mut value, &path, &known)?;
        let number = match value {
            Value::Integer(number) => number as f64,
            Value::Float(number) if number.is_finite() => number,
            Value::Float(number) => return Err(Problem::new(path, format!("is {number}"))),
            _ => {
                let problem = "is neither a number, like \"5 cm\", nor a formula, like \"=2*r\"";
                return Err(Problem::new(path, problem));
            }
        };
        known.push((name, number));
    }
    Ok(known)
}

/// Puts numbers in the place of the formulas and the numbers with units in a value at a path.
fn replace(value: &mut Value, path: &str, known: &Names) -> Result<(), Problem> {
    match value {
        Value::String(text) => {
            let number = match text.strip_prefix(MARK) {
                Some(formula) => Some(formula::evaluate(formula.trim(), known)),
                None => units::in_unit_of(place_of(path), text),
            };
            if let Some(number) = number {
                *value = in_toml(number.map_err(|problem| Problem::new(path, problem))?);
            }
        }
        Value::Array(array) => {
            for (i, element) in array.iter_mut().enumerate() {
                replace(element, &format!("{path}[{i}]"), known)?;
            }
        }
        Value::Table(table) => {
            for (name, value) in table.iter_mut() {
                replace(value, &format!("{path}.{name}"), known)?;
            }
        }
        _ => {}
    }
    Ok(())
}

/// The field at a path, or that of the list in which an element is.
fn place_of(path: &str) -> Place<'_> {
    let field = path.rsplit('.').next().unwrap_or_default();
    match path.split_once('.') {
        Some((TABLE, _)) => Place::Parameter,
        _ => Place::Field(field.split('[').next().unwrap_or_default()),
    }
}

/// A number as a file would have it: without a point where it is whole, for what counts something.
fn in_toml(number: f64) -> Value {
    let is_whole = number == number.trunc() && number.abs() <= LARGEST_WHOLE;
    if is_whole { Value::Integer(number as i64) } else { Value::Float(number) }
}
