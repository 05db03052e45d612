//! Pairs of spheres that may touch across the faces of a periodic box: one of them is an image.

use glam::DVec3;

use crate::detect::broad_phase::BroadPhase;
use crate::rule::contact::places::offsets;
use crate::rule::contact::slots::Slots;
use crate::rule::periodic::image_shift;

/// A pair of slots, the smaller one first, with the offset from the second sphere to its image that the first may
/// touch \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct ImagePair {
    pub slots: [u32; 2],
    pub shift: DVec3,
}

/// Working memory of the search for such pairs.
#[derive(Debug, Clone, Default)]
pub(crate) struct ImageSearch {
    /// Spheres near a face.
    own: Vec<Place>,
    /// Images near a face.
    images: Vec<Place>,
    phases: [BroadPhase; 2],
    found: Vec<(u32, u32)>,
}

/// A sphere or an image of one.
#[derive(Debug, Clone, Copy)]
struct Place {
    slot: u32,
    center: DVec3,
    /// Shift from the sphere to its image \[m\].
    shift: DVec3,
}

impl ImageSearch {
    /// Finds the pairs one of which is awake, in order of their slots. All spheres are in the box.
    pub fn find(&mut self, slots: &Slots, pairs: &mut Vec<ImagePair>) {
        pairs.clear();
        let period = slots.period;
        if period == DVec3::INFINITY {
            return;
        }
        let reach = |slot: u32| {
            let slot = slot as usize;
            slots.position[slot].number() + slots.reference[slot].number()
        };
        self.gather(slots, period, reach);
        let Self { own, images, phases: [of_own, of_images], found } = self;
        let spheres = |places: &[Place]| -> Vec<(u32, DVec3, f64)> {
            let number = (0..).zip(places);
            number.map(|(number, it)| (number, it.center, reach(it.slot))).collect()
        };
        of_own.rebuild(spheres(own).into_iter(), 0.0);
        of_images.rebuild(spheres(images).into_iter(), 0.0);
        found.clear();
        of_own.for_each_pair_with(of_images, |own, image| found.push((own, image)));
        // Images come in the order of their offsets, so that two of one pair do, too.
        found.sort_unstable();
        for &(first, second) in &*found {
            let (first, second) = (own[first as usize], images[second as usize]);
            let sleep = [first.slot, second.slot].map(|slot| slots.sleeps[slot as usize]);
            if first.slot != second.slot && sleep != [true; 2] {
                pairs.push(ImagePair::of(first, second));
            }
        }
        pairs.sort_by_key(|pair| pair.slots);
    }

    /// Gathers the spheres near a face, and one of each two images that are opposite to each other.
    fn gather(&mut self, slots: &Slots, period: DVec3, reach: impl Fn(u32) -> f64) {
        let Self { own, images, .. } = self;
        own.clear();
        images.clear();
        let count = slots.len() as u32;
        let most = (0..count).map(&reach).fold(0.0, f64::max);
        let half = 0.5 * period;
        let forward: Vec<DVec3> = offsets(period)
            .filter(|offset| offset.iter().find(|it| **it != 0) == Some(&1))
            .map(|offset| image_shift(offset.map(i32::from), period))
            .collect();
        for slot in 0..count {
            let center = slots.position[slot as usize].vector();
            let reach = reach(slot) + most;
            if !(center.abs() + reach).cmpgt(half).any() {
                continue;
            }
            own.push(Place { slot, center, shift: DVec3::ZERO });
            for &shift in &forward {
                let image = center + shift;
                if (image.abs() - reach).cmple(half).all() {
                    images.push(Place { slot, center: image, shift });
                }
            }
        }
    }
}

impl ImagePair {
    /// The pair of a sphere and the image of another one.
    fn of(first: Place, second: Place) -> Self {
        if first.slot < second.slot {
            Self { slots: [first.slot, second.slot], shift: second.shift }
        } else {
            Self { slots: [second.slot, first.slot], shift: -second.shift }
        }
    }
}
