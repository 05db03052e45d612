//! The file for `--map`: meanings of the fields of scripts.

use std::path::Path;

use serde::Deserialize;

use crate::error::{ImportError, read_text};

/// Meanings of the fields of scripts.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mapping {
    /// Kinds of scripts; the first kind that fits a script counts.
    #[serde(default)]
    pub(crate) scripts: Vec<ScriptKind>,
}

/// Scripts whose fields have the same meanings.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ScriptKind {
    /// Name of the kind in reports.
    pub name: String,
    /// File of the script, such as `Spawner.cs`; `None` for any file.
    pub file: Option<String>,
    /// Fields that every script of this kind has.
    #[serde(default)]
    pub fields: Vec<String>,
    /// Fields that are ignored.
    #[serde(default)]
    pub unused: Vec<String>,
    /// Fields of an emitter at the place of its object.
    pub emitter: Option<EmitterFields>,
    /// Fields of a sphere.
    pub sphere: Option<SphereFields>,
    /// Fields of a collider, whose shape is that of its object's mesh.
    pub collider: Option<ColliderFields>,
    /// Common properties of all spheres.
    pub properties: Option<PropertyFields>,
    /// Forces on every sphere.
    pub forces: Option<ForceFields>,
}

/// A number: a constant, or a field of the script.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub(crate) enum Number {
    /// A constant for all scripts.
    Constant(f64),
    /// Name of a field.
    Field(String),
}

/// A vector in Unity's coordinates: a constant, or a field of the script.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub(crate) enum Vector {
    /// A constant for all scripts.
    Constant([f64; 3]),
    /// Name of a field.
    Field(String),
}

/// Fields of an emitter.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct EmitterFields {
    /// Period \[s\].
    pub period: Number,
    pub max_spheres: Option<Number>,
    /// Diameter \[m\].
    pub diameter: Number,
    /// Mass \[kg\].
    pub mass: Option<Number>,
    /// Velocity in the emitter's coordinates \[m/s\].
    pub velocity: Option<Vector>,
}

/// Fields of a sphere.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereFields {
    /// Position in the world \[m\]; default: that of its object.
    pub position: Option<Vector>,
    /// Diameter \[m\]; default: the scale of its object.
    pub diameter: Option<Number>,
    /// Mass \[kg\].
    pub mass: Option<Number>,
    /// Velocity in the world \[m/s\].
    pub velocity: Option<Vector>,
    pub restitution: Option<Number>,
}

/// Fields of a collider.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ColliderFields {
    /// Restitution in [0, 1]; -1 for a collider that deflects nothing.
    pub restitution: Number,
}

/// Properties of spheres that state none.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PropertyFields {
    /// Mass \[kg\].
    pub mass: Option<Number>,
}

/// Forces on every sphere.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ForceFields {
    /// Force \[N\].
    pub constant: Option<Vector>,
    /// Acceleration \[m/s²\].
    pub gravity: Option<Vector>,
    /// Coefficient of drag \[kg/s\].
    pub viscous_drag: Option<Number>,
}

impl Mapping {
    /// Mapping of the scripts of the course.
    pub fn course() -> Self {
        toml::from_str(include_str!("course.toml")).expect("a test reads it")
    }

    /// Reads a mapping file. Its kinds take precedence over those of the course.
    ///
    /// # Errors
    /// [`ImportError`] for a file that cannot be read, or with the line of an error.
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
    /// Names of all fields that a script of this kind uses.
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
