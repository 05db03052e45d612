//! Emitters: sources of spheres.

use std::collections::VecDeque;

use glam::{DQuat, DVec3};

use crate::bodies::{Sphere, Spheres};
use crate::error::InvalidValue;
use crate::id::SphereId;
use crate::numbered::Numbered;
use crate::validate;

/// A sphere is due when its time is at most this much after the start of a frame \[s\], so that
/// rounding in sums of frame times cannot delay it by a frame
/// (`docs/physics/motion.md`, "Emission").
pub(crate) const DUE_TOLERANCE: f64 = 1e-9;

/// More spheres than this in one frame are a mistake in `period`, not a wish.
const MAX_PER_FRAME: f64 = 1e6;

/// Emits a sphere at the times 0, period, 2 period, ... after it entered the world.
///
/// When it emits depends on no sphere: one that is in the way is overlapped. A stream of spheres needs
/// a period in which each leaves its place, and room below it for all of them.
///
/// ```
/// use carom::{DVec3, Emitter, Sphere, World};
///
/// let falling = Sphere::new(DVec3::ZERO, 0.1).with_velocity(DVec3::NEG_Y);
/// let emitter = Emitter::new(falling, 0.5).with_position(DVec3::Y).with_max_spheres(2);
/// let mut world = World::default();
/// world.add_emitter(emitter)?;
/// let report = world.step(1.2)?;
/// // At 0, 0.5 and 1 s; the first makes place for the third.
/// assert_eq!((report.emitted.len(), report.retired.len()), (3, 1));
/// assert_eq!(world.spheres().len(), 2);
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Emitter {
    /// What is emitted, in the emitter's frame: `position` \[m\] is an offset from the emitter's
    /// origin, `velocity` \[m/s\] and
    /// `angular_velocity` \[rad/s\] are turned into the world with it.
    pub sphere: Sphere,
    /// Origin of the emitter's frame in the world \[m\].
    pub position: DVec3,
    /// Rotation from the emitter's frame to the world; any length but zero.
    pub rotation: DQuat,
    /// Time between two spheres \[s\], > 0.
    pub period: f64,
    /// With this many of its spheres alive, the oldest makes place for the next; `None`: no limit.
    pub max_spheres: Option<u32>,
}

impl Emitter {
    /// Emits this sphere at the origin of the world every `period` \[s\], without a limit.
    pub fn new(sphere: Sphere, period: f64) -> Self {
        let (position, rotation) = (DVec3::ZERO, DQuat::IDENTITY);
        Self { sphere, position, rotation, period, max_spheres: None }
    }

    /// The same emitter with its origin at this place in the world \[m\].
    pub fn with_position(self, position: DVec3) -> Self {
        Self { position, ..self }
    }

    /// The same emitter with this rotation from its frame to the world.
    pub fn with_rotation(self, rotation: DQuat) -> Self {
        Self { rotation, ..self }
    }

    /// The same emitter with at most this many of its spheres alive; `None`: no limit.
    pub fn with_max_spheres(self, max_spheres: impl Into<Option<u32>>) -> Self {
        Self { max_spheres: max_spheres.into(), ..self }
    }

    /// The same emitter of other spheres.
    pub fn with_sphere(self, sphere: Sphere) -> Self {
        Self { sphere, ..self }
    }

    /// The same emitter with this time between two spheres \[s\].
    pub fn with_period(self, period: f64) -> Self {
        Self { period, ..self }
    }

    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        self.sphere.validate()?;
        validate::finite("position", self.position)?;
        validate::rotation("rotation", self.rotation)?;
        let emits_in_turn = self.period > DUE_TOLERANCE && self.period.is_finite();
        let requirement = "finite and longer than 1e-9 s";
        validate::require(emits_in_turn, "period", requirement, self.period)?;
        self.max_spheres.map_or(Ok(()), |max| validate::at_least_one("max_spheres", max))
    }

    /// The sphere as it appears in the world.
    fn emitted(&self) -> Sphere {
        let rotation = self.rotation.normalize();
        Sphere {
            position: self.position + rotation * self.sphere.position,
            velocity: rotation * self.sphere.velocity,
            angular_velocity: rotation * self.sphere.angular_velocity,
            ..self.sphere
        }
    }
}

/// An emitter and what it has done so far.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EmitterState {
    pub emitter: Emitter,
    /// When it entered the world, and so emits first \[s\].
    pub start: f64,
    /// Number of spheres emitted so far.
    pub emitted: u64,
    /// Its spheres that may still be alive, oldest first; empty without `max_spheres`.
    pub ring: VecDeque<SphereId>,
}

impl EmitterState {
    pub fn new(emitter: Emitter, start: f64) -> Self {
        Self { emitter, start, emitted: 0, ring: VecDeque::new() }
    }

    /// When its next sphere is due \[s\].
    fn due(&self) -> f64 {
        self.start + self.emitted as f64 * self.emitter.period
    }

    fn is_due(&self, time: f64) -> bool {
        self.due() <= time
    }

    /// Refuses a period so short that one frame would have to emit spheres without end.
    pub fn validate_at(&self, time: f64) -> Result<(), InvalidValue> {
        let due = (time + DUE_TOLERANCE - self.start) / self.emitter.period - self.emitted as f64;
        let requirement = "longer: more than a million spheres are due in one frame";
        validate::require(due < MAX_PER_FRAME, "period", requirement, self.emitter.period)
    }
}

/// What came into the world and what left it for that.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Emission {
    /// Ascending.
    pub emitted: Vec<SphereId>,
    /// When each was due \[s\].
    pub due: Vec<f64>,
    /// In the order of leaving.
    pub retired: Vec<SphereId>,
}

/// Whether any emitter has a sphere due until `time` \[s\].
pub(crate) fn any_due(emitters: &Numbered<EmitterState>, time: f64) -> bool {
    emitters.iter().any(|(_, state)| state.is_due(time))
}

/// When the next sphere of all emitters is due \[s\]; infinite without any.
pub(crate) fn next_due(emitters: &Numbered<EmitterState>) -> f64 {
    emitters.iter().map(|(_, state)| state.due()).fold(f64::INFINITY, f64::min)
}

/// Emits every sphere that is due until `time` \[s\], emitter by emitter.
pub(crate) fn emit(
    emitters: &mut Numbered<EmitterState>,
    spheres: &mut Spheres,
    next_id: &mut u64,
    time: f64,
) -> Emission {
    let mut emission = Emission::default();
    for state in emitters.values_mut() {
        // Spheres that were removed by hand no longer count.
        state.ring.retain(|id| spheres.index_of(*id).is_some());
        let sphere = state.emitter.emitted();
        let max = state.emitter.max_spheres.map(|max| max as usize);
        while state.is_due(time) {
            if max.is_some_and(|max| state.ring.len() >= max) {
                emission.retired.extend(state.ring.pop_front());
            }
            let id = SphereId(*next_id);
            *next_id += 1;
            spheres.push(id, &sphere);
            emission.emitted.push(id);
            emission.due.push(state.due());
            if max.is_some() {
                state.ring.push_back(id);
            }
            state.emitted += 1;
        }
    }
    if !emission.retired.is_empty() {
        spheres.remove_all(&emission.retired);
    }
    emission
}
