//! The state of the rule between frames.

use educe::Educe;
use glam::DVec3;

use super::contacts::batch::ContactKinds;
use super::contacts::dormant::Dormant;
use super::contacts::materials::Materials;
use super::places::Places;
use super::slabs::Slabs;
use super::slabs::incidence::Incidence;
use super::slabs::landings::Landings;
use super::slabs::search::Search;
use super::slabs::warm_start::WarmStart;
use super::slots::Slots;
use super::slots::drift::Drift;

/// Spheres in their order of memory, their neighbours, and the impulses of their contacts: part of a
/// snapshot, but not of the state hash.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Solver {
    pub(super) slots: Slots,
    pub(super) slabs: Slabs,
    /// The impulses of contacts that were removed from [`Self::slabs`], until the next search.
    pub(super) warm_start: Option<WarmStart>,
    /// Spheres, by slot, whose bounces lead elsewhere than their last velocity.
    pub(super) bounces: Vec<Bounce>,
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) landings: Landings,
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) incidence: Incidence,
    /// Places and motions of surfaces in the sub-step.
    pub(super) places: Places,
    /// The common motion of spheres since the last search.
    pub(super) drift: Drift,
    pub(super) kinds: ContactKinds,
    pub(super) materials: Materials,
    /// The acceleration of all spheres \[m/s²\], where it is one and constant.
    pub(super) common_acceleration: Option<DVec3>,
    /// Whether some force is not linear, and is evaluated in every sub-step.
    pub(super) has_other_forces: bool,
    /// Whether a surface moves.
    pub(super) has_moving_surfaces: bool,
    /// Whether friction acts and a surface is a belt.
    pub(super) has_belts: bool,
    /// Conservative part of the forces applied to single spheres \[N\], by index, in the next sub-step.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) held_forces: Vec<DVec3>,
    /// Kinetic energy before the impulses of the sub-step \[J\].
    pub(super) energy_before: f64,
    /// Smallest radius of all spheres \[m\].
    pub(super) smallest_radius: f64,
    /// Length of the sub-steps of the last frame \[s\].
    pub(super) h: f64,
    /// Whether a search is due whatever the spheres do.
    pub(super) is_stale: bool,
    /// Whether something was changed from outside since the last frame.
    pub(super) is_changed: bool,
    /// Pairs of a sleeping sphere and an awake one near it, by slot.
    pub(super) watched: Vec<[u32; 2]>,
    /// The contacts of spheres that sleep.
    pub(super) dormant: Vec<Dormant>,
    /// Speed below which a sphere is calm, as a part of `sqrt(a r)`.
    pub(super) sleep_speed: f64,
    /// Whether spheres at rest stay at rest: forces are constant, and surfaces fixed.
    pub(super) may_sleep: bool,
    /// Frames since the last search for spheres that may sleep.
    pub(super) frames: u32,
}

/// The effect of a bounce on the path of a sphere in a sub-step.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Bounce {
    pub slot: u32,
    /// Offset from the place to which the last velocity leads in the whole sub-step \[m\].
    pub shift: DVec3,
    /// Velocity at the end \[m/s\].
    pub velocity: DVec3,
    /// Whether nothing else touches it in the sub-step.
    pub is_alone: bool,
    /// Whether the sphere reverses or stops at a surface.
    pub is_at_surface: bool,
    /// The turning point, if nothing else touches the sphere.
    pub turn: Option<Turn>,
}

/// The turning point of a sphere in a sub-step.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Turn {
    /// Time in the sub-step \[s\].
    pub time: f64,
    /// Centre of the sphere then \[m\].
    pub place: DVec3,
}

/// Working memory of the rule, kept from step to step only to spare its allocation. A copy begins without any.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    pub(super) search: Search,
    pub(super) warm_start: WarmStart,
}

impl Clone for Scratch {
    fn clone(&self) -> Self {
        Self::default()
    }

    /// Keeps the memory of `self`.
    fn clone_from(&mut self, _: &Self) {}
}

impl Solver {
    /// Notes a change from outside: neighbours are found again, and all sleeping spheres wake. Contacts keep their
    /// impulses.
    pub fn set_changed(&mut self) {
        self.is_changed = true;
    }

    /// Returns the number of spheres that sleep.
    pub fn asleep(&self) -> u32 {
        self.slots.asleep() as u32
    }

    /// Whether nothing happens in a frame without emissions and changes from outside: all spheres sleep.
    pub fn is_idle(&self) -> bool {
        let sleeps = &self.slots.sleeps;
        !self.is_changed && !sleeps.is_empty() && sleeps.iter().all(|&sleeps| sleeps)
    }
}
