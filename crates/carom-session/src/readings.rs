//! What is measured while a scene runs.

use carom::{DVec3, Snapshot, SphereId, StageCounts, World};

use crate::gas::{Enclosure, thermal_motion};
use crate::impacts::{LastImpacts, ListedImpact};
use crate::series::Series;

/// Time over which impacts are counted for their rate \[s\]: long enough for a number that can be
/// read, short enough to follow what happens.
pub const RATE_WINDOW: f64 = 0.5;

/// What all spheres have together, at one frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reading {
    /// \[s\]
    pub time: f64,
    /// \[J\]
    pub kinetic_energy: f64,
    /// In all forces that have one \[J\].
    pub potential_energy: f64,
    /// \[kg m/s\]
    pub momentum: DVec3,
    /// Impacts since the beginning.
    pub impacts: u64,
    /// Impacts per second, over the last [`RATE_WINDOW`] or since the last reading before it.
    pub impact_rate: f64,
    /// Temperature times Boltzmann's constant \[J\]: the mean of `m v²` along one direction, of the
    /// motion relative to that of all together, over the directions in which there is any.
    pub thermal_energy: f64,
    /// In how many directions there is any.
    pub directions: u8,
    /// Of the impacts on the first closed container, or by the virial theorem in a periodic box, over
    /// the same time as the rate of impacts \[Pa\]; `None` where spheres are not shut in.
    pub pressure: Option<f64>,
    /// Spheres that were stepped in a zone by the rule `exact`.
    pub stepped: u32,
    /// Work of the frame that led here, by stage.
    pub work: StageCounts,
    /// By which impacts have pressed since the beginning; see [`Enclosure::pressing`].
    pressed: f64,
}

impl Reading {
    /// \[J\]
    pub fn total_energy(&self) -> f64 {
        self.kinetic_energy + self.potential_energy
    }
}

/// The sphere that was picked, at one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PickedReading {
    /// \[s\]
    pub time: f64,
    /// Centre \[m\].
    pub position: DVec3,
    /// \[m/s\]
    pub velocity: DVec3,
}

impl PickedReading {
    fn new(time: f64, sphere: &carom::Sphere) -> Self {
        Self { time, position: sphere.position, velocity: sphere.velocity }
    }
}

/// What was counted since the beginning.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Tally {
    pub impacts: u64,
    /// See [`Enclosure::pressing`].
    pub pressed: f64,
}

/// Everything measured up to the present, in bounded memory.
#[derive(Debug, Clone, Default)]
pub(crate) struct Readings {
    /// Of the future too, until that is cut off.
    all: Series<Reading>,
    picked: Option<SphereId>,
    picked_series: Series<PickedReading>,
    last_impacts: LastImpacts,
    pub tally: Tally,
    /// Work of the frame that led to the present, and the spheres that were stepped in it.
    work: StageCounts,
    stepped: u32,
}

impl Readings {
    /// Measures the present of the world, after a frame that began at `start` \[s\].
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

    /// Measures the present of the world, where it is time for that.
    pub fn measure(&mut self, frame: u64, world: &World) {
        if self.all.wants(frame) {
            self.all.push(frame, self.present(frame, world));
        }
        if let Some(reading) = self.present_of_picked(world) {
            self.picked_series.push(frame, reading);
        }
    }

    /// What is measured at the present of the world.
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

    /// The reading from which rates up to this frame, at `time` \[s\], are counted.
    fn window(&self, frame: u64, time: f64) -> Option<Reading> {
        let past = self.all.until(frame.checked_sub(1)?);
        let outside = past.partition_point(|(_, reading)| reading.time <= time - RATE_WINDOW);
        past.get(outside.saturating_sub(1)).map(|(_, reading)| *reading)
    }

    /// The picked sphere at the present of the world, if it is still there.
    pub fn present_of_picked(&self, world: &World) -> Option<PickedReading> {
        let sphere = world.sphere(self.picked?).ok()?;
        Some(PickedReading::new(world.time(), &sphere))
    }

    /// Follows another sphere: from now on, and before as far as it is in `past`, which is ascending
    /// by frame.
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

    /// The sphere that is followed.
    pub fn picked(&self) -> Option<SphereId> {
        self.picked
    }

    /// Goes back (or on) to a frame up to which this was counted.
    pub fn go_to(&mut self, frame: u64, tally: Tally) {
        self.tally = tally;
        // A world that was put back has no report: what was measured then counts.
        let measured = self.all.until(frame).last();
        let last = measured.map(|(_, reading)| *reading).unwrap_or_default();
        (self.work, self.stepped) = (last.work, last.stepped);
        self.picked_series.cut(frame);
        self.last_impacts.cut(frame);
    }

    /// Forgets what comes after this frame, at which the world was changed, and measures it anew.
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

    /// What was measured up to this frame.
    pub fn until(&self, frame: u64) -> impl Iterator<Item = &Reading> {
        self.all.until(frame).iter().map(|(_, reading)| reading)
    }

    /// The picked sphere, up to this frame.
    pub fn of_picked_until(&self, frame: u64) -> impl Iterator<Item = &PickedReading> {
        self.picked_series.until(frame).iter().map(|(_, reading)| reading)
    }

    /// The last impacts, oldest first.
    pub fn last_impacts(&self) -> impl Iterator<Item = &ListedImpact> {
        self.last_impacts.iter()
    }
}

/// By how much a second a count grew up to `time` \[s\], from what it was `before`, when that was \[s\].
fn rate(time: f64, count: f64, before: Option<(f64, f64)>) -> f64 {
    before.map_or(
        0.0,
        |(since, then)| if time > since { (count - then) / (time - since) } else { 0.0 },
    )
}
