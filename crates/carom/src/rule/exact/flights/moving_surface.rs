//! Surfaces that move, or whose material does, under spheres on curves.

use glam::DVec3;

use crate::mesh::Placement;
use crate::surface::{Surface, SurfaceMotion};

/// A surface that moves, or whose material does.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MovingSurface<'a> {
    pub surface: &'a Surface,
    /// When surfaces are where the system says, on the world's clock \[s\].
    pub known_at: f64,
}

/// The place and the motion of a surface at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct SurfaceState {
    /// From where the system says that the surface is.
    pub placement: Placement,
    /// Motion of the material, without a belt's.
    pub motion: SurfaceMotion,
    /// Motion of the place: a wheel turns in its own.
    pub of_place: SurfaceMotion,
}

/// What the motion of a surface adds where a sphere touches it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Carried {
    /// Velocity of the surface, extended to the centre of the sphere \[m/s\].
    pub velocity: DVec3,
    /// Acceleration in space of a sphere that does not accelerate as seen from the surface \[m/s²\].
    pub acceleration: DVec3,
    /// Angular velocity of the surface \[rad/s\].
    pub spin: DVec3,
    /// Rate of change in space of the sphere's angular velocity, if it is constant as seen from the surface \[rad/s²\].
    pub spin_change: DVec3,
    /// Velocity of the material relative to the place of the surface \[m/s\].
    pub belt: DVec3,
}

impl<'a> MovingSurface<'a> {
    /// The surface, if it carries what touches it.
    pub fn of(surface: &'a Surface, known_at: f64) -> Option<Self> {
        surface.carries().then_some(Self { surface, known_at })
    }

    /// Place and motion at a time on the world's clock \[s\].
    pub(super) fn at(&self, time: f64) -> SurfaceState {
        let (placement, motion) = self.surface.placement_after(time - self.known_at);
        let turning = match motion.turns_form(&self.surface.form) {
            true => motion.angular_velocity,
            false => DVec3::ZERO,
        };
        let of_place = SurfaceMotion { angular_velocity: turning, ..motion };
        SurfaceState { placement, motion, of_place }
    }

    /// A centre \[m\] and a velocity \[m/s\] at a time \[s\], as seen from where the system says that the surface is.
    pub fn seen_from(&self, [center, velocity]: [DVec3; 2], time: f64) -> [DVec3; 2] {
        self.at(time).seen_from([center, velocity])
    }

    /// How long from a time on \[s\] its motion is smooth and turns by less than an angle \[rad\].
    pub(super) fn smooth_for(&self, time: f64, angle: f64) -> f64 {
        let SurfaceMotion { angular_velocity, drive, .. } = self.at(time).motion;
        let (rate, smooth_for) =
            drive.map_or((0.0, f64::INFINITY), |drive| (drive.rate, drive.smooth_for));
        let turning = angular_velocity.dot(angular_velocity).sqrt();
        smooth_for.min(angle / rate.max(turning))
    }
}

impl SurfaceState {
    /// A centre \[m\] and a velocity \[m/s\], as seen from where the system says that the surface is.
    pub fn seen_from(&self, [center, velocity]: [DVec3; 2]) -> [DVec3; 2] {
        let beside = velocity - self.of_place.velocity_at(center);
        [self.placement.point_back(center), self.placement.vector_back(beside)]
    }

    /// The acceleration \[m/s²\] as seen from there of what has this centre \[m\], velocity \[m/s\] and acceleration \[m/s²\] in
    /// space.
    pub fn acceleration_seen(&self, [center, velocity, acceleration]: [DVec3; 3]) -> DVec3 {
        self.placement.vector_back(acceleration - self.of_place.carrying(center, velocity))
    }

    /// What the surface adds where a sphere with this centre \[m\], velocity \[m/s\] and angular velocity \[rad/s\] touches
    /// it.
    pub fn carried(&self, [center, velocity, turning]: [DVec3; 3]) -> Carried {
        let SurfaceMotion { angular_velocity: spin, belt, drive, .. } = self.motion;
        let change = drive.map_or(DVec3::ZERO, |drive| drive.angular_acceleration);
        Carried {
            velocity: self.motion.velocity_at(center),
            acceleration: self.motion.carrying(center, velocity),
            spin,
            spin_change: change + spin.cross(turning),
            belt,
        }
    }
}
