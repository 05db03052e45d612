//! Impacts of two spheres in a box in steady shear, where the image of a sphere has a velocity of its own. Spheres that
//! meet at one instant are answered one pair after the other.

use super::pair::PairImpact;
use crate::rule::exact::answer::changed::Changed;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::timeline::Timeline;
use crate::shear::Shear;

/// Answers the impact of two spheres at `time` \[s\]. Momentum and energy are those of the second one's image.
pub(crate) fn answer_sheared_pair(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slots: [u32; 2],
    time: f64,
) -> Changed {
    let Some(shear) = Shear::of(context.system.settings) else { return Changed::NONE };
    let flights = &timeline.flights;
    let mut slots = slots;
    slots.sort_unstable_by_key(|&slot| flights.index_of[slot as usize]);
    let [one, (x2, v2)] = slots.map(|slot| flights.state_of(slot, time));
    let [offset, image_velocity] = shear.nearest(x2 - one.0, time);
    // A way of some boxes down leads to an image that is as many boxes up.
    let image = (one.0 + offset, v2 + image_velocity);
    let impact = PairImpact::of((timeline, context), slots, ([one, image], offset), time);
    impact.record(timeline, context, slots);
    let velocities = [impact.velocities[0], impact.velocities[1] - image_velocity];
    for (slot, (place, velocity)) in slots.into_iter().zip([one.0, x2].into_iter().zip(velocities))
    {
        timeline.begin_flight(slot, place, velocity, time);
        if impact.impulse.is_some() {
            timeline.flights.bodies[slot as usize].strike();
        }
    }
    Changed::Pair { slots, are_searched: [false; 2] }
}
