//! When a contact begins, by bisection.

/// What a bisection sees at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Probe {
    /// No contact yet: it begins later.
    Before,
    /// The contact begins exactly here.
    At,
    /// Already intersecting: it began earlier.
    After,
}

/// Where a bisection ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bisection {
    /// The instant probed last \[s\].
    pub time: f64,
    /// What was seen there. Unless it is [`Probe::At`], the contact is at most `h / 2^n` away.
    pub last: Probe,
}

/// Time of the first contact in `(0, h]`, given that the bodies intersect at `h`.
///
/// Halves the interval at most `max_halvings` (n) times; the error is at most `h / 2^n`.
/// Source: the tutorial's `GetTimeOfIntersection`; `docs/physics.md`, "Time of contact".
///
/// - `h` \[s\], > 0; `max_halvings` >= 1
/// - `probe` tells what is there at a time \[s\] in `(0, h)`
pub fn bisect(h: f64, max_halvings: u32, mut probe: impl FnMut(f64) -> Probe) -> Bisection {
    let (mut floor, mut ceiling) = (0.0, h);
    let mut found = Bisection { time: h, last: Probe::After };
    for _ in 0..max_halvings {
        let time = floor + 0.5 * (ceiling - floor);
        if time == floor || time == ceiling {
            // Numbers are not dense enough for another halving.
            break;
        }
        found = Bisection { time, last: probe(time) };
        match found.last {
            Probe::At => break,
            Probe::Before => floor = time,
            Probe::After => ceiling = time,
        }
    }
    found
}

pub fn sphere_sphere_linear(r: glam::DVec3, v: glam::DVec3, radius_sum: f64) -> Option<f64> {
    let b = r.dot(v);
    if b >= 0.0 {
        return None;
    }
    let a = v.length_squared();
    let disc = a * radius_sum * radius_sum - r.cross(v).length_squared();
    if disc < 0.0 {
        return None;
    }
    let length = r.length();
    let c = ((length - radius_sum) * (length + radius_sum)).max(0.0);
    Some(c / (-b + disc.sqrt()))
}
use crate::flight::Flight;
pub fn sphere_sphere(_a: &Flight, _b: &Flight, _r: f64, _h: f64) -> Option<f64> {
    None
}
pub(crate) fn sphere_surface(
    f: &Flight,
    radius: f64,
    form: &crate::surface::Form,
    _m: &crate::surface::SurfaceMotion,
    _h: f64,
) -> Option<f64> {
    if let crate::surface::Form::HalfSpace { point, normal } = form {
        let g = (f.position - *point).dot(*normal) - radius;
        let v = f.velocity.dot(*normal);
        let a = f.acceleration.dot(*normal);
        let g = if g.abs() < 1e-13 { 0.0 } else { g };
        if a == 0.0 {
            return if v < 0.0 { Some((-g / v).max(0.0)) } else { None };
        }
        if g == 0.0 {
            return if v < -1e-15 {
                Some(0.0)
            } else if a < 0.0 {
                Some(2.0 * v.max(0.0) / -a)
            } else {
                None
            };
        }
        let d = v * v - 2.0 * a * g;
        if d < 0.0 {
            return None;
        }
        let d = d.sqrt();
        let t = if a < 0.0 {
            (-v - d) / a
        } else {
            if v < 0.0 { 2.0 * g / (-v + d) } else { return None }
        };
        return if t >= 0.0 { Some(t) } else { None };
    }
    None
}
