//! Impacts as a table of numbers, so that JavaScript gets many of them without many objects.

use carom::{BodyPair, Impact};

/// Numbers per row; `web/package/src/impacts.js` reads them.
const COLUMNS: usize = 16;

/// Returns the impacts in rows: time, 1 if body 1 is a collider or 0 if it is a sphere, the numbers
/// of the bodies, point, normal, speeds of approach and separation, impulse, impulse of friction.
pub fn of(impacts: &[Impact]) -> Vec<f64> {
    let mut table = Vec::with_capacity(COLUMNS * impacts.len());
    for impact in impacts {
        let (is_collider, first, second) = match impact.between {
            BodyPair::Spheres(first, second) => (0.0, first.number() as f64, second),
            BodyPair::Collider { collider, sphere } => (1.0, collider.number() as f64, sphere),
        };
        table.extend([impact.time, is_collider, first, second.number() as f64]);
        table.extend(impact.point.to_array());
        table.extend(impact.normal.to_array());
        table.extend([impact.approach_speed, impact.separation_speed, impact.impulse]);
        table.extend(impact.tangential_impulse.to_array());
    }
    table
}
