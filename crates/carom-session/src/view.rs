//! Views: copies of everything that an interface shows of a session.

use std::sync::Arc;

use carom::{
    DQuat, DVec3, Friction, PersistentContact, Pose, RestitutionLaw, SphereId, Spring, SpringId,
    StateHash,
};
use carom_scene::Paint;
use carom_scene::scene::{Scene, Sphere};

use crate::change::PastChange;
use crate::distance::Distance;
use crate::error::SessionError;
use crate::impacts::ListedImpact;
use crate::readings::{PickedReading, Reading};
use crate::setup::Setup;

/// Time for which impacts are marked \[simulated s\].
pub const MARKED: f64 = 0.1;

/// Everything that an interface shows of a session, copied at one moment.
#[derive(Debug, Clone)]
pub struct View {
    /// The scene as opened: names, camera, light, colours.
    pub scene: Arc<Scene>,
    /// Everything except spheres, as edited.
    pub setup: Arc<Setup>,
    /// All changes, ascending by frame, including those in the future.
    pub changes: Arc<Vec<PastChange>>,
    /// Number of frames taken.
    pub frame: u64,
    /// Time \[s\].
    pub time: f64,
    /// Furthest frame reached.
    pub furthest_frame: u64,
    /// Time of the furthest frame \[s\].
    pub furthest: f64,
    /// Times of edits \[s\], ascending, including those in the future.
    pub edits: Vec<f64>,
    /// Number of manual edits that can be undone.
    pub undoable: usize,
    /// Number of edits that can be repeated.
    pub redoable: usize,
    /// Frame to which the session is going.
    pub seeking: Option<u64>,
    /// All spheres.
    pub spheres: SphereArrays,
    /// Springs, in the order in which their forces are summed.
    pub springs: Vec<(SpringId, Spring)>,
    /// Present poses of the colliders of [`Setup::colliders`].
    pub poses: Vec<Pose>,
    /// Present measurements.
    pub now: Reading,
    /// Measurements from the beginning to the present.
    pub readings: Vec<Reading>,
    /// The picked sphere; it may have been removed.
    pub picked: Option<SphereId>,
    /// Measurements of the picked sphere to the present, as far back as the past is stored.
    pub picked_readings: Vec<PickedReading>,
    /// The most recent impacts, oldest first.
    pub impacts: Vec<ListedImpact>,
    /// Persistent contacts with their forces, if [`Command::ShowContacts`] requested them; see
    /// [`carom::World::contacts`].
    ///
    /// [`Command::ShowContacts`]: crate::Command::ShowContacts
    pub contacts: Vec<PersistentContact>,
    /// Points of the path of the ball that is aimed \[m\], see [`Aim::path`](crate::Aim::path); empty without one.
    pub aimed: Vec<DVec3>,
    /// State of playback.
    pub playback: Playback,
    /// View of the same scene under the other rule, if two are compared.
    pub other: Option<Box<View>>,
    /// Distances of the two worlds up to the present.
    pub distances: Vec<Distance>,
}

/// All spheres, one array per quantity, ascending by id.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SphereArrays {
    /// Ids, ascending.
    pub ids: Vec<SphereId>,
    /// Centres \[m\].
    pub positions: Vec<DVec3>,
    /// Centres one frame ago \[m\].
    pub previous_positions: Vec<DVec3>,
    /// Velocities \[m/s\].
    pub velocities: Vec<DVec3>,
    /// Radii \[m\].
    pub radii: Vec<f64>,
    /// Masses \[kg\].
    pub masses: Vec<f64>,
    /// Coefficients of restitution.
    pub restitutions: Vec<f64>,
    /// Laws of restitution; empty while no sphere has one.
    pub restitution_laws: Vec<Option<RestitutionLaw>>,
    /// Numbers of materials; empty while all are 0.
    pub materials: Vec<u8>,
    /// Friction of each sphere; empty while no sphere has its own.
    pub frictions: Vec<Friction>,
    /// Moments of inertia divided by m r²; empty while all spheres are solid balls.
    pub inertia_factors: Vec<f64>,
    /// Rotations from the coordinate system of each sphere to the world's; empty while no sphere
    /// has rotated.
    pub orientations: Vec<DQuat>,
    /// Orientations one frame ago; empty if nothing can rotate a sphere
    /// ([`carom::World::has_spin`]).
    pub previous_orientations: Vec<DQuat>,
    /// Angular velocities \[rad/s\]; empty while no sphere has rotated.
    pub angular_velocities: Vec<DVec3>,
    /// Paints, with the colours of densities for spheres without their own.
    pub paints: Vec<Paint>,
    /// Changes whenever anything except the motion may have changed, within one scene.
    pub stamp: u64,
}

/// State of playback.
#[derive(Debug, Clone)]
pub struct Playback {
    /// Whether the session is playing.
    pub playing: bool,
    /// Requested speed in simulated seconds per second.
    pub speed: f64,
    /// Measured speed in simulated seconds per second; `None` before the first measurement.
    pub realtime_factor: Option<f64>,
    /// Whether the machine keeps up with the requested speed.
    pub keeps_up: bool,
    /// Elapsed fraction of the current frame, in \[0, 1\]: a picture shows spheres at this fraction
    /// between their previous positions and their positions.
    pub blend: f64,
    /// Growth of `blend` after this view was made \[1/s\].
    pub blend_rate: f64,
    /// The last error; removed by the next success.
    pub error: Option<Arc<SessionError>>,
    /// State hash, if a command requested it.
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
    /// View of an empty scene.
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
            aimed: Vec::new(),
            playback: Playback::default(),
            other: None,
            distances: Vec::new(),
        }
    }
}

impl View {
    /// Writes the present as a scene; see [`Session::scene_now`](crate::Session::scene_now).
    pub fn scene_now(&self) -> Scene {
        let mut scene = self.setup.scene(&self.scene);
        for (collider, pose) in scene.colliders.iter_mut().zip(&self.poses) {
            if collider.motion.is_empty() {
                collider.position = pose.position.to_array();
                collider.rotation = pose.rotation.to_array();
            } else {
                *collider = collider.beginning_at(self.time);
            }
        }
        let spheres: Vec<Sphere> = (0..self.spheres.ids.len())
            .map(|i| Sphere {
                material: scene.material_name(or(&self.spheres.materials, i, 0)),
                ..self.spheres.described(i)
            })
            .collect();
        scene.spheres.extend(spheres);
        let springs = self.springs.iter();
        let described = |(_, spring): &_| carom_scene::scene::Spring::of(spring, &self.spheres.ids);
        scene.springs.extend(springs.filter_map(described));
        // Under rules that find contacts late, spheres overlap; the scene must allow it.
        if !scene.simulation.allow_overlap && scene.world().is_err() {
            scene.simulation.allow_overlap = true;
            // If the scene is invalid for another reason, the setting does not help.
            scene.simulation.allow_overlap = scene.world().is_ok();
        }
        scene
    }

    /// Impacts to mark: those of the last [`MARKED`] seconds, oldest first.
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

    /// Orientation of a sphere at the fraction `blend` in \[0, 1\] between one frame ago and now;
    /// `None` if nothing can rotate a sphere.
    pub fn orientation(&self, index: usize, blend: f64) -> Option<DQuat> {
        let before = self.previous_orientations.get(index)?;
        Some(before.lerp(or(&self.orientations, index, DQuat::IDENTITY), blend))
    }

    /// Friction of the sphere at `index`.
    pub fn friction(&self, index: usize) -> Friction {
        or(&self.frictions, index, Friction::default())
    }

    /// Angular velocity of the sphere at an index \[rad/s\].
    pub fn angular_velocity(&self, index: usize) -> DVec3 {
        or(&self.angular_velocities, index, DVec3::ZERO)
    }

    /// Describes a sphere as in scene files.
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
        let law = or(&self.restitution_laws, index, None);
        let sphere = law.map_or(sphere, |law| sphere.with_restitution_law(law));
        Sphere::of(&sphere).painted(self.paints[index])
    }
}

/// Returns a value of an array that is empty while all values are `usual`.
fn or<T: Copy>(values: &[T], index: usize, usual: T) -> T {
    values.get(index).copied().unwrap_or(usual)
}

/// Replaces the content of a list in its existing memory.
pub(crate) fn replace<T>(list: &mut Vec<T>, with: impl Iterator<Item = T>) {
    list.clear();
    list.extend(with);
}
