//! The table of a scene file to a scene.

use serde::de::DeserializeOwned;
use toml::{Table, Value};

use crate::budget::Budget;
use crate::error::{Problem, is_much_like, nearest};
use crate::parameters;
use crate::scene::{Scene, Simulation};
use crate::wording::{in_plain_words, table_expected, with_form, with_names};
use crate::world;

/// The field of a scene file that names the files it includes.
pub(crate) const INCLUDE: &str = "include";

/// A scene within this budget from its table, or the first problem with it.
pub(crate) fn read(mut table: Table, budget: Budget) -> Result<Scene, Problem> {
    parameters::resolve(&mut table)?;
    let scene: Scene = told(table).map_err(|Problem { field: path, problem }| {
        if let Some(problem) = of_simulation(&problem, &path) {
            return Problem::new(path, problem);
        }
        if let Some((path, problem)) = table_expected(&path, &problem) {
            return Problem::new(path, problem);
        }
        if problem.starts_with("unknown field `include`") {
            return Problem::new(path, "`include` stands before the first table of a file");
        }
        // The reader knows the fields of a scene, from which others have been taken out.
        let problem = with_names(problem, &path, [parameters::TABLE, INCLUDE]);
        Problem::new(path, problem)
    })?;
    world::build(&scene, budget)?;
    Ok(scene)
}

/// What a table without formulas and units tells, or what of it cannot be read.
pub(crate) fn told<T: DeserializeOwned>(table: Table) -> Result<T, Problem> {
    serde_path_to_error::deserialize(Value::Table(table)).map_err(|error| {
        let path = error.path().to_string();
        let path = if path == "." { String::new() } else { path };
        let problem = in_plain_words(error.into_inner().message().trim());
        Problem::new(&*path, with_form(problem, &path))
    })
}

/// What to write for a field of the simulation that stands before the first table.
fn of_simulation(problem: &str, path: &str) -> Option<String> {
    let name = problem.strip_prefix("unknown field `")?.split('`').next()?;
    if path.contains(['.', '[']) {
        return None;
    }
    let schema = schemars::schema_for!(Simulation);
    let fields = schema.get("properties")?.as_object()?.keys();
    // Less like it, a name of the scene itself may be meant.
    let meant = nearest(name, fields.map(String::as_str)).filter(|it| is_much_like(name, it))?;
    Some(format!("unknown field `{name}`; \"{meant}\" stands in [simulation]"))
}
