//! Emitters: sources of spheres.

use std::collections::VecDeque;

use glam::{DQuat, DVec3};

use crate::bodies::Spheres;
use crate::error::InvalidValue;
use crate::id::SphereId;
use crate::non_additivity::NonAdditivity;
use crate::numbered::Numbered;
use crate::settings::nearest_image;
use crate::sphere::Sphere;
use crate::validate;

/// A sphere is due when its time is at most this part of a frame after the start of it, so that
/// rounding in sums of frame times cannot delay it by a frame
/// (`docs/physics/motion.md`, "Emission").
const DUE_TOLERANCE: f64 = 1e-7;

/// Latest due time \[s\] of spheres that are emitted with a frame that begins at `time` and lasts `h` \[s\].
pub(crate) fn due_with_frame(time: f64, h: f64) -> f64 {
    time + DUE_TOLERANCE * h
}

/// Spheres that overlap by no more than this part of the sum of their radii have room.
const OVERLAP: f64 = 1e-3;

/// More spheres than this in one frame are a mistake in `period`.
const MAX_PER_FRAME: f64 = 1e6;

/// Emits a sphere at the times 0, period, 2 period, ... after it entered the world, [`Self::count`] in all.
///
/// The times depend on no sphere. Where a sphere is in the way, the new one overlaps it or is left out:
/// [`Self::needs_room`].
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Emitter {
    /// The sphere to emit, in the emitter's frame: `position` \[m\] is an offset from the emitter's
    /// origin, `velocity` \[m/s\] and `angular_velocity` \[rad/s\] are turned into the world with
    /// it.
    pub sphere: Sphere,
    /// Origin of the emitter's frame in the world \[m\].
    pub position: DVec3,
    /// Rotation from the emitter's frame to the world; any length but zero.
    pub rotation: DQuat,
    /// Time between two spheres \[s\], > 0.
    pub period: f64,
    /// Largest number of its spheres in the world, beyond which the oldest is removed for the next; `None`: no
    /// limit.
    pub max_spheres: Option<u32>,
    /// Number of spheres to emit in all, those left out included; `None`: no end.
    pub count: Option<u32>,
    /// Whether a sphere is left out that would overlap another one by more than a thousandth of the sum of
    /// their radii; `None`: under the rule `contact`. Its id is never given to another one.
    pub needs_room: Option<bool>,
}

impl Emitter {
    /// Emits this sphere at the origin of the world every `period` \[s\], without an end.
    pub fn new(sphere: Sphere, period: f64) -> Self {
        let (position, rotation) = (DVec3::ZERO, DQuat::IDENTITY);
        let (max_spheres, count, needs_room) = (None, None, None);
        Self { sphere, position, rotation, period, max_spheres, count, needs_room }
    }

    /// Returns the emitter with its origin at this place in the world \[m\].
    pub fn with_position(self, position: DVec3) -> Self {
        Self { position, ..self }
    }

    /// Returns the emitter with this rotation from its frame to the world.
    pub fn with_rotation(self, rotation: DQuat) -> Self {
        Self { rotation, ..self }
    }

    /// Returns the emitter with at most this many of its spheres alive; `None`: no limit.
    pub fn with_max_spheres(self, max_spheres: impl Into<Option<u32>>) -> Self {
        Self { max_spheres: max_spheres.into(), ..self }
    }

    /// This emitter with another [`Self::count`].
    pub fn with_count(self, count: impl Into<Option<u32>>) -> Self {
        Self { count: count.into(), ..self }
    }

    /// This emitter with another [`Self::needs_room`].
    pub fn with_needs_room(self, needs_room: impl Into<Option<bool>>) -> Self {
        Self { needs_room: needs_room.into(), ..self }
    }

    /// Returns the emitter with this sphere to emit.
    pub fn with_sphere(self, sphere: Sphere) -> Self {
        Self { sphere, ..self }
    }

    /// Returns the emitter with this time between two spheres \[s\].
    pub fn with_period(self, period: f64) -> Self {
        Self { period, ..self }
    }

    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        self.sphere.validate()?;
        validate::finite("position", self.position)?;
        validate::rotation("rotation", self.rotation)?;
        validate::positive("period", self.period)?;
        self.max_spheres.map_or(Ok(()), |max| validate::at_least_one("max_spheres", max))?;
        self.count.map_or(Ok(()), |count| validate::at_least_one("count", count))
    }

    /// The sphere as it appears in the world.
    pub(crate) fn emitted(&self) -> Sphere {
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct EmitterState {
    pub emitter: Emitter,
    /// When it was added to the world, and so emits first \[s\].
    pub start: f64,
    /// Number of spheres emitted or left out so far.
    pub emitted: u64,
    /// Spheres of the emitter that may still be alive, oldest first; empty without `max_spheres`.
    pub ring: VecDeque<SphereId>,
}

impl EmitterState {
    pub fn new(emitter: Emitter, start: f64) -> Self {
        Self { emitter, start, emitted: 0, ring: VecDeque::new() }
    }

    /// Returns when the next sphere of the emitter is due \[s\]; infinite after the last one.
    fn due(&self) -> f64 {
        if self.is_done() {
            return f64::INFINITY;
        }
        self.start + self.emitted as f64 * self.emitter.period
    }

    fn is_done(&self) -> bool {
        self.emitter.count.is_some_and(|count| self.emitted >= u64::from(count))
    }

    /// Replaces the parameters at this time \[s\]: with another period it starts again, and an emitter
    /// that was done emits what a larger count adds from now on.
    pub fn set(&mut self, emitter: Emitter, time: f64) {
        let was_done = self.is_done();
        if emitter.period != self.emitter.period {
            (self.start, self.emitted) = (time, 0);
        }
        self.emitter = emitter;
        if was_done && !self.is_done() {
            // Not sooner than a period after the last one.
            self.start = self.start.max(time - self.emitted as f64 * self.emitter.period);
        }
    }

    fn needs(&self, room: &Room) -> bool {
        self.emitter.needs_room.unwrap_or(room.is_needed)
    }

    fn is_due(&self, time: f64) -> bool {
        self.due() <= time
    }

    /// Returns an error for a period so short that one frame would emit spheres without end.
    pub fn validate_at(&self, time: f64) -> Result<(), InvalidValue> {
        let due = (time - self.start) / self.emitter.period - self.emitted as f64;
        let left = self.emitter.count.map(|count| f64::from(count) - self.emitted as f64);
        let due = left.map_or(due, |left| due.min(left));
        let requirement = "longer: more than a million spheres are due in one frame";
        validate::require(due < MAX_PER_FRAME, "period", requirement, self.emitter.period)
    }
}

/// Spheres that an emission added and removed.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Emission {
    /// Ascending.
    pub emitted: Vec<SphereId>,
    /// When each was due \[s\].
    pub due: Vec<f64>,
    /// Spheres that left, in the order of leaving.
    pub retired: Vec<SphereId>,
    /// Ids of spheres that were left out, ascending.
    pub left_out: Vec<SphereId>,
}

/// The room that an emitted sphere needs.
#[derive(Debug, Clone)]
pub(crate) struct Room {
    /// Whether emitters need room by default.
    pub is_needed: bool,
    /// Edges of the periodic box \[m\], infinite along open axes.
    pub period: DVec3,
    /// Where spheres of named materials touch.
    pub non_additivity: NonAdditivity,
}

impl Room {
    /// Whether a sphere overlaps none of these, `apart` from one.
    fn is_there(&self, sphere: &Sphere, spheres: &Spheres, apart: Option<SphereId>) -> bool {
        let apart = apart.and_then(|id| spheres.index_of(id));
        let places = spheres.positions().iter().zip(spheres.radii()).enumerate();
        places.filter(|(index, _)| Some(*index) != apart).all(|(index, (&position, &radius))| {
            let offset = position - sphere.position;
            let offset = nearest_image(offset, self.period);
            let materials = [spheres.properties.material(index), sphere.material];
            let factor = self.non_additivity.factor(materials);
            let reach = (1.0 - OVERLAP) * (factor * (radius + sphere.radius));
            offset.length_squared() >= reach * reach
        })
    }
}

/// Whether any emitter has a sphere due until `time` \[s\].
pub(crate) fn any_due(emitters: &Numbered<EmitterState>, time: f64) -> bool {
    emitters.iter().any(|(_, state)| state.is_due(time))
}

/// Returns when the next sphere of all emitters is due \[s\]; infinite without any.
pub(crate) fn next_due(emitters: &Numbered<EmitterState>) -> f64 {
    emitters.iter().map(|(_, state)| state.due()).fold(f64::INFINITY, f64::min)
}

/// Emits every sphere that is due until `time` \[s\], emitter by emitter.
pub(crate) fn emit(
    emitters: &mut Numbered<EmitterState>,
    spheres: &mut Spheres,
    next_id: &mut u64,
    time: f64,
    room: &Room,
) -> Emission {
    let mut emission = Emission::default();
    for state in emitters.values_mut() {
        // Spheres that the program removed no longer count.
        state.ring.retain(|id| spheres.index_of(*id).is_some());
        let sphere = state.emitter.emitted();
        let max = state.emitter.max_spheres.map(|max| max as usize);
        while state.is_due(time) {
            let (id, due) = (SphereId(*next_id), state.due());
            *next_id += 1;
            state.emitted += 1;
            let is_full = max.is_some_and(|max| state.ring.len() >= max);
            let oldest = state.ring.front().copied().filter(|_| is_full);
            if state.needs(room) && !room.is_there(&sphere, spheres, oldest) {
                emission.left_out.push(id);
                continue;
            }
            if is_full {
                emission.retired.extend(state.ring.pop_front());
            }
            spheres.push(id, &sphere);
            emission.emitted.push(id);
            emission.due.push(due);
            if max.is_some() {
                state.ring.push_back(id);
            }
        }
    }
    if !emission.retired.is_empty() {
        spheres.remove_all(&emission.retired);
    }
    emission
}
