//! Sweeps over contacts of spheres with surfaces, and the correction of their overlaps.

use glam::DVec3;

use super::batch::Impulses;
use super::coulomb::{limited, slip};
use super::surfaces::{self, SurfaceContact, push, turn};
use super::swept::FREE;
use crate::rule::contact::places::Places;
use crate::rule::contact::slots::Run;
use crate::rule::contact::slots::slab_totals::SlabTotals;
use crate::rule::contact::sub_step::{RELAXATION, SLOP};

impl SurfaceContact {
    /// Solves the contact: applies the impulses that it needs.
    fn solve(&mut self, run: &mut Run) -> SlabTotals {
        let slot = self.slot as usize;
        let inverse_mass = run.velocity[slot].number();
        let velocity = run.velocity[slot].vector() - self.velocity;
        let speed = velocity.dot(self.normal);
        let Impulses { normal: impulse, tangential, angular, .. } = self.impulses;
        let room = speed + self.bias;
        let solved = (impulse - room / inverse_mass).max(0.0);
        let change = solved - impulse;
        let found = SlabTotals {
            change: change.abs(),
            excess: (-room).max(0.0),
            impulse: solved.max(impulse),
            ..SlabTotals::default()
        };
        if solved == 0.0 && impulse == 0.0 {
            return found;
        }
        self.impulses.normal = solved;
        let mut across = DVec3::ZERO;
        if !run.spin.is_empty() && self.friction.sliding > 0.0 {
            let spin = run.spin[slot];
            let excess = slip(velocity, self.normal, spin.vector()) - self.slip();
            let kept = DVec3::from_array(tangential);
            let wanted = kept - excess / (inverse_mass + spin.number());
            let limited = limited(wanted, self.friction.sliding * solved);
            self.impulses.tangential = limited.to_array();
            across = limited - kept;
        }
        push(run, self.slot, self.normal, [change * self.normal, across]);
        if !run.spin.is_empty() && (self.friction.rolling > 0.0 || self.friction.spinning > 0.0) {
            self.solve_rolling(run, DVec3::from_array(angular));
        }
        found
    }

    /// Applies the angular impulses against rolling and spinning on the surface.
    fn solve_rolling(&mut self, run: &mut Run, kept: DVec3) {
        let slot = self.slot as usize;
        let (spin, radius) = (run.spin[slot], run.position[slot].number());
        let relative = spin.vector() / radius - self.angular_velocity;
        let wanted = kept - relative * (radius * radius / spin.number());
        let along = wanted.dot(self.normal) * self.normal;
        let arm = radius * self.impulses.normal;
        let solved = limited(wanted - along, self.friction.rolling * arm)
            + limited(along, self.friction.spinning * arm);
        self.impulses.angular = solved.to_array();
        turn(run, self.slot, solved - kept);
    }
}

/// Writes the places of the contacts of a run that may press in the sub-step.
pub(crate) fn find_active(contacts: &[SurfaceContact], active: &mut Vec<u32>) {
    active.clear();
    let may_press = |it: &SurfaceContact| it.bias != FREE || it.impulses.normal != 0.0;
    active.extend((0..).zip(contacts).filter(|it| may_press(it.1)).map(|it| it.0));
}

/// Sweeps over the `active` ones of the contacts of a run: each gets the impulses that it needs with the others as they
/// are. Returns the largest change of a normal impulse, and the other totals.
pub(crate) fn sweep(
    run: &mut Run,
    (contacts, active): (&mut [SurfaceContact], &[u32]),
    backwards: bool,
) -> SlabTotals {
    let mut found = SlabTotals::default();
    let mut solve = |&place: &u32| found = found.or_larger(contacts[place as usize].solve(run));
    if backwards {
        active.iter().rev().for_each(&mut solve);
    } else {
        active.iter().for_each(&mut solve);
    }
    found
}

/// Moves spheres that overlap surfaces out of them; velocities stay as they are. Returns the work
/// against the forces that are linear \[J\], and the largest overlap as a part of the radius.
pub(crate) fn correct(run: &mut Run, contacts: &[SurfaceContact], places: &Places) -> SlabTotals {
    let (mut work, mut largest) = (0.0, 0.0_f64);
    for contact in contacts {
        let slot = contact.slot as usize;
        let (center, radius) = (run.position[slot].vector(), run.position[slot].number());
        if contact.is_clear(run, center, 0.0) {
            continue;
        }
        let (form, _) = places.at_end(contact.surface);
        let separation = contact.separation(run, form, (center, radius));
        let overlap = separation.map_or(0.0, |it| -it.distance - SLOP * radius).max(0.0);
        if overlap > 0.0 && !contact.passes {
            let out = separation.map_or(DVec3::ZERO, |it| RELAXATION * overlap * it.normal);
            work += surfaces::move_by(run, slot, out);
            largest = largest.max(overlap / radius);
        }
    }
    SlabTotals { energy: work, overlap: largest, ..SlabTotals::default() }
}
