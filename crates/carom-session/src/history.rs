//! The past of a session, from which every frame of it can be had again, bit for bit.

use std::sync::Arc;

use carom::{Rule, Snapshot, World};

use crate::change::{Change, PastChange};
use crate::error::SessionError;
use crate::looks::Looks;
use crate::readings::Tally;
use crate::setup::Setup;
use crate::timetable::Timetable;

/// Memory that the moments kept may take by default \[bytes\].
pub const DEFAULT_MEMORY: usize = 256 << 20;

/// Most moments kept: so many that none between two of them is far, so few that to look through
/// them takes no time.
const MOST_MOMENTS: usize = 1024;

/// Memory per sphere: id, position, velocity, radius, mass, restitution, and the colour \[bytes\].
const BYTES_PER_SPHERE: usize = 112;

/// Memory per sphere where one turns: orientation and angular velocity \[bytes\].
const BYTES_PER_ROTATION: usize = 56;
/// Memory per sphere where one says something of friction or is no solid ball \[bytes\].
const BYTES_PER_FRICTION: usize = 72;
/// Memory per sphere for its flight and predictions under the rule `exact` \[bytes\]: 250 were
/// measured in dense gases; the rest is for persistent contacts.
const BYTES_PER_FLIGHT: usize = 400;

/// Memory per collider with its surfaces \[bytes\]; a box, which has most, measured.
const BYTES_PER_COLLIDER: usize = 3000;

/// Memory of everything whose amount does not grow \[bytes\], generously.
const BYTES_PER_MOMENT: usize = 2000;

/// A session at one moment.
#[derive(Debug, Clone)]
pub(crate) struct Moment {
    /// Number of frames taken.
    pub frame: u64,
    /// How many changes came before, of all.
    pub changes: usize,
    /// What was counted so far.
    pub tally: Tally,
    pub setup: Arc<Setup>,
    pub looks: Looks,
    state: Snapshot,
    bytes: usize,
}

impl Moment {
    /// The present of a world.
    pub fn new(
        frame: u64,
        changes: usize,
        tally: Tally,
        world: &World,
        more: (&Arc<Setup>, &Looks),
    ) -> Self {
        let (setup, looks) = (more.0.clone(), more.1.clone());
        let bytes = estimated_bytes(world, frame);
        Self { frame, changes, tally, setup, looks, state: world.snapshot(), bytes }
    }

    /// What there was then.
    pub fn state(&self) -> &Snapshot {
        &self.state
    }

    /// Puts the world back to this moment.
    pub fn restore(&self, world: &mut World) {
        world.restore(&self.state);
    }
}

/// Memory that a moment of this world takes \[bytes\].
fn estimated_bytes(world: &World, frame: u64) -> usize {
    // Before the first frame, nothing has been predicted.
    let has_flights = frame > 0 && matches!(world.settings().rule, Rule::Exact(_));
    let spheres = world.spheres();
    let has_friction = !(spheres.frictions().is_empty() && spheres.inertia_factors().is_empty());
    let parts = [
        (true, BYTES_PER_SPHERE),
        (has_flights, BYTES_PER_FLIGHT),
        (!spheres.orientations().is_empty(), BYTES_PER_ROTATION),
        (has_friction, BYTES_PER_FRICTION),
    ];
    let per_sphere: usize = parts.iter().filter(|(is, _)| *is).map(|(_, bytes)| bytes).sum();
    BYTES_PER_MOMENT + spheres.len() * per_sphere + world.colliders().len() * BYTES_PER_COLLIDER
}

/// The past of a session: moments, and the changes from outside.
///
/// Steps and changes are deterministic, so each frame follows from any moment before it. Changes
/// are kept all, being small; moments within a bound of memory: dense near the present and thinner
/// the farther away, so that going back costs time in proportion to how far one goes.
#[derive(Debug)]
pub(crate) struct History {
    /// Ascending by frame; the first is frame 0.
    moments: Vec<Moment>,
    /// Ascending by frame. Those after the furthest frame are made when it is reached.
    changes: Arc<Vec<PastChange>>,
    /// Up to the furthest frame.
    timetable: Timetable,
    furthest: (u64, f64),
    /// Bound on the memory of the moments but the first \[bytes\].
    memory: usize,
}

impl History {
    /// A past that begins with `start`, with frames of `frame_time` \[s\]; `changes`, ascending by
    /// frame, are to come.
    pub fn new(start: Moment, frame_time: f64, changes: Arc<Vec<PastChange>>) -> Self {
        Self {
            moments: vec![start],
            changes,
            timetable: Timetable::new(frame_time),
            furthest: (0, 0.0),
            memory: DEFAULT_MEMORY,
        }
    }

    /// Bounds the memory of the moments \[bytes\]. The first is always kept.
    pub fn set_memory(&mut self, bytes: usize, present: u64) {
        self.memory = bytes;
        self.thin_out(present);
    }

    /// Estimated memory of all moments \[bytes\].
    pub fn bytes(&self) -> usize {
        self.moments.iter().map(|moment| moment.bytes).sum()
    }

    /// The last frame reached, and its time \[s\].
    pub fn furthest(&self) -> (u64, f64) {
        self.furthest
    }

    /// Notes that a frame was reached, at `time` \[s\].
    pub fn reach(&mut self, frame: u64, time: f64) {
        if frame > self.furthest.0 {
            self.furthest = (frame, time);
        }
    }

    /// All changes, ascending by frame; those after the furthest frame are still to come.
    pub fn changes(&self) -> &Arc<Vec<PastChange>> {
        &self.changes
    }

    /// The change after the first `done`, if it comes at this frame.
    pub fn change_at(&self, frame: u64, done: usize) -> Option<&Change> {
        self.changes.get(done).filter(|it| it.frame == frame).map(|it| &it.change)
    }

    /// Forgets all changes but the first `count`.
    pub fn forget_changes_after(&mut self, count: usize) {
        Arc::make_mut(&mut self.changes).truncate(count);
    }

    /// Cuts off what comes after this frame, at `time` \[s\].
    pub fn cut(&mut self, frame: u64, time: f64) {
        self.moments.retain(|moment| moment.frame <= frame);
        self.forget_changes_after(self.changes.partition_point(|it| it.frame <= frame));
        self.timetable.cut(frame);
        self.furthest = (frame, time);
    }

    /// Puts other changes in the place of all, and drops the moments that they make wrong.
    pub fn rewrite(&mut self, changes: Arc<Vec<PastChange>>) {
        let same = self.changes.iter().zip(changes.iter()).take_while(|(old, new)| old == new);
        let kept = same.count();
        let others = [self.changes.get(kept), changes.get(kept)].into_iter().flatten();
        if let Some(frame) = others.map(|it| it.frame).min() {
            self.moments.retain(|it| (it.frame, it.changes) <= (frame, kept));
        }
        self.changes = changes;
    }

    /// Makes this frame, at `time` \[s\], the last one that was reached; frames after it last for
    /// `frame_time` \[s\]. Changes after it are still to come.
    pub fn end(&mut self, frame: u64, time: f64, frame_time: f64) {
        self.moments.retain(|moment| moment.frame <= frame);
        self.timetable.cut(frame);
        self.furthest = (frame, time);
        self.note_frame_time(frame_time);
    }

    /// The times of all edits \[s\], ascending.
    pub fn edit_times(&self) -> Vec<f64> {
        let edits = self.changes.iter().filter(|it| matches!(it.change, Change::Edit(_)));
        let timetable = self.complete_timetable();
        edits.map(|it| timetable.time_of(it.frame)).collect()
    }

    /// The time of a frame \[s\], to rounding.
    pub fn time_of(&self, frame: u64) -> f64 {
        self.complete_timetable().time_of(frame)
    }

    /// With the frames that are to come.
    fn complete_timetable(&self) -> Timetable {
        let reached = self.changes.partition_point(|it| it.frame <= self.furthest.0);
        let mut timetable = self.timetable.clone();
        timetable.extend(&self.changes[reached..]);
        timetable
    }

    /// Notes a change at the last frame, after which frames last for `frame_time` \[s\]. Returns
    /// how many changes there are.
    pub fn note(&mut self, change: Change, frame_time: f64) -> usize {
        let frame = self.furthest.0;
        let place = self.changes.partition_point(|it| it.frame <= frame);
        Arc::make_mut(&mut self.changes).insert(place, PastChange { frame, change });
        self.note_frame_time(frame_time);
        place + 1
    }

    /// Notes that after the last frame, frames last for `frame_time` \[s\].
    pub fn note_frame_time(&mut self, frame_time: f64) {
        let (frame, time) = self.furthest;
        self.timetable.note(frame, time, frame_time);
    }

    /// The frame nearest to a time \[s\], which may be one not reached yet.
    ///
    /// # Errors
    /// As [`Timetable::frame_at`].
    pub fn frame_at(&self, time: f64) -> Result<u64, SessionError> {
        self.complete_timetable().frame_at(time)
    }

    /// Whether the last change at the last frame was a failed step.
    pub fn ends_with_failed_step(&self) -> bool {
        let frame = self.furthest.0;
        let count = self.changes.partition_point(|it| it.frame <= frame);
        let last = self.changes[..count].last();
        last.is_some_and(|it| it.frame == frame && it.change == Change::FailedStep)
    }

    /// All moments kept up to a frame, ascending by frame.
    pub fn until(&self, frame: u64) -> impl Iterator<Item = &Moment> {
        self.moments.iter().take_while(move |moment| moment.frame <= frame)
    }

    /// The last moment kept that is not after this frame.
    pub fn before(&self, frame: u64) -> &Moment {
        let later = self.moments.partition_point(|moment| moment.frame <= frame);
        &self.moments[later.saturating_sub(1)]
    }

    /// Whether the present of this world, at this frame, is to be kept: every frame is, to begin
    /// with, since a copy takes a small part of the time of a step.
    pub fn wants(&self, frame: u64, world: &World) -> bool {
        self.before(frame).frame < frame && estimated_bytes(world, frame) <= self.memory
    }

    /// Keeps a moment, unless its frame is kept already; makes place for it.
    pub fn keep(&mut self, moment: Moment) {
        let present = moment.frame;
        let place = self.moments.partition_point(|it| it.frame < moment.frame);
        if self.moments.get(place).is_some_and(|it| it.frame == moment.frame) {
            return;
        }
        self.moments.insert(place, moment);
        self.thin_out(present);
    }

    /// Drops moments until the rest is within the bound: first those without which the way to a
    /// frame grows least, compared with how far it is from the present.
    fn thin_out(&mut self, present: u64) {
        let first = self.moments.first().map_or(0, |moment| moment.bytes);
        let mut bytes = self.bytes() - first;
        let is_too_much = |bytes, count| bytes > self.memory || count > MOST_MOMENTS;
        while is_too_much(bytes, self.moments.len()) && self.moments.len() > 1 {
            let place = self.least_missed(present);
            bytes -= self.moments.remove(place).bytes;
        }
    }

    /// The place of the moment that is missed least; there are two at least.
    fn least_missed(&self, present: u64) -> usize {
        let frame = |place: usize| self.moments.get(place).map(|moment| moment.frame);
        let loss = |place: &usize| {
            let here = self.moments[*place].frame;
            let before = frame(*place - 1).unwrap_or(0);
            let after = frame(*place + 1).unwrap_or(2 * here - before);
            (after - before) as f64 / (1 + here.abs_diff(present)) as f64
        };
        let last = self.moments.len() - 1;
        (1..=last).min_by(|a, b| loss(a).total_cmp(&loss(b))).unwrap_or(last)
    }
}
