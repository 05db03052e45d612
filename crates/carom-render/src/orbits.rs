//! Orbits of bodies that attract each other: the ellipse on which a body would go on if only its
//! strongest attractor pulled at it (the osculating orbit).

use std::f64::consts::TAU;

use carom::DVec3;
use carom_scene::scene::{Color, Force};

use crate::drawing::Arrow;

/// Lines of which an ellipse consists.
const LINES: usize = 128;

/// Largest number of bodies whose orbits are drawn; more would be a tangle.
const MOST_BODIES: usize = 100;

/// Least mass of an attractor in masses of the body: a lighter one moves itself, and the ellipse
/// about it has no meaning.
const HEAVIER: f64 = 10.0;

/// A body that others attract.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Centre \[m\].
    pub position: DVec3,
    /// \[m/s\]
    pub velocity: DVec3,
    /// \[kg\]
    pub mass: f64,
    /// sRGB.
    pub color: Color,
}

/// What a body goes round.
#[derive(Debug, Clone, Copy)]
struct Attractor {
    position: DVec3,
    velocity: DVec3,
    /// Gravitational parameter of the attractor and the body together \[m³/s²\].
    parameter: f64,
}

/// An ellipse with the attractor in its focus.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ellipse {
    /// \[m\]
    center: DVec3,
    /// Half axes \[m\].
    half: [DVec3; 2],
}

/// Returns the lines of all closed orbits, in the colours of their bodies mixed half with
/// `background`.
pub(crate) fn lines(forces: &[&Force], bodies: &[Body], background: Color) -> Vec<Arrow> {
    if bodies.len() > MOST_BODIES {
        return Vec::new();
    }
    let orbits = (0..bodies.len()).filter_map(|index| {
        let attractor = attractor(forces, bodies, index)?;
        Some((bodies[index].color, orbit(&bodies[index], &attractor)?))
    });
    let lines = orbits.flat_map(|(color, ellipse)| {
        let color = std::array::from_fn(|i| 0.5 * (color[i] + background[i]));
        let at = move |number: usize| ellipse.at(TAU * number as f64 / LINES as f64);
        (0..LINES).map(move |number| Arrow {
            start: at(number),
            end: at(number + 1),
            color,
            width: 1.5,
            head: false,
            in_front: false,
        })
    });
    lines.collect()
}

/// Returns the attractor with the strongest pull on a body.
fn attractor(forces: &[&Force], bodies: &[Body], index: usize) -> Option<Attractor> {
    let body = &bodies[index];
    let of_force = |force: &&Force| match **force {
        Force::PointAttractor { position, gravitational_parameter: parameter, .. } => {
            let position = DVec3::from_array(position);
            vec![Attractor { position, velocity: DVec3::ZERO, parameter }]
        }
        Force::MutualGravity { constant, .. } => {
            let heavy = bodies.iter().filter(|it| it.mass >= HEAVIER * body.mass);
            let attractor = |it: &Body| Attractor {
                position: it.position,
                velocity: it.velocity,
                parameter: constant * (it.mass + body.mass),
            };
            heavy.map(attractor).collect()
        }
        _ => Vec::new(),
    };
    let pull = |it: &Attractor| it.parameter / body.position.distance_squared(it.position);
    let all = forces.iter().flat_map(of_force).filter(|it| pull(it).is_finite());
    all.max_by(|one, other| pull(one).total_cmp(&pull(other)))
}

/// Returns the orbit of a body; `None` if it is not closed.
///
/// With the position `r` and the velocity `v` relative to the attractor and the parameter `μ`, the
/// angular momentum is `h = r × v`, the eccentricity vector `e = v × h / μ − r / |r|`, and the
/// semi-major axis `a = h² / (μ (1 − e²))`. Source: Murray and Dermott, Solar System Dynamics
/// (1999), section 2.3.
fn orbit(body: &Body, attractor: &Attractor) -> Option<Ellipse> {
    let (r, v) = (body.position - attractor.position, body.velocity - attractor.velocity);
    let h = r.cross(v);
    let e = v.cross(h) / attractor.parameter - r.normalize();
    let eccentricity = e.length();
    // A straight fall has no ellipse, and a path that hardly closes leaves the picture.
    if attractor.parameter <= 0.0 || h.length_squared() == 0.0 || eccentricity > 0.995 {
        return None;
    }
    let semi_major = h.length_squared() / (attractor.parameter * (1.0 - eccentricity.powi(2)));
    let semi_minor = semi_major * (1.0 - eccentricity.powi(2)).sqrt();
    let normal = h.normalize();
    // A circle has no direction of its own.
    let to_pericentre = if eccentricity > 1e-9 { e / eccentricity } else { r.normalize() };
    let across = normal.cross(to_pericentre);
    let center = attractor.position - semi_major * eccentricity * to_pericentre;
    Some(Ellipse { center, half: [semi_major * to_pericentre, semi_minor * across] })
}

impl Ellipse {
    /// Returns the point at an eccentric anomaly \[rad\].
    fn at(&self, anomaly: f64) -> DVec3 {
        self.center + anomaly.cos() * self.half[0] + anomaly.sin() * self.half[1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRAVITY: Force =
        Force::MutualGravity { constant: 1.0, softening: 0.0, opening_angle: 0.5 };

    fn body(x: f64, speed: f64, mass: f64) -> Body {
        Body { position: DVec3::X * x, velocity: DVec3::Z * speed, mass, color: [0.5; 3] }
    }

    /// Distances of the points of the only orbit from the origin \[m\].
    fn distances(bodies: &[Body]) -> Vec<f64> {
        let lines = lines(&[&GRAVITY], bodies, [0.0; 3]);
        assert_eq!(lines.len(), LINES);
        lines.iter().map(|line| line.start.length()).collect()
    }

    #[test]
    fn the_orbit_at_the_speed_of_a_circle_is_a_circle() {
        let bodies = [body(0.0, 0.0, 99.0), body(4.0, 5.0, 1.0)];
        // A few roundings of numbers up to 4.
        assert!(distances(&bodies).iter().all(|it| (it - 4.0).abs() < 1e-13));
    }

    #[test]
    fn an_orbit_ends_where_energy_and_angular_momentum_say() {
        let (start, speed, parameter) = (2.0, 3.0, 100.0);
        let bodies = [body(0.0, 0.0, 99.0), body(start, speed, 1.0)];
        // Half of the major axis by the vis-viva equation; the body is at its farthest.
        let semi_major = 1.0 / (2.0 / start - speed * speed / parameter);
        let distances = distances(&bodies);
        let (near, far) = distances
            .iter()
            .fold((f64::MAX, 0.0), |(near, far), it: &f64| (it.min(near), it.max(far)));
        assert!((far - start).abs() < 1e-13 && (near + far - 2.0 * semi_major).abs() < 1e-13);
    }

    #[test]
    fn a_moon_goes_round_its_planet_and_a_planet_round_its_sun() {
        let sun = body(0.0, 0.0, 4.0);
        let planet = body(2.6, 1.24, 0.03);
        let moon = body(2.72, 1.74, 1e-5);
        let bodies = [sun, planet, moon];
        let near = |index: usize, of: &Body| {
            let found = attractor(&[&GRAVITY], &bodies, index).unwrap();
            found.position == of.position
        };
        assert!(near(1, &sun) && near(2, &planet));
        assert!(attractor(&[&GRAVITY], &bodies, 0).is_none());
    }

    #[test]
    fn bodies_that_escape_or_have_no_heavy_neighbour_have_no_orbit() {
        let escaping = [body(0.0, 0.0, 99.0), body(2.0, 10.1, 1.0)];
        let twins = [body(0.0, 0.0, 1.0), body(2.0, 0.1, 1.0)];
        let falling = [body(0.0, 0.0, 99.0), body(2.0, 0.0, 1.0)];
        for bodies in [escaping, twins, falling] {
            assert!(lines(&[&GRAVITY], &bodies, [0.0; 3]).is_empty());
        }
    }
}
