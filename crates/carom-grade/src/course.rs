//! The parts of a scene that the course's rule uses.

use carom::{CombineRule, DQuat, DVec3, Shape};
use carom_scene::Scene;
use carom_scene::scene::{self, Boundary, Force, Integrator, Rule};

use crate::error::GradeError;

/// A scene as the course's rule uses it.
#[derive(Debug, Clone)]
pub struct Course {
    /// Name of the scene.
    pub name: String,
    /// Length of a frame \[s\].
    pub frame_time: f64,
    /// Duration of the scene \[s\].
    pub duration: f64,
    /// Time by which a frame moves the balls \[s\]: the length of a frame.
    pub(crate) step: f64,
    /// Fraction of the tangential velocity that a bounce leaves: 1.
    pub(crate) tangential: f64,
    pub(crate) combine_rule: CombineRule,
    /// Forces, in the order in which they are summed.
    pub(crate) forces: Vec<Acting>,
    /// Balls at the start.
    pub(crate) balls: Vec<Kind>,
    pub(crate) emitters: Vec<Source>,
    /// Colliders, in the order in which they are tested for each ball.
    pub(crate) colliders: Vec<Fixed>,
}

/// A force on every ball.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Acting {
    /// Force \[N\].
    Constant(DVec3),
    /// Acceleration \[m/s²\].
    Gravity(DVec3),
    /// Coefficient of viscous drag \[kg/s\].
    Drag(f64),
}

/// Properties of a ball at its start.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kind {
    /// Position \[m\].
    pub position: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
    /// Radius \[m\].
    pub radius: f64,
    /// Mass \[kg\].
    pub mass: f64,
    pub restitution: f64,
}

/// An emitter.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Source {
    /// The emitted ball, in world coordinates.
    pub ball: Kind,
    /// Period \[s\].
    pub period: f64,
    /// Most balls of this emitter at one time.
    pub max: Option<usize>,
    /// Number of balls that it emits in all.
    pub count: Option<u64>,
}

/// A collider off which balls bounce.
#[derive(Debug, Clone)]
pub(crate) struct Fixed {
    /// Name of the collider.
    pub name: String,
    /// Index of the collider in the scene; the faces of a box share one.
    pub collider: usize,
    pub restitution: f64,
    pub form: Form,
    /// The surface of a program that takes the degrees of the rotation for radians.
    pub in_degrees: Form,
}

/// Geometry of a surface in the world.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Form {
    Sphere {
        /// Centre \[m\].
        center: DVec3,
        /// Radius \[m\].
        radius: f64,
        /// Axes of its own coordinate system.
        axes: [DVec3; 3],
    },
    Rectangle {
        /// Centre \[m\].
        center: DVec3,
        /// Axes of its own coordinate system; the second is the normal.
        axes: [DVec3; 3],
        /// Half lengths along the first and third axis \[m\].
        half: [f64; 2],
    },
}

impl Course {
    /// Reads a scene.
    ///
    /// # Errors
    /// [`GradeError::NotOfTheCourse`] if the scene has a part that the rule of the course does not
    /// support.
    pub fn of(scene: &Scene) -> Result<Self, GradeError> {
        let refuse = |what: &str| GradeError::NotOfTheCourse {
            scene: scene.name.clone(),
            what: what.to_owned(),
        };
        if let Some(what) = unknown_part(scene) {
            return Err(refuse(what));
        }
        // The world checks every number.
        let world = scene.world()?;
        let spheres = world.spheres();
        let balls = (0..spheres.len()).map(|index| kind(&spheres.get(index))).collect();
        let mut emitters = Vec::new();
        for emitter in &scene.emitters {
            emitters.push(source(&emitter.emitter()?));
        }
        let mut colliders = Vec::new();
        for (number, collider) in scene.colliders.iter().enumerate() {
            let name = match collider.name.as_str() {
                "" => format!("collider {number}"),
                name => name.to_owned(),
            };
            let rotation = DQuat::from_array(collider.rotation).normalize();
            let shaped = |rotation| {
                forms(collider, rotation).ok_or_else(|| refuse("a collider of another shape"))
            };
            for (form, in_degrees) in
                shaped(rotation)?.into_iter().zip(shaped(in_degrees(rotation))?)
            {
                let (name, restitution) = (name.clone(), collider.restitution);
                colliders.push(Fixed { name, collider: number, restitution, form, in_degrees });
            }
        }
        Ok(Self {
            name: scene.name.clone(),
            frame_time: scene.simulation.frame_time,
            duration: scene.simulation.duration,
            step: scene.simulation.frame_time,
            tangential: 1.0,
            combine_rule: scene.settings().combine_rule,
            forces: scene.forces.iter().filter_map(acting).collect(),
            balls,
            emitters,
            colliders,
        })
    }

    /// Sum of the coefficients of viscous drag \[kg/s\].
    pub(crate) fn drag(&self) -> f64 {
        let own = |force: &Acting| if let Acting::Drag(own) = force { *own } else { 0.0 };
        self.forces.iter().map(own).sum()
    }

    /// Properties of all balls at their start.
    pub(crate) fn starts_mut(&mut self) -> impl Iterator<Item = &mut Kind> {
        self.emitters.iter_mut().map(|it| &mut it.ball).chain(&mut self.balls)
    }

    /// Most balls at one time; `None` without a limit.
    pub(crate) fn capacity(&self) -> Option<usize> {
        let emitted = self.emitters.iter().map(|it| match (it.max, it.count) {
            (Some(max), Some(count)) => Some(max.min(count as usize)),
            (max, count) => max.or(count.map(|count| count as usize)),
        });
        emitted.sum::<Option<usize>>().map(|emitted| emitted + self.balls.len())
    }
}

/// Names a part of the scene that the rule of the course does not support.
fn unknown_part(scene: &Scene) -> Option<&'static str> {
    let simulation = &scene.simulation;
    let needs_room = |it: &scene::Emitter| it.needs_room == Some(true);
    let moves = |it: &scene::Collider| it.velocity != [0.0; 3] || it.angular_velocity != [0.0; 3];
    if simulation.rule != Rule::Discrete {
        Some("another rule than `discrete`")
    } else if simulation.discrete.integrator != Integrator::SemiImplicitEuler {
        Some("another integrator than semi-implicit Euler")
    } else if simulation.spheres_collide {
        Some("balls that collide with one another (`spheres_collide = false` lets them pass)")
    } else if simulation.boundary != Boundary::Open {
        Some("a boundary")
    } else if !scene.generators.is_empty() {
        Some("generators")
    } else if scene.emitters.iter().any(needs_room) {
        Some("emitters that need room")
    } else if scene.colliders.iter().any(moves) {
        Some("colliders that move")
    } else if !scene.springs.is_empty() {
        Some("springs")
    } else if scene.forces.iter().any(|force| acting(force).is_none()) {
        Some("forces that the course does not have")
    } else if scene.emitters.is_empty() && scene.spheres.is_empty() {
        Some("no ball and no emitter")
    } else {
        None
    }
}

/// Converts a force; `None` if the course does not have it.
fn acting(force: &Force) -> Option<Acting> {
    match *force {
        Force::Constant { force } => Some(Acting::Constant(DVec3::from_array(force))),
        Force::Gravity { acceleration } => Some(Acting::Gravity(DVec3::from_array(acceleration))),
        Force::ViscousDrag { coefficient } => Some(Acting::Drag(coefficient)),
        _ => None,
    }
}

fn kind(sphere: &carom::Sphere) -> Kind {
    let &carom::Sphere { position, velocity, radius, restitution, .. } = sphere;
    Kind { position, velocity, radius, mass: sphere.kilograms(), restitution }
}

fn source(emitter: &carom::Emitter) -> Source {
    let rotation = emitter.rotation.normalize();
    let own = kind(&emitter.sphere);
    let ball = Kind {
        position: emitter.position + rotation * own.position,
        velocity: rotation * own.velocity,
        ..own
    };
    Source {
        ball,
        period: emitter.period,
        max: emitter.max_spheres.map(|max| max as usize),
        count: emitter.count.map(u64::from),
    }
}

/// Surfaces of a collider, none for a trigger; `None` if the course does not have the shape.
fn forms(collider: &scene::Collider, rotation: DQuat) -> Option<Vec<Form>> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| rotation * axis);
    let center = DVec3::from_array(collider.position);
    let forms = match carom::Shape::from(&collider.shape) {
        Shape::Sphere { radius } => vec![Form::Sphere { center, radius, axes }],
        Shape::Rectangle { size_x, size_z } => {
            vec![Form::Rectangle { center, axes, half: [0.5 * size_x, 0.5 * size_z] }]
        }
        Shape::Box { size } => faces(center, axes, 0.5 * size),
        _ => return None,
    };
    Some(if collider.trigger { Vec::new() } else { forms })
}

/// The rotation whose angle in radians is the number of degrees of this one.
fn in_degrees(rotation: DQuat) -> DQuat {
    let (axis, angle) = rotation.to_axis_angle();
    DQuat::from_axis_angle(axis, angle.to_degrees())
}

/// Faces of a box with outward normals, in the order -x, +x, -y, +y, -z, +z.
fn faces(center: DVec3, axes: [DVec3; 3], half: DVec3) -> Vec<Form> {
    let face = |number: usize| {
        let axis = number / 2;
        let (first, second) = [(1, 2), (0, 2), (0, 1)][axis];
        let normal = if number.is_multiple_of(2) { -axes[axis] } else { axes[axis] };
        Form::Rectangle {
            center: center + half[axis] * normal,
            axes: [axes[first], normal, axes[second]],
            half: [half[first], half[second]],
        }
    };
    (0..6).map(face).collect()
}
