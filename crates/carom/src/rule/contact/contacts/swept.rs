//! Contacts of spheres that bounce, or have a long path in a sub-step: whether they meet on the way, and where.
//!
//! Elsewhere the normal at the start of a sub-step is as good as that at the impact, and the gap along it
//! says when the bodies meet. A sphere that goes far would be stopped by what it passes.

use glam::DVec3;

use super::batch::{PairBatch, set};
use crate::contact_time;
use crate::restitution::ContactRestitution;
use crate::rule::contact::slots::Run;
use crate::rule::contact::sub_step::SubStep;

/// A path is long beyond this part of the sum of radii.
pub(crate) const FAR: f64 = 0.125;
/// Bound of the normal velocity where nothing is met \[m/s\]: any value is allowed.
pub(crate) const FREE: f64 = f64::MAX;

/// Constants of a contact of two spheres between searches.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Traits {
    /// Sum of the radii \[m\].
    pub radius_sum: f64,
    pub restitution: ContactRestitution,
    /// Offset from sphere 2 to its image that sphere 1 touches \[m\].
    pub shift: DVec3,
    /// Velocity of that image relative to sphere 2, along x \[m/s\].
    pub slide: f64,
}

/// Computes a contact of a batch that bounces, or whose spheres have a long path, for their impact within the
/// sub-step, with the normal there; without an impact it does not press. Returns the speed of approach \[m/s\], 0
/// without an impact; `None` if they overlap already.
pub(crate) fn aim_pair(
    run: &Run,
    batch: &mut PairBatch,
    (lane, traits): (usize, Traits),
    sub_step: &SubStep,
) -> Option<f64> {
    let Traits { radius_sum, restitution, shift, slide } = traits;
    let [first, second] = [batch.first[lane] as usize, batch.second[lane] as usize];
    let offset = run.position[second].vector() - run.position[first].vector() + shift;
    let mut velocity = run.before[second].vector() - run.before[first].vector();
    velocity.x += slide;
    if first == second || offset.length_squared() <= radius_sum * radius_sum {
        return None;
    }
    let meeting = contact_time::sphere_sphere_linear(offset, velocity, radius_sum);
    let meeting = meeting.map(|time| {
        let normal = (offset + time * velocity) / radius_sum;
        let pressing = pressing(run, [first, second]).dot(normal);
        (normal, Fall::over(time, -velocity.dot(normal), pressing))
    });
    let Some((normal, fall)) = meeting.filter(|(_, fall)| fall.time <= sub_step.h) else {
        let passage = Passage::of(offset, velocity, radius_sum, sub_step.h);
        set(&mut batch.normal, lane, passage.normal.to_array());
        batch.bias[lane] = passage.bias;
        return Some(0.0);
    };
    let Fall { gap, time, speed, pressing } = fall;
    let rebound = restitution.at(speed) * speed - pressing * (sub_step.h - time);
    set(&mut batch.normal, lane, normal.to_array());
    batch.bias[lane] = if rebound > 0.0 { -rebound } else { gap / sub_step.h };
    Some(speed)
}

/// The closing of a gap.
struct Fall {
    /// \[m\]
    gap: f64,
    /// Time at which it is closed \[s\].
    time: f64,
    /// Closing speed at that time \[m/s\].
    speed: f64,
    /// Acceleration of closing \[m/s²\].
    pressing: f64,
}

impl Fall {
    /// The closing of a gap that would close after a time \[s\] at this speed \[m/s\] without the acceleration
    /// \[m/s²\]: `gap = s t + a t²/2`.
    fn over(time: f64, speed: f64, pressing: f64) -> Self {
        let gap = speed * time;
        if pressing == 0.0 {
            return Self { gap, time, speed, pressing };
        }
        let speed_there = (speed * speed + 2.0 * pressing * gap).max(0.0).sqrt();
        Self { gap, time: 2.0 * gap / (speed + speed_there), speed: speed_there, pressing }
    }
}

/// Acceleration of the second of two spheres towards the first by forces \[m/s²\], if one is supported and the
/// other is not; else zero.
fn pressing(run: &Run, [first, second]: [usize; 2]) -> DVec3 {
    match [run.bears[first], run.bears[second]] {
        [true, false] => -run.acceleration[second].vector(),
        [false, true] => run.acceleration[first].vector(),
        _ => DVec3::ZERO,
    }
}

/// The passage of two spheres that do not meet within a sub-step.
struct Passage {
    /// Unit vector from the first sphere to the second, at the time at which they are nearest.
    normal: DVec3,
    /// Lower bound of the normal velocity with the sign reversed \[m/s\]; impulses of other contacts must not go
    /// below it.
    bias: f64,
}

impl Passage {
    /// With the gap c and the normal n where they are nearest, after a time t, a change of their velocity v
    /// by d leaves the gap `c + t n·d`, which is not to be negative: `n·(v + d) >= n·v - c/t`.
    fn of(offset: DVec3, velocity: DVec3, radius_sum: f64, h: f64) -> Self {
        let nearest = -offset.dot(velocity) / velocity.length_squared();
        let time = nearest.clamp(0.0, h);
        let there = offset + time * velocity;
        let length = there.length();
        let normal = there / length;
        let gap = (length - radius_sum).max(0.0);
        let bias = if time > 0.0 { gap / time - normal.dot(velocity) } else { gap / h };
        Self { normal, bias }
    }
}
