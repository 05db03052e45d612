//! The JSON of a glTF 2.0 file, as far as it is written or read here.
//!
//! Names and meanings are those of the specification of Khronos. Numbers are kept in 64 bits, as JSON has them.

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::rigid_body::{NodeBody, RigidBodies, Shapes};

/// Accessors of 32-bit floats.
pub(crate) const FLOAT: u32 = 5126;
/// Accessors of unsigned 16-bit indices.
pub(crate) const UNSIGNED_SHORT: u32 = 5123;

/// A whole file.
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

/// The version of glTF, and which program wrote the file.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Asset {
    pub version: String,
    #[serde(default)]
    pub generator: String,
}

/// Extensions of a whole file.
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

/// The nodes of a scene that hang on no other.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Scene {
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub nodes: Vec<usize>,
}

/// What has a place.
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

/// Which light a node has.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct LightReference {
    pub light: usize,
}

/// Lights of a file.
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
    /// Linear.
    #[serde(default = "white")]
    pub color: [f64; 3],
    /// Of a directional light \[lx\].
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

/// What a camera sees in perspective.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Perspective {
    /// Vertical field of view \[rad\].
    pub yfov: f64,
    /// \[m\]
    pub znear: f64,
    /// \[m\]; without end where it is missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub zfar: Option<f64>,
}

/// What is drawn at nodes.
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
    /// 4: triangles, 5: a strip of them, 6: a fan.
    #[serde(default = "four", skip_serializing_if = "is_four")]
    pub mode: u32,
    #[serde(default, skip_serializing)]
    pub targets: Vec<IgnoredAny>,
}

/// Accessors of what each vertex has.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(rename_all = "UPPERCASE", default)]
pub(crate) struct Attributes {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<usize>,
}

/// How a surface looks.
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
    /// Linear, with opacity.
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

/// How much light goes through.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Transmission {
    pub transmission_factor: f64,
}

/// How nodes move.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Animation {
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    pub channels: Vec<Channel>,
    pub samplers: Vec<Sampler>,
}

/// What of a node moves, and how.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Channel {
    pub sampler: usize,
    pub target: Target,
}

/// What of a node moves.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Target {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub node: Option<usize>,
    pub path: String,
}

/// Times and values.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Sampler {
    pub input: usize,
    pub output: usize,
    #[serde(default)]
    pub interpolation: String,
}

/// Where numbers lie, and of what kind they are.
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

/// A part of a buffer.
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

/// Bytes: of a file, in the address itself, or those that come with a .glb file.
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
