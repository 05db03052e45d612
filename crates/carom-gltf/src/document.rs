//! The JSON of a glTF 2.0 file, limited to the parts that this crate writes or reads.
//!
//! Names and meanings are those of the specification of Khronos. Numbers have 64 bits, as in JSON.

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::rigid_body::{NodeBody, RigidBodies, Shapes};

/// Component type: 32-bit floats.
pub(crate) const FLOAT: u32 = 5126;
/// Component type: unsigned 16-bit indices.
pub(crate) const UNSIGNED_SHORT: u32 = 5123;

/// The JSON of a file.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Document {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub asset: Option<Asset>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub extensions_used: Vec<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub extensions_required: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene: Option<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub scenes: Vec<Scene>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub nodes: Vec<Node>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub cameras: Vec<Camera>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub meshes: Vec<Mesh>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub materials: Vec<Material>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub animations: Vec<Animation>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub accessors: Vec<Accessor>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub buffer_views: Vec<BufferView>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub buffers: Vec<Buffer>,
    pub extensions: DocumentExtensions,
    #[serde(skip_serializing)]
    pub skins: Vec<IgnoredAny>,
    #[serde(skip_serializing)]
    pub textures: Vec<IgnoredAny>,
}

/// Version of glTF, and the program that wrote the file.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Asset {
    pub version: String,
    #[serde(default)]
    pub generator: String,
}

/// Extensions of the file.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct DocumentExtensions {
    #[serde(rename = "KHR_lights_punctual", skip_serializing_if = "Option::is_none")]
    pub lights: Option<Lights>,
    #[serde(rename = "KHR_implicit_shapes", skip_serializing_if = "Option::is_none")]
    pub shapes: Option<Shapes>,
    #[serde(rename = "KHR_physics_rigid_bodies", skip_serializing_if = "Option::is_none")]
    pub bodies: Option<RigidBodies>,
}

/// A scene: its nodes without parents.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Scene {
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub nodes: Vec<usize>,
}

/// A node with its transformation.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Node {
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub translation: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub matrix: Option<[f64; 16]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub children: Vec<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<usize>,
    #[serde(skip_serializing)]
    pub skin: Option<usize>,
    #[serde(skip_serializing_if = "NodeExtensions::is_empty")]
    pub extensions: NodeExtensions,
}

/// Extensions of a node.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct NodeExtensions {
    #[serde(rename = "KHR_lights_punctual", skip_serializing_if = "Option::is_none")]
    pub light: Option<LightReference>,
    #[serde(rename = "KHR_physics_rigid_bodies", skip_serializing_if = "Option::is_none")]
    pub body: Option<Box<NodeBody>>,
}

impl NodeExtensions {
    fn is_empty(&self) -> bool {
        self.light.is_none() && self.body.is_none()
    }
}

/// The light of a node.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct LightReference {
    pub light: usize,
}

/// Lights of the file.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Lights {
    pub lights: Vec<Light>,
}

/// A light; a directional one shines along its node's local -z.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Light {
    #[serde(rename = "type")]
    pub kind: String,
    /// Colour, linear.
    #[serde(default = "white")]
    pub color: [f64; 3],
    /// Illuminance of a directional light \[lx\].
    #[serde(default = "one")]
    pub intensity: f64,
}

/// A camera; it looks along its node's local -z.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Camera {
    #[serde(rename = "type")]
    pub kind: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub perspective: Option<Perspective>,
}

/// Perspective of a camera.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Perspective {
    /// Vertical field of view \[rad\].
    pub yfov: f64,
    /// Nearest distance drawn \[m\].
    pub znear: f64,
    /// Farthest distance drawn \[m\]; infinite if it is missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub zfar: Option<f64>,
}

/// A mesh that nodes draw.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Mesh {
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    pub primitives: Vec<Primitive>,
}

/// Triangles of one material.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Primitive {
    pub attributes: Attributes,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub indices: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<usize>,
    /// Kind of primitive: 4 triangles, 5 triangle strip, 6 triangle fan.
    #[serde(default = "four", skip_serializing_if = "is_four")]
    pub mode: u32,
    #[serde(default, skip_serializing)]
    pub targets: Vec<IgnoredAny>,
}

/// Accessors of vertex attributes.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(rename_all = "UPPERCASE", default)]
pub(crate) struct Attributes {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<usize>,
}

/// Material of a surface.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Material {
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    pub pbr_metallic_roughness: MetallicRoughness,
    #[serde(skip_serializing_if = "String::is_empty")]
    pub alpha_mode: String,
    #[serde(skip_serializing_if = "is_false")]
    pub double_sided: bool,
    #[serde(skip_serializing_if = "MaterialExtensions::is_empty")]
    pub extensions: MaterialExtensions,
}

/// A physically based material.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct MetallicRoughness {
    /// Linear colour with opacity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base_color_factor: Option<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub metallic_factor: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roughness_factor: Option<f64>,
}

/// Extensions of a material.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct MaterialExtensions {
    #[serde(rename = "KHR_materials_transmission", skip_serializing_if = "Option::is_none")]
    pub transmission: Option<Transmission>,
}

impl MaterialExtensions {
    fn is_empty(&self) -> bool {
        self.transmission.is_none()
    }
}

/// Fraction of light that passes through.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Transmission {
    pub transmission_factor: f64,
}

/// An animation of nodes.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Animation {
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    pub channels: Vec<Channel>,
    pub samplers: Vec<Sampler>,
}

/// A channel: one property of a node, and its sampler.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Channel {
    pub sampler: usize,
    pub target: Target,
}

/// Node and property that a channel animates.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Target {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub node: Option<usize>,
    pub path: String,
}

/// Keys: times and values.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Sampler {
    pub input: usize,
    pub output: usize,
    #[serde(default)]
    pub interpolation: String,
}

/// Position and type of an array of numbers.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Accessor {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub buffer_view: Option<usize>,
    #[serde(default, skip_serializing_if = "is_zero")]
    pub byte_offset: u64,
    pub component_type: u32,
    #[serde(default, skip_serializing_if = "is_false")]
    pub normalized: bool,
    pub count: u64,
    #[serde(rename = "type")]
    pub kind: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub min: Vec<f64>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub max: Vec<f64>,
    #[serde(default, skip_serializing)]
    pub sparse: Option<IgnoredAny>,
}

/// A section of a buffer.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct BufferView {
    pub buffer: usize,
    #[serde(default, skip_serializing_if = "is_zero")]
    pub byte_offset: u64,
    pub byte_length: u64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub byte_stride: Option<u64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target: Option<u32>,
}

/// Bytes of a file, of the address itself, or of the .glb file.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Buffer {
    pub byte_length: u64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uri: Option<String>,
}

fn white() -> [f64; 3] {
    [1.0; 3]
}

fn one() -> f64 {
    1.0
}

fn four() -> u32 {
    4
}

fn is_four(mode: &u32) -> bool {
    *mode == 4
}

fn is_zero(number: &u64) -> bool {
    *number == 0
}

fn is_false(value: &bool) -> bool {
    !*value
}
