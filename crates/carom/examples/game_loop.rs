//! A game loop: physics in frames of one length, pictures as often as the screen asks for them. Each picture
//! shows the state between the last two frames, so motion is smooth at any rate; the physics is the same to the
//! bit at any rate, too.

use carom::{Collider, DVec3, Error, Gravity, Pose, Settings, Shape, Sphere, World};

/// Length of a frame of the physics \[s\].
const FRAME: f64 = 1.0 / 60.0;
/// Most frames that one picture waits for: after a pause, the game goes on where it was.
const MOST_FRAMES: u32 = 5;

fn main() -> Result<(), Error> {
    let mut world = World::new(Settings::default())?;
    world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0)))?;
    world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)))?;
    let ball = world.add_sphere(Sphere::new(DVec3::new(0.0, 1.0, 0.0), 0.1))?;

    let mut before = world.spheres().positions().to_vec();
    // Time that has passed and is not yet stepped [s].
    let mut owed = 0.0;
    // A screen of 144 Hz; a game measures the time since the picture before.
    for picture in 0..144 {
        owed += 1.0 / 144.0;
        for _ in 0..MOST_FRAMES {
            if owed < FRAME {
                break;
            }
            before.copy_from_slice(world.spheres().positions());
            world.step(FRAME)?;
            owed -= FRAME;
        }
        owed = owed.min(FRAME);
        // The player hits the ball half a second after the start.
        if picture == 72 {
            world.apply_impulse(ball, DVec3::new(0.0, 4.0, 0.0))?;
        }
        let part = owed / FRAME;
        let shown = before.iter().zip(world.spheres().positions());
        for (from, to) in shown.map(|(from, to)| (from, from.lerp(*to, part))) {
            if picture % 24 == 0 {
                println!("picture {picture:3}: height {:.3} m, {:.3} m since", to.y, to.y - from.y);
            }
        }
    }
    Ok(())
}
