//! Persistent contacts as a table of numbers, so that JavaScript gets many of them without many
//! objects.

use carom::{BodyPair, PersistentContact};

/// Numbers per row; `web/package/src/contacts.js` reads them.
const COLUMNS: usize = 15;

/// Returns the contacts in rows: 1 if body 1 is a collider or 0 if it is a sphere, the numbers of
/// the bodies, point, normal, gap, normal force, tangential force, 1 if the contact slides or 0.
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
