//! Triangle meshes and height fields of scenes.

use std::fmt;
use std::sync::{Arc, OnceLock};

use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::values::{Vector, is_default, one};

/// A surface of triangles: from a file, or listed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// Path of a file that ends in .glb, .gltf, .obj or .stl, relative to the scene file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Vertices, in m.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub vertices: Vec<Vector>,
    /// Triangles: the numbers of three vertices each, from 0, against the clock as seen from the front.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub triangles: Vec<[u32; 3]>,
    /// Factor of all coordinates, > 0; 1 by default.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub scale: f64,
    /// Whether an open mesh is met from its front only; false by default. A closed one always is.
    #[serde(default, skip_serializing_if = "is_default")]
    pub one_sided: bool,
    #[serde(skip)]
    made: Made<Mesh>,
}

/// Ground over a rectangle in the local xz plane about the origin, given by heights. Spheres pass it from below.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeightField {
    /// Full length along local x, in m, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub size_x: f64,
    /// Full length along local z, in m, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub size_z: f64,
    /// Rows of heights along x, in m, from the lowest z on: two or more of the same length.
    pub heights: Vec<Vec<f64>>,
    #[serde(skip)]
    made: Made<HeightField>,
}

impl HeightField {
    /// Heights \[m\], in rows along x, over a rectangle of this size along x and z \[m\].
    pub fn new([size_x, size_z]: [f64; 2], heights: Vec<Vec<f64>>) -> Self {
        Self { size_x, size_z, heights, made: Made::default() }
    }

    /// The mesh of the heights, made once.
    pub(crate) fn mesh(&self) -> Result<carom::Mesh, String> {
        let alone = || Self { made: Made::default(), ..self.clone() };
        let make = || {
            let made = carom::Mesh::from_heights([self.size_x, self.size_z], &self.heights);
            made.map_err(|error| error.to_string())
        };
        self.made.get(self, alone, make)
    }
}

/// What was made of a description, as long as that is the same. Copies of the description share it.
#[derive(Clone)]
pub(super) struct Made<T>(Arc<OnceLock<(T, Result<carom::Mesh, String>)>>);

impl<T: PartialEq> Made<T> {
    pub(super) fn get(
        &self,
        now: &T,
        alone: impl FnOnce() -> T,
        make: impl Fn() -> Result<carom::Mesh, String>,
    ) -> Result<carom::Mesh, String> {
        let (of, made) = self.0.get_or_init(|| (alone(), make()));
        if of == now { made.clone() } else { make() }
    }
}

impl<T> Default for Made<T> {
    fn default() -> Self {
        Self(Arc::default())
    }
}

impl<T> fmt::Debug for Made<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Made")
    }
}

impl<T> PartialEq for Made<T> {
    /// Returns true: the made value follows from the description, which is compared by itself.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Mesh {
    /// A mesh of a file, at its own scale.
    pub fn of_file(path: impl Into<String>) -> Self {
        Self { file: Some(path.into()), ..Self::listed(Vec::new(), Vec::new()) }
    }

    /// Creates a mesh of listed vertices \[m\] and triangles.
    pub fn listed(vertices: Vec<Vector>, triangles: Vec<[u32; 3]>) -> Self {
        let (scale, made) = (1.0, Made::default());
        Self { file: None, vertices, triangles, scale, one_sided: false, made }
    }

    /// Returns what `make` makes of the description. It is called once: a file is read when it is first needed.
    pub(crate) fn mesh(
        &self,
        make: impl Fn(&Self) -> Result<carom::Mesh, String>,
    ) -> Result<carom::Mesh, String> {
        let alone = || Self { made: Made::default(), ..self.clone() };
        self.made.get(self, alone, || make(self))
    }
}

fn is_one(scale: &f64) -> bool {
    *scale == 1.0
}

/// The path of a file, or a mesh with its fields.
#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "describes what is written")]
pub(super) enum PathOrMesh {
    /// Path of a file that ends in .glb, .gltf, .obj or .stl, relative to the scene file.
    Path(String),
    /// A file with a scale, or lists.
    Mesh(Mesh),
}

/// Reads the path of a file, or a table.
pub(super) fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Mesh, D::Error> {
    struct Given;

    impl<'de> Visitor<'de> for Given {
        type Value = Mesh;

        fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
            formatter.write_str(
                "the path of a file, or a table with `file`, or `vertices` and `triangles`",
            )
        }

        fn visit_str<E: serde::de::Error>(self, path: &str) -> Result<Mesh, E> {
            Ok(Mesh::of_file(path))
        }

        fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Mesh, A::Error> {
            Mesh::deserialize(MapAccessDeserializer::new(map))
        }
    }

    deserializer.deserialize_any(Given)
}
