//! Friction in the impacts of a group.

use glam::DVec3;

use crate::detect::contact::Bodies;
use crate::report::ImpactGroup;
use crate::respond::{self, FrictionContact, SpinningSphere};
use crate::rule::exact::contacts::{Group, Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::sum::Sum;

/// The effect of friction in an impact.
#[derive(Default)]
pub(super) struct FrictionImpulses {
    /// Impulses on body 2 \[N s\], one per touch; empty where no friction acts.
    pub impulses: Vec<DVec3>,
    /// Change of kinetic energy \[J\], <= 0, measured against the surfaces.
    energy: f64,
    /// Kinetic energy of rotation before and after \[J\].
    rotational: [f64; 2],
}

impl FrictionImpulses {
    /// All impulses together \[N s\].
    pub fn total(&self) -> DVec3 {
        self.impulses.iter().sum()
    }

    /// The account of the group with rotation and the work of friction.
    pub fn add_to(&self, account: ImpactGroup) -> ImpactGroup {
        ImpactGroup {
            energy_before: account.energy_before + self.rotational[0],
            energy_after: account.energy_after + self.rotational[1],
            energy_demanded: account.energy_demanded + self.energy,
            ..account
        }
    }
}

/// Applies friction to each touch that got a normal impulse \[N s\]; changes how the members move and
/// turn.
pub(super) fn in_group(
    context: &StepContext,
    group: &mut Group,
    normal_impulses: &[f64],
) -> FrictionImpulses {
    let contact = |(touch, &normal_impulse): (&Touch, &f64)| {
        let along = (touch.normal, normal_impulse);
        let surface_velocity = surface_velocity(touch, &group.members);
        let places = (touch.first, touch.second);
        FrictionContact { surface_velocity, ..contact_of(context, touch.bodies, places, along) }
    };
    let mut contacts: Vec<FrictionContact> =
        group.touches.iter().zip(normal_impulses).map(contact).collect();
    apply(context, &mut contacts, &mut group.members)
}

/// Applies friction to a sphere that gets an impulse \[N s\] along the normal of a surface at rest, whose material
/// has this velocity \[m/s\].
pub(super) fn at_surface(
    context: &StepContext,
    member: &mut Member,
    (bodies, surface_velocity): (Bodies, DVec3),
    along: (DVec3, f64),
) -> FrictionImpulses {
    let contact = contact_of(context, bodies, (None, 0), along);
    let contact = FrictionContact { surface_velocity, ..contact };
    apply(context, &mut [contact], std::slice::from_mut(member))
}

/// Applies friction to two spheres that get an impulse \[N s\] along the normal.
pub(super) fn of_pair(
    context: &StepContext,
    members: &mut [Member; 2],
    bodies: Bodies,
    along: (DVec3, f64),
) -> FrictionImpulses {
    let contact = contact_of(context, bodies, (Some(0), 1), along);
    apply(context, &mut [contact], members)
}

/// A contact that got an impulse \[N s\] along its normal, of bodies at these places among the members; a
/// surface is at rest.
fn contact_of(
    context: &StepContext,
    bodies: Bodies,
    (first, second): (Option<usize>, usize),
    (normal, normal_impulse): (DVec3, f64),
) -> FrictionContact {
    FrictionContact {
        first,
        second,
        normal,
        surface_velocity: DVec3::ZERO,
        friction: respond::friction_of(bodies, context.system),
        restitution: respond::restitution_of(bodies, context.system),
        normal_impulse,
        impulse: DVec3::ZERO,
    }
}

/// Applies the impulses of friction to contacts of spheres.
fn apply(
    context: &StepContext,
    contacts: &mut [FrictionContact],
    members: &mut [Member],
) -> FrictionImpulses {
    let mut spheres: Vec<SpinningSphere> =
        members.iter().map(|member| spinning(context, member)).collect();
    let rotational = |spheres: &[SpinningSphere]| {
        spheres.iter().map(SpinningSphere::rotational_energy).collect::<Sum>().value()
    };
    let before = rotational(&spheres);
    let energy = respond::apply_friction(context.work, contacts, &mut spheres);
    for (member, sphere) in members.iter_mut().zip(&spheres) {
        member.velocity = sphere.velocity;
        member.angular_velocity = sphere.angular_velocity;
    }
    let impulses = contacts.iter().map(|contact| contact.impulse).collect();
    FrictionImpulses { impulses, energy, rotational: [before, rotational(&spheres)] }
}

/// A sphere of a group for the friction law.
fn spinning(context: &StepContext, member: &Member) -> SpinningSphere {
    SpinningSphere {
        radius: member.species.radius,
        mass: member.species.mass,
        inertia_factor: context.system.spheres.inertia_factor(member.index as usize),
        velocity: member.velocity,
        angular_velocity: member.angular_velocity,
    }
}

/// Velocity of the material of a surface where it is touched \[m/s\]; zero for a sphere.
pub(super) fn surface_velocity(touch: &Touch, members: &[Member]) -> DVec3 {
    match touch.bodies {
        Bodies::Pair(..) => DVec3::ZERO,
        Bodies::Surface { .. } => {
            let arm = members[touch.second].species.radius * touch.normal;
            touch.with_belt(touch.surface_velocity - touch.surface_spin.cross(arm))
        }
    }
}
