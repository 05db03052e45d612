//! A world whose steps are followed for their derivatives.

use super::error::DerivativeError;
use super::margin::Margin;
use super::replay::Piece;
use super::start::Start;
use crate::id::SphereId;
use crate::world::World;

/// How far a world was followed.
#[derive(Debug, Clone)]
pub(super) struct Followed {
    pub ids: Vec<SphereId>,
    pub margin: Margin,
    /// When this began, on the world's clock \[s\].
    began: f64,
    /// Since then \[s\].
    elapsed: f64,
    /// The last impact of each sphere \[s\] since then; minus infinity if it had none.
    last_impacts: Vec<f64>,
    lost: Option<DerivativeError>,
}

impl Followed {
    /// Begins with a world as it is now.
    pub fn start(world: &World) -> Result<Self, DerivativeError> {
        let ids = Start::of(world)?.ids;
        let last_impacts = vec![f64::NEG_INFINITY; ids.len()];
        let (margin, began) = (Margin::default(), world.time());
        Ok(Self { ids, margin, began, elapsed: 0.0, last_impacts, lost: None })
    }

    /// Advances the world by `dt` \[s\]. Returns the pieces of the step.
    pub fn step(&mut self, world: &mut World, dt: f64) -> Result<Vec<Piece>, DerivativeError> {
        self.check()?;
        let start = Start::of(world)?;
        if start.ids != self.ids {
            return Err(DerivativeError::Changed);
        }
        let before = world.time();
        let supports = world.step_noting_supports(dt)?;
        let pieces = start.pieces(world, supports, self.elapsed);
        let pieces = pieces.inspect_err(|error| self.lost = Some(error.clone()))?;
        for piece in &pieces {
            if let Piece::Impact(saltation) = piece {
                self.margin.look_at(saltation, self.began, &mut self.last_impacts);
            }
        }
        self.elapsed += world.time() - before;
        Ok(pieces)
    }

    /// Refuses to go on where there is no derivative any more.
    pub fn check(&self) -> Result<(), DerivativeError> {
        self.lost.clone().map_or(Ok(()), Err)
    }

    /// The place of a sphere in the arrays of the world.
    pub fn place_of(&self, sphere: SphereId) -> Result<usize, DerivativeError> {
        self.ids.binary_search(&sphere).map_err(|_| DerivativeError::UnknownSphere(sphere))
    }
}
