//! Newton's cradle: two of five balls come in, two go out. The three balls that touch and the two
//! that come in are one group: the impact law answers all their contacts at one instant.

use carom::{DVec3, Error, Settings, Sphere, World};

fn main() -> Result<(), Error> {
    let mut world = World::new(Settings::default())?;
    for i in 0..5 {
        let (gap, speed) = if i < 2 { (-0.3, 1.0) } else { (0.0, 0.0) };
        let ball = Sphere::new(DVec3::new(f64::from(i) + gap, 0.0, 0.0), 0.5);
        world.add_sphere(ball.with_velocity(DVec3::new(speed, 0.0, 0.0)))?;
    }
    let show = |world: &World| {
        let speeds = world.spheres().velocities().iter().map(|v| format!("{:6.3}", v.x));
        println!("{:6.3} s: {}", world.time(), speeds.collect::<Vec<_>>().join(" "));
    };
    show(&world);
    for _ in 0..60 {
        if !world.step(1.0 / 60.0)?.impacts.is_empty() {
            show(&world);
        }
    }
    Ok(())
}
