//! Checks the table of what each language has: every function of a world stands in it, and everything in it is there.

use std::collections::BTreeSet;

use crate::documents;
use crate::shell::Outcome;

const TABLE: &str = "crates/carom/interfaces.md";
/// The cell of a row that is empty.
const NONE: &str = "-";

/// The functions that one language has for a world.
struct Language {
    name: &'static str,
    /// All names that cells of its column may have.
    names: BTreeSet<String>,
    /// Names that some cell must have.
    required: BTreeSet<String>,
}

/// Reports functions that the table lacks, and those in it that do not exist.
pub fn check() -> Outcome {
    let table = documents::text(TABLE)?;
    let mut faults = Vec::new();
    for (column, language) in languages()?.iter().enumerate() {
        let listed = listed(&table, column + 1);
        let gone = listed.difference(&language.names);
        faults.extend(gone.map(|name| format!("{}: there is no `{name}`", language.name)));
        let new = language.required.difference(&listed);
        faults.extend(new.map(|name| format!("{}: `{name}` is not in the table", language.name)));
    }
    faults.extend(unexplained(&table));
    if faults.is_empty() { Ok(()) } else { Err(format!("{TABLE}:\n{}", faults.join("\n"))) }
}

/// Reports rows with an empty cell that have no reason in the list at the end of a page, and reasons without such a row.
fn unexplained(page: &str) -> Vec<String> {
    let rows = page.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
    let cells = rows.map(|row| row.split(" | ").collect::<Vec<_>>());
    let empty = cells.filter(|cells| cells.contains(&NONE)).map(|cells| cells[0]);
    let reasons = page.lines().filter_map(|line| line.strip_prefix("- **")?.split("**").next());
    let (empty, reasons): (BTreeSet<&str>, BTreeSet<&str>) = (empty.collect(), reasons.collect());
    let missing = empty.difference(&reasons).map(|row| format!("`{row}` has no reason"));
    let needless = reasons.difference(&empty).map(|row| format!("`{row}` needs no reason"));
    missing.chain(needless).collect()
}

/// Returns the names in a column of all tables of a page.
fn listed(table: &str, column: usize) -> BTreeSet<String> {
    let rows = table.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
    let cells = rows.filter_map(|row| row.split(" | ").nth(column));
    let names = cells.filter(|&cell| cell != NONE && cell.contains('`'));
    names.flat_map(|cell| cell.split(", ")).map(|name| name.replace('`', "")).collect()
}

/// Returns the languages in the order of the columns.
fn languages() -> Outcome<[Language; 5]> {
    let rust = rust(&documents::text("crates/carom/interface.txt")?);
    let c = calls(&documents::text("crates/carom-c/include/carom.h")?);
    let csharp = csharp(&documents::text("crates/carom-c/csharp/CaromWorld.cs")?);
    let javascript = javascript(&documents::text("web/package/src/index.d.ts")?);
    let mut python = BTreeSet::new();
    for (file, class) in PYTHON {
        python.extend(members_of_python(&documents::text(file)?, class));
    }
    Ok([
        rust,
        all("C", c),
        all("C#", csharp),
        all("JavaScript", javascript),
        Language {
            name: "Python",
            names: python.iter().cloned().chain(PYTHON_CLASSES.map(str::to_owned)).collect(),
            required: python,
        },
    ])
}

/// The classes that a world of Python inherits, and its snapshots, with their files.
const PYTHON: [(&str, &str); 5] = [
    ("python/carom/_carom.pyi", "Engine"),
    ("python/carom/_carom.pyi", "Snapshot"),
    ("python/carom/_run/bodies.py", "Bodies"),
    ("python/carom/_run/queries.py", "Queries"),
    ("python/carom/_run/world.py", "World"),
];
const PYTHON_CLASSES: [&str; 3] = ["World", "Tangents", "Tape"];

/// Returns a language whose functions all have to be listed.
fn all(name: &'static str, names: BTreeSet<String>) -> Language {
    Language { name, required: names.clone(), names }
}

/// Returns the functions in the listing of the crate `carom`; those of worlds and snapshots and the parts of the
/// report have to be in the table.
fn rust(listing: &str) -> Language {
    let mut names = BTreeSet::from(["World".to_owned()]);
    let mut required = BTreeSet::new();
    for line in listing.lines() {
        let Some((owner, member)) = line.split_once("::") else { continue };
        let function = member.strip_prefix("fn ");
        let name = format!("{owner}::{}", identifier(function.unwrap_or(member)));
        let is_required = match owner {
            "World" | "Snapshot" => function.is_some(),
            "StepReport" => function.is_none(),
            _ => false,
        };
        if is_required {
            required.insert(name.clone());
        }
        names.insert(name);
    }
    Language { name: "Rust", names, required }
}

/// Returns the functions that a header declares.
fn calls(header: &str) -> BTreeSet<String> {
    let declarations = header.lines().filter(|line| !line.starts_with([' ', '/', '#', '}']));
    let names =
        declarations.filter_map(|line| line.split_once('(')?.0.split([' ', '*']).next_back());
    names.filter(|name| name.starts_with("carom_")).map(str::to_owned).collect()
}

/// Returns the public members of the classes of C# for worlds and snapshots.
fn csharp(source: &str) -> BTreeSet<String> {
    let mut members = BTreeSet::new();
    let mut is_inside = false;
    for line in source.lines() {
        let is_type = ["class ", "struct "].iter().any(|kind| line.contains(kind));
        if is_type && line.starts_with("    ") && !line.starts_with("     ") {
            let classes = ["class CaromWorld", "class CaromSnapshot"];
            is_inside = classes.iter().any(|class| line.contains(class));
        }
        let Some(member) = line.strip_prefix("        public ").filter(|_| is_inside) else {
            continue;
        };
        let head = member.split(['(', '{']).next().unwrap_or(member).trim();
        members.extend(head.split(' ').next_back().map(str::to_owned));
    }
    members
}

/// Returns the members of the classes for worlds and snapshots in declarations of TypeScript.
fn javascript(declarations: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for class in ["World", "Snapshot"] {
        let rest = declarations.split(&format!("export class {class} {{")).nth(1);
        let body = rest.and_then(|rest| rest.split("\n}").next()).unwrap_or_default();
        let members = body.lines().filter_map(|line| line.strip_prefix("  "));
        let members =
            members.filter(|line| line.starts_with(|first: char| first.is_ascii_lowercase()));
        let plain = |line| {
            let words = ["private ", "readonly ", "static "];
            identifier(words.iter().fold(line, |line: &str, word| line.trim_start_matches(word)))
        };
        names.extend(members.map(plain).map(str::to_owned));
    }
    if names.remove("constructor") {
        names.insert("World".to_owned());
    }
    names
}

/// Returns the public methods and properties of a class of Python.
fn members_of_python(source: &str, class: &str) -> BTreeSet<String> {
    let mut members = BTreeSet::new();
    let mut is_inside = false;
    for line in source.lines() {
        if let Some(name) = line.strip_prefix("class ") {
            is_inside = identifier(name) == class;
        }
        let Some(member) = line.strip_prefix("    def ").filter(|_| is_inside) else { continue };
        members
            .extend(Some(identifier(member)).filter(|it| !it.starts_with('_')).map(str::to_owned));
    }
    members
}

/// Returns the name at the start of a text.
fn identifier(text: &str) -> &str {
    text.split(|it: char| !it.is_alphanumeric() && it != '_').next().unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::{calls, csharp, javascript, listed, members_of_python, rust, unexplained};

    fn names<'a>(found: impl IntoIterator<Item = &'a String>) -> Vec<&'a str> {
        found.into_iter().map(String::as_str).collect()
    }

    #[test]
    fn cells_of_a_column_are_read() {
        let table = "| a | `x`, `y` | - |\n| b | - | `z` |\n";
        assert_eq!(names(&listed(table, 1)), ["x", "y"]);
        assert_eq!(names(&listed(table, 2)), ["z"]);
    }

    #[test]
    fn rows_with_empty_cells_have_reasons() {
        let page = "| a | `x` | - |\n| b | `y` | `z` |\n\n- **b**: so\n";
        assert_eq!(unexplained(page), ["`a` has no reason", "`b` needs no reason"]);
    }

    #[test]
    fn functions_of_worlds_and_fields_of_reports_are_required_in_rust() {
        let listing = "Ball::fn new() -> Self\nStepReport::impacts: Vec<Impact>\n\
                       StepReport::fn len(&self)\nWorld::fn step(&mut self, dt: f64)\nstruct World";
        assert_eq!(names(&rust(listing).required), ["StepReport::impacts", "World::step"]);
    }

    #[test]
    fn members_of_the_other_languages_are_found() {
        let header = "// carom_a() is here\nCaromStatus carom_a(CaromWorld world,\n\
                      const char *carom_b(size_t index);\ntypedef struct CaromWorld {\n";
        assert_eq!(names(&calls(header)), ["carom_a", "carom_b"]);
        let source = "    public sealed class CaromWorld : IDisposable\n        public double Time\n\
                      \x20       public void Step(double dt) { }\n    public struct CaromRay\n\
                      \x20       public Double3 Origin;\n";
        assert_eq!(names(&csharp(source)), ["Step", "Time"]);
        let declarations = "export class World {\n  constructor();\n  readonly time: number;\n\
                            \x20 static fromScene(name: string): World;\n  /** step */\n}\n  other();\n\
                            export class Snapshot {\n  private constructor();\n  toBytes(): Uint8Array;\n}\n";
        let members = ["World", "fromScene", "time", "toBytes"];
        assert_eq!(names(&javascript(declarations)), members);
        let classes = "class Engine:\n    def step(self) -> None: ...\n    def _own(self): ...\n\
                       class Other:\n    def else_(self): ...\n";
        assert_eq!(names(&members_of_python(classes, "Engine")), ["step"]);
    }
}
