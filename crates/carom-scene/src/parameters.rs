//! Parameters of a scene file, the formulas that use them, and numbers with units.
//!
//! Wherever a number may stand, a string that starts with `=` is a formula, and one like `5 cm` is
//! a number with a unit. Both are replaced by their values before the scene is read.

use toml::{Table, Value};

use crate::color_text;
use crate::error::Problem;
use crate::formula::{self, FormulaError, NamedValues};
use crate::units::{self, Place};

/// Name of the table of parameters.
pub(crate) const TABLE: &str = "parameters";

/// Fields with text for people, and names of parts: they are never read as formulas.
const TEXTS: [&str; 5] = [NAME, "title", "description", "origin", "try"];
const NAME: &str = "name";

/// Most parameters: each name in a formula is searched among all of them.
const MOST: usize = 1000;

/// First character of a string that is a formula.
const MARK: char = '=';

/// Largest value written as a whole number: above 2^53, an f64 cannot represent every whole number.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// A number to which a scene file gives a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Name by which formulas refer to it.
    pub name: String,
    /// Value in SI units.
    pub value: f64,
    /// Whether the file states it as a formula.
    pub is_formula: bool,
    /// Whether the file states it as a whole number, as a count must be.
    pub is_whole: bool,
}

/// Returns the parameters of a scene in the order of the file.
pub(crate) fn list(scene: &Table) -> Result<Vec<Parameter>, Problem> {
    let Some(Value::Table(table)) = scene.get(TABLE) else { return Ok(Vec::new()) };
    let written = table.values().map(|value| {
        let is_formula = value.as_str().is_some_and(|text| text.starts_with(MARK));
        (is_formula, value.is_integer())
    });
    let known = values(table)?.into_iter().zip(written);
    let list = known.map(|((name, value), (is_formula, is_whole))| Parameter {
        name,
        value,
        is_formula,
        is_whole,
    });
    Ok(list.collect())
}

/// Removes the table of parameters from a scene, and replaces formulas, numbers with units and
/// colours by their values.
pub(crate) fn resolve(scene: &mut Table) -> Result<(), Problem> {
    let known = match scene.remove(TABLE) {
        Some(Value::Table(table)) => values(&table)?,
        Some(_) => return Err(Problem::new(TABLE, "is no table of numbers")),
        None => Vec::new(),
    };
    let mut fields = scene.iter_mut().filter(|(name, _)| !TEXTS.contains(&name.as_str()));
    fields.try_for_each(|(name, value)| {
        replace(value, Place::Field(name), &known).map_err(|problem| problem.below(name))
    })
}

/// Returns the values of the parameters in the order of the file. A formula may use a parameter
/// that follows it.
fn values(table: &Table) -> Result<Vec<(String, f64)>, Problem> {
    if table.len() > MOST {
        return Err(Problem::new(TABLE, format!("has more than {MOST} parameters")));
    }
    let mut known: Vec<(String, f64)> = Vec::new();
    for name in table.keys() {
        find(name, table, &mut known, &mut Vec::new())?;
    }
    let place = |name: &String| table.keys().position(|it| it == name);
    known.sort_by_cached_key(|(name, _)| place(name));
    Ok(known)
}

/// Computes a parameter, after those that its formula uses. `way` lists the parameters that wait
/// for it, to detect circles.
fn find<'a>(
    name: &'a str,
    table: &'a Table,
    known: &mut Vec<(String, f64)>,
    way: &mut Vec<&'a str>,
) -> Result<(), Problem> {
    let is_known = |known: &[(String, f64)]| known.iter().any(|(it, _)| it == name);
    way.push(name);
    while !is_known(known) {
        match value_of(name, &table[name], known) {
            Ok(number) => known.push((name.to_owned(), number)),
            Err(error) => {
                let fault = |problem: String| Problem::new(format!("{TABLE}.{name}"), problem);
                let other = match &error {
                    FormulaError::UnknownName { name: other, .. } => table.get_key_value(other),
                    FormulaError::Other(_) => None,
                };
                let Some((other, _)) = other else { return Err(fault(error.to_string())) };
                if way.contains(&other.as_str()) {
                    return Err(fault(format!("\"{name}\" follows from itself, by \"{other}\"")));
                }
                find(other, table, known, way)?;
            }
        }
    }
    way.pop();
    Ok(())
}

/// Computes the value of a parameter; `known` has the parameters that its formula may use.
fn value_of(name: &str, value: &Value, known: &NamedValues) -> Result<f64, FormulaError> {
    let wrong = |problem: &str| Err(FormulaError::Other(problem.to_owned()));
    if !formula::is_name(name) {
        return wrong("a name has letters, digits and _, and begins with no digit");
    }
    if formula::is_taken(name) {
        return wrong(&format!("\"{name}\" has a meaning in formulas"));
    }
    match value {
        Value::Integer(number) => Ok(*number as f64),
        Value::Float(number) if number.is_finite() => Ok(*number),
        Value::Float(number) => wrong(&format!("must be a finite number, not {number}")),
        Value::String(text) => number_in(text, Place::Parameter, known).unwrap_or_else(|| {
            wrong("is neither a number, like \"5 cm\", nor a formula, like \"=2*r\"")
        }),
        _ => wrong("must be a number"),
    }
}

/// Returns the number of a formula or of a number with a unit; `None` for any other text.
fn number_in(text: &str, place: Place, known: &NamedValues) -> Option<Result<f64, FormulaError>> {
    match text.strip_prefix(MARK) {
        Some(formula) => Some(formula::evaluate(formula.trim(), known)),
        None => Some(units::in_unit_of(place, text)?.map_err(FormulaError::Other)),
    }
}

/// Replaces the formulas, numbers with units and colours in a value by numbers. The field of a
/// problem is relative to the value.
fn replace(value: &mut Value, place: Place, known: &NamedValues) -> Result<(), Problem> {
    match value {
        Value::String(text) => {
            if let Some(number) = number_in(text, place, known) {
                *value = in_toml(number.map_err(|error| Problem::new("", error.to_string()))?);
            }
            Ok(())
        }
        Value::Array(array) => array.iter_mut().enumerate().try_for_each(|(i, element)| {
            replace(element, place, known).map_err(|problem| problem.below(&format!("[{i}]")))
        }),
        Value::Table(table) => {
            let table_name = match place {
                Place::Field(name) => Some(name),
                Place::Parameter => None,
            };
            let mut fields = table.iter_mut().filter(|(name, _)| *name != NAME);
            fields.try_for_each(|(name, value)| {
                let color =
                    value.as_str().and_then(|it| color_text::numbers_of(table_name, name, it));
                let replaced = match color {
                    Some(color) => {
                        color.map(|color| *value = color).map_err(|it| Problem::new("", it))
                    }
                    None => replace(value, Place::Field(name), known),
                };
                replaced.map_err(|it| it.below(&format!(".{name}")))
            })
        }
        _ => Ok(()),
    }
}

/// Converts a number to TOML. A whole number becomes an integer, because a field that counts takes
/// no other.
fn in_toml(number: f64) -> Value {
    let is_whole = number == number.trunc() && number.abs() <= LARGEST_WHOLE;
    let is_minus_zero = number == 0.0 && number.is_sign_negative();
    if is_whole && !is_minus_zero { Value::Integer(number as i64) } else { Value::Float(number) }
}
