//! Pairs of spheres that may touch across the faces of a periodic box: one of them is an image.

use glam::DVec3;

use crate::detect::broad_phase::BroadPhase;
use crate::rule::contact::places::offsets;
use crate::rule::contact::slots::Slots;
use crate::rule::periodic::image_shift;

/// An image of a sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Image {
    /// Offset from the sphere \[m\].
    pub shift: DVec3,
    /// Velocity relative to the sphere, along x \[m/s\].
    pub slide: f64,
}

impl Image {
    /// The sphere itself.
    pub const OWN: Self = Self { shift: DVec3::ZERO, slide: 0.0 };

    /// One of each two images that are opposite to each other and may be near the box.
    fn forward(slots: &Slots) -> Vec<Self> {
        let period = slots.period;
        // The box above is up to half an edge beside this one.
        let beside = if slots.shear.is_some() { 2 } else { 1 };
        let is_forward = |offset: &[i8; 3]| offset.iter().find(|it| **it != 0) > Some(&0);
        let image = |offset: [i8; 3]| match slots.shear {
            Some(shear) => {
                let [shift, velocity] = shear.image(offset.map(i32::from), slots.time);
                Self { shift, slide: velocity.x }
            }
            None => Self { shift: image_shift(offset.map(i32::from), period), slide: 0.0 },
        };
        offsets(period, beside).filter(is_forward).map(image).collect()
    }

    /// The image of the first of two spheres as seen from the image of the second.
    fn reversed(self) -> Self {
        Self { shift: -self.shift, slide: -self.slide }
    }
}

/// A pair of slots, the smaller one first, with the image of the second sphere that the first may touch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct ImagePair {
    pub slots: [u32; 2],
    pub image: Image,
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
    image: Image,
}

impl ImageSearch {
    /// Finds the pairs one of which is awake, in order of their slots. All spheres are in the box.
    pub fn find(&mut self, slots: &Slots, pairs: &mut Vec<ImagePair>) {
        pairs.clear();
        let period = slots.period;
        if period == DVec3::INFINITY {
            return;
        }
        let reach = |slot: u32| slots.reach_of(slot as usize);
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
        let forward = Image::forward(slots);
        for slot in 0..count {
            let center = slots.position[slot as usize].vector();
            let reach = reach(slot) + most;
            if !(center.abs() + reach).cmpgt(half).any() {
                continue;
            }
            own.push(Place { slot, center, image: Image::OWN });
            for &image in &forward {
                let center = center + image.shift;
                if (center.abs() - reach).cmple(half).all() {
                    images.push(Place { slot, center, image });
                }
            }
        }
    }
}

impl ImagePair {
    /// The pair of a sphere and the image of another one.
    fn of(first: Place, second: Place) -> Self {
        if first.slot < second.slot {
            Self { slots: [first.slot, second.slot], image: second.image }
        } else {
            Self { slots: [second.slot, first.slot], image: second.image.reversed() }
        }
    }
}
