//! Batches of pairs, no sphere in two pairs of a batch: no pair reads what another one of its batch changes. So a
//! batch is solved in lanes, with the bits of one pair after the other.

use educe::Educe;
use glam::DVec3;

use super::materials::ContactMaterial;
use crate::lanes::LANES;
use crate::restitution::ContactRestitution;

/// One number of each pair of a batch.
pub(crate) type Quad = [f64; LANES];

/// Least number of batches between two with the same sphere: the next batch would wait for the results of the one
/// before.
const APART: u32 = 2;

/// Contacts of pairs of spheres, 1 and 2, by run of slots. Lanes without a pair hold a sphere twice,
/// with an effective mass of zero.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C, align(32))]
pub(crate) struct PairBatch {
    /// Slots of spheres 1, from the start of the run.
    pub first: [u32; LANES],
    /// Slots of spheres 2, from the start of the run.
    pub second: [u32; LANES],
    /// Unit normals from 1 to 2.
    pub normal: [Quad; 3],
    /// Normal impulses \[N s\].
    pub impulse: Quad,
    /// Minus the least normal velocity after the sub-step \[m/s\]: the gap may close, and a bounce separates.
    pub bias: Quad,
    /// m1 m2 / (m1 + m2) \[kg\]
    pub effective_mass: Quad,
}

/// The approach of the pairs of a batch, which no sweep reads. It is kept apart so that sweeps stream less memory.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C, align(32))]
pub(crate) struct ApproachBatch {
    /// The normal impulses of the sub-step before \[N s\].
    pub previous: Quad,
    /// Sum of the radii \[m\].
    pub radius_sum: Quad,
}

/// A batch in which an impact was found.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Hit {
    pub batch: u32,
    /// Speeds of approach \[m/s\]; 0 where there is no impact.
    pub speed: Quad,
}

/// Friction of the contacts of a batch.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C, align(32))]
pub(crate) struct FrictionBatch {
    /// Tangential impulses \[N s\].
    pub tangential: [Quad; 3],
    /// Slip after an impact \[m/s\].
    pub slip: [Quad; 3],
    /// 1 / ((1 + 1/k1)/m1 + (1 + 1/k2)/m2) \[kg\]
    pub tangential_mass: Quad,
    pub sliding: Quad,
    pub tangential_restitution: Quad,
}

/// Rolling and spinning friction of the contacts of a batch.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C, align(32))]
pub(crate) struct RollingBatch {
    /// Angular impulses on sphere 2; sphere 1 gets the opposite \[N m s\].
    pub angular: [Quad; 3],
    /// Coefficients of rolling friction, times the radius \[m\].
    pub rolling: Quad,
    /// Coefficients of spinning friction, times the radius \[m\].
    pub spinning: Quad,
    /// 1 / (1/I1 + 1/I2) \[kg m²\]
    pub inertia: Quad,
    /// 1 / r of spheres 1 and 2 \[1/m\].
    pub curvature: [Quad; 2],
}

/// Restitutions of the contacts of a batch that depend on the speed of approach; `None` for others.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct LawBatch(pub [Option<ContactRestitution>; LANES]);

impl LawBatch {
    /// Sets the coefficients that depend on the speed to those at these speeds of approach \[m/s\].
    pub fn set(&self, restitutions: &mut Quad, speeds: Quad) {
        for ((law, coefficient), speed) in self.0.iter().zip(restitutions).zip(speeds) {
            if let Some(law) = law {
                *coefficient = law.at(speed);
            }
        }
    }
}

/// Impulses that a contact keeps from search to search.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Impulses {
    /// \[N s\]
    pub normal: f64,
    /// Normal impulse of the sub-step before \[N s\].
    pub previous: f64,
    /// \[N s\]
    pub tangential: [f64; 3],
    /// \[N m s\]
    pub angular: [f64; 3],
}

impl Impulses {
    /// Whether one of the impulses is not zero.
    pub fn is_some(&self) -> bool {
        self.normal > 0.0
    }

    /// Returns the impulses on the other body.
    pub fn reversed(self) -> Self {
        let minus = |vector: [f64; 3]| vector.map(|part| -part);
        Self { tangential: minus(self.tangential), angular: minus(self.angular), ..self }
    }
}

/// A pair of spheres, in slots from the start of a run, with the constants of its contact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair {
    pub slots: [u32; 2],
    pub radii: [f64; 2],
    /// 1/m of both \[1/kg\].
    pub inverse_masses: [f64; 2],
    /// 1/(k m) of both \[1/kg\].
    pub inverse_inertias: [f64; 2],
    pub material: ContactMaterial,
    pub impulses: Impulses,
    /// Offset from sphere 2 to its image that sphere 1 touches \[m\].
    pub shift: DVec3,
    /// Velocity of that image relative to sphere 2, along x \[m/s\].
    pub slide: f64,
}

/// The pairs of a run of slots, in batches.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Batches {
    pub pairs: Vec<PairBatch>,
    /// Approaches of the pairs, one batch for each.
    pub approaches: Vec<ApproachBatch>,
    /// Coefficients of restitution, as many; where they depend on the speed, those of the present impacts.
    pub restitutions: Vec<Quad>,
    /// Restitutions that depend on the speed; as many, or none where there are none.
    pub laws: Vec<LawBatch>,
    /// The impacts of the sub-step, in order of their batches.
    pub hits: Vec<Hit>,
    /// Friction of the pairs, one batch for each, or none where there is no friction.
    pub frictions: Vec<FrictionBatch>,
    /// Rolling friction of the pairs, one batch for each, or none where there is none.
    pub rollings: Vec<RollingBatch>,
    /// Offsets from spheres 2 to their images that spheres 1 touch \[m\]; one per pair, or none where space is not
    /// periodic.
    pub shifts: Vec<[Quad; 3]>,
    /// Velocities of those images relative to spheres 2, along x \[m/s\]; one per pair, or none without shear.
    pub slides: Vec<Quad>,
    /// Pairs in each batch.
    counts: Vec<u8>,
    /// A batch with room, not before each one; the batch itself while it has room.
    with_room: Vec<u32>,
    /// For each slot, one more than the last batch with it; 0 for none.
    last: Vec<u32>,
}

impl Batches {
    /// Prepares for the pairs of a run with this number of slots.
    pub fn clear(&mut self, slots: usize) {
        self.pairs.clear();
        self.approaches.clear();
        self.restitutions.clear();
        self.laws.clear();
        self.hits.clear();
        self.frictions.clear();
        self.rollings.clear();
        self.shifts.clear();
        self.slides.clear();
        self.counts.clear();
        self.with_room.clear();
        self.last.clear();
        self.last.resize(slots, 0);
    }

    /// Adds a pair to the first batch that has room and is behind all others of its spheres, so that pairs with a
    /// common sphere keep their order.
    pub fn push(&mut self, pair: &Pair, kinds: ContactKinds) {
        let [first, second] = pair.slots;
        let last = self.last[first as usize].max(self.last[second as usize]);
        let batch = self.first_with_room(if last == 0 { 0 } else { last - 1 + APART });
        while self.pairs.len() <= batch as usize {
            self.push_batch(kinds);
        }
        let (number, lane) = (batch as usize, self.counts[batch as usize] as usize);
        self.counts[number] += 1;
        if lane + 1 == LANES {
            self.with_room[number] = batch + 1;
        }
        self.last[first as usize] = batch + 1;
        self.last[second as usize] = batch + 1;
        self.fill(number, lane, pair);
    }

    fn push_batch(&mut self, kinds: ContactKinds) {
        self.with_room.push(self.pairs.len() as u32);
        self.counts.push(0);
        self.pairs.push(PairBatch::EMPTY);
        self.approaches.push(ApproachBatch::default());
        self.restitutions.push([0.0; LANES]);
        if kinds.friction {
            self.frictions.push(FrictionBatch::default());
        }
        if kinds.rolling {
            self.rollings.push(RollingBatch::default());
        }
        if kinds.laws {
            self.laws.push(LawBatch::default());
        }
        if kinds.images {
            self.shifts.push([[0.0; LANES]; 3]);
        }
        if kinds.shear {
            self.slides.push([0.0; LANES]);
        }
    }

    /// The first batch with room from this one on, which may be one that does not exist yet.
    fn first_with_room(&mut self, from: u32) -> u32 {
        let next = |table: &[u32], batch: u32| table.get(batch as usize).copied().unwrap_or(batch);
        let mut found = from;
        while next(&self.with_room, found) != found {
            found = next(&self.with_room, found);
        }
        // Shortens the path for the batches on the way.
        let mut batch = from;
        while batch != found {
            let following = self.with_room[batch as usize];
            self.with_room[batch as usize] = found;
            batch = following;
        }
        found
    }

    fn fill(&mut self, number: usize, lane: usize, pair: &Pair) {
        let [first, second] = pair.slots;
        let batch = &mut self.pairs[number];
        if lane == 0 {
            (batch.first, batch.second) = ([first; LANES], [first; LANES]);
        }
        (batch.first[lane], batch.second[lane]) = (first, second);
        let inverse_mass = pair.inverse_masses[0] + pair.inverse_masses[1];
        batch.effective_mass[lane] = 1.0 / inverse_mass;
        batch.impulse[lane] = pair.impulses.normal;
        let approach = &mut self.approaches[number];
        approach.previous[lane] = pair.impulses.previous;
        approach.radius_sum[lane] = pair.radii[0] + pair.radii[1];
        self.restitutions[number][lane] = pair.material.restitution.at(0.0);
        if let Some(laws) = self.laws.get_mut(number) {
            laws.0[lane] = pair.material.restitution.by_speed();
        }
        if let Some(shifts) = self.shifts.get_mut(number) {
            set(shifts, lane, pair.shift.to_array());
        }
        if let Some(slides) = self.slides.get_mut(number) {
            slides[lane] = pair.slide;
        }
        let inverse_inertia = pair.inverse_inertias[0] + pair.inverse_inertias[1];
        if let Some(friction) = self.frictions.get_mut(number) {
            set(&mut friction.tangential, lane, pair.impulses.tangential);
            friction.tangential_mass[lane] = 1.0 / (inverse_mass + inverse_inertia);
            friction.sliding[lane] = pair.material.friction.sliding;
            friction.tangential_restitution[lane] = pair.material.friction.tangential_restitution;
        }
        if let Some(rolling) = self.rollings.get_mut(number) {
            let [r1, r2] = pair.radii;
            let radius = r1 * r2 / (r1 + r2);
            let [i1, i2] = pair.inverse_inertias;
            set(&mut rolling.angular, lane, pair.impulses.angular);
            rolling.rolling[lane] = pair.material.friction.rolling * radius;
            rolling.spinning[lane] = pair.material.friction.spinning * radius;
            rolling.inertia[lane] = 1.0 / (i1 / (r1 * r1) + i2 / (r2 * r2));
            (rolling.curvature[0][lane], rolling.curvature[1][lane]) = (1.0 / r1, 1.0 / r2);
        }
    }

    /// Every contact: its batch, its lane and its slots.
    pub fn contacts(&self) -> impl Iterator<Item = (usize, usize, [u32; 2])> {
        let lanes = |number: usize| 0..self.counts[number] as usize;
        (0..self.pairs.len()).flat_map(move |number| {
            let batch = &self.pairs[number];
            lanes(number).map(move |lane| (number, lane, [batch.first[lane], batch.second[lane]]))
        })
    }

    /// Restitution of a contact, at whatever speed.
    pub fn restitution(&self, number: usize, lane: usize) -> ContactRestitution {
        let law = self.laws.get(number).and_then(|laws| laws.0[lane]);
        law.unwrap_or(ContactRestitution::Constant(self.restitutions[number][lane]))
    }

    /// Offset from sphere 2 of a contact to its image that sphere 1 touches \[m\].
    pub fn shift(&self, number: usize, lane: usize) -> DVec3 {
        self.shifts.get(number).map_or(DVec3::ZERO, |it| DVec3::from_array(get(it, lane)))
    }

    /// Velocity of that image relative to sphere 2, along x \[m/s\].
    pub fn slide(&self, number: usize, lane: usize) -> f64 {
        self.slides.get(number).map_or(0.0, |it| it[lane])
    }

    /// Moves the images by their way in a time of `h` \[s\].
    pub fn slide_images(&mut self, h: f64) {
        for (shifts, slides) in self.shifts.iter_mut().zip(&self.slides) {
            shifts[0].iter_mut().zip(slides).for_each(|(shift, slide)| *shift += h * slide);
        }
    }

    /// The contacts with an impact that press, and their speeds of approach \[m/s\].
    pub fn impacts(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        self.hits.iter().flat_map(move |hit| {
            let number = hit.batch as usize;
            let bears = move |lane: &usize| self.pairs[number].impulse[*lane] > 0.0;
            let hits = (0..LANES).filter(|&lane| hit.speed[lane] > 0.0).filter(bears);
            hits.map(move |lane| (number, lane, hit.speed[lane]))
        })
    }

    /// Impulses that a contact keeps from search to search. An impact leaves none.
    pub fn impulses(&self, number: usize, lane: usize) -> Impulses {
        let batch = &self.pairs[number];
        let bounces = batch.bias[lane] < 0.0;
        Impulses {
            normal: if bounces { 0.0 } else { batch.impulse[lane] },
            previous: self.approaches[number].previous[lane],
            tangential: self.frictions.get(number).map_or([0.0; 3], |it| get(&it.tangential, lane)),
            angular: self.rollings.get(number).map_or([0.0; 3], |it| get(&it.angular, lane)),
        }
    }

    /// The impulse on sphere 2 \[N s\] of a bounce with this speed of approach \[m/s\], without the part with which
    /// others press the two together; `None` without a bounce.
    pub fn bounce(&self, number: usize, lane: usize, speed: f64) -> Option<DVec3> {
        let batch = &self.pairs[number];
        if batch.bias[lane] >= 0.0 {
            return None;
        }
        let own = batch.effective_mass[lane] * (1.0 + self.restitutions[number][lane]) * speed;
        Some(self.impulse(number, lane) * (own / batch.impulse[lane]).min(1.0))
    }

    /// Unit normal of a contact, from sphere 1 to sphere 2.
    pub fn normal(&self, number: usize, lane: usize) -> DVec3 {
        DVec3::from_array(get(&self.pairs[number].normal, lane))
    }

    /// The impulse on sphere 2, normal and tangential \[N s\].
    pub fn impulse(&self, number: usize, lane: usize) -> DVec3 {
        let normal = self.pairs[number].impulse[lane] * self.normal(number, lane);
        normal + self.tangential_impulse(number, lane)
    }

    /// The impulse of friction on sphere 2 \[N s\].
    pub fn tangential_impulse(&self, number: usize, lane: usize) -> DVec3 {
        let friction = self.frictions.get(number);
        friction.map_or(DVec3::ZERO, |it| DVec3::from_array(get(&it.tangential, lane)))
    }

    pub fn count(&self) -> usize {
        self.counts.iter().map(|&count| count as usize).sum()
    }
}

impl PairBatch {
    const EMPTY: Self = Self {
        first: [0; LANES],
        second: [0; LANES],
        normal: [[0.0; LANES]; 3],
        impulse: [0.0; LANES],
        bias: [0.0; LANES],
        effective_mass: [0.0; LANES],
    };
}

/// Kinds of contacts that occur in a world.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct ContactKinds {
    /// There is friction of any kind.
    pub friction: bool,
    /// There is rolling or spinning friction.
    pub rolling: bool,
    /// Some restitution depends on the speed.
    pub laws: bool,
    /// Space is periodic: spheres may touch images of others.
    pub images: bool,
    /// The periodic box is in steady shear: images slide.
    pub shear: bool,
}

/// A component of each vector of a batch.
pub(crate) fn get(vectors: &[Quad; 3], lane: usize) -> [f64; 3] {
    [vectors[0][lane], vectors[1][lane], vectors[2][lane]]
}

pub(crate) fn set(vectors: &mut [Quad; 3], lane: usize, vector: [f64; 3]) {
    (vectors[0][lane], vectors[1][lane], vectors[2][lane]) = (vector[0], vector[1], vector[2]);
}
