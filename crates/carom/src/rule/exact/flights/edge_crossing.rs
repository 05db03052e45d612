//! Where spheres on curves pass the edges of forces.

use super::free_field::FreeField;
use crate::forces::ForceEdge;
use crate::integrate::crossing::first_positive;
use crate::integrate::field::Start;
use crate::integrate::gauss_radau::Step;
use crate::norm::Norm;
use crate::polynomial_flight::PolynomialFlight;

/// Rounding of the distance from an edge, as a part of the coordinates that it is computed from.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// First time, from the start of a step \[s\], at which a sphere passes an edge of the forces on it; `None` if none does.
pub(super) fn first_crossing(fields: &[FreeField], start: &Start, step: &Step) -> Option<f64> {
    let of_sphere = |(place, field): (usize, &FreeField)| {
        let (position, velocity) = (start.positions[place], start.velocities[place]);
        let flight =
            PolynomialFlight { position, velocity, acceleration: step.accelerations[place] };
        let length = step.end - start.time;
        let edges = field.edges().map(move |edge| crossing(edge, &flight, length));
        edges.flatten().reduce(f64::min)
    };
    fields.iter().enumerate().filter_map(of_sphere).reduce(f64::min)
}

/// First time at which a flight passes an edge within `length` \[s\].
fn crossing(edge: ForceEdge, flight: &PolynomialFlight, length: f64) -> Option<f64> {
    let ForceEdge { normal, height } = edge;
    let beyond = normal.dot(flight.position) - height;
    let rounding = ROUNDING * (flight.position.norm() + height.abs());
    // A step that begins on the edge goes to where the sphere moves.
    let side = if beyond.abs() <= rounding { normal.dot(flight.velocity) } else { beyond };
    let side = if side < 0.0 { -1.0 } else { 1.0 };
    let passed = |t| {
        let (position, velocity) = flight.after(t);
        // The next step begins beyond the rounding of the edge.
        let beyond = normal.dot(position) - height;
        [-side * beyond - 2.0 * rounding, -side * normal.dot(velocity)]
    };
    let acceleration = flight.acceleration.coefficients.iter().map(|term| term.norm()).sum();
    first_positive(passed, acceleration, length)
}
