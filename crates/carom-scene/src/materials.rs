//! Materials: lays their fields under those of spheres and colliders, and numbers them for pairs.
//!
//! A scene that was read has the fields of its materials in every body; a scene that is written leaves them out again.

use std::collections::BTreeMap;

use carom::{DVec3, Friction, World};
use toml::{Table, Value};

use crate::deserialize::deserialize;
use crate::error::{Problem, nearest};
use crate::requirement::check;
use crate::scene::{Finish, Material, MaterialPair, RestitutionLaw, Scene};

/// Name of the table of materials.
const TABLE: &str = "materials";
/// Most materials of a scene: they are numbered by bytes, and 0 is none.
const MOST: usize = 255;

/// Fields of a body that keep those of a material out, besides fields of the same name.
const SAME: [(&str, &str); 3] =
    [("restitution", "restitution_law"), ("restitution_law", "restitution"), ("density", "mass")];

/// Adds the fields of materials to the bodies of a scene that do not have them.
///
/// # Errors
/// A [`Problem`] for a material that is invalid or does not exist.
pub(crate) fn fill(scene: &mut Table) -> Result<(), Problem> {
    let materials = match scene.get(TABLE) {
        Some(Value::Table(table)) => table.clone(),
        _ => Table::new(),
    };
    let read: BTreeMap<String, Material> =
        deserialize(materials.clone()).map_err(|problem| problem.below(&format!("{TABLE}.")))?;
    check_materials(&read)?;
    for_each_body(scene, &mut |body, path| {
        let Some(Value::String(name)) = body.get("material") else { return Ok(()) };
        let Some(Value::Table(fields)) = materials.get(name) else {
            let known = read.keys().map(String::as_str);
            return Err(unknown(name, known, &format!("{path}.material")));
        };
        let is_free = |field: &str| {
            let is_said = |(one, other): &(&str, &str)| *one == field && body.contains_key(*other);
            !body.contains_key(field) && !SAME.iter().any(is_said)
        };
        let is_sphere = !body.contains_key("shape");
        let fields = fields.iter().filter(|(field, _)| is_sphere || *field != "density");
        let missing: Vec<_> = fields.filter(|(field, _)| is_free(field)).collect();
        body.extend(missing.into_iter().map(|(field, value)| (field.clone(), value.clone())));
        Ok(())
    })
}

/// Returns the table of materials of a scene as TOML.
pub(crate) fn written(scene: &Scene) -> String {
    let materials = Value::try_from(&scene.materials).expect("materials have strings as keys");
    let table = Table::from_iter([(TABLE.to_owned(), materials)]);
    toml::to_string(&table).expect("materials have strings as keys")
}

/// Removes the fields of bodies that are those of their materials.
pub(crate) fn strip(scene: &mut Table) {
    let Some(Value::Table(materials)) = scene.get(TABLE).cloned() else { return };
    let stripped = for_each_body(scene, &mut |body, _| {
        let name = body.get("material").and_then(Value::as_str);
        let material = name.and_then(|name| materials.get(name)?.as_table());
        let Some(material) = material else { return Ok(()) };
        // A restitution that a law replaces is not read.
        if body.contains_key("restitution_law") {
            body.remove("restitution");
        }
        body.retain(|field, value| material.get(field) != Some(&*value));
        Ok(())
    });
    stripped.expect("nothing is refused");
}

/// Calls a function with every sphere and collider of a scene, those of generators and emitters included, and its path.
fn for_each_body(
    scene: &mut Table,
    change: &mut impl FnMut(&mut Table, &str) -> Result<(), Problem>,
) -> Result<(), Problem> {
    for list in ["spheres", "colliders", "emitters", "generators"] {
        let Some(Value::Array(elements)) = scene.get_mut(list) else { continue };
        let tables = elements.iter_mut().enumerate();
        for (i, table) in tables.filter_map(|(i, it)| Some((i, it.as_table_mut()?))) {
            let path = format!("{list}[{i}]");
            match list {
                "spheres" | "colliders" => change(table, &path)?,
                "emitters" => for_each_template(table, &path, change)?,
                _ => {
                    for (kind, generator) in table.iter_mut() {
                        let Some(generator) = generator.as_table_mut() else { continue };
                        for_each_template(generator, &format!("{path}.{kind}"), change)?;
                    }
                }
            }
        }
    }
    Ok(())
}

/// Calls a function with the sphere and the collider of a generator or an emitter.
fn for_each_template(
    table: &mut Table,
    path: &str,
    change: &mut impl FnMut(&mut Table, &str) -> Result<(), Problem>,
) -> Result<(), Problem> {
    for making in ["sphere", "collider"] {
        if let Some(Value::Table(body)) = table.get_mut(making) {
            change(body, &format!("{path}.{making}"))?;
        }
    }
    Ok(())
}

fn unknown<'a>(name: &str, known: impl Iterator<Item = &'a str>, path: &str) -> Problem {
    let names: Vec<&str> = known.collect();
    let hint = match nearest(name, names.iter().copied()) {
        Some(meant) => format!("; did you mean \"{meant}\"?"),
        None if is_finish(name) => "; did you mean \"finish\"?".to_owned(),
        None if names.is_empty() => format!("; the scene has no [{TABLE}]"),
        None => format!("; there are {}", names.join(", ")),
    };
    Problem::new(path, format!("unknown material \"{name}\"{hint}"))
}

fn is_finish(name: &str) -> bool {
    Value::from(name).try_into::<Finish>().is_ok()
}

/// Refuses invalid numbers of materials.
fn check_materials(materials: &BTreeMap<String, Material>) -> Result<(), Problem> {
    check(materials.len() <= MOST, TABLE, || format!("has more than {MOST} materials"))?;
    for (name, material) in materials {
        let path = format!("{TABLE}.{name}");
        let Material { restitution, restitution_law, density, .. } = *material;
        let sphere = carom::Sphere::new(DVec3::ZERO, 1.0)
            .with_restitution(restitution.unwrap_or(1.0))
            .with_friction(friction(
                [material.friction, material.rolling_friction, material.spinning_friction],
                material.tangential_restitution,
            ))
            .with_density(density.unwrap_or(1.0));
        let sphere = restitution_law.map_or(sphere, |law| sphere.with_restitution_law(law.into()));
        let added = World::default().add_sphere(sphere);
        added.map_err(|error| Problem::of_physics(&path, error))?;
    }
    Ok(())
}

impl Scene {
    /// Returns the name of the material with a number in the world of the scene; `None` for none.
    pub fn material_name(&self, number: u8) -> Option<String> {
        let place = usize::from(number).checked_sub(1)?;
        self.materials.keys().nth(place).cloned()
    }
}

/// Numbers of materials in a world, from 1 on, by name.
pub(crate) struct MaterialNumbers<'a>(BTreeMap<&'a str, u8>);

impl<'a> MaterialNumbers<'a> {
    pub fn of(scene: &'a Scene) -> Self {
        Self(scene.materials.keys().map(String::as_str).zip(1..=u8::MAX).collect())
    }

    /// Number of a body's material; 0 for none.
    ///
    /// # Errors
    /// A [`Problem`] at `path` for an unknown material.
    pub fn number(&self, material: Option<&str>, path: &str) -> Result<u8, Problem> {
        let number = |name| self.find(name, &format!("{path}.material"));
        material.map_or(Ok(0), number)
    }

    /// Number of a material.
    fn find(&self, name: &str, path: &str) -> Result<u8, Problem> {
        let number = self.0.get(name).copied();
        number.ok_or_else(|| unknown(name, self.0.keys().copied(), path))
    }
}

/// Sets the pairs of materials of a world.
///
/// # Errors
/// A [`Problem`] for an unknown material, an invalid number, or a pair that is given twice.
pub(crate) fn add_pairs(
    world: &mut World,
    scene: &Scene,
    numbers: &MaterialNumbers,
) -> Result<(), Problem> {
    let mut pairs = Vec::with_capacity(scene.material_pairs.len());
    for (i, pair) in scene.material_pairs.iter().enumerate() {
        let path = format!("material_pairs[{i}]");
        let [first, second] = &pair.materials;
        let at = format!("{path}.materials");
        let both @ [first, second] = [numbers.find(first, &at)?, numbers.find(second, &at)?];
        let is_same = |other: &carom::MaterialPair| {
            other.materials == [first, second] || other.materials == [second, first]
        };
        let names = &pair.materials;
        check(!pairs.iter().any(is_same), &at, || {
            format!("gives the pair of {} and {} a second time", names[0], names[1])
        })?;
        pairs.push(physical(pair, both));
        // The pair is checked alone, with its own path in the error.
        let checked = World::default().set_material_pairs(pairs.last().copied());
        checked.map_err(|error| Problem::of_physics(&path, error))?;
    }
    let set = world.set_material_pairs(pairs);
    set.map_err(|error| Problem::of_physics("material_pairs", error))
}

fn physical(pair: &MaterialPair, [first, second]: [u8; 2]) -> carom::MaterialPair {
    let mut physical = carom::MaterialPair::new(first, second).with_friction(friction(
        [pair.friction, pair.rolling_friction, pair.spinning_friction],
        pair.tangential_restitution,
    ));
    physical.restitution = pair.restitution;
    physical.non_additivity = pair.non_additivity;
    physical.restitution_law = pair.restitution_law.map(Into::into);
    physical
}

/// Friction of a body: `coefficients` of sliding, rolling and spinning friction.
pub(crate) fn friction(
    coefficients: [Option<f64>; 3],
    tangential_restitution: Option<f64>,
) -> Friction {
    let mut friction = Friction::default();
    [friction.sliding, friction.rolling, friction.spinning] = coefficients;
    friction.tangential_restitution = tangential_restitution;
    friction
}

impl From<RestitutionLaw> for carom::RestitutionLaw {
    fn from(law: RestitutionLaw) -> Self {
        match law {
            RestitutionLaw::PowerLaw { restitution, speed, exponent } => {
                Self::PowerLaw { restitution, speed, exponent }
            }
            RestitutionLaw::Viscoelastic { speed } => Self::Viscoelastic { speed },
            RestitutionLaw::Cutoff { restitution, speed } => Self::Cutoff { restitution, speed },
        }
    }
}

impl RestitutionLaw {
    /// Converts a law of `carom`; `None` for one that scene files do not have.
    pub fn of(law: carom::RestitutionLaw) -> Option<Self> {
        Some(match law {
            carom::RestitutionLaw::PowerLaw { restitution, speed, exponent } => {
                Self::PowerLaw { restitution, speed, exponent }
            }
            carom::RestitutionLaw::Viscoelastic { speed } => Self::Viscoelastic { speed },
            carom::RestitutionLaw::Cutoff { restitution, speed } => {
                Self::Cutoff { restitution, speed }
            }
            _ => return None,
        })
    }
}
