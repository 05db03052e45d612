//! What persists from step to step.

use std::sync::Arc;

use educe::Educe;
use glam::DVec3;

use crate::bodies::{Motion, Spheres};
use crate::clock::Clock;
use crate::colliders::Colliders;
use crate::detect::instant::Instant;
use crate::emitter::{self, EmitterState};
use crate::error::{Error, InvalidValue, Subject};
use crate::forces::{Force, Spring};
use crate::id::{EmitterId, SphereId};
use crate::invariants;
use crate::material_pair::MaterialPairs;
use crate::numbered::Numbered;
use crate::persistent_contact::PersistentContact;
use crate::rule::contact::{self, Solver};
use crate::rule::exact::{self, Timeline, Zone};
use crate::sensor::Presence;
use crate::settings::{Boundary, Rule, Settings};
use crate::shear::Shear;
use crate::system::System;
use crate::validate;

/// Everything a world's future depends on.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct State {
    pub settings: Settings,
    pub material_pairs: MaterialPairs,
    #[cfg_attr(feature = "serde", serde(with = "crate::forces::shipped"))]
    pub forces: Numbered<Arc<dyn Force>>,
    /// Between spheres that are all in the world.
    pub springs: Numbered<Spring>,
    /// Shared by worlds that were copied, until one changes its own.
    pub colliders: Arc<Colliders>,
    pub emitters: Numbered<EmitterState>,
    pub clock: Clock,
    pub spheres: Spheres,
    /// The id of the next sphere.
    pub next_id: u64,
    /// Flights of the spheres under the rule `exact`; `None` if they must start again from the
    /// present state.
    pub timeline: Option<Timeline>,
    /// Under the rule `exact`, what was stepped before the flights were dropped.
    pub zone: Zone,
    /// Whether spheres were in zones so far.
    pub was_stepped: bool,
    /// Which spheres were in which triggers at the end of the last step.
    pub presence: Presence,
    /// Under the rule `contact`, neighbours and the impulses of contacts.
    pub solver: Solver,
}

impl State {
    /// Returns what a step reads, and what it moves.
    pub fn split(&mut self) -> (System<'_>, &mut Motion) {
        let (system, motion, _) = self.split_with_solver();
        (system, motion)
    }

    /// Returns what a step reads, what it moves, and the solver that the rule `contact` keeps.
    pub fn split_with_solver(&mut self) -> (System<'_>, &mut Motion, &mut Solver) {
        let Self { settings, material_pairs, forces, springs, colliders, spheres, solver, .. } =
            self;
        let Spheres { properties, motion } = spheres;
        let given = (&*settings, &*material_pairs);
        (System::new(given, forces, springs, colliders, properties), motion, solver)
    }

    /// All spheres as they are now.
    pub fn now(&self) -> Instant<'_> {
        let time = self.clock.seconds();
        let properties = &self.spheres.properties;
        let Self { settings, material_pairs, forces, springs, colliders, .. } = self;
        let given = (settings, material_pairs);
        let system = System::new(given, forces, springs, colliders, properties);
        Instant { system, motion: &self.spheres.motion, time }
    }

    /// Potential energy \[J\] in all forces, springs and wells that have one, at `time` \[s\].
    pub fn potential_energy(&self, time: f64) -> f64 {
        let Self { forces, springs, settings, spheres, .. } = self;
        let period = settings.boundary.period();
        invariants::potential_energy(spheres, forces, springs, period, time) + self.well_energy()
    }

    /// Potential energy of pairs in wells \[J\]: of those that flights bind, or else by distances.
    fn well_energy(&self) -> f64 {
        if self.settings.pair_potential.is_none() {
            return 0.0;
        }
        match &self.timeline {
            Some(timeline) => timeline.well_energy(),
            None => exact::well_energy(&self.now()),
        }
    }

    /// Kinetic and potential energy \[J\], at `time` \[s\].
    pub fn total_energy(&self, time: f64) -> f64 {
        invariants::kinetic_energy(&self.spheres, Shear::of(&self.settings))
            + self.potential_energy(time)
    }

    /// Potential energy \[J\] in nonconservative forces at `time` \[s\].
    pub fn nonconservative_potential(&self, time: f64) -> f64 {
        let Instant { system, motion, .. } = self.now();
        if system.has_nonconservative_forces() {
            system.nonconservative_potential([&motion.position, &motion.velocity], time)
        } else {
            0.0
        }
    }

    /// The contacts that persist, as far as flights are known.
    pub fn persistent_contacts(&self) -> Vec<PersistentContact> {
        let Instant { system, time, .. } = self.now();
        let list = |timeline| exact::persistent_contacts(timeline, &system, time);
        match self.settings.rule {
            Rule::Contact(_) => contact::persistent_contacts(&self.solver, &system),
            _ => self.timeline.as_ref().map(list).unwrap_or_default(),
        }
    }

    /// The state, to be changed from outside: nothing that was predicted holds any more, and neighbours
    /// are others.
    pub fn changed(&mut self) -> &mut Self {
        self.drop_flights();
        self.solver.set_changed();
        self
    }

    /// Drops the flights, so that all begin again.
    fn drop_flights(&mut self) {
        if let Some(timeline) = self.timeline.take() {
            self.zone = timeline.into_zone();
        }
    }

    /// Takes spheres out, with the springs at them.
    pub fn remove_spheres(&mut self, ids: &[SphereId]) {
        let state = self.changed();
        state.spheres.remove_all(ids);
        state.drop_loose_springs();
    }

    /// Takes out the springs at spheres that are not in the world.
    pub fn drop_loose_springs(&mut self) {
        let Self { springs, spheres, .. } = self;
        springs.retain(|spring| spring.spheres().all(|id| spheres.index_of(id).is_some()));
    }

    /// Refuses forces that are invalid in the boundary of the world.
    pub fn check_boundary(settings: &Settings, force: &dyn Force) -> Result<(), InvalidValue> {
        let suits = force.interaction().is_none_or(|it| it.suits_periodic_box());
        let requirement =
            "open under this force between spheres, which has no end in a periodic box";
        validate::require(
            suits || settings.boundary == Boundary::Open,
            "boundary",
            requirement,
            "periodic",
        )
    }

    /// The colliders, to be changed from outside.
    pub fn colliders_mut(&mut self) -> &mut Colliders {
        let time = self.clock.seconds();
        let colliders = Arc::make_mut(&mut self.changed().colliders);
        colliders.move_to(time);
        colliders
    }

    /// Whether nothing happens in a step of `h` \[s\] by the rule `contact` that begins at `time` \[s\].
    pub fn is_idle(&self, time: f64, h: f64) -> bool {
        let any_due = emitter::any_due(&self.emitters, emitter::due_with_frame(time, h));
        self.solver.is_idle() && !any_due
    }

    /// Advances moving colliders by `h` \[s\].
    pub fn advance_colliders(&mut self, h: f64) {
        if !self.colliders.any_moving() {
            return;
        }
        let time = self.clock.seconds();
        if Arc::make_mut(&mut self.colliders).advance(h, time) {
            self.changed();
        }
    }

    /// Puts a sphere elsewhere. Where flights are renewed in every frame, those of the others stay good.
    pub fn place(&mut self, index: usize, position: DVec3, velocity: DVec3) {
        let time = self.clock.seconds();
        if let Some(timeline) = self.renewed_flights() {
            timeline.place(index, position, velocity, time);
        }
        self.solver.set_changed();
        (self.spheres.motion.position[index], self.spheres.motion.velocity[index]) =
            (position, velocity);
    }

    /// Sets the clock to a time \[s\].
    pub fn set_time(&mut self, seconds: f64) {
        let now = self.clock.seconds();
        if let Some(timeline) = self.renewed_flights() {
            timeline.set_time(now, seconds);
        }
        self.clock = Clock::at(seconds);
        if self.colliders.any_moving() {
            Arc::make_mut(&mut self.colliders).move_to(seconds);
        }
    }

    /// Returns the flights if all of them start again in each frame, so that a change from outside to some
    /// of them does not affect the others. Otherwise drops them.
    fn renewed_flights(&mut self) -> Option<&mut Timeline> {
        let are_applied = !self.spheres.applied_forces().is_empty();
        if !self.timeline.as_ref().is_some_and(|it| it.is_renewed_each_frame(are_applied)) {
            self.drop_flights();
        }
        self.timeline.as_mut()
    }

    /// The longest frame \[s\] in which motion on springs is sure to be stable.
    pub fn longest_stable_frame(&self) -> f64 {
        let rate = self.now().system.fastest_spring_rate();
        match self.settings.rule {
            Rule::Exact(_) => f64::INFINITY,
            Rule::Contact(parameters) => {
                contact::longest_frame_for_springs(parameters.sub_steps, rate)
            }
            Rule::Discrete(_) | Rule::Bisect(_) => 2.0 / rate,
        }
    }

    /// Refuses springs that a rule with frames does not follow in frames of `h` \[s\].
    pub fn check_springs(&self, h: f64) -> Result<(), Error> {
        let longest = self.longest_stable_frame();
        if h <= longest {
            return Ok(());
        }
        let requirement = match self.settings.rule {
            Rule::Contact(_) => "small enough for the frames and their `sub_steps`",
            _ => "small enough for the frames, or the rule `exact`",
        };
        let value = format!(
            "so large that motion on springs is stable up to frames of {longest:.3e} s; these have {h:.3e} s"
        );
        Err(InvalidValue { field: "stiffness", requirement, value }.about(Subject::Step))
    }

    /// Refuses positions or velocities that are not finite.
    pub fn check_finite(&self) -> Result<(), Error> {
        let quantities =
            [("velocity", self.spheres.velocities()), ("position", self.spheres.positions())];
        for (quantity, values) in quantities {
            if let Some(index) = values.iter().position(|value| !value.is_finite()) {
                let sphere = self.spheres.ids()[index];
                let time = self.clock.seconds();
                return Err(Error::NonFiniteState { sphere, quantity, time });
            }
        }
        Ok(())
    }

    /// Refuses a periodic box in which a sphere could touch two images of another one.
    pub fn check_box(&self) -> Result<(), Error> {
        let smallest = self.settings.boundary.period().min_element();
        let largest = if self.material_pairs.non_additivity.is_none() {
            self.spheres.radii().iter().copied().fold(0.0, f64::max)
        } else {
            let system = self.now().system;
            let spheres = 0..self.spheres.len() as u32;
            spheres.map(|sphere| system.reach_of(sphere)).fold(0.0, f64::max)
        };
        let (requirement, largest) = match self.settings.pair_potential {
            Some(potential) => (
                "at least four times the radius of every sphere, times the `range_ratio` of the pair potential, \
                 along every axis",
                potential.range_ratio() * largest,
            ),
            None if !self.material_pairs.non_additivity.is_none() => (
                "at least four times the radius of every sphere, times one plus the largest `non_additivity` of \
                 its material, along every axis",
                largest,
            ),
            None => ("at least four times the radius of every sphere along every axis", largest),
        };
        validate::require(smallest >= 4.0 * largest, "size", requirement, smallest)
            .map_err(|invalid| invalid.about(Subject::Settings))
    }

    /// Refuses spheres that would grow too large for a periodic box within `h` \[s\].
    pub fn check_grown(&self, h: f64) -> Result<(), Error> {
        let smallest = self.settings.boundary.period().min_element();
        let spheres = &self.spheres.properties;
        let reach =
            |index: usize| self.material_pairs.non_additivity.reach(spheres.material(index));
        let grown =
            |(index, speed): (usize, &f64)| reach(index) * (spheres.radius[index] + speed * h);
        let largest = spheres.growth_speed.iter().enumerate().map(grown).fold(0.0, f64::max);
        let requirement =
            "at least four times what the radius of every sphere grows to along every axis";
        validate::require(smallest >= 4.0 * largest, "size", requirement, smallest)
            .map_err(|invalid| invalid.about(Subject::Settings))
    }

    /// Refuses emitters that would have too many spheres due until `time` \[s\].
    pub fn check_emitters(&self, time: f64) -> Result<(), Error> {
        for (number, emitter) in self.emitters.iter() {
            let subject = Subject::Emitter(EmitterId(number));
            emitter.validate_at(time).map_err(|invalid| invalid.about(subject))?;
        }
        Ok(())
    }
}
