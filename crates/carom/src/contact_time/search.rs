//! The search for a contact where there is no closed form: conservative advancement.

use crate::norm::Norm;
use glam::DVec3;

use super::bisection::{Probe, bisect};
use super::obstacle::{Barrier, LocalDistance, Obstacle};
use super::path::{Path, State};
use super::roundoff::{ACCELERATION_ROUNDOFF, Gap, Magnitudes, Phase, Zero};
use crate::detect::passage;

/// Steps close to the obstacle that aim exactly at it. Transversal contacts take a handful,
/// passes at the distance of a rounding error some fifty.
const EXACT_STEPS: u32 = 128;

/// Exact steps within an overlap, where the bound can be weak: a path along the surface turns its
/// normal, and a step gains only a part of what is left.
const EXACT_STEPS_INSIDE: u32 = 4096;

/// Number of further steps close to the obstacle after which the search halves its accuracy.
const STEPS_OF_A_DEPTH: u32 = 16;

/// Largest number of steps of a search. Flights take a handful, seldom hundreds, and turning surfaces some tens per
/// turn. The bound is for numbers whose squares overflow, and for a horizon of more turns than a user waits for.
const MAX_STEPS: u32 = 1 << 20;

/// Doublings of a rounding error that make it larger than anything it is the rounding of.
const MOST_DOUBLINGS: u32 = 64;

/// Distance that counts as close, as a part of the size of the coordinates: √ε. Up to there a distance has lost
/// half its digits.
pub(super) const CLOSE: f64 = 1.5e-8;

/// Halvings that use up the 53 bits of a time and the 11 of its exponent many times over.
const MAX_HALVINGS: u32 = 128;

/// Time \[s\] of the first contact in `[0, horizon]`.
///
/// With n the normal at a time t0, convexity of the obstacle puts it behind its tangent plane,
/// so that `d(t) >= d + n·(x(t) - x)`, and with A an upper bound of the acceleration along -n,
///
/// ```text
/// d(t0 + τ) >= d + d' τ - A τ²/2
/// ```
///
/// Before this bound reaches zero there is no contact, so the search steps there and starts again
/// (Mirtich, *Impulse-based Dynamic Simulation* (1996), 2.3, with a bound of second order). It
/// converges quadratically to contacts with d' < 0, and by halves to grazing ones. Where the
/// bodies part, the step ends where the bound returns to zero or, of an overlap, where d' may.
/// Derived in `docs/physics/contact-times.md`, "The search".
///
/// A step is at least as long as the bound takes to fall by the distance from the obstacle: far
/// away that is at least `√(2 CLOSE L/A)`, L the size of the coordinates. Steps that stay close
/// to the obstacle for long (a path along its curvature) aim a rounding error below its surface,
/// then twice as far with each [`STEPS_OF_A_DEPTH`], so that they come to an end; where they
/// land in an overlap, the contact is found by halving. Only then can a contact go unnoticed
/// that is deeper than rounding, and no deeper than `CLOSE L`.
///
/// An obstacle that is open from behind is not met by a centre that overlaps it from there, or does so at time 0,
/// until they are apart. The distance grows by the way of the centre at most, which bounds that time from below.
///
/// - `size` of the numbers that the path and the obstacle are given by
pub(super) fn first_contact(
    path: &impl Path,
    obstacle: &Obstacle,
    size: Magnitudes,
    horizon: f64,
) -> Option<f64> {
    let start = SearchState::at(path, obstacle, size, 0.0);
    let passes = obstacle.is_open() && start.is_within(obstacle);
    search(path, (obstacle, passes), size, horizon)
}

/// Time \[s\] of the first contact in `[0, horizon]` after the overlap in which the path begins has ended.
pub(super) fn first_contact_after_overlap(
    path: &impl Path,
    obstacle: &Obstacle,
    size: Magnitudes,
    horizon: f64,
) -> Option<f64> {
    search(path, (obstacle, true), size, horizon)
}

/// The search, for a centre that passes the obstacle at time 0 or does not.
fn search(
    path: &impl Path,
    (obstacle, mut passes): (&Obstacle, bool),
    size: Magnitudes,
    horizon: f64,
) -> Option<f64> {
    let state_at = |t: f64| SearchState::at(path, obstacle, size, t);
    let (mut before, mut t) = (0.0, 0.0);
    let mut window = path.window();
    let (mut close_steps, mut was_overlap) = (0, false);
    for _ in 0..MAX_STEPS {
        let now = state_at(t).passing(obstacle, passes);
        passes = now.passes;
        if !now.is_finite() {
            return None;
        }
        if now.phase == Phase::Contact {
            let pinned = if t == 0.0 { 0.0 } else { pin_down(&now, state_at, before, t) };
            return Some(pinned.min(horizon));
        }
        let goes_on = now.is_close() && now.is_overlap() == was_overlap;
        close_steps = if goes_on { close_steps + 1 } else { 0 };
        was_overlap = now.is_overlap();
        let aim = now.aim(close_steps);
        let step = longest_step(path, &now, aim, t, &mut window, horizon);
        let next = (t + step).max(t.next_up());
        if next <= horizon && next.is_finite() {
            (before, t) = (t, next);
        } else {
            return None;
        }
    }
    None
}

/// The time of a contact that is present at `t`, but not at `before`, to full precision.
fn pin_down(now: &SearchState, state_at: impl Fn(f64) -> SearchState, before: f64, t: f64) -> f64 {
    let mut earliest = t;
    if now.is_overlap() {
        let length = t - before;
        bisect(length, MAX_HALVINGS, |elapsed| {
            if state_at(before + elapsed).phase == Phase::Contact {
                earliest = before + elapsed;
                Probe::After
            } else {
                Probe::Before
            }
        });
        return earliest;
    }
    // What is left is below rounding, but one step more makes the most of the digits.
    let Gap { distance, speed, acceleration } = now.gap;
    let step = if distance > 0.0 {
        time_to_fall(distance, speed, -acceleration)
    } else {
        -distance / speed
    };
    let polished = (t + step).max(before);
    if polished.is_finite() {
        let there = state_at(polished);
        let is_better = there.gap.distance.abs() < distance.abs();
        if is_better && there.phase == Phase::Contact {
            return polished;
        }
    }
    t
}

/// The longest step \[s\] known to be safe. `window` is how far ahead the acceleration is bounded;
/// it follows the steps.
fn longest_step(
    path: &impl Path,
    now: &SearchState,
    aim: f64,
    t: f64,
    window: &mut f64,
    horizon: f64,
) -> f64 {
    let far = now.time_to_hull(path, aim, t, horizon - t);
    if far > horizon - t {
        return far;
    }
    let ahead = window.min(now.window(path, aim, t, horizon)).min(horizon - t);
    let step = now.safe_step(path, aim, t, ahead);
    if step >= ahead {
        *window *= 2.0;
        // Past the horizon, or on to the next window.
        return if t + ahead >= horizon { step } else { ahead.max(far) };
    }
    // The bound is closer over a nearer window, and allows a longer step.
    let mut nearer = 4.0 * step;
    *window = nearer.max(path.window());
    let mut longest = step;
    while 0.0 < nearer && nearer < ahead {
        let step = now.safe_step(path, aim, t, nearer);
        longest = step.min(nearer).max(longest);
        if step < nearer {
            break;
        }
        nearer *= 4.0;
    }
    longest.max(far)
}

/// Gap and sizes at one instant of the search.
struct SearchState {
    state: State,
    local: LocalDistance,
    gap: Gap,
    zero: Zero,
    phase: Phase,
    /// Whether the centre came from behind, and is there or still overlaps the obstacle.
    passes: bool,
    /// Sizes of the numbers involved up to now.
    size: Magnitudes,
    /// Speed at which the radius grows \[m/s\].
    growth_speed: f64,
}

impl SearchState {
    fn at(path: &impl Path, obstacle: &Obstacle, size: Magnitudes, t: f64) -> Self {
        let state = path.state_at(t);
        let size = size + state.size;
        let growth_speed = path.growth_speed();
        let local = if growth_speed > 0.0 {
            obstacle.widened(growth_speed * t).local_distance(state.position, state.velocity)
        } else {
            obstacle.local_distance(state.position, state.velocity)
        };
        let gap = Gap {
            distance: local.distance,
            speed: local.normal.dot(state.velocity) - growth_speed,
            acceleration: local.normal.dot(state.acceleration) + local.turning,
        };
        let zero = if local.is_round {
            Zero::round(&size, local.from_core, state.velocity.norm(), local.turning)
        } else {
            Zero::flat(&size)
        };
        let phase = if local.is_behind { Phase::Apart } else { gap.phase(&zero) };
        Self { state, local, gap, zero, phase, passes: false, size, growth_speed }
    }

    /// Whether a centre overlaps an open obstacle as only one from behind does.
    fn is_within(&self, obstacle: &Obstacle) -> bool {
        passage::is_deep(self.gap.distance, obstacle.radius())
    }

    /// The state of a centre that passed an obstacle from behind before, or did not.
    fn passing(self, obstacle: &Obstacle, passed: bool) -> Self {
        let is_behind = obstacle.is_open() && self.local.is_behind;
        let passes = is_behind || (passed && self.is_overlap());
        let phase = if passes { Phase::Apart } else { self.phase };
        Self { passes, phase, ..self }
    }

    fn is_close(&self) -> bool {
        self.gap.distance <= CLOSE * self.size.length
    }

    fn is_finite(&self) -> bool {
        self.size.length.is_finite() && self.gap.speed.is_finite() && !self.gap.distance.is_nan()
    }

    /// Deeper than rounding.
    fn is_overlap(&self) -> bool {
        self.gap.distance < -self.zero.distance
    }

    /// Depth \[m\] below the surface at which a step aims, after this many steps close to it.
    fn aim(&self, close_steps: u32) -> f64 {
        let exact_steps = if self.is_overlap() { EXACT_STEPS_INSIDE } else { EXACT_STEPS };
        if close_steps <= exact_steps {
            return 0.0;
        }
        let doublings = (close_steps - exact_steps) / STEPS_OF_A_DEPTH;
        let depth =
            (0..doublings.min(MOST_DOUBLINGS)).fold(self.zero.distance, |depth, _| 2.0 * depth);
        // A path that turns within an overlap closes at the next step, which finds the contact.
        if self.is_overlap() { depth } else { depth.min(CLOSE * self.size.length) }
    }

    /// A step \[s\] before which no contact begins within the window; it may be longer than that,
    /// and infinite.
    fn safe_step(&self, path: &impl Path, aim: f64, t: f64, window: f64) -> f64 {
        if self.passes && !self.local.is_behind {
            return self.time_within(path, aim, t, window);
        }
        let falls = self.falls_by_curvature(path, t, window);
        let bound = |normal: DVec3| self.pull(path, normal, t, window) + falls;
        let slide = self.shortest_way_time(path, aim, t, window);
        if falls == f64::INFINITY {
            return slide;
        }
        let barrier = self.local.barrier.map_or(0.0, |Barrier { distance, normal }| {
            let aim = if distance > self.zero.distance { aim } else { self.zero.distance.max(aim) };
            // From behind, it is the centre that has to pass the plane.
            let growth_speed = if self.local.is_behind { 0.0 } else { self.growth_speed };
            let speed = normal.dot(self.state.velocity) - growth_speed;
            time_to_fall(distance + aim, speed, bound(normal))
        });
        let Gap { distance, speed, .. } = self.gap;
        if distance > self.zero.distance {
            let falling = time_to_fall(distance + aim, speed, bound(self.local.normal));
            return barrier.max(falling).max(slide);
        }
        if self.local.is_behind {
            return barrier;
        }
        let is_at_rest = self.gap.is_at_rest(&self.zero);
        let (speed, aim) =
            if is_at_rest { (0.0, aim.max(self.zero.distance)) } else { (speed, aim) };
        let parting = if distance >= -self.zero.distance {
            time_to_fall(aim, speed, bound(self.local.normal))
        } else {
            // d' falls by A t at most, so an overlap opens until d' may be used up.
            let pull = self.opening_pull(path, t, window);
            if pull > 0.0 { speed / pull + (2.0 * aim / pull).sqrt() } else { f64::INFINITY }
        };
        barrier.max(parting)
    }

    /// An upper bound of the acceleration \[m/s²\] with which the distance from a core that is not convex falls, by the
    /// curvature of the core, on a straight way.
    fn falls_by_curvature(&self, path: &impl Path, t: f64, window: f64) -> f64 {
        let Some(concavity) = self.local.concavity else { return 0.0 };
        let (way, speed) = self.most_moved(path, t, window);
        let curvature = concavity.most(way);
        if curvature == 0.0 { 0.0 } else { curvature * speed * speed }
    }

    /// Upper bounds of the way \[m\] and of the speed \[m/s\] within the window.
    fn most_moved(&self, path: &impl Path, t: f64, window: f64) -> (f64, f64) {
        let anywhere = path.max_acceleration_anywhere(t, t + window);
        let gained = if anywhere > 0.0 { anywhere * window } else { 0.0 };
        let speed = self.state.velocity.norm() + gained;
        (if speed > 0.0 { speed * window } else { 0.0 }, speed)
    }

    /// A step \[s\] in which the sphere does not go as far as the distance from a core that is not convex.
    fn shortest_way_time(&self, path: &impl Path, aim: f64, t: f64, window: f64) -> f64 {
        if self.local.concavity.is_none() {
            return 0.0;
        }
        let (_, speed) = self.most_moved(path, t, window);
        let distance = self.gap.distance.max(0.0) + aim;
        let speed = speed + self.growth_speed;
        if speed > 0.0 { distance / speed } else { f64::INFINITY }
    }

    /// A step \[s\] within which the centre does not go as far as to end an overlap.
    fn time_within(&self, path: &impl Path, aim: f64, t: f64, window: f64) -> f64 {
        let way = aim - self.gap.distance;
        let pull = path.max_acceleration_anywhere(t, t + window).max(0.0);
        let speed = self.state.velocity.norm();
        // The way is v τ + a τ²/2 at most.
        2.0 * way / (speed + (speed * speed + 2.0 * pull * way).sqrt())
    }

    /// A step \[s\] within which the sphere cannot reach the half-space that contains every place of contact.
    fn time_to_hull(&self, path: &impl Path, aim: f64, t: f64, window: f64) -> f64 {
        self.local.hull.map_or(0.0, |Barrier { distance, normal }| {
            let pull = self.pull(path, normal, t, window);
            let speed = normal.dot(self.state.velocity) - self.growth_speed;
            time_to_fall(distance + aim, speed, pull)
        })
    }

    /// Length of the next window \[s\]: over a core that is not convex, bounds of the curvature hold for a part of
    /// its radius.
    fn window(&self, path: &impl Path, aim: f64, t: f64, horizon: f64) -> f64 {
        let concavity = self.local.concavity.filter(|it| !it.is_none());
        let Some(concavity) = concavity else { return f64::INFINITY };
        let span = concavity.span.max(self.gap.distance).max(self.zero.distance + aim);
        let speed = self.state.velocity.norm();
        let pull = path.max_acceleration_anywhere(t, horizon.min(t + path.window()));
        // v τ + a τ² = span
        let root = (speed * speed + 4.0 * pull * span).sqrt();
        if root > 0.0 { 2.0 * span / (speed + root) } else { f64::INFINITY }
    }

    /// An upper bound of the acceleration against a fixed normal.
    fn pull(&self, path: &impl Path, normal: DVec3, t: f64, window: f64) -> f64 {
        let pull = path.max_acceleration(-normal, t, t + window);
        // Within the window, the rounding of the acceleration moves nothing by more than the
        // rounding of positions.
        let zero = ACCELERATION_ROUNDOFF * self.size.acceleration;
        if pull.abs() <= zero { 0.0 } else { pull }
    }

    /// An upper bound of the acceleration against the normal as it changes on the way, which
    /// bounds -d''. At a distance of ρ or more from a convex core, the normal turns by at most
    /// 1/ρ for each metre.
    fn opening_pull(&self, path: &impl Path, t: f64, window: f64) -> f64 {
        let anywhere = path.max_acceleration_anywhere(t, t + window);
        if self.local.concavity.is_some() {
            return anywhere + self.falls_by_curvature(path, t, window);
        }
        let way = window * (self.state.velocity.norm() + 0.5 * anywhere * window);
        let is_flat = self.local.flat_within == f64::INFINITY || way <= self.local.flat_within;
        let turn = if is_flat { 0.0 } else { way / (self.local.from_core - way) };
        if (0.0..1.0).contains(&turn) {
            self.pull(path, self.local.normal, t, window) + turn * anywhere
        } else {
            anywhere
        }
    }
}

/// First time \[s\] at which `h + v t - a t²/2` falls to zero; infinite if it never does.
///
/// - height h \[m\], >= 0; speed v \[m/s\]; pull a \[m/s²\], all of any other sign
pub(super) fn time_to_fall(height: f64, speed: f64, pull: f64) -> f64 {
    let discriminant = speed * speed + 2.0 * pull * height;
    if speed < 0.0 {
        if discriminant < 0.0 {
            return f64::INFINITY;
        }
        2.0 * height / (discriminant.sqrt() - speed)
    } else if pull > 0.0 {
        (speed + discriminant.sqrt()) / pull
    } else {
        f64::INFINITY
    }
}
