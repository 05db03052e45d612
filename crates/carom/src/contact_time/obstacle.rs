//! An obstacle as a core: the surfaces touch where the centre is at the distance of a radius from the core.

use glam::DVec3;

use crate::band::{Band, Concavity};
use crate::norm::Norm;
use crate::surface::Rectangle;

/// An obstacle at rest. Where its core is convex, the distance from it lies above each of its
/// tangent planes; elsewhere it falls below them by what the concavity allows. The search rests on that.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Obstacle {
    /// The origin.
    Point { radius: f64 },
    /// Everything below a plane through `point`.
    HalfSpace { point: DVec3, normal: DVec3, radius: f64 },
    /// A rectangle, which meets only centres in front of its plane.
    Rectangle { rectangle: Rectangle, radius: f64 },
    /// A surface of revolution, which meets only centres in front of it.
    Band { band: Band, radius: f64 },
    /// The points of a line between two ends.
    Segment { ends: [DVec3; 2], radius: f64 },
    /// A plane through `point`, which meets only centres in front of it.
    Plane { point: DVec3, normal: DVec3, radius: f64 },
    /// A triangle, which meets only centres in front of its plane.
    Triangle { corners: [DVec3; 3], normal: DVec3, radius: f64 },
}

/// Distance of an obstacle from one point, with its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LocalDistance {
    /// Distance from the core \[m\].
    pub from_core: f64,
    /// Distance of the surfaces: `from_core` less the radius \[m\].
    pub distance: f64,
    /// Direction in which the distance grows fastest.
    pub normal: DVec3,
    /// Whether the normal changes from place to place.
    pub is_round: bool,
    /// Distance \[m\] that the centre may move without a change of the normal.
    pub flat_within: f64,
    /// Second derivative \[m/s²\] of the distance for a point that moves at a constant velocity.
    pub turning: f64,
    /// A plane that the centre must pass before there can be contact.
    pub barrier: Option<Barrier>,
    /// Whether the centre is behind the obstacle, where there is no contact at any distance.
    pub is_behind: bool,
    /// Bound of the fall of the distance by the curvature of the core; `None` for a convex core.
    pub concavity: Option<Concavity>,
    /// A half-space that contains every place of contact.
    pub hull: Option<Barrier>,
}

/// A half-space that the centre must enter before a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Barrier {
    /// Distance from the half-space \[m\].
    pub distance: f64,
    /// Unit normal out of it.
    pub normal: DVec3,
}

impl Obstacle {
    /// The distance \[m\] of a centre from the core at a contact.
    pub fn radius(mut self) -> f64 {
        *self.radius_mut()
    }

    /// Returns the distance for a radius that is larger by an amount \[m\].
    pub fn widened(mut self, by: f64) -> Self {
        *self.radius_mut() += by;
        self
    }

    fn radius_mut(&mut self) -> &mut f64 {
        match self {
            Self::Point { radius }
            | Self::HalfSpace { radius, .. }
            | Self::Rectangle { radius, .. }
            | Self::Band { radius, .. }
            | Self::Segment { radius, .. }
            | Self::Plane { radius, .. }
            | Self::Triangle { radius, .. } => radius,
        }
    }

    /// Whether centres pass it from behind.
    pub fn is_open(&self) -> bool {
        match self {
            Self::Rectangle { rectangle, .. } => rectangle.is_open,
            Self::Band { band, .. } => band.is_open,
            _ => false,
        }
    }

    /// Distance of a centre with a velocity.
    pub fn local_distance(&self, position: DVec3, velocity: DVec3) -> LocalDistance {
        match *self {
            Self::Point { radius } => {
                LocalDistance::of_offset(position, velocity, radius, DVec3::Y)
            }
            Self::HalfSpace { point, normal, radius } => {
                let height = (position - point).dot(normal);
                LocalDistance::of_face(height, normal, radius, f64::INFINITY)
            }
            Self::Rectangle { ref rectangle, radius } => {
                rectangle_distance(rectangle, radius, position, velocity)
            }
            Self::Band { ref band, radius } => band_distance(band, radius, position, velocity),
            Self::Segment { ends, radius } => segment_distance(ends, radius, position, velocity),
            Self::Plane { point, normal, radius } => {
                let height = (position - point).dot(normal);
                let (above, away) =
                    if height < 0.0 { (-height, -normal) } else { (height, normal) };
                LocalDistance::of_face(above, away, radius, f64::INFINITY)
                    .one_sided(height, normal, radius)
            }
            Self::Triangle { ref corners, normal, radius } => {
                triangle_distance(corners, normal, radius, [position, velocity])
            }
        }
    }
}

impl LocalDistance {
    fn of_face(height: f64, normal: DVec3, radius: f64, flat_within: f64) -> Self {
        Self {
            from_core: height,
            distance: height - radius,
            normal,
            is_round: false,
            flat_within,
            turning: 0.0,
            barrier: None,
            is_behind: false,
            concavity: None,
            hull: None,
        }
    }

    /// Returns the distance from a point or an edge, by the offset from the nearest place on it.
    /// `across` is the velocity v without its part along the edge. The distance ρ has
    /// `ρ'' = (v² - ρ'²)/ρ`.
    fn of_offset(offset: DVec3, across: DVec3, radius: f64, normal_at_zero: DVec3) -> Self {
        let from_core = offset.norm();
        let (normal, turning) = if from_core > 0.0 {
            let normal = offset / from_core;
            (normal, normal.cross(across).length_squared() / from_core)
        } else {
            (normal_at_zero, 0.0)
        };
        Self {
            from_core,
            distance: from_core - radius,
            normal,
            is_round: true,
            flat_within: 0.0,
            turning,
            barrier: None,
            is_behind: false,
            concavity: None,
            hull: None,
        }
    }
}

/// Returns the distance from a band as in `detect/sphere_band.rs`; from behind, it is that to the
/// front.
fn band_distance(band: &Band, radius: f64, position: DVec3, velocity: DVec3) -> LocalDistance {
    let view = band.seen_from(position);
    let concavity = Some(band.concavity(&view));
    let is_behind = view.front < 0.0;
    let turning = |number: usize| {
        let speed = velocity.dot(view.directions[number]);
        speed * speed * view.curvatures[number]
    };
    // What the normal turns about.
    let sharpest = view.curvatures[0].abs().max(view.curvatures[1].abs());
    let from_core = if sharpest > 0.0 { sharpest.recip() } else { f64::INFINITY };
    let (offset, reach) = (position - band.center, band.reach() + radius);
    let from_center = offset.norm();
    let hull = (from_center > reach)
        .then(|| Barrier { distance: from_center - reach, normal: offset / from_center });
    let local = LocalDistance {
        hull,
        from_core,
        distance: view.distance - radius,
        normal: view.normal,
        is_round: sharpest > 0.0,
        flat_within: 0.0,
        turning: turning(0) + turning(1),
        barrier: None,
        is_behind,
        concavity,
    };
    if !is_behind {
        return local;
    }
    let (distance, normal) = (-view.front, -view.front_normal);
    LocalDistance { distance, normal, barrier: Some(Barrier { distance, normal }), ..local }
}

impl LocalDistance {
    /// Returns the distance from a surface that meets only centres in front of its plane, for a
    /// centre at a height above that.
    fn one_sided(self, height: f64, normal: DVec3, radius: f64) -> Self {
        let is_behind = height < 0.0;
        let barrier = if is_behind {
            Some(Barrier { distance: -height, normal: -normal })
        } else {
            (height > radius).then_some(Barrier { distance: height - radius, normal })
        };
        Self { is_behind, barrier, ..self }
    }
}

/// Returns the distance from a rectangle as in `detect/sphere_rectangle.rs`.
fn rectangle_distance(
    rectangle: &Rectangle,
    radius: f64,
    position: DVec3,
    velocity: DVec3,
) -> LocalDistance {
    let offset = position - rectangle.center;
    let (axis_x, axis_z) = (rectangle.axis_x, rectangle.axis_z);
    let height = offset.dot(rectangle.normal);
    let (x, z) = (offset.dot(axis_x), offset.dot(axis_z));
    let nearest_x = x.clamp(-rectangle.half_x, rectangle.half_x);
    let nearest_z = z.clamp(-rectangle.half_z, rectangle.half_z);
    let (over_x, over_z) = (nearest_x == x, nearest_z == z);
    let local = if over_x && over_z {
        let (height, normal) =
            if height < 0.0 { (-height, -rectangle.normal) } else { (height, rectangle.normal) };
        let to_edge = (rectangle.half_x - x.abs()).min(rectangle.half_z - z.abs());
        LocalDistance::of_face(height, normal, radius, to_edge)
    } else {
        let from_nearest =
            height * rectangle.normal + (x - nearest_x) * axis_x + (z - nearest_z) * axis_z;
        let mut across = velocity;
        if over_x {
            across -= velocity.dot(axis_x) * axis_x;
        }
        if over_z {
            across -= velocity.dot(axis_z) * axis_z;
        }
        LocalDistance::of_offset(from_nearest, across, radius, rectangle.normal)
    };
    local.one_sided(height, rectangle.normal, radius)
}

/// Distance of a centre with a velocity from a line between two ends.
fn segment_distance(
    ends: [DVec3; 2],
    radius: f64,
    position: DVec3,
    velocity: DVec3,
) -> LocalDistance {
    let way = ends[1] - ends[0];
    let length = way.norm();
    let axis = if length > 0.0 { way / length } else { DVec3::ZERO };
    let along = (position - ends[0]).dot(axis);
    let (nearest, across) = if along <= 0.0 {
        (ends[0], velocity)
    } else if along >= length {
        (ends[1], velocity)
    } else {
        (ends[0] + along * axis, velocity - velocity.dot(axis) * axis)
    };
    LocalDistance::of_offset(position - nearest, across, radius, DVec3::Y)
}

/// A triangle that goes round against the clock as seen from its front.
fn triangle_distance(
    corners: &[DVec3; 3],
    normal: DVec3,
    radius: f64,
    [position, velocity]: [DVec3; 2],
) -> LocalDistance {
    let height = (position - corners[0]).dot(normal);
    let sides = [0, 1, 2].map(|side| [corners[side], corners[(side + 1) % 3]]);
    let inside = sides.map(|[from, to]| {
        let way = to - from;
        (position - from).dot(normal.cross(way)) / way.norm()
    });
    let to_edge = inside.into_iter().fold(f64::INFINITY, f64::min);
    let local = if to_edge >= 0.0 {
        let (above, away) = if height < 0.0 { (-height, -normal) } else { (height, normal) };
        LocalDistance::of_face(above, away, radius, to_edge)
    } else {
        let of_sides = sides.map(|ends| segment_distance(ends, radius, position, velocity));
        let [first, second, third] = of_sides;
        let nearer =
            |a: LocalDistance, b: LocalDistance| if b.distance < a.distance { b } else { a };
        nearer(nearer(first, second), third)
    };
    local.one_sided(height, normal, radius)
}
