//! Stepped zones: spheres that are moved by the sub-steps of the rule `contact`, from tick to tick of the
//! world's clock.

use educe::Educe;
use glam::DVec3;

use super::changes::{Changes, changes_until_tick};
use super::waiting::Waiting;
use crate::bodies::{Motion, Properties, Spin};
use crate::forces;
use crate::id::SphereId;
use crate::interval::Interval;
use crate::norm::Norm;
use crate::parallel;
use crate::persistent_contact::PersistentContact;
use crate::report::{EnergyAccount, StepReport};
use crate::rule::contact::{self, Proximity, Scratch, Solver};
use crate::rule::exact::flights::{Flights, Rotation};
use crate::rule::exact::ticks::{first_tick_after, halvings, halvings_for_springs, part};
use crate::rule::periodic;
use crate::settings::Contact;
use crate::surface::Surface;
use crate::system::System;

/// Neighbour lists of zones are made to last some frames, each of this many ticks.
const TICKS_PER_FRAME: u32 = 8;

/// A sphere leaves its zone after this many ticks without a pressing contact, whatever is near.
const FREE_TICKS: u32 = 4 * TICKS_PER_FRAME;

/// Ticks last at most this part of `sqrt(r / a)`, the time in which a sphere with the radius r falls through half
/// of it.
const SHORT: f64 = 0.03;
/// Largest number of halvings of a tick.
const MOST_TICK_HALVINGS: u32 = 6;

/// The spheres of all zones of a world. Between ticks they fly straight.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Zone {
    /// Places of the spheres in the arrays of the world, ascending.
    pub index: Vec<u32>,
    properties: Properties,
    /// The states of the spheres at the next tick.
    motion: Motion,
    /// Velocities of the spheres at the last tick \[m/s\].
    velocity_before: Vec<DVec3>,
    /// Forces that have a potential, as they act on each sphere from the last tick to the next one \[N\].
    conservative_forces: Vec<DVec3>,
    /// Ticks since each sphere last had a pressing contact.
    free_ticks: Vec<u32>,
    /// Spheres that joined since the last tick.
    waiting: Vec<Waiting>,
    solver: Solver,
    #[cfg_attr(feature = "serde", serde(skip))]
    scratch: Scratch,
    /// The last tick, and the next one, on the world's clock \[s\]; the next one is infinite while all
    /// sleep.
    ticks: [f64; 2],
    /// Changes of energy in the sub-step from the last tick to the next one.
    changes: Changes,
    /// Number of halvings of a tick that small spheres need.
    halvings: u32,
    /// Held forces between spheres \[N\], by index in the arrays of the world; empty where there are none.
    pub held_forces: Vec<DVec3>,
    /// Slots of spheres outside zones with a neighbour inside; some may appear more than once or be out of date.
    pub near: Vec<u32>,
}

/// The motion of a sphere in a zone between two ticks.
#[derive(Debug, Clone)]
pub(crate) struct Stepped {
    pub index: u32,
    /// Centre at the last tick and at the next one \[m\].
    pub positions: [DVec3; 2],
    /// Where friction acts.
    pub rotation: Option<Rotation>,
}

impl Zone {
    /// Returns the number of spheres.
    pub fn len(&self) -> usize {
        self.index.len() + self.waiting.len()
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the solver that steps the spheres.
    pub fn solver(&self) -> &Solver {
        &self.solver
    }

    /// Returns the number of spheres that sleep.
    pub fn asleep(&self) -> u32 {
        if self.is_empty() { 0 } else { self.solver.asleep() }
    }

    /// The next tick, on the world's clock \[s\]; infinite without spheres.
    pub fn next_tick(&self) -> f64 {
        if self.is_empty() { f64::INFINITY } else { self.ticks[1] }
    }

    /// Sets and returns the next tick \[s\] for a sphere that is about to join at a time \[s\], by its index in the
    /// world's arrays. Ticks are `tick` \[s\] apart, or parts of that where spheres are small or springs, which move at
    /// `spring_rate` \[1/s\], are stiff.
    pub fn expect(
        &mut self,
        system: &System,
        index: u32,
        time: f64,
        [tick, spring_rate]: [f64; 2],
    ) -> f64 {
        let index = index as usize;
        if self.is_empty() {
            self.halvings = halvings_for_all(system, [tick, spring_rate]);
        }
        self.halvings = self.halvings.max(halvings_for(system, index, tick));
        if self.is_empty() || self.ticks[1] == f64::INFINITY {
            self.ticks = [time, first_tick_after(time, self.part_of(tick))];
        }
        self.ticks[1]
    }

    /// Sets the ticks after the next one to be `tick` \[s\] apart, or parts of that as in
    /// [`Self::expect`].
    pub fn follow_tick(&mut self, system: &System, [tick, spring_rate]: [f64; 2]) {
        let of_sphere = |index: u32| halvings_for(system, index as usize, tick);
        let of_spheres = self.indices(&system.spheres.id).into_iter().map(of_sphere);
        let of_all = halvings_for_all(system, [tick, spring_rate]);
        self.halvings = of_spheres.fold(of_all, u32::max);
    }

    /// Adds a sphere for which [`Self::expect`] was called. Its velocity changes steadily from that at `since`,
    /// when it joined \[s\], to that at the next tick \[m/s\], under a `force` that has a potential \[N\]; with the changes
    /// of energy until then.
    pub fn join(
        &mut self,
        sphere: SphereId,
        velocities: [DVec3; 2],
        force: DVec3,
        (since, changes): (f64, Changes),
    ) {
        self.waiting.push(Waiting { sphere, since, velocities, force, changes });
    }

    /// The force that has a potential, as it acts until the next tick on a sphere with this index and id \[N\].
    pub fn force_on(&self, index: u32, sphere: SphereId) -> DVec3 {
        let place = || self.index.binary_search(&index).ok();
        let known = || self.conservative_forces.get(place()?).copied();
        let waiting = self.waiting.iter().find(|it| it.sphere == sphere).map(|it| it.force);
        waiting.or_else(known).unwrap_or(DVec3::ZERO)
    }

    /// The time between its ticks \[s\].
    fn part_of(&self, tick: f64) -> f64 {
        part(tick, self.halvings)
    }

    /// Reports the changes of energy up to `time` \[s\], at most up to the next tick.
    pub fn report_energy(&mut self, time: f64, account: &mut EnergyAccount) {
        let [last, next] = self.ticks;
        let part = if time < next { (time - last) / (next - last) } else { 1.0 };
        self.changes.report(part, account);
        for waiting in &mut self.waiting {
            waiting.changes.report(waiting.part(time, next), account);
        }
    }

    /// Restarts all spheres that are still there at the first tick after a time \[s\], with these
    /// velocities, by index \[m/s\]; ticks are as in [`Self::expect`].
    pub fn restart(
        &mut self,
        system: &System,
        (flights, motion): (&Flights, &Motion),
        time: f64,
        tick: [f64; 2],
    ) {
        let all = self.indices(&system.spheres.id);
        self.waiting.clear();
        self.index.clear();
        self.properties = Properties::default();
        (self.motion, self.velocity_before, self.free_ticks) = Default::default();
        // The rest of the sub-step is dropped.
        self.changes = Changes::default();
        self.conservative_forces.clear();
        self.near.clear();
        // The held forces may be outdated, and their indices may belong to other spheres now.
        self.held_forces.clear();
        self.solver.set_changed();
        for index in all {
            let next = self.expect(system, index, time, tick);
            let (slot, place) = (flights.slot_of[index as usize], index as usize);
            let (position, velocity) = (motion.position[place], motion.velocity[place]);
            let (changes, force) = match flights.free_species_of(slot).is_curved {
                // What acts along a curve is not known yet.
                true => Default::default(),
                false => {
                    let motion = ([position, velocity], [velocity; 2]);
                    changes_until_tick(system, flights, slot, motion, [time, next])
                }
            };
            self.join(system.spheres.id[place], [velocity; 2], force, (time, changes));
        }
    }

    /// Updates the indices of spheres to arrays of the world with these ids; drops removed spheres.
    pub fn follow(&mut self, ids: &[SphereId]) {
        self.held_forces.clear();
        let is_there = |id: &SphereId| ids.binary_search(id).is_ok();
        self.waiting.retain(|it| is_there(&it.sphere));
        let stays: Vec<bool> = self.properties.id.iter().map(is_there).collect();
        self.keep(&stays);
        self.index = self
            .properties
            .id
            .iter()
            .flat_map(|id| ids.binary_search(id))
            .map(|it| it as u32)
            .collect();
    }

    /// Keeps the spheres whose flag is set.
    fn keep(&mut self, stays: &[bool]) {
        if stays.iter().all(|&stays| stays) {
            return;
        }
        let kept: Vec<u32> = (0..stays.len() as u32).filter(|&it| stays[it as usize]).collect();
        self.index = kept.iter().filter_map(|&it| self.index.get(it as usize).copied()).collect();
        self.properties = self.properties.of_some(&kept);
        self.motion = self.motion.of_some(&kept);
        let velocity = |&place: &u32| self.velocity_before[place as usize];
        self.velocity_before = kept.iter().map(velocity).collect();
        let force = |&place: &u32| self.conservative_forces.get(place as usize).copied();
        self.conservative_forces = kept.iter().filter_map(force).collect();
        self.free_ticks = kept.iter().map(|&place| self.free_ticks[place as usize]).collect();
    }

    /// Removes, at a tick, the spheres that are near no other one or have flown freely for some time, before
    /// waiting spheres are added. Spheres that press and would have to come back stay; `would_rejoin` decides by
    /// index and centre \[m\]. Returns the indices, centres \[m\] and velocities \[m/s\] of the removed.
    pub fn take_out_free(
        &mut self,
        would_rejoin: impl Fn(u32, DVec3) -> bool,
    ) -> Vec<(u32, [DVec3; 2])> {
        let known = contact::proximity(&self.solver);
        let proximity = |id: &SphereId| {
            let found = known.binary_search_by_key(id, |sphere| sphere.0);
            found.map_or(Proximity::Near, |place| known[place].1)
        };
        let stays = |(place, id): (usize, &SphereId)| {
            let ticks = self.free_ticks[place];
            let is_bound =
                || ticks == 0 && would_rejoin(self.index[place], self.motion.position[place]);
            match proximity(id) {
                Proximity::Apart => is_bound(),
                Proximity::Near => ticks < FREE_TICKS,
                Proximity::Overlaps => true,
            }
        };
        let stays: Vec<bool> = self.properties.id.iter().enumerate().map(stays).collect();
        let state = |place: usize| [self.motion.position[place], self.motion.velocity[place]];
        let free = (0..stays.len()).filter(|&place| !stays[place]);
        let out = free.map(|place| (self.index[place], state(place))).collect();
        self.keep(&stays);
        out
    }

    /// Whether all spheres sleep, so that nothing happens at the next tick.
    pub fn is_idle(&self) -> bool {
        self.waiting.is_empty() && self.solver.is_idle()
    }

    /// Stops the ticks while every sphere sleeps. Returns where the spheres are.
    pub fn rest(&mut self) -> Vec<Stepped> {
        self.ticks = [self.ticks[1], f64::INFINITY];
        self.velocity_before.clone_from(&self.motion.velocity);
        let spin = &self.motion.spin;
        let stepped = |place: usize| Stepped {
            index: self.index[place],
            positions: [self.motion.position[place]; 2],
            rotation: rotation_between([spin; 2], place, self.ticks),
        };
        (0..self.index.len()).map(stepped).collect()
    }

    /// Velocities of all spheres at a time between two ticks \[s\], by index and by id.
    pub fn velocities(&self, time: f64) -> impl Iterator<Item = (u32, DVec3)> {
        let [last, next] = self.ticks;
        let part = ((time - last) / (next - last)).clamp(0.0, 1.0);
        let both = self.velocity_before.iter().zip(&self.motion.velocity);
        self.index
            .iter()
            .zip(both)
            .map(move |(&index, (&before, &after))| (index, before + part * (after - before)))
    }

    /// The indices of all spheres, waiting ones included, in arrays of the world with these ids.
    pub fn indices(&self, ids: &[SphereId]) -> Vec<u32> {
        let waiting = self.waiting.iter().map(|it| &it.sphere);
        let all = self.properties.id.iter().chain(waiting);
        all.flat_map(|id| ids.binary_search(id)).map(|index| index as u32).collect()
    }

    /// The spheres that joined since the last tick, with their velocities at a time since then \[s\].
    pub fn waiting(&self, time: f64) -> impl Iterator<Item = (SphereId, DVec3)> {
        let next = self.ticks[1];
        self.waiting.iter().map(move |waiting| {
            let Waiting { sphere, velocities: [before, after], .. } = *waiting;
            (sphere, before + waiting.part(time, next) * (after - before))
        })
    }

    /// The contacts that pressed in the last sub-step.
    pub fn persistent_contacts(&self, system: &System) -> Vec<PersistentContact> {
        let system = System { spheres: &self.properties, interactions: None, ..*system };
        contact::persistent_contacts(&self.solver, &system)
    }

    /// Whether spheres may leave at the next tick: once per frame, for ticks `tick` \[s\] apart.
    pub fn is_due_to_leave(&self, tick: f64) -> bool {
        // A multiple may round to less.
        let number = |time: f64| ((time / tick + 0.25) as u64) / u64::from(TICKS_PER_FRAME);
        number(self.ticks[1]) != number(self.ticks[0])
    }

    /// Moves waiting spheres into the arrays; `flights` has their states and rotations at `now` \[s\].
    pub fn admit(&mut self, system: &System, flights: &Flights, now: f64) {
        if self.waiting.is_empty() {
            return;
        }
        let ids = &system.spheres.id;
        // By index, with the place of known spheres.
        let known = (0u32..).zip(&self.index).map(|(place, &index)| (index, Err(place)));
        let come = self.waiting.drain(..).filter_map(|it| {
            Some((ids.binary_search(&it.sphere).ok()? as u32, Ok(it.velocities[1])))
        });
        let mut all: Vec<(u32, Result<DVec3, u32>)> = known.chain(come).collect();
        all.sort_unstable_by_key(|sphere| sphere.0);
        let mut motion = Motion::default();
        let mut free_ticks = Vec::with_capacity(all.len());
        for &(index, velocity) in &all {
            let slot = flights.slot_of[index as usize];
            let (position, velocity, ticks) = match velocity {
                Ok(velocity) => (flights.state_of(slot, now).0, velocity, 0),
                Err(place) => {
                    let place = place as usize;
                    let Motion { position, velocity, .. } = &self.motion;
                    (position[place], velocity[place], self.free_ticks[place])
                }
            };
            motion.position.push(position);
            motion.velocity.push(velocity);
            free_ticks.push(ticks);
            if let Some(rotation) = flights.rotations.get(index as usize) {
                motion.spin.orientation.push(rotation.orientation_at(now));
                motion.spin.angular_velocity.push(rotation.angular_velocity_at(now));
            }
        }
        self.index = all.iter().map(|sphere| sphere.0).collect();
        (self.motion, self.free_ticks) = (motion, free_ticks);
        self.properties = system.spheres.of_some(&self.index);
    }

    /// Steps all spheres from this tick to the next one. `offset` \[s\] is the time of this tick from when
    /// surfaces are where the system says. Returns where they were and are to be.
    pub fn step(
        &mut self,
        system: &System,
        offset: f64,
        tick: f64,
        report: &mut StepReport,
    ) -> Vec<Stepped> {
        let now = self.ticks[1];
        let others = std::mem::take(&mut report.energy_account);
        let next = first_tick_after(now, self.part_of(tick));
        self.apply_forces(system);
        let before = self.motion.clone();
        self.velocity_before.clone_from(&self.motion.velocity);
        let system = System {
            spheres: &self.properties,
            moved_for: system.has_moving_surfaces().then_some(offset),
            // Forces between spheres are held.
            interactions: None,
            ..*system
        };
        let frames = f64::from(TICKS_PER_FRAME);
        let frame = Interval { time: now, h: frames * (next - now) };
        let parameters = Contact::default().with_sub_steps(TICKS_PER_FRAME);
        let (motion, memory) = (&mut self.motion, (&mut self.solver, &mut self.scratch));
        parallel::among_threads(self.index.len(), || {
            contact::tick(&system, parameters, motion, frame, memory, report);
        });
        self.ticks = [now, next];
        self.changes = Changes {
            account: std::mem::replace(&mut report.energy_account, others),
            energy_of_changes: energy_of_changes(&self.properties, [&before, &self.motion]),
            reported: 0.0,
        };
        self.conservative_forces = contact::conservative_forces(&self.solver);
        for (place, bears) in contact::bearing(&self.solver) {
            let ticks = &mut self.free_ticks[place as usize];
            *ticks = if bears { 0 } else { *ticks + 1 };
        }
        let period = system.settings.boundary.period();
        let stepped = |place: usize| {
            let [from, to] = [before.position[place], self.motion.position[place]];
            Stepped {
                index: self.index[place],
                positions: [from, periodic::image_near(to, from, period)],
                rotation: rotation_between([&before.spin, &self.motion.spin], place, self.ticks),
            }
        };
        (0..self.index.len()).map(stepped).collect()
    }

    /// Adds the forces applied to single spheres, and the held forces between spheres.
    fn apply_forces(&mut self, system: &System) {
        let applied = &system.spheres.applied_force;
        self.solver.held_forces.clear();
        if applied.is_empty() && self.held_forces.is_empty() {
            self.properties.applied_force.clear();
            return;
        }
        let of = |forces: &[DVec3], index: u32| forces.get(index as usize).copied();
        let held = self.index.iter().filter_map(|&index| of(&self.held_forces, index));
        self.solver.held_forces.extend(held);
        let force = |&index: &u32| {
            let held = of(&self.held_forces, index);
            of(applied, index).map_or(held, |own| Some(held.map_or(own, |held| own + held)))
        };
        self.properties.applied_force = self.index.iter().filter_map(force).collect();
    }
}

/// The kinetic energy \[J\] of the changes of velocity from one state of motion to another.
fn energy_of_changes(properties: &Properties, [before, after]: [&Motion; 2]) -> f64 {
    let energy = |place: usize| {
        let mass = properties.mass[place];
        let change = after.velocity[place] - before.velocity[place];
        let spins = [before, after].map(|motion| motion.spin.angular_velocity.get(place));
        let turned = spins[0].zip(spins[1]).map_or(DVec3::ZERO, |(first, last)| last - first);
        let radius = properties.radius[place];
        let inertia = properties.inertia_factor(place) * radius * radius;
        0.5 * mass * (change.length_squared() + inertia * turned.length_squared())
    };
    (0..properties.mass.len()).map(energy).sum()
}

/// The rotation of a sphere between two ticks \[s\], from its angular velocities at both.
fn rotation_between(
    [before, after]: [&Spin; 2],
    place: usize,
    [now, next]: [f64; 2],
) -> Option<Rotation> {
    let orientation = *before.orientation.get(place)?;
    let velocities = [before, after].map(|spin| spin.angular_velocity[place]);
    Some(Rotation::between(orientation, velocities, [now, next]))
}

/// Number of halvings of a tick \[s\] for springs, with a rate of motion \[1/s\], and for turning surfaces.
fn halvings_for_all(system: &System, [tick, spring_rate]: [f64; 2]) -> u32 {
    let for_springs = halvings_for_springs(spring_rate, tick);
    if system.has_moving_surfaces() {
        for_springs.max(halvings_for_turning(system.surfaces, tick))
    } else {
        for_springs
    }
}

/// Number of halvings of a tick \[s\] for turning surfaces.
fn halvings_for_turning(surfaces: &[Surface], tick: f64) -> u32 {
    let rates = surfaces.iter().map(|it| contact::turning_rate(&it.form, &it.motion));
    let rate = rates.fold(0.0, f64::max);
    halvings(tick, MOST_TICK_HALVINGS, |it| rate * it <= contact::TURN)
}

/// Number of halvings of a tick \[s\] for a sphere: until the tick is short beside the time in which the sphere
/// falls through its own size.
fn halvings_for(system: &System, index: usize, tick: f64) -> u32 {
    let (radius, mass) = (system.spheres.radius[index], system.spheres.mass[index]);
    let (linear, _) = forces::total_linear(system.forces, radius, mass);
    let own = system.spheres.applied_acceleration(index).unwrap_or(DVec3::ZERO);
    let wanted = SHORT * (radius / (linear.acceleration + own).norm()).sqrt();
    halvings(tick, MOST_TICK_HALVINGS, |it| it <= wanted)
}
