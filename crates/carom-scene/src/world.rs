//! Scenes to worlds.

use carom::{DQuat, DVec3, InvalidValue, Mass, Pose, Settings, World};

use crate::check::{check, check_numbers, check_positive};
use crate::error::Problem;
use crate::generate;
use crate::overlap;
use crate::scene::{
    Bisect, Boundary, Collider, CombineRule, Discrete, Emitter, Exact, Force, ImpactLaw,
    Integrator, Quaternion, Rule, Scene, Shape, Simulation, Sphere, Vector, WindBack,
};

impl Scene {
    /// The world at the start of the scene.
    ///
    /// # Errors
    /// A description of the field that makes no sense. Scenes that were read from a file or text
    /// have been checked; only one that was put together in code can fail.
    pub fn world(&self) -> Result<World, crate::SceneError> {
        build(self).map_err(|problem| problem.in_code(&self.name).into())
    }

    /// How the scene is stepped.
    pub fn settings(&self) -> Settings {
        settings(&self.simulation)
    }
}

/// The world at the start of a scene, or the first problem with it.
pub(crate) fn build(scene: &Scene) -> Result<World, Problem> {
    if scene.name.trim().is_empty() {
        return Err(Problem::new("name", "must not be empty"));
    }
    check_numbers(scene)?;
    let mut world = World::new(settings(&scene.simulation))
        .map_err(|error| settings_problem(&scene.simulation, error))?;
    add_forces(&mut world, &scene.forces)?;
    for (i, collider) in scene.colliders.iter().enumerate() {
        let path = format!("colliders[{i}]");
        let added = world.add_collider(self::collider(collider));
        added.map_err(|error| collider_problem(&path, &collider.shape, error))?;
    }
    for (i, sphere) in scene.spheres.iter().enumerate() {
        add_sphere(&mut world, sphere, &format!("spheres[{i}]"))?;
    }
    let mut first_of_generator = Vec::new();
    for (i, generator) in scene.generators.iter().enumerate() {
        first_of_generator.push(world.spheres().len());
        let path = format!("generators[{i}].{}", generate::kind(generator));
        generate::fill(&mut world, generator, &path)?;
    }
    for (i, emitter) in scene.emitters.iter().enumerate() {
        add_emitter(&mut world, emitter, &format!("emitters[{i}]"), &scene.simulation)?;
    }
    if !scene.simulation.allow_overlap {
        overlap::refuse(scene, &world, &first_of_generator)?;
    }
    Ok(world)
}

fn add_forces(world: &mut World, forces: &[Force]) -> Result<(), Problem> {
    for (i, force) in forces.iter().enumerate() {
        let kind = match force {
            Force::Constant { .. } => "constant",
            Force::Gravity { .. } => "gravity",
            Force::ViscousDrag { .. } => "viscous-drag",
        };
        let added = force.add_to(world);
        added.map_err(|error| problem(&format!("forces[{i}].{kind}"), error))?;
    }
    Ok(())
}

/// Adds an emitter written at `path`.
fn add_emitter(
    world: &mut World,
    emitter: &Emitter,
    path: &str,
    simulation: &Simulation,
) -> Result<(), Problem> {
    let emitter = self::emitter(emitter, path)?;
    world.add_emitter(emitter).map_err(|error| problem(path, error))?;
    let place = emitter.position + emitter.rotation.normalize() * emitter.sphere.position;
    let is_free = !world.meets_collider(place, emitter.sphere.radius);
    check(is_free || simulation.allow_overlap, &format!("{path}.position"), || {
        "puts spheres into a collider; move it, or set simulation.allow_overlap = true".into()
    })
}

/// Adds a sphere written at `path`.
pub(crate) fn add_sphere(world: &mut World, sphere: &Sphere, path: &str) -> Result<(), Problem> {
    let sphere = self::sphere(sphere, path)?;
    world.add_sphere(sphere).map_err(|error| problem(path, error))?;
    Ok(())
}

/// A sphere written at `path`, its numbers not yet checked.
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
    Ok(carom::Sphere::new(vector(sphere.position), radius)
        .with_velocity(vector(sphere.velocity))
        .with_mass(mass)
        .with_restitution(sphere.restitution))
}

fn collider(collider: &Collider) -> carom::Collider {
    let shape = match collider.shape {
        Shape::Sphere { radius } => carom::Shape::Sphere { radius },
        Shape::Rectangle { size_x, size_z } => carom::Shape::Rectangle { size_x, size_z },
        Shape::HalfSpace => carom::Shape::HalfSpace,
        Shape::Box { size } => carom::Shape::Box { size: vector(size) },
    };
    let pose = Pose::at(vector(collider.position)).rotated(quaternion(collider.rotation));
    let solid = carom::Collider::new(shape, pose)
        .moving(vector(collider.velocity), vector(collider.angular_velocity))
        .with_restitution(collider.restitution);
    if collider.trigger { solid.as_trigger() } else { solid }
}

fn emitter(emitter: &Emitter, path: &str) -> Result<carom::Emitter, Problem> {
    let sphere_path = format!("{path}.sphere");
    let sphere = sphere(&emitter.sphere, &sphere_path)?;
    // Adding the sphere to an empty world checks it, with its own path in the error.
    World::default().add_sphere(sphere).map_err(|error| problem(&sphere_path, error))?;
    Ok(carom::Emitter::new(sphere, emitter.period)
        .with_position(vector(emitter.position))
        .with_rotation(quaternion(emitter.rotation))
        .with_max_spheres(emitter.max_spheres))
}

fn settings(simulation: &Simulation) -> Settings {
    let rule: carom::Rule = match simulation.rule {
        Rule::Discrete => discrete(&simulation.discrete).into(),
        Rule::Bisect => bisect(&simulation.bisect).into(),
        Rule::Exact => exact(&simulation.exact).into(),
    };
    let combine_rule = match simulation.combine_rule {
        CombineRule::Product => carom::CombineRule::Product,
        CombineRule::Minimum => carom::CombineRule::Minimum,
        CombineRule::Maximum => carom::CombineRule::Maximum,
        CombineRule::Average => carom::CombineRule::Average,
    };
    let boundary = match simulation.boundary {
        Boundary::Open => carom::Boundary::Open,
        Boundary::Periodic { size } => carom::Boundary::Periodic { size: vector(size) },
    };
    Settings::default()
        .with_rule(rule)
        .with_combine_rule(combine_rule)
        .with_spheres_collide(simulation.spheres_collide)
        .with_boundary(boundary)
}

fn discrete(parameters: &Discrete) -> carom::Discrete {
    carom::Discrete::default().with_integrator(integrator(parameters.integrator))
}

fn bisect(parameters: &Bisect) -> carom::Bisect {
    let wind_back = match parameters.wind_back {
        WindBack::Touched => carom::WindBack::Touched,
        WindBack::All => carom::WindBack::All,
    };
    carom::Bisect::default()
        .with_integrator(integrator(parameters.integrator))
        .with_tolerance(parameters.tolerance)
        .with_max_halvings(parameters.max_halvings)
        .with_max_impacts(parameters.max_impacts)
        .with_wind_back(wind_back)
}

fn exact(parameters: &Exact) -> carom::Exact {
    let impact_law = match parameters.impact_law {
        ImpactLaw::Sequential => carom::ImpactLaw::Sequential,
        ImpactLaw::Simultaneous => carom::ImpactLaw::Simultaneous,
        ImpactLaw::Reflection => carom::ImpactLaw::Reflection,
    };
    carom::Exact::default()
        .with_impact_law(impact_law)
        .with_contact_duration(parameters.contact_duration)
        .with_max_impacts(parameters.max_impacts)
}

fn integrator(integrator: Integrator) -> carom::Integrator {
    match integrator {
        Integrator::SemiImplicitEuler => carom::Integrator::SemiImplicitEuler,
        Integrator::ExplicitEuler => carom::Integrator::ExplicitEuler,
        Integrator::VelocityVerlet => carom::Integrator::VelocityVerlet,
        Integrator::RungeKutta4 => carom::Integrator::RungeKutta4,
    }
}

/// A refusal of the settings, about the table they are written in.
fn settings_problem(simulation: &Simulation, error: carom::Error) -> Problem {
    let path = match &error {
        carom::Error::Invalid { source, .. } if source.field == "size" => {
            "simulation.boundary.periodic"
        }
        carom::Error::Invalid { source, .. } if source.field == "boundary" => "simulation",
        _ if simulation.rule == Rule::Exact => "simulation.exact",
        _ => "simulation.bisect",
    };
    problem(path, error)
}

/// A refusal of the physics, about what is written at `path`.
pub(crate) fn problem(path: &str, error: carom::Error) -> Problem {
    match error {
        carom::Error::Invalid { source: InvalidValue { field, requirement, value }, .. } => {
            Problem::new(format!("{path}.{field}"), format!("must be {requirement}, not {value}"))
        }
        other => Problem::new(path, other.to_string()),
    }
}

/// The problem of a field of a collider, whose lengths are written in its shape.
fn collider_problem(path: &str, shape: &Shape, error: carom::Error) -> Problem {
    let shape = match shape {
        Shape::Sphere { .. } => "sphere",
        Shape::Rectangle { .. } => "rectangle",
        Shape::HalfSpace => "half-space",
        Shape::Box { .. } => "box",
    };
    let is_length = |field: &str| field == "radius" || field.starts_with("size");
    match error {
        carom::Error::Invalid { ref source, .. } if is_length(source.field) => {
            problem(&format!("{path}.shape.{shape}"), error)
        }
        other => problem(path, other),
    }
}

pub(crate) fn vector(value: Vector) -> DVec3 {
    DVec3::from_array(value)
}

pub(crate) fn quaternion(value: Quaternion) -> DQuat {
    DQuat::from_array(value)
}
