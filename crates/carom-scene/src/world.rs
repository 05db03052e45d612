//! Creates worlds from scenes.

use carom::{DVec3, Sides, SphereMotion, World};

use crate::bodies::{add_sphere, collider, emitter};
use crate::budget::Budget;
use crate::check::{check_numbers, check_texts};
use crate::error::Problem;
use crate::generate;
use crate::materials::{self, MaterialNumbers};
use crate::meshes;
use crate::motion;
use crate::overlap;
use crate::requirement::check;
use crate::scene::{Boundary, Collider, Emitter, Force, Scene, Shape, Simulation};
use crate::settings::settings_problem;
use crate::springs;

impl Scene {
    /// Creates the world of the scene at its start.
    ///
    /// # Errors
    /// [`SceneError::Invalid`](crate::SceneError::Invalid) with the field that is invalid. Scenes
    /// read from a file or text were checked, so only a scene built in code can fail.
    pub fn world(&self) -> Result<World, crate::SceneError> {
        build(self, Budget::MOST).map_err(|problem| problem.in_code(&self.name).into())
    }
}

/// Creates the world of a scene within `budget`; returns the first problem.
pub(crate) fn build(scene: &Scene, budget: Budget) -> Result<World, Problem> {
    if scene.name.trim().is_empty() {
        return Err(Problem::new("name", "must not be empty"));
    }
    check_texts(scene)?;
    check_numbers(scene)?;
    budget.check(scene)?;
    meshes::check_files(scene, budget)?;
    let mut world =
        World::new(scene.settings()).map_err(|error| settings_problem(&scene.simulation, error))?;
    add_forces(&mut world, &scene.forces)?;
    let materials = MaterialNumbers::of(scene);
    materials::add_pairs(&mut world, scene, &materials)?;
    for (i, collider) in scene.colliders.iter().enumerate() {
        add_collider(&mut world, collider, &format!("colliders[{i}]"), &materials)?;
    }
    for (i, generator) in scene.generators.iter().enumerate() {
        let path = format!("generators[{i}].{}", generator.kind());
        for collider in generator.colliders(&path)? {
            add_collider(&mut world, &collider, &format!("{path}.collider"), &materials)?;
        }
    }
    for (i, sphere) in scene.spheres.iter().enumerate() {
        add_sphere(&mut world, sphere, &format!("spheres[{i}]"), &materials)?;
    }
    let mut first_of_generator = Vec::new();
    for (i, generator) in scene.generators.iter().enumerate() {
        first_of_generator.push(world.spheres().len());
        let path = format!("generators[{i}].{}", generator.kind());
        generate::fill(&mut world, generator, &path, &materials)?;
    }
    if let Boundary::Periodic { shear_rate, relative_velocities: true, .. } =
        scene.simulation.boundary
    {
        add_flow(&mut world, shear_rate)?;
    }
    for (i, spring) in scene.springs.iter().enumerate() {
        springs::add(&mut world, spring, &format!("springs[{i}]"))?;
    }
    for (i, emitter) in scene.emitters.iter().enumerate() {
        let path = format!("emitters[{i}]");
        add_emitter(&mut world, (emitter, &materials), &path, &scene.simulation)?;
    }
    if !scene.simulation.allow_overlap {
        overlap::refuse(scene, &world, &first_of_generator)?;
    }
    check_step(scene, &world)?;
    Ok(world)
}

/// Adds the mean flow of a sheared box to the velocities of all spheres; `shear_rate` in \[1/s\].
fn add_flow(world: &mut World, shear_rate: f64) -> Result<(), Problem> {
    let spheres = world.spheres();
    let states = spheres.ids().iter().zip(spheres.positions()).zip(spheres.velocities());
    let motions = states.map(|((&id, &position), &velocity)| {
        let velocity = velocity + DVec3::new(shear_rate * position.y, 0.0, 0.0);
        SphereMotion { id, position, velocity }
    });
    let motions: Vec<_> = motions.collect();
    let moved = world.set_motions(&motions);
    moved.map_err(|error| Problem::of_physics("simulation.boundary.periodic", error))
}

/// Refuses a scene whose first step would fail.
fn check_step(scene: &Scene, world: &World) -> Result<(), Problem> {
    world.check_step(scene.simulation.frame_time).map_err(|error| step_problem(scene, error))
}

/// Converts an error of the first step; the path is that of the part of the scene that it is about.
fn step_problem(scene: &Scene, error: carom::Error) -> Problem {
    let carom::Error::Invalid { subject, source } = &error else {
        return Problem::new("simulation", error.to_string());
    };
    let carom::InvalidValue { field, requirement, value } = source;
    if *field == "stiffness" || matches!(subject, carom::Subject::Spring(_)) {
        return Problem::new("springs", format!("`{field}` must be {requirement}, not {value}"));
    }
    let in_list = |list: &str, number: u64, length: usize| {
        (number < length as u64).then(|| format!("{list}[{number}]"))
    };
    let path = match subject {
        carom::Subject::Settings => return settings_problem(&scene.simulation, error),
        carom::Subject::Force(id) => {
            let number = id.number() as usize;
            let kind = scene.forces.get(number).map_or("", Force::kind);
            let text = format!("must act {requirement}, not with {value} N on a sphere");
            return Problem::new(format!("forces[{number}].{kind}"), text);
        }
        carom::Subject::Emitter(id) => in_list("emitters", id.number(), scene.emitters.len()),
        carom::Subject::Collider(id) => in_list("colliders", id.number(), scene.colliders.len()),
        carom::Subject::Sphere(id) => in_list("spheres", id.number(), scene.spheres.len()),
        _ => None,
    };
    match path {
        Some(path) => Problem::of_physics(&path, error),
        None => Problem::new("simulation", error.to_string()),
    }
}

fn add_forces(world: &mut World, forces: &[Force]) -> Result<(), Problem> {
    for (i, force) in forces.iter().enumerate() {
        let kind = force.kind();
        let added = force.add_to(world);
        added.map_err(|error| Problem::of_physics(&format!("forces[{i}].{kind}"), error))?;
    }
    Ok(())
}

/// Adds the collider that stands at `path`.
fn add_collider(
    world: &mut World,
    collider: &Collider,
    path: &str,
    materials: &MaterialNumbers,
) -> Result<(), Problem> {
    let material = materials.number(collider.material.as_deref(), path)?;
    let physical = self::collider(collider).map_err(|problem| {
        let kind = kind_of(&collider.shape);
        Problem::new(format!("{path}.shape.{kind}"), problem)
    })?;
    if let carom::Shape::Container { open, .. } = physical.shape {
        check(open != Sides::ALL, &format!("{path}.shape.container.open"), || {
            "must leave one wall at least".into()
        })?;
    }
    if let Shape::Bowl { opening_degrees, .. } = collider.shape {
        let is_open = (0.0..180.0).contains(&opening_degrees);
        check(is_open, &format!("{path}.shape.bowl.opening_degrees"), || {
            format!("must be at least 0 and less than 180, not {opening_degrees}")
        })?;
    }
    check(collider.trigger || !collider.capture, &format!("{path}.capture"), || {
        "needs `trigger = true`".into()
    })?;
    let motion = motion::motion(collider, path)?;
    let physical = if motion.is_empty() {
        physical
    } else {
        for (field, value) in
            [("velocity", collider.velocity), ("angular_velocity", collider.angular_velocity)]
        {
            check(value == [0.0; 3], &format!("{path}.{field}"), || {
                "must be left out beside `motion`, which may have a steady part".into()
            })?;
        }
        physical.with_motion(motion)
    };
    let added = world.add_collider(physical.with_material(material));
    added.map(drop).map_err(|error| collider_problem(path, &collider.shape, error))
}

/// Adds the emitter that stands at `path`.
fn add_emitter(
    world: &mut World,
    (emitter, materials): (&Emitter, &MaterialNumbers),
    path: &str,
    simulation: &Simulation,
) -> Result<(), Problem> {
    let sphere_path = format!("{path}.sphere");
    let material = materials.number(emitter.sphere.material.as_deref(), &sphere_path)?;
    let mut emitter = self::emitter(emitter, path)?;
    emitter.sphere.material = material;
    world.add_emitter(emitter).map_err(|error| Problem::of_physics(path, error))?;
    let place = emitter.position + emitter.rotation.normalize() * emitter.sphere.position;
    let is_free = !world.meets_collider(place, emitter.sphere.radius);
    check(is_free || simulation.allow_overlap, &format!("{path}.position"), || {
        "puts spheres into a collider; move it, or set simulation.allow_overlap = true".into()
    })
}

/// Name of a kind of shape, as scenes have it.
fn kind_of(shape: &Shape) -> &'static str {
    match shape {
        Shape::Sphere { .. } => "sphere",
        Shape::Rectangle { .. } => "rectangle",
        Shape::HalfSpace => "half-space",
        Shape::Box { .. } => "box",
        Shape::Container { .. } => "container",
        Shape::Mesh(_) => "mesh",
        Shape::HeightField(_) => "height-field",
        Shape::Track(_) => "track",
        Shape::Cylinder { .. } => "cylinder",
        Shape::Cone { .. } => "cone",
        Shape::Capsule { .. } => "capsule",
        Shape::Disc { .. } => "disc",
        Shape::Torus { .. } => "torus",
        Shape::Pipe { .. } => "pipe",
        Shape::Bowl { .. } => "bowl",
        Shape::Funnel { .. } => "funnel",
    }
}

/// Converts an error about a collider; lengths are fields of its shape.
fn collider_problem(path: &str, shape: &Shape, error: carom::Error) -> Problem {
    let shape = kind_of(shape);
    let is_length = |field: &str| {
        field.ends_with("radius")
            || field.starts_with("size")
            || ["height", "length"].contains(&field)
    };
    match error {
        carom::Error::Invalid { ref source, .. } if is_length(source.field) => {
            Problem::of_physics(&format!("{path}.shape.{shape}"), error)
        }
        other => Problem::of_physics(path, other),
    }
}
