//! Derivatives of a run by numbers that it starts with, as columns of its table.

use carom::{ColliderId, DVec3, SphereId, SphereTangent, SpringId, Tangents, Variation, World};

use crate::failure::Failure;

/// Motion of a sphere whose derivatives are written, in the order of the columns.
const MOTION: [&str; 6] = ["dx", "dy", "dz", "dvx", "dvy", "dvz"];

/// Derivatives that are carried along with a run.
pub struct Sensitivity {
    /// Names of the numbers, each with its component.
    numbers: Vec<String>,
    tangents: Tangents,
}

impl Sensitivity {
    /// Begins with the present state of a world; `None` without a name. A name of a vector means its three components.
    pub fn of(world: &World, names: &[String]) -> Result<Option<Self>, Failure> {
        if names.is_empty() {
            return Ok(None);
        }
        let (mut numbers, mut directions) = (Vec::new(), Vec::new());
        for name in names {
            for (number, direction) in directions_of(world, name)? {
                numbers.push(number);
                directions.push(direction);
            }
        }
        let tangents = Tangents::new(world, directions)?;
        Ok(Some(Self { numbers, tangents }))
    }

    /// Advances the world and the derivatives by `dt` \[s\].
    pub fn step(&mut self, world: &mut World, dt: f64) -> Result<(), Failure> {
        Ok(self.tangents.step(world, dt)?)
    }

    /// Returns the names of the columns.
    pub fn columns(&self) -> Vec<String> {
        let of = |number: &String| MOTION.map(|motion| format!("{motion}/d({number})"));
        self.numbers.iter().flat_map(of).collect()
    }

    /// Returns the present derivatives: a row for each sphere, by ascending id.
    pub fn rows(&self) -> Vec<Vec<f64>> {
        let count = if self.tangents.is_empty() { 0 } else { self.tangents.spheres(0).len() };
        let row = |sphere: usize| {
            let of = |direction: usize| {
                let SphereTangent { position, velocity, .. } =
                    self.tangents.spheres(direction)[sphere];
                position.to_array().into_iter().chain(velocity.to_array())
            };
            (0..self.tangents.len()).flat_map(of).collect()
        };
        (0..count).map(row).collect()
    }
}

/// What a number belongs to.
#[derive(Clone, Copy)]
enum Subject {
    World,
    Sphere(SphereId),
    Collider(ColliderId),
    Spring(SpringId),
}

/// Returns the numbers that a name means, each with the direction in which it alone changes.
fn directions_of(world: &World, name: &str) -> Result<Vec<(String, Variation)>, Failure> {
    let mut parts = name.split('.');
    let (subject, field) = match parts.next() {
        Some("acceleration") => (Subject::World, "acceleration"),
        Some(kind @ ("spheres" | "colliders" | "springs")) => {
            let subject = member(world, name, kind, parts.next())?;
            (subject, parts.next().unwrap_or_default())
        }
        _ => {
            return Err(unknown(
                name,
                "it names neither a sphere, nor a collider, nor a spring, nor the acceleration",
            ));
        }
    };
    let component = parts.next();
    if parts.next().is_some() {
        return Err(unknown(name, "it has too many parts"));
    }
    let axes: &[usize] = match component {
        None => &[0, 1, 2],
        Some("0") => &[0],
        Some("1") => &[1],
        Some("2") => &[2],
        Some(_) => return Err(unknown(name, "a component is 0, 1 or 2")),
    };
    let stem = name.strip_suffix(&component.map(|it| format!(".{it}")).unwrap_or_default());
    let stem = stem.unwrap_or(name);
    let along = |axis: usize| Some((format!("{stem}.{axis}"), vector(subject, field, axis)?));
    if let Some(directions) = axes.iter().map(|&axis| along(axis)).collect() {
        return Ok(directions);
    }
    match (scalar(subject, field), component) {
        (Some(direction), None) => Ok(vec![(name.to_owned(), direction)]),
        (Some(_), Some(_)) => Err(unknown(name, "it has no components")),
        (None, _) => Err(unknown(name, "there are no derivatives by this field")),
    }
}

/// Returns a sphere, collider or spring by its number in the scene.
fn member(world: &World, name: &str, kind: &str, number: Option<&str>) -> Result<Subject, Failure> {
    let number = number.and_then(|it| it.parse::<usize>().ok());
    let Some(number) = number else {
        return Err(unknown(name, &format!("a number comes after {kind}")));
    };
    let found = match kind {
        "spheres" => world.spheres().ids().get(number).map(|&id| Subject::Sphere(id)),
        "springs" => world.springs().nth(number).map(|(id, _)| Subject::Spring(id)),
        _ => world.colliders().nth(number).map(|(id, _)| Subject::Collider(id)),
    };
    found.ok_or_else(|| unknown(name, &format!("there are fewer {kind}")))
}

/// Returns the direction in which a component of a vector changes; `None` if it is no vector of the subject.
fn vector(subject: Subject, field: &str, axis: usize) -> Option<Variation> {
    let mut direction = Variation::default();
    let changed = match (subject, field) {
        (Subject::World, _) => &mut direction.acceleration,
        (Subject::Sphere(id), "position") => &mut direction.sphere_mut(id).position,
        (Subject::Sphere(id), "velocity") => &mut direction.sphere_mut(id).velocity,
        (Subject::Sphere(id), "angular_velocity") => &mut direction.sphere_mut(id).angular_velocity,
        (Subject::Sphere(id), "acceleration") => &mut direction.sphere_mut(id).acceleration,
        (Subject::Collider(id), "position") => &mut direction.collider_mut(id).position,
        (Subject::Collider(id), "velocity") => &mut direction.collider_mut(id).velocity,
        _ => return None,
    };
    *changed = DVec3::AXES[axis];
    Some(direction)
}

/// Returns the direction in which a number changes; `None` if the subject has no such number.
fn scalar(subject: Subject, field: &str) -> Option<Variation> {
    let mut direction = Variation::default();
    let changed = match (subject, field) {
        (Subject::Sphere(id), "radius") => &mut direction.sphere_mut(id).radius,
        (Subject::Sphere(id), "mass") => &mut direction.sphere_mut(id).mass,
        (Subject::Sphere(id), "restitution") => &mut direction.sphere_mut(id).restitution,
        (Subject::Sphere(id), "friction") => &mut direction.sphere_mut(id).friction,
        (Subject::Collider(id), "restitution") => &mut direction.collider_mut(id).restitution,
        (Subject::Collider(id), "friction") => &mut direction.collider_mut(id).friction,
        (Subject::Spring(id), "stiffness") => &mut direction.spring_mut(id).stiffness,
        (Subject::Spring(id), "rest_length") => &mut direction.spring_mut(id).rest_length,
        (Subject::Spring(id), "damping") => &mut direction.spring_mut(id).damping,
        _ => return None,
    };
    *changed = 1.0;
    Some(direction)
}

fn unknown(name: &str, why: &str) -> Failure {
    Failure::Usage(format!(
        "--sensitivity {name}: {why}; it is acceleration, spheres.N, colliders.N or springs.N, and then position, \
         velocity, angular_velocity, acceleration, radius, mass, restitution, friction, stiffness, rest_length or \
         damping"
    ))
}
