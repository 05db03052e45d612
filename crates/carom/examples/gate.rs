//! A trigger: a gate that counts the spheres that go through it and deflects none. A step reports
//! the triggers that are touched when the frame ends, so a sphere must not pass within a frame.

use std::collections::BTreeSet;

use carom::{Collider, DVec3, Error, Pose, Settings, Shape, Sphere, World};

fn main() -> Result<(), Error> {
    let mut world = World::new(Settings::default())?;
    let gate = Shape::Box { size: DVec3::new(0.2, 2.0, 2.0) };
    let gate = world.add_collider(Collider::new(gate, Pose::at(DVec3::ZERO)).as_trigger())?;
    for i in 0..5 {
        let ball = Sphere::new(DVec3::new(-2.0 - f64::from(i), 0.6 * f64::from(i), 0.0), 0.25);
        world.add_sphere(ball.with_velocity(DVec3::new(2.0, 0.0, 0.0)))?;
    }
    let mut seen = BTreeSet::new();
    for _ in 0..300 {
        world.step(1.0 / 60.0)?;
        for contact in &world.report().triggers {
            if contact.collider == gate && seen.insert(contact.sphere) {
                println!("{:5.2} s: sphere {} is in the gate", world.time(), contact.sphere);
            }
        }
    }
    println!("{} of {} went through", seen.len(), world.spheres().len());
    Ok(())
}
