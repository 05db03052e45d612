//! A ball dropped from 1 m onto a floor that gives back 70 % of its speed: each impact, and the
//! height of the bounce after it. The default rule, `exact`, finds each impact at its own time, so
//! each height is e² of the one before, to rounding, whatever the length of the frames.

use carom::{Collider, DVec3, Error, Gravity, Pose, Settings, Shape, Sphere, World};

fn main() -> Result<(), Error> {
    let (g, e) = (9.81, 0.7);
    let mut world = World::new(Settings::default())?;
    world.add_force(Gravity::new(DVec3::new(0.0, -g, 0.0)))?;
    world
        .add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(e))?;
    world.add_sphere(Sphere::new(DVec3::new(0.0, 1.1, 0.0), 0.1))?;

    println!("{:>9} {:>14} {:>16}", "time [s]", "speed [m/s]", "next apex [m]");
    while world.time() < 1.8 {
        let start = world.time();
        for impact in &world.step(1.0 / 240.0)?.impacts {
            let rebound = e * impact.approach_speed;
            let apex = rebound * rebound / (2.0 * g);
            println!("{:9.4} {:14.4} {:16.4}", start + impact.time, impact.approach_speed, apex);
        }
    }
    Ok(())
}
