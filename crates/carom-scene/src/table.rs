//! The table of a scene file to a scene.

use toml::{Table, Value};

use crate::error::Problem;
use crate::parameters;
use crate::scene::Scene;
use crate::wording::{in_plain_words, with_names};
use crate::world;

/// A scene from its table, or the first problem with it.
pub(crate) fn read(mut table: Table) -> Result<Scene, Problem> {
    parameters::resolve(&mut table)?;
    let scene: Scene = serde_path_to_error::deserialize(Value::Table(table)).map_err(|error| {
        let path = error.path().to_string();
        let path = if path == "." { String::new() } else { path };
        let problem = in_plain_words(error.into_inner().message().trim());
        // The reader knows the fields of a scene, from which parameters have been taken out.
        let problem = with_names(problem, &path, [parameters::TABLE]);
        Problem::new(path, problem)
    })?;
    world::build(&scene)?;
    Ok(scene)
}
