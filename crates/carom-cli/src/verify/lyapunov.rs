//! Lyapunov exponents of dilute gases of hard discs and spheres, against kinetic theory.
//!
//! At a low density n, in particles for each diameter to the power of the dimension d, both the sum of the positive
//! exponents and the largest one grow with -ln n. For each particle and each of its impacts, the sum grows by (d - 1)/2 of
//! that (van Beijeren, Dorfman, Posch and Dellago, Phys. Rev. E 56, 5272 (1997)), the largest exponent by the speed of
//! clocks of which an impact sets both to the later one and one more (van Zon, van Beijeren and Dellago, Phys. Rev. Lett.
//! 80, 2035 (1998)). The clocks here follow the impacts of the same run. Terms that are constant in n cancel between two
//! densities.

use carom::{BodyPair, Boundary, DVec3, Settings, Sphere, Tangents, Variation, World};

use super::claim::{Claim, Expected, Fault, Measured, Outcome, Tolerance};
use crate::numbers::Numbers;

/// Densities between which the slopes are taken.
const DENSITIES: [f64; 2] = [1e-3, 1e-5];
/// Impacts of each particle in a frame, about: so few that directions stay apart.
const IMPACTS_IN_FRAME: f64 = 0.1;

/// A dilute gas.
#[derive(Debug, Clone, Copy)]
struct Gas {
    particles: usize,
    dimensions: usize,
    density: f64,
    impacts: usize,
    /// Number of exponents that are wanted.
    exponents: usize,
}

/// What grows for each particle and each of its impacts.
#[derive(Debug, Clone, Copy)]
struct Growth {
    /// Sum of the exponents.
    sum: f64,
    largest: f64,
    clock: f64,
}

pub fn claims() -> Vec<Claim> {
    let entropy = |name: &str, gas: Gas, expected: f64| {
        let source = "(d - 1)/2: van Beijeren, Dorfman, Posch and Dellago 1997";
        Claim::new(
            format!(
                "dilute hard {name}: growth of the entropy by an impact with the logarithm of 1/n"
            ),
            Expected::value(expected, source),
            Tolerance::relative(0.015, "statistics 1 %"),
            move |_| slope(gas, |growth| growth.sum),
        )
    };
    let all = |particles: usize, dimensions: usize| dimensions * (particles - 1) - 1;
    let gas = Gas { particles: 10, dimensions: 2, density: 0.0, impacts: 6000, exponents: 1 };
    let discs = Gas { exponents: all(10, 2), ..gas };
    let spheres = Gas { particles: 8, dimensions: 3, exponents: all(8, 3), ..gas };
    let largest = Gas { particles: 16, impacts: 20_000, ..gas };
    let clocks = Claim::new(
        "dilute hard discs: largest exponent, the same, beside clocks that impacts advance [part]",
        Expected::no_error("van Zon, van Beijeren and Dellago 1998"),
        Tolerance::absolute(0.03, "statistics 1 %, terms of order 1/ln n"),
        move |_| largest_beside_clocks(largest),
    );
    vec![entropy("discs", discs, 0.5), clocks.slow(), entropy("spheres", spheres, 1.0).slow()]
}

/// Returns by how much a growth rises with the logarithm of 1/n.
fn slope(gas: Gas, of: impl Fn(&Growth) -> f64) -> Outcome {
    let (worlds, growths) = both(gas)?;
    let over = libm::log(DENSITIES[0] / DENSITIES[1]);
    Ok(Measured::in_world(&worlds[1], (of(&growths[1]) - of(&growths[0])) / over))
}

/// Returns by which part the slope of the largest exponent is off the speed of clocks.
fn largest_beside_clocks(gas: Gas) -> Outcome {
    let (worlds, [dense, dilute]) = both(gas)?;
    let over = libm::log(DENSITIES[0] / DENSITIES[1]);
    let slope = (dilute.largest - dense.largest) / over;
    let clock = 0.5 * (dense.clock + dilute.clock);
    Ok(Measured::in_world(&worlds[1], slope / clock - 1.0))
}

fn both(gas: Gas) -> Result<([World; 2], [Growth; 2]), Fault> {
    let [(first, dense), (second, dilute)] =
        [gas.growth_at(DENSITIES[0])?, gas.growth_at(DENSITIES[1])?];
    Ok(([first, second], [dense, dilute]))
}

impl Gas {
    fn growth_at(self, density: f64) -> Result<(World, Growth), Fault> {
        Self { density, ..self }.growth()
    }

    /// Returns the gas after some impacts, and what grew.
    fn growth(self) -> Result<(World, Growth), Fault> {
        let (mut world, speed, edge) = self.begun()?;
        let ids = world.spheres().ids().to_vec();
        let mut numbers = Numbers::new(2);
        let directions = (0..self.exponents).map(|_| {
            ids.iter().fold(Variation::default(), |direction, &id| {
                let [place, velocity] = [(); 2].map(|()| self.vector(&mut numbers));
                direction.with_position(id, edge * place).with_velocity(id, speed * velocity)
            })
        });
        let mut tangents = Tangents::new(&world, directions.collect())?;
        // A sphere sweeps some two cross-sections at its speed.
        let frame = IMPACTS_IN_FRAME / (2.0 * self.density * speed);
        let (mut clocks, mut impacts) = (vec![0_u64; ids.len()], 0);
        let (mut largest, mut sum, mut began) = (0.0, 0.0, None);
        while impacts < self.impacts {
            tangents.step(&mut world, frame)?;
            let sizes = tangents.orthonormalize(edge, speed);
            let latest = clocks.iter().copied().max().unwrap_or(0);
            // Directions need some impacts to turn to where they grow.
            if began.is_none() && impacts > self.impacts / 10 {
                (began, impacts) = (Some(latest), 0);
            }
            if began.is_some() {
                largest += libm::log(sizes[0]);
                sum += sizes.iter().map(|&it| libm::log(it)).sum::<f64>();
            }
            for impact in &world.report().impacts {
                let BodyPair::Spheres(first, second) = impact.between else { continue };
                let places = [first, second].map(|id| ids.binary_search(&id).unwrap_or(0));
                let next = places.map(|place| clocks[place]).into_iter().max().unwrap_or(0) + 1;
                places.into_iter().for_each(|place| clocks[place] = next);
                impacts += 1;
            }
        }
        let latest = clocks.iter().copied().max().unwrap_or(0);
        let advance = (latest - began.unwrap_or(0)) as f64;
        // Each impact is one of two particles.
        let each = 2.0 * impacts as f64 / self.particles as f64;
        let (largest, sum) = (largest / each, sum / each / self.particles as f64);
        Ok((world, Growth { sum, largest, clock: advance / each }))
    }

    /// Returns the gas at the start, its root mean square speed \[m/s\], and the edge of its box \[m\].
    fn begun(self) -> Result<(World, f64, f64), Fault> {
        let volume = self.particles as f64 / self.density;
        let edge = if self.dimensions == 2 { volume.sqrt() } else { libm::cbrt(volume) };
        let flat = self.dimensions == 2;
        let size = DVec3::new(edge, edge, if flat { f64::INFINITY } else { edge });
        let settings = Settings::default().with_boundary(Boundary::Periodic { size });
        let settings = if flat { settings.with_dimensions(2) } else { settings };
        let mut world = World::new(settings)?;
        let mut numbers = Numbers::new(1);
        let mut velocities: Vec<DVec3> =
            (0..self.particles).map(|_| self.vector(&mut numbers)).collect();
        let mean = velocities.iter().sum::<DVec3>() / self.particles as f64;
        velocities.iter_mut().for_each(|velocity| *velocity -= mean);
        let squares = velocities.iter().map(|velocity| velocity.length_squared()).sum::<f64>();
        let speed = (squares / self.particles as f64).sqrt();
        for (number, velocity) in velocities.into_iter().enumerate() {
            // On a lattice, off its places so that no two impacts are alike.
            let side = 4;
            let place = [number % side, number / side % side, number / (side * side)];
            let [x, y, z] = place.map(|it| (it as f64 + 0.5) / side as f64 - 0.5);
            let place = DVec3::new(x, y, if flat { 0.0 } else { z });
            let place = edge * (place + 0.02 * self.vector(&mut numbers));
            world.add_sphere(Sphere::new(place, 0.5).with_velocity(velocity))?;
        }
        Ok((world, speed, edge))
    }

    fn vector(self, numbers: &mut Numbers) -> DVec3 {
        let vector = numbers.normal_vector();
        if self.dimensions == 2 { vector.with_z(0.0) } else { vector }
    }
}
