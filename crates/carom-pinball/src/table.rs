//! A table: a scene, and the role of each collider.

use carom::World;
use carom_scene::Library;
use carom_scene::scene::{Collider, Scene};

use crate::error::TableError;
use crate::lever::{Lever, Stroke};
use crate::role::Role;

/// A pinball table: a scene, and the role of each of its colliders.
#[derive(Debug, Clone)]
pub struct Table {
    scene: Scene,
    roles: Vec<Role>,
    strokes: Vec<Option<Stroke>>,
}

impl Table {
    /// Returns the built-in table.
    ///
    /// # Errors
    /// Only errors of a broken built-in scene.
    pub fn built_in() -> Result<Self, TableError> {
        let (scene, _) = Library::new().find("pinball", &[])?;
        Self::from_scene(&scene)
    }

    /// Makes a table from a scene. The colliders "left flipper", "right flipper" and "plunger" move by keyframes, of
    /// which the first three are at rest (where the collider stands), pressed, and back. Triggers whose names end with
    /// "target" are targets, and "drain" is the trigger that captures the ball. Solid colliders whose names end with
    /// "bumper" or "slingshot" give points when they kick. The scene has as many spheres as the game has balls, which
    /// are played one after the other from the place of the first, at rest. A table may do without a plunger.
    ///
    /// # Errors
    /// [`TableError`] without balls, flippers or drain; for levers that do not move by such keyframes; and for an
    /// invalid scene.
    pub fn from_scene(scene: &Scene) -> Result<Self, TableError> {
        let name = || scene.name.clone();
        let roles = roles(&scene.colliders);
        let needed = [
            (Role::LeftFlipper, "left flipper", "solid collider"),
            (Role::RightFlipper, "right flipper", "solid collider"),
            (Role::Drain, "drain", "trigger with `capture`"),
        ];
        if let Some((_, name, kind)) = needed.into_iter().find(|(role, ..)| !roles.contains(role)) {
            return Err(TableError::Missing { scene: scene.name.clone(), name, kind });
        }
        let has_others = !scene.generators.is_empty() || !scene.emitters.is_empty();
        if scene.spheres.is_empty() || has_others {
            return Err(TableError::Balls { scene: name() });
        }
        let stroke = |(collider, role): (&Collider, &Role)| match role {
            Role::LeftFlipper | Role::RightFlipper | Role::Plunger => {
                let refused = || TableError::Stroke { scene: name(), name: collider.name.clone() };
                Stroke::of(&collider.motion).map(Some).ok_or_else(refused)
            }
            _ => Ok(None),
        };
        let strokes = scene.colliders.iter().zip(&roles).map(stroke).collect::<Result<_, _>>()?;
        let table = Self { scene: scene.clone(), roles, strokes };
        // Making a world checks all numbers of the scene.
        table.scene.world()?;
        table.at_start().world()?;
        Ok(table)
    }

    /// Returns the title for display.
    pub fn title(&self) -> &str {
        if self.scene.title.is_empty() { &self.scene.name } else { &self.scene.title }
    }

    /// Returns the scene of the table.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the role of each collider of [`Self::scene`], in the same order.
    pub fn roles(&self) -> &[Role] {
        &self.roles
    }

    /// Returns the number of balls of a game.
    pub fn balls(&self) -> usize {
        self.scene.spheres.len()
    }

    /// Returns the number of targets.
    pub fn targets(&self) -> usize {
        self.roles.iter().filter(|role| matches!(role, Role::Target(_))).count()
    }

    /// Returns the scene at the start of a game: the first ball at rest, and the levers, too.
    pub(crate) fn at_start(&self) -> Scene {
        let mut scene = self.scene.clone();
        scene.spheres.truncate(1);
        for sphere in &mut scene.spheres {
            sphere.velocity = [0.0; 3];
        }
        for (collider, stroke) in scene.colliders.iter_mut().zip(&self.strokes) {
            if stroke.is_some() {
                collider.motion.clear();
            }
        }
        scene
    }

    /// Returns the levers of a world of [`Self::at_start`], at rest.
    pub(crate) fn levers(&self, world: &World) -> Vec<Lever> {
        let parts = world.colliders().zip(self.roles.iter().zip(&self.strokes));
        let levers = parts.filter_map(|((id, collider), (role, stroke))| {
            Some(Lever::new(*role, id, collider.clone(), stroke.clone()?))
        });
        levers.collect()
    }
}

fn roles(colliders: &[Collider]) -> Vec<Role> {
    let mut targets = 0;
    let role = |collider: &Collider| {
        let name = collider.name.trim();
        match name.rsplit(' ').next().unwrap_or(name) {
            "target" if collider.trigger => {
                targets += 1;
                Role::Target(targets - 1)
            }
            "drain" if collider.trigger && collider.capture => Role::Drain,
            _ if collider.trigger => Role::Fixed,
            "flipper" if name == "left flipper" => Role::LeftFlipper,
            "flipper" if name == "right flipper" => Role::RightFlipper,
            "plunger" => Role::Plunger,
            "bumper" => Role::Bumper,
            "slingshot" => Role::Slingshot,
            _ => Role::Fixed,
        }
    };
    colliders.iter().map(role).collect()
}
