//! Contacts of balls with colliders, and their response: `OnCollision` of the course.

use carom::DVec3;
use serde::Serialize;

use crate::course::Form;
use crate::mistake::{Mistake, Mistakes};
use crate::real::{Real, Vec3};

/// Part of a collider that a ball touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ContactKind {
    /// The inside of a plane.
    Face,
    /// An edge of a plane.
    Edge,
    /// A corner of a plane.
    Corner,
    /// A fixed sphere.
    Sphere,
}

impl std::fmt::Display for ContactKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Face => "face",
            Self::Edge => "edge",
            Self::Corner => "corner",
            Self::Sphere => "sphere",
        })
    }
}

/// A collider in the number type of the program.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surface<N> {
    center: Vec3<N>,
    axes: [Vec3<N>; 3],
    extent: Extent<N>,
}

#[derive(Debug, Clone, Copy)]
enum Extent<N> {
    /// Radius \[m\].
    Sphere(N),
    /// Half lengths along the first and third axis \[m\].
    Rectangle([N; 2]),
}

/// A contact that the program detects.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Contact<N> {
    pub kind: ContactKind,
    /// Unit vector from the collider to the ball, in world coordinates.
    pub normal: Vec3<N>,
    /// Position \[m\] to which the program moves the ball if it answers the contact.
    pub place: Option<Vec3<N>>,
}

impl<N: Real> Surface<N> {
    /// Creates a collider as a program with these mistakes stores it.
    pub fn of(form: &Form, mistakes: Mistakes) -> Self {
        let vectors = |axes: [DVec3; 3]| axes.map(Vec3::of);
        match *form {
            Form::Sphere { center, radius, axes } => Self {
                center: Vec3::of(center),
                axes: vectors(axes),
                extent: Extent::Sphere(N::of(radius)),
            },
            Form::Rectangle { center, axes, half } => Self {
                center: Vec3::of(center),
                axes: vectors(axes),
                extent: Extent::Rectangle(extent(half, mistakes).map(N::of)),
            },
        }
    }

    /// Finds the contact with a ball at `position` \[m\] for a program with these mistakes, which
    /// takes `radius` \[m\] as its radius.
    pub fn contact(&self, position: Vec3<N>, radius: N, mistakes: Mistakes) -> Option<Contact<N>> {
        match self.extent {
            Extent::Sphere(own) => self.sphere_contact(position, [own, radius], mistakes),
            Extent::Rectangle(half) => self.rectangle_contact(half, position, radius, mistakes),
        }
    }

    fn sphere_contact(
        &self,
        position: Vec3<N>,
        [own, radius]: [N; 2],
        mistakes: Mistakes,
    ) -> Option<Contact<N>> {
        let offset = position - self.center;
        let length = offset.length();
        let is_at_centre = length <= N::of(0.0);
        let normal = if is_at_centre { Vec3::of(DVec3::Y) } else { offset / length };
        let place =
            mistakes.has(Mistake::OnTopOfSpheres).then(|| self.center + normal * (own + radius));
        let touches = length - (own + radius) < N::of(0.0);
        touches.then_some(Contact { kind: ContactKind::Sphere, normal, place })
    }

    fn rectangle_contact(
        &self,
        half: [N; 2],
        position: Vec3<N>,
        radius: N,
        mistakes: Mistakes,
    ) -> Option<Contact<N>> {
        let zero = N::of(0.0);
        let [axis_x, up, axis_z] = self.axes;
        let offset = position - self.center;
        let height = offset.dot(up);
        let is_underneath = height < zero;
        if is_underneath && !mistakes.has(Mistake::FromUnderneath) {
            return None;
        }
        let local = [offset.dot(axis_x), offset.dot(axis_z)];
        let nearest = [clamped(local[0], half[0]), clamped(local[1], half[1])];
        let point = self.center + axis_x * nearest[0] + axis_z * nearest[1];
        let beyond = [nearest[0] != local[0], nearest[1] != local[1]];
        let (kind, normal, distance) = if beyond == [false, false] {
            let distance = if is_underneath { -height } else { height };
            (ContactKind::Face, up, distance)
        } else {
            if mistakes.has(Mistake::EdgesIgnored) {
                return None;
            }
            let from_point = position - point;
            let length = from_point.length();
            let normal = if length > zero { from_point / length } else { up };
            let is_corner = beyond == [true, true];
            let kind = if is_corner { ContactKind::Corner } else { ContactKind::Edge };
            (kind, edge_normal(normal, up, offset, mistakes), length)
        };
        let place = (!mistakes.has(Mistake::NotOnTop)).then(|| point + normal * radius);
        (distance - radius <= zero).then_some(Contact { kind, normal, place })
    }

    /// Converts a vector from world coordinates to those of the collider.
    fn to_local(self, vector: Vec3<N>) -> Vec3<N> {
        let [x, y, z] = self.axes.map(|axis| vector.dot(axis));
        Vec3::new(x, y, z)
    }

    /// Velocity \[m/s\] after the contact; `None` if the program does not answer it.
    pub fn response(
        &self,
        contact: &Contact<N>,
        velocity: Vec3<N>,
        restitution: N,
        mistakes: Mistakes,
    ) -> Option<Vec3<N>> {
        let is_entering = velocity.dot(contact.normal) < N::of(0.0);
        if !is_entering && !mistakes.has(Mistake::NoEnteringTest) {
            return None;
        }
        let is_local = mistakes.has(Mistake::NormalNotTransformed);
        let normal = if is_local { self.to_local(contact.normal) } else { contact.normal };
        let after = bounced(velocity, normal, restitution, mistakes);
        let stays_local = mistakes.has(Mistake::VelocityNotTransformed);
        Some(if stays_local { self.to_local(after) } else { after })
    }
}

/// Half lengths of a plane for a program with these mistakes.
fn extent([x, z]: [f64; 2], mistakes: Mistakes) -> [f64; 2] {
    if mistakes.has(Mistake::ExtentIgnored) {
        [f64::INFINITY; 2]
    } else if mistakes.has(Mistake::ExtentSwapped) {
        [z, x]
    } else if mistakes.has(Mistake::ExtentDoubled) {
        [2.0 * x, 2.0 * z]
    } else {
        [x, z]
    }
}

fn clamped<N: Real>(value: N, half: N) -> N {
    if value < -half {
        -half
    } else if value > half {
        half
    } else {
        value
    }
}

/// Normal at an edge or corner. `normal` is the correct one; `offset` points from the middle of the
/// plane to the ball.
fn edge_normal<N: Real>(
    normal: Vec3<N>,
    up: Vec3<N>,
    offset: Vec3<N>,
    mistakes: Mistakes,
) -> Vec3<N> {
    if mistakes.has(Mistake::EdgeNormalOfPlane) {
        up
    } else if mistakes.has(Mistake::EdgeNormalFromCentre) {
        offset / offset.length()
    } else {
        normal
    }
}

/// Velocity after a bounce: `v' = v - (1 + e) (v.n) n`, or its variant with a mistake.
fn bounced<N: Real>(v: Vec3<N>, n: Vec3<N>, e: N, mistakes: Mistakes) -> Vec3<N> {
    let (one, two) = (N::of(1.0), N::of(2.0));
    let along = v.dot(n);
    if mistakes.has(Mistake::RestitutionOfWhole) {
        return (v - n * (two * along)) * e;
    }
    if mistakes.has(Mistake::VelocityReversed) {
        return v * -e;
    }
    if mistakes.has(Mistake::OneForgotten) {
        return v - n * (e * along);
    }
    let e = if mistakes.has(Mistake::RestitutionSqrt) {
        e.sqrt()
    } else if mistakes.has(Mistake::RestitutionSquared) {
        e * e
    } else if mistakes.has(Mistake::RestitutionIgnored) {
        one
    } else {
        e
    };
    v + n * (-(one + e) * along)
}
