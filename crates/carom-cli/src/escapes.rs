//! Detects balls that leave closed containers, which is impossible without passing a wall.

use std::iter;

use carom::{Collider, ColliderId, DVec3, Ends, Groups, Shape, Sides, SphereId, World};

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
            .filter_map(|(id, collider)| Some((id, inside(collider, world)?)))
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

/// Whether a collider holds a place in its own coordinates \[m\]; `None` if it is no closed container.
fn holds(collider: &Collider, local: DVec3) -> Option<bool> {
    match collider.shape {
        _ if collider.trigger => None,
        Shape::Container { size, open: Sides::NONE } => Some(local.abs().cmple(0.5 * size).all()),
        Shape::Pipe { radius, length, closed: Ends::BOTH } => {
            let from_axis = DVec3::new(local.x, 0.0, local.z).length();
            Some(from_axis <= radius && local.y.abs() <= 0.5 * length)
        }
        Shape::Bowl { radius, opening: 0.0 } => Some(local.length() <= radius),
        _ => None,
    }
}

/// Ids of the balls whose centre is in a closed container that they collide with, ascending; `None` for another
/// collider.
fn inside(collider: &Collider, world: &World) -> Option<Vec<SphereId>> {
    holds(collider, DVec3::ZERO)?;
    let to_local = collider.pose.rotation.normalize().inverse();
    let boundary = world.settings().boundary;
    let is_inside = |center: DVec3| {
        let offset = boundary.nearest_image(center - collider.pose.position);
        holds(collider, to_local * offset) == Some(true)
    };
    let spheres = world.spheres();
    // Without entries, all are in the default groups.
    let groups = spheres.groups().iter().copied().chain(iter::repeat(Groups::DEFAULT));
    let bodies = spheres.ids().iter().zip(spheres.positions()).zip(groups);
    let held = bodies
        .filter(|((_, center), groups)| groups.collides(collider.groups) && is_inside(**center));
    Some(held.map(|((id, _), _)| *id).collect())
}
