//! Content of a link: a scene, its changes, and the time reached.

use std::sync::Arc;

use carom_scene::Override;
use carom_scene::scene::Rule;

use super::camera::LinkCamera;
use super::error::{LinkError, MAX_MOVES};
use super::time::{checked_time, readable};
use crate::change::PastChange;

/// A run that can be reproduced elsewhere, bit for bit: scene, overrides, changes during the run,
/// and the time reached.
///
/// It is written as the fragment of an address, the part after `#`, which browsers do not send to
/// servers. Its parts `name=value` are separated by `&`:
///
/// | part | content |
/// |---|---|
/// | `scene` | name of a built-in scene |
/// | `file` | a whole scene file instead, packed |
/// | `name` | name of that file in errors |
/// | `set` | an [`Override`], may be repeated |
/// | `rule` | short for an override of `simulation.rule` |
/// | `edits` | changes during the run, as TOML, packed |
/// | `beside` | rule of a second run of the scene, side by side with the first |
/// | `beside-edits` | changes during the second run, if they are not those of the first |
/// | `t` | time reached \[s\] |
/// | `camera` | `x,y,z` of the camera and of the point that it looks at \[m\], and the vertical field of view \[°\] if it is not 35 |
/// | `goal` | result to beat in a game: points, strokes, or a time \[s\] |
/// | `moves` | moves of the player who reached it, as the game writes them, packed |
///
/// Packed text is compressed by zlib and written in URL-safe base64 without padding.
///
/// ```
/// use carom_session::{Link, Session};
///
/// let link: Link = "http://127.0.0.1:8042/#scene=simtest1&rule=exact&t=0.5".parse()?;
/// let mut session = Session::replay(link.open()?, &link)?;
/// session.advance_seek(u64::MAX)?;
/// assert_eq!(session.frame(), 25);
/// assert_eq!(session.link().to_fragment(), "scene=simtest1&rule=exact&t=0.5");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    pub(super) source: LinkSource,
    pub(super) overrides: Vec<Override>,
    /// Changes, ascending by frame.
    pub(super) changes: Arc<Vec<PastChange>>,
    /// The second of two runs side by side.
    pub(super) beside: Option<Beside>,
    /// Time reached \[s\].
    pub(super) time: Option<f64>,
    pub(super) camera: Option<LinkCamera>,
    /// Result to beat in a game: points, strokes, or a time \[s\].
    pub(super) goal: Option<f64>,
    /// Moves that reach the result to beat, as the game writes them.
    pub(super) moves: Option<Arc<str>>,
}

/// The second of two runs of one scene, side by side, as far as it differs from the first.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Beside {
    /// Rule of the second run.
    pub rule: Rule,
    /// Changes of the second run, ascending by frame.
    pub changes: Arc<Vec<PastChange>>,
}

/// The scene of a link.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LinkSource {
    /// A built-in scene, by name or title.
    BuiltIn(String),
    /// A scene file.
    File {
        /// Name of the file in errors.
        name: String,
        /// Text of the file.
        text: String,
    },
}

impl Link {
    /// Creates a link to the beginning of a scene.
    pub fn new(source: LinkSource) -> Self {
        Self {
            source,
            overrides: Vec::new(),
            changes: Arc::default(),
            beside: None,
            time: None,
            camera: None,
            goal: None,
            moves: None,
        }
    }

    /// Adds overrides after the present ones.
    pub fn with_overrides(mut self, overrides: impl IntoIterator<Item = Override>) -> Self {
        self.overrides.extend(overrides);
        self
    }

    /// Sets the time reached \[s\].
    ///
    /// # Errors
    /// [`LinkError::Time`] if the time is negative or not finite.
    pub fn with_time(mut self, seconds: f64) -> Result<Self, LinkError> {
        self.time = Some(checked_time(seconds)?);
        Ok(self)
    }

    /// Sets the time reached to that of a frame, with frames of `frame_time` \[s\].
    ///
    /// # Errors
    /// [`LinkError::Time`] if the time of that frame is not finite.
    pub fn with_frame(self, frame: u64, frame_time: f64) -> Result<Self, LinkError> {
        self.with_time(readable(frame as f64 * frame_time, frame_time))
    }

    /// Sets the camera; `None` for the camera of the scene.
    pub fn set_camera(&mut self, camera: Option<LinkCamera>) {
        self.camera = camera;
    }

    /// Sets the result to beat in a game: points, strokes, or a time \[s\].
    ///
    /// # Errors
    /// [`LinkError::Goal`] if the result is negative or not finite.
    pub fn with_goal(mut self, goal: f64) -> Result<Self, LinkError> {
        self.goal = Some(checked_goal(goal)?);
        Ok(self)
    }

    /// Sets the moves that reach the result to beat, as the game writes them.
    ///
    /// # Errors
    /// [`LinkError::Moves`] if the text is longer than [`MAX_MOVES`].
    pub fn with_moves(mut self, moves: &str) -> Result<Self, LinkError> {
        self.moves = Some(checked_moves(moves)?);
        Ok(self)
    }

    /// Removes the result to beat, and the moves that reach it.
    pub fn without_goal(mut self) -> Self {
        (self.goal, self.moves) = (None, None);
        self
    }

    /// Scene of the link.
    pub fn source(&self) -> &LinkSource {
        &self.source
    }

    /// Overrides of the scene.
    pub fn overrides(&self) -> &[Override] {
        &self.overrides
    }

    /// Changes during the run, ascending by frame.
    pub fn changes(&self) -> &Arc<Vec<PastChange>> {
        &self.changes
    }

    /// Rule of the second of two runs side by side, and the link to that run; `None` for a single
    /// run.
    pub(crate) fn second(&self) -> Option<(Rule, Self)> {
        let Beside { rule, changes } = self.beside.clone()?;
        Some((rule, Self { changes, beside: None, ..self.clone() }))
    }

    /// Time reached \[s\], if the link states it.
    pub fn time(&self) -> Option<f64> {
        self.time
    }

    /// Camera, if the link states one.
    pub fn camera(&self) -> Option<LinkCamera> {
        self.camera
    }

    /// Result to beat in a game, if the link states one: points, strokes, or a time \[s\].
    pub fn goal(&self) -> Option<f64> {
        self.goal
    }

    /// Moves that reach the result to beat, if the link has them.
    pub fn moves(&self) -> Option<&str> {
        self.moves.as_deref()
    }
}

/// Returns the moves if they are short enough.
pub(super) fn checked_moves(moves: &str) -> Result<Arc<str>, LinkError> {
    if moves.len() > MAX_MOVES { Err(LinkError::Moves) } else { Ok(moves.into()) }
}

/// Returns the result to beat if it is valid.
pub(super) fn checked_goal(goal: f64) -> Result<f64, LinkError> {
    if goal >= 0.0 && goal.is_finite() {
        Ok(goal.abs())
    } else {
        Err(LinkError::Goal { found: format!("{goal:?}") })
    }
}
