//! Whether spheres that press on each other are at rest as a whole: each may be slow while all roll down a gentle
//! slope.

use glam::DVec3;

use crate::connected::Connected;
use crate::rule::contact::slots::Slots;

/// A group is at rest if it is slower than this part of sqrt(a r): in the time sqrt(r / a) it moves by this part of
/// the radius.
const AT_REST: f64 = 1e-3;
/// A group stays at rest if it accelerates by less than this part of the acceleration by forces alone: in the time
/// sqrt(r / a) it moves by half this part of the radius.
const TOGETHER: f64 = 2e-3;
/// A sphere that touches no other one stays at rest where its contacts cancel the forces on it, up to this part:
/// contacts with surfaces are solved that well.
const ALONE: f64 = 1e-9;

/// Awake spheres that press on each other.
#[derive(Clone, Copy, Default)]
struct Group {
    count: u32,
    mass: f64,
    momentum: DVec3,
    /// Change of momentum in the sub-step \[kg m/s\], and the one by forces alone.
    change: DVec3,
    by_forces: DVec3,
}

impl Group {
    fn add(&mut self, slots: &Slots, slot: usize, h: f64) {
        let (velocity, inverse_mass) =
            (slots.velocity[slot].vector(), slots.velocity[slot].number());
        let mass = 1.0 / inverse_mass;
        self.count += 1;
        self.mass += mass;
        self.momentum += mass * velocity;
        self.change += mass * (velocity - slots.before[slot].vector());
        self.by_forces += mass * h * slots.acceleration[slot].vector();
    }

    /// Whether the group moves or is about to, seen by a member with this radius \[m\].
    fn moves(&self, radius: f64, h: f64) -> bool {
        let most = if self.count == 1 { ALONE } else { TOGETHER };
        // Mass times the square of a speed, both of the whole group.
        let slow = AT_REST * AT_REST * radius * self.mass * self.by_forces.length() / h;
        self.momentum.length_squared() >= slow
            || self.change.length() >= most * self.by_forces.length()
    }
}

/// Sets the flags, by slot, of the awake spheres whose group moves or is about to move, in sub-steps of `h` \[s\].
/// `bearing` holds the slots of the spheres that press on each other.
pub(crate) fn note_moving(slots: &Slots, bearing: &[[usize; 2]], h: f64, moves: &mut [bool]) {
    let is_awake = |slot: usize| !slots.sleeps[slot] && slots.velocity[slot].number() > 0.0;
    let mut connected = Connected::new(slots.len());
    for &[first, second] in bearing.iter().filter(|pair| pair.iter().all(|&slot| is_awake(slot))) {
        connected.join(first, second);
    }
    let mut groups = vec![Group::default(); slots.len()];
    for slot in (0..slots.len()).filter(|&slot| is_awake(slot)) {
        groups[connected.root_of(slot)].add(slots, slot, h);
    }
    for slot in (0..slots.len()).filter(|&slot| is_awake(slot)) {
        let radius = slots.position[slot].number();
        moves[slot] |= groups[connected.root_of(slot)].moves(radius, h);
    }
}
