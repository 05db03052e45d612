//! Finds all faults of a scene at once.

use std::collections::BTreeMap;
use std::path::Path;

use toml::de::DeTable;
use toml::{Table, Value};

use super::source::of_syntax;
use super::{SceneText, include, place_of};
use crate::budget::Budget;
use crate::error::{Fault, Problem, SceneError};
use crate::parameters;
use crate::scene::Scene;
use crate::table::read;
use crate::wording::SAYS_NOTHING;

/// Most faults in a list: later ones probably follow from earlier ones.
const MOST: usize = 20;
/// Bytes of text that are read in all to find faults; each fault costs one more reading of the
/// scene.
const BYTES: usize = 4_000_000;

impl Scene {
    /// Lists the faults in the text of a scene, within `budget`; see [`SceneText::faults`].
    pub fn faults(text: &str, source_name: &str, budget: Budget) -> Vec<Fault> {
        let (_, errors) = DeTable::parse_recoverable(text);
        if !errors.is_empty() {
            let of_syntax = |error: &toml::de::Error| of_syntax(source_name, text, error);
            let mut faults: Vec<Fault> = errors.iter().map(of_syntax).take(MOST).collect();
            // The parser continues after an error and may report it again.
            faults.dedup();
            return faults;
        }
        match SceneText::new(text, source_name) {
            Ok(text) => text.within(budget).faults(),
            Err(SceneError::Invalid(fault)) => vec![fault],
            Err(_) => Vec::new(),
        }
    }

    /// Lists the faults in a scene file and the files that it includes, within `budget`; see
    /// [`SceneText::faults`].
    ///
    /// # Errors
    /// [`SceneError`] if the file cannot be read.
    pub fn faults_of_file(path: &Path, budget: Budget) -> Result<Vec<Fault>, SceneError> {
        match SceneText::from_file_within(path, budget) {
            Ok(text) => Ok(text.faults()),
            // If a single file is no TOML, list all errors of its syntax.
            Err(SceneError::Invalid(fault)) if fault.source_name == path.display().to_string() => {
                let text = include::read_within(path, budget.bytes).unwrap_or_default();
                let faults = Self::faults(&text, &fault.source_name, budget);
                Ok(if faults.len() > 1 { faults } else { vec![fault] })
            }
            Err(SceneError::Invalid(fault)) => Ok(vec![fault]),
            Err(error) => Err(error),
        }
    }
}

impl SceneText {
    /// Lists faults in the order of lines: at most twenty, fewer for a text of more than 200 kB;
    /// none if [`Self::scene`] succeeds. Each sphere, collider and other element is listed with its
    /// first fault.
    ///
    /// ```
    /// use carom_scene::SceneText;
    ///
    /// let text = "name = 'two'\n[[spheres]]\nradus = 1\n[[spheres]]\nradius = -1\n";
    /// let faults = SceneText::new(text, "two.toml")?.faults();
    /// let lines: Vec<_> = faults.iter().filter_map(|fault| fault.line).collect();
    /// assert_eq!(lines, [3, 5]);
    /// # Ok::<(), carom_scene::SceneError>(())
    /// ```
    pub fn faults(&self) -> Vec<Fault> {
        let mut table = self.table.clone();
        let mut originals = originals(&table);
        let (mut faults, mut taken): (Vec<Fault>, Vec<String>) = Default::default();
        let bytes: usize = self.sources.iter().map(|source| source.text.len()).sum();
        let most = (BYTES / bytes.max(1)).clamp(1, MOST);
        // Faults that follow from known ones cost a reading, too.
        let mut tries = 10 * most;
        while faults.len() < most
            && tries > 0
            && let Err(problem) = read(table.clone(), self.budget)
        {
            tries -= 1;
            let field = as_written(&problem.field, &originals);
            let problem = Problem { field, ..problem };
            let found = self.fault(&problem);
            // A field that this loop removed is no fault of the file.
            let is_our_doing = missing(&problem).is_some_and(|field| taken.contains(&field))
                || is_emptied(&problem, &taken);
            let is_known = faults.contains(&found);
            if !(is_known || is_our_doing) {
                faults.push(found);
            }
            taken.extend([problem.field.clone(), place_of(&problem).join(".")]);
            let is_gone = if problem.field == "name" {
                table.insert("name".to_owned(), Value::from("any")).is_some()
            } else {
                take_out(&mut table, &problem, &mut originals)
            };
            if is_known || !is_gone {
                break;
            }
        }
        // Faults of the file itself come first.
        let is_included = |fault: &Fault| fault.source_name != self.name();
        faults.sort_by_key(|fault| (is_included(fault), fault.source_name.clone(), fault.line));
        faults
    }
}

/// Path of the missing field or parameter, if that is the problem.
fn missing(problem: &Problem) -> Option<String> {
    if let Some(rest) = problem.problem.strip_prefix("unknown name `") {
        return Some(format!("{}.{}", parameters::TABLE, rest.split('`').next()?));
    }
    let name = problem.problem.strip_prefix("missing field `")?.split('`').next()?;
    Some(if problem.field.is_empty() {
        name.to_owned()
    } else {
        format!("{}.{name}", problem.field)
    })
}

/// Whether a table is empty only because this module removed its fields.
fn is_emptied(problem: &Problem, taken: &[String]) -> bool {
    let is_in = |field: &String| field.strip_prefix(&problem.field)?.strip_prefix('.').map(drop);
    problem.problem.starts_with(SAYS_NOTHING) && taken.iter().any(|field| is_in(field).is_some())
}

/// Remaining elements of each list, by their indices in the file.
type Originals = BTreeMap<String, Vec<usize>>;

fn originals(table: &Table) -> Originals {
    let lists = table.iter().filter_map(|(name, value)| Some((name, value.as_array()?)));
    lists.map(|(name, list)| (name.clone(), (0..list.len()).collect())).collect()
}

/// Converts a path in the remaining table to the path in the file.
fn as_written(field: &str, originals: &Originals) -> String {
    let Some((list, rest)) = field.split_once('[') else { return field.to_owned() };
    let Some((place, rest)) = rest.split_once(']') else { return field.to_owned() };
    let original = originals.get(list).zip(place.parse().ok());
    match original.and_then(|(left, place): (_, usize)| left.get(place)) {
        Some(original) => format!("{list}[{original}]{rest}"),
        None => field.to_owned(),
    }
}

/// Removes the cause of a problem: a whole element of a list, or the field alone. Returns whether
/// it removed something.
fn take_out(table: &mut Table, problem: &Problem, originals: &mut Originals) -> bool {
    // An element that lacks a field is removed as a whole.
    let path = place_of(problem);
    let Some(first) = path.first().cloned() else { return false };
    if let (Some(Value::Array(list)), Some(left)) =
        (table.get_mut(&first), originals.get_mut(&first))
    {
        let place = path.get(1).and_then(|place| place.parse::<usize>().ok());
        let place = place.and_then(|original| left.iter().position(|it| *it == original));
        let Some(place) = place else { return table.remove(&first).is_some() };
        left.remove(place);
        list.remove(place);
        return true;
    }
    take_out_of(table, &path) || table.remove(&first).is_some()
}

/// Removes the field at the end of a path from nested tables; returns whether it existed.
fn take_out_of(table: &mut Table, path: &[String]) -> bool {
    match path {
        [] => false,
        [name] => table.remove(name).is_some(),
        [name, rest @ ..] => match table.get_mut(name) {
            Some(Value::Table(inner)) => take_out_of(inner, rest) || table.remove(name).is_some(),
            Some(_) => table.remove(name).is_some(),
            None => false,
        },
    }
}
