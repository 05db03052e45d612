//! Prepare for pairs: the state in which the contacts of pairs of spheres begin a sub-step, one contact per lane of
//! the processor's vectors.

use fearless_simd::{Level, Simd, SimdMask, dispatch, mask64x4};
use glam::DVec3;

use super::batch::{
    ApproachBatch, Batches, FrictionBatch, Hit, LawBatch, PairBatch, Quad, RollingBatch, get,
};
use super::gather::{
    TINY, apply, apply_spin, arrays, gathered, is_any, offset, relative_velocity, slip, smaller,
    sum, turn, vector, xyz,
};
use super::swept::{self, Traits};
use crate::lanes::{LANES, Lanes};
use crate::real::{Real, Vector};
use crate::restitution::ContactRestitution;
use crate::rule::contact::slots::Run;
use crate::rule::contact::sub_step::{GROWTH, SubStep};

/// Prepares the contacts of a run: normals, gaps, target velocities, and the impulses to start from, which it
/// applies.
pub(crate) fn prepare(run: &mut Run, batches: &mut Batches, sub_step: &SubStep) {
    let level = Level::new();
    if batches.frictions.is_empty() {
        dispatch!(level, simd => prepare_all::<_, false>(simd, run, batches, sub_step));
    } else {
        dispatch!(level, simd => prepare_all::<_, true>(simd, run, batches, sub_step));
    }
}

#[inline(always)]
fn prepare_all<S: Simd, const FRICTION: bool>(
    simd: S,
    run: &mut Run,
    batches: &mut Batches,
    sub_step: &SubStep,
) {
    let Batches {
        pairs,
        approaches,
        restitutions,
        laws,
        hits,
        frictions,
        rollings,
        shifts,
        slides,
        ..
    } = batches;
    hits.clear();
    for (number, (batch, approach)) in pairs.iter_mut().zip(approaches).enumerate() {
        let (restitution, law) = (&mut restitutions[number], laws.get(number));
        let (shift, slide) = (shifts.get(number), slides.get(number));
        if let Some(law) = law {
            law.set(restitution, [0.0; LANES]);
        }
        let given = Given { restitution, law, shift, slide };
        let aimed = aim(simd, run, (batch, approach), given, sub_step);
        if let Some(law) = law {
            law.set(restitution, aimed.impact.to_array());
        }
        let mut speed = [0.0; LANES];
        if aimed.is_any() {
            let given = Given { restitution, law, shift, slide };
            speed = aimed.meet(simd, run, batch, (approach, given), sub_step);
            if let Some(law) = law {
                law.set(restitution, speed);
            }
            if speed != [0.0; LANES] {
                hits.push(Hit { batch: number as u32, speed });
            }
        }
        if FRICTION {
            let friction = &mut frictions[number];
            friction.aim(simd, run, (batch, slide), speed);
            start_friction(simd, run, batch, friction, rollings.get_mut(number));
        } else {
            let impulse = Lanes::each(simd, batch.impulse);
            if is_any(simd, impulse) {
                apply(simd, run.velocity, batch, vector(simd, &batch.normal) * impulse);
            }
        }
    }
}

/// Constants of the pairs of a batch between searches.
#[derive(Clone, Copy)]
struct Given<'a> {
    /// Coefficients of restitution.
    restitution: &'a Quad,
    /// Restitutions that depend on the speed.
    law: Option<&'a LawBatch>,
    /// Offsets from spheres 2 to their images \[m\], where space is periodic.
    shift: Option<&'a [Quad; 3]>,
    /// Velocities of those images relative to spheres 2, along x \[m/s\], in a box in steady shear.
    slide: Option<&'a Quad>,
}

/// The approach of the pairs of a batch in a sub-step.
struct Aimed<S: Simd> {
    /// Speeds of approach of impacts \[m/s\]; 0 elsewhere.
    impact: Lanes<S>,
    /// Pairs whose spheres move so far that they may meet on the way.
    goes_far: mask64x4<S>,
    /// Pairs with an impact.
    is_hit: mask64x4<S>,
    /// Pairs of which neither sphere presses on anything.
    is_free: mask64x4<S>,
}

/// Computes present normals and gaps, target velocities without a bounce, and the impulses to start from.
#[inline(always)]
fn aim<S: Simd>(
    simd: S,
    run: &Run,
    (batch, approach): (&mut PairBatch, &mut ApproachBatch),
    Given { restitution, shift, slide, .. }: Given,
    sub_step: &SubStep,
) -> Aimed<S> {
    let all = |number| Lanes::all(simd, number);
    let zero = all(0.0);
    let offset = offset(simd, run.position, batch, shift);
    let length = offset.length_squared().sqrt();
    let is_lost = length.is_less(all(TINY));
    let inverse = all(1.0) / length.max(all(TINY));
    let mut normal = offset * inverse;
    // For coincident centres any direction will do, if it is always the same.
    normal.y = all(1.0).select(is_lost, normal.y);
    let radius_sum = Lanes::each(simd, approach.radius_sum);
    let gap = length - radius_sum;

    let [vx, vy, vz, bear] = relative_velocity(simd, run.before, batch, slide);
    let velocity = Vector { x: vx, y: vy, z: vz };
    let speed = velocity.dot(normal);

    let carried = Lanes::each(simd, batch.impulse);
    let before = Lanes::each(simd, approach.previous);
    // The impulse that stopped an impact is not needed once the two part.
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
    let mut fall = zero;
    // Spheres that fall side by side do not approach each other, but a falling sphere approaches a supported one. A
    // contact that does not bounce may wait until the end of the sub-step.
    let is_one_borne = bear.abs().is_equal(all(f64::INFINITY))
        & carried.is_equal(zero)
        & zero.is_less(Lanes::each(simd, *restitution));
    if is_one_borne.any_true() {
        let pressing = pressing(simd, run, (batch, normal), (bear, sub_step));
        fall = (pressing * (0.5 * sub_step.h)).select(is_one_borne, zero);
        // On its parabola the sphere does not get as far as with its last velocity.
        let stays = ((zero - speed + fall) * sub_step.h).is_less(gap);
        let later = fall.max(zero).select(stays, zero);
        batch.bias = (Lanes::each(simd, batch.bias) + later).to_array();
    }
    let least = all(sub_step.impact_speed);
    let shaken = shaken_speed(simd, run, (batch, normal), sub_step);
    let threshold = all(sub_step.resting_speed).select(rests, least);
    let threshold = threshold.select(is_free, threshold.max(shaken));
    let closing = zero - speed;
    let meets = gap.is_less((closing + fall) * sub_step.h) & threshold.is_less(closing);
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
    /// Whether some pair has an impact or may have one.
    #[inline(always)]
    fn is_any(&self) -> bool {
        (self.is_hit | self.goes_far).any_true()
    }

    /// Computes the velocities with which impacts are to end. Returns speeds of approach \[m/s\], 0 where
    /// there is no impact.
    #[inline(always)]
    fn meet(
        self,
        simd: S,
        run: &Run,
        batch: &mut PairBatch,
        (approach, Given { restitution, law, shift, slide }): (&ApproachBatch, Given),
        sub_step: &SubStep,
    ) -> Quad {
        let zero = Lanes::all(simd, 0.0);
        let rebound = zero - Lanes::each(simd, *restitution) * self.impact;
        // A contact that already presses does not bounce: it would lose its starting impulse.
        let is_new = Lanes::each(simd, approach.previous).is_equal(zero);
        let bounces = is_new & rebound.is_less(zero);
        let bias = rebound.select(bounces, Lanes::each(simd, batch.bias));
        batch.bias = bias.to_array();
        let mut speed = self.impact.to_array();
        let is_swept = (self.goes_far | bounces) & (self.is_free | self.is_hit);
        let is_swept = Lanes::all(simd, 1.0).select(is_swept, zero).to_array();
        for lane in (0..LANES).filter(|&lane| is_swept[lane] > 0.0) {
            let shift = shift.map_or(DVec3::ZERO, |it| DVec3::from_array(get(it, lane)));
            let traits = Traits {
                radius_sum: approach.radius_sum[lane],
                restitution: law
                    .and_then(|law| law.0[lane])
                    .unwrap_or(ContactRestitution::Constant(restitution[lane])),
                shift,
                slide: slide.map_or(0.0, |it| it[lane]),
            };
            if let Some(found) = swept::aim_pair(run, batch, (lane, traits), sub_step) {
                speed[lane] = found;
            }
        }
        speed
    }
}

/// Speeds of approach below which the spheres of a batch that press on something do not bounce \[m/s\].
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

/// Acceleration of approach \[m/s²\] for pairs of a supported sphere and a free one. The sign of `bear` says which
/// one is free: positive for the second.
#[inline(always)]
fn pressing<S: Simd>(
    simd: S,
    run: &Run,
    (batch, normal): (&PairBatch, Vector<Lanes<S>>),
    (bear, sub_step): (Lanes<S>, &SubStep),
) -> Lanes<S> {
    let zero = Lanes::all(simd, 0.0);
    let is_second_borne = zero.is_less(bear);
    let [of_first, of_second] = if let Some(acceleration) = sub_step.common_acceleration {
        [Vector::all(simd, acceleration).dot(normal); 2]
    } else {
        let first = xyz(Lanes::transposed(gathered(simd, run.acceleration, &batch.first)));
        let second = xyz(Lanes::transposed(gathered(simd, run.acceleration, &batch.second)));
        [first.dot(normal), second.dot(normal)]
    };
    of_first.select(is_second_borne, zero - of_second)
}

impl FrictionBatch {
    /// Computes the slip after impacts.
    #[inline(always)]
    fn aim<S: Simd>(
        &mut self,
        simd: S,
        run: &Run,
        (batch, slide): (&PairBatch, Option<&Quad>),
        speed: Quad,
    ) {
        let restitution = Lanes::each(simd, self.tangential_restitution);
        let impact = Lanes::each(simd, speed);
        if !is_any(simd, impact * restitution) {
            self.slip = [[0.0; LANES]; 3];
            return;
        }
        let normal = vector(simd, &batch.normal);
        let velocity = xyz(relative_velocity(simd, run.before, batch, slide));
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
    // Removes the part along the turned normal, and everything where the contact does not press.
    let kept = vector(simd, &friction.tangential);
    let along = kept - normal * kept.dot(normal);
    let none = Vector { x: zero, y: zero, z: zero };
    let tangential = along.select(bears, none);
    friction.tangential = arrays(tangential);
    if let Some(rolling) = rolling {
        let kept = vector(simd, &rolling.angular);
        let angular = kept.select(bears, none);
        rolling.angular = arrays(angular);
        turn(simd, run.spin, batch, rolling, angular);
    }
    if bears.any_true() {
        apply(simd, run.velocity, batch, normal * impulse + tangential);
        apply_spin(simd, run.spin, batch, normal.cross(tangential));
    }
}
