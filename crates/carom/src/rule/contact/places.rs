//! Where surfaces are at both ends of a sub-step.

use glam::DVec3;

use crate::band::Band;
use crate::detect::sphere_surface;
use crate::round_solid::RoundSolid;
use crate::surface::{Form, Role, Surface, SurfaceMotion};

/// Where a surface is, and how it moves.
pub(super) type Place = (Form, SurfaceMotion);

/// The places of all surfaces, by their number.
#[derive(Debug, Clone, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Places {
    /// At the start of the sub-step.
    starts: Vec<Place>,
    /// At its end; empty where all are at rest.
    #[cfg_attr(feature = "serde", serde(skip))]
    ends: Vec<Place>,
    /// The numbers of those that move and deflect.
    moving: Vec<u32>,
}

impl Places {
    /// Takes over the surfaces of a frame that begins.
    pub fn begin_frame(&mut self, surfaces: &[Surface]) {
        place_all(surfaces, 0.0, &mut self.starts);
        self.ends.clear();
        let moves =
            |(_, it): &(u32, &Surface)| it.role == Role::Deflects && !it.motion.is_at_rest();
        self.moving.clear();
        self.moving.extend((0..).zip(surfaces).filter(moves).map(|(number, _)| number));
    }

    /// Finds where surfaces that move are when a sub-step ends, at a time of the frame \[s\].
    pub fn begin_sub_step(&mut self, surfaces: &[Surface], end: f64) {
        if !self.moving.is_empty() {
            place_all(surfaces, end, &mut self.ends);
        }
    }

    /// Goes on to the next sub-step.
    pub fn end_sub_step(&mut self) {
        if !self.moving.is_empty() {
            std::mem::swap(&mut self.starts, &mut self.ends);
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.starts.len()
    }

    /// The numbers of those that move, ascending.
    pub fn moving(&self) -> &[u32] {
        &self.moving
    }

    /// All surfaces at the start of the sub-step.
    pub fn starts(&self) -> &[Place] {
        &self.starts
    }

    /// A surface at the start of the sub-step.
    pub fn at_start(&self, surface: u32) -> &Place {
        &self.starts[surface as usize]
    }

    /// A surface at the end of the sub-step.
    pub fn at_end(&self, surface: u32) -> &Place {
        let ends = if self.ends.is_empty() { &self.starts } else { &self.ends };
        &ends[surface as usize]
    }

    /// How fast the fastest of them turns \[rad/s\].
    pub fn turning_rate(&self) -> f64 {
        let places = self.moving.iter().map(|&number| self.at_start(number));
        places.map(|(form, motion)| turning_rate(form, motion)).fold(0.0, f64::max)
    }

    /// The highest speed \[m/s\] at which a moving surface may come to a sphere with this centre \[m\], radius \[m\]
    /// and velocity \[m/s\] within a time \[s\].
    pub fn approach(&self, (center, radius): (DVec3, f64), velocity: DVec3, time: f64) -> f64 {
        let speed = |&number: &u32| {
            let (form, motion) = self.at_start(number);
            let arm = (center - motion.origin).length() + radius;
            let turning = motion.angular_velocity.length() * arm;
            let speed = (motion.velocity - velocity).length() + turning;
            let separation = sphere_surface(form, center, radius)?;
            (separation.distance <= speed * time).then_some(speed)
        };
        self.moving.iter().filter_map(speed).fold(0.0, f64::max)
    }
}

fn place_all(surfaces: &[Surface], time: f64, places: &mut Vec<Place>) {
    places.clear();
    places.extend(surfaces.iter().map(|surface| surface.after(time)));
}

/// How fast a surface changes by turning \[rad/s\].
pub(crate) fn turning_rate(form: &Form, motion: &SurfaceMotion) -> f64 {
    match form {
        // Of a collider of its own, about its centre.
        Form::Sphere { .. } => 0.0,
        Form::HalfSpace { normal, .. } => motion.angular_velocity.cross(*normal).length(),
        Form::Band(Band { axis, .. }) | Form::Round(RoundSolid { axis, .. }) => {
            motion.angular_velocity.cross(*axis).length()
        }
        _ => motion.angular_velocity.length(),
    }
}
