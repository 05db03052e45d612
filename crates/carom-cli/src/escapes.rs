//! Balls that leave closed containers, which no ball can do without going through a wall.

use carom::{Collider, ColliderId, DVec3, Shape, Sides, SphereId, World};

/// Watches which balls are in which closed container.
#[derive(Debug, Default)]
pub struct Escapes {
    /// The balls inside each closed container at the last look, ascending.
    inside: Vec<(ColliderId, Vec<SphereId>)>,
    first: Option<Escape>,
    count: u64,
}

/// A ball that has left a closed container.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Escape {
    sphere: SphereId,
    container: ColliderId,
    /// When it was found outside \[s\].
    time: f64,
}

impl Escapes {
    /// Looks where all balls are, and counts those that have left a container since the last look.
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

    /// What happened, in a sentence that calls colliders by name; `None` if no ball left a container.
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

/// The size of a container that keeps in what is in it \[m\]; `None` for other colliders.
fn closed_size(collider: &Collider) -> Option<DVec3> {
    match collider.shape {
        Shape::Container { size, open } if open == Sides::NONE && !collider.trigger => Some(size),
        _ => None,
    }
}

/// The balls with their centre in a container of this size \[m\], ascending.
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
