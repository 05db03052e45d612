//! Numbers of Unity's classes that are imported.

/// An object with components.
pub(crate) const GAME_OBJECT: u32 = 1;
/// Position, rotation and scale of a game object.
pub(crate) const TRANSFORM: u32 = 4;
pub(crate) const CAMERA: u32 = 20;
pub(crate) const MATERIAL: u32 = 21;
/// Draws a mesh with materials.
pub(crate) const MESH_RENDERER: u32 = 23;
/// Refers to the mesh that is drawn.
pub(crate) const MESH_FILTER: u32 = 33;
pub(crate) const RIGIDBODY: u32 = 54;
pub(crate) const MESH_COLLIDER: u32 = 64;
pub(crate) const BOX_COLLIDER: u32 = 65;
pub(crate) const LIGHT: u32 = 108;
/// A script component.
pub(crate) const MONO_BEHAVIOUR: u32 = 114;
pub(crate) const PHYSIC_MATERIAL: u32 = 134;
pub(crate) const SPHERE_COLLIDER: u32 = 135;
pub(crate) const CAPSULE_COLLIDER: u32 = 136;
/// Transform of an element of the user interface.
const RECT_TRANSFORM: u32 = 224;
pub(crate) const PREFAB_INSTANCE: u32 = 1001;

/// Settings of a scene, such as lighting and navigation.
pub(crate) const SETTINGS: [u32; 5] = [29, 104, 157, 196, 1_660_057_539];

/// Whether the class is a transform of a game object.
pub(crate) const fn is_transform(class: u32) -> bool {
    matches!(class, TRANSFORM | RECT_TRANSFORM)
}
