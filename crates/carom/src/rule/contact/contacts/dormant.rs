//! Contacts of sleeping spheres.

use glam::DVec3;

use super::batch::Impulses;
use crate::rule::contact::slots::GONE;

/// A contact of a sphere that sleeps.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Dormant {
    /// Slot of the sphere.
    pub sphere: u32,
    pub partner: Partner,
    /// Impulses on the sphere.
    pub impulses: Impulses,
    /// Coefficient of friction.
    pub sliding: f64,
    /// The force on the sphere \[N\].
    pub force: DVec3,
}

/// What a sleeping sphere touches.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Partner {
    /// Another sleeping sphere, by slot.
    Sphere(u32),
    /// A sphere that is awake, by slot; [`GONE`] once it has left the world.
    Awake(u32),
    Surface(u32),
}

impl Dormant {
    /// The slots of two spheres that sleep.
    pub fn sleepers(&self) -> Option<[usize; 2]> {
        match self.partner {
            Partner::Sphere(other) => Some([self.sphere as usize, other as usize]),
            _ => None,
        }
    }

    /// Returns whether one of the spheres that slept in the contact is awake.
    pub fn wakes(&self, sleeps: &[bool]) -> bool {
        let has_woken = |slot: u32| !sleeps[slot as usize];
        match self.partner {
            Partner::Sphere(other) => has_woken(self.sphere) || has_woken(other),
            _ => has_woken(self.sphere),
        }
    }

    /// The contact seen from the partner, which sleeps; the sphere is awake.
    fn reversed(self, partner: u32) -> Self {
        Self {
            sphere: partner,
            partner: Partner::Awake(self.sphere),
            impulses: self.impulses.reversed(),
            force: -self.force,
            ..self
        }
    }
}

/// Updates the slots of spheres; `now` returns the new slot, or [`GONE`].
pub(crate) fn renumber(dormant: &mut Vec<Dormant>, now: impl Fn(usize) -> u32) {
    let now = |slot: u32| if slot == GONE { GONE } else { now(slot as usize) };
    dormant.retain_mut(|contact| {
        contact.sphere = now(contact.sphere);
        match &mut contact.partner {
            Partner::Sphere(other) | Partner::Awake(other) => *other = now(*other),
            Partner::Surface(_) => {}
        }
        contact.sphere != GONE && contact.partner != Partner::Sphere(GONE)
    });
}

/// Removes the contacts of spheres that woke.
pub(crate) fn renew(dormant: &mut Vec<Dormant>, sleeps: &[bool]) {
    dormant.retain_mut(|contact| {
        let sleeps_on = sleeps[contact.sphere as usize];
        let Partner::Sphere(other) = contact.partner else { return sleeps_on };
        match (sleeps_on, sleeps[other as usize]) {
            (true, false) => contact.partner = Partner::Awake(other),
            (false, true) => *contact = contact.reversed(other),
            _ => {}
        }
        sleeps[contact.sphere as usize]
    });
}
