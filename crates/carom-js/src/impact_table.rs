//! Impacts as a table of numbers: many of them reach JavaScript without an object each.

use carom::{BodyPair, Impact};

/// Numbers in a row; what they are stands in `web/package/src/impacts.js`.
const COLUMNS: usize = 16;

/// The impacts row by row: time, whether body 1 is a collider (1) or a sphere (0), the numbers of
/// the bodies, point, normal, speeds of approach and separation, impulse, impulse of friction.
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
