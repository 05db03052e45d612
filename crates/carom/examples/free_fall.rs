//! One second of free fall with drag under each integrator and several frame lengths: how the
//! error shrinks with the frame. The rule is `discrete`, because the default, `exact`, uses no
//! integrator: it computes such a fall in closed form.

use carom::{DVec3, Discrete, Error, Gravity, Integrator, Settings, Sphere, ViscousDrag, World};

/// Height after one second of falling from rest at 0, of 1 kg with a drag of 0.5 kg/s.
fn height(integrator: Integrator, frames: u32) -> Result<f64, Error> {
    let rule = Discrete::default().with_integrator(integrator);
    let mut world = World::new(Settings::default().with_rule(rule))?;
    world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0)))?;
    world.add_force(ViscousDrag::new(0.5))?;
    let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.1))?;
    for _ in 0..frames {
        world.step(1.0 / f64::from(frames))?;
    }
    Ok(world.sphere(ball)?.position.y)
}

fn main() -> Result<(), Error> {
    // Terminal velocity g m / k = 19.62 m/s; the exact height is -19.62 (1 - 2 (1 - e^(-1/2))).
    #[expect(clippy::disallowed_methods)] // Only to compare with.
    let exact = -19.62 * (1.0 - 2.0 * (1.0 - (-0.5_f64).exp()));
    println!("{:<20} {:>10} {:>10} {:>10}", "error [m] of", "10 frames", "20", "40");
    for integrator in [
        Integrator::ExplicitEuler,
        Integrator::SemiImplicitEuler,
        Integrator::VelocityVerlet,
        Integrator::RungeKutta4,
    ] {
        print!("{:<20}", format!("{integrator:?}"));
        for frames in [10, 20, 40] {
            print!(" {:10.1e}", height(integrator, frames)? - exact);
        }
        println!();
    }
    Ok(())
}
