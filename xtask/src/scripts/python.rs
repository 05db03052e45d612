//! Which modules of Python import which, how, and in which order of layers.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use super::Script;
use crate::imports::Import;
use crate::shell::Outcome;

/// The layers of the package, each of which imports those before it alone.
const LAYERS: [&str; 4] = ["carom._scene", "carom._run", "carom._pictures", "carom.notebook"];
/// What every layer may import besides.
const BASE: [&str; 2] = ["carom._carom", "carom.errors"];
/// The module that says what the layers above do for a scene. It names types of theirs in signatures,
/// which imports nothing when it runs.
const FORWARD: &str = "carom._scene.above";
/// What is imported where it is needed, since the package does without it elsewhere.
const OPTIONAL: [&str; 7] =
    ["carom.notebook", "distributed", "pandas", "ray", "scipy", "tqdm", "xarray"];

/// One name that a module imports.
#[derive(Debug, PartialEq, Eq)]
struct Imported {
    /// The module, and the name in it if one is taken from it.
    module: String,
    name: Option<String>,
    line: usize,
    /// Whether it stands in a function.
    is_local: bool,
    /// Whether only those who check types read it.
    is_for_types: bool,
}

/// For each module, those that it imports, by their places among the scripts.
pub fn imports(scripts: &[Script]) -> Vec<BTreeMap<usize, Import>> {
    let modules: Vec<String> = scripts.iter().map(|it| module_of(&it.file)).collect();
    let places: HashMap<&str, usize> =
        modules.iter().enumerate().map(|(place, module)| (module.as_str(), place)).collect();
    let of = |place: usize| {
        let mut found = BTreeMap::new();
        for imported in counted(&scripts[place], &modules[place]) {
            if let Some(&to) = places.get(target(&imported, &places).as_str())
                && to != place
            {
                let path = imported.module.clone();
                found.entry(to).or_insert(Import { path, line: imported.line });
            }
        }
        found
    };
    (0..scripts.len()).map(of).collect()
}

/// Refuses imports of a layer above, and imports in functions of what need not be imported there.
pub fn check_layers(scripts: &[Script]) -> Outcome {
    let faults = faults(scripts);
    if faults.is_empty() { Ok(()) } else { Err(format!("layers:\n{}", faults.join("\n"))) }
}

fn faults(scripts: &[Script]) -> Vec<String> {
    let modules: Vec<String> = scripts.iter().map(|it| module_of(&it.file)).collect();
    let places: HashMap<&str, usize> =
        modules.iter().enumerate().map(|(place, module)| (module.as_str(), place)).collect();
    let mut faults = Vec::new();
    for (script, module) in scripts.iter().zip(&modules).filter(|it| is_in(it.1, "carom")) {
        let layer = LAYERS.iter().position(|layer| is_in(module, layer));
        for imported in counted(script, module) {
            let place = format!("  {}:{}", script.file.display(), imported.line);
            let target = target(&imported, &places);
            if imported.is_local && !OPTIONAL.iter().any(|it| is_in(&target, it)) {
                faults.push(format!("{place} imports {target} in a function"));
            }
            if let Some(layer) = layer
                && is_in(&target, "carom")
                && !LAYERS[..=layer].iter().chain(&BASE).any(|it| is_in(&target, it))
            {
                faults.push(format!("{place}: {} imports {target}", LAYERS[layer]));
            }
        }
    }
    faults
}

/// Whether a module is this one, or in it.
fn is_in(module: &str, package: &str) -> bool {
    module.strip_prefix(package).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// What a module imports, but for names of types in [`FORWARD`]; a compiled module imports nothing.
fn counted(script: &Script, module: &str) -> Vec<Imported> {
    if script.file.extension().is_some_and(|ending| ending == "pyi") {
        return Vec::new();
    }
    let mut found = imported(&script.code(), module, script.file.ends_with("__init__.py"));
    found.retain(|it| !(it.is_for_types && module == FORWARD));
    found
}

/// The module that is imported: the name, where that is one.
fn target(imported: &Imported, places: &HashMap<&str, usize>) -> String {
    let within = imported.name.as_ref().map(|name| format!("{}.{name}", imported.module));
    within.filter(|it| places.contains_key(it.as_str())).unwrap_or_else(|| imported.module.clone())
}

/// What a module is called where it is imported.
fn module_of(file: &Path) -> String {
    let names: Vec<_> = file.iter().map(|name| name.to_string_lossy()).collect();
    let begin = if file.starts_with("python/carom") { 1 } else { names.len() - 1 };
    let mut module = names[begin..].join(".");
    for ending in [".pyi", ".py", ".__init__"] {
        module.truncate(module.strip_suffix(ending).map_or(module.len(), str::len));
    }
    module
}

/// What a module of this name imports.
fn imported(code: &str, module: &str, is_package: bool) -> Vec<Imported> {
    let mut found = Vec::new();
    // The lines that the present one stands in, with their indents.
    let mut blocks: Vec<(usize, &str)> = Vec::new();
    let mut lines = code.lines().enumerate();
    while let Some((number, line)) = lines.next() {
        let text = line.trim();
        if text.is_empty() {
            continue;
        }
        let indent = line.len() - line.trim_start().len();
        while blocks.last().is_some_and(|block| block.0 >= indent) {
            blocks.pop();
        }
        if text.starts_with("from ") || text.starts_with("import ") {
            let mut statement = text.to_owned();
            while statement.matches('(').count() > statement.matches(')').count() {
                let Some((_, next)) = lines.next() else { break };
                statement.push_str(next);
            }
            let is_local = blocks.iter().any(|block| is_function(block.1));
            let is_for_types = blocks.iter().any(|block| block.1 == "if TYPE_CHECKING:");
            for (module, name) in named(&statement, module, is_package) {
                found.push(Imported { module, name, line: number + 1, is_local, is_for_types });
            }
        }
        blocks.push((indent, text));
    }
    found
}

fn is_function(line: &str) -> bool {
    line.starts_with("def ") || line.starts_with("async def ")
}

/// The modules that a statement names, each with a name that is taken from it.
fn named(statement: &str, module: &str, is_package: bool) -> Vec<(String, Option<String>)> {
    let names = |list: &str| -> Vec<String> {
        let list = list.replace(['(', ')'], " ");
        let first = |item: &str| item.split_whitespace().next().map(str::to_owned);
        list.split(',').filter_map(first).collect()
    };
    if let Some(list) = statement.strip_prefix("import ") {
        return names(list).into_iter().map(|module| (module, None)).collect();
    }
    let rest = statement.strip_prefix("from ").unwrap_or_default();
    let Some((from, list)) = rest.split_once(" import ") else { return Vec::new() };
    let from = absolute(from.trim(), module, is_package);
    names(list).into_iter().map(|name| (from.clone(), Some(name))).collect()
}

/// A module's full name, where dots stand for the packages that the importing one is in.
fn absolute(from: &str, module: &str, is_package: bool) -> String {
    let name = from.trim_start_matches('.');
    let dots = from.len() - name.len();
    if dots == 0 {
        return name.to_owned();
    }
    let mut package: Vec<&str> = module.split('.').collect();
    let up = if is_package { dots - 1 } else { dots };
    package.truncate(package.len().saturating_sub(up));
    package.extend(Some(name).filter(|name| !name.is_empty()));
    package.join(".")
}

#[cfg(test)]
mod tests {
    use super::{faults, imported, imports};
    use crate::scripts::Script;

    #[test]
    fn imports_are_found_with_where_they_stand() {
        let code = "import a, b.c as d\nfrom e import (\n    f,\n    g as h,\n)\nif TYPE_CHECKING:\n    \
                    from i import j\ndef k():\n    if True:\n        import l\nfrom . import m\n";
        let found = imported(code, "pack.own", false);
        let told: Vec<String> = found
            .iter()
            .map(|it| {
                let name = it.name.as_deref().unwrap_or("-");
                let marks = [(it.is_local, "local"), (it.is_for_types, "types")];
                let marks: Vec<&str> = marks.iter().filter(|it| it.0).map(|it| it.1).collect();
                format!("{}:{}:{name}:{}", it.line, it.module, marks.join(" "))
            })
            .collect();
        let expected =
            ["1:a:-:", "1:b.c:-:", "2:e:f:", "2:e:g:", "7:i:j:types", "10:l:-:local", "11:pack:m:"];
        assert_eq!(told, expected);
    }

    #[test]
    fn a_name_that_is_a_module_is_what_is_imported() {
        let scripts = [
            Script::of_test("python/carom/__init__.py", ""),
            Script::of_test("python/carom/_carom.pyi", "from carom import one"),
            Script::of_test("python/carom/one.py", "from carom import _carom, other\n"),
            Script::of_test("python/carom/other.py", "from carom.one import name\n"),
        ];
        let found = imports(&scripts);
        let targets: Vec<Vec<usize>> =
            found.iter().map(|it| it.keys().copied().collect()).collect();
        assert_eq!(targets, [vec![], vec![], vec![1, 3], vec![2]]);
    }

    #[test]
    fn a_layer_imports_none_above_it() {
        let world = "from carom._scene.scene import Scene\nfrom carom.errors import CaromError\n";
        let scripts = [
            Script::of_test(
                "python/carom/_scene/scene.py",
                "if TYPE_CHECKING:\n    import carom._run\n",
            ),
            Script::of_test(
                "python/carom/_scene/above.py",
                "if TYPE_CHECKING:\n    import carom._run\n",
            ),
            Script::of_test("python/carom/_run/world.py", world),
            Script::of_test("python/carom/_run/show.py", "import carom._show\n"),
            Script::of_test("python/carom/_show.py", "def f():\n    import carom.notebook\n"),
        ];
        let expected = [
            "  python/carom/_scene/scene.py:2: carom._scene imports carom._run",
            "  python/carom/_run/show.py:1: carom._run imports carom._show",
        ];
        assert_eq!(faults(&scripts), expected);
    }

    #[test]
    fn functions_import_optional_packages_alone() {
        let code = "def f():\n    import pandas\n    from carom._run import world\n";
        let scripts = [
            Script::of_test("python/carom/_run/world.py", ""),
            Script::of_test("python/carom/own.py", code),
            Script::of_test("python/tests/test_own.py", code),
        ];
        let expected = ["  python/carom/own.py:3 imports carom._run.world in a function"];
        assert_eq!(faults(&scripts), expected);
    }
}
