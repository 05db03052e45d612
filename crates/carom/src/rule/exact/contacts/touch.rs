//! Two bodies that touch at one instant.

use glam::DVec3;

use super::member::Member;
use crate::detect::contact::Bodies;
use crate::detect::{Separation, sphere_sphere};
use crate::norm::Norm;
use crate::respond::{TouchingContact, belt_of};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::features::{
    NormalCurvature, curvature_of, separation, separation_from_side,
};
use crate::rule::exact::flights::RingSide;
use crate::surface::{Form, SurfaceMotion};
use crate::surface_motion::Drive;

/// Two bodies that touch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touch {
    pub bodies: Bodies,
    /// Places of the spheres among the members; the first body may be a surface.
    pub first: Option<usize>,
    pub second: usize,
    /// Unit normal from body 1 to body 2.
    pub normal: DVec3,
    /// Where on body 1 \[m\].
    pub point: DVec3,
    /// Between the two surfaces \[m\]: nearly 0.
    pub gap: f64,
    /// Unit vector from the axis to the side of the surface that is touched, where the sphere is on a ring.
    pub side: Option<DVec3>,
    /// How the normal turns when the spheres slide.
    pub curvature: NormalCurvature,
    /// Velocity of the surface, extended to the centre of body 2 \[m/s\]: its normal part equals that at the
    /// contact point. 0 where body 1 is a sphere.
    pub surface_velocity: DVec3,
    /// The part of `surface_velocity` with which the surface turns in its own place, as a wheel does about its axle
    /// \[m/s\].
    pub turning_in_place: DVec3,
    /// Velocity of the material relative to the surface, along it \[m/s\]; zero without friction.
    pub belt: DVec3,
    /// Angular velocity of the surface \[rad/s\].
    pub surface_spin: DVec3,
    /// Acceleration \[m/s²\] whose normal part is that of the gap from the turning of the surface, without sliding.
    pub surface_pull: DVec3,
    /// Acceleration of a surface that does not move steadily, extended to the centre of body 2 \[m/s²\].
    pub drive: DVec3,
    /// Bound of the relative rate of change of `drive` \[rad/s\].
    pub drive_rate: f64,
    /// How long `drive` stays continuous \[s\].
    pub drive_smooth_for: f64,
    /// Shift from the position of body 2 to its image beside body 1 \[m\].
    pub shift: DVec3,
    /// The contact was predicted, so rounding does not decide on it.
    pub is_predicted: bool,
    /// The contact has lasted up to now.
    pub has_persisted: bool,
    /// The contact continues from another part of the same mesh, over a border without an impulse.
    pub is_handed_over: bool,
}

/// A sphere that reaches the next part of a mesh gets no impulse where it meets that part at less than this
/// fraction of its speed. A piece of path along a curve is no more accurate than that.
const UNFELT: f64 = 1e-6;

impl Touch {
    /// Places of its spheres among the members.
    pub fn places(&self) -> impl Iterator<Item = usize> + use<> {
        self.first.into_iter().chain([self.second])
    }

    /// Whether the sphere at a place is one of the bodies.
    pub fn has(&self, place: usize) -> bool {
        self.places().any(|it| it == place)
    }

    /// The side of a ring that is touched.
    pub fn ring_side(&self) -> Option<RingSide> {
        let bodies = self.bodies;
        self.side.map(|side| RingSide { bodies, side })
    }

    /// The part of a vector across the normal.
    pub fn across(&self, vector: DVec3) -> DVec3 {
        vector - vector.dot(self.normal) * self.normal
    }

    /// A velocity \[m/s\] relative to the material of the surface, as one relative to its place.
    pub fn with_belt(&self, velocity: DVec3) -> DVec3 {
        // A sum with zero might change the sign of a zero.
        if self.belt == DVec3::ZERO { velocity } else { velocity + self.belt }
    }

    /// Velocity of body 2 relative to body 1 \[m/s\].
    pub fn relative_velocity(&self, members: &[Member]) -> DVec3 {
        let first = self.first.map_or(self.form_velocity(), |first| members[first].velocity);
        members[self.second].velocity - first
    }

    /// Velocity of the place of the surface \[m/s\], without what turns in its own place.
    pub fn form_velocity(&self) -> DVec3 {
        self.surface_velocity - self.turning_in_place
    }

    /// Angular velocity of the place of the surface \[rad/s\].
    pub fn form_spin(&self) -> DVec3 {
        if self.turning_in_place == DVec3::ZERO { self.surface_spin } else { DVec3::ZERO }
    }

    /// Returns the normal part of the relative velocity: negative where the bodies close.
    pub fn normal_velocity(&self, members: &[Member]) -> f64 {
        self.relative_velocity(members).dot(self.normal)
    }

    /// Velocity of sliding along which its normal turns \[m/s\]: zero on a plane.
    pub fn sliding(&self, members: &[Member]) -> DVec3 {
        let tangential = self.across(self.relative_velocity(members));
        self.curvature.turning(tangential).map_or(DVec3::ZERO, |(velocity, _)| velocity)
    }

    /// Whether it is followed in pieces: its normal turns, because bodies slide along each other or the surface turns,
    /// or the surface does not move steadily.
    pub fn is_curved(&self) -> bool {
        let turns = self.curvature != NormalCurvature::Flat || self.form_spin() != DVec3::ZERO;
        turns || self.drive_rate > 0.0
    }

    /// Whether the surface moves, and so does work on the sphere.
    pub fn does_work(&self) -> bool {
        let moves = self.surface_velocity != DVec3::ZERO || self.surface_spin != DVec3::ZERO;
        moves || self.drive_rate > 0.0
    }

    /// The contact for the impact laws, with restitution 0.
    pub fn contact(&self) -> TouchingContact {
        TouchingContact {
            first: self.first,
            second: self.second,
            normal: self.normal,
            surface_velocity: self.surface_velocity,
            restitution: 0.0,
        }
    }

    /// The same two bodies in other places; `None` where they no longer face each other.
    pub fn measured_at(
        &self,
        context: &StepContext,
        members: &[Member],
        time: f64,
    ) -> Option<Self> {
        let second = &members[self.second];
        match self.bodies {
            Bodies::Pair(..) => {
                let first = &members[self.first?];
                let centers = [first.position, second.position + self.shift];
                let spheres = [first.index, second.index];
                let separation = sphere_sphere(centers, context.system.contact_radii(spheres));
                let distance = (centers[1] - centers[0]).norm();
                Some(Self {
                    curvature: NormalCurvature::RoundFeature(distance),
                    ..self.with(separation)
                })
            }
            Bodies::Surface { surface, .. } => {
                let (form, motion) = context.surface_at(surface, time);
                let center = second.position + self.shift;
                let radius = second.species.radius;
                let turning_in_place = motion.turning_in_place(&form, center);
                let velocity = second.velocity - (motion.velocity_at(center) - turning_in_place);
                let (mut separation, curvature) = match self.side {
                    Some(side) => separation_from_side(&form, center, radius, side)?,
                    None => {
                        let separation = separation(&form, center, radius, self.is_predicted)?;
                        (separation, curvature_of(&form, [center, velocity], &separation))
                    }
                };
                if let (Form::Rectangle(face), NormalCurvature::Flat) = (&form, curvature) {
                    // A centre on the edge counts, too.
                    let height = (center - face.center).dot(face.normal);
                    separation.distance = height - radius;
                    separation.normal = face.normal;
                }
                let touch = self.with(separation).with_motion(&motion, center);
                let belt = belt_of(self.bodies, &motion, touch.normal, context.system);
                Some(Self { curvature, turning_in_place, belt, ..touch })
            }
        }
    }

    /// The contact as the continuation of one with the neighbouring part of a mesh, unless the mesh bends there.
    pub(super) fn handed_over(self, members: &[Member]) -> Self {
        let is_unfelt = self.is_unfelt(members);
        let has_persisted = self.has_persisted || is_unfelt;
        Self { has_persisted, is_handed_over: is_unfelt, ..self }
    }

    /// Whether the bodies hardly close or part, for the speed with which they slide.
    pub(super) fn is_unfelt(&self, members: &[Member]) -> bool {
        let speed = self.relative_velocity(members).norm();
        self.normal_velocity(members).abs() <= UNFELT * speed
    }

    fn with(self, separation: Separation) -> Self {
        let Separation { distance, normal, point } = separation;
        Self { gap: distance, normal, point, ..self }
    }

    /// The touch in a coordinate system that moves and turns with the surface, at the centre of the sphere.
    fn with_motion(self, motion: &SurfaceMotion, center: DVec3) -> Self {
        let surface_velocity = motion.velocity_at(center);
        let spin = motion.angular_velocity;
        // The centripetal acceleration of what turns with the surface.
        let surface_pull = -spin.cross(spin.cross(center - motion.origin));
        let Some(Drive { acceleration, angular_acceleration, rate, smooth_for, .. }) = motion.drive
        else {
            return Self { surface_velocity, surface_spin: spin, surface_pull, ..self };
        };
        let drive = acceleration + angular_acceleration.cross(center - motion.origin);
        let (drive_rate, drive_smooth_for) = (rate, smooth_for);
        let touch = Self { surface_velocity, surface_spin: spin, surface_pull, ..self };
        Self { drive, drive_rate, drive_smooth_for, ..touch }
    }

    /// The bodies, not yet measured.
    pub(super) fn between(
        bodies: Bodies,
        first: Option<usize>,
        second: usize,
        TouchOrigin { shift, is_predicted, .. }: TouchOrigin,
    ) -> Self {
        Self {
            is_predicted,
            has_persisted: false,
            is_handed_over: false,
            bodies,
            first,
            second,
            shift,
            normal: DVec3::ZERO,
            point: DVec3::ZERO,
            gap: 0.0,
            side: None,
            curvature: NormalCurvature::Flat,
            surface_velocity: DVec3::ZERO,
            turning_in_place: DVec3::ZERO,
            belt: DVec3::ZERO,
            surface_spin: DVec3::ZERO,
            surface_pull: DVec3::ZERO,
            drive: DVec3::ZERO,
            drive_rate: 0.0,
            drive_smooth_for: f64::INFINITY,
        }
    }
}

/// Origin of a touch: how the search found that two bodies touch.
#[derive(Clone, Copy)]
pub(super) struct TouchOrigin {
    /// Shift from the position of body 2 to its image beside body 1 \[m\].
    pub shift: DVec3,
    /// The contact was predicted, so rounding does not decide on it.
    pub is_predicted: bool,
    /// The contact was with the neighbouring part of the mesh up to now.
    pub is_handed_over: bool,
}
