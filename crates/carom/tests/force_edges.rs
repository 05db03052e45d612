//! Forces that bend or jump at planes, under the rule `exact`: proves that a flight sees each of them, however briefly.

mod common;

use std::f64::consts::PI;

use carom::{Buoyancy, DVec3, Force, ForceEdge, Gravity, Sphere, SphereState, World};
use common::{G, assert_close, exact, vec};

/// A layer between two heights in which every sphere gets an upward acceleration \[m/s²\].
#[derive(Debug, Clone, Copy)]
struct Updraft {
    heights: [f64; 2],
    acceleration: f64,
}

impl Force for Updraft {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        let [low, high] = self.heights;
        let is_inside = (low..high).contains(&sphere.position.y);
        if is_inside { sphere.mass * self.acceleration * DVec3::Y } else { DVec3::ZERO }
    }

    fn potential_energy(&self, sphere: &SphereState, _time: f64) -> f64 {
        let [low, high] = self.heights;
        -sphere.mass * self.acceleration * (sphere.position.y.clamp(low, high) - low)
    }

    fn is_conservative(&self) -> bool {
        true
    }

    fn edges(&self, _radius: f64) -> Vec<ForceEdge> {
        self.heights.map(|height| ForceEdge { normal: DVec3::Y, height }).to_vec()
    }
}

fn ball(world: &mut World, height: f64, speed: f64, scale: f64) {
    let ball = Sphere::new(vec(0.0, scale * height, 0.0), 0.01 * scale);
    world.add_sphere(ball.with_velocity(vec(0.0, scale * speed, 0.0))).unwrap();
}

#[test]
fn a_ball_through_a_thin_layer_is_faster_by_the_work_of_the_layer() {
    for (scale, width) in [(1.0, 1e-3), (1.0, 0.3), (1e-6, 1e-3), (1e6, 1e-3)] {
        let mut world = exact();
        let layer = Updraft { heights: [scale, scale * (1.0 + width)], acceleration: 1e3 * scale };
        world.add_force(layer).unwrap();
        ball(&mut world, 0.0, 3.0, scale);
        world.step(1.0).unwrap();
        let after = world.spheres().velocities()[0].y / scale;
        // v² grows by 2 a w. A jump is passed within the rounding of a coordinate.
        assert_close(after * after, 9.0 + 2.0 * 1e3 * width, 1e-9);
    }
}

#[test]
fn a_ball_under_water_that_hardly_reaches_the_surface_keeps_its_energy() {
    for peak in [1e-9, 1e-6, 1e-3] {
        let mut world = exact();
        world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
        world.add_force(Buoyancy::new(1000.0, 0.0)).unwrap();
        // Twice as heavy as water: it falls with half of gravity.
        let (r, start) = (0.1, -1.0);
        let mass = 2000.0 * 4.0 / 3.0 * PI * r * r * r;
        let speed = (G * (-r + peak - start)).sqrt();
        let ball = Sphere::new(vec(0.0, start, 0.0), r).with_mass(mass);
        world.add_sphere(ball.with_velocity(vec(0.0, speed, 0.0))).unwrap();
        let energy = world.total_energy();
        let mut lowest = f64::INFINITY;
        for _ in 0..200 {
            world.step(1.0 / 200.0).unwrap();
            // Rounding of some tens of steps.
            assert_close(world.total_energy(), energy, 1e-13 * mass * G);
            lowest = lowest.min(world.spheres().positions()[0].y);
        }
        assert!(lowest < start + 0.1, "{lowest}");
    }
}
