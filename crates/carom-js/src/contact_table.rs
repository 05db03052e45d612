//! Persistent contacts as a table of numbers: many of them reach JavaScript without an object each.

use carom::{BodyPair, PersistentContact};

/// Numbers in a row; what they are stands in `web/package/src/contacts.js`.
const COLUMNS: usize = 15;

/// The contacts row by row: whether body 1 is a collider (1) or a sphere (0), the numbers of the
/// bodies, point, normal, gap, normal force, tangential force, whether it slides (1) or not (0).
pub fn of(contacts: &[PersistentContact]) -> Vec<f64> {
    let mut table = Vec::with_capacity(COLUMNS * contacts.len());
    for contact in contacts {
        let (is_collider, first, second) = match contact.between {
            BodyPair::Spheres(first, second) => (0.0, first.number() as f64, second),
            BodyPair::Collider { collider, sphere } => (1.0, collider.number() as f64, sphere),
        };
        table.extend([is_collider, first, second.number() as f64]);
        table.extend(contact.point.to_array());
        table.extend(contact.normal.to_array());
        table.extend([contact.gap, contact.normal_force]);
        table.extend(contact.tangential_force.to_array());
        table.push(f64::from(contact.is_sliding));
    }
    table
}
