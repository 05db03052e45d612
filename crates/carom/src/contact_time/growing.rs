//! Contact of spheres whose radii grow.

use glam::DVec3;

use super::nearest::Feature;
use super::obstacle::Obstacle;
use super::path::{Path, State};
use super::roundoff::{DISTANCE_ROUNDOFF, Magnitudes, SPEED_ROUNDOFF};
use super::search::{self, time_to_fall};
use super::sphere_surface::size_of;
use crate::flight::Flight;
use crate::norm::Norm;
use crate::real::{Real, Vector};
use crate::surface::Form;

/// Time \[s\] at which two spheres come into contact whose relative velocity is constant, while the sum of
/// their radii grows steadily.
///
/// First root of `|r + v t| = R + G t` at which they close, in a form without cancellation:
///
/// ```text
/// b = r·v - R G    A = v² - G²    c = (|r| - R)(|r| + R)    D = b² - A c = |R v - G r|² - |r × v|²
/// t = c / (-b + √D)  for b < 0        t = (b + √D) / -A  for b >= 0 and A < 0
/// ```
///
/// The second case is that of spheres that part, and are overtaken by their growth. Without growth this is
/// [`sphere_sphere_linear`](super::sphere_sphere_linear). `None` if they miss, or touch with a closing speed that is
/// zero but for rounding.
///
/// Source: Lubachevsky and Stillinger, J. Stat. Phys. 60, 561 (1990); Press et al., *Numerical Recipes* (2007), 5.6.
///
/// - `offset` r = x2 - x1 \[m\], `relative_velocity` v = v2 - v1 \[m/s\]
/// - `radius_sum` R at time 0 \[m\], > 0; `growth_speed` G of that sum \[m/s\], >= 0
pub fn sphere_sphere_growing(
    offset: DVec3,
    relative_velocity: DVec3,
    radius_sum: f64,
    growth_speed: f64,
) -> Option<f64> {
    let (r, v) = (offset.into(), relative_velocity.into());
    let approach = GrowingApproach::of(r, v, radius_sum, growth_speed);
    let distance = offset.norm();
    let gap = distance - radius_sum;
    let speed = relative_velocity.norm() + growth_speed;
    let touches = gap <= DISTANCE_ROUNDOFF * radius_sum;
    let rounding = if touches { SPEED_ROUNDOFF * distance * speed } else { 0.0 };
    if approach.discriminant >= 0.0 && approach.closing < -rounding {
        return Some(approach.time(gap.max(0.0), distance + radius_sum));
    }
    if approach.closing < 0.0 {
        return None;
    }
    // Where growth is as fast as the spheres but for rounding, they do not come back.
    let is_overtaken = approach.curvature < -SPEED_ROUNDOFF * speed * speed;
    (is_overtaken && approach.discriminant >= 0.0).then(|| approach.late_time())
}

/// How two spheres come near each other whose radii grow; of one pair, or of several side by side.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GrowingApproach<N> {
    /// b of [`sphere_sphere_growing`] \[m²/s\], negative where they close.
    pub closing: N,
    /// A there \[m²/s²\].
    pub curvature: N,
    /// D there \[m⁴/s²\].
    pub discriminant: N,
}

impl<N: Real> GrowingApproach<N> {
    /// Prepares the equation from the offset r \[m\] and the relative velocity v \[m/s\], for
    /// spheres whose radii have the sum R \[m\], which grows at the speed G \[m/s\].
    #[inline(always)]
    pub fn of(r: Vector<N>, v: Vector<N>, radius_sum: N, growth_speed: N) -> Self {
        let along = v * radius_sum - r * growth_speed;
        Self {
            closing: r.dot(v) - radius_sum * growth_speed,
            curvature: v.dot(v) - growth_speed * growth_speed,
            discriminant: along.length_squared() - r.cross(v).length_squared(),
        }
    }

    /// When they meet that close \[s\], from |r| - R and |r| + R \[m\].
    #[inline(always)]
    pub fn time(&self, gap: N, sum: N) -> N {
        gap * sum / (self.discriminant.sqrt() - self.closing)
    }

    /// When growth overtakes those that part \[s\].
    #[inline(always)]
    pub fn late_time(&self) -> N {
        (self.discriminant.sqrt() + self.closing) / (self.curvature * -1.0)
    }
}

/// Time \[s\] at which a sphere whose radius grows, in straight flight, comes into contact with a surface at rest.
///
/// - `radius` at time 0 \[m\], > 0; `growth_speed` of it \[m/s\], >= 0; `horizon` \[s\], may be infinite
/// - returns \[s\] in `[0, horizon]`; `None` if there is no contact
pub(crate) fn growing_sphere_surface(
    flight: &Flight,
    [radius, growth_speed]: [f64; 2],
    form: &Form,
    horizon: f64,
) -> Option<f64> {
    let growing = Magnitudes { speed: growth_speed, ..size_of(form, radius) };
    let size = Magnitudes::of(flight) + growing;
    let obstacle = match *form {
        Form::Sphere { center, radius: own } => {
            let offset = flight.position - center;
            let time = sphere_sphere_growing(offset, flight.velocity, own + radius, growth_speed)?;
            return (time <= horizon).then_some(time);
        }
        Form::HalfSpace { point, normal } => {
            let distance = (flight.position - point).dot(normal) - radius;
            let speed = flight.velocity.dot(normal) - growth_speed;
            let closes = speed < -SPEED_ROUNDOFF * size.speed;
            let touches = distance <= DISTANCE_ROUNDOFF * size.length;
            return match (touches, closes) {
                (true, true) => Some(0.0),
                (true, false) => None,
                (false, _) => Some(time_to_fall(distance, speed, 0.0))
                    .filter(|&t| t.is_finite() && t <= horizon),
            };
        }
        Form::Rectangle(rectangle) => Obstacle::Rectangle { rectangle, radius },
        Form::Band(band) => Obstacle::Band { band, radius },
        Form::Facet(_) | Form::Edge(_) | Form::Corner(_) => {
            let path = GrowingFlight { flight: *flight, growth_speed };
            let feature = Feature { form, origin: DVec3::ZERO, radius, size };
            let time = search::first_contact(&path, &feature.obstacle()?, size, horizon)?;
            return feature.first_nearest(&path, time, horizon);
        }
        Form::Box(_) | Form::Round(_) | Form::Closed(_) => return None,
    };
    let path = GrowingFlight { flight: *flight, growth_speed };
    search::first_contact(&path, &obstacle, size, horizon)
}

/// The flight of a sphere whose radius grows.
#[derive(Debug, Clone, Copy)]
struct GrowingFlight {
    flight: Flight,
    /// \[m/s\]
    growth_speed: f64,
}

impl Path for GrowingFlight {
    fn state_at(&self, t: f64) -> State {
        let state = self.flight.state_at(t);
        let growing = Magnitudes { length: self.growth_speed * t, ..Magnitudes::of_length(0.0) };
        State { size: state.size + growing, ..state }
    }

    fn max_acceleration(&self, direction: DVec3, from: f64, to: f64) -> f64 {
        self.flight.max_acceleration(direction, from, to)
    }

    fn max_acceleration_anywhere(&self, from: f64, to: f64) -> f64 {
        self.flight.max_acceleration_anywhere(from, to)
    }

    fn growth_speed(&self) -> f64 {
        self.growth_speed
    }
}
