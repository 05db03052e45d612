//! The world: all persistent state, and the step that advances it.

mod forces;
mod growth;
mod materials;
mod measures;
mod memory;
#[cfg(test)]
mod moving_oracle;
mod passages;
mod poses;
mod queries;
pub(crate) mod snapshot;
mod strike;
#[cfg(feature = "serde")]
mod written;

use glam::DVec3;

use crate::bodies::Spheres;
use crate::collider::Collider;
use crate::emitter::{Emitter, EmitterState};
use crate::error::{Error, Subject};
use crate::id::{ColliderId, EmitterId, SphereId};
use crate::persistent_contact::PersistentContact;
use crate::report::StepReport;
use crate::rule::exact::FlightLog;
use crate::settings::Settings;
use crate::sphere::{Sphere, SphereMotion};
use crate::state::State;
use crate::step::{self, Scratch, Until};
use crate::validate;
use crate::work::StopRequest;

/// Spheres, the forces on them, and the colliders off which they bounce.
///
/// ```
/// use carom::{Collider, DVec3, Gravity, Pose, Settings, Shape, Sphere, World};
///
/// let mut world = World::new(Settings::default())?;
/// world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0)))?;
/// world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)))?;
/// let ball = world.add_sphere(Sphere::new(DVec3::new(0.0, 2.0, 0.0), 0.5))?;
/// for _ in 0..120 {
///     for impact in &world.step(1.0 / 60.0)?.impacts {
///         println!("bounced with {:.3} m/s", impact.approach_speed);
///     }
/// }
/// assert!(world.sphere(ball)?.position.y > 0.499);
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct World {
    state: State,
    report: StepReport,
    scratch: Box<Scratch>,
    /// Read while a step runs.
    stop_request: Option<StopRequest>,
}

impl World {
    /// An empty world, at time 0.
    ///
    /// # Errors [`Error::Invalid`] for an invalid parameter of the rule.
    pub fn new(settings: Settings) -> Result<Self, Error> {
        let mut world = Self::default();
        world.set_settings(settings)?;
        Ok(world)
    }

    /// Advances the world by `dt` \[s\]: emits the spheres that are due, moves all spheres, answers impacts.
    ///
    /// # Errors [`Error::Invalid`] if `dt` is not positive and finite, an emitter runs away or a periodic box is
    /// too small for the spheres; [`Error::NonFiniteState`] if a number would overflow; [`Error::TooManyImpacts`]
    /// under the rule `exact`; [`Error::Stopped`] on a request ([`Self::set_stop_request`]). The world then keeps
    /// the state before the step.
    pub fn step(&mut self, dt: f64) -> Result<&StepReport, Error> {
        let Self { state, report, scratch, stop_request } = self;
        step::step(state, dt, stop_request.as_ref(), scratch, report, Until::End)?;
        Ok(report)
    }

    /// Advances the world as [`Self::step`] does. Returns the persistent contacts and the curved flights of the step.
    pub(crate) fn step_with_log(&mut self, dt: f64) -> Result<FlightLog, Error> {
        self.scratch.flight_log = Some(FlightLog::default());
        let stepped = self.step(dt).map(drop);
        let log = self.scratch.flight_log.take().unwrap_or_default();
        stepped.map(|()| log)
    }

    /// Checks everything about a step by `dt` \[s\] that does not depend on forces: the length of the step,
    /// emitters, and under the rule `exact` the periodic box, the number of spheres and the stiffness of springs.
    ///
    /// # Errors
    /// [`Error::Invalid`], as [`Self::step`], or if springs are too stiff for the rule `exact`.
    pub fn check_step(&self, dt: f64) -> Result<(), Error> {
        step::check(&self.state, dt)
    }

    /// Advances the world to its next impact and answers it, with all others at that instant; by `within` \[s\] if
    /// there is none before. Only under the rule `exact`.
    ///
    /// ```
    /// use carom::{Collider, DVec3, Gravity, Pose, Settings, Shape, Sphere, World};
    ///
    /// let mut world = World::new(Settings::default())?;
    /// world.add_force(Gravity::new(DVec3::new(0.0, -8.0, 0.0)))?;
    /// world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)))?;
    /// world.add_sphere(Sphere::new(DVec3::new(0.0, 2.0, 0.0), 1.0))?;
    /// assert_eq!(world.next_event_time(10.0)?, Some(0.5));
    /// assert_eq!(world.step_to_next_event(10.0)?.impacts.len(), 1);
    /// assert_eq!(world.time(), 0.5);
    /// # Ok::<(), carom::Error>(())
    /// ```
    ///
    /// # Errors [`Error::Invalid`] under another rule, and with springs or forces that are not linear: they are
    /// held for a time, which may end before that. Otherwise the errors of [`Self::step`].
    pub fn step_to_next_event(&mut self, within: f64) -> Result<&StepReport, Error> {
        let Self { state, report, scratch, stop_request } = self;
        let stop_request = stop_request.as_ref();
        step::step(state, within, stop_request, scratch, report, Until::NextImpact)?;
        Ok(report)
    }

    /// The time of the next impact \[s\], if one comes `within` this time \[s\]. Only under the
    /// rule `exact`; costs as much as a copy of the world and the step to that impact.
    ///
    /// # Errors
    /// Those of [`Self::step_to_next_event`].
    pub fn next_event_time(&self, within: f64) -> Result<Option<f64>, Error> {
        let mut copy = self.clone();
        let has_impact = !copy.step_to_next_event(within)?.impacts.is_empty();
        Ok(has_impact.then(|| copy.time()))
    }

    /// The persistent contacts with their forces, in the order of the ids of spheres, pairs of spheres first. A
    /// ball that lies on the floor has one. They are known under the rules `exact` and `contact` after a step; none
    /// are listed after a change to the world, or under other rules.
    ///
    /// ```
    /// use carom::{Collider, DVec3, Gravity, Pose, Settings, Shape, Sphere, World};
    ///
    /// let mut world = World::new(Settings::default())?;
    /// world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0)))?;
    /// world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)))?;
    /// world.add_sphere(Sphere::new(DVec3::new(0.0, 1.0, 0.0), 1.0).with_mass(2.0))?;
    /// world.step(1.0)?;
    /// assert!((world.contacts()[0].normal_force - 2.0 * 9.81).abs() < 1e-12);
    /// # Ok::<(), carom::Error>(())
    /// ```
    pub fn contacts(&self) -> Vec<PersistentContact> {
        self.state.persistent_contacts()
    }

    /// Sets the request that ends steps early once it is made; `None` removes it. Under the rule `exact` a step
    /// reads it every few milliseconds, under the others before it begins. It is not part of a snapshot; copies of
    /// the world share it.
    pub fn set_stop_request(&mut self, request: Option<StopRequest>) {
        self.stop_request = request;
    }

    /// The report of the last step.
    pub fn report(&self) -> &StepReport {
        &self.report
    }

    /// Whether spheres have been in stepped zones under the rule `exact`. If not, every impact was answered at its
    /// own time. [`StepReport::zone_account`] has the number for each step.
    pub fn was_stepped(&self) -> bool {
        self.state.was_stepped
    }

    /// Time since the start \[s\]: the sum of all steps.
    pub fn time(&self) -> f64 {
        self.state.clock.seconds()
    }

    /// Settings: the step rule, and values that all rules share.
    pub fn settings(&self) -> &Settings {
        &self.state.settings
    }

    /// Replaces the settings; later steps use them.
    ///
    /// # Errors [`Error::Invalid`] for an invalid parameter of the rule, or a periodic box with a force that does
    /// not suit it.
    pub fn set_settings(&mut self, settings: Settings) -> Result<(), Error> {
        settings
            .validate()
            .and_then(|()| {
                let mut forces = self.state.forces.iter();
                forces.try_for_each(|(_, force)| State::check_boundary(&settings, &**force))
            })
            .map_err(|invalid| invalid.about(Subject::Settings))?;
        self.state.changed().settings = settings;
        Ok(())
    }

    /// Adds a sphere. It may overlap others: see [`Self::overlaps`].
    ///
    /// # Errors [`Error::Invalid`] for an invalid number.
    pub fn add_sphere(&mut self, sphere: Sphere) -> Result<SphereId, Error> {
        let id = SphereId(self.state.next_id);
        sphere.validate().map_err(|invalid| invalid.about(Subject::Sphere(id)))?;
        let state = self.state.changed();
        state.spheres.push(id, &sphere);
        state.next_id += 1;
        Ok(id)
    }

    /// All spheres, as arrays.
    pub fn spheres(&self) -> &Spheres {
        &self.state.spheres
    }

    /// Returns a sphere.
    ///
    /// # Errors
    /// [`Error::Unknown`] if it is not in the world (any more).
    pub fn sphere(&self, id: SphereId) -> Result<Sphere, Error> {
        Ok(self.state.spheres.get(self.index_of(id)?))
    }

    /// Changes a sphere.
    ///
    /// # Errors [`Error::Unknown`] if it is not in the world, [`Error::Invalid`] for an invalid number.
    pub fn set_sphere(&mut self, id: SphereId, sphere: Sphere) -> Result<(), Error> {
        let index = self.index_of(id)?;
        sphere.validate().map_err(|invalid| invalid.about(Subject::Sphere(id)))?;
        self.state.changed().spheres.set(index, &sphere);
        Ok(())
    }

    /// Sets the velocity of a sphere \[m/s\]; its place and spin stay.
    ///
    /// # Errors
    /// [`Error::Unknown`] if it is not in the world, [`Error::Invalid`] for a velocity that is not finite.
    pub fn set_velocity(&mut self, id: SphereId, velocity: DVec3) -> Result<(), Error> {
        let position = self.sphere(id)?.position;
        self.set_motions(&[SphereMotion { id, position, velocity }])
    }

    /// Applies an impulse \[N s\] to a sphere at its centre: its velocity changes by the impulse over its mass.
    ///
    /// # Errors
    /// [`Error::Unknown`] if it is not in the world, [`Error::Invalid`] where the new velocity is not finite.
    ///
    /// ```
    /// use carom::{DVec3, Settings, Sphere, World};
    ///
    /// let mut world = World::new(Settings::default())?;
    /// let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_mass(2.0))?;
    /// world.apply_impulse(ball, DVec3::new(3.0, 0.0, 0.0))?;
    /// assert_eq!(world.sphere(ball)?.velocity, DVec3::new(1.5, 0.0, 0.0));
    /// # Ok::<(), carom::Error>(())
    /// ```
    pub fn apply_impulse(&mut self, id: SphereId, impulse: DVec3) -> Result<(), Error> {
        let sphere = self.sphere(id)?;
        self.set_velocity(id, sphere.velocity + impulse / sphere.kilograms())
    }

    /// Applies an impulse \[N s\] to a sphere at a point \[m\]: besides its velocity the angular velocity changes, by the
    /// torque about the centre over the moment of inertia.
    ///
    /// # Errors
    /// [`Error::Unknown`] if it is not in the world, [`Error::Invalid`] where a new quantity is not finite.
    ///
    /// ```
    /// use carom::{DVec3, Sphere, World};
    ///
    /// let mut world = World::default();
    /// let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_mass(2.0))?;
    /// world.apply_impulse_at(ball, DVec3::X, DVec3::new(0.0, 0.5, 0.0))?;
    /// // The moment of inertia of a solid ball is 2/5 m r², here 0.2 kg m².
    /// assert_eq!(world.sphere(ball)?.velocity, DVec3::new(0.5, 0.0, 0.0));
    /// assert_eq!(world.sphere(ball)?.angular_velocity, DVec3::new(0.0, 0.0, -2.5));
    /// # Ok::<(), carom::Error>(())
    /// ```
    pub fn apply_impulse_at(
        &mut self,
        id: SphereId,
        impulse: DVec3,
        point: DVec3,
    ) -> Result<(), Error> {
        let index = self.index_of(id)?;
        let sphere = self.state.spheres.get(index);
        let torque = (point - sphere.position).cross(impulse);
        let turned = torque / self.state.spheres.moment_of_inertia(index);
        let velocity = sphere.velocity + impulse / sphere.kilograms();
        let angular_velocity = sphere.angular_velocity + turned;
        self.set_sphere(id, Sphere { velocity, angular_velocity, ..sphere })
    }

    /// Sets the angular velocity of a sphere \[rad/s\]; its place, velocity and orientation stay.
    ///
    /// # Errors
    /// [`Error::Unknown`] if it is not in the world, [`Error::Invalid`] for one that is not finite.
    pub fn set_angular_velocity(
        &mut self,
        id: SphereId,
        angular_velocity: DVec3,
    ) -> Result<(), Error> {
        let sphere = self.sphere(id)?;
        self.set_sphere(id, Sphere { angular_velocity, ..sphere })
    }

    /// Sets positions and velocities of spheres; their spins do not change. Where forces are applied to single
    /// spheres ([`Self::set_applied_forces`]), the flights of the others continue, which makes this cheap.
    ///
    /// # Errors [`Error::Unknown`] if one is not in the world, [`Error::Invalid`] for an invalid number. Then no
    /// sphere moves.
    pub fn set_motions(&mut self, motions: &[SphereMotion]) -> Result<(), Error> {
        for &SphereMotion { id, position, velocity } in motions {
            self.index_of(id)?;
            validate::finite("position", position)
                .and_then(|()| validate::finite("velocity", velocity))
                .map_err(|invalid| invalid.about(Subject::Sphere(id)))?;
        }
        for &SphereMotion { id, position, velocity } in motions {
            let index = self.index_of(id)?;
            self.state.place(index, position, velocity);
        }
        Ok(())
    }

    /// Applies a separate force \[N\] to every sphere, in the order of [`Self::spheres`]; an empty list removes
    /// these forces. Each is constant until it is set again; spheres that are added later have none. They add to
    /// the forces that act on all, and have no potential energy.
    ///
    /// To steer spheres, set them before each frame: this costs little, under the rule `exact` too,
    /// which renews all flights at the start of a frame while there are such forces.
    ///
    /// # Errors
    /// [`Error::Invalid`] for another number of forces than spheres, or one that is not finite.
    pub fn set_applied_forces(&mut self, forces: &[DVec3]) -> Result<(), Error> {
        let (count, wanted) = (forces.len(), self.spheres().len());
        let requirement = "one for each sphere, or none at all";
        validate::require(count == wanted || count == 0, "applied forces", requirement, count)
            .map_err(|invalid| invalid.about(Subject::Step))?;
        for (force, &id) in forces.iter().zip(self.spheres().ids()) {
            validate::finite("applied force", *force)
                .map_err(|invalid| invalid.about(Subject::Sphere(id)))?;
        }
        let had_some = !self.spheres().applied_forces().is_empty();
        if !had_some || count == 0 {
            self.state.changed();
        }
        let applied = &mut self.state.spheres.properties.applied_force;
        applied.clear();
        applied.extend_from_slice(forces);
        Ok(())
    }

    /// Sets the clock. Only emitters, motions of colliders and forces that depend on time read it; but different
    /// times round differently. A run that sets the clock back depends on nothing before, to the bit.
    ///
    /// # Errors [`Error::Invalid`] if the time is not finite, or there are emitters, which depend on it.
    pub fn set_time(&mut self, seconds: f64) -> Result<(), Error> {
        let has_emitters = self.state.emitters.iter().len() > 0;
        validate::require(seconds.is_finite(), "time", "finite", seconds)
            .and_then(|()| {
                validate::require(
                    !has_emitters,
                    "time",
                    "left alone where emitters count it",
                    seconds,
                )
            })
            .map_err(|invalid| invalid.about(Subject::Step))?;
        self.state.set_time(seconds);
        Ok(())
    }

    /// Removes a sphere from the world, with its springs, and returns it.
    ///
    /// # Errors
    /// [`Error::Unknown`] if it is not in the world.
    pub fn remove_sphere(&mut self, id: SphereId) -> Result<Sphere, Error> {
        let index = self.index_of(id)?;
        let sphere = self.state.spheres.get(index);
        self.state.remove_spheres(&[id]);
        Ok(sphere)
    }

    /// Removes spheres from the world, with their springs. Later ones move up in the arrays.
    ///
    /// # Errors [`Error::Unknown`] if one of them is not in it; then none is removed.
    pub fn remove_spheres(&mut self, ids: &[SphereId]) -> Result<(), Error> {
        ids.iter().try_for_each(|&id| self.index_of(id).map(|_| ()))?;
        if !ids.is_empty() {
            self.state.remove_spheres(ids);
        }
        Ok(())
    }

    fn index_of(&self, id: SphereId) -> Result<usize, Error> {
        self.state.spheres.index_of(id).ok_or(Error::Unknown(Subject::Sphere(id)))
    }

    /// Adds a collider, after those already there.
    ///
    /// # Errors [`Error::Invalid`] for an invalid number.
    pub fn add_collider(&mut self, collider: Collider) -> Result<ColliderId, Error> {
        let id = ColliderId(self.state.colliders.list().next_number());
        collider.validate().map_err(|invalid| invalid.about(Subject::Collider(id)))?;
        self.state.colliders_mut().push(collider);
        Ok(id)
    }

    /// All colliders, in their order.
    pub fn colliders(&self) -> impl ExactSizeIterator<Item = (ColliderId, &Collider)> {
        self.state.colliders.list().iter().map(|(number, it)| (ColliderId(number), it))
    }

    /// Returns a collider.
    ///
    /// # Errors
    /// [`Error::Unknown`] if there is no such collider.
    pub fn collider(&self, id: ColliderId) -> Result<Collider, Error> {
        let collider = self.state.colliders.list().get(id.0).cloned();
        collider.ok_or(Error::Unknown(Subject::Collider(id)))
    }

    /// Changes a collider. It keeps its place in the order.
    ///
    /// # Errors
    /// [`Error::Unknown`] if there is no such collider, [`Error::Invalid`] for an invalid number.
    pub fn set_collider(&mut self, id: ColliderId, collider: Collider) -> Result<(), Error> {
        self.set_colliders(&[(id, collider)])
    }

    /// Changes several colliders at once. Surfaces are placed once for all of them: moving many
    /// colliders together costs as much as moving one.
    ///
    /// # Errors
    /// As [`Self::set_collider`]; then none is changed.
    pub fn set_colliders(&mut self, changes: &[(ColliderId, Collider)]) -> Result<(), Error> {
        for (id, collider) in changes {
            self.check_collider(*id, collider)?;
        }
        self.state.colliders_mut().set(changes);
        Ok(())
    }

    /// Checks a change of a collider; returns the error that [`Self::set_collider`] would return.
    ///
    /// # Errors
    /// As [`Self::set_collider`].
    pub fn check_collider(&self, id: ColliderId, collider: &Collider) -> Result<(), Error> {
        let subject = Subject::Collider(id);
        self.state.colliders.list().get(id.0).ok_or(Error::Unknown(subject))?;
        collider.validate().map_err(|invalid| invalid.about(subject))
    }

    /// Removes a collider from the world and returns it.
    ///
    /// # Errors
    /// [`Error::Unknown`] if there is no such collider.
    pub fn remove_collider(&mut self, id: ColliderId) -> Result<Collider, Error> {
        self.state.colliders_mut().remove(id).ok_or(Error::Unknown(Subject::Collider(id)))
    }

    /// Adds an emitter; its first sphere is due now.
    ///
    /// # Errors [`Error::Invalid`] for an invalid number.
    pub fn add_emitter(&mut self, emitter: Emitter) -> Result<EmitterId, Error> {
        let id = EmitterId(self.state.emitters.next_number());
        emitter.validate().map_err(|invalid| invalid.about(Subject::Emitter(id)))?;
        let time = self.time();
        self.state.emitters.push(EmitterState::new(emitter, time));
        Ok(id)
    }

    /// All emitters, in the order in which they emit.
    pub fn emitters(&self) -> impl ExactSizeIterator<Item = (EmitterId, &Emitter)> {
        self.state.emitters.iter().map(|(number, state)| (EmitterId(number), &state.emitter))
    }

    /// Changes an emitter. The next sphere is of the new kind. With another period the emitter starts again now; a
    /// finished one emits what a larger `count` adds from now on.
    ///
    /// # Errors [`Error::Unknown`] if there is no such emitter, [`Error::Invalid`] for an invalid number.
    pub fn set_emitter(&mut self, id: EmitterId, emitter: Emitter) -> Result<(), Error> {
        let time = self.time();
        let unknown = Error::Unknown(Subject::Emitter(id));
        let state = self.state.emitters.get_mut(id.0).ok_or(unknown)?;
        emitter.validate().map_err(|invalid| invalid.about(Subject::Emitter(id)))?;
        state.set(emitter, time);
        Ok(())
    }

    /// Removes an emitter from the world and returns it; its spheres stay.
    ///
    /// # Errors
    /// [`Error::Unknown`] if there is no such emitter.
    pub fn remove_emitter(&mut self, id: EmitterId) -> Result<Emitter, Error> {
        let removed = self.state.emitters.remove(id.0);
        removed.map(|state| state.emitter).ok_or(Error::Unknown(Subject::Emitter(id)))
    }
}
