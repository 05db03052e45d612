//! The impact of a group as derivatives need it.

use crate::rule::exact::contacts::{Group, Member, Touch};
use crate::rule::exact::flights::{GroupImpact, StruckMember, StruckTouch};

/// Returns the impact of a group whose members move as after it. `before` are the members before it; `numbers` has the
/// restitution and the impulse \[N s\] of each touch.
pub(super) fn impact_of(
    group: &Group,
    before: &[Member],
    numbers: [&[f64]; 2],
    is_plain: bool,
) -> GroupImpact {
    let motion = |member: &Member| [member.velocity, member.angular_velocity];
    let pairs = before.iter().zip(&group.members);
    let members = pairs.map(|(before, after)| StruckMember {
        index: before.index,
        position: before.position,
        before: motion(before),
        after: motion(after),
    });
    let numbers = numbers[0].iter().zip(numbers[1]);
    let touches = group.touches.iter().zip(numbers);
    let touches = touches.map(|(touch, (&restitution, &impulse))| StruckTouch {
        bodies: touch.bodies,
        first: touch.first,
        second: touch.second,
        normal: touch.normal,
        curvature: touch.curvature,
        restitution,
        impulse,
    });
    let is_on_ring = group.touches.iter().any(|touch: &Touch| touch.side.is_some());
    GroupImpact {
        time: group.time,
        members: members.collect(),
        touches: touches.collect(),
        is_plain: is_plain && !is_on_ring,
    }
}
