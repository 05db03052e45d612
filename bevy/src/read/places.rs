//! Places of entities in the world.

use bevy_ecs::prelude::*;
use bevy_ecs::system::SystemParam;
use bevy_transform::components::Transform;
use bevy_transform::helper::TransformHelper;

/// Computes where entities are in the world from their `Transform` and those of their parents.
#[derive(SystemParam)]
pub struct Places<'w, 's> {
    helper: TransformHelper<'w, 's>,
    children: Query<'w, 's, (), With<ChildOf>>,
}

impl Places<'_, '_> {
    /// Returns the place of an entity; that of its own `Transform` where a parent has none.
    pub fn of(&self, entity: Entity, local: &Transform) -> Transform {
        if !self.children.contains(entity) {
            return *local;
        }
        let global = self.helper.compute_global_transform(entity);
        global.map_or(*local, |global| global.compute_transform())
    }
}
