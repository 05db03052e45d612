//! Which modules of JavaScript import which.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use super::Script;
use crate::files::normal;
use crate::imports::Import;

/// For each module, those that it imports, by their places among the scripts.
pub fn imports(scripts: &[Script]) -> Vec<BTreeMap<usize, Import>> {
    let places: HashMap<&Path, usize> =
        scripts.iter().enumerate().map(|(place, it)| (it.file.as_path(), place)).collect();
    let of = |script: &Script| {
        let mut found = BTreeMap::new();
        for (line, path) in imported(&script.code()) {
            let file = beside(&script.file, &path);
            let declared = file.with_extension("d.ts");
            if let Some(&to) = places.get(file.as_path()).or(places.get(declared.as_path())) {
                found.entry(to).or_insert(Import { path, line });
            }
        }
        found
    };
    scripts.iter().map(of).collect()
}

/// The file that a path means in a module.
fn beside(file: &Path, path: &str) -> PathBuf {
    normal(&file.parent().unwrap_or(file).join(path))
}

/// The files that a module names in its imports, with the lines; names of packages are no files.
fn imported(code: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut rest = code;
    while let Some(at) = ["\"./", "\"../"].iter().filter_map(|it| rest.find(it)).min() {
        let line = 1 + code[..code.len() - rest.len() + at].matches('\n').count();
        let (before, path) = (rest[..at].trim_end(), &rest[at + 1..]);
        let end = path.find('"').unwrap_or(path.len());
        let is_import = ["from", "import", "import("].iter().any(|it| before.ends_with(it));
        if is_import {
            found.push((line, path[..end].to_owned()));
        }
        rest = &path[end..];
    }
    found
}

#[cfg(test)]
mod tests {
    use super::imports;
    use crate::scripts::Script;

    #[test]
    fn imports_of_files_are_found_however_they_are_written() {
        let code = "import { a } from \"./a.js\";\nimport * as b from \"b\";\nimport \"../c.js\";\n\
                    export * from \"./d/d.js\";\nconst e = await import(\"./e.js\");\n// import \"./f.js\"\n\
                    fetch(\"./f.js\");\n";
        let files = ["web/own/a.js", "web/c.js", "web/own/d/d.js", "web/own/e.js", "web/own/f.js"];
        let mut scripts = vec![Script::of_test("web/own/own.js", code)];
        scripts.extend(files.map(|file| Script::of_test(file, "")));
        let found = imports(&scripts);
        let lines: Vec<_> = found[0].iter().map(|(to, import)| (*to, import.line)).collect();
        assert_eq!(lines, [(1, 1), (2, 3), (3, 4), (4, 5)]);
    }

    #[test]
    fn declarations_import_each_other_by_the_names_of_what_they_declare() {
        let scripts = [
            Script::of_test("web/a.d.ts", "import type { B } from \"./b.js\";\n"),
            Script::of_test("web/b.d.ts", ""),
        ];
        assert!(imports(&scripts)[0].contains_key(&1));
    }
}
