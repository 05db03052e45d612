//! The session or comparison of a driver.

use carom::{DVec3, SphereId, StateHash, StopRequest};
use carom_scene::scene::{Scene, Simulation};

use crate::comparison::Comparison;
use crate::edit::Edit;
use crate::error::SessionError;
use crate::link::Link;
use crate::session::Session;
use crate::view::View;

/// The session or comparison of a driver.
#[derive(Debug)]
pub enum Watched {
    /// One session.
    One(Box<Session>),
    /// Two runs of one scene.
    Two(Box<Comparison>),
}

impl From<Session> for Watched {
    fn from(session: Session) -> Self {
        Self::One(Box::new(session))
    }
}

impl From<Comparison> for Watched {
    fn from(comparison: Comparison) -> Self {
        Self::Two(Box::new(comparison))
    }
}

impl Watched {
    /// Opens the run of a link, or both of two side by side, and starts to go to its time.
    ///
    /// # Errors
    /// The same as those of [`Session::replay`], for either run.
    pub fn replay(scene: Scene, link: &Link) -> Result<Self, SessionError> {
        Ok(match link.second() {
            Some((rule, second)) => Comparison::replay(scene, link, (rule, &second))?.into(),
            None => Session::replay(scene, link)?.into(),
        })
    }

    /// The session, or the first of two.
    pub fn session(&self) -> &Session {
        match self {
            Self::One(session) => session,
            Self::Two(comparison) => comparison.first(),
        }
    }

    /// Opens the same scene under two simulations, or under the present first one only, and starts
    /// to go to the present time. All changes are repeated except those of the simulation.
    ///
    /// # Errors
    /// [`SessionError::Scene`] if the scene is invalid under one of them, [`SessionError::Repeat`]
    /// if a change at the beginning is refused, and those of [`Session::frame_at`].
    pub fn compared(&self, simulations: Option<&[Simulation; 2]>) -> Result<Self, SessionError> {
        let session = self.session();
        let mut compared = match simulations {
            Some(simulations) => Self::from(Comparison::under(session, simulations)?),
            None => Self::from(session.under(&session.setup().simulation)?),
        };
        compared.seek(compared.session().frame_at(session.time())?);
        Ok(compared)
    }

    /// Sets a request that ends steps early; see [`Session::set_stop_request`].
    pub fn set_stop_request(&mut self, request: Option<StopRequest>) {
        match self {
            Self::One(session) => session.set_stop_request(request),
            Self::Two(comparison) => comparison.set_stop_request(request),
        }
    }

    /// Takes one frame; see [`Session::step`].
    ///
    /// # Errors
    /// Those of [`Session::step`].
    pub fn step(&mut self) -> Result<(), SessionError> {
        match self {
            Self::One(session) => session.step(),
            Self::Two(comparison) => comparison.step(),
        }
    }

    /// Starts to go to a frame; see [`Session::seek`].
    pub fn seek(&mut self, frame: u64) {
        match self {
            Self::One(session) => session.seek(frame),
            Self::Two(comparison) => comparison.seek(frame),
        }
    }

    /// Frame to which it is going; see [`Session::seeking`].
    pub fn seeking(&self) -> Option<u64> {
        match self {
            Self::One(session) => session.seeking(),
            Self::Two(comparison) => comparison.first().seeking().or(comparison.second().seeking()),
        }
    }

    /// Takes frames towards the target; see [`Session::advance_seek`].
    ///
    /// # Errors
    /// Those of [`Session::advance_seek`].
    pub fn advance_seek(&mut self, budget: u64) -> Result<bool, SessionError> {
        match self {
            Self::One(session) => session.advance_seek(budget),
            Self::Two(comparison) => comparison.advance_seek(budget),
        }
    }

    /// Stops going to a frame; see [`Session::stop_seeking`].
    ///
    /// # Errors
    /// The same as those of [`Comparison::stop_seeking`].
    pub fn stop_seeking(&mut self) -> Result<(), SessionError> {
        match self {
            Self::One(session) => {
                session.stop_seeking();
                Ok(())
            }
            Self::Two(comparison) => comparison.stop_seeking(),
        }
    }

    /// Makes an edit; see [`Session::edit`] and [`Comparison::edit`].
    ///
    /// # Errors
    /// Those of [`Session::edit`].
    pub fn edit(&mut self, edit: Edit) -> Result<(), SessionError> {
        match self {
            Self::One(session) => session.edit(edit),
            Self::Two(comparison) => comparison.edit(&edit),
        }
    }

    /// Continues the last edit; see [`Session::edit_further`] and [`Comparison::edit_further`].
    ///
    /// # Errors
    /// Those of [`Session::edit`].
    pub fn edit_further(&mut self, edit: Edit) -> Result<(), SessionError> {
        match self {
            Self::One(session) => session.edit_further(edit),
            Self::Two(comparison) => comparison.edit_further(&edit),
        }
    }

    /// Moves a sphere of the second of two runs by `displacement` \[m\]; a single run gets a copy
    /// beside it first.
    ///
    /// # Errors
    /// Those of [`Session::edit`].
    pub(crate) fn nudge(
        &mut self,
        sphere: SphereId,
        displacement: DVec3,
    ) -> Result<(), SessionError> {
        match self {
            Self::One(session) => {
                *self = Comparison::beside_nudged(session, sphere, displacement)?.into();
                Ok(())
            }
            Self::Two(comparison) => comparison.nudge(sphere, displacement),
        }
    }

    /// Undoes the last manual edit; see [`Session::undo`].
    pub fn undo(&mut self) -> bool {
        match self {
            Self::One(session) => session.undo(),
            Self::Two(comparison) => comparison.undo(),
        }
    }

    /// Repeats the edit that was undone last; see [`Session::redo`].
    pub fn redo(&mut self) -> bool {
        match self {
            Self::One(session) => session.redo(),
            Self::Two(comparison) => comparison.redo(),
        }
    }

    /// Restarts with edited values; see [`Session::restart_with_values`].
    pub fn restart_with_values(&mut self) {
        match self {
            Self::One(session) => session.restart_with_values(),
            Self::Two(comparison) => comparison.restart_with_values(),
        }
    }

    /// Picks a sphere to follow; see [`Session::pick`].
    pub fn pick(&mut self, sphere: Option<SphereId>) {
        match self {
            Self::One(session) => session.pick(sphere),
            Self::Two(comparison) => comparison.pick(sphere),
        }
    }

    /// Copies everything that an interface shows.
    pub fn fill(&self, view: &mut View) {
        match self {
            Self::One(session) => {
                session.fill(view);
                view.other = None;
                view.distances.clear();
            }
            Self::Two(comparison) => comparison.fill(view),
        }
    }

    /// Copies the persistent contacts if `are_shown`; otherwise the view gets none.
    pub(crate) fn fill_contacts(&self, view: &mut View, are_shown: bool) {
        let contacts = |session: &Session| {
            if are_shown { session.world().contacts() } else { Vec::new() }
        };
        view.contacts = contacts(self.session());
        if let (Self::Two(comparison), Some(other)) = (self, &mut view.other) {
            other.contacts = contacts(comparison.second());
        }
    }

    /// State hashes of the session, or of both.
    pub fn state_hashes(&self) -> (StateHash, Option<StateHash>) {
        match self {
            Self::One(session) => (session.state_hash(), None),
            Self::Two(comparison) => {
                (comparison.first().state_hash(), Some(comparison.second().state_hash()))
            }
        }
    }
}
