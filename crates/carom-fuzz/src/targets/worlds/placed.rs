//! Places balls beside each other, within their enclosure.

use super::drawn::Ball;
use super::vector::{HALF, Vector, scaled, sum};

/// A ball with its place.
pub struct Placed<'a> {
    pub position: Vector,
    pub radius: f64,
    pub ball: &'a Ball,
    /// Whether it is of the second material.
    pub is_other: bool,
}

/// Returns the balls with places in a part of the room, without those that overlap an earlier one
/// or leave the container. With a non-additivity, every second ball in the list is of another material.
pub fn placed(balls: &[Ball], crowding: f64, non_additivity: Option<f64>) -> Vec<Placed<'_>> {
    let mut placed: Vec<Placed> = Vec::new();
    for (number, ball) in balls.iter().enumerate() {
        let is_other = non_additivity.is_some() && number % 2 == 1;
        let factor = |other: &Placed| {
            1.0 + non_additivity.filter(|_| other.is_other != is_other).unwrap_or(0.0)
        };
        let radius = 10f64.powf(ball.radius);
        let length = distance(ball.place, [0.0; 3]);
        let position = match placed.last() {
            Some(last) if ball.touches && length > 0.1 => {
                let distance = factor(last) * (radius + last.radius) / length;
                sum(last.position, scaled(ball.place, distance))
            }
            _ => scaled(ball.place, crowding * (HALF - radius)),
        };
        // Whatever its turn, a ball in this sphere is in the container.
        let is_inside = distance(position, [0.0; 3]) < HALF - radius;
        // Touching counts, overlapping by more than rounding does not.
        let is_free = placed.iter().all(|other| {
            let reach = factor(other) * (radius + other.radius);
            distance(position, other.position) > reach * (1.0 - 1e-14)
        });
        if is_inside && is_free {
            placed.push(Placed { position, radius, ball, is_other });
        }
    }
    placed
}

fn distance(one: Vector, other: Vector) -> f64 {
    [0, 1, 2].map(|axis| (one[axis] - other[axis]).powi(2)).iter().sum::<f64>().sqrt()
}
