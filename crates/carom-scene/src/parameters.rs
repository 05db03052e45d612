//! The parameters of a scene file, and the formulas in which they occur.
//!
//! A string that begins with `=` is a formula, wherever a number may stand; its number takes its place before
//! the scene is read.

use toml::{Table, Value};

use crate::error::Problem;
use crate::formula::{self, Names};

/// The table of the parameters.
pub(crate) const TABLE: &str = "parameters";

/// Fields of a scene that are for people: what stands there is never a formula.
const TEXTS: [&str; 4] = ["name", "title", "description", "origin"];

/// What a string begins with that is a formula.
const MARK: char = '=';

/// Whole numbers up to this one are written as such: beyond, not every one is a number of 64 bits.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// Takes the parameters out of a scene, and puts numbers in the place of its formulas. Gives the values of the
/// parameters.
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
                let problem = "is neither a number nor a formula, like \"=2*r\"";
                return Err(Problem::new(path, problem));
            }
        };
        known.push((name, number));
    }
    Ok(known)
}

/// Puts numbers in the place of the formulas in a value at a path.
fn replace(value: &mut Value, path: &str, known: &Names) -> Result<(), Problem> {
    match value {
        Value::String(text) => {
            let Some(formula) = text.strip_prefix(MARK) else { return Ok(()) };
            let number = formula::evaluate(formula.trim(), known)
                .map_err(|problem| Problem::new(path, problem))?;
            *value = in_toml(number);
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

/// A number as a file would have it: without a point where it is whole, for what counts something.
fn in_toml(number: f64) -> Value {
    let is_whole = number == number.trunc() && number.abs() <= LARGEST_WHOLE;
    if is_whole { Value::Integer(number as i64) } else { Value::Float(number) }
}
