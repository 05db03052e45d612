//! Built-in scenes for the rule `contact`: balls run, fall and come to rest as the descriptions
//! say.

use carom::{DVec3, World};
use carom_scene::{Library, Scene};

fn scene(name: &str) -> Scene {
    Library::new().find(name, &[]).unwrap().0
}

fn after(scene: &Scene, seconds: f64) -> World {
    let mut world = scene.world().unwrap();
    while world.time() < seconds {
        world.step(scene.simulation.frame_time).unwrap();
    }
    world
}

/// Counts spheres whose centre satisfies `is_there`.
fn count(world: &World, is_there: impl Fn(DVec3) -> bool) -> usize {
    world.spheres().positions().iter().filter(|center| is_there(**center)).count()
}

#[test]
fn every_ball_of_the_hourglass_runs_through_its_neck() {
    let scene = scene("hourglass");
    let start = scene.world().unwrap();
    assert_eq!(count(&start, |center| center.y > 0.66), 480);
    let half = after(&scene, 2.0);
    let above = count(&half, |center| center.y > 0.0);
    assert!((100..380).contains(&above), "{above} after 2 s");
    let mut end = start;
    let (energy, mut account) = (end.total_energy(), 0.0);
    while end.time() < scene.simulation.duration {
        let taken = end.step(scene.simulation.frame_time).unwrap().energy_account;
        account += taken.contacts + taken.correction;
    }
    assert_eq!(count(&end, |center| center.y < 0.0), 480);
    // Some balls are pressed to the ground by others that sleep. What is left is the rounding of millions of impulses.
    let open = end.total_energy() - energy - account;
    assert!(open.abs() < 1e-9 * energy.abs(), "{open} J");
    // None has left the box, which is 1.16 m wide and 0.34 m deep.
    let inside = |center: DVec3| center.x.abs() < 0.58 && center.z.abs() < 0.17 && center.y > -1.02;
    assert_eq!(count(&end, inside), 480);
}

#[test]
fn the_avalanche_leaves_its_fence_and_reaches_the_valley() {
    let scene = scene("avalanche");
    // The slope is 7 m long and falls by 30 degrees.
    let foot = 7.0 * 0.75_f64.sqrt();
    let behind_the_gate = |center: DVec3| center.y > 2.7;
    let before = after(&scene, 0.5);
    assert!(count(&before, behind_the_gate) > 300, "{}", count(&before, behind_the_gate));
    assert_eq!(count(&before, |center| center.z > foot), 0);
    let end = after(&scene, scene.simulation.duration);
    assert!(count(&end, behind_the_gate) < 20, "{}", count(&end, behind_the_gate));
    assert!(count(&end, |center| center.z > foot) > 100);
    assert_eq!(count(&end, |center| center.y < 0.0), 0);
}

#[test]
fn one_ball_sets_off_all_rows_of_the_chain_reaction() {
    let scene = scene("chain-reaction");
    let start = scene.world().unwrap();
    assert_eq!(start.spheres().len(), 1 + 210);
    // Rows that no ball has reached are at rest.
    let early = after(&scene, 2.0);
    let moved = |number: usize| {
        early.spheres().positions()[number].distance(start.spheres().positions()[number])
    };
    assert!(moved(1) > 0.1, "the first row");
    assert!((191..211).all(|number| moved(number) < 1e-3), "the last row");
    let end = after(&scene, scene.simulation.duration);
    let board = 4.0;
    let lowest = start.spheres().positions().iter().map(|center| center.y).fold(board, f64::min);
    assert!(count(&end, |center| center.y < lowest - 0.1) >= 205);
}

#[test]
fn the_galton_board_makes_a_heap_in_the_middle() {
    let scene = scene("galton");
    let end = after(&scene, 20.0);
    let below = |center: DVec3| center.y < 0.9;
    let all = count(&end, below);
    let middle = count(&end, |center| below(center) && center.x.abs() < 0.12);
    assert!(all > 150 && middle * 3 > all * 2, "{middle} of {all}");
    assert_eq!(count(&end, |center| center.x.abs() > 0.364 || center.y < 0.0), 0);
}
