//! Past of a session, from which every frame can be computed again, bit for bit.

use std::sync::Arc;

use carom::{Rule, Snapshot, World};

use crate::change::{Change, PastChange};
use crate::error::SessionError;
use crate::looks::Looks;
use crate::readings::Tally;
use crate::setup::Setup;
use crate::timetable::Timetable;

/// Default limit on the memory of stored moments \[bytes\].
pub const DEFAULT_MEMORY: usize = 256 << 20;

/// Most stored moments: enough that every frame is near one, and few enough that searching them
/// takes no time.
const MOST_MOMENTS: usize = 1024;

/// Memory per sphere: id, position, velocity, radius, mass, restitution, and the colour \[bytes\].
const BYTES_PER_SPHERE: usize = 112;

/// Memory per sphere if any sphere rotates: orientation and angular velocity \[bytes\].
const BYTES_PER_ROTATION: usize = 56;
/// Memory per sphere if any sphere has its own friction or is no solid ball \[bytes\].
const BYTES_PER_FRICTION: usize = 72;
/// Memory per sphere for flight and predictions under the rule `exact` \[bytes\]: 250 were measured
/// in dense gases; the rest is for persistent contacts.
const BYTES_PER_FLIGHT: usize = 400;

/// Memory per collider with its surfaces \[bytes\], measured for a box, which has most.
const BYTES_PER_COLLIDER: usize = 3000;

/// Memory of everything that does not grow with the scene \[bytes\], a generous estimate.
const BYTES_PER_MOMENT: usize = 2000;

/// State of a session at one moment.
#[derive(Debug, Clone)]
pub(crate) struct Moment {
    /// Number of frames taken.
    pub frame: u64,
    /// Number of changes made before.
    pub changes: usize,
    /// Counts up to this moment.
    pub tally: Tally,
    pub setup: Arc<Setup>,
    pub looks: Looks,
    state: Snapshot,
    bytes: usize,
}

impl Moment {
    /// Stores the present state of a world.
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

    /// State of the world at this moment.
    pub fn state(&self) -> &Snapshot {
        &self.state
    }

    /// Restores the world to this moment.
    pub fn restore(&self, world: &mut World) {
        world.restore(&self.state);
    }
}

/// Estimated memory of a moment of this world \[bytes\].
fn estimated_bytes(world: &World, frame: u64) -> usize {
    // Before the first frame there are no predictions.
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

/// Past of a session: stored moments, and all changes from outside.
///
/// Steps and changes are deterministic, so each frame can be computed from any earlier moment. All
/// changes are stored, because they are small. Moments are stored within a limit of memory: densely
/// near the present, and more sparsely farther away, so that the cost of going back is proportional
/// to the distance.
#[derive(Debug, Clone)]
pub(crate) struct History {
    /// Stored moments, ascending by frame; the first is frame 0.
    moments: Vec<Moment>,
    /// All changes, ascending by frame. Those after the furthest frame are made when it is reached.
    changes: Arc<Vec<PastChange>>,
    /// Times of frames, up to the furthest one.
    timetable: Timetable,
    furthest: (u64, f64),
    /// Limit on the memory of the moments without the first \[bytes\].
    memory: usize,
}

impl History {
    /// Creates a past that begins with `start`, with frames of `frame_time` \[s\]. `changes`,
    /// ascending by frame, are still to be made.
    pub fn new(start: Moment, frame_time: f64, changes: Arc<Vec<PastChange>>) -> Self {
        Self {
            moments: vec![start],
            changes,
            timetable: Timetable::new(frame_time),
            furthest: (0, 0.0),
            memory: DEFAULT_MEMORY,
        }
    }

    /// Sets the limit on the memory of moments \[bytes\]. The first moment is always kept.
    pub fn set_memory(&mut self, bytes: usize, present: u64) {
        self.memory = bytes;
        self.thin_out(present);
    }

    /// Estimated memory of all moments \[bytes\].
    pub fn bytes(&self) -> usize {
        self.moments.iter().map(|moment| moment.bytes).sum()
    }

    /// Furthest frame reached, and its time \[s\].
    pub fn furthest(&self) -> (u64, f64) {
        self.furthest
    }

    /// Records that a frame was reached, at `time` \[s\].
    pub fn reach(&mut self, frame: u64, time: f64) {
        if frame > self.furthest.0 {
            self.furthest = (frame, time);
        }
    }

    /// All changes, ascending by frame; those after the furthest frame are still to be made.
    pub fn changes(&self) -> &Arc<Vec<PastChange>> {
        &self.changes
    }

    /// Returns the change that follows the first `done` ones, if it belongs to this frame.
    pub fn change_at(&self, frame: u64, done: usize) -> Option<&Change> {
        self.changes.get(done).filter(|it| it.frame == frame).map(|it| &it.change)
    }

    /// Removes all changes except the first `count`.
    pub fn forget_changes_after(&mut self, count: usize) {
        Arc::make_mut(&mut self.changes).truncate(count);
    }

    /// Removes everything after this frame, at `time` \[s\].
    pub fn cut(&mut self, frame: u64, time: f64) {
        self.moments.retain(|moment| moment.frame <= frame);
        self.forget_changes_after(self.changes.partition_point(|it| it.frame <= frame));
        self.timetable.cut(frame);
        self.furthest = (frame, time);
    }

    /// Replaces all changes, and drops the moments that they make invalid.
    pub fn rewrite(&mut self, changes: Arc<Vec<PastChange>>) {
        let same = self.changes.iter().zip(changes.iter()).take_while(|(old, new)| old == new);
        let kept = same.count();
        let others = [self.changes.get(kept), changes.get(kept)].into_iter().flatten();
        if let Some(frame) = others.map(|it| it.frame).min() {
            self.moments.retain(|it| (it.frame, it.changes) <= (frame, kept));
        }
        self.changes = changes;
    }

    /// Makes this frame, at `time` \[s\], the furthest one. The frames after it last `frame_time`
    /// \[s\]; changes after it are still to be made.
    pub fn end(&mut self, frame: u64, time: f64, frame_time: f64) {
        self.moments.retain(|moment| moment.frame <= frame);
        self.timetable.cut(frame);
        self.furthest = (frame, time);
        self.note_frame_time(frame_time);
    }

    /// Times of all edits \[s\], ascending.
    pub fn edit_times(&self) -> Vec<f64> {
        let edits = self.changes.iter().filter(|it| matches!(it.change, Change::Edit(_)));
        let timetable = self.complete_timetable();
        edits.map(|it| timetable.time_of(it.frame)).collect()
    }

    /// Time of a frame \[s\], up to rounding.
    pub fn time_of(&self, frame: u64) -> f64 {
        self.complete_timetable().time_of(frame)
    }

    /// Timetable including the frames that are still to come.
    fn complete_timetable(&self) -> Timetable {
        let reached = self.changes.partition_point(|it| it.frame <= self.furthest.0);
        let mut timetable = self.timetable.clone();
        timetable.extend(&self.changes[reached..]);
        timetable
    }

    /// Adds a change at the furthest frame, after which frames last `frame_time` \[s\]. Returns the
    /// number of changes up to it.
    pub fn note(&mut self, change: Change, frame_time: f64) -> usize {
        let frame = self.furthest.0;
        let place = self.changes.partition_point(|it| it.frame <= frame);
        Arc::make_mut(&mut self.changes).insert(place, PastChange { frame, change });
        self.note_frame_time(frame_time);
        place + 1
    }

    /// Records that frames after the furthest one last `frame_time` \[s\].
    pub fn note_frame_time(&mut self, frame_time: f64) {
        let (frame, time) = self.furthest;
        self.timetable.note(frame, time, frame_time);
    }

    /// Frame nearest to a time \[s\], which may lie in the future.
    ///
    /// # Errors
    /// The same as those of [`Timetable::frame_at`].
    pub fn frame_at(&self, time: f64) -> Result<u64, SessionError> {
        self.complete_timetable().frame_at(time)
    }

    /// Whether the last change at the furthest frame was a failed step.
    pub fn ends_with_failed_step(&self) -> bool {
        let frame = self.furthest.0;
        let count = self.changes.partition_point(|it| it.frame <= frame);
        let last = self.changes[..count].last();
        last.is_some_and(|it| it.frame == frame && it.change == Change::FailedStep)
    }

    /// Stored moments up to a frame, ascending by frame.
    pub fn until(&self, frame: u64) -> impl Iterator<Item = &Moment> {
        self.moments.iter().take_while(move |moment| moment.frame <= frame)
    }

    /// Last stored moment that is not after this frame.
    pub fn before(&self, frame: u64) -> &Moment {
        let later = self.moments.partition_point(|moment| moment.frame <= frame);
        &self.moments[later.saturating_sub(1)]
    }

    /// Whether to store the present state at this frame. Initially every frame is stored, because a
    /// copy is much cheaper than a step.
    pub fn wants(&self, frame: u64, world: &World) -> bool {
        self.before(frame).frame < frame && estimated_bytes(world, frame) <= self.memory
    }

    /// Stores a moment, unless its frame is stored already; removes others if necessary.
    pub fn keep(&mut self, moment: Moment) {
        let present = moment.frame;
        let place = self.moments.partition_point(|it| it.frame < moment.frame);
        if self.moments.get(place).is_some_and(|it| it.frame == moment.frame) {
            return;
        }
        self.moments.insert(place, moment);
        self.thin_out(present);
    }

    /// Drops moments until the rest is within the limit. It drops first those whose loss increases
    /// the distance to a frame least, relative to their distance from the present.
    fn thin_out(&mut self, present: u64) {
        let first = self.moments.first().map_or(0, |moment| moment.bytes);
        let mut bytes = self.bytes() - first;
        let is_too_much = |bytes, count| bytes > self.memory || count > MOST_MOMENTS;
        while is_too_much(bytes, self.moments.len()) && self.moments.len() > 1 {
            let place = self.least_missed(present);
            bytes -= self.moments.remove(place).bytes;
        }
    }

    /// Index of the moment whose loss matters least; there must be at least two moments.
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
