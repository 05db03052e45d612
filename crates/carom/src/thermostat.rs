//! Thermostats: when velocities change, and to what (`docs/physics/thermostats.md`).

use glam::DVec3;

use crate::bodies::Spheres;
use crate::id::SphereId;
use crate::random::Random;
use crate::settings::Thermostat;
use crate::shear::Shear;
use crate::sum::Sum;

/// A change of velocities at `time` \[s\].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kick {
    pub time: f64,
    pub of: Kicked,
}

/// The spheres of a change.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Kicked {
    All,
    /// The sphere at an index of the world's arrays, and its velocity \[m/s\].
    One(usize, DVec3),
}

/// The changes that a thermostat still makes. They follow from the time and the ids of spheres alone, so nothing is
/// kept between steps.
#[derive(Debug, Clone)]
pub(crate) struct Kicks {
    thermostat: Thermostat,
    /// Number of dimensions.
    dimensions: u32,
    /// Number of the present interval: it ends at the multiple of the interval with the next number.
    number: f64,
    /// Changes in the present interval, the last one first.
    due: Vec<Kick>,
}

impl Kicks {
    /// The changes after `now` \[s\] in 2 or 3 dimensions.
    pub fn after(thermostat: Thermostat, spheres: &Spheres, dimensions: u32, now: f64) -> Self {
        let number = now / thermostat.interval();
        // An interval may end later than its rounded number says.
        let number = (number - 4.0 * f64::EPSILON * number.abs()).floor();
        let mut kicks = Self { thermostat, dimensions, number, due: Vec::new() };
        kicks.fill(spheres);
        kicks.due.retain(|kick| kick.time > now);
        while kicks.next() <= now {
            kicks.take(spheres);
        }
        kicks
    }

    /// Returns the time of the next change \[s\], or that of the end of an interval without one.
    pub fn next(&self) -> f64 {
        self.due.last().map_or_else(|| self.end_of_interval(), |kick| kick.time)
    }

    /// Takes out the next change, if there is one at its time.
    pub fn take(&mut self, spheres: &Spheres) -> Option<Kick> {
        let kick = self.due.pop();
        if self.due.is_empty() {
            self.number += 1.0;
            self.fill(spheres);
        }
        kick
    }

    fn end_of_interval(&self) -> f64 {
        (self.number + 1.0) * self.thermostat.interval()
    }

    /// Finds the changes of the present interval.
    fn fill(&mut self, spheres: &Spheres) {
        let Thermostat::Andersen { frequency, temperature, seed } = self.thermostat else {
            return self.due.push(Kick { time: self.end_of_interval(), of: Kicked::All });
        };
        for (index, (id, mass)) in spheres.ids().iter().zip(spheres.masses()).enumerate() {
            let mut random = Random::keyed(seed, [id.number(), self.number.to_bits()]);
            // Exponentially distributed times have no memory, so they may begin again in each interval.
            let mut time = random.exponential();
            while time <= 1.0 {
                let velocity = (temperature / mass).sqrt() * random.normal_vector();
                let velocity = in_space(velocity, self.dimensions);
                let of = Kicked::One(index, velocity);
                self.due.push(Kick { time: (self.number + time) / frequency, of });
                time += random.exponential();
            }
        }
        // Stable, so at one time the sphere with the larger id, which stands last, comes first.
        self.due.sort_by(|one, other| other.time.total_cmp(&one.time));
    }
}

/// The part of a vector in 2 or 3 dimensions.
fn in_space(vector: DVec3, dimensions: u32) -> DVec3 {
    if dimensions == 2 { vector.with_z(0.0) } else { vector }
}

/// Returns the velocities of all spheres after a change of all at `time` \[s\], in m/s.
pub(crate) fn velocities_after(
    kicks: &Kicks,
    spheres: &Spheres,
    shear: Option<Shear>,
    time: f64,
) -> Vec<DVec3> {
    let Kicks { thermostat, dimensions, .. } = *kicks;
    match thermostat {
        Thermostat::Andersen { .. } => spheres.velocities().to_vec(),
        Thermostat::Rescale { temperature, .. } => {
            rescaled(spheres, shear, temperature, dimensions)
        }
        Thermostat::WhiteNoise { interval, strength, seed } => {
            let variance = strength * interval;
            let number = (time / interval).round();
            let noise = noise(spheres, (seed, number), variance.sqrt());
            let changed = spheres.velocities().iter().zip(noise);
            let changed = changed.map(|(&velocity, noise)| velocity + in_space(noise, dimensions));
            changed.collect()
        }
    }
}

/// Returns the velocities, scaled about the mean flow to a kinetic temperature \[J\]. Spheres at rest stay so.
fn rescaled(
    spheres: &Spheres,
    shear: Option<Shear>,
    temperature: f64,
    dimensions: u32,
) -> Vec<DVec3> {
    let flow = |place: &DVec3| shear.map_or(DVec3::ZERO, |shear| shear.velocity_at(*place));
    let own = spheres.velocities().iter().zip(spheres.positions()).map(|(v, x)| *v - flow(x));
    let own: Vec<DVec3> = own.collect();
    let energies = spheres.masses().iter().zip(&own).map(|(m, v)| m * v.length_squared());
    let present =
        energies.collect::<Sum>().value() / (f64::from(dimensions) * spheres.len() as f64);
    let factor = if present > 0.0 { (temperature / present).sqrt() } else { 1.0 };
    let places = spheres.positions().iter();
    own.iter().zip(places).map(|(&velocity, x)| flow(x) + factor * velocity).collect()
}

/// Returns normally distributed changes of velocity with a standard deviation \[m/s\] and zero total momentum.
fn noise(spheres: &Spheres, (seed, number): (u64, f64), deviation: f64) -> Vec<DVec3> {
    let change = |id: &SphereId| {
        deviation * Random::keyed(seed, [id.number(), number.to_bits()]).normal_vector()
    };
    let mut changes: Vec<DVec3> = spheres.ids().iter().map(change).collect();
    let total: f64 = spheres.masses().iter().copied().collect::<Sum>().value();
    let momenta = spheres.masses().iter().zip(&changes).map(|(&mass, &change)| mass * change);
    let mean = momenta.fold(DVec3::ZERO, |sum, momentum| sum + momentum) / total;
    changes.iter_mut().for_each(|change| *change -= mean);
    changes
}
