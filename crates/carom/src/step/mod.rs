//! A step of a world: what is due is emitted, the rule moves the spheres, and a step that fails
//! leaves the world as it was.

mod by_event;
mod by_frame;

use crate::bodies::{Motion, Spheres};
use crate::clock::Clock;
use crate::detect::contacts::Search;
use crate::emitter::{self, Emission, EmitterState};
use crate::error::{Error, Subject};
use crate::numbered::Numbered;
use crate::report::StepReport;
pub(crate) use crate::rule::exact::Until;
use crate::rule::{self, bisect, discrete};
use crate::settings::Rule;
use crate::state::State;
use crate::validate;
use crate::work::{StopRequest, Work};

/// Working memory of steps, kept from one to the next only to spare its allocation.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    rule: rule::Scratch,
    search: Search,
    /// Motion at the start of the step, to return to if it fails.
    start: Motion,
}

/// A step at work.
struct Step<'a> {
    state: &'a mut State,
    scratch: &'a mut Scratch,
    report: &'a mut StepReport,
    work: Work<'a>,
    /// Start of the step, on the world's clock \[s\].
    start: f64,
    /// Length of the step \[s\].
    length: f64,
    /// The clock at the end of the step.
    end: Clock,
    /// What the first emission of the step changed.
    before_emission: Option<BeforeEmission>,
}

/// Advances a world by `dt` \[s\], or until something happens in it, by the rule of its settings, and
/// writes the report.
///
/// # Errors
/// Those of [`World::step`](crate::World::step). The state before the step is kept.
pub(crate) fn step(
    state: &mut State,
    dt: f64,
    stop_request: Option<&StopRequest>,
    scratch: &mut Scratch,
    report: &mut StepReport,
    until: Until,
) -> Result<(), Error> {
    validate::positive("dt", dt).map_err(|invalid| invalid.about(Subject::Step))?;
    report.clear();

    let (start, end) = (state.clock.seconds(), state.clock.after(dt));
    let requirement = "so short that the time stays finite";
    validate::require(end.seconds().is_finite(), "dt", requirement, dt)
        .map_err(|invalid| invalid.about(Subject::Step))?;

    if stop_request.is_some_and(StopRequest::is_made) {
        return Err(Error::Stopped { time: start });
    }
    let work = Work::new(stop_request);
    let (rule, length, before_emission) = (state.settings.rule, dt, None);
    let knows_events = until == Until::End || matches!(rule, Rule::Exact(_));
    let requirement = "`exact` to know of events";
    validate::require(knows_events, "rule", requirement, "one that knows nothing but frames")
        .map_err(|invalid| invalid.about(Subject::Settings))?;
    let step = Step { state, scratch, report, work, start, length, end, before_emission };
    match rule {
        Rule::Discrete(parameters) => {
            by_frame::step(step, |system, motion, frame, memory, report| {
                discrete::step(system, parameters, motion, frame, memory, report);
            })
        }
        Rule::Bisect(parameters) => {
            by_frame::step(step, |system, motion, frame, memory, report| {
                bisect::step(system, parameters, motion, frame, memory, report);
            })
        }
        Rule::Exact(parameters) => by_event::step(step, parameters, until),
    }
}

impl Step<'_> {
    /// Moves the spheres by `advance`, then the clock and the colliders to the end of the step. If
    /// `advance` fails, what was emitted is taken back, and flights begin anew.
    fn take(&mut self, advance: impl FnOnce(&mut Self) -> Result<(), Error>) -> Result<(), Error> {
        if let Err(error) = advance(self) {
            if let Some(before) = self.before_emission.take() {
                before.restore(self.state);
            }
            self.state.timeline = None;
            self.report.clear();
            return Err(error);
        }
        self.state.clock = self.end;
        self.state.advance_colliders(self.length);
        Ok(())
    }

    /// Emits the spheres that are due at `time` \[s\]; notes what was before, the first time.
    fn emit(&mut self, time: f64) -> Emission {
        if !emitter::any_due(&self.state.emitters, time) {
            return Emission::default();
        }
        self.before_emission.get_or_insert_with(|| BeforeEmission::of(self.state));
        let State { emitters, spheres, next_id, .. } = &mut *self.state;
        let emission = emitter::emit(emitters, spheres, next_id, time);
        self.report.emitted.extend(&emission.emitted);
        self.report.retired.extend(&emission.retired);
        emission
    }
}

/// What an emission changes, to return to if the step fails.
struct BeforeEmission {
    emitters: Numbered<EmitterState>,
    spheres: Spheres,
    next_id: u64,
}

impl BeforeEmission {
    fn of(state: &State) -> Self {
        let State { emitters, spheres, next_id, .. } = state;
        Self { emitters: emitters.clone(), spheres: spheres.clone(), next_id: *next_id }
    }

    fn restore(self, state: &mut State) {
        let Self { emitters, spheres, next_id } = self;
        (state.emitters, state.spheres, state.next_id) = (emitters, spheres, next_id);
    }
}
