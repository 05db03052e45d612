//! A force of one's own: a spring that pulls every sphere to the origin, with its potential
//! energy, so that the world's total energy counts it. The default rule, `exact`, has no closed form
//! for such a force and holds it over a frame, with its value in the middle of the frame: the energy
//! varies a little and does not drift away.

use carom::{DVec3, Error, Force, Settings, Sphere, SphereState, World};

#[derive(Debug)]
struct Spring {
    /// [N/m]
    stiffness: f64,
}

impl Force for Spring {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        -self.stiffness * sphere.position
    }

    fn potential_energy(&self, sphere: &SphereState, _time: f64) -> f64 {
        0.5 * self.stiffness * sphere.position.length_squared()
    }
}

fn main() -> Result<(), Error> {
    let mut world = World::new(Settings::default())?;
    world.add_force(Spring { stiffness: 4.0 })?;
    let ball = world.add_sphere(Sphere::new(DVec3::new(1.0, 0.0, 0.0), 0.1))?;
    println!("{:>9} {:>10} {:>12}", "time [s]", "x [m]", "energy [J]");
    for frame in 0..=40 {
        if frame % 4 == 0 {
            let x = world.sphere(ball)?.position.x;
            println!("{:9.3} {x:10.5} {:12.9}", world.time(), world.total_energy());
        }
        world.step(0.05)?;
    }
    Ok(())
}
