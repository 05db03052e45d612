//! Modifications that an instance of a prefab makes in its objects.

use crate::error::ImportError;
use crate::value::{Kind, Value};

/// A field that an instance of a prefab modifies.
pub(crate) struct Modification<'a> {
    /// Id of the object in the prefab.
    pub target: i64,
    /// Path of the field, such as `m_LocalPosition.x` or `m_Materials.Array.data[0]`.
    pub path: &'a str,
    /// The new value: a text, or a reference to an object.
    value: &'a Value,
}

impl<'a> Modification<'a> {
    /// Reads an item of `m_Modifications`.
    ///
    /// # Errors
    /// [`ImportError`] if target, path or value is missing.
    pub fn new(item: &'a Value) -> Result<Self, ImportError> {
        let part = |name: &str| {
            let missing = || item.place.malformed(format!("the modification has no {name}"));
            item.get(name).ok_or_else(missing)
        };
        let path = part("propertyPath")?;
        let path =
            path.text().ok_or_else(|| path.place.malformed("propertyPath must be a text"))?;
        let target = part("target")?.reference().map_or(0, |it| it.id);
        let value = match item.get("objectReference") {
            Some(object) if object.reference().is_some() => object,
            _ => part("value")?,
        };
        Ok(Self { target, path, value })
    }

    /// Sets the field of its target; creates missing parts of the path.
    ///
    /// # Errors
    /// [`ImportError`] if the path leads through a text, or is too long.
    pub fn apply(&self, fields: &mut Value) -> Result<(), ImportError> {
        const LONGEST: usize = 16;
        let steps = steps(self.path);
        let refuse = |problem: &str| {
            self.value.place.malformed(format!("the modification of {}: {problem}", self.path))
        };
        if steps.len() > LONGEST {
            return Err(refuse("its path has too many parts"));
        }
        let mut at = fields;
        for step in steps {
            at = match step {
                Step::Size => return resize(at, self.value).ok_or_else(|| refuse("it is no size")),
                Step::Item(index) => item(at, index),
                Step::Field(name) => field(at, name),
            }
            .ok_or_else(|| refuse("its path leads nowhere"))?;
        }
        *at = self.value.clone();
        Ok(())
    }
}

/// A step of the path to a field.
enum Step<'a> {
    Field(&'a str),
    /// An item of a list: `Array.data[0]`.
    Item(usize),
    /// The length of a list: `Array.size`.
    Size,
}

fn steps(path: &str) -> Vec<Step<'_>> {
    let mut steps = Vec::new();
    let mut parts = path.split('.').peekable();
    while let Some(part) = parts.next() {
        let index = |it: &str| it.strip_prefix("data[")?.strip_suffix(']')?.parse().ok();
        let of_list = match (part, parts.peek()) {
            ("Array", Some(&"size")) => Some(Step::Size),
            ("Array", Some(next)) => index(next).map(Step::Item),
            _ => None,
        };
        match of_list {
            Some(step) => {
                parts.next();
                steps.push(step);
            }
            None => steps.push(Step::Field(part)),
        }
    }
    steps
}

/// Longest list that a modification may create.
const LONGEST_LIST: usize = 10_000;

fn resize(list: &mut Value, size: &Value) -> Option<()> {
    let size = size.text()?.parse().ok().filter(|&size| size <= LONGEST_LIST)?;
    let items = made_list(list)?;
    items.truncate(size);
    Some(())
}

fn item(list: &mut Value, index: usize) -> Option<&mut Value> {
    let empty = Value { place: list.place.clone(), kind: Kind::Text(String::new()) };
    let items = made_list(list)?;
    if index >= LONGEST_LIST {
        return None;
    }
    if items.len() <= index {
        items.resize(index + 1, empty);
    }
    items.get_mut(index)
}

/// Items of a list; turns an empty value into a list.
fn made_list(value: &mut Value) -> Option<&mut Vec<Value>> {
    if matches!(&value.kind, Kind::Text(text) if text.is_empty()) {
        value.kind = Kind::List(Vec::new());
    }
    match &mut value.kind {
        Kind::List(items) => Some(items),
        _ => None,
    }
}

fn field<'a>(map: &'a mut Value, name: &str) -> Option<&'a mut Value> {
    let empty = Value { place: map.place.clone(), kind: Kind::Text(String::new()) };
    if matches!(&map.kind, Kind::Text(text) if text.is_empty()) {
        map.kind = Kind::Map(Vec::new());
    }
    let Kind::Map(fields) = &mut map.kind else { return None };
    let index = fields.iter().position(|(it, _)| it == name).unwrap_or_else(|| {
        fields.push((name.to_owned(), empty));
        fields.len() - 1
    });
    Some(&mut fields[index].1)
}
