//! Flat faces of a mesh, without their edges.

use glam::{DVec2, DVec3};

use super::outline::{Outline, Side};
use crate::axis_motion::AlongAxis;
use crate::norm::Norm;
use crate::rectangle::Rectangle;

/// A flat face, which counts for points on its front side that project into its outline.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Facet {
    /// Bounding rectangle of the outline, which defines the coordinates in the plane.
    pub frame: Rectangle,
    pub outline: Outline,
}

impl Facet {
    /// Creates a face that fills a rectangle.
    pub fn of_rectangle(frame: Rectangle) -> Self {
        let half = DVec2::new(frame.half_x, frame.half_z);
        let [a, b, c, d] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|corner| half * DVec2::from_array(corner));
        let sides = vec![
            Side::new([a, b], DVec2::NEG_Y),
            Side::new([b, c], DVec2::X),
            Side::new([c, d], DVec2::Y),
            Side::new([d, a], DVec2::NEG_X),
        ];
        Self { frame, outline: Outline::new(sides, vec![[a, b, c], [a, c, d]]) }
    }

    /// Returns the same face, met from the other side.
    pub fn turned(&self) -> Self {
        let frame = Rectangle { normal: -self.frame.normal, ..self.frame };
        Self { frame, outline: self.outline.clone() }
    }

    /// Returns the height of a point above the plane \[m\].
    pub fn height_of(&self, point: DVec3) -> f64 {
        (point - self.frame.center).dot(self.frame.normal)
    }

    /// Returns whether a centre \[m\] projects into the outline, up to rounding.
    pub fn is_under(&self, center: DVec3) -> bool {
        let (place, slack) = (self.local(center), self.slack(center));
        self.is_in_frame(place, 2.0 * slack) && self.outline.is_within(place, slack)
    }

    /// Returns whether a place in the plane \[m\] is in the bounding rectangle, or at most this far \[m\] outside.
    fn is_in_frame(&self, place: DVec2, slack: f64) -> bool {
        let Rectangle { half_x, half_z, .. } = self.frame;
        place.x.abs() <= half_x + slack && place.y.abs() <= half_z + slack
    }

    /// Returns whether a centre may come to project into the outline from the front, or from behind within a `radius`
    /// \[m\], once it has moved by a distance `way` \[m\].
    pub fn may_be_met(&self, center: DVec3, radius: f64, way: f64) -> bool {
        let height = self.height_of(center);
        let place = self.local(center);
        (-radius - way <= height && height <= radius + way)
            && self.is_in_frame(place, way)
            && self.outline.is_within(place, way)
    }

    /// Returns whether a sphere with this centre \[m\] and relative velocity \[m/s\] belongs to the face. On the
    /// outline it belongs to the face if it moves inward, so that exactly one of the two neighbours has it.
    pub fn holds(&self, [center, velocity]: [DVec3; 2]) -> bool {
        self.outline.contains(self.local(ahead([center, velocity], self.slack(center))))
    }

    /// Returns a lower bound of the time \[s\] at which a centre \[m\] passes the outline, given its motion along a
    /// direction.
    pub fn time_on<M: AlongAxis>(&self, center: DVec3, motion: impl Fn(DVec3) -> M) -> f64 {
        let (place, slack) = (self.local(center), self.slack(center));
        let mut time = f64::INFINITY;
        for side in self.outline.sides() {
            let [start, _] = side.ends;
            let beyond = (place - start).dot(side.outward);
            let outward = motion(self.world(side.outward));
            if beyond > slack {
                // Near a corner of the outline the time is that of the line of a side; the face is tested again
                // then.
                time = time.min(outward.leaves(slack - beyond, f64::INFINITY));
                continue;
            }
            let leaves = outward.leaves(f64::NEG_INFINITY, slack - beyond);
            if leaves >= time {
                continue;
            }
            let along = motion(self.world(side.along));
            let is_beside = along.way(leaves).is_some_and(|way| {
                let there = (place - start).dot(side.along) + way;
                there < -slack || there > side.length + slack
            });
            if !is_beside {
                time = leaves;
            }
        }
        time
    }

    /// Returns the height \[m\] of its highest point above a plane, given by a point \[m\] and a normal.
    pub fn height_above(&self, [point, normal]: [DVec3; 2]) -> f64 {
        let Rectangle { center, axis_x, axis_z, .. } = self.frame;
        let base = (center - point).dot(normal);
        let rise = DVec2::new(axis_x.dot(normal), axis_z.dot(normal));
        self.outline.ends().map(|end| base + end.dot(rise)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns whether its outline crosses that of another face in its plane.
    pub fn crosses(&self, other: &Self) -> bool {
        let place = |end: DVec2| self.frame.center + self.world(end);
        let sides =
            self.outline.sides().iter().map(|side| side.ends.map(|it| other.local(place(it))));
        sides.into_iter().any(|ends| other.outline.is_crossed_by(ends))
    }

    /// Returns the triangles that cover the face, in the world \[m\].
    pub fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> {
        let Rectangle { center, axis_x, axis_z, .. } = self.frame;
        let place = move |it: DVec2| center + it.x * axis_x + it.y * axis_z;
        self.outline.triangles().iter().map(move |corners| corners.map(place))
    }

    /// Returns the vertices in the world \[m\], each at least once.
    pub fn vertices(&self) -> impl Iterator<Item = DVec3> {
        let Rectangle { center, axis_x, axis_z, .. } = self.frame;
        self.outline.ends().map(move |end| center + end.x * axis_x + end.y * axis_z)
    }

    /// Returns the coordinates in the plane of the projection of a point \[m\].
    pub fn local(&self, point: DVec3) -> DVec2 {
        self.local_direction(point - self.frame.center)
    }

    /// Converts a direction of the world to coordinates of the plane.
    pub fn local_direction(&self, direction: DVec3) -> DVec2 {
        DVec2::new(direction.dot(self.frame.axis_x), direction.dot(self.frame.axis_z))
    }

    /// Converts a direction of the plane to the world.
    pub fn world(&self, direction: DVec2) -> DVec3 {
        direction.x * self.frame.axis_x + direction.y * self.frame.axis_z
    }

    /// Returns whether a point \[m\] projects into the outline, or at most this far \[m\] outside.
    pub fn is_beside(&self, point: DVec3, beside: f64) -> bool {
        self.outline.is_within(self.local(point), beside)
    }

    /// Returns the distance of the projection of a centre from the outline \[m\]; 0 inside.
    pub fn distance_beside(&self, center: DVec3) -> f64 {
        self.outline.distance(self.local(center))
    }

    /// Returns a lower bound of the way \[m\] that a centre goes before it projects into the outline, up to rounding,
    /// and is in front of the face, if none passes it from behind; where it does, minus a lower bound of the way before
    /// it projects elsewhere.
    pub fn clearance(&self, center: DVec3) -> f64 {
        let beside = self.outline.signed_distance(self.local(center));
        let slack = WIDER * self.slack(center);
        let behind = if self.frame.is_open { 0.0 } else { -self.height_of(center) };
        let way = beside.max(behind);
        if way > 0.0 { (way - slack).max(0.0) } else { (beside + slack).min(0.0) }
    }

    /// Returns the rounding error of the position of a point beside the face \[m\].
    fn slack(&self, point: DVec3) -> f64 {
        let Rectangle { center, half_x, half_z, .. } = self.frame;
        ROUNDING * (point.norm() + center.norm() + half_x + half_z)
    }
}

/// Uncertainty of a position relative to a border, as a fraction of the coordinates: rounding of the time of a
/// contact and of the path to it.
pub(super) const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// What a region is widened by where it is to hold all that may count as in it, as a multiple of the uncertainty.
pub(super) const WIDER: f64 = 8.0;

/// A direction unlikely to be along any feature. It decides which feature a sphere belongs to that moves along a
/// border.
const LEAD: DVec3 = DVec3::new(0.8, 0.36, 0.48);

/// Returns a point \[m\] ahead of a centre by a few times the rounding error `slack` \[m\], so that it lies clearly
/// on one side of a border.
pub(super) fn ahead([center, velocity]: [DVec3; 2], slack: f64) -> DVec3 {
    let speed = velocity.norm();
    let way = if speed > 0.0 { velocity / speed } else { DVec3::ZERO };
    center + slack * (4.0 * way + 0.25 * LEAD)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::detect::passage::is_behind;
    use crate::detect::sphere_surface;
    use crate::mesh::{Mesh, Placement};
    use crate::surface::{Form, place_mesh};
    use glam::DQuat;

    /// A number from -1 to 1 of a linear congruential generator (Knuth, MMIX).
    fn random(state: &mut u64) -> f64 {
        *state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
    }

    #[test]
    fn a_centre_is_as_it_was_to_a_feature_while_it_goes_less_than_the_clearance() {
        let mut state = 1;
        let rows: Vec<Vec<f64>> =
            (0..6).map(|_| (0..6).map(|_| 0.4 * random(&mut state)).collect()).collect();
        let field = Mesh::from_heights([5.0, 5.0], &rows).expect("a good field");
        let sheet =
            Mesh::new(field.vertices().to_vec(), field.triangles().to_vec()).expect("a good mesh");
        let mut known = [0, 0];
        for mesh in [&field, &sheet] {
            let mut forms = Vec::new();
            let placement =
                Placement { rotation: DQuat::IDENTITY, from: DVec3::ZERO, to: DVec3::ZERO };
            place_mesh(mesh.features(), &placement, |form| forms.push(form));
            for form in &forms {
                for _ in 0..200 {
                    let mut point = || DVec3::from_array([0; 3].map(|_| random(&mut state)));
                    let (center, way) = (3.0 * point(), point());
                    let clearance = match form {
                        Form::Facet(it) => it.clearance(center),
                        Form::Edge(it) if !it.is_border => it.clearance(center),
                        Form::Corner(it) => it.clearance(center),
                        _ => continue,
                    };
                    let there = center + 0.999 * clearance.abs() * way / way.norm();
                    let radius = 10.0;
                    if clearance > 0.0 {
                        assert_eq!(sphere_surface(form, there, radius), None, "{form:?} {there}");
                        assert!(!is_behind(form, there, radius), "{form:?} {there}");
                        known[0] += 1;
                    }
                    if let Form::Facet(facet) = form
                        && clearance < 0.0
                    {
                        assert!(facet.is_under(there), "{form:?} {there}");
                        known[1] += 1;
                    }
                }
            }
        }
        assert!(known.iter().all(|it| *it > 100), "{known:?}");
    }
}
