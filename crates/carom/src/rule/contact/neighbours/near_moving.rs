//! Finds the moving surfaces that each sphere may meet.

use crate::rule::contact::places::Places;
use crate::rule::contact::places::top_speed::TopSpeed;
use crate::rule::contact::slots::Slots;
use crate::system::System;

/// Numbers of moving surfaces near each sphere.
#[derive(Debug, Clone, Default)]
pub(crate) struct NearMoving {
    /// Places in `numbers`: those of a slot are `numbers[starts[slot] .. starts[slot + 1]]`,
    /// ascending; empty where nothing moves.
    starts: Vec<u32>,
    numbers: Vec<u32>,
}

impl NearMoving {
    /// Finds the surfaces near awake spheres: within a `reach` \[m\] of their centres, by slot and by how fast the
    /// surfaces are. Their places are known then.
    pub fn find(
        system: &System,
        slots: &Slots,
        places: &mut Places,
        reach: impl Fn(usize, TopSpeed) -> f64,
    ) -> Self {
        let trees = places.trees_at_start(system);
        let mut found = Self::default();
        if trees.is_empty() {
            return found;
        }
        for (slot, row) in slots.position.iter().enumerate() {
            let first = found.numbers.len();
            found.starts.push(first as u32);
            if slots.sleeps[slot] {
                continue;
            }
            for (tree, fastest) in &trees {
                tree.add_near(row.vector(), reach(slot, *fastest), &mut found.numbers);
            }
            found.numbers[first..].sort_unstable();
        }
        found.starts.push(found.numbers.len() as u32);
        places.know(system, &found.numbers);
        found
    }

    /// Returns the highest speed \[m/s\], by slot, with which a surface may approach each sphere within a time \[s\];
    /// empty where nothing moves.
    pub fn approaches(system: &System, slots: &Slots, places: &mut Places, time: f64) -> Vec<f64> {
        let near = Self::find(system, slots, places, |slot, fastest| {
            let (row, velocity) = (slots.position[slot], slots.velocity[slot].vector());
            let speed = fastest.around(row.vector(), row.number(), time);
            row.number() + time * (speed + velocity.length())
        });
        let slots_of_near = 0..near.starts.len().saturating_sub(1);
        let approach = |slot: usize| {
            let (row, velocity) = (slots.position[slot], slots.velocity[slot].vector());
            places.approach(near.of(slot), (row.vector(), row.number()), velocity, time)
        };
        slots_of_near.map(approach).collect()
    }

    /// Returns the surfaces near the sphere in a slot.
    pub fn of(&self, slot: usize) -> &[u32] {
        match self.starts.get(slot..slot + 2) {
            Some(&[first, last]) => &self.numbers[first as usize..last as usize],
            _ => &[],
        }
    }
}
