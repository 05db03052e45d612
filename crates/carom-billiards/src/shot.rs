//! What happened in a shot, read from reports of steps.

use std::collections::BTreeMap;

use carom::{BodyPair, ColliderId, SphereId, StepReport};

/// Number of the cue ball.
pub const CUE: u8 = 0;

/// What happened in a shot, by the numbers of the balls: 0 for the cue ball.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Shot {
    /// The ball that the cue ball met first; the lowest of several that it met at the same instant.
    pub first_hit: Option<u8>,
    /// Balls that fell into pockets, in the order of their fall.
    pub pocketed: Vec<u8>,
    /// Balls that met a cushion after the first ball was hit, each once. A ball that lies at a cushion has not met it.
    pub railed: Vec<u8>,
    /// Balls that left the table otherwise than through pockets.
    pub off_table: Vec<u8>,
}

/// Reads impacts and sensor events of a world as a [`Shot`].
#[derive(Debug, Clone, Default)]
pub struct Referee {
    /// The number of each ball.
    pub balls: BTreeMap<SphereId, u8>,
    /// Cushions, jaws and rails.
    pub cushions: Vec<ColliderId>,
    /// Sensors that take balls out.
    pub pockets: Vec<ColliderId>,
    shot: Shot,
    /// When the first ball was hit, on the clock of the world \[s\].
    first_hit_time: Option<f64>,
}

impl Referee {
    /// Begins to watch a shot on a table with these balls, cushions and pockets.
    pub fn new(
        balls: BTreeMap<SphereId, u8>,
        cushions: Vec<ColliderId>,
        pockets: Vec<ColliderId>,
    ) -> Self {
        Self { balls, cushions, pockets, ..Self::default() }
    }

    /// Reads the report of a step that began at `start` on the clock of the world \[s\].
    pub fn read(&mut self, report: &StepReport, start: f64) {
        for impact in &report.impacts {
            match impact.between {
                BodyPair::Spheres(one, other) => self.note_hit(one, other, start + impact.time),
                BodyPair::Collider { collider, sphere } => self.note_cushion(collider, sphere),
            }
        }
        for event in report.sensor_events.iter().filter(|event| event.enters) {
            if self.pockets.contains(&event.collider)
                && let Some(ball) = self.balls.get(&event.sphere)
                && !self.shot.pocketed.contains(ball)
            {
                self.shot.pocketed.push(*ball);
            }
        }
    }

    /// Notes a ball that left the table.
    pub fn note_off_table(&mut self, ball: u8) {
        if !self.shot.off_table.contains(&ball) {
            self.shot.off_table.push(ball);
        }
    }

    /// Returns what has happened up to now.
    pub fn shot(&self) -> &Shot {
        &self.shot
    }

    fn note_hit(&mut self, one: SphereId, other: SphereId, time: f64) {
        let (Some(one), Some(other)) = (self.balls.get(&one), self.balls.get(&other)) else {
            return;
        };
        let hit = match (*one, *other) {
            (CUE, ball) | (ball, CUE) => ball,
            _ => return,
        };
        let first_time = *self.first_hit_time.get_or_insert(time);
        if self.shot.first_hit.is_none() || (time == first_time && self.shot.first_hit > Some(hit))
        {
            self.shot.first_hit = Some(hit);
        }
    }

    fn note_cushion(&mut self, collider: ColliderId, sphere: SphereId) {
        if self.shot.first_hit.is_none() || !self.cushions.contains(&collider) {
            return;
        }
        if let Some(ball) = self.balls.get(&sphere)
            && !self.shot.railed.contains(ball)
        {
            self.shot.railed.push(*ball);
        }
    }
}
