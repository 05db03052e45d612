//! Speed that surfaces add in impacts.

use glam::DVec3;

use crate::respond;
use crate::rule::exact::contacts::Member;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::persistent::free_acceleration;

/// Speed that a surface adds to a sphere along its normal in an impact \[m/s\].
pub(super) fn kick_of(
    context: &StepContext,
    member: &Member,
    (surface, normal): (u32, DVec3),
) -> f64 {
    let kick = context.system.surfaces[surface as usize].kick;
    if kick == 0.0 {
        return 0.0;
    }
    respond::kick(kick, -free_acceleration(member).dot(normal), member.species.radius)
}
