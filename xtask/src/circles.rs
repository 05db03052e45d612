//! Keeps modules in order: no two of a crate, or of Python, JavaScript or C#, use each other, on
//! whatever way round.

use std::collections::{BTreeMap, VecDeque};
use std::path::PathBuf;

use crate::imports::{Import, imports};
use crate::scripts::{Language, Script, csharp, javascript, python, scripts};
use crate::shell::Outcome;
use crate::sources::{Source, crates_of, folders};

/// Refuses modules that use each other in a circle, and layers that use those above them.
pub fn check() -> Outcome {
    let mut faults = Vec::new();
    for folder in folders()? {
        for sources in crates_of(&folder)? {
            faults.extend(circles(&sources));
        }
    }
    let (pythons, others): (Vec<Script>, Vec<Script>) =
        scripts()?.into_iter().partition(|it| it.language == Language::Python);
    let (javascripts, csharps): (Vec<Script>, Vec<Script>) =
        others.into_iter().partition(|it| it.language == Language::JavaScript);
    faults.extend(circles_of_scripts(&pythons, python::imports));
    faults.extend(circles_of_scripts(&javascripts, javascript::imports));
    faults.extend(circles_of_scripts(&csharps, csharp::imports));
    if faults.is_empty() {
        return python::check_layers(&pythons);
    }
    Err(format!("modules that use each other in a circle:\n{}", faults.join("\n")))
}

/// The groups of modules of a crate that use each other.
fn circles(sources: &[Source]) -> Vec<String> {
    let files: Vec<&PathBuf> = sources.iter().map(|it| &it.file).collect();
    circles_among(&files, &imports(sources))
}

/// The groups of scripts that use each other.
fn circles_of_scripts(
    scripts: &[Script],
    imports: fn(&[Script]) -> Vec<BTreeMap<usize, Import>>,
) -> Vec<String> {
    let files: Vec<&PathBuf> = scripts.iter().map(|it| &it.file).collect();
    circles_among(&files, &imports(scripts))
}

/// The groups of files that use each other, each with one way round.
fn circles_among(files: &[&PathBuf], imports: &[BTreeMap<usize, Import>]) -> Vec<String> {
    let tell = |group: Vec<usize>| {
        let names = group.iter().map(|&place| files[place].display().to_string());
        let way = shortest_way_round(imports, &group);
        let steps = way.iter().map(|&(from, to, import)| {
            let (from, to) = (files[from].display(), files[to].display());
            format!("      {from}:{} uses {} of {to}", import.line, import.path)
        });
        let lines: Vec<String> = steps.collect();
        format!("  {}\n{}", names.collect::<Vec<_>>().join(", "), lines.join("\n"))
    };
    components(imports).into_iter().filter(|group| group.len() > 1).map(tell).collect()
}

/// One step from a module to another that it uses.
type Step<'a> = (usize, usize, &'a Import);

/// The fewest steps that lead from a module of the group back to it.
fn shortest_way_round<'a>(
    imports: &'a [BTreeMap<usize, Import>],
    group: &[usize],
) -> Vec<Step<'a>> {
    let ways = group.iter().filter_map(|&start| way_round(imports, group, start));
    ways.min_by_key(Vec::len).unwrap_or_default()
}

fn way_round<'a>(
    imports: &'a [BTreeMap<usize, Import>],
    group: &[usize],
    start: usize,
) -> Option<Vec<Step<'a>>> {
    let mut came_by: BTreeMap<usize, Step> = BTreeMap::new();
    let mut ahead = VecDeque::from([start]);
    while !came_by.contains_key(&start) {
        let from = ahead.pop_front()?;
        for (&to, import) in imports[from].iter().filter(|(to, _)| group.contains(to)) {
            came_by.entry(to).or_insert_with(|| {
                ahead.push_back(to);
                (from, to, import)
            });
        }
    }
    let mut way = vec![came_by[&start]];
    while way[way.len() - 1].0 != start {
        way.push(came_by[&way[way.len() - 1].0]);
    }
    way.reverse();
    Some(way)
}

/// The strongly connected components of the graph of imports, by Tarjan's algorithm, each in
/// ascending order.
fn components(imports: &[BTreeMap<usize, Import>]) -> Vec<Vec<usize>> {
    let count = imports.len();
    let mut search = Search { imports, order: vec![None; count], ..Search::default() };
    search.lowest = vec![0; count];
    for place in 0..count {
        if search.order[place].is_none() {
            search.visit(place);
        }
    }
    search.found.sort();
    search.found
}

/// State of Tarjan's search.
#[derive(Default)]
struct Search<'a> {
    imports: &'a [BTreeMap<usize, Import>],
    /// When each module was first visited.
    order: Vec<Option<usize>>,
    /// The earliest visited module that each module leads back to.
    lowest: Vec<usize>,
    /// Visited modules that have no component yet.
    open: Vec<usize>,
    visited: usize,
    found: Vec<Vec<usize>>,
}

impl Search<'_> {
    fn visit(&mut self, place: usize) {
        let own_order = self.visited;
        self.visited += 1;
        self.order[place] = Some(own_order);
        self.lowest[place] = own_order;
        self.open.push(place);
        for &to in self.imports[place].keys() {
            match self.order[to] {
                None => {
                    self.visit(to);
                    self.lowest[place] = self.lowest[place].min(self.lowest[to]);
                }
                Some(order) if self.open.contains(&to) => {
                    self.lowest[place] = self.lowest[place].min(order);
                }
                Some(_) => {}
            }
        }
        if self.lowest[place] == own_order {
            let first = self.open.iter().position(|&it| it == place).unwrap_or(0);
            let mut component = self.open.split_off(first);
            component.sort_unstable();
            self.found.push(component);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::{circles, circles_of_scripts};
    use crate::scripts::{Script, javascript, python};
    use crate::sources::Source;

    /// A crate of modules, each with its names from the root (`a::b`) and its code.
    fn circles_of(modules: &[(&str, &str)]) -> Vec<String> {
        let source = |&(module, code): &(&str, &str)| Source {
            module: module.split("::").filter(|it| !it.is_empty()).map(str::to_owned).collect(),
            file: PathBuf::from(format!("{module}.rs")),
            syntax: syn::parse_file(code).unwrap(),
        };
        circles(&modules.iter().map(source).collect::<Vec<_>>())
    }

    #[test]
    fn modules_that_use_each_other_are_a_circle() {
        let found = circles_of(&[
            ("", "mod a; mod b; mod c;"),
            ("a", "use crate::b::B;\nstruct A;"),
            ("b", "struct B(super::c::C);"),
            ("c", "struct C;\nfn print() { println!(\"{}\", crate::a::A) }"),
        ]);
        let way = "  a.rs, b.rs, c.rs\n      a.rs:1 uses crate::b::B of b.rs\n      b.rs:1 uses \
                   super::c::C of c.rs\n      c.rs:2 uses crate::a::A of a.rs";
        assert_eq!(found, [way]);
    }

    #[test]
    fn a_parent_that_uses_a_child_that_uses_the_parent_is_a_circle() {
        let parent = "mod child; use child::Child; pub struct Parent(Child);";
        let found = circles_of(&[
            ("", "mod parent;"),
            ("parent", parent),
            ("parent::child", "use super::Parent; pub struct Child;"),
        ]);
        assert_eq!(found.len(), 1, "{found:?}");
    }

    #[test]
    fn a_reexport_is_looked_through() {
        let found = circles_of(&[
            ("", "mod parent; pub use parent::{A, B as Bee};"),
            ("parent", "mod a; mod b; pub use a::A; pub use b::*;"),
            ("parent::a", "use super::B; pub struct A;"),
            ("parent::b", "pub struct B; fn f() -> crate::Bee { B }"),
        ]);
        assert!(found.is_empty(), "{found:?}");
        let found = circles_of(&[
            ("", "mod parent; pub use parent::A;"),
            ("parent", "mod a; mod b; pub use a::A; pub use b::*;"),
            ("parent::a", "use super::B; pub struct A;"),
            ("parent::b", "pub struct B(crate::A);"),
        ]);
        assert_eq!(found.len(), 1, "{found:?}");
    }

    #[test]
    fn code_for_tests_does_not_count() {
        let found = circles_of(&[
            ("", "mod a; mod b;"),
            ("a", "use crate::b; fn f() { b::g() }"),
            ("b", "pub fn g() {}\n#[cfg(test)]\nmod tests { use crate::a::f; }"),
        ]);
        assert!(found.is_empty(), "{found:?}");
    }

    #[test]
    fn an_inline_module_belongs_to_its_file() {
        let found = circles_of(&[
            ("", "mod a;"),
            ("a", "mod b; struct A; mod inside { use super::b::B; pub struct C; }"),
            ("a::b", "use super::A; struct B;"),
        ]);
        assert_eq!(found.len(), 1, "{found:?}");
    }

    #[test]
    fn modules_of_python_that_import_each_other_are_a_circle_wherever_they_do() {
        let scripts = [
            Script::of_test("python/carom/a.py", "from carom import b\n"),
            Script::of_test("python/carom/b.py", "def f():\n    from carom.a import A\n"),
            Script::of_test("python/carom/c.py", "import carom.a\n"),
        ];
        let way = "  python/carom/a.py, python/carom/b.py\n      python/carom/a.py:1 uses carom of \
                   python/carom/b.py\n      python/carom/b.py:2 uses carom.a of python/carom/a.py";
        assert_eq!(circles_of_scripts(&scripts, python::imports), [way]);
    }

    #[test]
    fn modules_of_javascript_that_import_each_other_are_a_circle() {
        let scripts = [
            Script::of_test("web/a.js", "import { b } from \"./b/b.js\";\n"),
            Script::of_test("web/b/b.js", "export * from \"../a.js\";\n"),
            Script::of_test("web/c.js", "import \"./a.js\";\n"),
        ];
        assert_eq!(circles_of_scripts(&scripts, javascript::imports).len(), 1);
    }
}
