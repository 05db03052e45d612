//! Converts blows of a cue.

use carom::{DVec3, World};

use crate::error::Problem;
use crate::requirement::{check, check_energy};
use crate::scene::Strike;

impl Strike {
    /// Converts the strike to one of `carom`, on a sphere of this radius \[m\]; its numbers are not checked.
    ///
    /// With the azimuth α and the elevation ε the cue points along `(cos ε cos α, -sin ε, -cos ε sin α)`.
    pub fn on_radius(&self, radius: f64) -> carom::Strike {
        let (across, along) = libm::sincos(self.azimuth_degrees.to_radians());
        let (down, level) = libm::sincos(self.elevation_degrees.to_radians());
        let right = DVec3::new(across, 0.0, along);
        let direction = DVec3::new(level * along, -down, -level * across);
        let [to_right, to_top] = self.offset;
        let offset = radius * (to_right * right + to_top * right.cross(direction));
        carom::Strike::new(direction, self.speed).with_offset(offset).with_cue_mass(self.cue_mass)
    }
}

/// Returns a sphere after the strike that stands at `path`; its own numbers are not yet checked.
pub(crate) fn struck(
    sphere: carom::Sphere,
    strike: &Strike,
    path: &str,
) -> Result<carom::Sphere, Problem> {
    let finite = strike.azimuth_degrees.is_finite();
    check(finite, &format!("{path}.azimuth_degrees"), || "must be finite".into())?;
    let is_angle = (0.0..=90.0).contains(&strike.elevation_degrees);
    check(is_angle, &format!("{path}.elevation_degrees"), || "must be in [0, 90]".into())?;
    let [right, up] = strike.offset;
    let is_on = right * right + up * up < 1.0;
    check(is_on, &format!("{path}.offset"), || "must be below 1 in size, on the sphere".into())?;
    let mut world = World::default();
    // A sphere that is itself invalid is refused where it enters its own world, which names the field.
    let Ok(id) = world.add_sphere(sphere) else { return Ok(sphere) };
    let invalid = |error| of_cue(Problem::of_physics(path, error));
    world.strike(id, strike.on_radius(sphere.radius)).map_err(invalid)?;
    let struck = world.sphere(id).map_err(invalid)?;
    check_energy(&struck, &format!("{path}.speed"))?;
    Ok(struck)
}

/// Names the speed of the cue where the velocity or the spin that it gives the ball is refused.
fn of_cue(mut problem: Problem) -> Problem {
    let of_ball = [".angular_velocity", ".velocity"];
    if let Some(path) = of_ball.iter().find_map(|field| problem.field.strip_suffix(field)) {
        problem.field = format!("{path}.speed");
    }
    problem
}
