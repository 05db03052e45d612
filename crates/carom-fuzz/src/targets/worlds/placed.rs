//! Places balls beside each other, within their enclosure.

use super::drawn::Ball;
use super::vector::{HALF, Vector, scaled, sum};

/// A ball with its place.
pub struct Placed<'a> {
    pub position: Vector,
    pub radius: f64,
    pub ball: &'a Ball,
}

/// Returns the balls with places in a part of the room, without those that overlap an earlier one
/// or leave the container.
pub fn placed(balls: &[Ball], crowding: f64) -> Vec<Placed<'_>> {
    let mut placed: Vec<Placed> = Vec::new();
    for ball in balls {
        let radius = 10f64.powf(ball.radius);
        let length = distance(ball.place, [0.0; 3]);
        let position = match placed.last() {
            Some(last) if ball.touches && length > 0.1 => {
                let distance = (radius + last.radius) / length;
                sum(last.position, scaled(ball.place, distance))
            }
            _ => scaled(ball.place, crowding * (HALF - radius)),
        };
        // Whatever its turn, a ball in this sphere is in the container.
        let is_inside = distance(position, [0.0; 3]) < HALF - radius;
        // Touching counts, overlapping by more than rounding does not.
        let is_free = placed.iter().all(|other| {
            distance(position, other.position) > (radius + other.radius) * (1.0 - 1e-14)
        });
        if is_inside && is_free {
            placed.push(Placed { position, radius, ball });
        }
    }
    placed
}

fn distance(one: Vector, other: Vector) -> f64 {
    [0, 1, 2].map(|axis| (one[axis] - other[axis]).powi(2)).iter().sum::<f64>().sqrt()
}
