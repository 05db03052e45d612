//! An emitter that is tilted, and keeps eight spheres alive: which ids come, and which go. Under the
//! rule `discrete` a sphere comes at the start of a frame; under `exact` it would come at its own
//! time within the frame.

use carom::{DQuat, DVec3, Discrete, Emitter, Error, Gravity, Settings, Sphere, World};

fn main() -> Result<(), Error> {
    let mut world = World::new(Settings::default().with_rule(Discrete::default()))?;
    world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0)))?;
    let drop = Sphere::new(DVec3::ZERO, 0.05).with_velocity(DVec3::new(0.0, 6.0, 0.0));
    let tilted = Emitter::new(drop, 0.1).with_rotation(DQuat::from_rotation_z(-0.2));
    world.add_emitter(tilted.with_max_spheres(8))?;
    for _ in 0..60 {
        let report = world.step(0.02)?;
        let names = |ids: &[carom::SphereId]| {
            ids.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
        };
        let (came, went) = (names(&report.emitted), names(&report.retired));
        if !came.is_empty() {
            println!("{:5.2} s: came {came:<4} went {went:<4}", world.time());
        }
    }
    Ok(())
}
