//! Hands that play, for tests.
#![allow(dead_code, reason = "no test uses all of them")]

use carom_pinball::{Game, Keys};

/// Random keys: each is held or let go for a random number of frames.
pub struct Fingers {
    state: u64,
    keys: Keys,
}

impl Fingers {
    pub fn new(seed: u64) -> Self {
        let state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
        Self { state, keys: Keys::NONE }
    }

    /// Xorshift (Marsaglia, J. Stat. Softw. 8 (2003)).
    fn next(&mut self) -> u64 {
        self.state ^= self.state << 13;
        self.state ^= self.state >> 7;
        self.state ^= self.state << 17;
        self.state
    }

    /// Changes the key of a flipper every eighth frame on average, that of the plunger every fortieth.
    pub fn press(&mut self) -> Keys {
        let dice = self.next() >> 16;
        self.keys.left ^= dice.is_multiple_of(8);
        self.keys.right ^= (dice >> 8).is_multiple_of(8);
        self.keys.plunger ^= (dice >> 16).is_multiple_of(40);
        self.keys
    }
}

/// Pulls the plunger for a number of frames, and lets go.
pub fn shoot(game: &mut Game, frames: u32) {
    for _ in 0..frames {
        game.step(Keys { plunger: true, ..Keys::NONE }).unwrap();
    }
    for _ in 0..6 {
        game.step(Keys::NONE).unwrap();
    }
}
