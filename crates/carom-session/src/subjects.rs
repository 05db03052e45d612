//! Makes edits.

use std::sync::Arc;

use carom::{Collider, ColliderId, Emitter, EmitterId, Error, ForceId, Pose, Subject, World};
use carom_scene::scene::{self, Force, RestitutionLaw, Scene, Simulation};
use carom_scene::{Paint, SceneError};

use crate::change::Change;
use crate::edit::Edit;
use crate::error::SessionError;
use crate::looks::{self, Looks};
use crate::setup::{Setup, describe_emitter, group_name};

/// Everything that edits change.
pub(crate) struct Subjects<'a> {
    pub world: &'a mut World,
    pub setup: &'a mut Arc<Setup>,
    pub looks: &'a mut Looks,
}

impl Subjects<'_> {
    /// Makes an edit in the world and in the description of the scene.
    ///
    /// # Errors
    /// [`SessionError`] if the edit is refused; then nothing changes, and no flights are computed
    /// again.
    pub fn edit(self, edit: &Edit, scene: &Scene) -> Result<(), SessionError> {
        let Subjects { world, setup, looks } = self;
        match edit {
            Edit::Simulation(simulation) => set_simulation(simulation, scene, world, setup),
            Edit::FrameTime(frame_time) => {
                let mut simulation = setup.simulation.clone();
                simulation.frame_time = *frame_time;
                set_simulation(&simulation, scene, world, setup)
            }
            Edit::Force(id, force) => set_force(*id, force, world, setup),
            Edit::AddForce(force) => {
                let id = force.add_to(world)?;
                Arc::make_mut(setup).forces.push((id, force.clone()));
                Ok(())
            }
            Edit::RemoveForce(id) => remove_force(*id, world, setup),
            Edit::Spring(id, spring) => Ok(world.set_spring(*id, *spring)?),
            Edit::AddSpring(spring) => Ok(world.add_spring(*spring).map(drop)?),
            Edit::RemoveSpring(id) => Ok(world.remove_spring(*id).map(drop)?),
            Edit::ColliderRestitution(id, restitution) => set_collider(*id, world, setup, |it| {
                it.with_restitution(*restitution).with_material(0)
            }),
            Edit::AllColliderRestitutions(restitution) => set_colliders(None, world, setup, |it| {
                it.with_restitution(*restitution).with_material(0)
            }),
            Edit::NamedColliderRestitutions(name, restitution) => {
                set_colliders(Some(name), world, setup, |it| {
                    it.with_restitution(*restitution).with_material(0)
                })
            }
            Edit::ColliderFriction(id, friction) => {
                set_collider(*id, world, setup, |it| it.with_friction(*friction).with_material(0))
            }
            Edit::AllColliderFrictions(friction) => {
                set_colliders(None, world, setup, |it| it.with_friction(*friction).with_material(0))
            }
            Edit::NamedColliderFrictions(name, friction) => {
                set_colliders(Some(name), world, setup, |it| {
                    it.with_friction(*friction).with_material(0)
                })
            }
            Edit::ColliderPose(id, pose) => set_pose(*id, *pose, world, setup),
            Edit::ColliderScale(id, scale) => set_scale(*id, *scale, world, setup),
            Edit::Emitter(id, emitter) => {
                set_emitter(*id, emitter, scene, Subjects { world, setup, looks })
            }
            Edit::Sphere(id, change) => {
                let changed = change.of(world.sphere(*id)?);
                if change.radius.is_some() {
                    check_writable(scene, setup, changed.radius)?;
                }
                Ok(world.set_sphere(*id, changed)?)
            }
            Edit::Throw { sphere, color } => {
                check_writable(scene, setup, sphere.radius)?;
                let id = world.add_sphere(**sphere)?;
                let color = color.or_else(|| looks::color_of(scene, sphere));
                looks.paint(id, Paint { color, ..Paint::default() });
                Ok(())
            }
            Edit::RemoveSphere(id) => Ok(world.remove_sphere(*id).map(drop)?),
        }
    }

    /// Makes a change of any kind.
    ///
    /// # Errors
    /// The same as those of [`Self::edit`].
    pub fn change(self, change: &Change, scene: &Scene) -> Result<(), SessionError> {
        match change {
            Change::Edit(edit) => self.edit(edit, scene),
            Change::FailedStep => {
                begin_flights_anew(self.world);
                Ok(())
            }
        }
    }
}

/// Computes all flights again, as after a failed step.
pub(crate) fn begin_flights_anew(world: &mut World) {
    let settings = *world.settings();
    // These settings were accepted before.
    let _ = world.set_settings(settings);
}

fn set_simulation(
    simulation: &Simulation,
    scene: &Scene,
    world: &mut World,
    setup: &mut Arc<Setup>,
) -> Result<(), SessionError> {
    let changed = Setup { simulation: simulation.clone(), ..(**setup).clone() };
    let smallest = world.spheres().radii().iter().copied().fold(f64::INFINITY, f64::min);
    check_writable(scene, &changed, smallest)?;
    let settings = changed.scene(scene).settings();
    // Setting even equal settings would compute all flights again.
    if settings != *world.settings() {
        world.set_settings(settings)?;
    }
    *setup = Arc::new(changed);
    Ok(())
}

/// Refuses a setup that no scene file could have. `smallest` is the radius \[m\] of the smallest
/// sphere; errors use the names of scene files.
fn check_writable(scene: &Scene, setup: &Setup, smallest: f64) -> Result<(), SceneError> {
    let mut probe = Setup { colliders: Vec::new(), ..setup.clone() }.scene(scene);
    probe.simulation.allow_overlap = true;
    // The world checks the sphere itself.
    if smallest.is_finite() && smallest > 0.0 {
        probe.spheres.push(scene::Sphere::at([0.0; 3], smallest));
    }
    probe.world().map(drop)
}

fn set_force(
    id: ForceId,
    force: &Force,
    world: &mut World,
    setup: &mut Arc<Setup>,
) -> Result<(), SessionError> {
    force.replace_in(world, id)?;
    let forces = &mut Arc::make_mut(setup).forces;
    forces.iter_mut().filter(|it| it.0 == id).for_each(|it| it.1 = force.clone());
    Ok(())
}

fn remove_force(
    id: ForceId,
    world: &mut World,
    setup: &mut Arc<Setup>,
) -> Result<(), SessionError> {
    // Checked first, because the world computes all flights again before it refuses an unknown
    // force.
    if !setup.forces.iter().any(|it| it.0 == id) {
        return Err(Error::Unknown(Subject::Force(id)).into());
    }
    world.remove_force(id)?;
    Arc::make_mut(setup).forces.retain(|it| it.0 != id);
    Ok(())
}

/// Changes restitution or friction of a collider.
fn set_collider(
    id: ColliderId,
    world: &mut World,
    setup: &mut Arc<Setup>,
    change: impl Fn(Collider) -> Collider,
) -> Result<(), SessionError> {
    let collider = change(world.collider(id)?);
    world.set_collider(id, collider.clone())?;
    for described in descriptions(setup, id) {
        described.restitution = collider.restitution;
        described.restitution_law = collider.restitution_law.and_then(RestitutionLaw::of);
        described.material = described.material.take().filter(|_| collider.material > 0);
        described.set_surface_friction(collider.friction);
    }
    Ok(())
}

/// Puts a collider into this pose; its description gets the pose without its motion.
fn set_pose(
    id: ColliderId,
    pose: Pose,
    world: &mut World,
    setup: &mut Arc<Setup>,
) -> Result<(), SessionError> {
    world.set_collider(id, world.collider(id)?.with_pose(pose))?;
    let collider = world.collider(id)?;
    let Pose { position, rotation } = collider.motion.rest().unwrap_or(collider.pose);
    for described in descriptions(setup, id) {
        described.position = position.to_array();
        described.rotation = rotation.to_array();
    }
    Ok(())
}

/// Scales a collider of triangles, see [`Edit::ColliderScale`].
fn set_scale(
    id: ColliderId,
    scale: f64,
    world: &mut World,
    setup: &mut Arc<Setup>,
) -> Result<(), SessionError> {
    let mut scaled = world.collider(id)?;
    let described = setup.colliders.iter().find(|it| it.0 == id);
    let shape = described.and_then(|(_, it)| it.shape.scaled(scale));
    let shape = shape.ok_or(SessionError::NoScale)?;
    scaled.shape = shape.physical().map_err(SessionError::Shape)?;
    world.set_collider(id, scaled)?;
    descriptions(setup, id).for_each(|described| described.shape = shape.clone());
    Ok(())
}

/// The descriptions of a collider.
fn descriptions(
    setup: &mut Arc<Setup>,
    id: ColliderId,
) -> impl Iterator<Item = &mut scene::Collider> {
    let colliders = Arc::make_mut(setup).colliders.iter_mut();
    colliders.filter(move |it| it.0 == id).map(|it| &mut it.1)
}

/// Changes restitution or friction of all colliders with this group name, which one has at least; `None` for all.
fn set_colliders(
    name: Option<&String>,
    world: &mut World,
    setup: &mut Arc<Setup>,
    change: impl Fn(Collider) -> Collider,
) -> Result<(), SessionError> {
    // A value that one collider refuses is refused by the first, so that none is changed.
    let is_changed = |it: &scene::Collider| name.is_none_or(|name| group_name(&it.name) == name);
    let changed = setup.colliders.iter().filter(|(_, it)| is_changed(it));
    let ids: Vec<ColliderId> = changed.map(|(id, _)| *id).collect();
    if let Some(name) = name.filter(|_| ids.is_empty()) {
        let mut known: Vec<String> =
            setup.colliders.iter().map(|(_, it)| group_name(&it.name).to_owned()).collect();
        known.sort_unstable();
        known.dedup();
        return Err(SessionError::NoCollider { name: name.clone(), known });
    }
    ids.into_iter().try_for_each(|id| set_collider(id, world, setup, &change))
}

fn set_emitter(
    id: EmitterId,
    emitter: &Emitter,
    scene: &Scene,
    to: Subjects,
) -> Result<(), SessionError> {
    let Subjects { world, setup, looks } = to;
    let unknown = Error::Unknown(Subject::Emitter(id));
    let place = setup.emitters.iter().position(|it| it.0 == id).ok_or(unknown)?;
    let mut changed = (**setup).clone();
    let is_anew = changed.emitters[place].1.period != emitter.period;
    describe_emitter(emitter, &mut changed.emitters[place].1);
    check_writable(scene, &changed, f64::INFINITY)?;
    world.set_emitter(id, *emitter)?;
    if is_anew {
        looks.restart_emitter(id, world.time());
    }
    *setup = Arc::new(changed);
    Ok(())
}
