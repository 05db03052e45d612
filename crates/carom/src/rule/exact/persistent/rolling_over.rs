//! A sphere that is pressed onto an edge, a corner or a fixed sphere where friction acts: it slides or rolls
//! over it in pieces of path (`docs/physics/persistent-contacts.md`).

use glam::DVec3;

use super::NoClosedForm;
use super::accelerations::{Accelerations, bias};
use super::piece::turning_time;
use super::rolling::{PressedSphere, Rolling, on_plane};
use crate::axis_motion::AxisMotion;
use crate::detect::contact::Bodies;
use crate::friction::ContactFriction;
use crate::rule::exact::contacts::{Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::features::{is_over_face, time_on};
use crate::surface::Form;

/// The motion of a sphere over a piece of path.
pub(super) struct RollingOver {
    pub member: Member,
    /// Acceleration by everything \[m/s²\].
    pub acceleration: DVec3,
    /// \[rad/s²\]
    pub angular_acceleration: DVec3,
    /// How long that holds \[s\].
    pub valid_for: f64,
}

/// The next piece of path of a sphere on one curved contact at rest. It lasts until the normal has turned by a
/// thousandth, or the sphere stops sliding or rolling. Over the piece, velocity and angular velocity change by as
/// much as on the true path; its places are right to the third order.
///
/// # Errors
/// [`NoClosedForm`] under drag, and where the surface or its material moves.
pub(super) fn roll_over(
    context: &StepContext,
    member: &Member,
    touch: &Touch,
    friction: ContactFriction,
    time: f64,
) -> Result<RollingOver, NoClosedForm> {
    let moves = touch.does_work() || touch.belt != DVec3::ZERO;
    if member.species.drag_rate > 0.0 || moves {
        return Err(NoClosedForm);
    }
    let inertia_factor = context.system.spheres.inertia_factor(member.index as usize);
    let contact = CurvedContact {
        context,
        touch: Touch { first: None, second: 0, ..*touch },
        friction,
        inertia_factor,
        time,
    };
    let mut member = *member;
    // Closes the gap that the piece before left.
    member.position -= touch.gap * touch.normal;
    member.velocity -= member.velocity.dot(touch.normal) * touch.normal;
    let duration = context.parameters.contact_duration;
    let pressed = contact.pressed(&member, &contact.touch);
    let slides = pressed.slides(duration);
    let state = on_plane(&pressed, duration);
    (member.velocity, member.angular_velocity) = (state.velocity, state.angular_velocity);
    // A slip that ends within the piece has no direction at the end.
    let slip = slides.then(|| state.acceleration - pressed.pull);
    let fixed = slip.filter(|_| state.valid_for < f64::INFINITY);
    let motion = Motion { slides, friction: fixed };
    let [acceleration, _] = contact.rates(&member, &contact.touch, motion);
    let start = Accelerations { each: vec![acceleration], largest: pressed.pressing };
    let turning = turning_time(&[member], &[contact.touch], &start, f64::INFINITY);
    let on_feature = contact.time_on(&member, acceleration).max(duration);
    let valid_for = state.valid_for.min(turning).min(on_feature);
    if valid_for == f64::INFINITY || state.is_at_rest() {
        // The sphere rests, spins on the spot, or rolls along an edge.
        let Rolling { acceleration, angular_acceleration, .. } = state;
        return Ok(RollingOver { member, acceleration, angular_acceleration, valid_for });
    }
    let valid_for = valid_for.max(duration);
    let motion = Motion { friction: fixed.filter(|_| valid_for >= state.valid_for), ..motion };
    let [velocity, angular_velocity] = contact.after(&member, motion, valid_for);
    Ok(RollingOver {
        member,
        acceleration: (velocity - member.velocity) / valid_for,
        angular_acceleration: (angular_velocity - member.angular_velocity) / valid_for,
        valid_for,
    })
}

/// The friction over a piece.
#[derive(Clone, Copy)]
struct Motion {
    slides: bool,
    /// Sliding friction divided by the mass \[m/s²\], if it is the same all the time.
    friction: Option<DVec3>,
}

/// The contact of a sphere with a round feature at rest.
struct CurvedContact<'a> {
    context: &'a StepContext<'a>,
    /// Touch of the only member, as it is at the start.
    touch: Touch,
    friction: ContactFriction,
    inertia_factor: f64,
    /// Start, on the world's clock \[s\].
    time: f64,
}

impl CurvedContact<'_> {
    /// The sphere on the tangent plane of the contact, with the effect of the turning normal on its slip as a pull.
    fn pressed(&self, member: &Member, touch: &Touch) -> PressedSphere {
        let Member { species, velocity, angular_velocity, .. } = *member;
        let normal = touch.normal;
        let pressing =
            -species.acceleration.dot(normal) - bias(touch, std::slice::from_ref(member));
        let turning = touch.curvature.rate(touch.across(velocity));
        let spin = species.radius * angular_velocity.dot(normal);
        PressedSphere {
            normal,
            belt: DVec3::ZERO,
            radius: species.radius,
            inertia_factor: self.inertia_factor,
            velocity: touch.across(velocity),
            angular_velocity,
            pressing: pressing.max(0.0),
            pull: touch.across(species.acceleration) - spin * normal.cross(turning),
            friction: self.friction,
        }
    }

    /// Time \[s\] until the sphere, with this acceleration \[m/s²\], may reach what is beside the feature.
    fn time_on(&self, member: &Member, acceleration: DVec3) -> f64 {
        let Bodies::Surface { surface, .. } = self.touch.bodies else { return f64::INFINITY };
        let form = &self.context.system.surfaces[surface as usize].form;
        if let Form::Rectangle(_) = form {
            // Edges and corners are tested where they turn.
            return f64::INFINITY;
        }
        let motion = |axis: DVec3| AxisMotion {
            velocity: member.velocity.dot(axis),
            acceleration: acceleration.dot(axis),
            drag_rate: 0.0,
        };
        time_on(form, [member.position + self.touch.shift, member.velocity], motion)
    }

    /// Acceleration \[m/s²\] and angular acceleration \[rad/s²\].
    fn rates(&self, member: &Member, touch: &Touch, motion: Motion) -> [DVec3; 2] {
        let pressed = self.pressed(member, touch);
        let friction = match motion.friction {
            Some(friction) => touch.across(friction),
            None => pressed.friction_now(motion.slides),
        };
        let normal = -bias(touch, std::slice::from_ref(member)) * touch.normal;
        let acceleration = touch.across(member.species.acceleration) + friction + normal;
        [acceleration, pressed.angular_acceleration_under(friction, motion.slides)]
    }

    /// Whether both states are on the face of a band, or both beside it. A piece ends a little beyond the face, where
    /// the rim is, which is sharply curved.
    fn are_on_one_part(&self, one: &Member, other: &Member) -> bool {
        let Bodies::Surface { surface, .. } = self.touch.bodies else { return true };
        let Form::Band(band) = &self.context.system.surfaces[surface as usize].form else {
            return true;
        };
        let is_over =
            |it: &Member| is_over_face(band, [it.position + self.touch.shift, it.velocity]);
        is_over(one) == is_over(other)
    }

    /// Velocity \[m/s\] and angular velocity \[rad/s\] after `h` \[s\], by the method of Runge and Kutta.
    fn after(&self, start: &Member, motion: Motion, h: f64) -> [DVec3; 2] {
        let mut rates = [[DVec3::ZERO; 3]; 4];
        let parts = [0.0, 0.5, 0.5, 1.0];
        for stage in 0..4 {
            let [way, change, spin] = match stage {
                0 => [DVec3::ZERO; 3],
                _ => rates[stage - 1].map(|rate| parts[stage] * h * rate),
            };
            let member = Member {
                position: start.position + way,
                velocity: start.velocity + change,
                angular_velocity: start.angular_velocity + spin,
                ..*start
            };
            let measured =
                self.touch.measured_at(self.context, std::slice::from_ref(&member), self.time);
            let measured = measured.filter(|_| self.are_on_one_part(start, &member));
            let touch = measured.unwrap_or(self.touch);
            let [acceleration, angular_acceleration] = self.rates(&member, &touch, motion);
            rates[stage] = [member.velocity, acceleration, angular_acceleration];
        }
        let [first, second, third, fourth] = rates;
        let mean = |of: usize| (first[of] + 2.0 * (second[of] + third[of]) + fourth[of]) / 6.0;
        [start.velocity + h * mean(1), start.angular_velocity + h * mean(2)]
    }
}
