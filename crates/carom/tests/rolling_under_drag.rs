//! Spheres that slide and roll under linear drag and in wind, under the rule `exact`: against closed forms, the same at any
//! size to the bit.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use carom::{
    Collider, DQuat, DVec3, Exact, Gravity, Pose, Shape, Sphere, SphereId, ViscousDrag, Wind,
    World, Zones,
};
use common::{G, account_of_run, assert_close, exact, vec, world};

const FRAME: f64 = 1.0 / 64.0;
const MU: f64 = 0.1;
/// Sizes of worlds that scale every number without rounding.
const SIZES: [f64; 3] = [1.0, 1.0 / 1_048_576.0, 1_048_576.0];
/// Coefficient of drag \[kg/s\]: the rate of drag of a ball of 1 kg \[1/s\].
const DRAG: f64 = 0.25;

/// A ball of 1 kg on a rough plane that rises along x by this angle \[rad\], with lengths and times in these units,
/// without zones.
struct UnderDrag {
    world: World,
    ball: SphereId,
    unit: f64,
    along: DVec3,
}

impl UnderDrag {
    /// The ball with this speed along the plane \[m/s\] and this angular speed times its radius \[m/s\].
    fn new(unit: f64, angle: f64, [speed, turning]: [f64; 2]) -> Self {
        let mut world = world(Exact::default().with_zones(Zones::Never));
        world.add_force(Gravity::new(vec(0.0, -G / unit, 0.0))).unwrap();
        let rotation = DQuat::from_rotation_z(angle);
        let plane = Collider::new(Shape::HalfSpace, Pose { position: DVec3::ZERO, rotation });
        world.add_collider(plane.with_friction(MU)).unwrap();
        let (along, radius) = (rotation * DVec3::X, 0.1 * unit);
        let ball = Sphere::new(radius * (rotation * DVec3::Y), radius).with_mass(1.0);
        let ball = ball.with_restitution(0.0).with_friction(MU).with_velocity(speed * along);
        let ball = ball.with_angular_velocity(vec(0.0, 0.0, -turning / radius));
        let ball = world.add_sphere(ball).unwrap();
        Self { world, ball, unit, along }
    }

    fn with_drag(mut self) -> Self {
        self.world.add_force(ViscousDrag::new(DRAG / self.unit)).unwrap();
        self
    }

    fn with_wind(mut self, speed: f64) -> Self {
        self.world.add_force(Wind::new(speed * self.along, DRAG / self.unit)).unwrap();
        self
    }

    /// Advances by frames. Returns the way along the plane \[units\] and the speeds of the centre and of the turning
    /// \[m/s\].
    fn after(&mut self, frames: u32) -> [f64; 3] {
        for _ in 0..frames {
            self.world.step(FRAME * self.unit).unwrap();
        }
        let Sphere { position, velocity, angular_velocity, radius, .. } =
            self.world.sphere(self.ball).unwrap();
        let (way, speed) = (position.dot(self.along) / self.unit, velocity.dot(self.along));
        [way, speed, -angular_velocity.z * radius]
    }
}

#[test]
fn a_ball_that_rolls_under_drag_slows_at_five_sevenths_of_its_rate() {
    let rate = DRAG / 1.4;
    let runs = SIZES.map(|unit| {
        let mut rolling = UnderDrag::new(unit, 0.0, [1.5, 1.5]).with_drag();
        let mut ends = [[0.0; 3]; 5];
        for (second, end) in (1u32..).zip(&mut ends) {
            *end = rolling.after(64);
            let [way, speed, turning] = *end;
            let left = (-rate * f64::from(second)).exp();
            // Rounding of some hundred steps.
            assert_close(way, 1.5 * (1.0 - left) / rate, 1e-13);
            assert_close(speed, 1.5 * left, 1e-13);
            assert_close(turning, 1.5 * left, 1e-13);
        }
        ends
    });
    assert!(runs.iter().all(|run| *run == runs[0]), "{runs:?}");
}

#[test]
fn wind_rolls_a_ball_from_rest_towards_its_own_speed() {
    let runs = SIZES.map(|unit| {
        let mut rolling = UnderDrag::new(unit, 0.0, [0.0; 2]).with_wind(3.0);
        let end = rolling.after(5 * 64);
        let speed = 3.0 * (1.0 - (-DRAG / 1.4 * 5.0).exp());
        // Rounding of some hundred steps.
        assert_close(end[1], speed, 1e-14);
        assert_close(end[2], speed, 1e-14);
        end
    });
    assert!(runs.iter().all(|run| *run == runs[0]), "{runs:?}");
}

#[test]
fn a_ball_that_slides_under_drag_rolls_when_its_turning_has_caught_up() {
    let (rate, loss) = (DRAG, MU * G);
    // Sliding, v' = -c v/m - μ g and r ω' = 5/2 μ g.
    let sliding = |time: f64| (2.0 + loss / rate) * (-rate * time).exp() - loss / rate;
    let slip = |time: f64| sliding(time) - 2.5 * loss * time;
    let (mut early, mut late) = (0.0, 2.0);
    for _ in 0..60 {
        let middle = 0.5 * (early + late);
        if slip(middle) > 0.0 { early = middle } else { late = middle }
    }
    let runs = SIZES.map(|unit| {
        let mut ball = UnderDrag::new(unit, 0.0, [2.0, 0.0]).with_drag();
        let [_, speed, turning] = ball.after(16);
        // Rounding of some ten steps.
        assert_close(speed, sliding(0.25), 1e-14);
        assert_close(turning, 2.5 * loss * 0.25, 1e-14);
        let energy = ball.world.total_energy();
        let (account, left) = account_of_run(&mut ball.world, 48, FRAME * unit);
        assert!(account.contacts < 0.0 && account.forces < 0.0, "{account:?}");
        assert!(left.abs() < 1e-13 * energy, "{left:e}");
        let end = ball.after(0);
        let speed = sliding(early) * (-rate / 1.4 * (1.0 - early)).exp();
        assert_close(end[1], speed, 1e-13);
        assert_close(end[2], speed, 1e-13);
        end
    });
    assert!(runs.iter().all(|run| *run == runs[0]), "{runs:?}");
}

#[test]
fn a_ball_that_rolls_down_an_incline_under_drag_nears_the_speed_at_which_drag_bears_it() {
    let angle: f64 = 0.2;
    let (rate, last) = (DRAG / 1.4, G * angle.sin() / DRAG);
    let runs = SIZES.map(|unit| {
        let mut rolling = UnderDrag::new(unit, -angle, [0.0; 2]).with_drag();
        let end = rolling.after(4 * 64);
        let speed = last * (1.0 - (-4.0 * rate).exp());
        // Rounding of the normal and of some hundred steps.
        assert_close(end[1], speed, 1e-13);
        assert_close(end[2], speed, 1e-13);
        end
    });
    assert!(runs.iter().all(|run| *run == runs[0]), "{runs:?}");
}

#[test]
fn a_ball_at_rest_under_drag_takes_no_steps() {
    let mut ball = UnderDrag::new(1.0, 0.0, [0.0; 2]).with_drag();
    ball.after(1);
    let report = ball.world.step(FRAME).unwrap();
    assert_eq!((report.work.predictions, ball.after(0)[1]), (0, 0.0));
}

#[test]
fn a_ball_that_a_belt_carries_under_drag_rolls_on_from_it_without_a_zone() {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world.add_force(ViscousDrag::new(DRAG)).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(MU);
    world.add_collider(floor).unwrap();
    let belt = Shape::Rectangle { size_x: 1.0, size_z: 1.0 };
    let belt = Collider::new(belt, Pose::at(vec(0.0, 1e-5, 0.0))).with_friction(MU);
    world.add_collider(belt.with_surface_velocity(vec(2.0, 0.0, 0.0))).unwrap();
    let ball = Sphere::new(vec(0.2, 0.1 + 1e-5, 0.0), 0.1).with_mass(1.0).with_restitution(0.0);
    let ball = ball.with_velocity(DVec3::X).with_angular_velocity(vec(0.0, 0.0, -10.0));
    let ball = world.add_sphere(ball.with_friction(MU)).unwrap();
    let mut ticks = 0;
    for _ in 0..3 * 64 {
        ticks += world.step(FRAME).unwrap().zone_account.ticks;
    }
    let before = world.sphere(ball).unwrap();
    assert!(before.position.x > 0.6, "{before:?}");
    for _ in 0..64 {
        ticks += world.step(FRAME).unwrap().zone_account.ticks;
    }
    assert_eq!(ticks, 0);
    let after = world.sphere(ball).unwrap();
    let left = (-DRAG / 1.4).exp();
    // Rounding of some ten steps.
    assert_close(after.velocity.x, before.velocity.x * left, 1e-13);
    assert_close(-0.1 * after.angular_velocity.z, after.velocity.x, 1e-13);
}
