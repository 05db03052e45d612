//! Names of extensions of glTF.

/// Lights.
pub(crate) const LIGHTS: &str = "KHR_lights_punctual";
/// Shapes for physics.
pub(crate) const SHAPES: &str = "KHR_implicit_shapes";
/// Bodies for physics.
pub(crate) const BODIES: &str = "KHR_physics_rigid_bodies";
/// Materials that transmit light.
pub(crate) const TRANSMISSION: &str = "KHR_materials_transmission";

/// Extensions that an import reads.
pub(crate) const READ: [&str; 5] = [LIGHTS, SHAPES, BODIES, TRANSMISSION, "KHR_mesh_quantization"];
