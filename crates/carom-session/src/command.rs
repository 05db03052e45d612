//! Commands to a driver.

use carom::{DVec3, SphereId};
use carom_scene::scene::{Scene, Simulation};

use crate::aim::Aim;
use crate::edit::Edit;
use crate::link::Link;

/// A command to a driver. Commands are executed in the order in which they arrive; those that do
/// not depend on the time are executed even during a seek. A command that fails changes nothing,
/// and the next view contains its error.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Command {
    /// Starts to play.
    Play,
    /// Stops playing.
    Pause,
    /// Stops playing and takes one frame.
    Step,
    /// Stops playing and goes back by one frame.
    StepBack,
    /// Goes back to the beginning; continues to play if it played.
    Restart,
    /// Goes to the frame nearest to this time \[s\]; continues to play if it played. Another
    /// command that goes to a time replaces it; edits and steps wait until it has arrived.
    Seek(f64),
    /// Stops going to a time, at the frame reached. Waiting commands are executed there.
    StopSeeking,
    /// Sets the speed, in simulated seconds per second, between [`SLOWEST`](crate::SLOWEST) and
    /// [`FASTEST`](crate::FASTEST).
    Speed(f64),
    /// Makes an edit. An edit of the same thing within a second of the last one continues it, as
    /// dragging a slider does; see [`Session::edit_further`](crate::Session::edit_further).
    Edit(Edit),
    /// Makes an edit that continues the last one, whatever it was; both are undone together.
    EditFurther(Edit),
    /// Undoes the last manual edit and goes to its frame; does nothing if there is none.
    Undo,
    /// Repeats the edit that was undone last and goes to its frame; does nothing if there is none.
    Redo,
    /// Goes back to the beginning with the values that were edited during the whole run; see
    /// [`Session::restart_with_values`](crate::Session::restart_with_values).
    RestartWithValues,
    /// Follows another sphere, or none.
    Pick(Option<SphereId>),
    /// Sets whether views contain the state hash, which takes time to compute.
    ShowStateHash(bool),
    /// Sets whether views contain the persistent contacts with their forces, which take time to
    /// compute.
    ShowContacts(bool),
    /// Sets what views predict the path of: a ball that is aimed, or none.
    Aim(Option<Aim>),
    /// Opens another scene; continues to play if it played.
    Open(Box<Scene>),
    /// Opens the scene of a link, goes to the time of the link and makes its changes at their
    /// frames; continues to play if it played.
    Replay(Box<Scene>, Box<Link>),
    /// Shows the scene under two simulations side by side, with the frame length of the first, or
    /// under the first only. The time remains, and all changes are repeated except those of the
    /// simulation.
    Compare(Option<Box<[Simulation; 2]>>),
    /// Shows a copy of the present run beside it, with this sphere moved by this vector \[m\]; of two runs,
    /// moves the sphere of the second.
    Nudge(SphereId, DVec3),
}

impl Command {
    /// Whether the command goes to another time or scene, so that an earlier seek becomes useless.
    pub(crate) fn goes_elsewhere(&self) -> bool {
        match self {
            Self::Restart | Self::Seek(_) | Self::StopSeeking => true,
            Self::Open(_) | Self::Replay(..) => true,
            Self::Play | Self::Pause | Self::Step | Self::StepBack | Self::Speed(_) => false,
            Self::Edit(_) | Self::EditFurther(_) | Self::Pick(_) => false,
            Self::Undo | Self::Redo | Self::RestartWithValues => false,
            Self::Compare(_) | Self::Nudge(..) => false,
            Self::ShowStateHash(_) | Self::ShowContacts(_) | Self::Aim(_) => false,
        }
    }

    /// Whether the command concerns display and playback only, so that it need not wait for the end
    /// of a seek.
    pub(crate) fn is_of_any_time(&self) -> bool {
        matches!(self, Self::Play | Self::Pause | Self::Speed(_) | Self::Pick(_))
            || matches!(self, Self::ShowStateHash(_) | Self::ShowContacts(_) | Self::Aim(_))
    }

    /// Whether the command interrupts the current frame.
    #[cfg(not(target_arch = "wasm32"))]
    pub(crate) fn stops_frame(&self) -> bool {
        matches!(self, Self::Pause | Self::StepBack | Self::Undo | Self::RestartWithValues)
            || self.goes_elsewhere()
    }

    /// Merges this command with a `later` one that directly follows it; `None` if both are needed.
    pub(crate) fn merged(&self, later: &Self) -> Option<Self> {
        match (self, later) {
            (Self::Edit(edit), Self::Edit(next)) => edit.merged(next).map(Self::Edit),
            (Self::EditFurther(edit), Self::EditFurther(next)) => {
                edit.merged(next).map(Self::EditFurther)
            }
            (Self::Play | Self::Pause, Self::Play | Self::Pause)
            | (Self::Restart | Self::Seek(_), Self::Restart | Self::Seek(_))
            | (Self::Speed(_), Self::Speed(_))
            | (Self::Pick(_), Self::Pick(_))
            | (Self::Compare(_), Self::Compare(_))
            | (Self::Aim(_), Self::Aim(_))
            | (Self::ShowStateHash(_), Self::ShowStateHash(_))
            | (Self::ShowContacts(_), Self::ShowContacts(_)) => Some(later.clone()),
            _ => None,
        }
    }
}
