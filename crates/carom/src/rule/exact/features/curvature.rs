//! The curvature of a contact's normal.

use glam::DVec3;

use super::separation::{are_within, is_over_face};
use crate::band::{Band, View};
use crate::detect::Separation;
use crate::mesh::Placement;
use crate::norm::Norm;
use crate::surface::Form;

/// How the normal of a contact turns when the bodies slide along each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum NormalCurvature {
    /// A plane, without curvature.
    Flat,
    /// Curvature about a point, this far from the centre of body 2 \[m\].
    RoundFeature(f64),
    /// Curvature about an edge in this direction, this far from the centre of body 2 \[m\].
    Edge(DVec3, f64),
    /// Second derivatives of the gap along two unit vectors across the normal \[1/m\]: negative
    /// where the surface is hollow.
    Principal { directions: [DVec3; 2], curvatures: [f64; 2] },
}

impl NormalCurvature {
    /// Velocity along which the normal turns, and the distance about which it does.
    pub fn turning(&self, tangential: DVec3) -> Option<(DVec3, f64)> {
        match *self {
            Self::Flat => None,
            Self::RoundFeature(distance) => Some((tangential, distance)),
            Self::Edge(direction, distance) => {
                Some((tangential - tangential.dot(direction) * direction, distance))
            }
            Self::Principal { directions, curvatures } => {
                let parts: [DVec3; 2] = std::array::from_fn(|number| {
                    let turns = curvatures[number] != 0.0;
                    let part = tangential.dot(directions[number]) * directions[number];
                    if turns { part } else { DVec3::ZERO }
                });
                let velocity = parts[0] + parts[1];
                let sharpest = curvatures[0].abs().max(curvatures[1].abs()).recip();
                let rate = self.rate(tangential).norm();
                Some((velocity, if rate > 0.0 { velocity.norm() / rate } else { sharpest }))
            }
        }
    }

    /// The same on a surface that is turned.
    pub fn turned(self, placement: &Placement) -> Self {
        let turn = |direction: DVec3| placement.direction(direction);
        match self {
            Self::Flat | Self::RoundFeature(_) => self,
            Self::Edge(direction, distance) => Self::Edge(turn(direction), distance),
            Self::Principal { directions, curvatures } => {
                Self::Principal { directions: directions.map(turn), curvatures }
            }
        }
    }

    /// How fast the normal turns by this velocity \[rad/s\].
    pub fn rate(&self, tangential: DVec3) -> DVec3 {
        match *self {
            Self::Principal { directions, curvatures } => {
                let along = |number: usize| {
                    let speed = tangential.dot(directions[number]);
                    speed * curvatures[number] * directions[number]
                };
                along(0) + along(1)
            }
            _ => self.turning(tangential).map_or(DVec3::ZERO, |(part, distance)| part / distance),
        }
    }

    /// Second derivative of the gap \[m/s²\] by this velocity.
    pub fn acceleration(&self, tangential: DVec3) -> f64 {
        match *self {
            Self::Principal { directions, curvatures } => {
                let along = |number: usize| {
                    let speed = tangential.dot(directions[number]);
                    speed * speed * curvatures[number]
                };
                along(0) + along(1)
            }
            _ => self
                .turning(tangential)
                .map_or(0.0, |(part, distance)| part.length_squared() / distance),
        }
    }
}

/// How the normal turns where a sphere about `center` \[m\] touches a surface, with a velocity relative to
/// it \[m/s\].
pub(crate) fn curvature_of(
    form: &Form,
    [center, velocity]: [DVec3; 2],
    separation: &Separation,
) -> NormalCurvature {
    let distance = (center - separation.point).norm();
    match form {
        Form::Sphere { center: fixed, .. } => {
            NormalCurvature::RoundFeature((center - *fixed).norm())
        }
        Form::HalfSpace { .. }
        | Form::Box(_)
        | Form::Round(_)
        | Form::Closed(_)
        | Form::Facet(_) => NormalCurvature::Flat,
        Form::Band(band) => curvature_of_band(band, [center, velocity]),
        Form::Edge(edge) => NormalCurvature::Edge(edge.axis, distance),
        Form::Corner(_) => NormalCurvature::RoundFeature(distance),
        Form::Rectangle(rectangle) => match are_within(rectangle, [center, velocity]) {
            [true, true] => NormalCurvature::Flat,
            [false, true] => NormalCurvature::Edge(rectangle.axis_z, distance),
            [true, false] => NormalCurvature::Edge(rectangle.axis_x, distance),
            [false, false] => NormalCurvature::RoundFeature(distance),
        },
    }
}

fn curvature_of_band(band: &Band, state: [DVec3; 2]) -> NormalCurvature {
    let is_over = is_over_face(band, state);
    if is_over && band.flat_normal().is_some() {
        return NormalCurvature::Flat;
    }
    let view = if is_over { band.face_seen_from(state[0]) } else { band.rim_seen_from(state[0]) };
    let View { directions, curvatures, .. } = view;
    NormalCurvature::Principal { directions, curvatures }
}
