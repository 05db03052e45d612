//! The report of a step.

use std::ops::AddAssign;

use glam::{DMat3, DVec3};

use crate::detect::contact::{Bodies, Contact};
use crate::force_work::ForceWork;
use crate::id::{ColliderId, SphereId};
use crate::settings::ImpactLaw;
use crate::system::System;
use crate::well_event::WellEvent;

/// Report of one step: impacts, triggers, emitted spheres, accounts.
///
/// ```
/// use carom::{BodyPair, DVec3, Sphere, World};
///
/// let mut world = World::default();
/// let moving = Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::new(2.0, 0.0, 0.0));
/// let first = world.add_sphere(moving)?;
/// let second = world.add_sphere(Sphere::new(DVec3::new(2.0, 0.0, 0.0), 0.5))?;
/// let report = world.step(1.0)?;
/// let impact = &report.impacts[0];
/// assert_eq!(impact.between, BodyPair::Spheres(first, second));
/// assert_eq!((impact.time, impact.approach_speed, impact.impulse), (0.5, 2.0, 2.0));
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct StepReport {
    /// Impacts in order of time; at one time in the order in which they were answered.
    pub impacts: Vec<Impact>,
    /// Under the rule `exact`, the groups of impacts that were answered together, in the order of
    /// their impacts; see [`Self::ledger`].
    pub groups: Vec<ImpactGroup>,
    /// Events at the edges of wells ([`PairPotential`](crate::PairPotential)), in order of time.
    pub well_events: Vec<WellEvent>,
    /// Spheres inside triggers, in order of sphere, then collider.
    pub triggers: Vec<TriggerContact>,
    /// When spheres entered and left triggers, in order of time, then of sphere and collider.
    pub sensor_events: Vec<SensorEvent>,
    /// Spheres that emitters added, ascending.
    pub emitted: Vec<SphereId>,
    /// Spheres that emitters removed for new ones, or that entered triggers that capture.
    pub retired: Vec<SphereId>,
    /// Ids of spheres that emitters left out for want of room: no sphere ever has them.
    pub left_out: Vec<SphereId>,
    /// Under the rule `bisect`, groups of spheres in which two bodies met as often as allowed in a frame. They
    /// count as at rest: the rest of the frame was taken in one piece, and remaining overlaps were answered as in
    /// `discrete`.
    pub unfinished_islands: u32,
    /// The work of the step, by stage.
    pub work: StageCounts,
    /// Changes of the energy, by cause.
    pub energy_account: EnergyAccount,
    /// Quality of the solution under the rule `contact`, and in the stepped zones of `exact`.
    pub contact_account: ContactAccount,
    /// Under the rule `exact`, the spheres that were stepped and not moved from impact to impact.
    pub zone_account: ZoneAccount,
    /// Σ J l of all contacts \[N m s\], impacts among them, with their impulses J and the vectors l between centres;
    /// under the rule `contact` in a box in steady shear.
    pub(crate) virial: Option<DMat3>,
}

/// Zones of the rule `exact`: spheres were stepped whose contacts took more work than
/// [`Exact::zone_budget`](crate::Exact::zone_budget). [`StepReport::contact_account`] has the accuracy of their
/// motion.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct ZoneAccount {
    /// Spheres in a zone at the end of the step.
    pub spheres: u32,
    /// Time of all spheres in zones together \[s\]: a sphere in a zone at the end of a step counts for
    /// the whole step.
    pub sphere_seconds: f64,
    /// Ticks at which a zone was stepped.
    pub ticks: u32,
    /// Spheres that joined a zone.
    pub joined: u32,
    /// Spheres that left one.
    pub left: u32,
}

/// Changes of the energy of a world in a step, by cause, under any rule.
///
/// [`World::total_energy`](crate::World::total_energy) after the step is the energy before it, plus the sum of
/// these, plus the error of the integration: of other rules than `exact`, or rounding.
///
/// ```
/// use carom::{Collider, DVec3, Gravity, Pose, Shape, Sphere, World};
///
/// let mut world = World::default();
/// world.add_force(Gravity::new(DVec3::new(0.0, -10.0, 0.0)))?;
/// let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.5);
/// world.add_collider(floor)?;
/// world.add_sphere(Sphere::new(DVec3::new(0.0, 2.0, 0.0), 1.0))?;
/// let before = world.total_energy();
/// let taken = world.step(0.5)?.energy_account.contacts;
/// assert!((world.total_energy() - before - taken).abs() < 1e-14 * before);
/// // Of m g h = 10 J the impact leaves a quarter.
/// assert!((taken + 7.5).abs() < 1e-14 * before);
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct EnergyAccount {
    /// Work of contacts \[J\]: the energy that restitution and friction took, in impacts and in persistent
    /// contacts. It is <= 0 up to rounding, and under the rule `contact` up to the error of a sub-step. The contact
    /// forces on a sphere at rest do no work.
    pub contacts: f64,
    /// Work of moving colliders \[J\].
    pub colliders: f64,
    /// Work of the kicks of colliders \[J\].
    pub kicks: f64,
    /// Work of spheres that grow \[J\].
    pub growth: f64,
    /// Work of the steady shear of a periodic box \[J\]: -V σ_xy times the shear rate and the time, with the stress
    /// relative to the mean flow. [`World::kinetic_energy`](crate::World::kinetic_energy) is relative to it, too.
    pub shear: f64,
    /// Energy that a thermostat added \[J\]; < 0 where it took some.
    pub thermostat: f64,
    /// Work of forces without a potential \[J\]: of drag, wind, vortices, dampers of springs, and any other
    /// [`Force`](crate::Force) that is not conservative.
    pub forces: f64,
    /// Work of the forces applied to single spheres
    /// ([`World::set_applied_forces`](crate::World::set_applied_forces)) \[J\].
    pub applied: f64,
    /// Work \[J\], against forces that have a potential or are linear, of moving spheres out of overlaps, or in
    /// front of a surface, or along with a stepped zone until its first tick.
    pub correction: f64,
    /// Energy of the spheres that emitters added, minus the energy of those that they or triggers removed \[J\].
    pub emission: f64,
    /// Energy that the rule `exact` adds where it holds a force constant for a time, in stepped zones and in some
    /// persistent contacts \[J\]: the work of the held force, less that of the force itself.
    pub integration: f64,
}

impl EnergyAccount {
    /// The sum of all entries \[J\].
    pub fn total(&self) -> f64 {
        let of_bodies = self.contacts
            + self.colliders
            + self.kicks
            + self.growth
            + self.shear
            + self.thermostat;
        let of_forces = self.forces + self.applied + self.integration;
        of_bodies + of_forces + self.correction + self.emission
    }

    /// Returns the account with all entries multiplied by a factor.
    pub(crate) fn part(&self, part: f64) -> Self {
        Self {
            contacts: part * self.contacts,
            colliders: part * self.colliders,
            kicks: part * self.kicks,
            growth: part * self.growth,
            shear: part * self.shear,
            thermostat: part * self.thermostat,
            forces: part * self.forces,
            applied: part * self.applied,
            correction: part * self.correction,
            emission: part * self.emission,
            integration: part * self.integration,
        }
    }

    /// Adds work of nonconservative forces.
    pub(crate) fn add_force_work(&mut self, work: ForceWork) {
        self.forces += work.forces;
        self.shear += work.shear;
        self.applied += work.applied;
        self.integration += work.integration;
    }
}

impl AddAssign for EnergyAccount {
    fn add_assign(&mut self, other: Self) {
        self.contacts += other.contacts;
        self.colliders += other.colliders;
        self.kicks += other.kicks;
        self.growth += other.growth;
        self.shear += other.shear;
        self.thermostat += other.thermostat;
        self.forces += other.forces;
        self.applied += other.applied;
        self.correction += other.correction;
        self.emission += other.emission;
        self.integration += other.integration;
    }
}

/// Quality of the solutions of a step under the rule `contact`, or in the stepped zones of `exact`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct ContactAccount {
    /// Sub-steps in which all impulses were reduced so that they add no kinetic energy.
    pub limited_sub_steps: u32,
    /// Largest change of a normal impulse in the last sweep of a sub-step, as a part of the largest impulse before
    /// or after it, 0 to 1: a measure of the distance from the converged solution.
    pub residual: f64,
    /// Largest overlap before its correction, beyond the slop, as a part of the sum of radii.
    pub largest_overlap: f64,
    /// Spheres that sleep at the end of the step: at rest, with all that they touch, until something comes
    /// near or changes.
    pub asleep: u32,
    /// How often a sphere was pressed into a surface by half its radius or more, counted in each sub-step: by
    /// surfaces that leave it no way out, as between the jaws of a vice, or by others much heavier. No motion
    /// keeps such bodies apart.
    pub squeezed: u32,
}

/// The work of a step, counted by stage: integers that depend on the world alone, not on the machine
/// or on the number of threads.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct StageCounts {
    /// Predict: number of predictions of the next events of a sphere, under the rule `exact`.
    pub predictions: u64,
    /// Predict: pairs of spheres that were tested for a meeting; under the other rules, pairs that were
    /// tested for a contact.
    pub pair_tests: u64,
    /// Queue: number of events taken from it, with void ones, under the rule `exact`.
    pub events: u64,
    /// Cell crossing: number of such events.
    pub cell_crossings: u64,
    /// Impact: groups of touching bodies that were answered as a whole, under the rule `exact`.
    pub groups: u64,
    /// Impact: iterations of the solvers of these groups, for impulses and for the forces of persistent
    /// contacts, each counted once for every contact.
    pub solver_iterations: u64,
    /// Search: number of searches for neighbours, under the rule `contact`.
    pub searches: u64,
    /// Sweep: number of passes over all contacts, under the rule `contact`.
    pub sweeps: u64,
    /// Sweep: contacts that it goes through at the end of the step, under the rule `contact`.
    pub contacts: u64,
}

impl AddAssign for StageCounts {
    fn add_assign(&mut self, other: Self) {
        self.predictions += other.predictions;
        self.pair_tests += other.pair_tests;
        self.events += other.events;
        self.cell_crossings += other.cell_crossings;
        self.groups += other.groups;
        self.solver_iterations += other.solver_iterations;
        self.searches += other.searches;
        self.sweeps += other.sweeps;
        self.contacts += other.contacts;
    }
}

impl StepReport {
    pub(crate) fn clear(&mut self) {
        self.impacts.clear();
        self.groups.clear();
        self.well_events.clear();
        self.triggers.clear();
        self.sensor_events.clear();
        self.emitted.clear();
        self.left_out.clear();
        self.retired.clear();
        self.unfinished_islands = 0;
        self.work = StageCounts::default();
        self.energy_account = EnergyAccount::default();
        self.contact_account = ContactAccount::default();
        self.zone_account = ZoneAccount::default();
        self.virial = None;
    }
}

impl StepReport {
    /// Every impact with the group in which it was answered, in order. Empty under rules that keep
    /// no account of groups.
    pub fn ledger(&self) -> impl Iterator<Item = LedgerEntry<'_>> {
        self.groups.iter().flat_map(|group| {
            let impacts = &self.impacts[group.first..group.first + group.count];
            impacts.iter().map(move |impact| LedgerEntry { impact, group })
        })
    }
}

/// An impact, and the account of the group in which it was answered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LedgerEntry<'a> {
    /// The impact.
    pub impact: &'a Impact,
    /// The impacts at the same instant among bodies that touch, itself among them.
    pub group: &'a ImpactGroup,
}

/// Impacts at one instant among bodies that touch each other, with their common momentum and energy.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ImpactGroup {
    /// Index of its first impact in [`StepReport::impacts`].
    pub first: usize,
    /// Number of its impacts.
    pub count: usize,
    /// Law by which it was answered. A single impact is the same under every law.
    pub law: ImpactLaw,
    /// Momentum of its spheres before \[kg m/s\].
    pub momentum_before: DVec3,
    /// Momentum after, less what colliders gave \[kg m/s\]: it differs from the momentum before by rounding only.
    pub momentum_after: DVec3,
    /// Sum of the magnitudes of the momenta before, for the relative error; with more than two spheres or with
    /// colliders, of those after if that is more \[kg m/s\].
    pub momentum_scale: f64,
    /// Kinetic energy of its spheres before \[J\].
    pub energy_before: f64,
    /// Kinetic energy after, less the work of moving colliders, of kicks and of growth \[J\].
    pub energy_after: f64,
    /// Work of moving colliders \[J\].
    pub collider_work: f64,
    /// Work of the kicks of colliders, and of spheres that grow \[J\].
    pub kick_work: f64,
    /// Change of the kinetic energy that the coefficients of restitution demand \[J\], <= 0.
    pub energy_demanded: f64,
}

impl ImpactGroup {
    /// Size of the error of momentum, relative to the momenta at work.
    pub fn momentum_error(&self) -> f64 {
        relative((self.momentum_after - self.momentum_before).length(), self.momentum_scale)
    }

    /// Change of energy beyond what restitution demands, relative to the energy at work.
    pub fn energy_error(&self) -> f64 {
        let error = self.energy_after - self.energy_before - self.energy_demanded;
        relative(error.abs(), self.energy_before.max(self.energy_after.abs()))
    }
}

/// `error / scale`, and 0 for no error of nothing.
fn relative(error: f64, scale: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / scale }
}

/// The two bodies of an impact or an overlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum BodyPair {
    /// Two spheres, bodies 1 and 2; the smaller id first.
    Spheres(SphereId, SphereId),
    /// A collider, body 1, and a sphere, body 2.
    Collider {
        /// Body 1.
        collider: ColliderId,
        /// Body 2.
        sphere: SphereId,
    },
}

impl BodyPair {
    pub(crate) fn of(bodies: Bodies, system: &System) -> Self {
        let id = &system.spheres.id;
        match bodies {
            Bodies::Pair(i, j) => Self::Spheres(id[i as usize], id[j as usize]),
            Bodies::Surface { sphere, surface } => Self::Collider {
                collider: system.surfaces[surface as usize].collider,
                sphere: id[sphere as usize],
            },
        }
    }
}

/// One impact.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Impact {
    /// Time since the start of the step \[s\].
    pub time: f64,
    /// The two bodies.
    pub between: BodyPair,
    /// Contact point on the surface of body 1 \[m\].
    pub point: DVec3,
    /// Unit normal from body 1 to body 2.
    pub normal: DVec3,
    /// Speed of approach along the normal before the impact \[m/s\], > 0. In a group of several impacts it is that
    /// before all of them: a contact that was not closing by itself may be hit.
    pub approach_speed: f64,
    /// Speed of separation along the normal after the impact \[m/s\], and after all others at the
    /// same instant in its group; > 0 where the bodies part.
    pub separation_speed: f64,
    /// Impulse on body 2 along the normal, and against it on body 1 \[N s\].
    pub impulse: f64,
    /// Impulse of friction on body 2, and against it on body 1, across the normal \[N s\]: zero without
    /// friction. At the contact point it turns both bodies, too.
    pub tangential_impulse: DVec3,
    /// Speed that the collider added along the normal \[m/s\]: its [`Collider::kick`](crate::Collider::kick), or 0.
    pub kick: f64,
}

/// A sphere inside a trigger at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TriggerContact {
    /// The trigger.
    pub collider: ColliderId,
    /// The sphere.
    pub sphere: SphereId,
    /// Unit normal from the trigger's surface to the sphere.
    pub normal: DVec3,
    /// Contact point on the surface of the trigger \[m\].
    pub point: DVec3,
}

/// A sphere that enters a trigger, or leaves it.
///
/// A sphere is in a trigger while their surfaces touch or overlap. Under the rule `exact` the time is that of the
/// flight, to rounding, however small the trigger and however fast the sphere. Under the other rules the path of a
/// sphere is straight within a frame, under `contact` within a sub-step. A sphere that is in a trigger at the start
/// of a step, but was not at the end of the last one, enters at time 0.
///
/// ```
/// use carom::{Collider, DVec3, Pose, Shape, Sphere, World};
///
/// let mut world = World::default();
/// let gate = Collider::new(Shape::Box { size: DVec3::splat(2.0) }, Pose::at(DVec3::ZERO));
/// world.add_collider(gate.as_trigger())?;
/// let fast = Sphere::new(DVec3::new(-21.0, 0.0, 0.0), 1.0).with_velocity(DVec3::new(100.0, 0.0, 0.0));
/// world.add_sphere(fast)?;
/// let events = &world.step(1.0)?.sensor_events;
/// assert_eq!((events[0].enters, events[1].enters), (true, false));
/// assert!((events[0].time - 0.19).abs() < 1e-15 && (events[1].time - 0.23).abs() < 1e-15);
/// assert_eq!(events[0].speed, 100.0);
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SensorEvent {
    /// Time since the start of the step \[s\].
    pub time: f64,
    /// The trigger.
    pub collider: ColliderId,
    /// The sphere.
    pub sphere: SphereId,
    /// Whether the sphere enters; else it leaves.
    pub enters: bool,
    /// Where on the trigger's surface \[m\].
    pub point: DVec3,
    /// Unit normal from the trigger's surface to the sphere.
    pub normal: DVec3,
    /// Speed of the sphere relative to the trigger \[m/s\].
    pub speed: f64,
}

impl TriggerContact {
    /// The report of a contact with a trigger; `None` for a contact between spheres.
    pub(crate) fn of(contact: &Contact, system: &System) -> Option<Self> {
        let Bodies::Surface { sphere, surface } = contact.bodies else { return None };
        Some(Self {
            collider: system.surfaces[surface as usize].collider,
            sphere: system.spheres.id[sphere as usize],
            normal: contact.separation.normal,
            point: contact.separation.point,
        })
    }
}

/// Two bodies that overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// The two bodies.
    pub between: BodyPair,
    /// How far their surfaces overlap \[m\], > 0.
    pub depth: f64,
}

impl Overlap {
    pub(crate) fn of(contact: &Contact, system: &System) -> Self {
        Self { between: BodyPair::of(contact.bodies, system), depth: -contact.separation.distance }
    }
}
