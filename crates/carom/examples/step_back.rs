//! Snapshots: run, go back, run again - and end in the same state, bit for bit. A snapshot keeps the
//! flights of the spheres, too, from which the rule `exact` computes their positions.

use carom::{Collider, DVec3, Error, Gravity, Pose, Settings, Shape, Sphere, World};

fn run(world: &mut World, frames: u32) -> Result<(), Error> {
    for _ in 0..frames {
        world.step(1.0 / 60.0)?;
    }
    println!("{:5.2} s: state {}", world.time(), world.state_hash());
    Ok(())
}

fn main() -> Result<(), Error> {
    let mut world = World::new(Settings::default())?;
    world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0)))?;
    world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)))?;
    for i in 0..10 {
        let place = DVec3::new(0.1 * f64::from(i), 1.0 + 1.2 * f64::from(i), 0.0);
        world.add_sphere(Sphere::new(place, 0.5))?;
    }
    run(&mut world, 60)?;
    let snapshot = world.snapshot();
    run(&mut world, 100)?;
    world.restore(&snapshot);
    println!("back to {:.2} s", world.time());
    run(&mut world, 100)
}
