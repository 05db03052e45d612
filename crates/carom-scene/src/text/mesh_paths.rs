//! Paths of mesh files, which are relative to the file that names them.

use std::path::Path;

use toml::{Table, Value};

/// Makes the paths of meshes in the table of a scene file those that lead to them from where the program runs.
pub(super) fn resolve(table: &mut Table, file: &Path) {
    let folder = file.parent().unwrap_or(Path::new(""));
    let lists = ["colliders", "generators"].map(|list| table.remove(list).map(|it| (list, it)));
    for (list, mut value) in lists.into_iter().flatten() {
        for element in value.as_array_mut().into_iter().flatten() {
            if list == "colliders" {
                resolve_shape(element, folder);
                continue;
            }
            let generators = element.as_table_mut().into_iter().flat_map(|it| it.iter_mut());
            for (_, generator) in generators {
                generator.get_mut("collider").into_iter().for_each(|it| resolve_shape(it, folder));
            }
        }
        table.insert(list.to_owned(), value);
    }
}

fn resolve_shape(collider: &mut Value, folder: &Path) {
    let mesh = collider.get_mut("shape").and_then(|shape| shape.get_mut("mesh"));
    let path = match mesh {
        Some(path @ Value::String(_)) => Some(path),
        Some(mesh) => mesh.get_mut("file"),
        None => None,
    };
    if let Some(Value::String(path)) = path {
        *path = folder.join(&*path).display().to_string();
    }
}
