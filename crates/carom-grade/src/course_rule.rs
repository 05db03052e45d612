//! The course's rule, as a student writes it, with or without mistakes.
//!
//! A frame emits first; then it moves each ball and answers each collider that the ball touches.
//! Without mistakes, the states equal those of the engine's rule `discrete` bit for bit, which a
//! test checks. The rule is implemented again because the engine has no mistakes.

use carom::CombineRule;

use crate::contact::Surface;
use crate::course::{Acting, Course, Fixed, Kind, Source};
use crate::mistake::{Mistake, Mistakes};
use crate::real::{Real, Vec3};
use crate::tracks::{State, Touch, Track, Tracks};

/// A ball is emitted in a frame if its time is at most this part of the frame after the start of
/// the frame.
const DUE_TOLERANCE: f64 = 1e-7;

/// Frame time of a common display \[s\].
const DISPLAY: f64 = 1.0 / 60.0;

/// Most states of a run; a longer run ends early.
const MOST_STATES: usize = 100_000;

/// Times at which frames end.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Clock {
    /// Frames of the scene, up to a time \[s\].
    Fixed(f64),
    /// These times \[s\], ascending.
    At(Vec<f64>),
}

/// A frame of the clock.
#[derive(Debug, Clone, Copy)]
struct Frame {
    /// Start \[s\].
    start: f64,
    /// End \[s\].
    end: f64,
    /// Time by which the program moves balls \[s\].
    h: f64,
}

/// Runs a course in the number type `N`.
pub(crate) fn run<N: Real>(course: &Course, mistakes: Mistakes, clock: &Clock) -> Tracks {
    let mut run = Run::<N>::new(course, mistakes);
    run.take(&frames(course, mistakes, clock));
    run.tracks
}

/// Runs a course with an error in each number of each step. `jitter` returns the
/// relative error.
pub(crate) fn run_jittered(
    course: &Course,
    mistakes: Mistakes,
    clock: &Clock,
    jitter: &mut dyn FnMut() -> f64,
) -> Tracks {
    let mut run = Run::<f64>::new(course, mistakes);
    run.jitter = Some(jitter);
    run.take(&frames(course, mistakes, clock));
    run.tracks
}

/// Frames of a program with these mistakes.
fn frames(course: &Course, mistakes: Mistakes, clock: &Clock) -> Vec<Frame> {
    let end = match clock {
        Clock::Fixed(end) => *end,
        Clock::At(times) if mistakes.has(Mistake::DisplayFrames) => {
            let starts = std::iter::once(0.0).chain(times.iter().copied());
            let frames = starts.zip(times);
            let rate = course.step / course.frame_time;
            let frame = |(start, &end)| Frame { start, end, h: rate * (end - start) };
            return frames.map(frame).collect();
        }
        Clock::At(times) => times.last().copied().unwrap_or(0.0),
    };
    let length = if mistakes.has(Mistake::DisplayFrames) { DISPLAY } else { course.frame_time };
    let h = if mistakes.has(Mistake::DisplayStep) {
        DISPLAY
    } else if mistakes.has(Mistake::DisplayFrames) {
        DISPLAY * (course.step / course.frame_time)
    } else {
        course.step
    };
    // 1e-6 of a frame is a rounding error. The count is limited, because without balls nothing else
    // would end the run.
    let count = ((end / length - 1e-6).ceil().max(1.0) as usize).min(MOST_STATES);
    let time = |frame: usize| frame as f64 * length;
    (0..count).map(|frame| Frame { start: time(frame), end: time(frame + 1), h }).collect()
}

/// State of a ball in the program.
#[derive(Debug, Clone, Copy)]
struct Ball<N> {
    number: usize,
    position: Vec3<N>,
    velocity: Vec3<N>,
    radius: N,
    mass: N,
    restitution: f64,
    /// Velocity at the emission.
    emitted: Vec3<N>,
    /// Velocity at the start of the previous frame.
    before: Vec3<N>,
    /// Velocity before the last response to a collision.
    saved: Vec3<N>,
    /// Sum of forces \[N\] that was never cleared.
    force: Vec3<N>,
}

impl<N: Real> Ball<N> {
    fn new(number: usize, kind: &Kind) -> Self {
        let velocity = Vec3::of(kind.velocity);
        Self {
            number,
            position: Vec3::of(kind.position),
            velocity,
            radius: N::of(kind.radius),
            mass: N::of(kind.mass),
            restitution: kind.restitution,
            emitted: velocity,
            before: velocity,
            saved: velocity,
            force: Vec3::zero(),
        }
    }

    fn jitter(&mut self, jitter: &mut dyn FnMut() -> f64) {
        let mut off = |vector: Vec3<N>| {
            let mut off = |value: N| value * N::of(1.0 + jitter());
            Vec3::new(off(vector.x), off(vector.y), off(vector.z))
        };
        (self.position, self.velocity) = (off(self.position), off(self.velocity));
    }

    fn state(&self) -> State {
        State { position: self.position.to_f64(), velocity: self.velocity.to_f64() }
    }
}

/// Slots of an emitter, and the number of balls that were due so far.
struct Ring<'a> {
    source: &'a Source,
    slots: Vec<usize>,
    due: u64,
}

impl Ring<'_> {
    fn is_due(&self, time: f64) -> bool {
        let is_left = self.source.count.is_none_or(|count| self.due < count);
        is_left && self.due as f64 * self.source.period <= time
    }

    fn is_full(&self) -> bool {
        self.source.max.is_some_and(|max| self.slots.len() >= max)
    }
}

/// State of a running program.
struct Run<'a, N> {
    mistakes: Mistakes,
    forces: &'a [Acting],
    combine_rule: CombineRule,
    surfaces: Vec<(Surface<N>, f64)>,
    tangential: f64,
    rings: Vec<Ring<'a>>,
    /// Ball of each slot.
    balls: Vec<Ball<N>>,
    tracks: Tracks,
    /// Number of states in the tracks.
    states: usize,
    /// Returns the relative error of a number, a new one at each call.
    jitter: Option<&'a mut dyn FnMut() -> f64>,
}

impl<'a, N: Real> Run<'a, N> {
    fn new(course: &'a Course, mistakes: Mistakes) -> Self {
        let is_in_degrees = mistakes.has(Mistake::DegreesForRadians);
        let form = |it: &Fixed| if is_in_degrees { it.in_degrees } else { it.form };
        let surface = |it: &Fixed| (Surface::of(&form(it), mistakes), it.restitution);
        let ring = |source| Ring { source, slots: Vec::new(), due: 0 };
        let mut run = Self {
            mistakes,
            forces: &course.forces,
            combine_rule: course.combine_rule,
            surfaces: course.colliders.iter().map(surface).collect(),
            tangential: course.tangential,
            rings: course.emitters.iter().map(ring).collect(),
            balls: Vec::new(),
            tracks: Tracks { times: vec![0.0], ..Tracks::default() },
            states: 0,
            jitter: None,
        };
        for kind in &course.balls {
            run.put(None, kind);
        }
        run
    }

    fn take(&mut self, frames: &[Frame]) {
        for frame in frames {
            self.frame(*frame);
            if self.states > MOST_STATES {
                break;
            }
        }
    }

    fn frame(&mut self, frame: Frame) {
        self.emit(frame.start + DUE_TOLERANCE * frame.h);
        let number = self.tracks.times.len();
        self.tracks.times.push(frame.end);
        let h = N::of(frame.h);
        for slot in 0..self.balls.len() {
            let mut ball = self.balls[slot];
            if self.mistakes.has(Mistake::CollisionsBefore) {
                self.collide(&mut ball, number);
                self.advance(&mut ball, h);
            } else {
                self.advance(&mut ball, h);
                self.collide(&mut ball, number);
            }
            if let Some(jitter) = &mut self.jitter {
                ball.jitter(jitter);
            }
            self.tracks.balls[ball.number].states.push(ball.state());
            self.balls[slot] = ball;
        }
        self.states += self.balls.len();
    }

    /// Emits the balls that are due at a time \[s\].
    fn emit(&mut self, time: f64) {
        for index in 0..self.rings.len() {
            while self.rings[index].is_due(time) && self.states <= MOST_STATES {
                self.emit_from(index);
                self.states += 1;
            }
        }
    }

    fn emit_from(&mut self, index: usize) {
        let ring = &mut self.rings[index];
        let turn = ring.due;
        ring.due += 1;
        let kind = &ring.source.ball;
        if !ring.is_full() {
            let slot = self.put(None, kind);
            self.rings[index].slots.push(slot);
            return;
        }
        if self.mistakes.has(Mistake::RingStops) {
            return;
        }
        let oldest = (turn % ring.slots.len() as u64) as usize;
        let is_newest = self.mistakes.has(Mistake::RingNewest);
        let place = if is_newest { ring.slots.len() - 1 } else { oldest };
        let slot = ring.slots[place];
        let velocity = self.balls[slot].velocity;
        self.put(Some(slot), kind);
        if self.mistakes.has(Mistake::RingKeepsVelocity) {
            self.balls[slot].velocity = velocity;
        }
    }

    /// Puts a ball into a slot, or into a new one; returns the slot.
    fn put(&mut self, slot: Option<usize>, kind: &Kind) -> usize {
        let ball = Ball::new(self.tracks.balls.len(), kind);
        let slot = slot.unwrap_or(self.balls.len());
        if slot == self.balls.len() {
            self.balls.push(ball);
            self.tracks.slots.push(Vec::new());
        }
        self.balls[slot] = ball;
        self.tracks.slots[slot].push(ball.number);
        let birth = self.tracks.times.len() - 1;
        self.tracks.balls.push(Track { birth, states: vec![ball.state()] });
        slot
    }

    /// Moves a ball by `h` \[s\]: `v' = v + h F/m`, `x' = x + h v'`.
    fn advance(&self, ball: &mut Ball<N>, h: N) {
        let force = self.force(ball);
        let is_heavy = !self.mistakes.has(Mistake::MassIgnored);
        let acceleration = if is_heavy { force / ball.mass } else { force };
        let old = ball.velocity;
        ball.velocity = old + acceleration * h;
        let moved_with = if self.mistakes.has(Mistake::ExplicitEuler) {
            old
        } else if self.mistakes.has(Mistake::OldVelocity) {
            ball.saved
        } else if self.mistakes.has(Mistake::MeanVelocity) {
            (old + ball.velocity) * N::of(0.5)
        } else {
            ball.velocity
        };
        ball.position += moved_with * h;
        (ball.before, ball.saved) = (old, ball.velocity);
    }

    /// The force on a ball \[N\].
    fn force(&self, ball: &mut Ball<N>) -> Vec3<N> {
        let keeps = self.mistakes.has(Mistake::ForcesNotCleared);
        let before = if keeps { ball.force } else { Vec3::zero() };
        ball.force = self.forces.iter().fold(before, |sum, force| match *force {
            Acting::Constant(force) => sum + Vec3::of(force),
            Acting::Gravity(acceleration) => sum + Vec3::of(acceleration) * ball.mass,
            Acting::Drag(coefficient) => sum + self.drag(ball, coefficient),
        });
        ball.force
    }

    /// Viscous drag on a ball \[N\]: `-k v`.
    fn drag(&self, ball: &Ball<N>, coefficient: f64) -> Vec3<N> {
        let coefficient = N::of(coefficient);
        if self.mistakes.has(Mistake::NoDrag) {
            Vec3::zero()
        } else if self.mistakes.has(Mistake::DragSign) {
            ball.velocity * coefficient
        } else if self.mistakes.has(Mistake::DragNotUpdated) {
            ball.emitted * -coefficient
        } else if self.mistakes.has(Mistake::DragLate) {
            ball.before * -coefficient
        } else if self.mistakes.has(Mistake::DragQuadratic) {
            ball.velocity * (-coefficient * ball.velocity.length())
        } else {
            ball.velocity * -coefficient
        }
    }

    /// Answers the colliders that a ball touches, in order. Each one acts on the result of those
    /// before it.
    fn collide(&mut self, ball: &mut Ball<N>, frame: usize) {
        let radius = if self.mistakes.has(Mistake::RadiusIgnored) {
            N::of(0.0)
        } else if self.mistakes.has(Mistake::DiameterForRadius) {
            ball.radius * N::of(2.0)
        } else {
            ball.radius
        };
        for (index, (surface, restitution)) in self.surfaces.iter().enumerate() {
            let Some(contact) = surface.contact(ball.position, radius, self.mistakes) else {
                continue;
            };
            let e = N::of(self.combine_rule.combine(*restitution, ball.restitution));
            let Some(velocity) = surface.response(&contact, ball.velocity, e, self.mistakes) else {
                continue;
            };
            let velocity = match self.tangential {
                1.0 => velocity,
                left => slowed(velocity, contact.normal, N::of(left)),
            };
            ball.velocity = velocity;
            ball.position = contact.place.unwrap_or(ball.position);
            let (kind, surface) = (contact.kind, index);
            self.tracks.touches.push(Touch { frame, ball: ball.number, kind, surface });
            if self.mistakes.has(Mistake::FirstColliderOnly) {
                break;
            }
        }
    }
}

/// Multiplies the part of a velocity that is at right angles to a unit vector by a factor.
fn slowed<N: Real>(velocity: Vec3<N>, normal: Vec3<N>, left: N) -> Vec3<N> {
    let along = normal * velocity.dot(normal);
    along + (velocity - along) * left
}
