//! Comparison of two runs of one scene: under two rules, or of one and a nudged copy.

use carom::{DVec3, SphereId, StopRequest};
use carom_scene::SceneError;
use carom_scene::scene::{Rule, Scene, Simulation};

use crate::distance::Distance;
use crate::edit::{Edit, SphereChange};
use crate::error::SessionError;
use crate::history::DEFAULT_MEMORY;
use crate::link::Link;
use crate::series::Series;
use crate::session::Session;
use crate::view::{View, replace};

/// Two sessions of one scene, under two rules or one. Every change is made in both, and both are at
/// the same frame.
#[derive(Debug)]
pub struct Comparison {
    first: Session,
    second: Session,
    distances: Series<Distance>,
}

impl Comparison {
    /// Opens a scene under each of two rules.
    ///
    /// # Errors
    /// [`SceneError`] if the scene is invalid under one of them.
    pub fn new(scene: &Scene, rules: [Rule; 2]) -> Result<Self, SceneError> {
        let [first, second] = rules.map(|rule| {
            let mut scene = scene.clone();
            scene.simulation.rule = rule;
            Session::new(scene)
        });
        Ok(Self::of(first?, second?))
    }

    /// Opens the two runs of a link, and starts to go to its time in both.
    ///
    /// # Errors
    /// The same as those of [`Session::replay`], for either run.
    pub(crate) fn replay(
        scene: Scene,
        link: &Link,
        (rule, second): (Rule, &Link),
    ) -> Result<Self, SessionError> {
        let mut beside = scene.clone();
        beside.simulation.rule = rule;
        Ok(Self::of(Session::replay(scene, link)?, Session::replay(beside, second)?))
    }

    /// Opens the scene of a session under two simulations, at the beginning, with the frame length
    /// of the first. All changes of the session are repeated at their times, except those of the
    /// simulation.
    ///
    /// # Errors
    /// The same as those of [`Session::under`], for either simulation.
    pub(crate) fn under(
        session: &Session,
        [first, second]: &[Simulation; 2],
    ) -> Result<Self, SessionError> {
        let second = Simulation { frame_time: first.frame_time, ..second.clone() };
        Ok(Self::of(session.under(first)?, session.under(&second)?))
    }

    /// Puts a copy beside a session, in which a sphere is moved by `displacement` \[m\] at the
    /// present frame.
    ///
    /// # Errors
    /// The same as those of [`Self::nudge`].
    pub(crate) fn beside_nudged(
        session: &Session,
        sphere: SphereId,
        displacement: DVec3,
    ) -> Result<Self, SessionError> {
        let mut comparison = Self::of(session.clone(), session.clone());
        comparison.nudge(sphere, displacement)?;
        Ok(comparison)
    }

    fn of(first: Session, second: Session) -> Self {
        let mut comparison = Self { first, second, distances: Series::default() };
        comparison.set_memory(DEFAULT_MEMORY);
        comparison.measure();
        comparison
    }

    /// Session under the first rule.
    pub fn first(&self) -> &Session {
        &self.first
    }

    /// Session under the second rule.
    pub fn second(&self) -> &Session {
        &self.second
    }

    /// Sets a limit on the memory for the past of both \[bytes\].
    pub fn set_memory(&mut self, bytes: usize) {
        self.first.set_memory(bytes / 2);
        self.second.set_memory(bytes / 2);
    }

    /// Sets a request that ends steps of both early; see [`carom::World::set_stop_request`].
    pub fn set_stop_request(&mut self, request: Option<StopRequest>) {
        self.first.set_stop_request(request.clone());
        self.second.set_stop_request(request);
    }

    /// Distance between both worlds at present.
    pub fn distance(&self) -> Distance {
        Distance::between(self.first.world(), self.second.world())
    }

    /// Distances between both worlds up to the present.
    pub fn distances(&self) -> impl Iterator<Item = &Distance> {
        self.distances.until(self.first.frame()).iter().map(|(_, distance)| distance)
    }

    /// Takes one frame in each session.
    ///
    /// # Errors
    /// The same as those of [`Session::step`]; then neither has moved.
    pub fn step(&mut self) -> Result<(), SessionError> {
        let stepped = self.first.step().and_then(|()| self.second.step());
        if let Err(error) = stepped {
            // The first may have moved, or the second, if it then refused a change.
            self.stop_seeking()?;
            return Err(error);
        }
        self.measure();
        Ok(())
    }

    /// Starts to go to a frame; [`Self::advance_seek`] goes there.
    pub fn seek(&mut self, frame: u64) {
        self.first.seek(frame);
        self.second.seek(frame);
    }

    /// Takes up to `budget` frames, counted over both, towards the frame of [`Self::seek`]. Returns
    /// whether both have arrived.
    ///
    /// # Errors
    /// The same as those of [`Session::advance_seek`]; then both stop at the same frame.
    pub fn advance_seek(&mut self, budget: u64) -> Result<bool, SessionError> {
        for _ in 0..budget {
            let behind = match (self.first.seeking(), self.second.seeking()) {
                (None, None) => break,
                (Some(_), None) => &mut self.first,
                (None, Some(_)) => &mut self.second,
                _ if self.first.frame() <= self.second.frame() => &mut self.first,
                _ => &mut self.second,
            };
            if let Err(error) = behind.advance_seek(1) {
                self.stop_seeking()?;
                return Err(error);
            }
            if self.first.frame() == self.second.frame() {
                self.measure();
            }
        }
        Ok(self.first.seeking().is_none() && self.second.seeking().is_none())
    }

    /// Stops going to a frame; both stay at the frame of the slower one.
    ///
    /// # Errors
    /// Only those that these frames had when they were first taken.
    pub fn stop_seeking(&mut self) -> Result<(), SessionError> {
        let frame = self.first.frame().min(self.second.frame());
        for session in [&mut self.first, &mut self.second] {
            session.seek(frame);
            session.advance_seek(u64::MAX)?;
        }
        Ok(())
    }

    /// Makes an edit in both. An edit of the simulation changes only the fields that differ from
    /// the first session's, and each session keeps its own rule.
    ///
    /// # Errors
    /// The same as those of [`Session::edit`], if one of them refuses it; then neither changes.
    pub fn edit(&mut self, edit: &Edit) -> Result<(), SessionError> {
        self.edit_both(edit, Session::edit)
    }

    /// Makes an edit in both that continues the last one; see [`Session::edit_further`].
    ///
    /// # Errors
    /// The same as those of [`Self::edit`].
    pub fn edit_further(&mut self, edit: &Edit) -> Result<(), SessionError> {
        self.edit_both(edit, Session::edit_further)
    }

    /// Moves a sphere of the second session by `displacement` \[m\]. The first gets the same edit
    /// without a displacement, so that nothing else differs.
    ///
    /// # Errors
    /// The same as those of [`Session::edit`]; then neither changes.
    pub(crate) fn nudge(
        &mut self,
        sphere: SphereId,
        displacement: DVec3,
    ) -> Result<(), SessionError> {
        let moved_by = |session: &Session, displacement: DVec3| {
            let position = session.world().sphere(sphere)?.position + displacement;
            let change = SphereChange { position: Some(position), ..SphereChange::default() };
            Ok::<_, SessionError>(Edit::Sphere(sphere, Box::new(change)))
        };
        let first = moved_by(&self.first, DVec3::ZERO)?;
        let second = moved_by(&self.second, displacement)?;
        self.second.check(&second)?;
        self.first.edit(first)?;
        self.second.edit(second)?;
        self.measure_anew();
        Ok(())
    }

    fn edit_both(
        &mut self,
        edit: &Edit,
        make: impl Fn(&mut Session, Edit) -> Result<(), SessionError>,
    ) -> Result<(), SessionError> {
        let before = &self.first.setup().simulation;
        let [first, second] = [&self.first, &self.second].map(|session| own(edit, before, session));
        self.second.check(&second)?;
        make(&mut self.first, first)?;
        make(&mut self.second, second)?;
        self.measure_anew();
        Ok(())
    }

    /// Undoes the last manual edit in both; see [`Session::undo`].
    pub fn undo(&mut self) -> bool {
        let done = self.first.undo() & self.second.undo();
        self.measure_anew();
        done
    }

    /// Repeats in both the edit that was undone last; see [`Session::redo`].
    pub fn redo(&mut self) -> bool {
        let done = self.first.redo() & self.second.redo();
        self.measure_anew();
        done
    }

    /// Goes back to the beginning of both with the present values; see
    /// [`Session::restart_with_values`].
    pub fn restart_with_values(&mut self) {
        self.first.restart_with_values();
        self.second.restart_with_values();
        self.measure_anew();
    }

    /// Follows a sphere in both.
    pub fn pick(&mut self, sphere: Option<SphereId>) {
        self.first.pick(sphere);
        self.second.pick(sphere);
    }

    /// Copies both to a view: the first directly, the second as [`View::other`].
    pub fn fill(&self, view: &mut View) {
        self.first.fill(view);
        self.second.fill(view.other.get_or_insert_default());
        replace(&mut view.distances, self.distances().copied());
        let now = self.distance();
        view.distances.pop_if(|last| last.time >= now.time);
        view.distances.push(now);
    }

    /// Removes distances that are no longer valid, and measures the present one if both are at one
    /// frame.
    fn measure_anew(&mut self) {
        match self.first.frame().min(self.second.frame()).checked_sub(1) {
            Some(before) => self.distances.cut(before),
            None => self.distances.clear(),
        }
        if self.first.frame() == self.second.frame() {
            self.measure();
        }
    }

    fn measure(&mut self) {
        let frame = self.first.frame();
        if self.distances.wants(frame) {
            let distance = self.distance();
            self.distances.push(frame, distance);
        }
    }
}

/// Converts an edit of the first session, whose simulation was `before`, for a session with another
/// rule.
fn own(edit: &Edit, before: &Simulation, session: &Session) -> Edit {
    let Edit::Simulation(edited) = edit else { return edit.clone() };
    let mut own = session.setup().simulation.clone();
    macro_rules! take_over_what_is_changed {
        ($($field:ident),*) => {
            $(if edited.$field != before.$field {
                own.$field = edited.$field.clone();
            })*
        };
    }
    take_over_what_is_changed!(
        dimensions,
        frame_time,
        duration,
        spheres_collide,
        combine_rule,
        friction_combine_rule,
        allow_overlap,
        boundary,
        thermostat,
        pair_potential,
        exact,
        bisect,
        discrete,
        contact
    );
    Edit::Simulation(Box::new(own))
}
