//! Rings: from the axis of a surface of revolution, a whole circle of it is nearest.

use glam::{DVec2, DVec3};

use super::{Band, Profile, ProfilePoint, View};
use crate::norm::Norm;

/// Points count as on the axis of a band within this part of the size of the band.
const ON_AXIS: f64 = 1e-9;
/// A path goes through the axis if it passes it within this part of the distance within which points count as on it:
/// rounding.
const THROUGH_AXIS: f64 = 1e-2;
/// A normal along or across the axis has a smaller component \[1\] in the other direction.
const LEAST_TILT: f64 = 1e-3;

impl ProfilePoint {
    /// The view from the axis, where a whole ring is nearest and its mean normal is along the axis. A sphere there
    /// approaches the ring more slowly than it moves along the axis.
    fn over_ring(&self) -> Self {
        let normal = DVec2::new(0.0, 1f64.copysign(self.normal.y));
        Self { normal, curvatures: [0.0; 2], ..*self }
    }

    /// Whether a ring of the surface would be nearest to the axis.
    fn is_of_ring(&self) -> bool {
        self.normal.x < -LEAST_TILT && self.normal.y.abs() > LEAST_TILT
    }
}

impl Profile {
    /// Distance from the axis \[m\] within which points count as on it.
    fn axis_reach(&self) -> f64 {
        ON_AXIS * self.size()
    }
}

impl View {
    /// Unit vector to the axis and the distance from it \[m\], where from the axis a ring of the face is nearest;
    /// `None` on the axis.
    pub fn way_to_ring(&self, band: &Band) -> Option<(DVec3, f64)> {
        let inward = band.axis.cross(self.directions[1]);
        let tilt = self.normal.dot(inward);
        let is_ring = tilt > LEAST_TILT && self.normal.dot(band.axis).abs() > LEAST_TILT;
        (is_ring && self.from_axis > band.profile.axis_reach()).then_some((inward, self.from_axis))
    }
}

impl Band {
    /// Returns whether a point \[m\] is on the axis, and a whole ring is nearest to it.
    pub fn has_ring_about(&self, point: DVec3) -> bool {
        let [place, _] = self.place_of(point);
        let is_on_axis = place.x <= self.profile.axis_reach();
        is_on_axis && self.profile.foot(DVec2::new(place.x, place.y)).is_of_ring()
    }

    /// Distance from the axis \[m\] beyond which a sphere is no longer on all of a ring.
    pub fn ring_reach(&self) -> f64 {
        2.0 * self.profile.axis_reach()
    }

    /// The band as seen from a point \[m\], by one side of it alone: by the section of the band along the unit vector
    /// `side` from the axis, carried straight on at right angles to it, and past the axis.
    pub fn side_seen_from(&self, point: DVec3, side: DVec3) -> View {
        self.section(point, side, |profile, place| profile.foot(place))
    }

    /// Returns the view of a point over the face of the section, though a rim may be nearer.
    pub fn side_face_seen_from(&self, point: DVec3, side: DVec3) -> View {
        self.section(point, side, Profile::foot_on_face)
    }

    /// Returns the view of a point over a rim of the section, though the face may be nearer.
    pub fn side_rim_seen_from(&self, point: DVec3, side: DVec3) -> View {
        let on_rim = |profile: &Profile, place| {
            let face = profile.foot_on_face(place);
            profile.foot_on_rim(place, &face)
        };
        self.section(point, side, on_rim)
    }

    /// The view of a section along a unit vector from the axis.
    fn section(
        &self,
        point: DVec3,
        side: DVec3,
        foot: impl Fn(&Profile, DVec2) -> ProfilePoint,
    ) -> View {
        let offset = point - self.center;
        let height = offset.dot(self.axis);
        let foot = foot(&self.profile, DVec2::new(offset.dot(side), height));
        let [of_profile, _] = foot.curvatures;
        let foot = ProfilePoint { curvatures: [of_profile, 0.0], ..foot };
        View { from_axis: (offset - height * self.axis).norm(), ..foot.view(self.axis, side) }
    }

    /// Unit vector along the section in which a point \[m\] moves with this velocity \[m/s\], on the side of the point,
    /// where it goes through the axis or comes from there, and a ring is nearest to the axis.
    pub fn section_through_axis(&self, [point, velocity]: [DVec3; 2]) -> Option<DVec3> {
        let [place, radial] = self.place_of(point);
        let across = velocity - velocity.dot(self.axis) * self.axis;
        let speed = across.norm();
        let section = if speed > 0.0 {
            let side = across / speed;
            if side.dot(radial) < 0.0 { -side } else { side }
        } else {
            radial
        };
        let meets_ring = || self.profile.foot(DVec2::new(0.0, place.y)).is_of_ring();
        (self.is_in_section(point, section) && meets_ring()).then_some(section)
    }

    /// Whether a point \[m\] is in the section through the axis along a unit vector, up to rounding.
    pub fn is_in_section(&self, point: DVec3, section: DVec3) -> bool {
        let beside = (point - self.center).dot(self.axis.cross(section));
        beside.abs() <= THROUGH_AXIS * self.profile.axis_reach()
    }

    /// Unit vector away from the axis at a point \[m\].
    pub fn radial_at(&self, point: DVec3) -> DVec3 {
        self.place_of(point)[1]
    }

    /// The view of a foot from a point \[m\], by the distance of the point from the axis and the unit vector away
    /// from that.
    pub(super) fn view(&self, foot: &ProfilePoint, from_axis: f64, radial: DVec3) -> View {
        let is_on_axis = from_axis <= self.profile.axis_reach();
        let foot = if is_on_axis && foot.is_of_ring() { &foot.over_ring() } else { foot };
        View { from_axis, ..foot.view(self.axis, radial) }
    }
}
