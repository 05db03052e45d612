//! The commands of a driver.

use carom::SphereId;
use carom_scene::scene::{Scene, Simulation};

use crate::edit::Edit;
use crate::link::Link;

/// A command to a driver. The driver obeys commands in the order in which they arrive, but does not
/// let those wait on the way elsewhere that can be obeyed at any time; one that fails says why in the
/// next view, and changes nothing.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Command {
    /// Let time go on.
    Play,
    /// Let time stand still.
    Pause,
    /// Stop, and take one frame.
    Step,
    /// Stop, and go back by one frame.
    StepBack,
    /// Go back to the beginning; time goes on from there, if it did.
    Restart,
    /// Go to the frame nearest to this time \[s\]; time goes on from there, if it did. Another
    /// command that goes elsewhere takes its place; changes and steps wait until it is there.
    Seek(f64),
    /// Give up going elsewhere: stay where it has come to. What waits is done there.
    StopSeeking,
    /// Simulated seconds per second, between [`SLOWEST`](crate::SLOWEST) and
    /// [`FASTEST`](crate::FASTEST).
    Speed(f64),
    /// Make a change. One that follows another of the same thing within a second goes on with it,
    /// as a slider does that is dragged; see [`Session::edit_further`](crate::Session::edit_further).
    Edit(Edit),
    /// Take back the last change by hand, and go where it was made; nothing if there is none.
    Undo,
    /// Make the change again that was taken back last, and go where it was made; nothing if there is
    /// none.
    Redo,
    /// Go back to the beginning with the values that were changed in the whole run; see
    /// [`Session::restart_with_values`](crate::Session::restart_with_values).
    RestartWithValues,
    /// Follow another sphere, or none.
    Pick(Option<SphereId>),
    /// Whether views have the state as a number, which takes time to make.
    ShowStateHash(bool),
    /// Whether views have the persistent contacts with their forces, which take time to solve for.
    ShowContacts(bool),
    /// Open another scene; time goes on there, if it did.
    Open(Box<Scene>),
    /// Open a scene, the one of a link, and go where the link leads, changing on the way what was
    /// changed there; time goes on from there, if it did.
    Replay(Box<Scene>, Box<Link>),
    /// Show the scene under two simulations side by side, frames being as long as the first one says,
    /// or alone under the first again; at the time of now, with all changes but those of the simulation.
    Compare(Option<Box<[Simulation; 2]>>),
}

impl Command {
    /// Whether it goes elsewhere by itself, so that going elsewhere before it is in vain.
    pub(crate) fn goes_elsewhere(&self) -> bool {
        match self {
            Self::Restart | Self::Seek(_) | Self::StopSeeking => true,
            Self::Open(_) | Self::Replay(..) => true,
            Self::Play | Self::Pause | Self::Step | Self::StepBack | Self::Speed(_) => false,
            Self::Edit(_) | Self::Pick(_) => false,
            Self::Undo | Self::Redo | Self::RestartWithValues | Self::Compare(_) => false,
            Self::ShowStateHash(_) | Self::ShowContacts(_) => false,
        }
    }

    /// Whether it is about the way things are shown and played, whatever the time: it need not wait
    /// until a way elsewhere has come to its end.
    pub(crate) fn is_of_any_time(&self) -> bool {
        matches!(self, Self::Play | Self::Pause | Self::Speed(_) | Self::Pick(_))
            || matches!(self, Self::ShowStateHash(_) | Self::ShowContacts(_))
    }

    /// Whether a frame at work is given up for it.
    #[cfg(not(target_arch = "wasm32"))]
    pub(crate) fn stops_frame(&self) -> bool {
        matches!(self, Self::Pause | Self::StepBack | Self::Undo | Self::RestartWithValues)
            || self.goes_elsewhere()
    }

    /// One command instead of this one and a `later` one right after it; `None` if it takes both.
    pub(crate) fn merged(&self, later: &Self) -> Option<Self> {
        match (self, later) {
            (Self::Edit(edit), Self::Edit(next)) => edit.merged(next).map(Self::Edit),
            (Self::Play | Self::Pause, Self::Play | Self::Pause)
            | (Self::Restart | Self::Seek(_), Self::Restart | Self::Seek(_))
            | (Self::Speed(_), Self::Speed(_))
            | (Self::Pick(_), Self::Pick(_))
            | (Self::Compare(_), Self::Compare(_))
            | (Self::ShowStateHash(_), Self::ShowStateHash(_))
            | (Self::ShowContacts(_), Self::ShowContacts(_)) => Some(later.clone()),
            _ => None,
        }
    }
}
