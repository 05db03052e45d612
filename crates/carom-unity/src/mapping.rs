//! Which fields of scripts mean what: the file for `--map`.

use std::path::Path;

use serde::Deserialize;

use crate::error::{ImportError, read_text};

/// What the fields of scripts mean.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mapping {
    /// Kinds of scripts; a script is of the first kind that fits.
    #[serde(default)]
    pub(crate) scripts: Vec<ScriptKind>,
}

/// Scripts that mean the same.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ScriptKind {
    /// What reports call it.
    pub name: String,
    /// File of the script, like `Spawner.cs`; any where it is missing.
    pub file: Option<String>,
    /// Fields that a script of this kind has.
    #[serde(default)]
    pub fields: Vec<String>,
    /// Fields that mean nothing here.
    #[serde(default)]
    pub unused: Vec<String>,
    /// It emits spheres where its object is.
    pub emitter: Option<EmitterFields>,
    /// It is a sphere.
    pub sphere: Option<SphereFields>,
    /// Its object is a collider, in the form of its mesh.
    pub collider: Option<ColliderFields>,
    /// What all spheres have in common.
    pub properties: Option<PropertyFields>,
    /// Forces on every sphere.
    pub forces: Option<ForceFields>,
}

/// A number of the script, or one for all scripts.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub(crate) enum Number {
    /// A number for all scripts.
    Constant(f64),
    /// The name of the field.
    Field(String),
}

/// A vector of the script in Unity's frame, or one for all scripts.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub(crate) enum Vector {
    /// A vector for all scripts.
    Constant([f64; 3]),
    /// The name of the field.
    Field(String),
}

/// What an emitter has.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct EmitterFields {
    /// In s.
    pub period: Number,
    pub max_spheres: Option<Number>,
    /// In m.
    pub diameter: Number,
    /// In kg.
    pub mass: Option<Number>,
    /// In m/s, in the emitter's frame.
    pub velocity: Option<Vector>,
}

/// What a sphere has.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereFields {
    /// In m, in the world; where its object is where it is missing.
    pub position: Option<Vector>,
    /// In m; the scale of its object where it is missing.
    pub diameter: Option<Number>,
    /// In kg.
    pub mass: Option<Number>,
    /// In m/s, in the world.
    pub velocity: Option<Vector>,
    pub restitution: Option<Number>,
}

/// What a collider has.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ColliderFields {
    /// In [0, 1]; -1 for a collider that deflects nothing.
    pub restitution: Number,
}

/// What spheres have that say nothing else.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PropertyFields {
    /// In kg.
    pub mass: Option<Number>,
}

/// What acts on spheres.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ForceFields {
    /// In N.
    pub constant: Option<Vector>,
    /// In m/s².
    pub gravity: Option<Vector>,
    /// In kg/s.
    pub viscous_drag: Option<Number>,
}

impl Mapping {
    /// The scripts of the course.
    pub fn course() -> Self {
        toml::from_str(include_str!("course.toml")).expect("a test reads it")
    }

    /// Reads a mapping file. Its kinds come before those of the course.
    ///
    /// # Errors
    /// Files that cannot be read, and what makes no sense in them, with the line.
    pub fn from_file(path: &Path) -> Result<Self, ImportError> {
        let text = read_text(path)?;
        let malformed = |line: usize, problem: String| ImportError::Malformed {
            path: path.to_path_buf(),
            line,
            problem,
        };
        let mut mapping: Self = toml::from_str(&text).map_err(|error| {
            let start = error.span().map_or(0, |span| span.start.min(text.len()));
            let line = 1 + text.as_bytes()[..start].iter().filter(|&&it| it == b'\n').count();
            malformed(line, error.message().to_owned())
        })?;
        let vague = mapping.scripts.iter().find(|it| it.file.is_none() && it.fields.is_empty());
        if let Some(ScriptKind { name, .. }) = vague {
            let problem = format!("the scripts \"{name}\" need `fields` or a `file`");
            return Err(ImportError::Refused { path: path.to_path_buf(), problem });
        }
        mapping.scripts.extend(Self::course().scripts);
        Ok(mapping)
    }
}

impl ScriptKind {
    /// Every field that it reads.
    pub fn read_fields(&self) -> Vec<&str> {
        let mut fields: Vec<&str> = Vec::new();
        fields.extend(self.fields.iter().map(String::as_str));
        fields.extend(self.unused.iter().map(String::as_str));
        let mut numbers: Vec<Option<&Number>> = Vec::new();
        let mut vectors: Vec<Option<&Vector>> = Vec::new();
        if let Some(emitter) = &self.emitter {
            let EmitterFields { period, max_spheres, diameter, mass, velocity } = emitter;
            numbers.extend([Some(period), max_spheres.as_ref(), Some(diameter), mass.as_ref()]);
            vectors.push(velocity.as_ref());
        }
        if let Some(SphereFields { position, diameter, mass, velocity, restitution }) = &self.sphere
        {
            numbers.extend([diameter.as_ref(), mass.as_ref(), restitution.as_ref()]);
            vectors.extend([position.as_ref(), velocity.as_ref()]);
        }
        numbers.push(self.collider.as_ref().map(|it| &it.restitution));
        numbers.push(self.properties.as_ref().and_then(|it| it.mass.as_ref()));
        if let Some(ForceFields { constant, gravity, viscous_drag }) = &self.forces {
            vectors.extend([constant.as_ref(), gravity.as_ref()]);
            numbers.push(viscous_drag.as_ref());
        }
        fields.extend(numbers.into_iter().flatten().filter_map(|it| match it {
            Number::Field(name) => Some(name.as_str()),
            Number::Constant(_) => None,
        }));
        fields.extend(vectors.into_iter().flatten().filter_map(|it| match it {
            Vector::Field(name) => Some(name.as_str()),
            Vector::Constant(_) => None,
        }));
        fields
    }
}
