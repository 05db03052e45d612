//! Situations with a contact planted at a known time: hits, near misses, grazes within rounding,
//! starts in contact.

use glam::{DVec2, DVec3};

use super::situation::{Bodies, Situation};
use crate::band::{Band, Profile};
use crate::flight::{Flight, Propagator};
use crate::surface::SurfaceMotion;
use crate::surface::{Form, Rectangle};

/// Numbers in [0, 1), the same in every run: SplitMix64 (Steele, Lea, Flood 2014).
pub struct Numbers(pub u64);

impl Numbers {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// 10 to a power in this range.
    pub fn decade(&mut self, low: f64, high: f64) -> f64 {
        libm::exp10(self.between(low, high))
    }

    pub fn one_in(&mut self, count: u64) -> bool {
        self.bits().is_multiple_of(count)
    }

    pub fn direction(&mut self) -> DVec3 {
        loop {
            let v = DVec3::from_array(std::array::from_fn(|_| self.between(-1.0, 1.0)));
            if (0.1..1.0).contains(&v.length()) {
                return v.normalize();
            }
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Spheres,
    Sphere,
    HalfSpace,
    Rectangle,
    /// A line or an arc about an axis.
    Band,
}

/// Whether paths are parabolas and surfaces do not turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Air {
    None,
    Drag,
}

/// Scales of one situation.
struct Scales {
    /// Scale of radii and sizes \[m\].
    length: f64,
    /// Scale of the relative motion \[m/s\].
    speed: f64,
    /// When the planted contact is \[s\].
    time: f64,
}

/// Centre and velocity, relative to an obstacle at rest, at the planted time.
struct Planted {
    point: DVec3,
    normal: DVec3,
}

pub fn situation(numbers: &mut Numbers, kind: Kind, air: Air, turns: bool) -> Situation {
    let scales = scales(numbers);
    let time = scales.time;
    let bodies = if kind == Kind::Spheres {
        spheres(numbers, &scales, air)
    } else {
        surface(numbers, &scales, kind, air, turns)
    };
    let longest = if time > 0.0 { time } else { scales.length / scales.speed };
    let horizon = match numbers.bits() % 4 {
        0 if !turns => f64::INFINITY,
        0 | 1 => 1.001 * time,
        2 => longest * numbers.decade(-1.0, 1.5),
        _ => 3.0 * longest,
    };
    Situation { bodies, horizon }
}

fn scales(numbers: &mut Numbers) -> Scales {
    let length = numbers.decade(-3.0, 3.0);
    let speed = numbers.decade(-6.0, 8.0);
    let travelled = length * numbers.decade(-2.0, 4.0);
    let time = if numbers.one_in(4) { 0.0 } else { travelled / speed };
    Scales { length, speed, time }
}

fn spheres(numbers: &mut Numbers, scales: &Scales, air: Air) -> Bodies {
    let radius_sum = scales.length * (1.0 + numbers.decade(-3.0, 0.0));
    let normal = numbers.direction();
    let planted = Planted { point: DVec3::ZERO, normal };
    let (offset, velocity) = approach(numbers, scales, &planted, radius_sum);
    let place = if numbers.one_in(3) { DVec3::ZERO } else { far_place(numbers, scales) };
    let drift = scales.speed * numbers.decade(-3.0, 1.0) * numbers.direction();
    let (a, g) = (acceleration(numbers, scales), drag_rate(numbers, scales, air));
    let (a2, g2) = match numbers.bits() % 3 {
        0 => (a, g),
        1 => (acceleration(numbers, scales), g),
        _ => (acceleration(numbers, scales), drag_rate(numbers, scales, air)),
    };
    let first = rewound(scales.time, place, drift, a, g);
    let second = rewound(scales.time, place + offset, drift + velocity, a2, g2);
    Bodies::Spheres { first, second, radius_sum }
}

fn surface(numbers: &mut Numbers, scales: &Scales, kind: Kind, air: Air, turns: bool) -> Bodies {
    let radius = scales.length * numbers.decade(-3.0, 0.0);
    let place = if numbers.one_in(2) { DVec3::ZERO } else { far_place(numbers, scales) };
    let (form, planted) = form(numbers, scales, kind, place);
    let radius = radius.min(widest_inside(&form));
    let (center, relative) = approach(numbers, scales, &planted, radius);
    let motion = motion(numbers, scales, place, turns);
    let (omega, t) = (motion.angular_velocity, scales.time);
    let turn = |v: DVec3| {
        let rate = omega.length();
        if rate == 0.0 { v } else { glam::DQuat::from_axis_angle(omega / rate, rate * t) * v }
    };
    let arm = turn(center - motion.origin);
    let x = motion.origin + t * motion.velocity + arm;
    let v = motion.velocity + turn(relative) + omega.cross(arm);
    let (a, g) = (acceleration(numbers, scales), drag_rate(numbers, scales, air));
    Bodies::Surface { flight: rewound(t, x, v, a, g), radius, form, motion }
}

fn motion(numbers: &mut Numbers, scales: &Scales, place: DVec3, turns: bool) -> SurfaceMotion {
    let moves = turns || numbers.one_in(3);
    let speed = if moves { scales.speed * numbers.decade(-3.0, 1.0) } else { 0.0 };
    let velocity = speed * numbers.direction();
    let period = if scales.time > 0.0 { scales.time } else { scales.length / scales.speed };
    let rate = if turns { numbers.decade(-2.0, 1.3) / period } else { 0.0 };
    let arm = if numbers.one_in(3) { 0.0 } else { scales.length * numbers.between(0.0, 2.0) };
    let origin = place + arm * numbers.direction();
    let axis = if numbers.one_in(3) { DVec3::Y } else { numbers.direction() };
    SurfaceMotion { origin, velocity, angular_velocity: rate * axis, ..SurfaceMotion::REST }
}

/// A surface and a point on it, with a normal there.
fn form(numbers: &mut Numbers, scales: &Scales, kind: Kind, place: DVec3) -> (Form, Planted) {
    let normal = if numbers.one_in(3) { DVec3::Y } else { numbers.direction() };
    let (axis_x, axis_z) = normal.any_orthonormal_pair();
    let length = scales.length;
    let mut sideways = |half: f64| half * numbers.between(-1.0, 1.0);
    match kind {
        Kind::Spheres | Kind::Sphere => {
            let radius = length * numbers.decade(-3.0, 0.0);
            let point = place + radius * normal;
            (Form::Sphere { center: place, radius }, Planted { point, normal })
        }
        Kind::HalfSpace => {
            let point = place + sideways(length) * axis_x + sideways(length) * axis_z;
            (Form::HalfSpace { point: place, normal }, Planted { point, normal })
        }
        Kind::Rectangle => {
            let (half_x, half_z) = (length * numbers.decade(-1.0, 0.0), length);
            let (center, is_open) = (place, false);
            let rectangle = Rectangle { center, axis_x, axis_z, normal, half_x, half_z, is_open };
            // On the face, an edge or a corner.
            let mut feature = |half: f64| match numbers.bits() % 4 {
                0 => (half, numbers.between(0.0, 1.0)),
                1 => (-half, -numbers.between(0.0, 1.0)),
                _ => (half * numbers.between(-1.0, 1.0), 0.0),
            };
            let ((x, out_x), (z, out_z)) = (feature(half_x), feature(half_z));
            let up = if out_x == 0.0 && out_z == 0.0 { 1.0 } else { numbers.between(0.0, 1.0) };
            let normal = (out_x * axis_x + out_z * axis_z + up * normal).normalize();
            let point = place + x * axis_x + z * axis_z;
            (Form::Rectangle(rectangle), Planted { point, normal })
        }
        Kind::Band => band(numbers, length, place, normal),
    }
}

/// Radius \[m\] of a sphere that never touches a surface of revolution on two sides at once.
fn widest_inside(form: &Form) -> f64 {
    let Form::Band(Band { profile, .. }) = form else { return f64::INFINITY };
    let ends = profile.ends().map(|end| end.x).into_iter().filter(|&x| x > 0.0);
    let rim = ends.fold(f64::INFINITY, f64::min);
    match *profile {
        Profile::Line { direction, .. } if direction.y <= 0.0 && direction.x == 0.0 => {
            f64::INFINITY
        }
        Profile::Line { direction, .. } if direction.y == 0.0 => f64::INFINITY,
        Profile::Arc { center, radius, .. } if center.x > 0.0 => 0.5 * (center.x - radius),
        Profile::Arc { radius, .. } => 0.5 * radius.min(rim),
        Profile::Line { .. } => 0.5 * rim,
    }
}

/// A surface of revolution about an axis, and a point on its face or a rim, with a normal there.
fn band(numbers: &mut Numbers, length: f64, place: DVec3, axis: DVec3) -> (Form, Planted) {
    let (x, z) = axis.any_orthonormal_pair();
    let angle = numbers.between(0.0, std::f64::consts::TAU);
    let radial = libm::cos(angle) * x + libm::sin(angle) * z;
    let part = numbers.between(0.0, 1.0);
    let profile = profile(numbers, length);
    let ends = profile.ends();
    let (inner, normal) = match profile {
        Profile::Line { from, direction, length, .. } => {
            let end = numbers.bits() % 4;
            let along = if end < 2 { end as f64 } else { part };
            let face = DVec2::new(-direction.y, direction.x);
            let out = [-direction, direction][(end % 2) as usize];
            let lean = if end < 2 { numbers.between(0.0, 1.0) } else { 0.0 };
            let rim = [ends[0].x, ends[1].x][(end % 2) as usize];
            let is_point = end < 2 && rim == 0.0 && direction.y == 0.0;
            let lean = if is_point { 0.0 } else { lean };
            (from + along * length * direction, (face + lean * out).normalize())
        }
        Profile::Arc { center, radius, ends, is_hollow } => {
            let turn = if ends[0] == ends[1] {
                DVec2::from_angle(numbers.between(0.0, std::f64::consts::TAU))
            } else {
                (ends[0] + part * (ends[1] - ends[0]) + DVec2::X * 1e-3).normalize()
            };
            (center + radius * turn, if is_hollow { -turn } else { turn })
        }
    };
    let thickness = match profile {
        Profile::Line { thickness, .. } => thickness,
        Profile::Arc { .. } => 0.0,
    };
    let foot = inner + thickness * normal;
    let world = |vector: DVec2| vector.x * radial + vector.y * axis;
    let band = Band { center: place, axis, profile, is_open: false };
    (Form::Band(band), Planted { point: place + world(foot), normal: world(normal) })
}

fn profile(numbers: &mut Numbers, length: f64) -> Profile {
    let radius = length * numbers.decade(-2.0, 0.0);
    let half = length * numbers.decade(-2.0, 0.0);
    let line = |a: [f64; 2], b: [f64; 2]| Profile::line(a.into(), b.into());
    let profile = match numbers.bits() % 6 {
        0 => line([radius, half], [radius, -half]),
        1 => line([radius * numbers.between(0.0, 1.0), half], [radius, -half]),
        2 => line([0.0, half], [radius, half]),
        3 => Profile::Line {
            from: DVec2::new(0.0, half),
            direction: DVec2::NEG_Y,
            length: 2.0 * half,
            thickness: radius,
        },
        4 => {
            let opening = numbers.between(0.0, 3.0);
            let rim = DVec2::new(libm::sin(opening), libm::cos(opening));
            let (center, ends) = (DVec2::ZERO, [DVec2::NEG_Y, rim]);
            Profile::Arc { center, radius, ends, is_hollow: false }
        }
        _ => {
            let (center, ends) = (DVec2::new(length, 0.0), [DVec2::X; 2]);
            return Profile::Arc { center, radius: 0.9 * radius, ends, is_hollow: false };
        }
    };
    let is_capsule = matches!(profile, Profile::Line { thickness, .. } if thickness > 0.0);
    if !is_capsule && numbers.one_in(2) { profile.turned() } else { profile }
}

/// Centre and relative velocity of a sphere at the planted contact: hit, graze, near graze or
/// opening.
fn approach(
    numbers: &mut Numbers,
    scales: &Scales,
    planted: &Planted,
    reach: f64,
) -> (DVec3, DVec3) {
    let Planted { point, normal } = *planted;
    let off = match numbers.bits() % 6 {
        0 => numbers.decade(-16.0, -10.0),
        1 => -numbers.decade(-16.0, -10.0),
        2 => numbers.decade(-10.0, -1.0),
        3 => -numbers.decade(-10.0, -1.0),
        _ => 0.0,
    };
    let center = point + reach * normal * (1.0 + off);
    let across = numbers.direction().cross(normal).normalize();
    let closing = match numbers.bits() % 6 {
        0 => 0.0,
        1 => numbers.decade(-17.0, -12.0),
        2 => numbers.decade(-12.0, -2.0),
        3 => -numbers.decade(-12.0, 0.0),
        _ => numbers.between(0.0, 2.0),
    };
    let sliding = if numbers.one_in(8) { 0.0 } else { 1.0 };
    (center, scales.speed * (sliding * across - closing * normal))
}

fn far_place(numbers: &mut Numbers, scales: &Scales) -> DVec3 {
    scales.length * numbers.decade(-1.0, 4.0) * numbers.direction()
}

fn acceleration(numbers: &mut Numbers, scales: &Scales) -> DVec3 {
    if numbers.one_in(4) {
        return DVec3::ZERO;
    }
    let turn_back = if scales.time > 0.0 { scales.speed / scales.time } else { 9.81 };
    turn_back * numbers.decade(-4.0, 1.0) * numbers.direction()
}

fn drag_rate(numbers: &mut Numbers, scales: &Scales, air: Air) -> f64 {
    // Beyond, a rewound flight started astronomically fast.
    const MOST_SPENT: f64 = 8.0;
    if air == Air::None {
        return 0.0;
    }
    let rate = numbers.decade(-12.0, 3.0);
    if rate * scales.time > MOST_SPENT {
        numbers.between(0.0, MOST_SPENT) / scales.time
    } else {
        rate
    }
}

/// The flight that is at a place with a velocity at a time.
fn rewound(t: f64, x: DVec3, v: DVec3, acceleration: DVec3, drag_rate: f64) -> Flight {
    let Propagator { decay, drift, fall } = Propagator::over(t, drag_rate);
    let velocity = (v - drift * acceleration) / decay;
    let position = x - (drift * velocity + fall * acceleration);
    Flight { position, velocity, acceleration, drag_rate }
}
