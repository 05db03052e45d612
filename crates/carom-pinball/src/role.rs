//! Roles of colliders on a table.

/// Role of a collider in the game.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The lever that the left key raises.
    LeftFlipper,
    /// The lever that the right key raises.
    RightFlipper,
    /// The lever that shoots the ball when its key is let go.
    Plunger,
    /// A collider that kicks the ball, for many points.
    Bumper,
    /// A collider that kicks the ball, for few points.
    Slingshot,
    /// A trigger that lights up when the ball rolls over it. The number is its index among the targets.
    Target(usize),
    /// The trigger that takes the ball.
    Drain,
    /// Anything else.
    Fixed,
}
