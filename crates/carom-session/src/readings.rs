//! Measurements during a run.

use carom::{DVec3, Snapshot, SphereId, StageCounts, World};

use crate::gas::{Enclosure, thermal_motion};
use crate::impacts::{LastImpacts, ListedImpact};
use crate::series::Series;

/// Time over which impacts are counted for their rate \[s\]: long enough for a readable number,
/// short enough to follow changes.
pub const RATE_WINDOW: f64 = 0.5;

/// Quantities of all spheres together at one frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reading {
    /// Time \[s\].
    pub time: f64,
    /// Kinetic energy \[J\].
    pub kinetic_energy: f64,
    /// Potential energy in all forces that have a potential \[J\].
    pub potential_energy: f64,
    /// Momentum \[kg m/s\].
    pub momentum: DVec3,
    /// Number of impacts since the beginning.
    pub impacts: u64,
    /// Impacts per second, over the last [`RATE_WINDOW`], or since the last reading before it.
    pub impact_rate: f64,
    /// Temperature times Boltzmann's constant \[J\]: the mean of `m v²` per direction, relative to
    /// the centre of mass, over the directions in which spheres move.
    pub thermal_energy: f64,
    /// Number of directions in which spheres move.
    pub directions: u8,
    /// Pressure \[Pa\] from the impacts on the first closed container, or by the virial theorem in
    /// a periodic box, over the time of the impact rate; `None` if the spheres are not enclosed.
    pub pressure: Option<f64>,
    /// Number of spheres that the rule `exact` stepped in zones.
    pub stepped: u32,
    /// Work of the last frame, by stage.
    pub work: StageCounts,
    /// Sum of [`Enclosure::pressing`] since the beginning.
    pressed: f64,
}

impl Reading {
    /// Total energy \[J\].
    pub fn total_energy(&self) -> f64 {
        self.kinetic_energy + self.potential_energy
    }
}

/// State of the picked sphere at one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PickedReading {
    /// Time \[s\].
    pub time: f64,
    /// Centre \[m\].
    pub position: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
}

impl PickedReading {
    fn new(time: f64, sphere: &carom::Sphere) -> Self {
        Self { time, position: sphere.position, velocity: sphere.velocity }
    }
}

/// Counts since the beginning.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Tally {
    pub impacts: u64,
    /// Sum of [`Enclosure::pressing`].
    pub pressed: f64,
}

/// All measurements up to the present, in limited memory.
#[derive(Debug, Clone, Default)]
pub(crate) struct Readings {
    /// Readings, including those of the future until it is cut off.
    all: Series<Reading>,
    picked: Option<SphereId>,
    picked_series: Series<PickedReading>,
    last_impacts: LastImpacts,
    pub tally: Tally,
    /// Work and stepped spheres of the last frame.
    work: StageCounts,
    stepped: u32,
}

impl Readings {
    /// Measures the world after a frame that began at `start` \[s\].
    pub fn note(&mut self, frame: u64, start: f64, world: &World) {
        let report = world.report();
        self.tally.impacts += report.impacts.len() as u64;
        if let Some(enclosure) = Enclosure::of(world) {
            self.tally.pressed += enclosure.pressing(report, world);
        }
        (self.work, self.stepped) = (report.work, report.zone_account.spheres);
        self.last_impacts.note(report, frame, start, world);
        self.measure(frame, world);
    }

    /// Measures the present of the world, if a point is due.
    pub fn measure(&mut self, frame: u64, world: &World) {
        if self.all.wants(frame) {
            self.all.push(frame, self.present(frame, world));
        }
        if let Some(reading) = self.present_of_picked(world) {
            self.picked_series.push(frame, reading);
        }
    }

    /// Returns the measurements at the present of the world.
    pub fn present(&self, frame: u64, world: &World) -> Reading {
        let (time, Tally { impacts, pressed }) = (world.time(), self.tally);
        let motion = thermal_motion(world);
        let since = self.window(frame, time);
        let pressure = |enclosure: Enclosure| {
            let rate = rate(time, pressed, since.map(|it| (it.time, it.pressed)));
            enclosure.pressure(rate, world.spheres().len(), motion)
        };
        Reading {
            time,
            kinetic_energy: world.kinetic_energy(),
            potential_energy: world.potential_energy(),
            momentum: world.momentum(),
            impacts,
            impact_rate: rate(time, impacts as f64, since.map(|it| (it.time, it.impacts as f64))),
            thermal_energy: motion.energy,
            directions: motion.directions,
            pressure: Enclosure::of(world).map(pressure),
            stepped: self.stepped,
            work: self.work,
            pressed,
        }
    }

    /// Reading from which rates up to this frame, at `time` \[s\], are counted.
    fn window(&self, frame: u64, time: f64) -> Option<Reading> {
        let past = self.all.until(frame.checked_sub(1)?);
        let outside = past.partition_point(|(_, reading)| reading.time <= time - RATE_WINDOW);
        past.get(outside.saturating_sub(1)).map(|(_, reading)| *reading)
    }

    /// State of the picked sphere, if it still exists.
    pub fn present_of_picked(&self, world: &World) -> Option<PickedReading> {
        let sphere = world.sphere(self.picked?).ok()?;
        Some(PickedReading::new(world.time(), &sphere))
    }

    /// Picks another sphere: follows it from now on, and reads its past from `past`, which is
    /// ascending by frame.
    pub fn pick<'a>(
        &mut self,
        sphere: Option<SphereId>,
        past: impl Iterator<Item = (u64, &'a Snapshot)>,
    ) {
        if sphere == self.picked {
            return;
        }
        self.picked = sphere;
        self.picked_series.clear();
        for (frame, then) in past {
            if let Some(found) = sphere.and_then(|id| then.sphere(id)) {
                self.picked_series.push(frame, PickedReading::new(then.time(), &found));
            }
        }
    }

    /// The picked sphere.
    pub fn picked(&self) -> Option<SphereId> {
        self.picked
    }

    /// Goes to another frame that was measured, with the counts at that frame.
    pub fn go_to(&mut self, frame: u64, tally: Tally) {
        self.tally = tally;
        // A restored world has no report, so the stored measurement counts.
        let measured = self.all.until(frame).last();
        let last = measured.map(|(_, reading)| *reading).unwrap_or_default();
        (self.work, self.stepped) = (last.work, last.stepped);
        self.picked_series.cut(frame);
        self.last_impacts.cut(frame);
    }

    /// Removes everything after this frame, at which the world was changed, and measures it again.
    pub fn cut(&mut self, frame: u64, world: &World) {
        match frame.checked_sub(1) {
            Some(before) => {
                self.all.cut(before);
                self.picked_series.cut(before);
            }
            None => {
                self.all.clear();
                self.picked_series.clear();
            }
        }
        self.last_impacts.cut(frame);
        self.measure(frame, world);
    }

    /// Readings up to this frame.
    pub fn until(&self, frame: u64) -> impl Iterator<Item = &Reading> {
        self.all.until(frame).iter().map(|(_, reading)| reading)
    }

    /// Readings of the picked sphere up to this frame.
    pub fn of_picked_until(&self, frame: u64) -> impl Iterator<Item = &PickedReading> {
        self.picked_series.until(frame).iter().map(|(_, reading)| reading)
    }

    /// The most recent impacts, oldest first.
    pub fn last_impacts(&self) -> impl Iterator<Item = &ListedImpact> {
        self.last_impacts.iter()
    }
}

/// Rate at which a count grew until `time` \[s\]; `before` is an earlier time \[s\] with its count.
fn rate(time: f64, count: f64, before: Option<(f64, f64)>) -> f64 {
    before.map_or(
        0.0,
        |(since, then)| if time > since { (count - then) / (time - since) } else { 0.0 },
    )
}
