//! Scenes: worlds of built-in scenes and scene files, and additions from text.

use std::collections::BTreeMap;
use std::ffi::{CString, c_char};
use std::sync::OnceLock;

use carom::{Spring, SpringEnd};
use carom_scene::{BUILT_IN_FILES, Library, Override, Palette, Scene, SceneError, part};

use crate::described::Described;
use crate::pointer::{Out, tell, text, texts};
use crate::status::{CaromStatus, Failure, call};
use crate::world::{CaromWorld, Inner};

/// Ids that carom_world_add_toml() has added. Ids of each kind are consecutive: those of the
/// spheres are first_sphere, first_sphere + 1, ...
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CaromAdded {
    /// Id of the first sphere.
    pub first_sphere: u64,
    /// Number of spheres.
    pub spheres: u64,
    /// Id of the first collider.
    pub first_collider: u64,
    /// Number of colliders.
    pub colliders: u64,
    /// Id of the first force.
    pub first_force: u64,
    /// Number of forces.
    pub forces: u64,
    /// Id of the first emitter.
    pub first_emitter: u64,
    /// Number of emitters.
    pub emitters: u64,
}

impl CaromAdded {
    /// Counts an added id.
    fn count(first: &mut u64, count: &mut u64, id: u64) {
        if *count == 0 {
            *first = id;
        }
        *count += 1;
    }
}

/// Returns the name of a built-in scene in the order of `carom scenes`; null after the last one.
#[unsafe(no_mangle)]
pub extern "C" fn carom_scene_name(index: usize) -> *const c_char {
    static NAMES: OnceLock<Vec<CString>> = OnceLock::new();
    let names = NAMES.get_or_init(|| {
        let names = BUILT_IN_FILES.iter().map(|(file, _)| file.trim_end_matches(".toml"));
        names.map(|name| CString::new(name).unwrap_or_default()).collect()
    });
    names.get(index).map_or(std::ptr::null(), |name| name.as_ptr())
}

/// Makes the world of a built-in scene, found by name or title, or of a scene file, found by its
/// path. Overrides are texts like "simulation.rule=contact" that replace values of the scene; they
/// may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_from_scene(
    name: *const c_char,
    overrides: *const *const c_char,
    override_count: usize,
    world: *mut CaromWorld,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut world = unsafe { Out::new(world, "world") }?;
        // SAFETY: the caller's text is null or ends in a zero, as the header demands.
        let name = unsafe { text(name, "name") }?;
        // SAFETY: the caller's texts are null or `override_count` texts, as the header demands.
        let overrides = unsafe { texts(overrides, override_count, "overrides") }?;
        let (scene, _) = Library::new().find(name, &parsed(&overrides)?)?;
        world.set(made(scene)?);
        Ok(())
    })
}

/// Makes the world of a scene file's text (TOML), with overrides as in carom_world_from_scene().
/// The message of an error has the line of the fault.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_from_toml(
    toml: *const c_char,
    overrides: *const *const c_char,
    override_count: usize,
    world: *mut CaromWorld,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut world = unsafe { Out::new(world, "world") }?;
        // SAFETY: the caller's text is null or ends in a zero, as the header demands.
        let toml = unsafe { text(toml, "toml") }?;
        // SAFETY: the caller's texts are null or `override_count` texts, as the header demands.
        let overrides = unsafe { texts(overrides, override_count, "overrides") }?;
        world.set(made(Scene::from_toml_with(toml, "scene", &parsed(&overrides)?)?)?);
        Ok(())
    })
}

fn parsed(overrides: &[&str]) -> Result<Vec<Override>, SceneError> {
    overrides.iter().map(|text| text.parse()).collect()
}

fn made(scene: Scene) -> Result<CaromWorld, Failure> {
    let (world, described) = Described::of(scene)?;
    Ok(CaromWorld::hold(Inner { world, described }))
}

/// Adds the spheres, generators, springs, colliders, forces and emitters of a text in the format of
/// scene files (TOML). Spheres may overlap others; springs join spheres of the text. Writes the ids
/// to `added`, which may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_add_toml(
    world: CaromWorld,
    toml: *const c_char,
    added: *mut CaromAdded,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's text is null or ends in a zero, as the header demands.
        let toml = unsafe { text(toml, "toml") }?;
        let all = world.with(|inner| {
            let part = part::read_for(toml, inner.described.scene())?;
            add(inner, part)
        })?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        unsafe { tell(added, all) };
        Ok(())
    })
}

/// Adds the content of a part of a scene.
fn add(inner: &mut Inner, mut part: Scene) -> Result<CaromAdded, Failure> {
    let Inner { world, described } = inner;
    part.colors.clone_from(&described.scene().colors);
    let (source, palette) = (part.world()?, Palette::new(&part)?);
    let mut added = CaromAdded::default();
    // Everything has been checked: nothing below fails.
    for force in &part.forces {
        let id = force.add_to(world)?.number();
        CaromAdded::count(&mut added.first_force, &mut added.forces, id);
    }
    described.scene_mut().forces.extend(part.forces.iter().cloned());
    for (_, collider) in source.colliders() {
        let id = world.add_collider(collider.clone())?.number();
        CaromAdded::count(&mut added.first_collider, &mut added.colliders, id);
    }
    let colliders = part.all_colliders().into_owned();
    described.change_colliders(|all| all.extend(colliders));
    // Ids of spheres in the part, with their ids in the world.
    let mut spheres = BTreeMap::new();
    for (index, &own) in source.spheres().ids().iter().enumerate() {
        let id = world.add_sphere(source.spheres().get(index))?;
        spheres.insert(own, id);
        described.palette_mut().add_sphere(id.number(), palette.own(own.number()));
        CaromAdded::count(&mut added.first_sphere, &mut added.spheres, id.number());
    }
    for (_, spring) in source.springs() {
        let to = match spring.to {
            SpringEnd::Sphere(own) => SpringEnd::Sphere(spheres[&own]),
            point @ SpringEnd::Point(_) => point,
        };
        world.add_spring(Spring { sphere: spheres[&spring.sphere], to, ..*spring })?;
    }
    for ((_, emitter), told) in source.emitters().zip(&part.emitters) {
        let (id, time) = (world.add_emitter(*emitter)?.number(), world.time());
        described.palette_mut().add_emitter(told, time);
        described.scene_mut().emitters.push(told.clone());
        CaromAdded::count(&mut added.first_emitter, &mut added.emitters, id);
    }
    Ok(added)
}

/// Sets the simulation settings from the table `[simulation]` of a scene file (TOML):
/// "[simulation]\nrule = \"contact\"". Missing settings get their defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_set_simulation(
    world: CaromWorld,
    toml: *const c_char,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's text is null or ends in a zero, as the header demands.
        let toml = unsafe { text(toml, "toml") }?;
        let part = part::read_simulation(toml)?;
        world.with(|inner| {
            inner.world.set_settings(part.settings())?;
            inner.described.scene_mut().simulation = part.simulation;
            Ok(())
        })
    })
}

/// Sets the pairs of materials from the tables of a scene file (TOML):
/// "material_pairs = [{ materials = [\"ivory\", \"slate\"], restitution = 0.9 }]". The materials are
/// those of the scene; an empty text removes all pairs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_set_material_pairs(
    world: CaromWorld,
    toml: *const c_char,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's text is null or ends in a zero, as the header demands.
        let toml = unsafe { text(toml, "toml") }?;
        world.with(|inner| {
            let (described, pairs) = part::material_pairs(toml, inner.described.scene())?;
            inner.world.set_material_pairs(pairs)?;
            inner.described.scene_mut().material_pairs = described;
            Ok(())
        })
    })
}
