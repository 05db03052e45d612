//! Lists what the crate `carom` promises, so that a change of it is seen: the items at its root, with
//! their fields, variants and functions, and the traits that they have.

use std::collections::BTreeSet;
use std::fs;

use syn::spanned::Spanned;
use syn::{Fields, ImplItem, Item, ItemImpl, Type, UseTree, Visibility};

use crate::shell::{Outcome, root};
use crate::sources::{Source, crates_of, read};

const LISTING: &str = "crates/carom/interface.txt";

/// Reports what the listing lacks and what it has too much.
pub fn check() -> Outcome {
    let listed = read(&root().join(LISTING))?;
    let [listed, found] = [listed, listing()?]
        .map(|text| -> BTreeSet<String> { text.lines().map(str::to_owned).collect() });
    let gone = listed.difference(&found).map(|line| format!("  - {line}"));
    let new = found.difference(&listed).map(|line| format!("  + {line}"));
    let changes: Vec<String> = gone.chain(new).collect();
    if changes.is_empty() {
        return Ok(());
    }
    let changes = changes.join("\n");
    Err(format!("the interface of carom changed; `cargo xtask interface` lists it:\n{changes}"))
}

/// Writes the listing.
pub fn write() -> Outcome {
    let file = root().join(LISTING);
    fs::write(&file, listing()?).map_err(|error| format!("{}: {error}", file.display()))
}

fn listing() -> Outcome<String> {
    let crates = crates_of(&root().join("crates/carom/src"))?;
    let sources = crates.into_iter().next().ok_or("carom has no sources")?;
    let mut modules = Vec::new();
    for source in sources {
        let text = read(&root().join(&source.file))?;
        modules.push(Module { source, text });
    }
    Ok(lines(&Modules(modules))?.into_iter().map(|line| line + "\n").collect())
}

/// Returns the lines of the listing in alphabetical order.
fn lines(modules: &Modules) -> Outcome<BTreeSet<String>> {
    let top = modules.find(&[]).ok_or("there is no root module")?;
    let mut lines = BTreeSet::new();
    for item in &top.source.syntax.items {
        let Item::Use(item) = item else { continue };
        if !matches!(item.vis, Visibility::Public(_)) {
            continue;
        }
        for import in imports(&item.tree) {
            let name = import.name.clone();
            match modules.definition(top, &import.path, 0) {
                Some((module, item)) => lines.extend(described(modules, module, item, &name)),
                None => drop(lines.insert(format!("use {}", import.path.join("::")))),
            }
        }
    }
    Ok(lines)
}

/// Returns the lines of an item: its own, those of its parts, and those of its implementations.
fn described(modules: &Modules, home: &Module, item: &Item, name: &str) -> Vec<String> {
    let part = |text: String| format!("{name}::{text}");
    let mut lines = match item {
        Item::Struct(it) => {
            let is_public = |field: &&syn::Field| matches!(field.vis, Visibility::Public(_));
            let fields: Vec<&syn::Field> = match &it.fields {
                Fields::Named(fields) => fields.named.iter().filter(is_public).collect(),
                Fields::Unnamed(fields) => fields.unnamed.iter().filter(is_public).collect(),
                Fields::Unit => Vec::new(),
            };
            let fields = fields.into_iter().map(|it| match &it.ident {
                Some(ident) => part(format!("{ident}: {}", home.text_of(&it.ty))),
                None => part(home.text_of(&it.ty)),
            });
            let head = format!("struct {name}{}", home.text_of(&it.generics));
            [head].into_iter().chain(fields).collect()
        }
        Item::Enum(it) => {
            let variants = it.variants.iter().map(|it| {
                let fields: Vec<String> = it.fields.iter().map(|it| home.field(it)).collect();
                let fields = fields.join(", ");
                let fields = match it.fields {
                    Fields::Named(_) => format!(" {{ {fields} }}"),
                    Fields::Unnamed(_) => format!("({fields})"),
                    Fields::Unit => fields,
                };
                part(format!("{}{fields}", it.ident))
            });
            [format!("enum {name}{}", home.text_of(&it.generics))]
                .into_iter()
                .chain(variants)
                .collect()
        }
        Item::Trait(it) => {
            let functions = it.items.iter().filter_map(|it| match it {
                syn::TraitItem::Fn(it) => {
                    let provided = if it.default.is_some() { " (provided)" } else { "" };
                    Some(part(format!("{}{provided}", home.text_of(&it.sig))))
                }
                _ => None,
            });
            let bounds: Vec<String> = it.supertraits.iter().map(|it| home.text_of(it)).collect();
            [format!("trait {name}: {}", bounds.join(" + "))].into_iter().chain(functions).collect()
        }
        Item::Fn(it) => vec![home.text_of(&it.sig)],
        Item::Const(it) => vec![format!("const {name}: {}", home.text_of(&it.ty))],
        _ => vec![format!("{name} (made by a macro)")],
    };
    lines.extend(derived(home, item, name));
    for module in &modules.0 {
        for implementation in module.implementations() {
            let Some(ident) = ident_of(&implementation.self_ty) else { continue };
            let is_of_item = modules
                .definition(module, &[ident], 0)
                .is_some_and(|(_, found)| std::ptr::eq(found, item));
            if is_of_item {
                lines.extend(implemented(module, implementation, name));
            }
        }
    }
    lines
}

/// Returns the traits that an item derives, without those behind a feature.
fn derived(home: &Module, item: &Item, name: &str) -> Option<String> {
    let attributes = match item {
        Item::Struct(it) => &it.attrs,
        Item::Enum(it) => &it.attrs,
        _ => return None,
    };
    let derives =
        |it: &&syn::Attribute| ["derive", "educe"].iter().any(|by| it.path().is_ident(by));
    let derived = attributes.iter().filter(derives);
    let texts: Vec<String> = derived.map(|it| home.text_of(&it.meta)).collect();
    (!texts.is_empty()).then(|| format!("{name}: {}", texts.join(" ")))
}

/// Returns the public functions and constants of an implementation, or the trait that it is of.
fn implemented(module: &Module, implementation: &ItemImpl, name: &str) -> Vec<String> {
    if let Some((path, _)) = &implementation.trait_ {
        return vec![format!("{name}: {}", module.text_of(path))];
    }
    let parts = implementation.items.iter().filter_map(|item| match item {
        ImplItem::Fn(it) if matches!(it.vis, Visibility::Public(_)) => {
            Some(format!("{name}::{}", module.text_of(&it.sig)))
        }
        ImplItem::Const(it) if matches!(it.vis, Visibility::Public(_)) => {
            Some(format!("{name}::const {}: {}", it.ident, module.text_of(&it.ty)))
        }
        _ => None,
    });
    parts.collect()
}

/// Returns the name of a type without its module and parameters.
fn ident_of(item: &Type) -> Option<String> {
    let Type::Path(path) = item else { return None };
    Some(path.path.segments.last()?.ident.to_string())
}

/// A name that a `use` brings in, and the path that it stands for.
struct Import {
    name: String,
    path: Vec<String>,
}

/// Returns the names that a tree of imports brings in.
fn imports(tree: &UseTree) -> Vec<Import> {
    match tree {
        UseTree::Path(it) => {
            let mut found = imports(&it.tree);
            found.iter_mut().for_each(|import| import.path.insert(0, it.ident.to_string()));
            found
        }
        UseTree::Name(it) => vec![import(it.ident.to_string(), it.ident.to_string())],
        UseTree::Rename(it) => vec![import(it.rename.to_string(), it.ident.to_string())],
        UseTree::Group(it) => it.items.iter().flat_map(imports).collect(),
        UseTree::Glob(_) => Vec::new(),
    }
}

fn import(name: String, of: String) -> Import {
    Import { name, path: vec![of] }
}

/// A module with the text of its file.
struct Module {
    source: Source,
    text: String,
}

impl Module {
    /// Returns the source of a part of the syntax, on one line.
    fn text_of(&self, part: &impl Spanned) -> String {
        let text = self.text.get(part.span().byte_range()).unwrap_or_default();
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        text.replace("( ", "(").replace(", )", ")").replace(",)", ")")
    }

    fn field(&self, field: &syn::Field) -> String {
        let of_type = self.text_of(&field.ty);
        field.ident.as_ref().map_or(of_type.clone(), |ident| format!("{ident}: {of_type}"))
    }

    fn implementations(&self) -> impl Iterator<Item = &ItemImpl> {
        self.source.syntax.items.iter().filter_map(|item| match item {
            Item::Impl(item) => Some(item),
            _ => None,
        })
    }

    /// Returns the item of this name that the module itself defines.
    fn own(&self, name: &str) -> Option<&Item> {
        self.source.syntax.items.iter().find(|item| match item {
            Item::Struct(it) => it.ident == name,
            Item::Enum(it) => it.ident == name,
            Item::Trait(it) => it.ident == name,
            Item::Fn(it) => it.sig.ident == name,
            Item::Const(it) => it.ident == name,
            Item::Macro(it) => {
                it.mac.tokens.to_string().split_whitespace().any(|word| word == name)
            }
            _ => false,
        })
    }

    /// Returns the path that a name in this module was imported by.
    fn imported(&self, name: &str) -> Option<Vec<String>> {
        let uses = self.source.syntax.items.iter().filter_map(|item| match item {
            Item::Use(item) => Some(imports(&item.tree)),
            _ => None,
        });
        uses.flatten().find(|import| import.name == name).map(|import| import.path)
    }
}

struct Modules(Vec<Module>);

impl Modules {
    fn find(&self, path: &[String]) -> Option<&Module> {
        self.0.iter().find(|module| module.source.module == path)
    }

    /// Returns the definition that a path in a module leads to, with its module; `None` for other
    /// crates. `depth` counts imports of imports.
    fn definition(&self, from: &Module, path: &[String], depth: usize) -> Option<(&Module, &Item)> {
        const DEEPEST: usize = 8;
        let (name, before) = path.split_last()?;
        let home = self.find(&self.absolute(from, before)?)?;
        if let Some(item) = home.own(name) {
            return Some((home, item));
        }
        let imported = home.imported(name).filter(|_| depth < DEEPEST)?;
        self.definition(home, &imported, depth + 1)
    }

    /// Converts the path of a module, as written in another one, to one from the root of the crate.
    fn absolute(&self, from: &Module, path: &[String]) -> Option<Vec<String>> {
        let mut found = from.source.module.clone();
        for (place, segment) in path.iter().enumerate() {
            match segment.as_str() {
                "crate" => found.clear(),
                "self" => {}
                "super" => drop(found.pop()?),
                _ => found.push(segment.clone()),
            }
            // Other crates are no module here.
            if place == 0 && self.find(&found).is_none() {
                return None;
            }
        }
        Some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::{Module, Modules, lines};
    use crate::sources::Source;

    fn module(path: &[&str], text: &str) -> Module {
        let module = path.iter().map(|it| (*it).to_owned()).collect();
        let syntax = syn::parse_file(text).unwrap_or_else(|error| panic!("{error}"));
        Module { source: Source { module, file: "x.rs".into(), syntax }, text: text.to_owned() }
    }

    #[test]
    fn items_at_the_root_are_listed_with_their_public_parts() {
        let modules = Modules(vec![
            module(&[], "mod a; pub use a::{Ball, Law}; pub use glam::DVec3; use a::Hidden;"),
            module(
                &["a"],
                "mod b; pub use b::Ball; pub enum Law { Hard, Soft { by: f64 } } pub struct Hidden;",
            ),
            module(
                &["a", "b"],
                "#[derive(Debug)] pub struct Ball { pub radius: f64, mass: f64 }
                 impl Ball { pub fn new(\n    radius: f64,\n) -> Self { todo!() } fn own() {} }
                 impl Clone for Ball {}",
            ),
            module(&["c"], "use crate::a::Ball; impl Ball { pub fn grow(&mut self) {} }"),
            module(&["d"], "struct Ball; impl Ball { pub fn other() {} }"),
        ]);
        let found: Vec<String> = lines(&modules).unwrap_or_default().into_iter().collect();
        let expected = [
            "Ball: Clone",
            "Ball: derive(Debug)",
            "Ball::fn grow(&mut self)",
            "Ball::fn new(radius: f64) -> Self",
            "Ball::radius: f64",
            "Law::Hard",
            "Law::Soft { by: f64 }",
            "enum Law",
            "struct Ball",
            "use glam::DVec3",
        ];
        assert_eq!(found, expected);
    }
}
