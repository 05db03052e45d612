//! What an interface shows of a session: a plain copy.

use std::sync::Arc;

use carom::{
    DQuat, DVec3, Friction, PersistentContact, Pose, SphereId, Spring, SpringId, StateHash,
};
use carom_scene::Paint;
use carom_scene::scene::{Scene, Sphere};

use crate::change::PastChange;
use crate::distance::Distance;
use crate::error::SessionError;
use crate::impacts::ListedImpact;
use crate::readings::{PickedReading, Reading};
use crate::setup::Setup;

/// Time for which the marks of impacts last \[simulated s\].
pub const MARKED: f64 = 0.1;

/// All that an interface shows of a session, copied at one moment.
#[derive(Debug, Clone)]
pub struct View {
    /// The scene as first opened: names, camera, light, colours.
    pub scene: Arc<Scene>,
    /// What is not spheres, as edited.
    pub setup: Arc<Setup>,
    /// What was changed from outside, ascending by frame, the future included.
    pub changes: Arc<Vec<PastChange>>,
    /// Number of frames taken.
    pub frame: u64,
    /// \[s\]
    pub time: f64,
    /// The last frame reached.
    pub furthest_frame: u64,
    /// Its time \[s\].
    pub furthest: f64,
    /// When edits were made, or are to be made again \[s\]; ascending, the future included.
    pub edits: Vec<f64>,
    /// How many edits by hand can be taken back.
    pub undoable: usize,
    /// How many that were taken back can be made again.
    pub redoable: usize,
    /// The frame it is on the way to.
    pub seeking: Option<u64>,
    /// All spheres.
    pub spheres: SphereArrays,
    /// Springs, in the order in which their forces are added up.
    pub springs: Vec<(SpringId, Spring)>,
    /// Where the colliders of [`Setup::colliders`] are now.
    pub poses: Vec<Pose>,
    /// What is measured now.
    pub now: Reading,
    /// What was measured until now, from the beginning.
    pub readings: Vec<Reading>,
    /// The sphere that is followed; it may have gone.
    pub picked: Option<SphereId>,
    /// The picked sphere until now, from the beginning as far as the past is kept.
    pub picked_readings: Vec<PickedReading>,
    /// The last impacts, oldest first.
    pub impacts: Vec<ListedImpact>,
    /// The contacts that persist, with their forces, where [`Command::ShowContacts`] asks for them;
    /// see [`carom::World::contacts`].
    ///
    /// [`Command::ShowContacts`]: crate::Command::ShowContacts
    pub contacts: Vec<PersistentContact>,
    /// How it is played.
    pub playback: Playback,
    /// The same scene under the other rule, where two are compared.
    pub other: Option<Box<View>>,
    /// How far apart the two were until now.
    pub distances: Vec<Distance>,
}

/// All spheres, one array per quantity, ascending by id.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SphereArrays {
    /// Ascending.
    pub ids: Vec<SphereId>,
    /// Centres \[m\].
    pub positions: Vec<DVec3>,
    /// Centres a frame ago \[m\].
    pub previous_positions: Vec<DVec3>,
    /// \[m/s\]
    pub velocities: Vec<DVec3>,
    /// \[m\]
    pub radii: Vec<f64>,
    /// \[kg\]
    pub masses: Vec<f64>,
    /// Coefficients of restitution.
    pub restitutions: Vec<f64>,
    /// What each sphere says of friction; empty while none says anything.
    pub frictions: Vec<Friction>,
    /// Moments of inertia divided by m r²; empty while all spheres are solid balls.
    pub inertia_factors: Vec<f64>,
    /// Rotations from the coordinate system of each sphere to the world's; empty while no sphere was
    /// ever turned.
    pub orientations: Vec<DQuat>,
    /// Orientations a frame ago; empty where nothing can turn a sphere ([`carom::World::has_spin`]).
    pub previous_orientations: Vec<DQuat>,
    /// Angular velocities \[rad/s\]; empty while no sphere was ever turned.
    pub angular_velocities: Vec<DVec3>,
    /// Their looks, with the colour of their density where they have none of their own.
    pub paints: Vec<Paint>,
    /// Another number when anything but the motion may have changed, within one scene.
    pub stamp: u64,
}

/// How a session is played.
#[derive(Debug, Clone)]
pub struct Playback {
    /// Whether time goes on.
    pub playing: bool,
    /// Wished for: simulated seconds per second.
    pub speed: f64,
    /// Reached: simulated seconds per second; `None` before anything was measured.
    pub realtime_factor: Option<f64>,
    /// Whether the machine keeps up with the wish.
    pub keeps_up: bool,
    /// Part of the frame under way, in \[0, 1\]: a picture shows spheres so far on the way from
    /// their previous positions to their positions.
    pub blend: f64,
    /// How fast that part grows after this view was made \[1/s\].
    pub blend_rate: f64,
    /// What went wrong last; gone with the next thing that goes well.
    pub error: Option<Arc<SessionError>>,
    /// The state as one number, where a command requested it.
    pub state_hash: Option<StateHash>,
}

impl Default for Playback {
    fn default() -> Self {
        Self {
            playing: false,
            speed: 1.0,
            realtime_factor: None,
            keeps_up: true,
            blend: 1.0,
            blend_rate: 0.0,
            error: None,
            state_hash: None,
        }
    }
}

impl Default for View {
    /// Of a scene with nothing in it.
    fn default() -> Self {
        Self {
            scene: Arc::new(Scene::new("")),
            setup: Arc::default(),
            changes: Arc::default(),
            frame: 0,
            time: 0.0,
            furthest_frame: 0,
            furthest: 0.0,
            edits: Vec::new(),
            undoable: 0,
            redoable: 0,
            seeking: None,
            spheres: SphereArrays::default(),
            springs: Vec::new(),
            poses: Vec::new(),
            now: Reading::default(),
            readings: Vec::new(),
            picked: None,
            picked_readings: Vec::new(),
            impacts: Vec::new(),
            contacts: Vec::new(),
            playback: Playback::default(),
            other: None,
            distances: Vec::new(),
        }
    }
}

impl View {
    /// The present as a scene; see [`Session::scene_now`](crate::Session::scene_now).
    pub fn scene_now(&self) -> Scene {
        let mut scene = self.setup.scene(&self.scene);
        for (collider, pose) in scene.colliders.iter_mut().zip(&self.poses) {
            collider.position = pose.position.to_array();
            collider.rotation = pose.rotation.to_array();
        }
        scene.spheres.extend((0..self.spheres.ids.len()).map(|i| self.spheres.described(i)));
        let springs = self.springs.iter();
        let described = |(_, spring): &_| carom_scene::scene::Spring::of(spring, &self.spheres.ids);
        scene.springs.extend(springs.filter_map(described));
        // Rules that find contacts late let spheres overlap; a scene has to admit it.
        if !scene.simulation.allow_overlap && scene.world().is_err() {
            scene.simulation.allow_overlap = true;
            // What else is wrong with it, that does not help.
            scene.simulation.allow_overlap = scene.world().is_ok();
        }
        scene
    }

    /// The impacts to be marked: those of the last [`MARKED`] seconds, oldest first.
    pub fn marks(&self) -> &[ListedImpact] {
        let first = self.impacts.partition_point(|impact| impact.time <= self.time - MARKED);
        &self.impacts[first..]
    }
}

impl SphereArrays {
    /// Index of a sphere in the arrays.
    pub fn index_of(&self, id: SphereId) -> Option<usize> {
        self.ids.binary_search(&id).ok()
    }

    /// How a sphere is turned when it is so far (`blend` in \[0, 1\]) on the shorter way from a frame
    /// ago to now; `None` where nothing can turn a sphere.
    pub fn orientation(&self, index: usize, blend: f64) -> Option<DQuat> {
        let before = self.previous_orientations.get(index)?;
        Some(before.lerp(or(&self.orientations, index, DQuat::IDENTITY), blend))
    }

    /// What the sphere at an index says of friction.
    pub fn friction(&self, index: usize) -> Friction {
        or(&self.frictions, index, Friction::default())
    }

    /// Angular velocity of the sphere at an index \[rad/s\].
    pub fn angular_velocity(&self, index: usize) -> DVec3 {
        or(&self.angular_velocities, index, DVec3::ZERO)
    }

    /// A sphere as scene files write it.
    fn described(&self, index: usize) -> Sphere {
        let usual = carom::Sphere::new(self.positions[index], self.radii[index]);
        let sphere = usual
            .with_velocity(self.velocities[index])
            .with_mass(self.masses[index])
            .with_restitution(self.restitutions[index])
            .with_friction(self.friction(index))
            .with_inertia_factor(or(&self.inertia_factors, index, usual.inertia_factor))
            .with_orientation(or(&self.orientations, index, usual.orientation))
            .with_angular_velocity(self.angular_velocity(index));
        Sphere::of(&sphere).painted(self.paints[index])
    }
}

/// The value at an index of an array that is empty while all values are `usual`.
fn or<T: Copy>(values: &[T], index: usize, usual: T) -> T {
    values.get(index).copied().unwrap_or(usual)
}

/// Fills a list anew, in the memory it has.
pub(crate) fn replace<T>(list: &mut Vec<T>, with: impl Iterator<Item = T>) {
    list.clear();
    list.extend(with);
}
