//! What the player presses.

use crate::role::Role;

/// The keys that are pressed in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Keys {
    /// Raises the left flipper.
    pub left: bool,
    /// Raises the right flipper.
    pub right: bool,
    /// Pulls the plunger, which shoots the ball when it is let go.
    pub plunger: bool,
}

impl Keys {
    /// No key.
    pub const NONE: Self = Self { left: false, right: false, plunger: false };

    /// Returns whether the key of a lever with this role is pressed.
    pub(crate) fn press(self, role: Role) -> bool {
        match role {
            Role::LeftFlipper => self.left,
            Role::RightFlipper => self.right,
            Role::Plunger => self.plunger,
            _ => false,
        }
    }
}
