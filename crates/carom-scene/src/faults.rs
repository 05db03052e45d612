//! All faults of a scene file at once.

use std::collections::BTreeMap;

use toml::de::DeTable;
use toml::{Table, Value};

use crate::error::{Fault, Problem};
use crate::load::{fault, line_at, line_of, named, place_of, read};
use crate::scene::Scene;

/// Faults of one file in a list, at most: those after them are likely to follow from them.
const MOST: usize = 20;

impl Scene {
    /// What is wrong with a scene file, in the order of its lines, up to twenty faults; nothing if
    /// [`Self::from_toml`] reads it. Of each sphere, collider and so on, it is the first fault.
    ///
    /// ```
    /// use carom_scene::Scene;
    ///
    /// let text = "name = 'two'\n[[spheres]]\nradus = 1\n[[spheres]]\nradius = -1\n";
    /// let faults = Scene::faults(text, "two.toml");
    /// let lines: Vec<_> = faults.iter().filter_map(|fault| fault.line).collect();
    /// assert_eq!(lines, [3, 5]);
    /// ```
    pub fn faults(text: &str, source_name: &str) -> Vec<Fault> {
        let (document, errors) = DeTable::parse_recoverable(text);
        if !errors.is_empty() {
            let of_syntax = |error: &toml::de::Error| {
                let line = error.span().map(|span| line_at(text, span.start));
                fault(source_name, line, "", error.message())
            };
            return errors.iter().map(of_syntax).take(MOST).collect();
        }
        let mut table = match named(text, source_name) {
            Ok(table) => table,
            Err(error) => return vec![fault(source_name, None, "", error.message())],
        };
        let mut originals = originals(&table);
        let (mut faults, mut taken): (Vec<Fault>, Vec<String>) = Default::default();
        while faults.len() < MOST
            && let Err(problem) = read(table.clone())
        {
            let field = as_written(&problem.field, &originals);
            let problem = Problem { field, ..problem };
            let line = line_of(&document, text, &problem);
            let found = fault(source_name, line, &problem.field, &problem.problem);
            // What was taken out is missing now.
            let is_our_doing = missing(&problem).is_some_and(|field| taken.contains(&field));
            let is_known = faults.contains(&found);
            if !(is_known || is_our_doing) {
                faults.push(found);
            }
            taken.push(problem.field.clone());
            let is_gone = if problem.field == "name" {
                table.insert("name".to_owned(), Value::from("any")).is_some()
            } else {
                take_out(&mut table, &problem, &mut originals)
            };
            if is_known || !is_gone {
                break;
            }
        }
        faults.sort_by_key(|fault| fault.line);
        faults
    }
}

/// The path of the field that is missing, where that is the problem.
fn missing(problem: &Problem) -> Option<String> {
    let name = problem.problem.strip_prefix("missing field `")?.split('`').next()?;
    Some(if problem.field.is_empty() {
        name.to_owned()
    } else {
        format!("{}.{name}", problem.field)
    })
}

/// For each list of the table, which elements of it are left, by their places in the file.
type Originals = BTreeMap<String, Vec<usize>>;

fn originals(table: &Table) -> Originals {
    let lists = table.iter().filter_map(|(name, value)| Some((name, value.as_array()?)));
    lists.map(|(name, list)| (name.clone(), (0..list.len()).collect())).collect()
}

/// The path of a field in the file, from the one in what is left of it.
fn as_written(field: &str, originals: &Originals) -> String {
    let Some((list, rest)) = field.split_once('[') else { return field.to_owned() };
    let Some((place, rest)) = rest.split_once(']') else { return field.to_owned() };
    let original = originals.get(list).zip(place.parse().ok());
    match original.and_then(|(left, place): (_, usize)| left.get(place)) {
        Some(original) => format!("{list}[{original}]{rest}"),
        None => field.to_owned(),
    }
}

/// Takes out what a problem is about: a whole element of a list, or else the field alone. Returns
/// whether there was anything.
fn take_out(table: &mut Table, problem: &Problem, originals: &mut Originals) -> bool {
    // Of what lacks a field, all goes.
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

/// Takes the field at the end of a path out of tables in tables, if it is there.
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
