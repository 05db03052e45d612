//! Queue of commands.

use std::collections::VecDeque;

use crate::command::Command;
use crate::error::SessionError;

/// Most waiting commands: far more than a user sends during a frame, and little memory.
pub(crate) const MOST_WAITING: usize = 256;

/// Waiting commands, in order. Commands made obsolete by the next one are merged with it, so that
/// dragging a slider during a long frame leaves one edit.
#[derive(Debug, Default)]
pub(crate) struct Queue(VecDeque<Command>);

impl Queue {
    /// Appends a command.
    ///
    /// # Errors
    /// [`SessionError::Busy`] if the queue is full; the command is then discarded.
    pub fn push(&mut self, command: Command) -> Result<(), SessionError> {
        if let Some(last) = self.0.back_mut()
            && let Some(merged) = last.merged(&command)
        {
            *last = merged;
            return Ok(());
        }
        if self.0.len() >= MOST_WAITING {
            return Err(SessionError::Busy);
        }
        self.0.push_back(command);
        Ok(())
    }

    /// Removes the next command if it is wanted.
    pub fn pop_if(&mut self, is_wanted: impl Fn(&Command) -> bool) -> Option<Command> {
        if self.0.front().is_some_and(is_wanted) { self.0.pop_front() } else { None }
    }

    /// Removes the first wanted command, even if others wait before it.
    pub fn take_first(&mut self, is_wanted: impl Fn(&Command) -> bool) -> Option<Command> {
        let found = self.0.iter().position(is_wanted)?;
        self.0.remove(found)
    }

    /// Moves waiting commands from another queue, as far as there is room.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn take_from(&mut self, other: &mut Self) {
        while self.0.len() < MOST_WAITING
            && let Some(command) = other.0.pop_front()
        {
            self.0.push_back(command);
        }
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}
