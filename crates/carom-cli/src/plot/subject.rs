//! What the command `plot` can show.

use carom_session::View;
use carom_session::figures::{self, Figure};
use clap::ValueEnum;

/// A quantity that is plotted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Subject {
    /// Kinetic, potential and total energy of all balls.
    Energy,
    /// Components and size of the momentum of all balls.
    Momentum,
    /// Impacts per second.
    Impacts,
    /// Balls by their speed at the end, beside the distribution of Maxwell and Boltzmann.
    Speeds,
    /// Temperature and, in a closed container or a periodic box, pressure of the balls as a gas.
    Gas,
    /// Pair tests, events and iterations of the solver in each frame.
    Work,
    /// Height of the ball.
    Height,
    /// Speed of the ball.
    Speed,
    /// Coordinates of the ball.
    Position,
    /// Components of the velocity of the ball.
    Velocity,
    /// Velocity of the ball over its position, along x.
    PhaseX,
    /// The same along y.
    PhaseY,
    /// The same along z.
    PhaseZ,
}

impl Subject {
    /// Whether it is a quantity of one ball.
    pub fn needs_ball(self) -> bool {
        match self {
            Self::Energy | Self::Momentum | Self::Impacts => false,
            Self::Speeds | Self::Gas | Self::Work => false,
            Self::Height | Self::Speed | Self::Position | Self::Velocity => true,
            Self::PhaseX | Self::PhaseY | Self::PhaseZ => true,
        }
    }

    /// Returns the figures of a run.
    pub fn figures(self, view: &View) -> Vec<Figure> {
        match self {
            Self::Energy => vec![figures::energies(view)],
            Self::Momentum => vec![figures::momenta(view)],
            Self::Impacts => vec![figures::impact_rate(view)],
            Self::Speeds => vec![figures::speeds(view)],
            Self::Gas => figures::thermodynamics(view),
            Self::Work => figures::work(view),
            Self::Height => vec![figures::height(view)],
            Self::Speed => vec![figures::speed(view)],
            Self::Position => vec![figures::position(view)],
            Self::Velocity => vec![figures::velocity(view)],
            Self::PhaseX => vec![figures::phase_space(view, 0)],
            Self::PhaseY => vec![figures::phase_space(view, 1)],
            Self::PhaseZ => vec![figures::phase_space(view, 2)],
        }
    }
}
