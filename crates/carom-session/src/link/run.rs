//! What a link says: which run, and how far it has come.

use std::sync::Arc;

use carom_scene::Override;

use super::camera::LinkCamera;
use super::error::LinkError;
use super::time::{checked_time, readable};
use crate::change::PastChange;

/// A run that can be had again elsewhere, to the bit: which scene, what is different in it, what
/// was changed on the way, and the time it has come to.
///
/// It is written as the fragment of an address, the part after `#`, which no browser sends to a
/// server, in parts `name=value` with `&` between them:
///
/// | part | is |
/// |---|---|
/// | `scene` | name of a built-in scene |
/// | `file` | instead of it, a whole scene file, packed |
/// | `name` | what errors call that file |
/// | `set` | an [`Override`], may be repeated |
/// | `rule` | short for an override of `simulation.rule` |
/// | `edits` | what was changed on the way, as TOML, packed |
/// | `t` | the time \[s\] it has come to |
/// | `camera` | `x,y,z` of a place to look from and of one to look at \[m\], and the vertical field of view \[°\] where it is not 35 |
///
/// Packed is text compressed by zlib in base64 with the alphabet for addresses, without padding.
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
    /// Ascending by frame.
    pub(super) changes: Arc<Vec<PastChange>>,
    /// \[s\]
    pub(super) time: Option<f64>,
    pub(super) camera: Option<LinkCamera>,
}

/// The scene of a link.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LinkSource {
    /// A built-in scene, by name or title.
    BuiltIn(String),
    /// A scene file.
    File {
        /// What errors call it.
        name: String,
        /// All of it.
        text: String,
    },
}

impl Link {
    /// To the beginning of a scene as it is.
    pub fn new(source: LinkSource) -> Self {
        Self { source, overrides: Vec::new(), changes: Arc::default(), time: None, camera: None }
    }

    /// This run with these values different in the scene, after those that were.
    pub fn with_overrides(mut self, overrides: impl IntoIterator<Item = Override>) -> Self {
        self.overrides.extend(overrides);
        self
    }

    /// This run, come to another time \[s\].
    ///
    /// # Errors
    /// [`LinkError::Time`] for a time that is negative or not finite.
    pub fn with_time(mut self, seconds: f64) -> Result<Self, LinkError> {
        self.time = Some(checked_time(seconds)?);
        Ok(self)
    }

    /// This run, come to a frame, where each lasts for `frame_time` \[s\].
    ///
    /// # Errors
    /// [`LinkError::Time`] if the time of that frame is none.
    pub fn with_frame(self, frame: u64, frame_time: f64) -> Result<Self, LinkError> {
        self.with_time(readable(frame as f64 * frame_time, frame_time))
    }

    /// Has the run looked at from another place; from where its scene says without one.
    pub fn set_camera(&mut self, camera: Option<LinkCamera>) {
        self.camera = camera;
    }

    /// Its scene.
    pub fn source(&self) -> &LinkSource {
        &self.source
    }

    /// What is different in it.
    pub fn overrides(&self) -> &[Override] {
        &self.overrides
    }

    /// What was changed on the way, ascending by frame.
    pub fn changes(&self) -> &Arc<Vec<PastChange>> {
        &self.changes
    }

    /// The time it has come to \[s\]; `None` where it leaves that open.
    pub fn time(&self) -> Option<f64> {
        self.time
    }

    /// Where it is looked at from; `None` where it leaves that open.
    pub fn camera(&self) -> Option<LinkCamera> {
        self.camera
    }
}
