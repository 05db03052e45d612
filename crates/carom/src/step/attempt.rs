//! An attempt at a step: it emits spheres, and undoes everything if the step fails.

use crate::bodies::{Motion, Spheres};
use crate::clock::Clock;
use crate::detect::contacts::{self, Search};
use crate::emitter::{self, Emission, EmitterState, Room};
use crate::error::Error;
use crate::forces::Spring;
use crate::numbered::Numbered;
use crate::report::{StepReport, TriggerContact};
use crate::rule::contact::{self, Solver};
use crate::rule::exact::FlightLog;
use crate::rule::{bisect, discrete};
use crate::sensor::{Sensors, Tracks};
use crate::settings::Rule;
use crate::state::State;
use crate::surface::{Role, Surface};
use crate::work::Work;

/// Working memory of steps, kept to avoid allocating it again.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    pub discrete: discrete::Scratch,
    pub bisect: bisect::Scratch,
    pub contact: contact::Scratch,
    pub search: Search,
    pub tracks: Tracks,
    /// Log of persistent contacts under the rule `exact`; `None` in a step that keeps none.
    pub flight_log: Option<FlightLog>,
    /// Motion at the start of the step, which a failed step restores.
    pub start: Motion,
}

/// An attempt at a step.
pub(super) struct Attempt<'a> {
    pub state: &'a mut State,
    pub scratch: &'a mut Scratch,
    pub report: &'a mut StepReport,
    pub work: Work<'a>,
    /// Start of the step, on the world's clock \[s\].
    pub start: f64,
    /// Length of the step \[s\].
    pub length: f64,
    /// The clock at the end of the step.
    pub end: Clock,
    /// What the first emission of the step changed.
    before_emission: Option<BeforeEmission>,
}

impl<'a> Attempt<'a> {
    /// A step of `length` \[s\] that has not begun.
    pub fn new(
        state: &'a mut State,
        scratch: &'a mut Scratch,
        report: &'a mut StepReport,
        work: Work<'a>,
        length: f64,
    ) -> Self {
        let (start, end) = (state.clock.seconds(), state.clock.after(length));
        Self { state, scratch, report, work, start, length, end, before_emission: None }
    }

    /// Ends the step at `time` \[s\], if that is before its end.
    pub fn end_at(&mut self, time: f64) {
        if time < self.end.seconds() {
            (self.length, self.end) = (time - self.start, Clock::at(time));
        }
    }

    /// Moves the spheres by `advance`, then the clock and the colliders to the end of the step. If `advance` fails,
    /// emitted spheres are removed, and flights restart.
    pub fn take(
        &mut self,
        advance: impl FnOnce(&mut Self) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let potential = self.state.nonconservative_potential(self.start);
        if let Err(error) = advance(self) {
            if let Some(before) = self.before_emission.take() {
                before.restore(self.state);
            }
            self.state.timeline = None;
            self.state.solver = Solver::default();
            self.report.clear();
            return Err(error);
        }
        // A potential accounts for this part of the work.
        let gained = self.state.nonconservative_potential(self.end.seconds()) - potential;
        self.report.energy_account.forces += gained;
        self.state.clock = self.end;
        self.state.advance_colliders(self.length);
        Ok(())
    }

    /// Reports the spheres that are inside triggers now.
    pub fn report_triggers(&mut self) {
        let Self { state, scratch, report, .. } = self;
        let now = state.now();
        contacts::visit_triggers(&now, 0.0, &mut scratch.search, |contact| {
            report.triggers.extend(TriggerContact::of(&contact, &now.system));
        });
    }

    /// Begins to note where the spheres are, if there are triggers.
    pub fn begin_tracks(&mut self) {
        let is_wanted = !self.state.colliders.trigger_tree().is_empty();
        self.scratch.tracks.begin(is_wanted, self.state.spheres.positions());
    }

    /// Reports the spheres inside triggers before a trigger moves: the rules `discrete` and `bisect` test them
    /// then.
    pub fn report_moved_triggers(&mut self) {
        let is_moving = |it: &Surface| it.role == Role::Reports && !it.motion.is_at_rest();
        if self.state.colliders.surfaces().iter().any(is_moving) {
            self.report.triggers.clear();
            self.report_triggers();
        }
    }

    /// Reports the events of sensors, and keeps the spheres in triggers; `None` where there are no triggers.
    pub fn report_sensors(&mut self, sensors: Option<Sensors>) {
        let Some(mut sensors) = sensors else { return self.state.presence.clear() };
        let (system, _) = self.state.split();
        sensors.finish(&system);
        self.report.sensor_events = sensors.events;
        self.state.presence = sensors.presence;
    }

    /// Saves the state before an emission, which a failed step restores.
    pub fn expect_emission(&mut self) {
        self.before_emission.get_or_insert_with(|| BeforeEmission::of(self.state));
    }

    /// The room for emitted spheres.
    pub fn room(&self) -> Room {
        let settings = &self.state.settings;
        let is_needed = matches!(settings.rule, Rule::Contact(_)) && settings.spheres_collide;
        let non_additivity = self.state.material_pairs.non_additivity.clone();
        Room { is_needed, period: settings.boundary.period(), non_additivity }
    }

    /// Emits the spheres that are due at `time` \[s\], with all others in the places of the arrays; the first time
    /// it saves the state before.
    pub fn emit(&mut self, time: f64) -> Emission {
        if !emitter::any_due(&self.state.emitters, time) {
            return Emission::default();
        }
        self.expect_emission();
        let room = self.room();
        let energy = self.state.total_energy(time);
        let potential = self.state.nonconservative_potential(time);
        let State { emitters, spheres, next_id, .. } = &mut *self.state;
        let emission = emitter::emit(emitters, spheres, next_id, time, &room);
        if !emission.retired.is_empty() {
            self.state.drop_loose_springs();
        }
        let account = &mut self.report.energy_account;
        account.emission += self.state.total_energy(time) - energy;
        account.forces -= self.state.nonconservative_potential(time) - potential;
        self.report.emitted.extend(&emission.emitted);
        self.report.retired.extend(&emission.retired);
        self.report.left_out.extend(&emission.left_out);
        emission
    }
}

/// The state that an emission changes, which a failed step restores.
struct BeforeEmission {
    emitters: Numbered<EmitterState>,
    spheres: Spheres,
    springs: Numbered<Spring>,
    next_id: u64,
}

impl BeforeEmission {
    fn of(state: &State) -> Self {
        let State { emitters, spheres, springs, next_id, .. } = state;
        Self {
            emitters: emitters.clone(),
            spheres: spheres.clone(),
            springs: springs.clone(),
            next_id: *next_id,
        }
    }

    fn restore(self, state: &mut State) {
        let Self { emitters, spheres, springs, next_id } = self;
        (state.emitters, state.spheres) = (emitters, spheres);
        (state.springs, state.next_id) = (springs, next_id);
    }
}
