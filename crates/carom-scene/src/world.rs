//! Scenes to worlds.

use carom::{DQuat, DVec3, InvalidValue, Mass, Pose, Settings, World};

use crate::error::Problem;
use crate::generate;
use crate::scene::{
    Bisect, Collider, Color, DensityColor, Emitter, Force, Integrator, Quaternion, RestitutionRule,
    Rule, Scene, Shape, Simulation, Sphere, Vector, WindBack,
};

impl Scene {
    /// The world at the start of the scene.
    ///
    /// # Errors
    /// A description of the field that makes no sense. Scenes that were read from a file or text
    /// have been checked; only one that was put together in code can fail.
    pub fn world(&self) -> Result<World, crate::SceneError> {
        build(self).map_err(|Problem { field, problem }| {
            let source_name = self.name.clone();
            crate::Fault { source_name, line: None, field, problem, nearest: None }.into()
        })
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
        .map_err(|error| problem("simulation.bisect", error))?;
    for (i, force) in scene.forces.iter().enumerate() {
        let added = match *force {
            Force::Constant { force } => world.add_force(carom::ConstantForce::new(vector(force))),
            Force::Gravity { acceleration } => {
                world.add_force(carom::Gravity::new(vector(acceleration)))
            }
            Force::ViscousDrag { coefficient } => {
                world.add_force(carom::ViscousDrag::new(coefficient))
            }
        };
        added.map_err(|error| problem(&format!("forces[{i}].{}", force_name(force)), error))?;
    }
    for (i, collider) in scene.colliders.iter().enumerate() {
        let added = world.add_collider(self::collider(collider));
        added.map_err(|error| {
            collider_problem(&format!("colliders[{i}]"), &collider.shape, error)
        })?;
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
        let path = format!("emitters[{i}]");
        let emitter = self::emitter(emitter, &path)?;
        world.add_emitter(emitter).map_err(|error| problem(&path, error))?;
        let place = emitter.position + emitter.rotation.normalize() * emitter.sphere.position;
        let is_free = !world.meets_collider(place, emitter.sphere.radius);
        check(is_free || scene.simulation.allow_overlap, &format!("{path}.position"), || {
            "puts spheres into a collider; move it, or set simulation.allow_overlap = true".into()
        })?;
    }
    if !scene.simulation.allow_overlap {
        refuse_overlaps(scene, &world, &first_of_generator)?;
    }
    Ok(world)
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
    Ok(carom::Sphere {
        position: vector(sphere.position),
        velocity: vector(sphere.velocity),
        radius,
        mass,
        restitution: sphere.restitution,
    })
}

fn collider(collider: &Collider) -> carom::Collider {
    let shape = match collider.shape {
        Shape::Sphere { radius } => carom::Shape::Sphere { radius },
        Shape::Rectangle { size_x, size_z } => carom::Shape::Rectangle { size_x, size_z },
        Shape::HalfSpace => carom::Shape::HalfSpace,
        Shape::Box { size } => carom::Shape::Box { size: vector(size) },
    };
    carom::Collider {
        shape,
        pose: Pose { position: vector(collider.position), rotation: quaternion(collider.rotation) },
        restitution: collider.restitution,
        trigger: collider.trigger,
    }
}

fn emitter(emitter: &Emitter, path: &str) -> Result<carom::Emitter, Problem> {
    let sphere_path = format!("{path}.sphere");
    let sphere = sphere(&emitter.sphere, &sphere_path)?;
    // Adding the sphere to an empty world checks it, with its own path in the error.
    World::default().add_sphere(sphere).map_err(|error| problem(&sphere_path, error))?;
    Ok(carom::Emitter {
        sphere,
        position: vector(emitter.position),
        rotation: quaternion(emitter.rotation),
        period: emitter.period,
        max_spheres: emitter.max_spheres,
    })
}

fn settings(simulation: &Simulation) -> Settings {
    let Bisect { tolerance, max_halvings, max_impacts, wind_back } = simulation.bisect;
    let wind_back = match wind_back {
        WindBack::Touched => carom::WindBack::Touched,
        WindBack::All => carom::WindBack::All,
    };
    Settings {
        rule: match simulation.rule {
            Rule::Discrete => carom::Rule::Discrete,
            Rule::Bisect => carom::Rule::Bisect(carom::Bisect {
                tolerance,
                max_halvings,
                max_impacts,
                wind_back,
            }),
        },
        integrator: match simulation.integrator {
            Integrator::SemiImplicitEuler => carom::Integrator::SemiImplicitEuler,
            Integrator::ExplicitEuler => carom::Integrator::ExplicitEuler,
            Integrator::VelocityVerlet => carom::Integrator::VelocityVerlet,
            Integrator::RungeKutta4 => carom::Integrator::RungeKutta4,
        },
        restitution_rule: match simulation.restitution_rule {
            RestitutionRule::Product => carom::RestitutionRule::Product,
            RestitutionRule::Minimum => carom::RestitutionRule::Minimum,
            RestitutionRule::Maximum => carom::RestitutionRule::Maximum,
            RestitutionRule::Average => carom::RestitutionRule::Average,
        },
        spheres_collide: simulation.spheres_collide,
    }
}

/// Numbers that no part of the world looks at.
fn check_numbers(scene: &Scene) -> Result<(), Problem> {
    let Simulation { frame_time, duration, .. } = scene.simulation;
    check_positive(frame_time, "simulation.frame_time")?;
    check_positive(duration, "simulation.duration")?;
    if let Some(camera) = &scene.camera {
        let fov = camera.vertical_fov_degrees;
        check(fov > 0.0 && fov < 180.0, "camera.vertical_fov_degrees", || {
            format!("must be between 0 and 180, not {fov}")
        })?;
        check_positive(camera.near, "camera.near")?;
        check(camera.far > camera.near && camera.far.is_finite(), "camera.far", || {
            format!("must be farther than `near`, not {}", camera.far)
        })?;
        check_vector(camera.position, "camera.position")?;
        check_rotation(camera.rotation, "camera.rotation")?;
    }
    if let Some(sun) = &scene.sun {
        check_rotation(sun.rotation, "sun.rotation")?;
        check(sun.intensity >= 0.0 && sun.intensity.is_finite(), "sun.intensity", || {
            format!("must be zero or positive, and finite, not {}", sun.intensity)
        })?;
    }
    for (path, color) in colors(scene) {
        check(color.iter().all(|part| (0.0..=1.0).contains(part)), &path, || {
            format!("must have three parts in [0, 1], not {color:?}")
        })?;
    }
    let densities = scene.colors.iter().flat_map(|colors| &colors.densities).enumerate();
    for (i, DensityColor { density, .. }) in densities {
        check_positive(*density, &format!("colors.densities[{i}].density"))?;
    }
    check_tolerance(scene)?;
    Ok(())
}

/// Every colour in a scene, with its path.
fn colors(scene: &Scene) -> Vec<(String, Color)> {
    let mut colors = Vec::new();
    let mut add = |path: String, color: Option<Color>| colors.extend(color.map(|c| (path, c)));
    for (i, sphere) in scene.spheres.iter().enumerate() {
        add(format!("spheres[{i}].color"), sphere.color);
    }
    for (i, generator) in scene.generators.iter().enumerate() {
        let path = format!("generators[{i}].{}.sphere.color", generate::kind(generator));
        add(path, generate::template(generator).color);
    }
    for (i, collider) in scene.colliders.iter().enumerate() {
        add(format!("colliders[{i}].color"), collider.color);
    }
    for (i, emitter) in scene.emitters.iter().enumerate() {
        add(format!("emitters[{i}].sphere.color"), emitter.sphere.color);
    }
    add("sun.color".to_owned(), scene.sun.as_ref().map(|sun| sun.color));
    if let Some(own) = &scene.colors {
        add("colors.background".to_owned(), own.background);
        add("colors.colliders".to_owned(), own.colliders);
        add("colors.spheres".to_owned(), own.spheres);
        for (i, density) in own.densities.iter().enumerate() {
            add(format!("colors.densities[{i}].color"), Some(density.color));
        }
    }
    colors
}

pub(crate) fn check(
    holds: bool,
    path: &str,
    problem: impl FnOnce() -> String,
) -> Result<(), Problem> {
    if holds { Ok(()) } else { Err(Problem::new(path, problem())) }
}

pub(crate) fn check_positive(value: f64, path: &str) -> Result<(), Problem> {
    check(value > 0.0 && value.is_finite(), path, || {
        format!("must be positive and finite, not {value}")
    })
}

pub(crate) fn check_vector(value: Vector, path: &str) -> Result<(), Problem> {
    check(vector(value).is_finite(), path, || format!("must be finite, not {value:?}"))
}

fn check_rotation(value: Quaternion, path: &str) -> Result<(), Problem> {
    let length_squared = quaternion(value).length_squared();
    check(length_squared.is_finite() && length_squared >= f64::MIN_POSITIVE, path, || {
        format!("must be a quaternion x, y, z, w that is finite and not zero, not {value:?}")
    })
}

/// Refuses spheres that overlap each other or a collider by more than rounding.
fn refuse_overlaps(
    scene: &Scene,
    world: &World,
    first_of_generator: &[usize],
) -> Result<(), Problem> {
    let is_real = |overlap: &carom::Overlap| overlap.depth > rounding(world, overlap);
    let Some(overlap) = world.overlaps(0.0).into_iter().find(is_real) else {
        return Ok(());
    };
    let index = |sphere: carom::SphereId| sphere.number() as usize;
    let path = |sphere: carom::SphereId| match first_of_generator
        .partition_point(|&first| first <= index(sphere))
    {
        0 => format!("spheres[{}]", index(sphere)),
        generator => format!("generators[{}]", generator - 1),
    };
    let (sphere, other) = match overlap.between {
        carom::Participants::Spheres(first, second) => {
            (second, format!("sphere number {} ({})", first.number(), path(first)))
        }
        carom::Participants::Collider { collider, sphere } => {
            let number = collider.number();
            (sphere, format!("colliders[{number}] \"{}\"", scene.colliders[number].name))
        }
    };
    let text = format!(
        "sphere number {} overlaps {other} by {:.3e} m at the start; move it, or set \
         simulation.allow_overlap = true",
        sphere.number(),
        overlap.depth,
    );
    Err(Problem::new(path(sphere), text))
}

/// Overlap \[m\] that bodies meant to touch can have: coordinates in a file have fewer digits than
/// a double, and those far from the origin are coarse.
fn rounding(world: &World, overlap: &carom::Overlap) -> f64 {
    const OF_RADIUS: f64 = 1e-9;
    const OF_COORDINATES: f64 = 8.0 * f64::EPSILON;
    let of_sphere = |id: carom::SphereId| {
        let index = id.number() as usize;
        let (radius, center) = (world.spheres().radii()[index], world.spheres().positions()[index]);
        (radius, center.abs().max_element())
    };
    let (radius, coordinate) = match overlap.between {
        carom::Participants::Collider { sphere, .. } => of_sphere(sphere),
        carom::Participants::Spheres(first, second) => {
            let (first, second) = (of_sphere(first), of_sphere(second));
            (first.0.min(second.0), first.1.max(second.1))
        }
    };
    OF_RADIUS * radius + OF_COORDINATES * coordinate
}

/// Refuses a touching distance that is no longer small against the smallest sphere.
fn check_tolerance(scene: &Scene) -> Result<(), Problem> {
    let spheres = scene.spheres.iter().chain(scene.generators.iter().map(generate::template));
    let spheres = spheres.chain(scene.emitters.iter().map(|emitter| &emitter.sphere));
    let radii = spheres.filter_map(|s| s.radius.or(s.diameter.map(|diameter| 0.5 * diameter)));
    let smallest = radii.filter(|radius| *radius > 0.0).fold(f64::INFINITY, f64::min);
    let tolerance = scene.simulation.bisect.tolerance;
    let is_used = scene.simulation.rule == Rule::Bisect;
    check(!is_used || tolerance <= 0.01 * smallest, "simulation.bisect.tolerance", || {
        format!("must be at most 1/100 of the smallest radius, {smallest}, not {tolerance}")
    })
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

/// Likewise for a collider, whose lengths are written in its shape.
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

fn force_name(force: &Force) -> &'static str {
    match force {
        Force::Constant { .. } => "constant",
        Force::Gravity { .. } => "gravity",
        Force::ViscousDrag { .. } => "viscous-drag",
    }
}

pub(crate) fn vector(value: Vector) -> DVec3 {
    DVec3::from_array(value)
}

fn quaternion(value: Quaternion) -> DQuat {
    DQuat::from_array(value)
}
