//! The world that JavaScript holds.

use std::rc::Rc;

use carom::{SphereId, WellEventKind};
use carom_scene::{Library, Override, Palette, Scene, SceneError};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::contact_table;
use crate::failure::Failure;
use crate::impact_table;
use crate::members::Members;
use crate::place::place;
use crate::snapshot::{Description, Snapshot};

/// A world, its description, and the impacts of its last step.
#[wasm_bindgen]
#[derive(Debug)]
pub struct World {
    pub(crate) world: carom::World,
    pub(crate) description: Description,
    /// The impacts of the last step, after a script has read them.
    impacts: Option<Vec<f64>>,
}

/// Constructors.
#[wasm_bindgen]
impl World {
    /// Makes the world of a built-in scene, with some values replaced (`path=value`).
    ///
    /// # Errors
    /// [`Failure`] if no scene has this name or title, or if a value is invalid.
    #[wasm_bindgen(js_name = fromName)]
    pub fn from_name(name: &str, overrides: Vec<String>) -> Result<Self, Failure> {
        let (scene, _) = Library::new().find(name, &parsed(&overrides)?)?;
        Self::new(scene)
    }

    /// Makes the world of a scene file's text, with some values replaced (`path=value`).
    ///
    /// # Errors
    /// [`Failure`] with the line of the error.
    #[wasm_bindgen(js_name = fromToml)]
    pub fn from_toml(text: &str, overrides: Vec<String>) -> Result<Self, Failure> {
        Self::new(Scene::from_toml_with(text, "scene", &parsed(&overrides)?)?)
    }
}

impl World {
    fn new(mut scene: Scene) -> Result<Self, Failure> {
        let world = scene.world()?;
        let palette = Palette::new(&scene)?;
        let mut members = Members::default();
        members.follow(world.spheres(), &palette);
        scene.spheres.clear();
        scene.colliders = scene.all_colliders().into_owned();
        scene.generators.clear();
        scene.springs.clear();
        let description = Description { scene: Rc::new(scene), palette, members };
        Ok(Self { world, description, impacts: None })
    }

    /// Returns the scene without its spheres.
    pub(crate) fn described(&self) -> &Scene {
        &self.description.scene
    }

    /// Returns the description for changes, which must match those of the world itself.
    pub(crate) fn described_mut(&mut self) -> &mut Scene {
        Rc::make_mut(&mut self.description.scene)
    }
}

impl World {
    /// Takes a step and updates the description and the tables.
    pub(crate) fn take_step(
        &mut self,
        step: impl FnOnce(&mut carom::World) -> Result<(), carom::Error>,
    ) -> Result<(), Failure> {
        self.impacts = None;
        step(&mut self.world)?;
        if !self.world.report().emitted.is_empty() {
            let Description { palette, members, .. } = &mut self.description;
            palette.follow(self.world.time());
            members.follow(self.world.spheres(), palette);
        }
        Ok(())
    }
}

fn parsed(overrides: &[String]) -> Result<Vec<Override>, SceneError> {
    overrides.iter().map(|text| text.parse()).collect()
}

/// Time and state.
#[wasm_bindgen]
impl World {
    /// Advances the world by `dt` \[s\].
    ///
    /// # Errors
    /// [`Failure`] as [`carom::World::step`]; the state before the step is kept.
    pub fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.take_step(|world| world.step(dt).map(drop))
    }

    /// Returns the time since the start \[s\].
    #[wasm_bindgen(getter)]
    pub fn time(&self) -> f64 {
        self.world.time()
    }

    /// Returns the frame time of the scene \[s\].
    #[wasm_bindgen(getter, js_name = frameTime)]
    pub fn frame_time(&self) -> f64 {
        self.described().simulation.frame_time
    }

    /// Returns a snapshot of everything that the future depends on.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot { world: self.world.snapshot(), description: self.description.clone() }
    }

    /// Takes a snapshot into the memory of an earlier one, which is overwritten.
    #[wasm_bindgen(js_name = snapshotInto)]
    pub fn snapshot_into(&self, snapshot: &mut Snapshot) {
        self.world.snapshot_into(&mut snapshot.world);
        snapshot.description.clone_from(&self.description);
    }

    /// Restores a snapshot, bit for bit. The impacts of the last step are removed.
    pub fn restore(&mut self, snapshot: &Snapshot) {
        self.world.restore(&snapshot.world);
        self.description.clone_from(&snapshot.description);
        self.impacts = None;
    }

    /// Returns the state hash in 16 hexadecimal digits.
    #[wasm_bindgen(js_name = stateHash)]
    pub fn state_hash(&self) -> String {
        self.world.state_hash().to_string()
    }
}

/// Report of the last step.
#[wasm_bindgen]
impl World {
    /// Returns the number of impacts.
    #[wasm_bindgen(getter, js_name = impactCount)]
    pub fn impact_count(&self) -> usize {
        self.world.report().impacts.len()
    }

    /// Returns the address of the table of impacts, `f64`, one row each.
    #[wasm_bindgen(getter)]
    pub fn impacts(&mut self) -> usize {
        let impacts = &self.world.report().impacts;
        place(self.impacts.get_or_insert_with(|| impact_table::of(impacts)))
    }

    /// Returns the work by stage: predictions, pair tests, events, cell crossings, groups, solver
    /// iterations, searches, sweeps, contacts.
    #[wasm_bindgen(getter)]
    pub fn work(&self) -> Vec<f64> {
        let work = self.world.report().work;
        let of_events = [work.predictions, work.pair_tests, work.events, work.cell_crossings];
        let of_groups = [work.groups, work.solver_iterations];
        let of_sub_steps = [work.searches, work.sweeps, work.contacts];
        let all = of_events.iter().chain(&of_groups).chain(&of_sub_steps);
        all.map(|&count| count as f64).collect()
    }

    /// Returns the energy account \[J\]: work of contacts, of moving colliders, of kicks, of growth, of
    /// shear, of a thermostat, of forces without a potential, of applied forces and of the correction of overlaps, and the energy of
    /// emitted spheres minus that of removed ones.
    #[wasm_bindgen(getter, js_name = energyAccount)]
    pub fn energy_account(&self) -> Vec<f64> {
        let account = self.world.report().energy_account;
        let of_bodies = [account.contacts, account.colliders, account.kicks, account.growth];
        let driven = [account.shear, account.thermostat];
        let others = [account.forces, account.applied, account.correction, account.emission];
        let all = of_bodies.into_iter().chain(driven).chain(others);
        all.chain([account.integration]).collect()
    }

    /// Returns the quality of the solutions of the rule `contact`: sub-steps with limited impulses,
    /// residual, largest overlap, sleeping spheres, and how often a sphere was squeezed.
    #[wasm_bindgen(getter, js_name = contactAccount)]
    pub fn contact_account(&self) -> Vec<f64> {
        let account = self.world.report().contact_account;
        vec![
            f64::from(account.limited_sub_steps),
            account.residual,
            account.largest_overlap,
            f64::from(account.asleep),
            f64::from(account.squeezed),
        ]
    }

    /// Returns the account of zones under the rule `exact`: spheres in zones, their total time
    /// there \[s\], ticks, spheres that joined, and spheres that left.
    #[wasm_bindgen(getter, js_name = zoneAccount)]
    pub fn zone_account(&self) -> Vec<f64> {
        let account = self.world.report().zone_account;
        let [spheres, ticks] = [account.spheres, account.ticks].map(f64::from);
        let [joined, left] = [account.joined, account.left].map(f64::from);
        vec![spheres, account.sphere_seconds, ticks, joined, left]
    }

    /// Returns whether any sphere was ever in a zone.
    #[wasm_bindgen(getter, js_name = wasStepped)]
    pub fn was_stepped(&self) -> bool {
        self.world.was_stepped()
    }

    /// Returns the groups of impacts at one time in rows: index of the first impact, number of impacts, momentum before
    /// and after \[kg m/s\], energy before, after and demanded by restitution, work of colliders and of kicks \[J\].
    #[wasm_bindgen(getter, js_name = impactGroups)]
    pub fn impact_groups(&self) -> Vec<f64> {
        let mut table = Vec::new();
        for group in &self.world.report().groups {
            table.extend([group.first as f64, group.count as f64]);
            table.extend(group.momentum_before.to_array());
            table.extend(group.momentum_after.to_array());
            table.extend([group.energy_before, group.energy_after, group.energy_demanded]);
            table.extend([group.collider_work, group.kick_work]);
        }
        table
    }

    /// Returns the number of groups in which two bodies met as often as a frame allows, under the rule `bisect`.
    #[wasm_bindgen(getter, js_name = unfinishedIslands)]
    pub fn unfinished_islands(&self) -> u32 {
        self.world.report().unfinished_islands
    }

    /// Returns the table of the present persistent contacts, one row each.
    #[wasm_bindgen(getter)]
    pub fn contacts(&self) -> Vec<f64> {
        contact_table::of(&self.world.contacts())
    }

    /// Returns the ids of the spheres that emitters added.
    #[wasm_bindgen(getter)]
    pub fn emitted(&self) -> Vec<f64> {
        numbers(&self.world.report().emitted)
    }

    /// Returns the ids of the spheres that emitters removed.
    #[wasm_bindgen(getter)]
    pub fn retired(&self) -> Vec<f64> {
        numbers(&self.world.report().retired)
    }

    /// Returns the ids of the spheres that emitters left out for lack of space.
    #[wasm_bindgen(getter, js_name = leftOut)]
    pub fn left_out(&self) -> Vec<f64> {
        numbers(&self.world.report().left_out)
    }

    /// Returns the spheres inside triggers at the end of the step: collider, sphere, collider,
    /// sphere, ...
    #[wasm_bindgen(getter)]
    pub fn triggers(&self) -> Vec<f64> {
        let triggers = self.world.report().triggers.iter();
        triggers.flat_map(|it| [it.collider.number() as f64, it.sphere.number() as f64]).collect()
    }

    /// Returns the entries of spheres into triggers and the exits in rows: time, collider, sphere,
    /// 1 if the sphere enters or 0 if it leaves, point, normal, speed.
    #[wasm_bindgen(getter, js_name = sensorEvents)]
    pub fn sensor_events(&self) -> Vec<f64> {
        let mut table = Vec::new();
        for event in &self.world.report().sensor_events {
            table.extend([event.time, event.collider.number() as f64]);
            table.extend([event.sphere.number() as f64, f64::from(event.enters)]);
            table.extend(event.point.to_array());
            table.extend(event.normal.to_array());
            table.push(event.speed);
        }
        table
    }

    /// Returns the events of pairs of spheres at the edges of wells in rows: time, spheres, 0 for a
    /// capture, 1 for a dissociation or 2 for a bounce, normal, distance, impulse.
    #[wasm_bindgen(getter, js_name = wellEvents)]
    pub fn well_events(&self) -> Vec<f64> {
        let mut table = Vec::new();
        for event in &self.world.report().well_events {
            table.push(event.time);
            table.extend(event.between.map(|id| id.number() as f64));
            table.push(match event.kind {
                WellEventKind::Capture => 0.0,
                WellEventKind::Dissociation => 1.0,
                _ => 2.0,
            });
            table.extend(event.normal.to_array());
            table.extend([event.distance, event.impulse]);
        }
        table
    }
}

fn numbers(ids: &[SphereId]) -> Vec<f64> {
    ids.iter().map(|id| id.number() as f64).collect()
}
