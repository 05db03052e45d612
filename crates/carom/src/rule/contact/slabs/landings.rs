//! Results of cascades in a sub-step.

use educe::Educe;
use glam::DVec3;

use super::incidence::Origin;
use crate::rule::contact::contacts::batch::Impulses;

/// The state of a sphere after a cascade.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Landed {
    pub slot: u32,
    /// Centre at the end of the sub-step \[m\].
    pub position: DVec3,
    /// Path of the sphere in the sub-step \[m\].
    pub path: DVec3,
    pub velocity: DVec3,
    /// r w \[m/s\]
    pub spin: DVec3,
    /// Centre at the start of the last flight \[m\].
    pub from: DVec3,
    /// Sum over its flights of the time times the mean of the first and the last velocity \[m\].
    pub way: DVec3,
    /// Sum over its flights of the time times the product of that mean and the velocity that drag acts on \[m²/s\].
    pub against_drag: f64,
    /// Whether the sphere presses on something at the end.
    pub bears: bool,
    /// Whether it has met a surface.
    pub met_surface: bool,
}

/// The results of the cascades of a sub-step.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
pub(crate) struct Landings {
    /// The spheres of cascades, by slot.
    pub spheres: Vec<Landed>,
    /// The impulses with which their contacts start the next sub-step.
    pub contacts: Vec<(Origin, Impulses)>,
}

impl Landings {
    /// Whether the sphere in a slot is among them.
    pub fn has(&self, slot: usize) -> bool {
        self.of(slot).is_some()
    }

    /// The result for the sphere in a slot, if it was in a cascade.
    pub fn of(&self, slot: usize) -> Option<&Landed> {
        let place = |it: &Landed| it.slot as usize;
        let found = self.spheres.binary_search_by_key(&slot, place).ok()?;
        Some(&self.spheres[found])
    }
}
