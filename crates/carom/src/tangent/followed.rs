//! A world whose steps are followed for their derivatives.

use super::error::DerivativeError;
use super::margin::Margin;
use super::replay::Piece;
use super::start::Start;
use crate::id::SphereId;
use crate::world::World;

/// Time over which derivatives were followed, and the impacts in it.
#[derive(Debug, Clone)]
pub(super) struct Followed {
    pub ids: Vec<SphereId>,
    pub margin: Margin,
    /// Start of the derivatives on the world's clock \[s\].
    pub began: f64,
    /// Time since the start of the derivatives \[s\].
    elapsed: f64,
    /// Time of the last impact of each sphere since the start of the derivatives \[s\]; minus infinity if it had
    /// none.
    last_impacts: Vec<f64>,
    lost: Option<DerivativeError>,
}

impl Followed {
    /// Starts with the present state of a world.
    pub fn start(world: &World) -> Result<Self, DerivativeError> {
        let ids = Start::of(world)?.ids;
        let last_impacts = vec![f64::NEG_INFINITY; ids.len()];
        let (margin, began) = (Margin::default(), world.time());
        Ok(Self { ids, margin, began, elapsed: 0.0, last_impacts, lost: None })
    }

    /// Advances the world by `dt` \[s\]. Returns the flights and impacts of the step as linear maps.
    pub fn step(&mut self, world: &mut World, dt: f64) -> Result<Vec<Piece>, DerivativeError> {
        self.check()?;
        let start = Start::of(world)?;
        if start.ids != self.ids {
            return Err(DerivativeError::Changed);
        }
        let before = world.time();
        let log = world.step_with_log(dt)?;
        let pieces = start.pieces(world, log, self.elapsed);
        let pieces = pieces.inspect_err(|error| self.lost = Some(error.clone()))?;
        self.last_impacts.resize(world.spheres().ids().len(), f64::NEG_INFINITY);
        for piece in &pieces {
            match piece {
                Piece::Impact(it) => {
                    self.margin.look_at(it, self.began, &mut self.last_impacts);
                }
                Piece::Group(it) => {
                    self.margin.look_at_group(it, self.began, &mut self.last_impacts);
                }
                Piece::Departure(it) => {
                    self.margin.look_at_directness(it.directness(), (it.id, self.began + it.time));
                }
                Piece::Passage(it) => {
                    self.margin.look_at_directness(it.directness(), (it.id, self.began + it.time));
                }
                _ => {}
            }
        }
        self.elapsed += world.time() - before;
        // Spheres that were added come last.
        self.ids.clear();
        self.ids.extend(world.spheres().ids());
        Ok(pieces)
    }

    /// Ends the derivatives with an error.
    pub fn lose(&mut self, error: DerivativeError) {
        self.lost = Some(error);
    }

    /// Returns the error that an earlier step ended with, if any.
    pub fn check(&self) -> Result<(), DerivativeError> {
        self.lost.clone().map_or(Ok(()), Err)
    }

    /// Returns the index of a sphere in the arrays of the world.
    pub fn place_of(&self, sphere: SphereId) -> Result<usize, DerivativeError> {
        self.ids.binary_search(&sphere).map_err(|_| DerivativeError::UnknownSphere(sphere))
    }
}
