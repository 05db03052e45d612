//! Links: a run in the form of an address, to be had again elsewhere.

mod address;
mod error;
mod packed;
mod parse;
mod written;

use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

use carom_scene::scene::Scene;
use carom_scene::{BUILT_IN_FILES, Library, Override, SceneError};

use crate::Session;
use crate::change::PastChange;
use crate::view::View;

pub use error::{LinkError, PackedError};
pub use packed::MAX_UNPACKED;

/// Address of the page that opens links, where it is served on this machine.
pub const LOCAL_PAGE: &str = "http://127.0.0.1:8042/";

/// What errors call a scene file without a name.
const NAMELESS: &str = "scene file";

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
    source: LinkSource,
    overrides: Vec<Override>,
    /// Ascending by frame.
    changes: Arc<Vec<PastChange>>,
    /// \[s\]
    time: Option<f64>,
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
        Self { source, overrides: Vec::new(), changes: Arc::default(), time: None }
    }

    /// To the beginning of this scene: a built-in one goes by its name, with its rule where it has
    /// another; any other is written out.
    pub fn to_scene(scene: &Scene) -> Self {
        as_built_in(scene).unwrap_or_else(|| {
            let (name, text) = (scene.name.clone(), scene.to_toml());
            Self::new(LinkSource::File { name, text })
        })
    }

    /// The same with these values different in the scene, after those that were.
    pub fn with_overrides(mut self, overrides: impl IntoIterator<Item = Override>) -> Self {
        self.overrides.extend(overrides);
        self
    }

    /// The same, come to another time \[s\].
    ///
    /// # Errors
    /// [`LinkError::Time`] for a time that is negative or not finite.
    pub fn with_time(mut self, seconds: f64) -> Result<Self, LinkError> {
        self.time = Some(parse::checked_time(seconds)?);
        Ok(self)
    }

    /// The same, come to a frame, where each lasts for `frame_time` \[s\].
    ///
    /// # Errors
    /// [`LinkError::Time`] if the time of that frame is none.
    pub fn with_frame(self, frame: u64, frame_time: f64) -> Result<Self, LinkError> {
        self.with_time(address::readable(frame as f64 * frame_time, frame_time))
    }

    /// The same scene, come to where this view of it is, by the same changes.
    pub fn at(&self, view: &View) -> Self {
        self.come_to((view.frame, view.time), &view.scene, &view.changes)
    }

    /// The same `scene`, come to a frame at a time \[s\], by those of these changes that came before.
    fn come_to(&self, now: (u64, f64), scene: &Scene, changes: &Arc<Vec<PastChange>>) -> Self {
        let (frame, time) = now;
        let made = changes.partition_point(|it| it.frame <= frame);
        let changes =
            if made == changes.len() { changes.clone() } else { changes[..made].to_vec().into() };
        let time = Some(address::readable(time, shortest_frame(scene, &changes)));
        Self { changes, time, ..self.clone() }
    }

    /// Reads a link: a whole address, or the part of it after `#`.
    ///
    /// # Errors
    /// [`LinkError`], but not for what is wrong in a scene; [`Self::open`] says that.
    pub fn parse(text: &str) -> Result<Self, LinkError> {
        parse::link(text)
    }

    /// The part of an address after `#`.
    pub fn to_fragment(&self) -> String {
        address::fragment(self)
    }

    /// The scene at its beginning.
    ///
    /// # Errors
    /// [`LinkError::Scene`] if there is no such scene, or with what is wrong in it.
    pub fn open(&self) -> Result<Scene, LinkError> {
        let scene = match &self.source {
            LinkSource::BuiltIn(name) => built_in(name, &self.overrides),
            LinkSource::File { name, text } => {
                let name = if name.is_empty() { NAMELESS } else { name };
                Scene::from_toml_with(text, name, &self.overrides)
            }
        };
        Ok(scene?)
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
}

impl FromStr for Link {
    type Err = LinkError;

    fn from_str(text: &str) -> Result<Self, LinkError> {
        Self::parse(text)
    }
}

impl fmt::Display for Link {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.to_fragment())
    }
}

impl View {
    /// A link to what it shows. Where the scene was opened from a link, [`Link::at`] of that link
    /// is shorter.
    pub fn link(&self) -> Link {
        Link::to_scene(&self.scene).at(self)
    }
}

impl Session {
    /// A link to the present.
    pub fn link(&self) -> Link {
        let now = (self.frame(), self.time());
        Link::to_scene(self.scene()).come_to(now, self.scene(), self.changes())
    }
}

/// A scene by the name of a built-in one with the same values but for its rule, if there is one.
fn as_built_in(scene: &Scene) -> Option<Link> {
    let mut own = built_in(&scene.name, &[]).ok()?;
    let link = Link::new(LinkSource::BuiltIn(own.name.clone()));
    if own == *scene {
        return Some(link);
    }
    own.simulation.rule = scene.simulation.rule;
    let rule = parse::rule_override(scene.simulation.rule.name()).ok()?;
    (own == *scene).then(|| link.with_overrides([rule]))
}

/// A built-in scene by name or title. A link must not reach for files by their path, as
/// [`Library::find`] does.
fn built_in(name: &str, overrides: &[Override]) -> Result<Scene, SceneError> {
    let wanted = name.to_lowercase();
    let is_wanted = |file: &str| file.strip_suffix(".toml").is_some_and(|own| own == wanted);
    if let Some((file, text)) = BUILT_IN_FILES.iter().find(|(file, _)| is_wanted(file)) {
        return Scene::from_toml_with(text, file, overrides);
    }
    let is_path = name.ends_with(".toml") || name.contains(['/', '\\']);
    if is_path {
        return Err(SceneError::Unknown { name: name.to_owned(), nearest: None });
    }
    Ok(Library::new().find(name, overrides)?.0)
}

/// The shortest frame \[s\] of a run.
fn shortest_frame(scene: &Scene, changes: &[PastChange]) -> f64 {
    let later = changes.iter().filter_map(|it| it.change.frame_time());
    later.fold(scene.simulation.frame_time, f64::min)
}
