//! Finds which modules of a crate use names that other modules of it define.
//!
//! A name belongs to the module whose file defines it; re-exports are followed. Test code is
//! ignored.

use std::collections::{BTreeMap, HashMap};

use proc_macro2::{Spacing, TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Attribute, ImplItemFn, Item, ItemMod, ItemUse, Macro, Path, UseTree, Visibility};

use crate::sources::{Source, is_for_tests};

/// One use of a name that another module defines.
pub struct Import {
    /// The name as the code writes it.
    pub path: String,
    pub line: usize,
}

/// Returns for each module the modules whose names it uses, with the first use of each. Modules are
/// identified by their index in `sources`.
pub fn imports(sources: &[Source]) -> Vec<BTreeMap<usize, Import>> {
    let modules: Vec<Module> = sources.iter().map(|source| Module::new(&source.syntax)).collect();
    let places = sources.iter().enumerate().map(|(place, source)| (&source.module[..], place));
    let names = Names { sources, modules, places: places.collect() };
    let imports_of = |place: usize| {
        let mut imports = BTreeMap::new();
        for used in &names.modules[place].uses {
            if let Some(definer) = names.definer(place, &used.path, 0)
                && definer != place
            {
                let import = Import { path: used.path.join("::"), line: used.line };
                imports.entry(definer).or_insert(import);
            }
        }
        imports
    };
    (0..sources.len()).map(imports_of).collect()
}

/// A path that a module uses, without steps out of an inline module.
struct Used {
    path: Vec<String>,
    line: usize,
}

/// Names in a module.
#[derive(Default)]
struct Module {
    /// Names in scope, with the path of each.
    bindings: HashMap<String, Vec<String>>,
    /// Modules that are imported with a glob.
    globs: Vec<Vec<String>>,
    /// Names that the module defines.
    items: Vec<String>,
    /// Paths that the module uses, except those of re-exports, which use nothing themselves.
    uses: Vec<Used>,
    /// Number of inline modules around the visited item.
    depth: usize,
}

impl Module {
    fn new(syntax: &syn::File) -> Self {
        let mut module = Self::default();
        module.visit_file(syntax);
        module
    }

    fn add(&mut self, mut path: Vec<String>, line: usize) {
        self.leave_inline_modules(&mut path);
        self.uses.push(Used { path, line });
    }

    /// Removes steps out of inline modules, so that a path starts at the file's module.
    fn leave_inline_modules(&self, path: &mut Vec<String>) {
        for _ in 0..self.depth {
            if path.first().is_some_and(|first| first == "super") {
                path.remove(0);
            }
        }
    }

    /// Records the names that one branch of a `use` brings into scope.
    fn add_use(&mut self, tree: &UseTree, mut path: Vec<String>, is_private: bool, line: usize) {
        let (name, renamed) = match tree {
            UseTree::Path(tree) => {
                path.push(tree.ident.to_string());
                return self.add_use(&tree.tree, path, is_private, line);
            }
            UseTree::Group(group) => {
                for tree in &group.items {
                    self.add_use(tree, path.clone(), is_private, line);
                }
                return;
            }
            UseTree::Glob(_) => {
                self.leave_inline_modules(&mut path);
                return self.globs.push(path);
            }
            UseTree::Name(tree) => (tree.ident.to_string(), tree.ident.to_string()),
            UseTree::Rename(tree) => (tree.ident.to_string(), tree.rename.to_string()),
        };
        let renamed = if name == "self" { path.last().cloned() } else { Some(renamed) };
        if name != "self" {
            path.push(name);
        }
        self.leave_inline_modules(&mut path);
        if is_private {
            self.uses.push(Used { path: path.clone(), line });
        }
        self.bindings.insert(renamed.unwrap_or_default(), path);
    }

    /// Records the paths in the tokens of a macro.
    fn add_tokens(&mut self, tokens: TokenStream) {
        let mut path: Vec<String> = Vec::new();
        let mut colons = 0;
        for token in tokens {
            match token {
                TokenTree::Ident(ident) => {
                    if colons != 2 {
                        path.clear();
                    }
                    path.push(ident.to_string());
                    if path.len() > 1 {
                        self.add(path.clone(), ident.span().start().line);
                    }
                    colons = 0;
                }
                TokenTree::Punct(mark) if mark.as_char() == ':' && !path.is_empty() => {
                    colons += if mark.spacing() == Spacing::Joint || colons == 1 { 1 } else { 3 };
                }
                TokenTree::Group(group) => {
                    path.clear();
                    self.add_tokens(group.stream());
                }
                _ => path.clear(),
            }
        }
    }
}

impl<'ast> Visit<'ast> for Module {
    fn visit_item(&mut self, item: &'ast Item) {
        if is_for_tests(attributes_of(item)) {
            return;
        }
        self.items.extend(name_of(item));
        visit::visit_item(self, item);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast ImplItemFn) {
        if !is_for_tests(&item.attrs) {
            visit::visit_impl_item_fn(self, item);
        }
    }

    fn visit_item_mod(&mut self, item: &'ast ItemMod) {
        self.depth += 1;
        visit::visit_item_mod(self, item);
        self.depth -= 1;
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        let is_private = matches!(item.vis, Visibility::Inherited);
        let line = item.use_token.span.start().line;
        self.add_use(&item.tree, Vec::new(), is_private, line);
    }

    fn visit_path(&mut self, path: &'ast Path) {
        let names = path.segments.iter().map(|segment| segment.ident.to_string());
        let line = path.segments.first().map_or(0, |first| first.ident.span().start().line);
        self.add(names.collect(), line);
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &'ast Macro) {
        self.add_tokens(call.tokens.clone());
        visit::visit_macro(self, call);
    }

    fn visit_attribute(&mut self, attribute: &'ast Attribute) {
        if let syn::Meta::List(list) = &attribute.meta {
            self.add_tokens(list.tokens.clone());
        }
    }
}

/// The modules of a crate by name.
struct Names<'a> {
    sources: &'a [Source],
    modules: Vec<Module>,
    places: HashMap<&'a [String], usize>,
}

impl Names<'_> {
    /// Returns the module that defines the meaning of a path in this module; `None` if it is not in
    /// this crate. A path to a module alone uses none of its names.
    fn definer(&self, place: usize, path: &[String], depth: usize) -> Option<usize> {
        // Names that refer to each other in a circle have no definition.
        if depth > 16 {
            return None;
        }
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => return self.definer_in(*self.places.get(&[][..])?, rest, depth),
            "self" => return self.definer_in(place, rest, depth),
            "super" => {
                let (_, parent) = self.sources[place].module.split_last()?;
                let parent = *self.places.get(parent)?;
                return match rest.first() {
                    Some(next) if next == "super" => self.definer(parent, rest, depth),
                    _ => self.definer_in(parent, rest, depth),
                };
            }
            _ => {}
        }
        self.definer_in(place, path, depth)
    }

    /// As [`Self::definer`], for a path whose first name is in this module.
    fn definer_in(&self, place: usize, path: &[String], depth: usize) -> Option<usize> {
        let (first, rest) = path.split_first()?;
        let module = &self.modules[place];
        let child = [&self.sources[place].module[..], std::slice::from_ref(first)].concat();
        if let Some(&child) = self.places.get(&child[..])
            && !rest.is_empty()
        {
            return self.definer_in(child, rest, depth);
        }
        // A function may have the same name as a module in scope.
        let is_item = module.items.contains(first);
        if is_item && (rest.is_empty() || !module.bindings.contains_key(first)) {
            return Some(place);
        }
        if let Some(bound) = module.bindings.get(first)
            // A name bound to itself comes from another crate.
            && bound.first() != Some(first)
        {
            let path = [&bound[..], rest].concat();
            return self.definer(place, &path, depth + 1);
        }
        // Globs of other crates define no name of this one. Following them would take very long,
        // because a path through a glob is searched in all globs again.
        let mut globs = module.globs.iter().filter(|glob| self.is_of_crate(place, glob));
        globs.find_map(|glob| {
            let path = [&glob[..], path].concat();
            self.definer(place, &path, depth + 1)
        })
    }

    /// Returns whether a path in this module may lead to a module of the crate.
    fn is_of_crate(&self, place: usize, path: &[String]) -> bool {
        let Some(first) = path.first() else { return false };
        let bound = self.modules[place].bindings.get(first);
        let child = [&self.sources[place].module[..], std::slice::from_ref(first)].concat();
        matches!(first.as_str(), "crate" | "self" | "super")
            || bound.is_some_and(|bound| bound.first() != Some(first))
            || self.places.contains_key(&child[..])
    }
}

/// Returns the name that an item defines in its module.
fn name_of(item: &Item) -> Option<String> {
    let ident = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Macro(item) => item.ident.as_ref()?,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::TraitAlias(item) => &item.ident,
        Item::Type(item) => &item.ident,
        Item::Union(item) => &item.ident,
        _ => return None,
    };
    Some(ident.to_string())
}

fn attributes_of(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}
