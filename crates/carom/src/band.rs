//! Surfaces of revolution: a line or an arc beside an axis, turned about that.

mod ring;

use glam::{DVec2, DVec3};

use crate::norm::Norm;

/// A one-sided surface of revolution in the world, with its ends as rims.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Band {
    /// Origin of the profile, on the axis \[m\].
    pub center: DVec3,
    /// Unit vector.
    pub axis: DVec3,
    pub profile: Profile,
    /// Whether spheres pass it from behind: nothing else of its collider is there.
    pub is_open: bool,
}

/// Half of a section along the axis: x is the distance from the axis \[m\], y the height along it \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Profile {
    /// A line that faces the left of its direction.
    Line {
        from: DVec2,
        /// Unit vector.
        direction: DVec2,
        /// Length \[m\].
        length: f64,
        /// The surface is this far from the line \[m\].
        thickness: f64,
    },
    /// An arc of half a circle at most, or a whole one.
    Arc {
        /// Centre of the arc, on the axis unless the circle is a whole one.
        center: DVec2,
        /// Radius \[m\].
        radius: f64,
        /// Unit vectors from the centre to the ends, the second one counterclockwise from the first; equal for a
        /// whole circle.
        ends: [DVec2; 2],
        /// Whether the surface faces the centre of its arc.
        is_hollow: bool,
    },
}

/// The nearest place of a profile to a point of the half-plane.
#[derive(Debug, Clone, Copy)]
struct ProfilePoint {
    /// Distance \[m\] of the surface; of the face it is negative behind it.
    distance: f64,
    /// Unit vector in which that grows fastest.
    normal: DVec2,
    /// Second derivatives of the distance along the profile and about the axis \[1/m\].
    curvatures: [f64; 2],
    /// Distance in front of the profile, were it to go on past its ends \[m\].
    front: f64,
    /// Unit vector in which that grows fastest.
    front_normal: DVec2,
    /// How far the point may go with the face nearest \[m\]; negative where a rim is.
    room: f64,
}

/// Distance of a band from a point, with its derivatives.
#[derive(Debug, Clone, Copy)]
pub(crate) struct View {
    /// Distance from the surface \[m\]; negative behind the face.
    pub distance: f64,
    /// Unit vector in which that grows fastest.
    pub normal: DVec3,
    /// Distance in front of the surface, were it to go on past its rims \[m\].
    pub front: f64,
    /// Unit vector in which that grows fastest.
    pub front_normal: DVec3,
    /// How far the point may go with the face nearest \[m\]; negative where a rim is.
    pub room: f64,
    /// Unit vectors along the profile and about the axis, at the nearest point of the surface.
    pub directions: [DVec3; 2],
    /// Second derivatives of the distance along them \[1/m\].
    pub curvatures: [f64; 2],
    /// Distance from the axis \[m\].
    pub from_axis: f64,
}

impl ProfilePoint {
    /// The view by this foot in the half-plane of these unit vectors, as if it were on the axis.
    fn view(&self, axis: DVec3, radial: DVec3) -> View {
        let world = |vector: DVec2| vector.x * radial + vector.y * axis;
        View {
            distance: self.distance,
            normal: world(self.normal),
            front: self.front,
            front_normal: world(self.front_normal),
            room: self.room,
            directions: [world(DVec2::new(self.normal.y, -self.normal.x)), axis.cross(radial)],
            curvatures: self.curvatures,
            from_axis: 0.0,
        }
    }
}

impl Band {
    /// The band as seen from a point \[m\].
    pub fn seen_from(&self, point: DVec3) -> View {
        let [place, radial] = self.place_of(point);
        let foot = self.profile.foot(DVec2::new(place.x, place.y));
        self.view(&foot, place.x, radial)
    }

    /// The band as seen from a point \[m\] that is over its face, though a rim may be nearest by rounding.
    pub fn face_seen_from(&self, point: DVec3) -> View {
        let [place, radial] = self.place_of(point);
        let place = DVec2::new(place.x, place.y);
        self.view(&self.profile.foot_on_face(place), place.x, radial)
    }

    /// The band as seen from a point \[m\] that is over a rim, though the face may be nearest by rounding.
    pub fn rim_seen_from(&self, point: DVec3) -> View {
        let [place, radial] = self.place_of(point);
        let place = DVec2::new(place.x, place.y);
        let face = self.profile.foot_on_face(place);
        self.view(&self.profile.foot_on_rim(place, &face), place.x, radial)
    }

    /// Coordinates of a point in the half-plane through it, and the unit vector away from the axis there.
    fn place_of(&self, point: DVec3) -> [DVec3; 2] {
        let offset = point - self.center;
        let height = offset.dot(self.axis);
        let across = offset - height * self.axis;
        let from_axis = across.norm();
        let radial = if from_axis > 0.0 { across / from_axis } else { self.any_radial() };
        [DVec3::new(from_axis, height, 0.0), radial]
    }

    /// A unit vector at right angles to the axis.
    fn any_radial(&self) -> DVec3 {
        let least = self.axis.abs().min_position();
        let mut other = DVec3::ZERO;
        other[least] = 1.0;
        let across = other - other.dot(self.axis) * self.axis;
        across / across.norm()
    }

    /// How far the rims are from the place of the face nearest to a point \[m\], along the profile: the one against
    /// the direction of the view, then the other one. Arcs are measured across; what is beyond a quarter of a circle
    /// is endless.
    pub fn rooms(&self, point: DVec3) -> [f64; 2] {
        let [place, _] = self.place_of(point);
        let place = DVec2::new(place.x, place.y);
        match self.profile {
            Profile::Line { from, direction, length, .. } => {
                let along = (place - from).dot(direction);
                [along, length - along]
            }
            Profile::Arc { center, ends, is_hollow, .. } => {
                let offset = place - center;
                let [first, second] = ends;
                let room = |end: DVec2, side: f64| {
                    let is_rim = ends[0] != ends[1] && end.x != 0.0 && end.dot(offset) > 0.0;
                    let beside = side * (end.x * offset.y - end.y * offset.x);
                    if is_rim { beside } else { f64::INFINITY }
                };
                let rooms = [room(second, -1.0), room(first, 1.0)];
                if is_hollow { [rooms[1], rooms[0]] } else { rooms }
            }
        }
    }

    /// The unit normal of a flat face.
    pub fn flat_normal(&self) -> Option<DVec3> {
        match self.profile {
            Profile::Line { direction, thickness: 0.0, .. } if direction.y == 0.0 => {
                Some(direction.x * self.axis)
            }
            _ => None,
        }
    }

    /// Radius of a disc \[m\].
    pub fn disc_radius(&self) -> Option<f64> {
        match self.profile {
            Profile::Line { from, direction, length, .. } if direction.y == 0.0 => {
                Some(if direction.x > 0.0 { length } else { from.x })
            }
            _ => None,
        }
    }

    /// The inside of a cylinder about the axis of a disc, at the height of a point \[m\]: as far from the rim as the
    /// radius of the disc, and `slack` \[m\].
    pub fn beyond_disc(&self, point: DVec3, slack: f64) -> Option<Self> {
        let half = self.disc_radius()?;
        let radius = 2.0 * half + slack;
        let profile = Profile::line(DVec2::new(radius, -half), DVec2::new(radius, half));
        let center = self.center + (point - self.center).dot(self.axis) * self.axis;
        Some(Self { center, profile, is_open: false, ..*self })
    }

    /// Returns where a point \[m\] is that moves with the band from another place of it to this
    /// one, by the shortest turn.
    pub fn carried_from(&self, before: &Self, point: DVec3) -> DVec3 {
        let offset = point - before.center;
        let turn = before.axis.cross(self.axis);
        let cos = before.axis.dot(self.axis);
        if turn == DVec3::ZERO {
            return self.center + offset;
        }
        // Rodrigues' formula (1840), with sin θ k for the axis of the turn.
        let turned = cos * offset + turn.cross(offset) + turn.dot(offset) / (1.0 + cos) * turn;
        self.center + turned
    }

    /// Size of the coordinates that it is given by \[m\].
    pub fn coordinates(&self) -> f64 {
        self.center.norm() + self.profile.size()
    }

    /// Returns a bound of the distance of the band's points from its centre \[m\].
    pub fn reach(&self) -> f64 {
        self.profile.size()
    }

    /// Smallest and largest of `(x - center)·direction` over the band \[m\]; more than that for arcs.
    pub fn extent(&self, direction: DVec3) -> [f64; 2] {
        let along = self.axis.dot(direction).clamp(-1.0, 1.0);
        let across = (1.0 - along * along).max(0.0).sqrt();
        let of =
            |point: DVec2| [point.y * along - point.x * across, point.y * along + point.x * across];
        let ([a, b], margin) = match self.profile {
            Profile::Line { from, direction, length, thickness } => {
                ([of(from), of(from + length * direction)], thickness)
            }
            Profile::Arc { center, radius, .. } => ([of(center); 2], radius),
        };
        [a[0].min(b[0]) - margin, a[1].max(b[1]) + margin]
    }

    /// Whether turning about an origin \[m\] with this angular velocity \[rad/s\] leaves it as it is.
    pub fn is_turned_in_place_by(&self, origin: DVec3, angular_velocity: DVec3) -> bool {
        /// Sine of the largest angle \[rad\] between axes that count as one: what many turns leave of rounding.
        const SAME_AXIS: f64 = 1e-9;
        self.center == origin
            && self.axis.cross(angular_velocity).norm() <= SAME_AXIS * angular_velocity.norm()
    }
}

impl Profile {
    /// The line between two different points; it faces the left of its direction.
    pub fn line(from: DVec2, to: DVec2) -> Self {
        let way = to - from;
        let length = way.dot(way).sqrt();
        Self::Line { from, direction: way / length, length, thickness: 0.0 }
    }

    /// Returns the profile facing the other way.
    pub fn turned(self) -> Self {
        match self {
            Self::Line { from, direction, length, thickness } => Self::Line {
                from: from + length * direction,
                direction: -direction,
                length,
                thickness,
            },
            Self::Arc { center, radius, ends, is_hollow } => {
                Self::Arc { center, radius, ends, is_hollow: !is_hollow }
            }
        }
    }

    /// Size of its coordinates \[m\].
    fn size(&self) -> f64 {
        match *self {
            Self::Line { from, length, thickness, .. } => {
                from.x.abs() + from.y.abs() + length + thickness
            }
            Self::Arc { center, radius, .. } => center.x.abs() + center.y.abs() + radius,
        }
    }

    fn foot(&self, point: DVec2) -> ProfilePoint {
        let face = self.foot_on_face(point);
        if face.room >= 0.0 { face } else { self.foot_on_rim(point, &face) }
    }

    /// Returns the foot of a point as if the nearest place were on the face.
    fn foot_on_face(&self, point: DVec2) -> ProfilePoint {
        match *self {
            Self::Line { from, direction, length, thickness } => {
                let offset = point - from;
                let along = offset.dot(direction);
                let normal = DVec2::new(-direction.y, direction.x);
                let front = offset.dot(normal);
                // A disc goes on to the other side of the axis.
                let is_inner = |end: f64| direction.y == 0.0 && end == 0.0;
                let before = if is_inner(from.x) { f64::INFINITY } else { along };
                let end = from.x + length * direction.x;
                let after =
                    if direction.x < 0.0 && is_inner(end) { f64::INFINITY } else { length - along };
                let about =
                    if normal.x == 0.0 { 0.0 } else { normal.x / point.x.max(f64::MIN_POSITIVE) };
                ProfilePoint {
                    distance: front - thickness,
                    normal,
                    curvatures: [0.0, about],
                    front,
                    front_normal: normal,
                    room: before.min(after),
                }
            }
            Self::Arc { center, radius, ends, is_hollow } => {
                let offset = point - center;
                let from_center = offset.dot(offset).sqrt();
                let out = if from_center > 0.0 { offset / from_center } else { ends[0] };
                let sign = if is_hollow { -1.0 } else { 1.0 };
                let normal = sign * out;
                let front = sign * (from_center - radius);
                let along = sign / from_center.max(f64::MIN_POSITIVE);
                // About a centre on the axis, it is a sphere.
                let about =
                    if center.x == 0.0 { along } else { normal.x / point.x.max(f64::MIN_POSITIVE) };
                let curvatures = [along, about];
                let room = room_on_arc(ends, offset);
                let (distance, front_normal) = (front, normal);
                ProfilePoint { distance, normal, curvatures, front, front_normal, room }
            }
        }
    }

    /// Returns the foot of a point as if the nearest place were on the nearer end.
    fn foot_on_rim(&self, point: DVec2, face: &ProfilePoint) -> ProfilePoint {
        let [first, second] = self.ends().map(|end| point - end);
        let [near, far] = [first.dot(first), second.dot(second)];
        let offset = if near <= far { first } else { second };
        let from_rim = near.min(far).sqrt();
        let normal = if from_rim > 0.0 { offset / from_rim } else { face.normal };
        let thickness = if let Self::Line { thickness, .. } = *self { thickness } else { 0.0 };
        let along = from_rim.max(f64::MIN_POSITIVE).recip();
        // A rim on the axis is a point.
        let about =
            if offset.x == point.x { along } else { normal.x / point.x.max(f64::MIN_POSITIVE) };
        ProfilePoint {
            distance: from_rim - thickness,
            normal,
            curvatures: [along, about],
            room: face.room.min(-f64::MIN_POSITIVE),
            ..*face
        }
    }

    /// Returns both ends of the profile \[m\].
    pub fn ends(&self) -> [DVec2; 2] {
        match *self {
            Self::Line { from, direction, length, .. } => [from, from + length * direction],
            Self::Arc { center, radius, ends, .. } => ends.map(|end| center + radius * end),
        }
    }
}

/// Returns how far a point at an offset from the centre of an arc is within the sector in which the
/// arc is nearest \[m\]; negative where an end is nearer.
fn room_on_arc(ends: [DVec2; 2], offset: DVec2) -> f64 {
    if ends[0] == ends[1] {
        return f64::INFINITY;
    }
    // The boundary is a ray from the centre. Ends on the axis are none.
    let to_ray = |end: DVec2, side: f64| {
        let beside = side * (end.x * offset.y - end.y * offset.x);
        if end.x == 0.0 {
            f64::INFINITY
        } else if beside >= 0.0 && end.dot(offset) < 0.0 {
            offset.dot(offset).sqrt()
        } else {
            beside
        }
    };
    to_ray(ends[0], 1.0).min(to_ray(ends[1], -1.0))
}

/// Bounds of how fast the distance of a band may fall by its own curvature.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Concavity {
    /// Part of 1, and length \[m\], whose quotient is the curvature with which the distance falls, while the face
    /// is nearest.
    near: [f64; 2],
    /// How far that is so \[m\].
    room: f64,
    /// Distance \[m\] of what it may curve about elsewhere.
    elsewhere: f64,
    /// How far a point may go before that counts \[m\].
    clear: f64,
    /// A length over which a step is worth computing \[m\].
    pub span: f64,
}

impl Concavity {
    /// Whether the distance is convex wherever the point may go.
    pub fn is_none(&self) -> bool {
        self.near[0] == 0.0 && (self.room == f64::INFINITY || self.clear == f64::INFINITY)
    }

    /// An upper bound of the curvature \[1/m\] with which the distance falls within this way \[m\].
    pub fn most(&self, way: f64) -> f64 {
        let about = |part: f64, length: f64| {
            if part == 0.0 {
                0.0
            } else if way < length {
                part / (length - way)
            } else {
                f64::INFINITY
            }
        };
        if way < self.room || self.room == f64::INFINITY {
            about(self.near[0], self.near[1])
        } else {
            about(if way <= self.clear { 0.0 } else { 1.0 }, self.elsewhere)
        }
    }
}

impl Band {
    /// How fast the distance may fall by the curvature of the band near a point that sees it so; where the point is
    /// behind, the distance to the front.
    pub fn concavity(&self, view: &View) -> Concavity {
        let is_behind = view.front < 0.0;
        let from_axis = view.from_axis;
        match self.profile {
            Profile::Line { direction, .. } => {
                let outward = if is_behind { direction.y } else { -direction.y };
                let [a, b] = self.profile.ends();
                let widest = a.x.max(b.x);
                let is_convex = direction.y == 0.0 || widest == 0.0;
                let clear = match () {
                    () if is_convex => f64::INFINITY,
                    () if outward >= 0.0 && !is_behind => from_axis - widest,
                    () => -1.0,
                };
                let near = [if is_convex { 0.0 } else { (-outward).max(0.0) }, from_axis];
                let room = if is_behind { f64::INFINITY } else { view.room };
                Concavity { near, room, elsewhere: from_axis, clear, span: 0.5 * from_axis }
            }
            Profile::Arc { center, radius, is_hollow, .. } => {
                let from_center = radius + if is_hollow { -view.front } else { view.front };
                let falls = is_hollow != is_behind;
                let near = match (center.x == 0.0, falls) {
                    (true, true) => [1.0, from_center],
                    (true, false) => [0.0, from_center],
                    (false, true) => [1.0, from_center.min(from_axis)],
                    (false, false) => [1.0, from_axis],
                };
                let is_whole = center.x != 0.0;
                let room = if is_behind || is_whole { f64::INFINITY } else { view.room };
                let elsewhere = from_center.min(from_axis);
                let span = (0.5 * near[1]).min(0.75 * room).max(0.5 * elsewhere);
                Concavity { near, room, elsewhere, clear: -1.0, span }
            }
        }
    }
}
