//! A table: a scene, its balls by their numbers, and the roles of its colliders.

use carom::{DVec3, Sphere, World};
use carom_scene::Library;
use carom_scene::scene::Scene;

use crate::error::TableError;
use crate::nine_ball::NINE;

/// Number of balls.
const BALLS: usize = NINE as usize + 1;

/// A table for nine-ball.
#[derive(Debug, Clone)]
pub struct Table {
    scene: Scene,
    /// The spheres of the balls by their numbers, at rest at their first places.
    balls: [Sphere; BALLS],
    /// Index of the cloth among the colliders.
    cloth: usize,
    cushions: Vec<usize>,
    pockets: Vec<usize>,
    /// Corners of the smallest rectangle that contains the middles of all pockets \[m\].
    corners: [DVec3; 2],
}

impl Table {
    /// Returns the built-in table.
    ///
    /// # Errors
    /// Only errors of a broken built-in scene.
    pub fn built_in() -> Result<Self, TableError> {
        let (scene, _) = Library::new().find("nine-ball", &[])?;
        Self::from_scene(&scene)
    }

    /// Makes a table from a scene with gravity along -y. Its ten spheres are the balls, whose `user_data` is 0 for the cue
    /// ball and 1 to 9 for the others; the cue ball's place is the middle of the head string, that of ball 1 the foot
    /// spot. The collider "cloth" is under them. Triggers that capture are pockets. Solid colliders whose names end with
    /// "cushion", "jaw" or "rail" are cushions.
    ///
    /// # Errors
    /// [`TableError`] if balls, cloth, cushions or pockets are missing, and for an invalid scene.
    pub fn from_scene(scene: &Scene) -> Result<Self, TableError> {
        let name = || scene.name.clone();
        let missing = |what| TableError::Missing { scene: scene.name.clone(), what };
        let has_others = !scene.generators.is_empty() || !scene.emitters.is_empty();
        if scene.spheres.len() != BALLS || has_others {
            return Err(TableError::Balls { scene: name() });
        }
        let all = |is: fn(&str) -> bool, captures: bool| -> Vec<usize> {
            let colliders = scene.colliders.iter().enumerate();
            let found = colliders.filter(|(_, it)| it.capture == captures && is(it.name.trim()));
            found.map(|(index, _)| index).collect()
        };
        let cloth = all(|name| name == "cloth", false);
        let cloth = *cloth.first().ok_or_else(|| missing("a collider named \"cloth\""))?;
        let is_cushion: fn(&str) -> bool =
            |name| ["cushion", "jaw", "rail"].iter().any(|it| name.ends_with(it));
        let (cushions, pockets) = (all(is_cushion, false), all(|_| true, true));
        if cushions.is_empty() {
            return Err(missing("colliders whose names end with \"cushion\""));
        }
        if pockets.is_empty() {
            return Err(missing("pockets: triggers with `capture`"));
        }
        let world = scene.world()?;
        let balls = numbered(&world).ok_or_else(|| TableError::Balls { scene: name() })?;
        let middles = pockets.iter().map(|index| DVec3::from(scene.colliders[*index].position));
        let corners = middles.fold([DVec3::INFINITY, -DVec3::INFINITY], |[least, most], it| {
            [least.min(it), most.max(it)]
        });
        Ok(Self { scene: scene.clone(), balls, cloth, cushions, pockets, corners })
    }

    /// Returns the title for display.
    pub fn title(&self) -> &str {
        if self.scene.title.is_empty() { &self.scene.name } else { &self.scene.title }
    }

    /// Returns the scene of the table.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns a ball by its number, at rest at its first place.
    pub fn ball(&self, number: u8) -> Option<&Sphere> {
        self.balls.get(usize::from(number))
    }

    /// Returns the length of the table between pockets \[m\].
    pub fn length(&self) -> f64 {
        (self.corners[1] - self.corners[0]).with_y(0.0).max_element()
    }

    /// Returns the direction from the head string to the foot spot, along the table.
    pub(crate) fn along(&self) -> DVec3 {
        let way = self.balls[1].position - self.balls[0].position;
        if way.x.abs() >= way.z.abs() {
            DVec3::X * way.x.signum()
        } else {
            DVec3::Z * way.z.signum()
        }
    }

    /// Returns whether a place is between the pockets.
    pub(crate) fn is_within(&self, place: DVec3) -> bool {
        let [least, most] = self.corners;
        (least.x..=most.x).contains(&place.x) && (least.z..=most.z).contains(&place.z)
    }

    pub(crate) fn cloth(&self) -> usize {
        self.cloth
    }

    pub(crate) fn cushions(&self) -> &[usize] {
        &self.cushions
    }

    pub(crate) fn pockets(&self) -> &[usize] {
        &self.pockets
    }
}

/// Returns the spheres of a world at rest by their numbers; `None` unless there is one of each.
fn numbered(world: &World) -> Option<[Sphere; BALLS]> {
    let spheres = world.spheres();
    let mut balls = [None; BALLS];
    for index in 0..spheres.len() {
        let sphere = spheres.get(index);
        let number = usize::try_from(sphere.user_data).ok()?;
        let at_rest = sphere.with_velocity(DVec3::ZERO).with_angular_velocity(DVec3::ZERO);
        if balls.get_mut(number)?.replace(at_rest).is_some() {
            return None;
        }
    }
    let all: Option<Vec<Sphere>> = balls.into_iter().collect();
    all?.try_into().ok()
}
