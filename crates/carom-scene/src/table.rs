//! Converts the table of a scene file to a scene.

use toml::Table;

use crate::budget::Budget;
use crate::deserialize::deserialize;
use crate::error::{Problem, is_much_like, nearest};
use crate::materials;
use crate::parameters;
use crate::scene::{Scene, Simulation};
use crate::wording::{table_expected, with_names};
use crate::world;

/// Name of the field that lists included files.
pub(crate) const INCLUDE: &str = "include";

/// Reads a scene from its table within `budget`; returns the first problem.
pub(crate) fn read(mut table: Table, budget: Budget) -> Result<Scene, Problem> {
    parameters::resolve(&mut table)?;
    materials::fill(&mut table)?;
    let scene: Scene = deserialize(table).map_err(|Problem { field: path, problem }| {
        if let Some(problem) = of_simulation(&problem, &path) {
            return Problem::new(path, problem);
        }
        if let Some((path, problem)) = table_expected(&path, &problem) {
            return Problem::new(path, problem);
        }
        if problem.starts_with("unknown field `include`") {
            return Problem::new(path, "`include` stands before the first table of a file");
        }
        // The deserializer knows only the fields of a scene; add the names that were removed
        // before.
        let problem = with_names(problem, &path, [parameters::TABLE, INCLUDE]);
        Problem::new(path, problem)
    })?;
    world::build(&scene, budget)?;
    Ok(scene)
}

/// Suggests the table `[simulation]` for one of its fields that stands before the first table.
fn of_simulation(problem: &str, path: &str) -> Option<String> {
    let name = problem.strip_prefix("unknown field `")?.split('`').next()?;
    if path.contains(['.', '[']) {
        return None;
    }
    let schema = schemars::schema_for!(Simulation);
    let fields = schema.get("properties")?.as_object()?.keys();
    // If the names are less similar, a field of the scene itself may be meant.
    let meant = nearest(name, fields.map(String::as_str)).filter(|it| is_much_like(name, it))?;
    Some(format!("unknown field `{name}`; \"{meant}\" stands in [simulation]"))
}
