//! Built-in scenes with colliders that move: what their descriptions promise happens.

use carom::World;
use carom_scene::{BUILT_IN_FILES, Scene};

const FRAME: f64 = 1.0 / 60.0;

fn world(name: &str) -> World {
    let (file, text) = BUILT_IN_FILES.iter().find(|(file, _)| *file == name).unwrap();
    Scene::from_toml(text, file).unwrap().world().unwrap()
}

fn run(world: &mut World, seconds: f64) {
    for _ in 0..(seconds / FRAME).round() as u32 {
        world.step(FRAME).unwrap();
    }
}

/// Part of the small balls above the large one, which is the first.
fn part_above_the_large_ball(world: &World) -> f64 {
    let [large, small @ ..] = world.spheres().positions() else { panic!("no balls") };
    small.iter().filter(|ball| ball.y > large.y).count() as f64 / small.len() as f64
}

#[test]
fn large_ball_rises_through_the_small_ones_on_a_vibrated_plate() {
    let mut world = world("vibrated-plate.toml");
    run(&mut world, 1.0);
    // They have fallen on it and lie around it.
    assert!(part_above_the_large_ball(&world) > 0.6);
    run(&mut world, 11.0);
    assert!(part_above_the_large_ball(&world) < 0.4);
}

#[test]
fn balls_pass_the_lift_the_turnstile_and_the_bridge() {
    let mut world = world("gates.toml");
    let (mut on_the_lift, mut on_the_deck, mut on_the_bridge) = (false, false, false);
    for _ in 0..1200 {
        run(&mut world, FRAME);
        for ball in world.spheres().positions() {
            // Above the ends of the ramp, of the deck, and of the bridge at its lowest.
            on_the_lift |= ball.x > -1.8 && ball.x < -0.8 && ball.y > 1.5;
            on_the_deck |= ball.x > -0.7 && ball.x < 1.6 && ball.y > 1.7;
            on_the_bridge |= ball.x > 1.7 && ball.x < 3.0 && ball.y > 1.0;
        }
    }
    assert!(on_the_lift && on_the_deck && on_the_bridge);
}

/// Most speed gained between walls at a distance of L, one of which moves with up to V at the frequency f: of the order
/// of `sqrt(8 π f L V)`, where the kicks of two impacts in a row lose their phase (Lichtenberg and Lieberman, *Regular
/// and Chaotic Dynamics*, 3.4).
#[test]
fn balls_of_fermi_gain_speed_up_to_a_bound() {
    let mut world = world("fermi.toml");
    let start = world.kinetic_energy();
    let mut fastest = 0.0f64;
    for _ in 0..60 {
        run(&mut world, 1.0);
        let speeds = world.spheres().velocities().iter().map(|it| it.length());
        fastest = speeds.fold(fastest, f64::max);
    }
    assert!(world.kinetic_energy() > 4.0 * start);
    // Between the surfaces less a diameter, at 1 Hz with an amplitude of 0.1 m.
    let (length, wall_speed) = (1.3, 0.2 * std::f64::consts::PI);
    let bound = (8.0 * std::f64::consts::PI * length * wall_speed).sqrt();
    assert!(fastest > 0.5 * bound && fastest < 1.5 * bound, "{fastest} {bound}");
}
