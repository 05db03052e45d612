//! Bodies of a world in the extension `KHR_physics_rigid_bodies`, for physics in other programs.

use carom::{Collider, DQuat, DVec3, Friction, SOLID_BALL, Shape, Sphere};
use carom_scene::scene::{CombineRule, Force, Scene};

use crate::rigid_body::{
    self, BoxShape, Combine, Geometry, Motion, NodeBody, PhysicsMaterial, PlaneShape, RigidBodies,
    Shapes, SphereShape,
};

/// Gravity on a body with factor 1 \[m/s²\].
const GRAVITY: f64 = 9.81;

/// Shapes and materials, to which bodies refer by index.
#[derive(Debug)]
pub(super) struct Bodies {
    pub shapes: Shapes,
    pub materials: RigidBodies,
    gravity_factor: f64,
    friction_combine: Combine,
    restitution_combine: Combine,
}

impl Bodies {
    /// Creates the bodies of a scene, which are still empty.
    pub fn new(scene: &Scene) -> Self {
        let downward = |force: &Force| match force {
            Force::Gravity { acceleration } => -acceleration[1] / GRAVITY,
            _ => 0.0,
        };
        let simulation = &scene.simulation;
        Self {
            shapes: Shapes::default(),
            materials: RigidBodies::default(),
            gravity_factor: scene.forces.iter().map(downward).sum(),
            friction_combine: combine(simulation.friction_combine_rule),
            restitution_combine: combine(simulation.combine_rule),
        }
    }

    /// Creates the body of a sphere whose node is scaled by its radius.
    pub fn sphere(&mut self, sphere: &Sphere) -> Box<NodeBody> {
        let (mass, radius) = (sphere.kilograms(), sphere.radius);
        let inertia = sphere.inertia_factor * mass * radius * radius;
        let other_inertia = sphere.inertia_factor != SOLID_BALL;
        let motion = Motion {
            mass: Some(mass),
            inertia_diagonal: other_inertia.then_some([inertia; 3]),
            gravity_factor: (self.gravity_factor != 1.0).then_some(self.gravity_factor),
            ..moving(sphere.velocity, sphere.angular_velocity, sphere.orientation)
        };
        let shape = self.shape(unit_sphere());
        let material = self.material(sphere.restitution, sphere.friction);
        let collider = Some(with_shape(shape, Some(material)));
        Box::new(NodeBody { motion: Some(motion), collider, ..NodeBody::default() })
    }

    /// Creates the body of a collider whose node is scaled by its size. The walls of a container
    /// have bodies of their own.
    pub fn collider(&mut self, collider: &Collider) -> Option<Box<NodeBody>> {
        let shape = match collider.shape {
            Shape::Sphere { .. } => Some(unit_sphere()),
            Shape::Rectangle { .. } => Some(plane(Some(1.0), false)),
            Shape::HalfSpace => Some(plane(None, false)),
            Shape::Box { .. } => Some(rigid_body::Shape {
                kind: "box".to_owned(),
                solid_box: Some(BoxShape::default()),
                ..rigid_body::Shape::default()
            }),
            _ => None,
        };
        let mut body = shape.map_or_else(NodeBody::default, |it| self.fixed(it, collider));
        let Collider { velocity, angular_velocity, pose, .. } = *collider;
        if !collider.motion.is_empty() {
            // Its animation says how it moves.
            body.motion = Some(Motion { is_kinematic: true, ..Motion::default() });
        } else if velocity != DVec3::ZERO || angular_velocity != DVec3::ZERO {
            let motion = moving(velocity, angular_velocity, pose.rotation);
            body.motion = Some(Motion { is_kinematic: true, ..motion });
        }
        let is_empty = body.motion.is_none() && body.collider.is_none() && body.trigger.is_none();
        (!is_empty).then(|| Box::new(body))
    }

    /// Creates the body of a wall of a container, 1 by 1; spheres bounce off both sides.
    pub fn wall(&mut self, container: &Collider) -> Box<NodeBody> {
        Box::new(self.fixed(plane(Some(1.0), true), container))
    }

    fn fixed(&mut self, shape: rigid_body::Shape, collider: &Collider) -> NodeBody {
        let shape = self.shape(shape);
        if collider.trigger {
            let trigger = Some(with_shape(shape, None));
            return NodeBody { trigger, ..NodeBody::default() };
        }
        let material = self.material(collider.restitution, collider.friction);
        let collider = Some(with_shape(shape, Some(material)));
        NodeBody { collider, ..NodeBody::default() }
    }

    fn shape(&mut self, shape: rigid_body::Shape) -> usize {
        place_of(&mut self.shapes.shapes, shape)
    }

    fn material(&mut self, restitution: f64, friction: Friction) -> usize {
        // Without friction of its own, a collider takes that of its partner; the format cannot
        // express this.
        let friction = friction.sliding.unwrap_or(0.0);
        let material = PhysicsMaterial {
            static_friction: friction,
            dynamic_friction: friction,
            restitution,
            friction_combine: self.friction_combine,
            restitution_combine: self.restitution_combine,
        };
        place_of(&mut self.materials.physics_materials, material)
    }
}

/// Index of a value in a list; appends it if it is missing.
pub(super) fn place_of<T: PartialEq>(list: &mut Vec<T>, value: T) -> usize {
    list.iter().position(|it| *it == value).unwrap_or_else(|| {
        list.push(value);
        list.len() - 1
    })
}

/// Converts velocities in world coordinates to those of a node with this rotation.
fn moving(velocity: DVec3, angular_velocity: DVec3, rotation: DQuat) -> Motion {
    let rotation = rotation.normalize();
    let local = |vector: DVec3| {
        // Without a rotation, avoid its rounding errors.
        let is_turned = rotation != DQuat::IDENTITY;
        let local = if is_turned { rotation.inverse() * vector } else { vector };
        (vector != DVec3::ZERO).then_some(local.to_array())
    };
    Motion {
        linear_velocity: local(velocity),
        angular_velocity: local(angular_velocity),
        ..Motion::default()
    }
}

fn with_shape(shape: usize, physics_material: Option<usize>) -> rigid_body::Collider {
    let geometry = Some(Geometry { shape: Some(shape), ..Geometry::default() });
    rigid_body::Collider { geometry, physics_material, ..rigid_body::Collider::default() }
}

fn unit_sphere() -> rigid_body::Shape {
    rigid_body::Shape {
        kind: "sphere".to_owned(),
        sphere: Some(SphereShape { radius: 1.0 }),
        ..rigid_body::Shape::default()
    }
}

fn plane(size: Option<f64>, double_sided: bool) -> rigid_body::Shape {
    rigid_body::Shape {
        kind: "plane".to_owned(),
        plane: Some(PlaneShape { size_x: size, size_z: size, double_sided }),
        ..rigid_body::Shape::default()
    }
}

/// Nearest combine mode; the format has no geometric mean.
fn combine(rule: CombineRule) -> Combine {
    match rule {
        CombineRule::Product => Combine::Multiply,
        CombineRule::Minimum => Combine::Minimum,
        CombineRule::Maximum => Combine::Maximum,
        CombineRule::Average | CombineRule::GeometricMean => Combine::Average,
    }
}
