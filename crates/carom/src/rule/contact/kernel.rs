//! The stages of a sub-step for contacts of pairs of spheres: a batch at a time, one contact in each lane
//! of the processor's vectors.
//!
//! Every operation is the one that a single contact needs, so no bit depends on the vectors.

use fearless_simd::{Level, Simd, SimdMask, dispatch, mask64x4};

use super::batch::{ApproachBatch, Batches, FrictionBatch, Hit, PairBatch, Quad, RollingBatch};
use super::found::Found;
use super::row::Row;
use super::slots::Run;
use super::sub_step::{GROWTH, RELAXATION, SLOP, SubStep};
use super::swept;
use crate::lanes::{LANES, Lanes};
use crate::real::{Real, Vector};

/// Smaller than what it is compared with, unless that is zero.
const TINY: f64 = f64::MIN_POSITIVE;

/// Prepares the contacts of a run: normals, gaps, what velocities must come to, and the impulses to
/// start from, which it applies.
pub(super) fn prepare(run: &mut Run, batches: &mut Batches, sub_step: &SubStep) {
    let level = Level::new();
    if batches.frictions.is_empty() {
        dispatch!(level, simd => prepare_all::<_, false>(simd, run, batches, sub_step));
    } else {
        dispatch!(level, simd => prepare_all::<_, true>(simd, run, batches, sub_step));
    }
}

/// Sweeps over the contacts of a run, forwards or backwards: each gets the impulse that it needs with
/// the others as they are. Finds the largest change of an impulse, and the largest impulse.
pub(super) fn sweep(run: &mut Run, batches: &mut Batches, backwards: bool) -> Found {
    let level = Level::new();
    macro_rules! sweep {
        ($friction:literal, $rolling:literal) => {
            dispatch!(level, simd => sweep_all::<_, $friction, $rolling>(
                simd, run, batches, backwards
            ))
        };
    }
    match (!batches.frictions.is_empty(), !batches.rollings.is_empty()) {
        (false, _) => sweep!(false, false),
        (true, false) => sweep!(true, false),
        (true, true) => sweep!(true, true),
    }
}

/// Moves spheres that overlap apart; velocities stay as they are. Gives the largest overlap, as a part of
/// the sum of radii.
pub(super) fn correct(run: &mut Run, batches: &Batches) -> f64 {
    dispatch!(Level::new(), simd => correct_all(simd, run, batches))
}

#[inline(always)]
fn prepare_all<S: Simd, const FRICTION: bool>(
    simd: S,
    run: &mut Run,
    batches: &mut Batches,
    sub_step: &SubStep,
) {
    let Batches { pairs, approaches, restitutions, hits, frictions, rollings, .. } = batches;
    hits.clear();
    for (number, (batch, approach)) in pairs.iter_mut().zip(approaches).enumerate() {
        let aimed = aim(simd, run, (batch, approach), sub_step);
        let mut speed = [0.0; LANES];
        if aimed.is_any() {
            let traits = (&*approach, &restitutions[number]);
            speed = aimed.meet(simd, run, batch, traits, sub_step);
            if speed != [0.0; LANES] {
                hits.push(Hit { batch: number as u32, speed });
            }
        }
        if FRICTION {
            let friction = &mut frictions[number];
            friction.aim(simd, run, batch, speed);
            start_friction(simd, run, batch, friction, rollings.get_mut(number));
        } else {
            let impulse = Lanes::each(simd, batch.impulse);
            if is_any(simd, impulse) {
                apply(simd, run.velocity, batch, vector(simd, &batch.normal) * impulse);
            }
        }
    }
}

/// How the pairs of a batch come near each other in a sub-step.
struct Aimed<S: Simd> {
    /// Speeds of approach of impacts \[m/s\]; 0 elsewhere.
    impact: Lanes<S>,
    /// Where the spheres go so far that they may meet on their way.
    goes_far: mask64x4<S>,
    /// Where there is an impact.
    is_hit: mask64x4<S>,
    /// Where neither sphere bears anything.
    is_free: mask64x4<S>,
}

/// Normals and gaps of now; the velocities that contacts are to have after the sub-step if none bounces;
/// the impulses to start from.
#[inline(always)]
fn aim<S: Simd>(
    simd: S,
    run: &Run,
    (batch, approach): (&mut PairBatch, &mut ApproachBatch),
    sub_step: &SubStep,
) -> Aimed<S> {
    let all = |number| Lanes::all(simd, number);
    let zero = all(0.0);
    let offset = xyz(difference(simd, run.position, batch));
    let length = offset.length_squared().sqrt();
    let is_lost = length.is_less(all(TINY));
    let inverse = all(1.0) / length.max(all(TINY));
    let mut normal = offset * inverse;
    // Any direction would do for centres that coincide, but it must be the same always.
    normal.y = all(1.0).select(is_lost, normal.y);
    let radius_sum = Lanes::each(simd, approach.radius_sum);
    let gap = length - radius_sum;

    let [vx, vy, vz, bear] = difference(simd, run.before, batch);
    let velocity = Vector { x: vx, y: vy, z: vz };
    let speed = velocity.dot(normal);

    let carried = Lanes::each(simd, batch.impulse);
    let before = Lanes::each(simd, approach.previous);
    // What stopped an impact is no longer needed, once the two part.
    let has_bounced = Lanes::each(simd, batch.bias).is_less(zero) & zero.is_at_most(speed);
    let carried = smaller(carried, before).select(has_bounced, carried);
    let effective_mass = Lanes::each(simd, batch.effective_mass);
    let most = before * GROWTH + effective_mass * sub_step.growth;
    approach.previous = carried.to_array();
    batch.impulse = smaller(carried, most).to_array();
    batch.bias = (gap.max(zero) * (1.0 / sub_step.h)).to_array();
    batch.normal = arrays(normal);

    let rests = zero.is_less(carried);
    let is_free = bear.is_equal(zero);
    let least = all(sub_step.impact_speed);
    let shaken = shaken_speed(simd, run, (batch, normal), sub_step);
    let threshold = all(sub_step.resting_speed).select(rests, least);
    let threshold = threshold.select(is_free, threshold.max(shaken));
    let closing = zero - speed;
    let meets = gap.is_less(closing * sub_step.h) & threshold.is_less(closing);
    let way = velocity.length_squared() * (sub_step.h * sub_step.h);
    let reach = radius_sum * swept::FAR;
    Aimed {
        impact: closing.select(meets, zero),
        goes_far: (reach * reach).is_less(way),
        is_hit: meets,
        is_free,
    }
}

impl<S: Simd> Aimed<S> {
    /// Whether there is an impact, or may be one.
    #[inline(always)]
    fn is_any(&self) -> bool {
        (self.is_hit | self.goes_far).any_true()
    }

    /// The velocities that impacts are to end with. Gives speeds of approach \[m/s\], 0 where there is no
    /// impact.
    #[inline(always)]
    fn meet(
        self,
        simd: S,
        run: &Run,
        batch: &mut PairBatch,
        (approach, restitution): (&ApproachBatch, &Quad),
        sub_step: &SubStep,
    ) -> Quad {
        let zero = Lanes::all(simd, 0.0);
        let rebound = zero - Lanes::each(simd, *restitution) * self.impact;
        // What bears something already does not bounce: it would lose the impulse to start from.
        let is_new = Lanes::each(simd, approach.previous).is_equal(zero);
        let bounces = is_new & rebound.is_less(zero);
        let bias = rebound.select(bounces, Lanes::each(simd, batch.bias));
        batch.bias = bias.to_array();
        let mut speed = self.impact.to_array();
        let is_swept = (self.goes_far | bounces) & (self.is_free | self.is_hit);
        let is_swept = Lanes::all(simd, 1.0).select(is_swept, zero).to_array();
        for lane in (0..LANES).filter(|&lane| is_swept[lane] > 0.0) {
            let traits = [approach.radius_sum[lane], restitution[lane]];
            if let Some(found) = swept::aim_pair(run, batch, (lane, traits), sub_step) {
                speed[lane] = found;
            }
        }
        speed
    }
}

/// Speeds of approach below which the spheres of a batch that bear something do not bounce \[m/s\].
#[inline(always)]
fn shaken_speed<S: Simd>(
    simd: S,
    run: &Run,
    (batch, normal): (&PairBatch, Vector<Lanes<S>>),
    sub_step: &SubStep,
) -> Lanes<S> {
    let along = if let Some(acceleration) = sub_step.common_acceleration {
        Vector::all(simd, acceleration).dot(normal).abs()
    } else {
        let first = xyz(Lanes::transposed(gathered(simd, run.acceleration, &batch.first)));
        let second = xyz(Lanes::transposed(gathered(simd, run.acceleration, &batch.second)));
        first.dot(normal).abs().max(second.dot(normal).abs())
    };
    let [by_weight, least] = sub_step.shaken();
    along * by_weight + Lanes::all(simd, least)
}

impl FrictionBatch {
    /// The slip that impacts are to end with.
    #[inline(always)]
    fn aim<S: Simd>(&mut self, simd: S, run: &Run, batch: &PairBatch, speed: Quad) {
        let restitution = Lanes::each(simd, self.tangential_restitution);
        let impact = Lanes::each(simd, speed);
        if !is_any(simd, impact * restitution) {
            self.slip = [[0.0; LANES]; 3];
            return;
        }
        let normal = vector(simd, &batch.normal);
        let velocity = xyz(difference(simd, run.before, batch));
        let slip = slip(velocity, normal, xyz(sum(simd, run.spin_before, batch)));
        let is_impact = Lanes::all(simd, 0.0).is_less(impact);
        let part = (Lanes::all(simd, 0.0) - restitution).select(is_impact, Lanes::all(simd, 0.0));
        self.slip = arrays(slip * part);
    }
}

/// Applies the impulses to start from, normal and tangential.
#[inline(always)]
fn start_friction<S: Simd>(
    simd: S,
    run: &mut Run,
    batch: &PairBatch,
    friction: &mut FrictionBatch,
    rolling: Option<&mut RollingBatch>,
) {
    let zero = Lanes::all(simd, 0.0);
    let impulse = Lanes::each(simd, batch.impulse);
    let bears = zero.is_less(impulse);
    let normal = vector(simd, &batch.normal);
    // What the normal turned away from goes; nothing is left where the contact bears nothing.
    let kept = vector(simd, &friction.tangential);
    let along = kept - normal * kept.dot(normal);
    let tangential = Vector {
        x: along.x.select(bears, zero),
        y: along.y.select(bears, zero),
        z: along.z.select(bears, zero),
    };
    friction.tangential = arrays(tangential);
    if let Some(rolling) = rolling {
        let kept = vector(simd, &rolling.angular);
        let angular = Vector {
            x: kept.x.select(bears, zero),
            y: kept.y.select(bears, zero),
            z: kept.z.select(bears, zero),
        };
        rolling.angular = arrays(angular);
        turn(simd, run.spin, batch, rolling, angular);
    }
    if bears.any_true() {
        apply(simd, run.velocity, batch, normal * impulse + tangential);
        apply_spin(simd, run.spin, batch, normal.cross(tangential));
    }
}

#[inline(always)]
fn sweep_all<S: Simd, const FRICTION: bool, const ROLLING: bool>(
    simd: S,
    run: &mut Run,
    batches: &mut Batches,
    backwards: bool,
) -> Found {
    let Batches { pairs, frictions, rollings, .. } = batches;
    let [mut largest_change, mut largest_impulse, mut least_room] = [Lanes::all(simd, 0.0); 3];
    let count = pairs.len();
    for step in 0..count {
        let number = if backwards { count - 1 - step } else { step };
        let batch = &mut pairs[number];
        let Solved { change, room } = if FRICTION {
            let rolling = if ROLLING { rollings.get_mut(number) } else { None };
            solve_with_friction(simd, run, batch, &mut frictions[number], rolling)
        } else {
            solve(simd, run, batch)
        };
        largest_change = largest_change.max(change.abs());
        largest_impulse = largest_impulse.max(Lanes::each(simd, batch.impulse));
        least_room = smaller(least_room, room);
    }
    let excess = (Lanes::all(simd, 0.0) - least_room).largest();
    let [change, impulse] = [largest_change, largest_impulse].map(Lanes::largest);
    Found { change, excess, impulse, ..Found::default() }
}

/// What solving a batch comes to.
struct Solved<S: Simd> {
    /// Changes of the normal impulses \[N s\].
    change: Lanes<S>,
    /// By how much normal velocities were above their bounds \[m/s\]; negative below.
    room: Lanes<S>,
}

/// Gives each contact of a batch its normal impulse.
#[inline(always)]
fn solve<S: Simd>(simd: S, run: &mut Run, batch: &mut PairBatch) -> Solved<S> {
    let zero = Lanes::all(simd, 0.0);
    let normal = vector(simd, &batch.normal);
    let speed = xyz(difference(simd, run.velocity, batch)).dot(normal);
    let impulse = Lanes::each(simd, batch.impulse);
    let room = speed + Lanes::each(simd, batch.bias);
    let solved = (impulse - Lanes::each(simd, batch.effective_mass) * room).max(zero);
    let change = solved - impulse;
    if is_any(simd, change) {
        batch.impulse = solved.to_array();
        apply(simd, run.velocity, batch, normal * change);
    }
    Solved { change, room }
}

/// Gives each contact of a batch its normal and then its tangential impulse, which lies on Coulomb's disc.
///
/// An impulse along the normal changes no slip, and one across it no normal speed: so both follow in
/// closed form.
#[inline(always)]
fn solve_with_friction<S: Simd>(
    simd: S,
    run: &mut Run,
    batch: &mut PairBatch,
    friction: &mut FrictionBatch,
    rolling: Option<&mut RollingBatch>,
) -> Solved<S> {
    let zero = Lanes::all(simd, 0.0);
    let normal = vector(simd, &batch.normal);
    let velocity = xyz(difference(simd, run.velocity, batch));
    let speed = velocity.dot(normal);
    let impulse = Lanes::each(simd, batch.impulse);
    let room = speed + Lanes::each(simd, batch.bias);
    let solved = (impulse - Lanes::each(simd, batch.effective_mass) * room).max(zero);
    let change = solved - impulse;
    if !is_any(simd, solved.max(impulse)) {
        return Solved { change, room };
    }
    batch.impulse = solved.to_array();

    let slip = slip(velocity, normal, xyz(sum(simd, run.spin, batch)));
    let tangential = vector(simd, &friction.tangential);
    let excess = slip - vector(simd, &friction.slip);
    let wanted = tangential - excess * Lanes::each(simd, friction.tangential_mass);
    let most = Lanes::each(simd, friction.sliding) * solved;
    let limited = limited(simd, wanted, most);
    friction.tangential = arrays(limited);
    let across = limited - tangential;
    apply(simd, run.velocity, batch, normal * change + across);
    apply_spin(simd, run.spin, batch, normal.cross(across));
    if let Some(rolling) = rolling {
        solve_rolling(simd, run, batch, rolling);
    }
    Solved { change, room }
}

/// Gives each contact of a batch its angular impulses against rolling and spinning.
#[inline(always)]
fn solve_rolling<S: Simd>(simd: S, run: &mut Run, batch: &PairBatch, rolling: &mut RollingBatch) {
    let normal = vector(simd, &batch.normal);
    let first = xyz(Lanes::transposed(gathered(simd, run.spin, &batch.first)));
    let second = xyz(Lanes::transposed(gathered(simd, run.spin, &batch.second)));
    let [curvature_1, curvature_2] = rolling.curvature;
    let relative = second * Lanes::each(simd, curvature_2) - first * Lanes::each(simd, curvature_1);
    let angular = vector(simd, &rolling.angular);
    let wanted = angular - relative * Lanes::each(simd, rolling.inertia);
    let spinning = wanted.dot(normal);
    let impulse = Lanes::each(simd, batch.impulse);
    let rolls = wanted - normal * spinning;
    let rolls = limited(simd, rolls, Lanes::each(simd, rolling.rolling) * impulse);
    let most = Lanes::each(simd, rolling.spinning) * impulse;
    let spins = limited(simd, normal * spinning, most);
    let solved = rolls + spins;
    rolling.angular = arrays(solved);
    turn(simd, run.spin, batch, rolling, solved - angular);
}

#[inline(always)]
fn correct_all<S: Simd>(simd: S, run: &mut Run, batches: &Batches) -> f64 {
    let zero = Lanes::all(simd, 0.0);
    let mut largest = zero;
    for (batch, approach) in batches.pairs.iter().zip(&batches.approaches) {
        let offset = xyz(difference(simd, run.position, batch));
        let length = offset.length_squared().sqrt();
        let radius_sum = Lanes::each(simd, approach.radius_sum);
        let overlap = radius_sum * (1.0 - SLOP) - length;
        // Centres that coincide are left to the velocities.
        let is_whole = Lanes::all(simd, TINY).is_less(length);
        let overlap = overlap.max(zero).select(is_whole, zero);
        if !is_any(simd, overlap) {
            continue;
        }
        // An overlap within the slop counts as none.
        largest = largest.max(overlap / radius_sum.max(Lanes::all(simd, TINY)));
        let effective_mass = Lanes::each(simd, batch.effective_mass);
        let push = overlap * effective_mass * RELAXATION / length.max(Lanes::all(simd, TINY));
        let rows = rows_of(simd, offset * push);
        for (lane, row) in rows.into_iter().enumerate() {
            let (first, second) = (batch.first[lane] as usize, batch.second[lane] as usize);
            let of_first = -run.velocity[first].number();
            shift(simd, &mut run.position[first], row * of_first);
            let of_second = run.velocity[second].number();
            shift(simd, &mut run.position[second], row * of_second);
        }
    }
    largest.largest()
}

/// Slip of the surfaces where they touch: what of the velocity is across the normal, with spin.
#[inline(always)]
fn slip<S: Simd>(
    velocity: Vector<Lanes<S>>,
    normal: Vector<Lanes<S>>,
    spin: Vector<Lanes<S>>,
) -> Vector<Lanes<S>> {
    velocity - normal * velocity.dot(normal) - spin.cross(normal)
}

/// Vectors, shortened to a length where they are longer.
#[inline(always)]
fn limited<S: Simd>(simd: S, vector: Vector<Lanes<S>>, most: Lanes<S>) -> Vector<Lanes<S>> {
    let length = vector.length_squared().sqrt().max(Lanes::all(simd, TINY));
    vector * (most / length).min(1.0)
}

/// Second minus first of each pair.
#[inline(always)]
fn difference<S: Simd>(simd: S, all: &[Row], batch: &PairBatch) -> [Lanes<S>; LANES] {
    let [first, second] = [gathered(simd, all, &batch.first), gathered(simd, all, &batch.second)];
    let ([a, b, c, d], [e, f, g, h]) = (first, second);
    Lanes::transposed([e - a, f - b, g - c, h - d])
}

/// First plus second of each pair.
#[inline(always)]
fn sum<S: Simd>(simd: S, all: &[Row], batch: &PairBatch) -> [Lanes<S>; LANES] {
    let [first, second] = [gathered(simd, all, &batch.first), gathered(simd, all, &batch.second)];
    let ([a, b, c, d], [e, f, g, h]) = (first, second);
    Lanes::transposed([e + a, f + b, g + c, h + d])
}

/// The rows of these slots. Written out, for closures are not compiled for the processor's vectors.
#[inline(always)]
fn gathered<S: Simd>(simd: S, all: &[Row], slots: &[u32; LANES]) -> [Lanes<S>; LANES] {
    let [a, b, c, d] = *slots;
    [
        Lanes::each(simd, all[a as usize].0),
        Lanes::each(simd, all[b as usize].0),
        Lanes::each(simd, all[c as usize].0),
        Lanes::each(simd, all[d as usize].0),
    ]
}

/// Gives spheres 2 impulses, and spheres 1 the opposite ones.
#[inline(always)]
fn apply<S: Simd>(simd: S, velocities: &mut [Row], batch: &PairBatch, impulse: Vector<Lanes<S>>) {
    let rows = rows_of(simd, impulse);
    for (lane, row) in rows.into_iter().enumerate() {
        let first = &mut velocities[batch.first[lane] as usize];
        shift(simd, first, row * -first.number());
        let second = &mut velocities[batch.second[lane] as usize];
        shift(simd, second, row * second.number());
    }
}

/// Turns both spheres of each pair by the impulses that act at their surfaces, of which this is the cross
/// product with the normal.
#[inline(always)]
fn apply_spin<S: Simd>(simd: S, spins: &mut [Row], batch: &PairBatch, turn: Vector<Lanes<S>>) {
    let rows = rows_of(simd, turn);
    for (lane, row) in rows.into_iter().enumerate() {
        for slot in [batch.first[lane], batch.second[lane]] {
            let spin = &mut spins[slot as usize];
            shift(simd, spin, row * -spin.number());
        }
    }
}

/// Gives spheres 2 angular impulses, and spheres 1 the opposite ones.
#[inline(always)]
fn turn<S: Simd>(
    simd: S,
    spins: &mut [Row],
    batch: &PairBatch,
    rolling: &RollingBatch,
    angular: Vector<Lanes<S>>,
) {
    let rows = rows_of(simd, angular);
    for (lane, row) in rows.into_iter().enumerate() {
        let first = &mut spins[batch.first[lane] as usize];
        shift(simd, first, row * -(first.number() * rolling.curvature[0][lane]));
        let second = &mut spins[batch.second[lane] as usize];
        shift(simd, second, row * (second.number() * rolling.curvature[1][lane]));
    }
}

#[inline(always)]
fn shift<S: Simd>(simd: S, row: &mut Row, by: Lanes<S>) {
    row.0 = (Lanes::each(simd, row.0) + by).to_array();
}

#[inline(always)]
fn rows_of<S: Simd>(simd: S, Vector { x, y, z }: Vector<Lanes<S>>) -> [Lanes<S>; LANES] {
    Lanes::transposed([x, y, z, Lanes::all(simd, 0.0)])
}

#[inline(always)]
fn xyz<S: Simd>([x, y, z, _]: [Lanes<S>; LANES]) -> Vector<Lanes<S>> {
    Vector { x, y, z }
}

#[inline(always)]
fn vector<S: Simd>(simd: S, quads: &[Quad; 3]) -> Vector<Lanes<S>> {
    let [x, y, z] = *quads;
    Vector { x: Lanes::each(simd, x), y: Lanes::each(simd, y), z: Lanes::each(simd, z) }
}

#[inline(always)]
fn arrays<S: Simd>(Vector { x, y, z }: Vector<Lanes<S>>) -> [Quad; 3] {
    [x.to_array(), y.to_array(), z.to_array()]
}

#[inline(always)]
fn smaller<S: Simd>(first: Lanes<S>, second: Lanes<S>) -> Lanes<S> {
    first.select(first.is_less(second), second)
}

/// Whether any of them is not zero.
#[inline(always)]
fn is_any<S: Simd>(simd: S, numbers: Lanes<S>) -> bool {
    !numbers.is_equal(Lanes::all(simd, 0.0)).all_true()
}
