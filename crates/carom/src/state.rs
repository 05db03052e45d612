//! What persists from step to step.

use std::sync::Arc;

use glam::DVec3;

use crate::bodies::{Motion, Spheres};
use crate::clock::Clock;
use crate::colliders::Colliders;
use crate::detect::instant::Instant;
use crate::emitter::{self, Emission, EmitterState};
use crate::error::{Error, Subject};
use crate::forces::Force;
use crate::id::EmitterId;
use crate::numbered::Numbered;
use crate::report::StepReport;
use crate::rule::Exact;
use crate::rule::exact::{self, Arrivals, Span, Timeline, Unfinished};
use crate::settings::Settings;
use crate::system::System;
use crate::validate;
use crate::work::Work;

/// Everything a world's future depends on.
#[derive(Debug, Clone, Default)]
pub(crate) struct State {
    pub settings: Settings,
    pub forces: Numbered<Arc<dyn Force>>,
    /// Shared by worlds that were copied, until one changes its own.
    pub colliders: Arc<Colliders>,
    pub emitters: Numbered<EmitterState>,
    pub clock: Clock,
    pub spheres: Spheres,
    /// The id of the next sphere.
    pub next_id: u64,
    /// Under the rule `exact`, the flights of the spheres; `None` where they have to begin anew,
    /// from the spheres as they are.
    pub timeline: Option<Timeline>,
}

impl State {
    /// What a step reads, and what it moves.
    pub fn split(&mut self) -> (System<'_>, &mut Motion) {
        let Self { settings, forces, colliders, spheres, .. } = self;
        let Spheres { properties, motion } = spheres;
        (System::new(settings, forces, colliders, properties), motion)
    }

    /// All spheres as they are now.
    pub fn now(&self) -> Instant<'_> {
        let time = self.clock.seconds();
        let properties = &self.spheres.properties;
        let system = System::new(&self.settings, &self.forces, &self.colliders, properties);
        Instant { system, motion: &self.spheres.motion, time }
    }

    /// The state, to be changed from outside: nothing that was predicted holds any more.
    pub fn changed(&mut self) -> &mut Self {
        self.timeline = None;
        self
    }

    /// The colliders, to be changed from outside.
    pub fn colliders_mut(&mut self) -> &mut Colliders {
        Arc::make_mut(&mut self.changed().colliders)
    }

    /// Moves on by `h` \[s\] the colliders that move.
    pub fn advance_colliders(&mut self, h: f64) {
        if self.colliders.any_moving() {
            Arc::make_mut(&mut self.colliders).advance(h);
        }
    }

    /// Puts a sphere elsewhere. Where flights are renewed in every frame, those of the others stay good.
    pub fn place(&mut self, index: usize, position: DVec3, velocity: DVec3) {
        let time = self.clock.seconds();
        if let Some(timeline) = self.renewed_flights() {
            timeline.place(index, position, velocity, time);
        }
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
    }

    /// The flights, if all begin anew in each frame: then a change from outside to some of them leaves
    /// the others good. Any others are dropped.
    fn renewed_flights(&mut self) -> Option<&mut Timeline> {
        self.timeline = self.timeline.take().filter(Timeline::is_renewed_each_frame);
        self.timeline.as_mut()
    }

    /// Emits the spheres that are due at `time` \[s\]; those that are there fly on.
    pub fn emit(&mut self, time: f64) -> Emission {
        let ids = self.timeline.is_some().then(|| self.spheres.ids().to_vec());
        let Self { emitters, spheres, next_id, .. } = self;
        let emission = emitter::emit(emitters, spheres, next_id, time);
        let next = emitter::next_due(emitters);
        if let (Some(timeline), Some(ids)) = (self.timeline.take(), ids) {
            let (system, motion) = self.split();
            let time_of = |id| match emission.emitted.binary_search(&id) {
                Ok(place) => emission.due[place],
                Err(_) => time,
            };
            let arrivals = Arrivals { known: &ids, time_of, next };
            self.timeline = Some(exact::adopt(&timeline, &system, motion, arrivals, time));
        }
        emission
    }

    /// Prepares for a frame from and to these times \[s\] under the rule `exact`.
    ///
    /// # Errors
    /// [`Error::NonFiniteState`] if a force is not finite, [`Error::Invalid`] if a periodic box is
    /// too small for the spheres or if there are too many of them.
    pub fn begin_frame(&mut self, parameters: Exact, frame: [f64; 2]) -> Result<(), Error> {
        self.check_count()?;
        self.check_box()?;
        let timeline = self.timeline.take();
        let next_emission = emitter::next_due(&self.emitters);
        let (system, motion) = self.split();
        let start = || exact::start(&system, parameters, motion, frame[0]);
        let mut timeline = timeline.unwrap_or_else(start);
        let begun = exact::begin(&mut timeline, &system, frame, next_emission);
        self.timeline = Some(timeline);
        let time = frame[0];
        begun.map_err(|sphere| Error::NonFiniteState { sphere, quantity: "velocity", time })
    }

    /// Refuses more spheres than the rule `exact` can tell apart.
    fn check_count(&self) -> Result<(), Error> {
        let (count, most) = (self.spheres.ids().len(), exact::MAX_SPHERES);
        let requirement = "few enough for the rule exact: at most 2^27 spheres";
        validate::require(count <= most, "spheres", requirement, count as f64)
            .map_err(|invalid| invalid.about(Subject::Step))
    }

    /// Refuses a periodic box in which a sphere could touch two images of another one.
    fn check_box(&self) -> Result<(), Error> {
        let smallest = self.settings.boundary.period().min_element();
        let largest = self.spheres.radii().iter().copied().fold(0.0, f64::max);
        let requirement = "at least four times the radius of every sphere along every axis";
        validate::require(smallest >= 4.0 * largest, "size", requirement, smallest)
            .map_err(|invalid| invalid.about(Subject::Settings))
    }

    /// Takes a part of a frame by the rule `exact`.
    pub fn advance_exactly(
        &mut self,
        span: Span,
        work: &Work,
        report: &mut StepReport,
    ) -> Result<(), Error> {
        let Some(mut timeline) = self.timeline.take() else { return Ok(()) };
        let (system, _) = self.split();
        let advanced = exact::advance(&system, &mut timeline, span, work, report);
        self.timeline = Some(timeline);
        advanced.map_err(|unfinished| match unfinished {
            Unfinished::Stopped => Error::Stopped { time: span.start },
            Unfinished::TooManyImpacts { sphere, limit, companions, time } => {
                Error::TooManyImpacts { sphere, limit, companions, at: time, time: span.start }
            }
        })
    }

    /// Puts all spheres where they are at the end of a frame under the rule `exact`.
    ///
    /// # Errors
    /// [`Error::NonFiniteState`] if one is nowhere; then none is moved.
    pub fn end_frame(&mut self, span: Span) -> Result<(), Error> {
        let Some(timeline) = self.timeline.take() else { return Ok(()) };
        let (system, motion) = self.split();
        exact::end(&timeline, &system, motion, span).map_err(|(index, quantity)| {
            let (sphere, time) = (self.spheres.ids()[index], self.clock.seconds());
            Error::NonFiniteState { sphere, quantity, time }
        })?;
        self.timeline = Some(timeline);
        Ok(())
    }

    /// Refuses positions or velocities that are not finite.
    pub fn check_finite(&self) -> Result<(), Error> {
        let quantities =
            [("velocity", self.spheres.velocities()), ("position", self.spheres.positions())];
        for (quantity, values) in quantities {
            if let Some(index) = values.iter().position(|value| !value.is_finite()) {
                let sphere = self.spheres.ids()[index];
                return Err(Error::NonFiniteState { sphere, quantity, time: self.clock.seconds() });
            }
        }
        Ok(())
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
