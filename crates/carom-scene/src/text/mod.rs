//! Texts of scenes: reads scenes from them, and finds the line of every error.

mod faults;
mod include;
mod mesh_paths;
mod source;

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use toml::{Table, Value};

pub(crate) use self::include::named_files;
pub use self::source::from_toml_text;
use self::source::{SourceText, fault};
use crate::budget::Budget;
use crate::error::{Fault, Problem, SceneError, segments};
use crate::overrides::Override;
use crate::parameters::{self, Parameter};
use crate::scene::Scene;
use crate::table::read;
use crate::wording::{with_names, without_list};

/// Text of a scene file, with those of the files that it includes.
///
/// ```
/// use carom_scene::SceneText;
///
/// let text = SceneText::new("[parameters]\nr = 0.5\n[[spheres]]\nradius = '=2*r'\n", "one.toml")?;
/// let scene = text.scene(&["r=0.25".parse()?])?;
/// assert_eq!(scene.spheres[0].radius, Some(0.5));
/// assert_eq!(text.parameters(&[])?[0].value, 0.5);
/// # Ok::<(), carom_scene::SceneError>(())
/// ```
#[derive(Debug, Clone)]
pub struct SceneText {
    /// Texts of all files; included ones come before the files that include them, the file itself
    /// last.
    sources: Vec<SourceText>,
    /// Merged content of all files.
    table: Table,
    /// Limits on the size of the scene.
    budget: Budget,
}

impl SceneText {
    /// Parses a text. Errors call it `source_name`; a scene without a name gets that of the source,
    /// without its ending.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if the text is no TOML, or includes a file.
    pub fn new(text: &str, source_name: &str) -> Result<Self, SceneError> {
        Self::of(SourceText::new(source_name, text)?, &[], Budget::FILE)
    }

    /// Reads a file and the files that it includes.
    ///
    /// # Errors
    /// [`SceneError::Unreadable`] if the file cannot be read. [`SceneError::Invalid`] if a file is
    /// no TOML, or if an included file cannot be read or includes a file that includes it.
    pub fn from_file(path: &Path) -> Result<Self, SceneError> {
        Self::from_file_within(path, Budget::FILE)
    }

    /// Reads a file and the files that it includes, within `budget`.
    ///
    /// # Errors
    /// The same as those of [`Self::from_file`], and [`SceneError::Unreadable`] if a file has too
    /// many bytes.
    pub fn from_file_within(path: &Path, budget: Budget) -> Result<Self, SceneError> {
        let text = include::read_within(path, budget.bytes)
            .map_err(|source| SceneError::Unreadable { path: path.to_owned(), source })?;
        let own = SourceText::new(&path.display().to_string(), &text)?;
        Self::of(own, &[path.to_owned()], budget)
    }

    /// Sets the limits on the size of the scene; the default is [`Budget::FILE`].
    pub fn within(self, budget: Budget) -> Self {
        Self { budget, ..self }
    }

    fn of(own: SourceText, way: &[PathBuf], budget: Budget) -> Result<Self, SceneError> {
        let name = Path::new(&own.name).file_stem().unwrap_or_default();
        let name = name.to_string_lossy().into_owned();
        let sources = include::with_included(own, way, budget, &mut Vec::new())?;
        let mut table = Table::new();
        for source in &sources {
            let mut own = source.table.clone();
            if !way.is_empty() {
                mesh_paths::resolve(&mut own, Path::new(&source.name));
            }
            include::lay_over(&mut table, own);
        }
        if !(table.contains_key("name") || name.is_empty()) {
            table.insert("name".to_owned(), name.into());
        }
        Ok(Self { sources, table, budget })
    }

    /// Creates the scene, with overrides applied.
    ///
    /// # Errors
    /// The same as those of [`Scene::from_toml_with`].
    pub fn scene(&self, overrides: &[Override]) -> Result<Scene, SceneError> {
        let table = self.changed(overrides)?;
        read(table, self.budget).map_err(|problem| {
            // The file is to blame if there are no overrides, or if it is invalid without them.
            let own = if overrides.is_empty() {
                Some(problem.clone())
            } else {
                read(self.table.clone(), self.budget).err()
            };
            if let Some(problem) = own {
                return self.fault(&problem).into();
            }
            let mut cause: Vec<&Override> =
                overrides.iter().filter(|changed| changed.concerns(&problem.field)).collect();
            if cause.is_empty() {
                cause = overrides.iter().collect();
            }
            let cause: Vec<_> = cause.iter().map(|it| it.to_string()).collect();
            // An unknown name without a path may be meant as a parameter.
            let Problem { field, problem } = problem;
            let problem = with_names(problem, &field, self.parameter_names());
            let mut fault = Box::new(fault(self.name(), None, &field, &problem));
            if problem.starts_with("unknown field")
                && let Some(meant) = self.path_to(&field)
            {
                fault.problem = without_list(&problem, true).to_owned();
                fault.nearest = Some(meant);
            }
            SceneError::Overridden { overrides: cause.join(", "), fault }
        })
    }

    /// Returns the parameters (`[parameters]`) in the order of the text, with overrides applied:
    /// `parameters.NAME=VALUE` changes one.
    ///
    /// # Errors
    /// The same as those of [`Self::scene`], for the parameters only.
    pub fn parameters(&self, overrides: &[Override]) -> Result<Vec<Parameter>, SceneError> {
        Ok(parameters::list(&self.changed(overrides)?).map_err(|problem| self.fault(&problem))?)
    }

    /// Returns one text with the content of all files; a single file is returned unchanged.
    pub fn whole(&self) -> Cow<'_, str> {
        match &self.sources[..] {
            [own] => Cow::Borrowed(&own.text),
            _ => Cow::Owned(toml::to_string(&self.table).expect("it has only strings as keys")),
        }
    }

    /// Name of the text in errors: the path from which it was read.
    pub fn name(&self) -> &str {
        self.sources.last().map_or("", |own| &own.name)
    }

    fn changed(&self, overrides: &[Override]) -> Result<Table, SceneError> {
        let mut table = self.table.clone();
        overrides.iter().try_for_each(|changed| changed.apply(&mut table))?;
        Ok(table)
    }

    /// First path to a field of this name in a list of the scene.
    fn path_to(&self, name: &str) -> Option<String> {
        let lists = self.table.iter().filter(|(list, _)| include::is_list(list));
        lists.filter_map(|(list, value)| Some((list, value.as_array()?))).find_map(|(list, all)| {
            let has = |value: &Value| value.as_table().is_some_and(|it| it.contains_key(name));
            Some(format!("{list}.{}.{name}", all.iter().position(has)?))
        })
    }

    fn parameter_names(&self) -> impl Iterator<Item = &str> {
        let table = self.table.get(parameters::TABLE).and_then(Value::as_table);
        table.into_iter().flat_map(Table::keys).map(String::as_str)
    }

    /// Locates a problem in the file and line that state the field.
    fn fault(&self, problem: &Problem) -> Fault {
        let place = place_of(problem);
        if let Some((source, skipped)) = self.source_of_element(&place) {
            // Indices in errors count within one file.
            let place = renumbered(&place, skipped);
            let field = match problem.field.split_once(']') {
                Some((_, rest)) => format!("{}[{}]{rest}", place[0], place[1]),
                None => problem.field.clone(),
            };
            let line = source.line_of(&place).map(|(line, _)| line);
            return fault(&source.name, line, &field, &problem.problem);
        }
        // If several files state the field, choose the last of those that contain the longest part
        // of its path.
        let found = self.sources.iter().map(|source| (source, source.line_of(&place)));
        let found = found.max_by_key(|(_, found)| found.map_or(0, |(_, steps)| steps));
        let (name, line) = found.map_or((self.name(), None), |(source, found)| {
            (&*source.name, found.map(|(line, _)| line))
        });
        fault(name, line, &problem.field, &problem.problem)
    }

    /// Returns the file that contains the element of a list at `place`, and the number of elements
    /// in the files before it.
    fn source_of_element(&self, place: &[String]) -> Option<(&SourceText, usize)> {
        let [list, index, ..] = place else { return None };
        let index: usize = index.parse().ok()?;
        let mut skipped = 0;
        for source in self.sources.iter().filter(|_| include::is_list(list)) {
            let count = source.table.get(list).and_then(Value::as_array).map_or(0, Vec::len);
            if index < skipped + count {
                return Some((source, skipped));
            }
            skipped += count;
        }
        None
    }
}

/// Subtracts `skipped` from the index of an element in a path.
fn renumbered(place: &[String], skipped: usize) -> Vec<String> {
    let renumber = |(i, name): (usize, &String)| match name.parse::<usize>() {
        Ok(index) if i == 1 => (index - skipped).to_string(),
        _ => name.clone(),
    };
    place.iter().enumerate().map(renumber).collect()
}

/// Path of the cause of a problem, as names and indices.
fn place_of(problem: &Problem) -> Vec<String> {
    let mut place = segments(&problem.field);
    // "unknown field `x`" is reported at the table that contains x; a missing field has no place.
    if !problem.problem.starts_with("missing field") {
        place.extend(problem.problem.split('`').nth(1).map(str::to_owned));
    }
    place
}
