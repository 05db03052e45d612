//! What is measured while a scene runs.

use carom::{DVec3, SphereId, StageCounts, World};

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
    /// Spheres that were stepped in a zone by the rule `exact`.
    pub stepped: u32,
    /// Work of the frame that led here, by stage.
    pub work: StageCounts,
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
    /// Centre above the origin \[m\].
    pub height: f64,
    /// \[m/s\]
    pub speed: f64,
}

/// Everything measured up to the present, in bounded memory.
#[derive(Debug, Clone, Default)]
pub(crate) struct Readings {
    /// Of the future too, until that is cut off.
    all: Series<Reading>,
    picked: Option<SphereId>,
    /// From when the sphere was picked.
    picked_series: Series<PickedReading>,
    last_impacts: LastImpacts,
    /// Since the beginning.
    pub impacts: u64,
    /// Work of the frame that led to the present, and the spheres that were stepped in it.
    work: StageCounts,
    stepped: u32,
}

impl Readings {
    /// Measures the present of the world, after a frame that began at `start` \[s\].
    pub fn note(&mut self, frame: u64, start: f64, world: &World) {
        let report = world.report();
        self.impacts += report.impacts.len() as u64;
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
        let (time, impacts) = (world.time(), self.impacts);
        Reading {
            time,
            kinetic_energy: world.kinetic_energy(),
            potential_energy: world.potential_energy(),
            momentum: world.momentum(),
            impacts,
            impact_rate: self.rate(frame, time),
            stepped: self.stepped,
            work: self.work,
        }
    }

    /// Impacts per second up to this frame, at `time` \[s\].
    fn rate(&self, frame: u64, time: f64) -> f64 {
        let past = self.all.until(frame.saturating_sub(1));
        let outside = past.partition_point(|(_, reading)| reading.time <= time - RATE_WINDOW);
        let Some((_, since)) = past.get(outside.saturating_sub(1)) else { return 0.0 };
        let impacts = self.impacts.saturating_sub(since.impacts);
        if time > since.time { impacts as f64 / (time - since.time) } else { 0.0 }
    }

    /// The picked sphere at the present of the world, if it is still there.
    pub fn present_of_picked(&self, world: &World) -> Option<PickedReading> {
        let sphere = world.sphere(self.picked?).ok()?;
        let (height, velocity) = (sphere.position.y, sphere.velocity);
        Some(PickedReading { time: world.time(), height, speed: velocity.length() })
    }

    /// Follows another sphere, from now on.
    pub fn pick(&mut self, sphere: Option<SphereId>) {
        if sphere != self.picked {
            self.picked = sphere;
            self.picked_series.clear();
        }
    }

    /// The sphere that is followed.
    pub fn picked(&self) -> Option<SphereId> {
        self.picked
    }

    /// Goes back (or on) to a frame after `impacts`.
    pub fn go_to(&mut self, frame: u64, impacts: u64) {
        self.impacts = impacts;
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
