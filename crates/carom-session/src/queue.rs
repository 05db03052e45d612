//! Commands that wait to be obeyed.

use std::collections::VecDeque;

use crate::command::Command;
use crate::error::SessionError;

/// Most commands that wait: far more than a user sends on purpose while a frame is taken, far less
/// than would be felt in memory.
pub(crate) const MOST_WAITING: usize = 256;

/// Commands that wait, in order. Those that a next one makes needless are left out, so that a
/// slider that is dragged while a long frame is taken leaves one edit.
#[derive(Debug, Default)]
pub(crate) struct Queue(VecDeque<Command>);

impl Queue {
    /// Appends a command.
    ///
    /// # Errors
    /// [`SessionError::Busy`] if there is no place; the command is not taken then.
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

    /// Takes the next command, if it is one of those wanted.
    pub fn pop_if(&mut self, is_wanted: impl Fn(&Command) -> bool) -> Option<Command> {
        if self.0.front().is_some_and(is_wanted) { self.0.pop_front() } else { None }
    }

    /// Takes the first of the commands that are wanted, whatever waits before it.
    pub fn take_first(&mut self, is_wanted: impl Fn(&Command) -> bool) -> Option<Command> {
        let found = self.0.iter().position(is_wanted)?;
        self.0.remove(found)
    }

    /// Takes over what waits in another queue, as far as there is place.
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
