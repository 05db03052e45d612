//! What several test files need.
#![allow(dead_code)]

pub mod derivatives;
pub mod group;
pub mod rough_mesh;
pub mod solid_mesh;

use carom::{
    Bisect, DVec3, Discrete, EnergyAccount, Exact, Force, Integrator, Rule, Settings, SphereState,
    WindBack, World,
};

pub const G: f64 = 9.81;

pub fn vec(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

pub fn world(rule: impl Into<Rule>) -> World {
    World::new(Settings::default().with_rule(rule)).unwrap()
}

pub fn exact() -> World {
    world(Exact::default())
}

pub fn world_with(integrator: Integrator) -> World {
    world(Discrete::default().with_integrator(integrator))
}

pub fn discrete() -> Rule {
    Rule::Discrete(Discrete::default())
}

pub fn bisect() -> Rule {
    Rule::Bisect(Bisect::default())
}

pub fn bisect_all() -> Rule {
    Rule::Bisect(Bisect::default().with_wind_back(WindBack::All))
}

/// Drag against the velocity through air that moves, of which the rules do not know that it is linear.
#[derive(Debug)]
pub struct AirDrag {
    /// \[1/s\]
    pub rate: f64,
    /// \[m/s\]
    pub wind: DVec3,
}

impl Force for AirDrag {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        -self.rate * sphere.mass * (sphere.velocity - self.wind)
    }
}

/// Numbers in [0, 1), the same in every run.
pub struct Numbers(pub u64);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51afd7ed558ccd);
        ((mixed ^ (mixed >> 33)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// In the cube from -1 to 1.
    pub fn vector(&mut self) -> DVec3 {
        vec(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0))
    }

    pub fn unit_vector(&mut self) -> DVec3 {
        loop {
            let v = self.vector();
            if (0.1..1.0).contains(&v.length()) {
                return v.normalize();
            }
        }
    }
}

/// Advances a world in frames of `h` \[s\], and counts the impacts.
pub fn run(world: &mut World, duration: f64, h: f64) -> usize {
    let frames = (duration / h).round() as usize;
    (0..frames).map(|_| world.step(h).unwrap().impacts.len()).sum()
}

/// Runs a number of frames. Returns the sum of their accounts \[J\], and what is left of the change of energy \[J\].
pub fn account_of_run(world: &mut World, frames: usize, dt: f64) -> (EnergyAccount, f64) {
    let before = world.total_energy();
    let mut sum = EnergyAccount::default();
    for _ in 0..frames {
        sum += world.step(dt).unwrap().energy_account;
    }
    (sum, world.total_energy() - before - sum.total())
}

/// Asserts `|a - b| <= tolerance`, and says by how much it fails.
#[track_caller]
pub fn assert_close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a} is not {b} within {tolerance}: off by {}", a - b);
}

#[track_caller]
pub fn assert_close_vec(a: DVec3, b: DVec3, tolerance: f64) {
    let distance = (a - b).length();
    assert!(distance <= tolerance, "{a} is not {b} within {tolerance}: off by {distance}");
}
