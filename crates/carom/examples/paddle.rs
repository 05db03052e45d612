//! A collider that moves: a paddle that goes to and fro, steered each frame by its velocity. It hits balls with
//! that velocity; a pose that is set at once would put it there without a hit.

use carom::{BodyPair, Collider, DVec3, Error, Pose, Settings, Shape, Sides, Sphere, World};

const FRAME: f64 = 1.0 / 60.0;

fn main() -> Result<(), Error> {
    let mut world = World::new(Settings::default())?;
    let paddle =
        Collider::new(Shape::Box { size: DVec3::new(0.1, 1.0, 1.0) }, Pose::at(DVec3::ZERO));
    let paddle = world.add_collider(paddle)?;
    let size = DVec3::new(6.0, 6.0, 6.0);
    world.add_collider(Collider::new(
        Shape::Container { size, open: Sides::NONE },
        Pose::at(DVec3::ZERO),
    ))?;
    world.add_sphere(Sphere::new(DVec3::new(1.0, 0.0, 0.0), 0.2))?;

    for frame in 0..240 {
        // One second each way, at 0.8 m/s: the new velocity holds from the next frame on.
        let velocity = if frame / 60 % 2 == 0 { 0.8 } else { -0.8 };
        let moved = world.collider(paddle)?.moving(DVec3::new(velocity, 0.0, 0.0), DVec3::ZERO);
        world.set_collider(paddle, moved)?;
        world.step(FRAME)?;
        for impact in &world.report().impacts {
            if matches!(impact.between, BodyPair::Collider { collider, .. } if collider == paddle) {
                let speed = world.spheres().velocities()[0].x;
                println!("{:.2} s: hit; the ball leaves with {speed:+.2} m/s", world.time());
            }
        }
    }
    println!("the paddle ends at x = {:.3} m", world.collider(paddle)?.pose.position.x);
    Ok(())
}
