//! Detects balls that leave closed containers, which is impossible without passing a wall.

use carom::{Collider, ColliderId, DVec3, Shape, Sides, SphereId, World};

/// Tracks which balls are inside each closed container.
#[derive(Debug, Default)]
pub struct Escapes {
    /// Ids of the balls inside each closed container at the last check, ascending.
    inside: Vec<(ColliderId, Vec<SphereId>)>,
    first: Option<Escape>,
    count: u64,
}

/// A ball that has left a closed container.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Escape {
    sphere: SphereId,
    container: ColliderId,
    /// Time at which it was found outside \[s\].
    time: f64,
}

impl Escapes {
    /// Finds the balls inside each container, and counts those that left since the last call.
    pub fn look(&mut self, world: &World) {
        let inside: Vec<_> = world
            .colliders()
            .filter_map(|(id, collider)| {
                Some((id, inside(collider, closed_size(collider)?, world)))
            })
            .collect();
        for (container, before) in &self.inside {
            let Some((_, now)) = inside.iter().find(|(id, _)| id == container) else { continue };
            let is_there = |id: &&SphereId| world.spheres().index_of(**id).is_some();
            let has_left = |id: &&SphereId| now.binary_search(id).is_err();
            for &sphere in before.iter().filter(is_there).filter(has_left) {
                let escape = Escape { sphere, container: *container, time: world.time() };
                self.first.get_or_insert(escape);
                self.count += 1;
            }
        }
        self.inside = inside;
    }

    /// Describes the escapes in a sentence; `name_of` names a collider. Returns `None` if there are
    /// none.
    pub fn breach(&self, name_of: impl Fn(ColliderId) -> String) -> Option<String> {
        let Escape { sphere, container, time } = self.first?;
        let (container, count) = (name_of(container), self.count);
        let others = match count {
            1 => String::new(),
            _ => format!(", the first of {count}"),
        };
        Some(format!(
            "ball {sphere} has left the closed container {container} by {time:.4} s{others}"
        ))
    }
}

/// Size of a closed container \[m\]; `None` for another collider.
fn closed_size(collider: &Collider) -> Option<DVec3> {
    match collider.shape {
        Shape::Container { size, open } if open == Sides::NONE && !collider.trigger => Some(size),
        _ => None,
    }
}

/// Ids of the balls whose centre is in a container of this size \[m\], ascending.
fn inside(collider: &Collider, size: DVec3, world: &World) -> Vec<SphereId> {
    let to_local = collider.pose.rotation.normalize().inverse();
    let is_inside = |center: DVec3| {
        let local = to_local * (center - collider.pose.position);
        local.abs().cmple(0.5 * size).all()
    };
    let spheres = world.spheres();
    let all = spheres.ids().iter().zip(spheres.positions());
    all.filter(|(_, center)| is_inside(**center)).map(|(id, _)| *id).collect()
}
