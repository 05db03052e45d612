//! Converts spheres, colliders and emitters of scenes into those of `carom`.

use carom::{Ends, Friction, Groups, Mass, Pose, Sides, World};

use crate::error::{Problem, SceneError};
use crate::materials::{MaterialNumbers, friction};
use crate::requirement::{check_energy, check_positive};
use crate::scene::values::{quaternion, vector};
use crate::scene::{Collider, Emitter, End, RestitutionLaw, Shape, Side, Sphere};
use crate::{meshes, strike, track};

/// Adds the sphere that stands at `path` in the scene.
pub(crate) fn add_sphere(
    world: &mut World,
    sphere: &Sphere,
    path: &str,
    materials: &MaterialNumbers,
) -> Result<(), Problem> {
    let material = materials.number(sphere.material.as_deref(), path)?;
    let sphere = self::sphere(sphere, path)?.with_material(material);
    check_energy(&sphere, &format!("{path}.velocity"))?;
    world.add_sphere(sphere).map_err(|error| Problem::of_physics(path, error))?;
    Ok(())
}

/// Converts the sphere that stands at `path`; its numbers are not yet checked.
pub(crate) fn sphere(sphere: &Sphere, path: &str) -> Result<carom::Sphere, Problem> {
    let radius = match (sphere.radius, sphere.diameter) {
        (Some(radius), None) => radius,
        (None, Some(diameter)) => {
            check_positive(diameter, &format!("{path}.diameter"))?;
            0.5 * diameter
        }
        (None, None) => return Err(Problem::new(path, "needs `radius` or `diameter`")),
        (Some(_), Some(_)) => {
            return Err(Problem::new(format!("{path}.diameter"), "`radius` says it already"));
        }
    };
    let mass = match (sphere.mass, sphere.density) {
        (None, None) => Mass::Kilograms(1.0),
        (Some(mass), None) => Mass::Kilograms(mass),
        (None, Some(density)) => Mass::Density(density),
        (Some(_), Some(_)) => {
            return Err(Problem::new(format!("{path}.density"), "`mass` says it already"));
        }
    };
    let physical = carom::Sphere::new(vector(sphere.position), radius)
        .with_velocity(vector(sphere.velocity))
        .with_growth_speed(sphere.growth_speed)
        .with_mass(mass)
        .with_restitution(sphere.restitution)
        .with_friction(friction(
            [sphere.friction, sphere.rolling_friction, sphere.spinning_friction],
            sphere.tangential_restitution,
        ))
        .with_orientation(quaternion(sphere.orientation))
        .with_angular_velocity(vector(sphere.angular_velocity))
        .with_inertia_factor(sphere.inertia_factor)
        .with_groups(Groups { groups: sphere.groups, collides_with: sphere.collides_with })
        .with_user_data(sphere.user_data);
    let law = sphere.restitution_law;
    let physical = law.map_or(physical, |law| physical.with_restitution_law(law.into()));
    match &sphere.strike {
        Some(strike) => strike::struck(physical, strike, &format!("{path}.strike")),
        None => Ok(physical),
    }
}

impl Sphere {
    /// Converts a sphere of `carom` to the fields of a scene file, without a colour of its own.
    pub fn of(sphere: &carom::Sphere) -> Self {
        let (mass, density) = match sphere.mass {
            Mass::Kilograms(mass) => (Some(mass), None),
            Mass::Density(density) => (None, Some(density)),
        };
        Self {
            velocity: sphere.velocity.to_array(),
            growth_speed: sphere.growth_speed,
            mass,
            density,
            restitution: sphere.restitution,
            restitution_law: sphere.restitution_law.and_then(RestitutionLaw::of),
            friction: sphere.friction.sliding,
            rolling_friction: sphere.friction.rolling,
            spinning_friction: sphere.friction.spinning,
            tangential_restitution: sphere.friction.tangential_restitution,
            orientation: sphere.orientation.to_array(),
            angular_velocity: sphere.angular_velocity.to_array(),
            inertia_factor: sphere.inertia_factor,
            groups: sphere.groups.groups,
            collides_with: sphere.groups.collides_with,
            user_data: sphere.user_data,
            ..Self::at(sphere.position.to_array(), sphere.radius)
        }
    }
}

impl Collider {
    /// Friction fields of the sphere or collider, as `carom` has them.
    pub fn surface_friction(&self) -> Friction {
        let coefficients = [self.friction, self.rolling_friction, self.spinning_friction];
        friction(coefficients, self.tangential_restitution)
    }

    /// Sets the four friction fields.
    pub fn set_surface_friction(&mut self, friction: Friction) {
        self.friction = friction.sliding;
        self.rolling_friction = friction.rolling;
        self.spinning_friction = friction.spinning;
        self.tangential_restitution = friction.tangential_restitution;
    }
}

impl Emitter {
    /// Converts the emitter to one of `carom`.
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if a field of the emitter's sphere is invalid; it names the field.
    pub fn emitter(&self) -> Result<carom::Emitter, SceneError> {
        emitter(self, "emitter").map_err(|problem| problem.in_code(&self.name).into())
    }
}

impl Shape {
    /// Converts the shape without checking its numbers; meshes are read from their files.
    ///
    /// # Errors
    /// What is wrong with a mesh or a height field, in words.
    pub fn physical(&self) -> Result<carom::Shape, String> {
        Ok(match self {
            Self::Sphere { radius } => carom::Shape::Sphere { radius: *radius },
            Self::Rectangle { size_x, size_z } => {
                carom::Shape::Rectangle { size_x: *size_x, size_z: *size_z }
            }
            Self::HalfSpace => carom::Shape::HalfSpace,
            Self::Box { size } => carom::Shape::Box { size: vector(*size) },
            Self::Container { size, open } => {
                carom::Shape::Container { size: vector(*size), open: sides(open) }
            }
            Self::Cylinder { radius, height } => {
                carom::Shape::Cylinder { radius: *radius, height: *height }
            }
            Self::Cone { bottom_radius, top_radius, height } => carom::Shape::Cone {
                bottom_radius: *bottom_radius,
                top_radius: *top_radius,
                height: *height,
            },
            Self::Capsule { radius, length } => {
                carom::Shape::Capsule { radius: *radius, length: *length }
            }
            Self::Disc { radius } => carom::Shape::Disc { radius: *radius },
            Self::Torus { ring_radius, tube_radius } => {
                carom::Shape::Torus { ring_radius: *ring_radius, tube_radius: *tube_radius }
            }
            Self::Pipe { radius, length, closed } => {
                let [bottom, top] = [End::Bottom, End::Top].map(|end| closed.contains(&end));
                carom::Shape::Pipe {
                    radius: *radius,
                    length: *length,
                    closed: Ends { bottom, top },
                }
            }
            Self::Bowl { radius, opening_degrees } => {
                carom::Shape::Bowl { radius: *radius, opening: opening_degrees.to_radians() }
            }
            Self::Funnel { bottom_radius, top_radius, height } => carom::Shape::Funnel {
                bottom_radius: *bottom_radius,
                top_radius: *top_radius,
                height: *height,
            },
            Self::Mesh(mesh) => carom::Shape::Mesh(mesh.mesh(meshes::made)?),
            Self::HeightField(heights) => carom::Shape::Mesh(heights.mesh()?),
            Self::Track(track) => carom::Shape::Mesh(track.mesh(track::mesh)?),
        })
    }
}

fn sides(sides: &[Side]) -> Sides {
    Sides {
        left: sides.contains(&Side::Left),
        right: sides.contains(&Side::Right),
        bottom: sides.contains(&Side::Bottom),
        top: sides.contains(&Side::Top),
        back: sides.contains(&Side::Back),
        front: sides.contains(&Side::Front),
    }
}

/// Converts a collider without its motion; its numbers are not yet checked. The error says what is wrong with a mesh.
pub(crate) fn collider(collider: &Collider) -> Result<carom::Collider, String> {
    let shape = collider.shape.physical()?;
    let pose = Pose::at(vector(collider.position)).rotated(quaternion(collider.rotation));
    let solid = carom::Collider::new(shape, pose)
        .moving(vector(collider.velocity), vector(collider.angular_velocity))
        .with_restitution(collider.restitution)
        .with_friction(collider.surface_friction())
        .with_surface_velocity(vector(collider.surface_velocity))
        .with_kick(collider.kick)
        .with_groups(Groups { groups: collider.groups, collides_with: collider.collides_with })
        .with_user_data(collider.user_data);
    let solid = match collider.cushion {
        Some(ratio) => solid.with_cushion(ratio),
        None => solid,
    };
    let law = collider.restitution_law;
    let solid = match law {
        Some(law) => solid.with_restitution_law(law.into()),
        None => solid,
    };
    Ok(match (collider.trigger, collider.capture) {
        (false, false) => solid,
        (true, false) => solid.as_trigger(),
        (_, true) => solid.capturing(),
    })
}

/// Converts the emitter that stands at `path`; only its sphere is checked.
pub(crate) fn emitter(emitter: &Emitter, path: &str) -> Result<carom::Emitter, Problem> {
    let sphere_path = format!("{path}.sphere");
    let sphere = sphere(&emitter.sphere, &sphere_path)?;
    // Adding the sphere to an empty world checks it, with its own path in the error.
    World::default()
        .add_sphere(sphere)
        .map_err(|error| Problem::of_physics(&sphere_path, error))?;
    Ok(carom::Emitter::new(sphere, emitter.period)
        .with_position(vector(emitter.position))
        .with_rotation(quaternion(emitter.rotation))
        .with_max_spheres(emitter.max_spheres)
        .with_count(emitter.count)
        .with_needs_room(emitter.needs_room))
}
