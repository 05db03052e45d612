//! Builds glTF files for tests.
#![allow(dead_code, reason = "each test uses a part")]

use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use carom_gltf::{ImportError, Imported, Options};
use serde_json::{Value, json};
use tempfile::TempDir;

/// A file under construction.
pub struct Gltf {
    pub json: Value,
    bytes: Vec<u8>,
}

impl Gltf {
    /// Creates a file with these nodes; all nodes without parents are in the scene.
    pub fn with_nodes(nodes: Value) -> Self {
        let children: Vec<u64> = nodes
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|it| it["children"].as_array().cloned().unwrap_or_default())
            .map(|it| it.as_u64().unwrap())
            .collect();
        let roots = 0..nodes.as_array().unwrap().len() as u64;
        let roots: Vec<u64> = roots.filter(|it| !children.contains(it)).collect();
        let json = json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": roots }],
            "nodes": nodes,
            "meshes": [], "accessors": [], "bufferViews": [],
        });
        Self { json, bytes: Vec::new() }
    }

    /// Sets a value at the top level.
    pub fn with(mut self, name: &str, value: Value) -> Self {
        self.json[name] = value;
        self
    }

    /// Adds a mesh of these triangles, with a material if there is one.
    pub fn with_mesh(
        mut self,
        vertices: &[[f32; 3]],
        indices: &[u16],
        material: Option<u64>,
    ) -> Self {
        let places = vertices.as_flattened().iter().flat_map(|it| it.to_le_bytes()).collect();
        let position = self.push(places, 5126, "VEC3", vertices.len());
        let bytes = indices.iter().flat_map(|it| it.to_le_bytes()).collect();
        let indices = self.push(bytes, 5123, "SCALAR", indices.len());
        let mut primitive = json!({ "attributes": { "POSITION": position }, "indices": indices });
        if let Some(material) = material {
            primitive["material"] = material.into();
        }
        let meshes = self.json["meshes"].as_array_mut().unwrap();
        meshes.push(json!({ "primitives": [primitive] }));
        self
    }

    fn push(&mut self, bytes: Vec<u8>, component: u32, kind: &str, count: usize) -> usize {
        let view =
            json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let views = self.json["bufferViews"].as_array_mut().unwrap();
        views.push(view);
        let view = views.len() - 1;
        let accessors = self.json["accessors"].as_array_mut().unwrap();
        accessors.push(
            json!({ "bufferView": view, "componentType": component, "type": kind, "count": count }),
        );
        accessors.len() - 1
    }

    /// Writes the file as .gltf with an embedded buffer.
    pub fn text(&self) -> String {
        let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&self.bytes));
        self.text_with_buffer(&uri)
    }

    /// Writes the file as .gltf with its buffer at an address.
    pub fn text_with_buffer(&self, uri: &str) -> String {
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "byteLength": self.bytes.len(), "uri": uri }]);
        serde_json::to_string_pretty(&json).unwrap()
    }

    /// Content of the buffer.
    pub fn buffer(&self) -> &[u8] {
        &self.bytes
    }

    /// Writes the file as .glb.
    pub fn binary(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        let mut text = serde_json::to_vec(&json).unwrap();
        text.resize(text.len().next_multiple_of(4), b' ');
        let whole = 12 + 8 + text.len() + 8 + self.bytes.len();
        let words = |words: [usize; 2]| words.map(|it| (it as u32).to_le_bytes()).concat();
        [
            b"glTF".to_vec(),
            words([2, whole]),
            words([text.len(), 0x4e4f_534a]),
            text,
            words([self.bytes.len(), 0x004e_4942]),
            self.bytes.clone(),
        ]
        .concat()
    }

    /// Imports the file as .gltf.
    pub fn import(&self) -> Result<Imported, ImportError> {
        import_bytes("scene.gltf", self.text().as_bytes())
    }

    /// Imports the file as .gltf, which must succeed.
    pub fn imported(&self) -> Imported {
        self.import().unwrap()
    }
}

/// Imports a file with this content.
pub fn import_bytes(name: &str, bytes: &[u8]) -> Result<Imported, ImportError> {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    carom_gltf::import(&path, &Options::default())
}

/// Path of a file of the fixtures.
pub fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name)
}

/// Lines of a report.
pub fn report(imported: &Imported) -> Vec<String> {
    imported.omissions.iter().map(ToString::to_string).collect()
}

/// Triangles of a sphere about a point, with `slices` slices and half as many stacks.
pub fn sphere(center: [f32; 3], radius: f32, slices: u16) -> (Vec<[f32; 3]>, Vec<u16>) {
    let stacks = slices / 2;
    let mut vertices = Vec::new();
    for stack in 0..=stacks {
        let polar = std::f64::consts::PI * f64::from(stack) / f64::from(stacks);
        for slice in 0..slices {
            let around = std::f64::consts::TAU * f64::from(slice) / f64::from(slices);
            let place = [polar.sin() * around.cos(), polar.cos(), polar.sin() * around.sin()];
            vertices.push([0, 1, 2].map(|i| center[i] + radius * place[i] as f32));
        }
    }
    let mut indices = Vec::new();
    for stack in 0..stacks {
        for slice in 0..slices {
            let next = (slice + 1) % slices;
            let [a, b] = [stack * slices + slice, stack * slices + next];
            indices.extend([a, b, b + slices, a, b + slices, a + slices]);
        }
    }
    (vertices, indices)
}

/// Triangles of a box about the origin.
pub fn cube(size: [f32; 3]) -> (Vec<[f32; 3]>, Vec<u16>) {
    let corner =
        |i: u16| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 0.5 } else { -0.5 } * size[axis]);
    let faces =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let indices = faces.iter().flat_map(|[a, b, c, d]| [*a, *b, *c, *a, *c, *d]).collect();
    ((0..8).map(corner).collect(), indices)
}

/// Triangles of a rectangle in the xz plane that faces +y.
pub fn rectangle(x: f32, z: f32) -> (Vec<[f32; 3]>, Vec<u16>) {
    let (x, z) = (0.5 * x, 0.5 * z);
    (vec![[-x, 0.0, z], [x, 0.0, z], [x, 0.0, -z], [-x, 0.0, -z]], vec![0, 1, 2, 0, 2, 3])
}
