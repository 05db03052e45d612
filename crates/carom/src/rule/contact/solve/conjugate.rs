//! Accelerated sweeps, which converge faster without friction: the change of impulses in a sweep forth and back is
//! taken for the descent of a function, and conjugate directions are followed (Silcowitz, Niebe and Erleben, A
//! nonsmooth nonlinear conjugate gradient method for interactive contact force problems, The Visual Computer 26,
//! 893 (2010)). With friction there is no such function.

use glam::DVec3;

use crate::rule::contact::contacts::batch::get;
use crate::rule::contact::slabs::descent::Descent;
use crate::rule::contact::slabs::{Direction, Slab, Slabs};
use crate::rule::contact::slots::{Run, Slots};

/// Saves the impulses before the sweeps.
pub(crate) fn begin(slots: &mut Slots, slabs: &mut Slabs) {
    slabs.each_contact(slots, Direction::Forwards, |_, slab| {
        let before = impulses(slab);
        let direction = vec![0.0; before.len()];
        slab.descent = Descent { before, direction, change: Vec::new() };
    });
}

/// Adds a step along the direction before, after sweeps have changed the impulses, and updates the direction by
/// that change. `last` is the sum of squares of the change before, infinite at first. Returns that of this change.
pub(crate) fn follow(slots: &mut Slots, slabs: &mut Slabs, last: f64) -> f64 {
    slabs.each_contact(slots, Direction::Forwards, |_, slab| {
        let now = impulses(slab);
        let both = now.iter().zip(&slab.descent.before);
        slab.descent.change = both.map(|(now, before)| now - before).collect();
    });
    let squares = |slab: &Slab| slab.descent.change.iter().map(|it| it * it).sum::<f64>();
    let sum = slabs.iter().map(squares).sum::<f64>();
    // Where changes grow, the descent restarts.
    let part = if sum < last { sum / last } else { 0.0 };
    slabs.each_contact(slots, Direction::Forwards, |run, slab| {
        slab.descent.direction.iter_mut().for_each(|it| *it *= part);
        push(run, slab);
        let Descent { change, direction, .. } = &mut slab.descent;
        direction.iter_mut().zip(change).for_each(|(direction, change)| *direction += *change);
        slab.descent.before = impulses(slab);
    });
    sum
}

/// Forgets the descent.
pub(crate) fn end(slabs: &mut Slabs) {
    slabs.iter_mut().for_each(|slab| slab.descent = Descent::default());
}

/// The normal impulses of a slab.
fn impulses(slab: &Slab) -> Vec<f64> {
    let of_pairs = slab.batches.contacts();
    let of_pairs = of_pairs.map(|(number, lane, _)| slab.batches.pairs[number].impulse[lane]);
    of_pairs.chain(slab.surfaces.iter().map(|contact| contact.impulses.normal)).collect()
}

/// Changes the normal impulses of a slab by the direction, and the velocities by them.
fn push(run: &mut Run, slab: &mut Slab) {
    let Slab { batches, surfaces, descent, .. } = slab;
    let (of_pairs, of_surfaces) = descent.direction.split_at(batches.count());
    let mut push = |slot: u32, impulse: DVec3| {
        let row = &mut run.velocity[slot as usize];
        *row = row.with_vector(row.vector() + row.number() * impulse);
    };
    let contacts: Vec<_> = batches.contacts().collect();
    for ((number, lane, [first, second]), step) in contacts.into_iter().zip(of_pairs) {
        let batch = &mut batches.pairs[number];
        let impulse = *step * DVec3::from_array(get(&batch.normal, lane));
        batch.impulse[lane] += step;
        push(first, -impulse);
        push(second, impulse);
    }
    for (contact, step) in surfaces.iter_mut().zip(of_surfaces) {
        contact.impulses.normal += step;
        push(contact.slot, *step * contact.normal);
    }
}
