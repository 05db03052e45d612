//! Colliders as the world sees them: surfaces in their places.

use std::cell::Cell;
use std::ops::Deref;
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use crate::band::{Band, Profile};
use crate::collider::{Collider, Shape};
use crate::collider_motion::{Carriage, Course};
use crate::friction::Friction;
use crate::groups::Groups;
use crate::id::ColliderId;
use crate::mesh::{ClosedMesh, Corner, Edge, Facet, Features, Placement};
use crate::norm::Norm;
use crate::pose::Pose;
pub(crate) use crate::rectangle::Rectangle;
use crate::restitution::BodyRestitution;
use crate::rotation;
use crate::round_solid::{Outline, RoundSolid};
pub(crate) use crate::solid_box::SolidBox;
pub(crate) use crate::surface_motion::SurfaceMotion;

/// One surface of a collider in world coordinates, with what a contact needs to know of it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Surface {
    pub form: Form,
    /// Lowest-numbered collider of those with faces flush with each other, its own included.
    pub whole: ColliderId,
    pub role: Role,
    /// What the surfaces of a collider have in common; they share its memory.
    pub common: Arc<Common>,
}

/// What the surfaces of a collider have in common.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Common {
    pub collider: ColliderId,
    pub restitution: BodyRestitution,
    pub friction: Friction,
    /// Frequency ratio of a compliant surface; 0 for none.
    pub cushion: f64,
    /// Speed that an impact adds along the normal \[m/s\].
    pub kick: f64,
    pub groups: Groups,
    /// 0 for none.
    pub material: u8,
    /// Now.
    pub motion: SurfaceMotion,
    /// Motion from now on, if it is not steady.
    pub course: Option<Arc<Course>>,
}

impl Deref for Surface {
    type Target = Common;

    fn deref(&self) -> &Common {
        &self.common
    }
}

impl SurfaceMotion {
    /// Returns the motion of the surfaces of a collider, taken as steady.
    pub fn of(collider: &Collider) -> Self {
        let Collider { pose, velocity, angular_velocity, .. } = *collider;
        let belt = belt_of(collider);
        Self { origin: pose.position, velocity, angular_velocity, belt, drive: None }
    }

    /// Whether the place of a surface of this form changes by its turning.
    pub fn turns_form(&self, form: &Form) -> bool {
        self.turns() && (self.drive.is_some() || !form.is_turned_in_place_by(self))
    }

    /// Velocity \[m/s\] at a point, if turning leaves a surface of this form as it is, less the velocity of its
    /// origin; else 0.
    pub fn turning_in_place(&self, form: &Form, point: DVec3) -> DVec3 {
        if self.turns() && !self.turns_form(form) {
            self.angular_velocity.cross(point - self.origin)
        } else {
            DVec3::ZERO
        }
    }
}

impl Surface {
    /// Returns the form and the motion now.
    pub fn place(&self) -> (&Form, &SurfaceMotion) {
        (&self.form, &self.motion)
    }

    /// Geometry and motion of the surface after `h` \[s\].
    pub fn after(&self, h: f64) -> (Form, SurfaceMotion) {
        match &self.course {
            Some(course) => self.carried(&course.carriage(h)),
            None => self.motion.carry(&self.form, h),
        }
    }

    /// Geometry and motion of the surface when its collider has moved so from now on.
    pub fn carried(&self, &Carriage { to, turn, motion }: &Carriage) -> (Form, SurfaceMotion) {
        let SurfaceMotion { origin: from, belt, .. } = self.motion;
        let (form, belt) = match turn {
            Some(rotation) => {
                (self.form.placed(&Placement { rotation, from, to }), rotation * belt)
            }
            None => (self.form.shifted(to - from), belt),
        };
        (form, SurfaceMotion { belt, ..motion })
    }

    /// Placement after `h` \[s\] of what the surface carries, and motion of the surface then.
    pub fn placement_after(&self, h: f64) -> (Placement, SurfaceMotion) {
        let Some(course) = &self.course else { return self.motion.placement(&self.form, h) };
        let Carriage { to, turn, motion } = course.carriage(h);
        let rotation = turn.unwrap_or(DQuat::IDENTITY);
        let belt = rotation * self.motion.belt;
        (Placement { rotation, from: self.motion.origin, to }, SurfaceMotion { belt, ..motion })
    }

    /// Whether it moves, or its material does.
    pub fn carries(&self) -> bool {
        !self.motion.is_at_rest() || self.motion.belt != DVec3::ZERO
    }

    /// Returns the motion from `h` \[s\] later on, if it is not steady.
    pub fn course_after(&self, h: f64) -> Option<Course> {
        self.course.as_ref().map(|course| course.after(h))
    }

    /// Returns the mean motion between two times from now \[s\], as a steady one.
    pub fn mean_motion(&self, times: [f64; 2]) -> Option<SurfaceMotion> {
        let course = self.course.as_ref()?;
        let belt = match course.carriage(times[0]).turn {
            Some(rotation) => rotation * self.motion.belt,
            None => self.motion.belt,
        };
        Some(SurfaceMotion { belt, ..course.mean_motion(times) })
    }
}

/// Velocity of the material of a collider along its surface, in the world \[m/s\].
fn belt_of(collider: &Collider) -> DVec3 {
    let Collider { surface_velocity, pose, .. } = *collider;
    if surface_velocity == DVec3::ZERO {
        return surface_velocity;
    }
    pose.rotation.normalize() * surface_velocity
}

/// Motion of the last collider that was asked for; its surfaces share it.
#[derive(Default)]
pub(crate) struct LastCarriage(Cell<Option<(ColliderId, f64, Carriage)>>);

impl LastCarriage {
    /// Geometry and motion of a surface after `h` \[s\].
    pub fn after(&self, surface: &Surface, h: f64) -> (Form, SurfaceMotion) {
        match &surface.course {
            Some(course) => surface.carried(&self.carriage(surface, course, h)),
            None => surface.after(h),
        }
    }

    /// Returns a surface as it is after `h` \[s\].
    pub fn moved(&self, surface: &Surface, h: f64) -> Surface {
        let (form, motion) = self.after(surface, h);
        let course = surface.course_after(h).map(Arc::new);
        let common = Arc::new(Common { motion, course, ..Common::clone(surface) });
        Surface { form, common, ..*surface }
    }

    /// Origin \[m\] of the collider of a surface after `h` \[s\], and its rotation since now.
    pub fn turn_after(&self, surface: &Surface, h: f64) -> (DVec3, DQuat) {
        if let Some(course) = &surface.course {
            let Carriage { to, turn, .. } = self.carriage(surface, course, h);
            return (to, turn.unwrap_or(DQuat::IDENTITY));
        }
        let SurfaceMotion { origin, velocity, angular_velocity, .. } = surface.motion;
        let pose = Pose::at(origin).moved(velocity, angular_velocity, h);
        (pose.position, pose.rotation)
    }

    fn carriage(&self, surface: &Surface, course: &Course, h: f64) -> Carriage {
        let known = self.0.get().filter(|it| it.0 == surface.collider && it.1 == h);
        let carriage = known.map_or_else(|| course.carriage(h), |it| it.2);
        self.0.set(Some((surface.collider, h, carriage)));
        carriage
    }
}

impl SurfaceMotion {
    /// Geometry and motion after `h` \[s\] of a surface of this form that moves so.
    pub fn carry(&self, form: &Form, h: f64) -> (Form, Self) {
        if self.is_at_rest() {
            return (form.clone(), *self);
        }
        let (placement, motion) = self.placement(form, h);
        (form.placed(&placement), motion)
    }

    /// Placement after `h` \[s\] of a surface of this form that moves so, and its motion then.
    fn placement(&self, form: &Form, h: f64) -> (Placement, Self) {
        let Self { origin, velocity, angular_velocity, .. } = *self;
        let turning = if self.turns_form(form) { angular_velocity } else { DVec3::ZERO };
        let pose = Pose::at(origin).moved(velocity, turning, h);
        let placement = Placement { rotation: pose.rotation, from: origin, to: pose.position };
        let belt = if self.belt == DVec3::ZERO { self.belt } else { self.turned(self.belt, h) };
        (placement, Self { origin: pose.position, belt, ..*self })
    }
}

/// What a surface is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Role {
    /// Spheres bounce off it.
    Deflects,
    /// It reports contact and deflects nothing.
    Reports,
    /// It only tells whether a sphere is inside: the volume of a box or a closed mesh, whose faces deflect.
    Encloses,
}

/// Geometry of a surface, in the world.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Form {
    Sphere {
        center: DVec3,
        radius: f64,
    },
    Rectangle(Rectangle),
    HalfSpace {
        point: DVec3,
        normal: DVec3,
    },
    Box(SolidBox),
    Band(Band),
    Round(RoundSolid),
    /// What a closed mesh encloses.
    Closed(ClosedMesh),
    /// A face of a mesh; the next two are its edges and corners.
    Facet(Facet),
    Edge(Edge),
    Corner(Corner),
}

/// Difference between unit normals of parallel planes, at most: their rounding.
pub(crate) const PARALLEL: f64 = 8.0 * f64::EPSILON;

impl Form {
    /// Whether spheres pass it from behind.
    pub fn is_open(&self) -> bool {
        match self {
            Self::Rectangle(rectangle) => rectangle.is_open,
            Self::Band(band) => band.is_open,
            Self::Facet(facet) => facet.frame.is_open,
            Self::Edge(edge) => edge.is_open,
            Self::Corner(corner) => corner.is_open,
            _ => false,
        }
    }

    /// Whether it is a face, an edge or a corner of a mesh, which counts for the spheres nearest to it.
    pub fn is_feature(&self) -> bool {
        matches!(self, Self::Facet(_) | Self::Edge(_) | Self::Corner(_))
    }

    /// Returns the same form, met by all that overlap it from the front.
    pub fn closed(mut self) -> Self {
        match &mut self {
            Self::Rectangle(rectangle) => rectangle.is_open = false,
            Self::Band(band) => band.is_open = false,
            Self::Facet(facet) => facet.frame.is_open = false,
            Self::Edge(edge) => edge.is_open = false,
            Self::Corner(corner) => corner.is_open = false,
            _ => {}
        }
        self
    }

    /// Whether the turning of a motion leaves it as it is.
    fn is_turned_in_place_by(&self, motion: &SurfaceMotion) -> bool {
        match self {
            Self::Band(band) => band.is_turned_in_place_by(motion.origin, motion.angular_velocity),
            _ => false,
        }
    }

    /// Returns the form moved by a placement.
    pub fn placed(&self, placement: &Placement) -> Self {
        let place = |point: DVec3| placement.point(point);
        let turn = |direction: DVec3| placement.direction(direction);
        match *self {
            Self::Sphere { center, radius } => Self::Sphere { center: place(center), radius },
            Self::HalfSpace { point, normal } => {
                Self::HalfSpace { point: place(point), normal: turn(normal) }
            }
            Self::Rectangle(ref it) => Self::Rectangle(placement.rectangle(it)),
            Self::Closed(ref it) => Self::Closed(placement.closed_mesh(it)),
            Self::Facet(ref it) => Self::Facet(placement.facet(it)),
            Self::Edge(ref it) => Self::Edge(placement.edge(it)),
            Self::Corner(ref it) => Self::Corner(placement.corner(it)),
            Self::Box(b) => {
                Self::Box(SolidBox { center: place(b.center), axes: b.axes.map(turn), ..b })
            }
            Self::Band(b) => Self::Band(Band { center: place(b.center), axis: turn(b.axis), ..b }),
            Self::Round(s) => {
                Self::Round(RoundSolid { center: place(s.center), axis: turn(s.axis), ..s })
            }
        }
    }

    /// Returns the form shifted by a way \[m\].
    pub fn shifted(&self, way: DVec3) -> Self {
        let placement = Placement { rotation: DQuat::IDENTITY, from: DVec3::ZERO, to: way };
        match *self {
            Self::Sphere { center, radius } => Self::Sphere { center: center + way, radius },
            Self::HalfSpace { point, normal } => Self::HalfSpace { point: point + way, normal },
            Self::Rectangle(it) => Self::Rectangle(Rectangle { center: it.center + way, ..it }),
            Self::Closed(ref it) => Self::Closed(placement.closed_mesh(it)),
            Self::Facet(ref it) => Self::Facet(placement.facet(it)),
            Self::Edge(ref it) => Self::Edge(placement.edge(it)),
            Self::Corner(ref it) => Self::Corner(placement.corner(it)),
            Self::Band(it) => Self::Band(Band { center: it.center + way, ..it }),
            Self::Round(it) => Self::Round(RoundSolid { center: it.center + way, ..it }),
            Self::Box(it) => Self::Box(SolidBox { center: it.center + way, ..it }),
        }
    }

    /// Size of the coordinates that it is given by \[m\].
    pub fn coordinates(&self) -> f64 {
        match *self {
            Self::Sphere { center, radius } => center.norm() + radius,
            Self::HalfSpace { point, .. } => point.norm(),
            Self::Rectangle(Rectangle { center, half_x, half_z, .. }) => {
                center.norm() + half_x + half_z
            }
            Self::Box(it) => it.coordinates(),
            Self::Closed(ref it) => SolidBox::about(it).coordinates(),
            Self::Band(band) => band.coordinates(),
            Self::Round(solid) => solid.coordinates(),
            Self::Facet(Facet { frame: Rectangle { center, half_x, half_z, .. }, .. }) => {
                center.norm() + half_x + half_z
            }
            Self::Edge(Edge { center, half, .. }) => center.norm() + half,
            Self::Corner(Corner { point, .. }) => point.norm(),
        }
    }

    /// Height of its highest point above a plane, which is given by a point \[m\] and its normal.
    pub fn height_above(&self, [point, normal]: [DVec3; 2]) -> f64 {
        let height = |place: DVec3| (place - point).dot(normal);
        match *self {
            Self::Sphere { center, radius } => height(center) + radius,
            Self::HalfSpace { point, normal: own } if (own - normal).norm() <= PARALLEL => {
                height(point)
            }
            Self::HalfSpace { .. } => f64::INFINITY,
            Self::Rectangle(Rectangle { center, axis_x, axis_z, half_x, half_z, .. }) => {
                let rise = |axis: DVec3, half: f64| half * axis.dot(normal).abs();
                height(center) + rise(axis_x, half_x) + rise(axis_z, half_z)
            }
            Self::Box(it) => it.height_above([point, normal]),
            Self::Closed(ref it) => SolidBox::about(it).height_above([point, normal]),
            Self::Band(band) => height(band.center) + band.extent(normal)[1],
            Self::Round(solid) => height(solid.center) + solid.extent(normal)[1],
            Self::Facet(ref facet) => facet.height_above([point, normal]),
            Self::Edge(ref edge) => edge.height_above([point, normal]),
            Self::Corner(Corner { point, .. }) => height(point),
        }
    }
}

/// Appends the surfaces of a collider at `time` \[s\]. Those of a solid box are its volume and then its faces, in
/// the order -x, +x, -y, +y, -z, +z; those of a container its walls in the same order, each facing
/// outward and then inward. A box or a container that only reports is its volume. A solid of revolution has its volume,
/// then its side and discs; a hollow one has its walls, each facing outward and then inward. A closed mesh has what it
/// encloses before its faces.
pub(crate) fn place(id: ColliderId, collider: &Collider, time: f64, surfaces: &mut Vec<Surface>) {
    let Collider { ref shape, pose, friction, trigger, kick, groups, material, .. } = *collider;
    let restitution = BodyRestitution::of(collider.restitution, collider.restitution_law);
    let course = collider.course(time).map(Arc::new);
    let motion = match &course {
        Some(course) => SurfaceMotion { belt: belt_of(collider), ..course.place(0.0).1 },
        None => SurfaceMotion::of(collider),
    };
    let (center, rotation) = (pose.position, pose.rotation.normalize());
    let axes @ [_, y, _] = rotation::axes(rotation);
    let common = Arc::new(Common {
        collider: id,
        restitution,
        friction,
        cushion: collider.cushion.unwrap_or(0.0),
        kick,
        groups,
        material,
        motion,
        course,
    });
    let mut add = |form: Form, role| {
        let (form, role) = if trigger { (form.closed(), Role::Reports) } else { (form, role) };
        surfaces.push(Surface { form, whole: id, role, common: Arc::clone(&common) });
    };
    match *shape {
        Shape::Sphere { radius } => add(Form::Sphere { center, radius }, Role::Deflects),
        Shape::HalfSpace => add(Form::HalfSpace { point: center, normal: y }, Role::Deflects),
        Shape::Rectangle { size_x, size_z } => {
            let plate = plate(center, axes, [size_x, size_z]);
            add(Form::Rectangle(plate), Role::Deflects);
        }
        Shape::Box { size } => {
            let solid = SolidBox { center, axes, half: 0.5 * size };
            add(Form::Box(solid), Role::Encloses);
            if !trigger {
                for face in solid.faces() {
                    add(Form::Rectangle(face), Role::Deflects);
                }
            }
        }
        Shape::Container { size, open } => {
            let hollow = SolidBox { center, axes, half: 0.5 * size };
            if trigger {
                add(Form::Box(hollow), Role::Reports);
                return;
            }
            for face in hollow.walls(open) {
                add(Form::Rectangle(face), Role::Deflects);
                add(Form::Rectangle(face.turned()), Role::Deflects);
            }
        }
        Shape::Disc { radius } => {
            let profile = Profile::line(DVec2::ZERO, DVec2::new(radius, 0.0));
            add(Form::Band(Band { center, axis: y, profile, is_open: true }), Role::Deflects);
        }
        Shape::Mesh(ref mesh) => {
            let placement = Placement { rotation, from: DVec3::ZERO, to: center };
            if let Some(solid) = ClosedMesh::of(mesh) {
                add(Form::Closed(placement.closed_mesh(&solid)), Role::Encloses);
            }
            place_mesh(mesh.features(), &placement, |form| add(form, Role::Deflects));
        }
        Shape::Cylinder { .. }
        | Shape::Cone { .. }
        | Shape::Capsule { .. }
        | Shape::Torus { .. }
        | Shape::Pipe { .. }
        | Shape::Bowl { .. }
        | Shape::Funnel { .. } => place_round(shape, (center, y), trigger, add),
    }
}

/// A rectangle about `center` \[m\] with these full lengths along the first and the last of its axes \[m\].
fn plate(center: DVec3, [axis_x, normal, axis_z]: [DVec3; 3], size: [f64; 2]) -> Rectangle {
    let [half_x, half_z] = size.map(|length| 0.5 * length);
    Rectangle { center, axis_x, axis_z, normal, half_x, half_z, is_open: true }
}

/// Places a solid of revolution, its volume first, or the walls of a hollow one.
fn place_round(
    shape: &Shape,
    (center, axis): (DVec3, DVec3),
    is_trigger: bool,
    mut add: impl FnMut(Form, Role),
) {
    let Some(outline) = Outline::of(shape) else { return };
    let solid = RoundSolid { center, axis, outline };
    let is_hollow = matches!(shape, Shape::Pipe { .. } | Shape::Bowl { .. } | Shape::Funnel { .. });
    if is_trigger || !is_hollow {
        add(Form::Round(solid), Role::Encloses);
    }
    if is_trigger {
        return;
    }
    if is_hollow {
        solid.walls(shape).for_each(|wall| add(Form::Band(wall), Role::Deflects));
    } else {
        solid.bands().for_each(|band| add(Form::Band(band), Role::Deflects));
    }
}

/// Places the faces of a mesh, those that are met from both sides twice, then its edges and its corners.
pub(crate) fn place_mesh(features: &Features, placement: &Placement, mut add: impl FnMut(Form)) {
    for facet in &features.facets {
        let facet = placement.facet(facet);
        let behind = features.is_two_sided.then(|| facet.turned());
        add(Form::Facet(facet));
        behind.map(Form::Facet).into_iter().for_each(&mut add);
    }
    features.edges.iter().for_each(|edge| add(Form::Edge(placement.edge(edge))));
    features.corners.iter().for_each(|corner| add(Form::Corner(placement.corner(corner))));
}
