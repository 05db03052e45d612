//! The rules of nine-ball: what a shot is worth, and who plays next.

use crate::error::MoveError;
use crate::shot::{CUE, Shot};

/// The ball that wins.
pub const NINE: u8 = 9;

/// Object balls that have to reach a cushion in a break that pockets none.
const RAILED_IN_BREAK: usize = 4;

/// Fouls of one player in a row that lose the rack.
const MOST_FOULS: u8 = 3;

/// Why a shot is against the rules.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Foul {
    /// The cue ball fell into a pocket or left the table.
    Scratch,
    /// The cue ball met no ball.
    NoHit,
    /// The cue ball met another ball before the lowest.
    WrongBall {
        /// The ball that it met.
        hit: u8,
        /// The lowest ball on the table.
        lowest: u8,
    },
    /// An object ball left the table.
    OffTable,
    /// A break pocketed no ball and drove fewer than four object balls to a cushion.
    WeakBreak,
    /// No ball was pocketed, and none reached a cushion after the cue ball had met a ball.
    NoRail,
}

/// Where the player may put the cue ball before the shot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BallInHand {
    /// Nowhere: it stays where it is.
    No,
    /// Behind the head string.
    BehindHeadString,
    /// Anywhere on the table.
    Anywhere,
}

/// What the next move of a rack has to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// The first shot.
    Break,
    /// The shot after a break without a foul, which may be a push-out.
    AfterBreak,
    /// A shot that was declared a push-out.
    PushOut,
    /// The answer to a push-out: who shoots?
    Answer,
    /// Any other shot.
    Open,
    /// None: the rack is won.
    Won,
}

/// What the rules say of a shot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Verdict {
    /// The foul, if the shot was one.
    pub foul: Option<Foul>,
    /// Whether the nine is put back onto the table.
    pub spots_nine: bool,
    /// Whether the same player goes on.
    pub continues: bool,
    /// The player who has won the rack.
    pub winner: Option<usize>,
}

/// A rack of nine-ball: the balls on the table, the players and their fouls.
///
/// The rules are those of the World Pool-Billiard Association (Rules of Play, chapters 2 and 6): the cue ball meets the
/// lowest ball first, then a ball is pocketed or reaches a cushion; who pockets the nine without a foul wins. The shot
/// after the break may be a push-out. After a foul the other player has the cue ball in hand; the third foul in a row
/// loses. One player alone goes on after fouls.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rack {
    players: usize,
    shooter: usize,
    stage: Stage,
    in_hand: BallInHand,
    on_table: [bool; NINE as usize + 1],
    fouls_in_row: [u8; 2],
    shots: u32,
    fouls: u32,
    winner: Option<usize>,
}

impl Rack {
    /// Creates a rack that player `breaker` of one or two `players` begins; players count from 0.
    ///
    /// # Errors
    /// [`MoveError::Players`] for another number of players, or a breaker that is none of them.
    pub fn new(players: usize, breaker: usize) -> Result<Self, MoveError> {
        if !(1..=2).contains(&players) || breaker >= players {
            return Err(MoveError::Players);
        }
        Ok(Self {
            players,
            shooter: breaker,
            stage: Stage::Break,
            in_hand: BallInHand::BehindHeadString,
            on_table: [true; NINE as usize + 1],
            fouls_in_row: [0; 2],
            shots: 0,
            fouls: 0,
            winner: None,
        })
    }

    /// Declares the next shot a push-out, which may meet any ball or none.
    ///
    /// # Errors
    /// [`MoveError::PushOut`] but for the shot after a break without a foul.
    pub fn push_out(&mut self) -> Result<(), MoveError> {
        match self.stage {
            Stage::AfterBreak => self.stage = Stage::PushOut,
            _ => return Err(MoveError::PushOut),
        }
        Ok(())
    }

    /// Answers a push-out: the player at the table shoots, or leaves the shot to the one who pushed out.
    ///
    /// # Errors
    /// [`MoveError::Answer`] unless there was a push-out.
    pub fn answer(&mut self, shoots: bool) -> Result<(), MoveError> {
        if self.stage != Stage::Answer {
            return Err(MoveError::Answer);
        }
        self.stage = Stage::Open;
        if !shoots {
            self.shooter = self.other();
        }
        Ok(())
    }

    /// Judges a shot, and goes on to the next.
    ///
    /// # Errors
    /// [`MoveError::Shot`] if no shot is due: the rack is won, or a push-out waits for its answer.
    pub fn judge(&mut self, shot: &Shot) -> Result<Verdict, MoveError> {
        if matches!(self.stage, Stage::Answer | Stage::Won) {
            return Err(MoveError::Shot);
        }
        let foul = self.foul(shot);
        let is_push = self.stage == Stage::PushOut;
        let has_nine = shot.pocketed.contains(&NINE);
        let wins = has_nine && foul.is_none() && !is_push;
        let spots_nine = !wins && (has_nine || shot.off_table.contains(&NINE));
        for ball in shot.pocketed.iter().chain(&shot.off_table) {
            if let Some(is_there) = self.on_table.get_mut(usize::from(*ball)) {
                *is_there = *ball == CUE;
            }
        }
        self.on_table[usize::from(NINE)] |= spots_nine;
        self.count(foul);
        self.winner = match foul {
            None if wins => Some(self.shooter),
            Some(_) if self.fouls_in_row[self.shooter] == MOST_FOULS && self.players > 1 => {
                Some(self.other())
            }
            _ => None,
        };
        let continues = foul.is_none() && !is_push && !shot.pocketed.is_empty();
        self.go_on(foul, continues);
        Ok(Verdict { foul, spots_nine, continues, winner: self.winner })
    }

    /// Returns the first foul of a shot, in the order in which the rules name them.
    fn foul(&self, shot: &Shot) -> Option<Foul> {
        if shot.pocketed.contains(&CUE) || shot.off_table.contains(&CUE) {
            return Some(Foul::Scratch);
        }
        if !shot.off_table.is_empty() {
            return Some(Foul::OffTable);
        }
        if self.stage == Stage::PushOut {
            return None;
        }
        let lowest = self.lowest();
        match shot.first_hit {
            None => return Some(Foul::NoHit),
            Some(hit) if hit != lowest => return Some(Foul::WrongBall { hit, lowest }),
            Some(_) => {}
        }
        if !shot.pocketed.is_empty() {
            return None;
        }
        let railed = shot.railed.iter().filter(|ball| **ball != CUE).count();
        match self.stage {
            Stage::Break => (railed < RAILED_IN_BREAK).then_some(Foul::WeakBreak),
            _ => shot.railed.is_empty().then_some(Foul::NoRail),
        }
    }

    /// Counts the shot, and the fouls in a row of the player.
    fn count(&mut self, foul: Option<Foul>) {
        self.shots += 1;
        let in_row = &mut self.fouls_in_row[self.shooter];
        match foul {
            Some(_) => {
                *in_row = (*in_row + 1).min(MOST_FOULS);
                self.fouls += 1;
            }
            None => *in_row = 0,
        }
    }

    /// Sets who shoots next, from where and under which rule.
    fn go_on(&mut self, foul: Option<Foul>, continues: bool) {
        self.in_hand = if foul.is_some() { BallInHand::Anywhere } else { BallInHand::No };
        self.stage = match (self.winner, foul, self.stage) {
            (Some(_), ..) => Stage::Won,
            (None, None, Stage::Break) => Stage::AfterBreak,
            (None, None, Stage::PushOut) if self.players > 1 => Stage::Answer,
            _ => Stage::Open,
        };
        if !continues && self.winner.is_none() {
            self.shooter = self.other();
        }
    }

    /// Returns the player who is not at the table; alone, the only one.
    fn other(&self) -> usize {
        (self.shooter + 1) % self.players
    }

    /// Returns the lowest ball on the table, which the cue ball has to meet first.
    pub fn lowest(&self) -> u8 {
        (1..NINE).find(|ball| self.has(*ball)).unwrap_or(NINE)
    }

    /// Returns whether a ball is on the table.
    pub fn has(&self, ball: u8) -> bool {
        self.on_table.get(usize::from(ball)).copied().unwrap_or(false)
    }

    /// Returns what the next move has to be.
    pub fn stage(&self) -> Stage {
        self.stage
    }

    /// Returns where the player may put the cue ball.
    pub fn in_hand(&self) -> BallInHand {
        self.in_hand
    }

    /// Returns the player at the table.
    pub fn shooter(&self) -> usize {
        self.shooter
    }

    /// Returns the number of players.
    pub fn players(&self) -> usize {
        self.players
    }

    /// Returns how many shots in a row of a player were fouls.
    pub fn fouls_in_row(&self, player: usize) -> u8 {
        self.fouls_in_row.get(player).copied().unwrap_or(0)
    }

    /// Returns the shots of all players, each foul counted as one more.
    pub fn strokes(&self) -> u32 {
        self.shots + self.fouls
    }

    /// Returns the player who has won.
    pub fn winner(&self) -> Option<usize> {
        self.winner
    }
}
