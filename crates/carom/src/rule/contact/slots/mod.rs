//! Slots: the spheres in the solver's order of memory.

pub(crate) mod drift;
mod forces;
pub(crate) mod order;
pub(crate) mod row;
pub(crate) mod slab_totals;

use educe::Educe;
use glam::DVec3;

use self::row::Row;
use crate::bodies::Motion;
use crate::id::SphereId;
use crate::rule::periodic;
use crate::settings::nearest_image;
use crate::shear::Shear;
use crate::system::System;

/// Spheres by slot: neighbours in space are neighbours in memory.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Slots {
    /// Id of the sphere in each slot.
    pub id: Vec<SphereId>,
    /// Index of each sphere in the world's arrays; [`GONE`] if it has left the world.
    pub index: Vec<u32>,
    /// Centre \[m\] and radius \[m\]. In a periodic box the centre is wrapped at searches only.
    pub position: Vec<Row>,
    /// Velocity \[m/s\] and 1/m \[1/kg\], 0 for one that sleeps: nothing moves it.
    pub velocity: Vec<Row>,
    /// Velocity at the start of the sub-step \[m/s\].
    pub before: Vec<Row>,
    /// Velocity of the surface by spin, r w \[m/s\], and 1/(k m) \[1/kg\] with the inertia k m r², 0 for one
    /// that sleeps. Empty without friction.
    pub spin: Vec<Row>,
    /// Spin at the start of the sub-step \[m/s\]. Empty without friction.
    pub spin_before: Vec<Row>,
    /// Sum of the spins of the sub-steps of a frame \[m/s\]. Empty without friction.
    pub turn: Vec<Row>,
    /// Centre at the last search for neighbours \[m\], and how far the sphere may go from there \[m\].
    pub reference: Vec<Row>,
    /// Whether each sphere sleeps.
    pub sleeps: Vec<bool>,
    /// How long each sphere has been calm, in units of sqrt(r / a).
    pub calm: Vec<f64>,
    /// Whether a contact that is no bounce had an impulse in the sub-step before.
    pub bears: Vec<bool>,
    /// Acceleration by forces \[m/s²\], and rate of linear drag \[1/s\].
    pub acceleration: Vec<Row>,
    /// The acceleration by forces that are linear \[m/s²\]; empty where there are no others.
    linear: Vec<Row>,
    /// Whether forces damp the motion of each sphere in less than the sub-step, by index: its acceleration is then that
    /// of an implicit step.
    #[cfg_attr(feature = "serde", serde(skip))]
    damped: Vec<bool>,
    /// Centres \[m\] and velocities \[m/s\], by index, in the middle of the sub-step, where forces that are not linear
    /// act.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub middle: [Vec<DVec3>; 2],
    /// Acceleration by nonconservative forces \[m/s²\], and the rate of their linear drag \[1/s\], in the present
    /// sub-step; empty without such forces.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub working: Vec<Row>,
    /// Part of the acceleration by forces applied to single spheres \[m/s²\].
    #[cfg_attr(feature = "serde", serde(skip))]
    pub applied: Vec<DVec3>,
    /// Edges of the periodic box \[m\], infinite along open axes.
    pub period: DVec3,
    /// Shear of the periodic box.
    pub shear: Option<Shear>,
    /// The present time, where images slide \[s\].
    pub time: f64,
    /// Largest factor of the contact distances of spheres, at least 1.
    pub factor: f64,
}

/// The index of a sphere that was taken out of the world.
pub(crate) const GONE: u32 = u32::MAX;

impl Slots {
    /// Half the largest contact distance of a sphere with others like it, and the path that it may go until the next
    /// search \[m\].
    #[inline(always)]
    pub fn reach_of(&self, slot: usize) -> f64 {
        self.factor * self.position[slot].number() + self.reference[slot].number()
    }

    /// Radii of the spheres in two slots \[m\], multiplied by the factor of their contact distance.
    #[inline]
    pub fn contact_radii(&self, slots: [usize; 2], system: &System) -> [f64; 2] {
        if system.material_pairs.non_additivity.is_none() {
            return slots.map(|slot| self.position[slot].number());
        }
        system.contact_radii(slots.map(|slot| self.index[slot]))
    }

    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Returns the number of spheres that sleep.
    pub fn asleep(&self) -> usize {
        self.sleeps.iter().filter(|sleeps| **sleeps).count()
    }

    /// Whether the same spheres are in the world, at the same indices.
    pub fn are_of(&self, ids: &[SphereId]) -> bool {
        self.len() == ids.len()
            && self
                .index
                .iter()
                .zip(&self.id)
                .all(|(&index, &id)| ids.get(index as usize) == Some(&id))
    }

    /// Updates the indices of the spheres that are still in the world.
    pub fn follow(&mut self, ids: &[SphereId]) {
        for (index, id) in self.index.iter_mut().zip(&self.id) {
            *index = ids.binary_search(id).map_or(GONE, |found| found as u32);
        }
    }

    /// Puts all spheres of the world into slots, in the order of their ids. Known ones keep the state that is not
    /// in the world.
    pub fn arrange(&mut self, ids: &[SphereId]) {
        let count = ids.len();
        let (mut sleeps, mut calm, mut bears) =
            (vec![false; count], vec![0.0; count], vec![true; count]);
        for (slot, &index) in self.index.iter().enumerate().filter(|(_, index)| **index != GONE) {
            let index = index as usize;
            (sleeps[index], calm[index]) = (self.sleeps[slot], self.calm[slot]);
            bears[index] = self.bears[slot];
        }
        (self.sleeps, self.calm, self.bears) = (sleeps, calm, bears);
        self.index = (0..count as u32).collect();
        self.id = ids.to_vec();
    }

    /// Copies places and motions of spheres from the world.
    pub fn read(&mut self, system: &System, motion: &Motion, with_spin: bool) {
        self.read_motion(system, motion);
        let Self { index, spin, turn, .. } = self;
        let spheres = system.spheres;
        let indices = || index.iter().map(|&index| index as usize);
        spin.clear();
        turn.clear();
        if with_spin {
            spin.extend(
                indices()
                    .map(|i| Row::new(spheres.radius[i] * motion.spin.angular_velocity[i], 0.0)),
            );
            turn.resize(index.len(), Row::default());
        }
        self.read_masses(system);
        self.before.clone_from(&self.velocity);
        self.spin_before.clone_from(&self.spin);
    }

    /// Copies places and velocities of spheres from the world. A sphere whose place is the wrapped form of its own keeps
    /// its own.
    fn read_motion(&mut self, system: &System, motion: &Motion) {
        let radii = &system.spheres.radius;
        let is_periodic = self.period != DVec3::INFINITY;
        self.position.resize(self.index.len(), Row::default());
        self.velocity.resize(self.index.len(), Row::default());
        for slot in 0..self.index.len() {
            let index = self.index[slot] as usize;
            let own = [self.position[slot], self.velocity[slot]].map(Row::vector);
            let shown = [motion.position[index], motion.velocity[index]];
            let wrapped = self.wrapped(own);
            let is_same = is_periodic && wrapped[0] == shown[0];
            let place = if is_same { own[0] } else { shown[0] };
            let velocity = match self.shear {
                Some(_) if is_same && wrapped == shown => own[1],
                Some(_) if is_same => shown[1] + self.velocity_beyond(place),
                _ => shown[1],
            };
            self.position[slot] = Row::new(place, radii[index]);
            self.velocity[slot] = Row::new(velocity, 0.0);
        }
    }

    /// The state of a sphere, its place \[m\] and velocity \[m/s\], wrapped into the periodic box.
    fn wrapped(&self, [place, velocity]: [DVec3; 2]) -> [DVec3; 2] {
        match self.shear {
            Some(shear) => shear.wrapped([place, velocity], self.time),
            None => [periodic::wrapped(place, self.period), velocity],
        }
    }

    /// The velocity of a sphere at a place beyond that of its image in the box \[m/s\].
    fn velocity_beyond(&self, place: DVec3) -> DVec3 {
        match self.shear {
            Some(shear) => -shear.wrapped([place, DVec3::ZERO], self.time)[1],
            None => DVec3::ZERO,
        }
    }

    /// The velocity of a sphere relative to the flow of a box in steady shear \[m/s\].
    pub fn beside_flow(&self, slot: usize) -> DVec3 {
        let velocity = self.velocity[slot].vector();
        match self.shear {
            Some(shear) => velocity - shear.velocity_at(self.position[slot].vector()),
            None => velocity,
        }
    }

    /// Wraps all spheres into the periodic box.
    pub fn wrap(&mut self) {
        if self.period == DVec3::INFINITY {
            return;
        }
        for slot in 0..self.position.len() {
            let place = self.position[slot].vector();
            let change = self.velocity_beyond(place);
            if change != DVec3::ZERO {
                for row in [&mut self.velocity[slot], &mut self.before[slot]] {
                    *row = row.with_vector(row.vector() - change);
                }
            }
            let [place, _] = self.wrapped([place, DVec3::ZERO]);
            self.position[slot] = self.position[slot].with_vector(place);
        }
    }

    /// Place of a sphere, by its slot, wrapped into the periodic box \[m\].
    pub fn place(&self, slot: usize) -> DVec3 {
        self.wrapped_place(self.position[slot].vector())
    }

    /// A place wrapped into the periodic box \[m\].
    pub fn wrapped_place(&self, place: DVec3) -> DVec3 {
        self.wrapped([place, DVec3::ZERO])[0]
    }

    /// The image of a sphere that is nearest to a place \[m\].
    pub fn image_near(&self, slot: usize, place: DVec3) -> DVec3 {
        let own = self.position[slot].vector();
        match self.shear {
            Some(shear) => place + shear.nearest(own - place, self.time)[0],
            None => periodic::image_near(own, place, self.period),
        }
    }

    /// Offset from one sphere to another, in a periodic box to its nearest image \[m\].
    pub fn offset(&self, [from, to]: [usize; 2]) -> DVec3 {
        let way = self.position[to].vector() - self.position[from].vector();
        match self.shear {
            Some(shear) => shear.nearest(way, self.time)[0],
            None => nearest_image(way, self.period),
        }
    }

    /// Copies masses and moments of inertia from the world; sleeping spheres are immovable.
    pub fn read_masses(&mut self, system: &System) {
        let spheres = system.spheres;
        for (slot, &index) in self.index.iter().enumerate() {
            let index = index as usize;
            let mass = if self.sleeps[slot] { f64::INFINITY } else { spheres.mass[index] };
            self.velocity[slot] = Row::new(self.velocity[slot].vector(), 1.0 / mass);
            if let Some(spin) = self.spin.get_mut(slot) {
                *spin = Row::new(spin.vector(), 1.0 / (spheres.inertia_factor(index) * mass));
            }
        }
    }

    /// Moves to each slot the sphere of the slot at the same place in `from`.
    pub fn permute(&mut self, from: &[u32], spare: &mut Vec<Row>) {
        for rows in [
            &mut self.position,
            &mut self.velocity,
            &mut self.before,
            &mut self.spin,
            &mut self.spin_before,
            &mut self.turn,
            &mut self.acceleration,
            &mut self.linear,
        ] {
            if !rows.is_empty() {
                spare.clear();
                spare.extend(from.iter().map(|&slot| rows[slot as usize]));
                std::mem::swap(rows, spare);
            }
        }
        permute(&mut self.id, from);
        permute(&mut self.index, from);
        permute(&mut self.bears, from);
        permute(&mut self.calm, from);
        permute(&mut self.sleeps, from);
    }

    /// Returns by how much the mean velocity of a free sphere in the sub-step differs from its last
    /// one \[m/s\], where forces are not linear; others change too little in a sub-step for that to
    /// matter.
    pub fn speed_beside_last(&self, slot: usize) -> f64 {
        if self.linear.is_empty() {
            return 0.0;
        }
        0.5 * (self.velocity[slot].vector() - self.before[slot].vector()).length()
    }

    /// Centres \[m\], by index.
    pub fn positions(&self) -> Vec<DVec3> {
        let mut positions = vec![DVec3::ZERO; self.index.len()];
        for (&index, position) in self.index.iter().zip(&self.position) {
            positions[index as usize] = position.vector();
        }
        positions
    }

    /// Writes positions and velocities at the end of a frame into the world.
    pub fn write(&self, motion: &mut Motion) {
        for (slot, &index) in self.index.iter().enumerate() {
            let own = [self.position[slot], self.velocity[slot]].map(Row::vector);
            let [place, velocity] = self.wrapped(own);
            motion.position[index as usize] = place;
            motion.velocity[index as usize] = velocity;
        }
        for (slot, spin) in self.spin.iter().enumerate() {
            let radius = self.position[slot].number();
            motion.spin.angular_velocity[self.index[slot] as usize] = spin.vector() / radius;
        }
    }
}

/// The slots of a run of spheres, which nothing else reads or writes meanwhile.
pub(crate) struct Run<'a> {
    pub position: &'a mut [Row],
    pub velocity: &'a mut [Row],
    pub before: &'a mut [Row],
    pub spin: &'a mut [Row],
    pub spin_before: &'a mut [Row],
    pub turn: &'a mut [Row],
    pub acceleration: &'a [Row],
    /// Empty without nonconservative forces.
    pub working: &'a [Row],
    pub reference: &'a [Row],
    pub bears: &'a mut [bool],
    pub sleeps: &'a [bool],
}

impl Slots {
    /// Returns the run of all slots.
    pub fn all(&mut self) -> Run<'_> {
        Run {
            position: &mut self.position,
            velocity: &mut self.velocity,
            before: &mut self.before,
            spin: &mut self.spin,
            spin_before: &mut self.spin_before,
            turn: &mut self.turn,
            acceleration: &self.acceleration,
            working: &self.working,
            reference: &self.reference,
            bears: &mut self.bears,
            sleeps: &self.sleeps,
        }
    }

    /// The run of this number of slots from the first one on.
    pub fn first(&mut self, count: usize) -> Run<'_> {
        self.all().take_front(count)
    }

    /// Runs that end at these slots, ascending.
    pub fn runs(&mut self, ends: impl Iterator<Item = usize>) -> Vec<Run<'_>> {
        let mut rest = self.all();
        let mut start = 0;
        ends.map(|end| {
            let count = end - start;
            start = end;
            rest.take_front(count)
        })
        .collect()
    }
}

impl Slots {
    /// The velocity of a sphere that is awake at the end of a sub-step of `h` \[s\], without contacts \[m/s\].
    pub fn accelerated(&self, slot: usize, h: f64) -> DVec3 {
        accelerated(self.before[slot], self.acceleration[slot], h)
    }
}

impl Run<'_> {
    /// Acceleration of a sphere by conservative forces \[m/s²\].
    pub fn conservative_acceleration(&self, slot: usize) -> DVec3 {
        let working = self.working.get(slot).map_or(DVec3::ZERO, |row| row.vector());
        self.acceleration[slot].vector() - working
    }

    /// Work against the conservative forces on a sphere that is moved by a way \[m\] \[J\].
    pub fn work_of_move(&self, slot: usize, way: DVec3) -> f64 {
        -self.conservative_acceleration(slot).dot(way) / self.velocity[slot].number()
    }

    /// The velocity of a sphere at the end of a sub-step of `h` \[s\], without contacts \[m/s\].
    pub fn accelerated(&self, slot: usize, h: f64) -> DVec3 {
        if self.sleeps[slot] {
            return self.before[slot].vector();
        }
        accelerated(self.before[slot], self.acceleration[slot], h)
    }
}

impl<'a> Run<'a> {
    /// Splits a run of this number of slots off the front.
    fn take_front(&mut self, count: usize) -> Self {
        Run {
            position: front_mut(&mut self.position, count),
            velocity: front_mut(&mut self.velocity, count),
            before: front_mut(&mut self.before, count),
            spin: front_mut(&mut self.spin, count),
            spin_before: front_mut(&mut self.spin_before, count),
            turn: front_mut(&mut self.turn, count),
            acceleration: front(&mut self.acceleration, count),
            working: front(&mut self.working, count),
            reference: front(&mut self.reference, count),
            bears: front_mut(&mut self.bears, count),
            sleeps: front(&mut self.sleeps, count),
        }
    }
}

/// Splits this number of items off the front; an unused array stays empty.
fn front_mut<'a, T>(rest: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let count = count.min(rest.len());
    let (front, behind) = std::mem::take(rest).split_at_mut(count);
    *rest = behind;
    front
}

fn front<'a, T>(rest: &mut &'a [T], count: usize) -> &'a [T] {
    let (front, behind) = rest.split_at(count.min(rest.len()));
    *rest = behind;
    front
}

fn permute<T: Copy>(items: &mut Vec<T>, from: &[u32]) {
    *items = from.iter().map(|&slot| items[slot as usize]).collect();
}

/// `(v + h a) / (1 + h c)` \[m/s\], with the rate c of drag, which never reverses a velocity.
pub(crate) fn accelerated(before: Row, acceleration: Row, h: f64) -> DVec3 {
    let gained = before.vector() + h * acceleration.vector();
    let drag = h * acceleration.number();
    if drag > 0.0 { gained / (1.0 + drag) } else { gained }
}
