//! Reads files with all their objects, including those of prefab instances.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use carom_scene::import::{Omission, omit};

use crate::class;
use crate::document::{self, Document};
use crate::error::{ImportError, Place};
use crate::modification::Modification;
use crate::project::Project;
use crate::value::{Kind, Value};

/// Reads scenes and prefabs, each file once.
pub(crate) struct Loader<'a> {
    project: &'a Project,
    loaded: BTreeMap<PathBuf, Rc<Vec<Document>>>,
    /// Files that are being read: each contains an instance of the next.
    open: Vec<PathBuf>,
    /// Remaining memory for copies of objects \[bytes\].
    memory_left: usize,
    /// Omissions so far.
    pub report: Vec<Omission>,
}

impl<'a> Loader<'a> {
    /// Creates a loader for files of this project.
    pub fn new(project: &'a Project) -> Self {
        /// Limit on the memory of copies \[bytes\]: nested prefabs can double the number of objects
        /// with each line.
        const MEMORY: usize = 512 << 20;
        let report = project.omissions().to_vec();
        Self { project, loaded: BTreeMap::new(), open: Vec::new(), memory_left: MEMORY, report }
    }

    /// Reads all objects of a scene or prefab, in the order of the file. The objects of a prefab
    /// instance take its place.
    ///
    /// # Errors
    /// [`ImportError`] for a broken file, or for prefabs that contain themselves or are too many.
    pub fn objects(&mut self, path: &Path) -> Result<Rc<Vec<Document>>, ImportError> {
        if let Some(objects) = self.loaded.get(path) {
            return Ok(objects.clone());
        }
        let documents = document::read(path)?;
        self.open.push(path.to_path_buf());
        let mut objects = Vec::new();
        let mut stripped: BTreeMap<i64, Vec<(i64, i64)>> = BTreeMap::new();
        for document in documents.iter().filter(|it| it.stripped) {
            if let Some((instance, source)) = stands_for(document) {
                stripped.entry(instance).or_default().push((source, document.id));
            }
        }
        for document in documents {
            if document.class == class::PREFAB_INSTANCE {
                let known = stripped.remove(&document.id).unwrap_or_default();
                objects.extend(self.instance(&document, &known.into_iter().collect())?);
            } else if !document.stripped {
                objects.push(document);
            }
        }
        let mut ids = BTreeSet::new();
        if let Some(twice) = objects.iter().find(|object| !ids.insert(object.id)) {
            return Err(twice
                .fields
                .place
                .malformed(format!("the id {} is there twice", twice.id)));
        }
        self.open.pop();
        let objects = Rc::new(objects);
        self.loaded.insert(path.to_path_buf(), objects.clone());
        Ok(objects)
    }

    /// Creates the objects of a prefab instance. `known` maps ids in the prefab to the ids that the
    /// file gives to some of them.
    fn instance(
        &mut self,
        instance: &Document,
        known: &BTreeMap<i64, i64>,
    ) -> Result<Vec<Document>, ImportError> {
        let Some((path, changes)) = self.source(instance)? else { return Ok(Vec::new()) };
        let source = self.objects(&path)?;
        let removed = removed(instance, &source);
        let mut objects: Vec<_> =
            source.iter().filter(|object| !removed.contains(&object.id)).cloned().collect();
        self.pay(&objects, &instance.fields.place)?;
        let new_id = |id: i64| {
            // Unity's rule for the ids of objects in nested prefabs.
            known.get(&id).copied().unwrap_or((instance.id ^ id) & i64::MAX)
        };
        let parent = changes.and_then(|it| it.get("m_TransformParent")?.reference());
        for object in &mut objects {
            let is_root = class::is_transform(object.class)
                && object.fields.get("m_Father").and_then(Value::reference).is_none();
            object.fields.refer(&new_id);
            if is_root {
                let id = parent.as_ref().map_or(0, |it| it.id);
                set_father(&mut object.fields, id);
            }
        }
        let index: BTreeMap<i64, usize> =
            objects.iter().enumerate().map(|(index, object)| (object.id, index)).collect();
        let modifications = changes.and_then(|it| it.get("m_Modifications"));
        for item in modifications.map_or(&[][..], Value::items) {
            let modification = Modification::new(item)?;
            match index.get(&modification.target) {
                Some(&index) => modification.apply(&mut objects[index].fields)?,
                None if removed.contains(&modification.target) => {}
                None => {
                    let what = format!("modification of {}", modification.path);
                    let reason = "its object is not in the prefab (any more)";
                    omit(&mut self.report, &self.project.shown(&path), &what, reason);
                }
            }
        }
        objects.iter_mut().for_each(|object| object.id = new_id(object.id));
        Ok(objects)
    }

    /// Finds the file of the prefab, and the modifications of the instance; `None` if there is no
    /// such file.
    fn source<'b>(
        &mut self,
        instance: &'b Document,
    ) -> Result<Option<(PathBuf, Option<&'b Value>)>, ImportError> {
        const DEEPEST: usize = 32;
        let fields = &instance.fields;
        // The second name is that of Unity up to 2018.2.
        let source = fields.get("m_SourcePrefab").or_else(|| fields.get("m_ParentPrefab"));
        let changes = fields.get("m_Modification");
        let object = self.project.shown(&fields.place.file);
        let Some(guid) = source.and_then(Value::reference).and_then(|it| it.guid) else {
            // Prefabs of Unity up to 2018.2 contain such a document for themselves.
            if fields.get("m_RootGameObject").is_none() {
                omit(&mut self.report, &object, "prefab instance", "names no prefab");
            }
            return Ok(None);
        };
        let Some(path) = self.project.file(&guid).map(Path::to_path_buf) else {
            let reason = format!("no file of the project has its guid {guid}");
            omit(&mut self.report, &object, "prefab instance", reason);
            return Ok(None);
        };
        if path.extension().is_none_or(|ending| ending != "prefab") {
            let reason = format!("{} is no prefab", self.project.shown(&path));
            omit(&mut self.report, &object, "prefab instance", reason);
            return Ok(None);
        }
        if self.open.contains(&path) {
            let problem = format!("the prefab {} holds itself", path.display());
            return Err(fields.place.malformed(problem));
        }
        if self.open.len() == DEEPEST {
            return Err(fields.place.malformed("prefabs are more than 32 deep in each other"));
        }
        Ok(Some((path, changes)))
    }

    /// Subtracts the memory of copies from the remaining memory.
    fn pay(&mut self, objects: &[Document], place: &Place) -> Result<(), ImportError> {
        let cost = objects.iter().map(|it| size_of::<Document>() + it.fields.size()).sum();
        let too_much = || place.malformed("all instances of prefabs take more than 512 MiB");
        self.memory_left = self.memory_left.checked_sub(cost).ok_or_else(too_much)?;
        Ok(())
    }
}

/// For a stripped document, returns the prefab instance and the id in the prefab of the object for
/// which it stands.
fn stands_for(document: &Document) -> Option<(i64, i64)> {
    let reference = |new: &str, old: &str| {
        document.fields.get(new).or_else(|| document.fields.get(old))?.reference()
    };
    let instance = reference("m_PrefabInstance", "m_PrefabInternal")?;
    let source = reference("m_CorrespondingSourceObject", "m_PrefabParentObject")?;
    Some((instance.id, source.id))
}

fn set_father(fields: &mut Value, id: i64) {
    let Kind::Map(all) = &mut fields.kind else { return };
    let id = Value { place: fields.place.clone(), kind: Kind::Text(id.to_string()) };
    let father =
        Value { place: fields.place.clone(), kind: Kind::Map(vec![("fileID".to_owned(), id)]) };
    all.retain(|(name, _)| name != "m_Father");
    all.push(("m_Father".to_owned(), father));
}

/// Ids that an instance removes: components, and objects with all their descendants.
fn removed(instance: &Document, source: &[Document]) -> BTreeSet<i64> {
    let changes = instance.fields.get("m_Modification");
    let list = |name: &str| {
        let list = changes.and_then(|it| it.get(name)).map_or(&[][..], Value::items);
        list.iter().filter_map(Value::reference).map(|it| it.id)
    };
    let mut removed: BTreeSet<i64> =
        list("m_RemovedComponents").chain(list("m_RemovedGameObjects")).collect();
    if removed.is_empty() {
        return removed;
    }
    // Removes children of removed objects. A file may list them in any order, so this repeats until
    // nothing changes.
    loop {
        let before = removed.len();
        for object in source {
            let refers = |name: &str| object.fields.get(name).and_then(Value::reference);
            let owners = [refers("m_GameObject"), refers("m_Father")];
            if owners.iter().flatten().any(|owner| removed.contains(&owner.id)) {
                removed.insert(object.id);
                if class::is_transform(object.class) {
                    removed.extend(refers("m_GameObject").map(|it| it.id));
                }
            }
        }
        if removed.len() == before {
            return removed;
        }
    }
}
