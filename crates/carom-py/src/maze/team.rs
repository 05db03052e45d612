//! Many episodes on several threads.

use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

use carom_maze::{Arena, EpisodeError, Episodes, Outcome, Start};
use rayon::prelude::*;

use super::results::{Ended, Results, Rows};
use crate::failure::Failure;
use crate::threads::{self, Pool};

/// Number of balls per block, few enough for a thread's cache.
const BALLS_IN_A_BLOCK: usize = 512;

/// What happens after an episode ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Autoreset {
    /// The next step starts a new episode and ignores the action.
    NextStep,
    /// The step that ends an episode starts a new one.
    SameStep,
    /// The episode stays ended.
    Disabled,
}

/// Many episodes in blocks that threads share. No result depends on the number of threads.
#[derive(Debug)]
pub struct Team {
    arena: Arc<Arena>,
    blocks: Vec<Block>,
    /// `None` if one thread does everything.
    pool: Option<Pool>,
    autoreset: Autoreset,
    /// Where episodes start by default.
    start: Start,
    /// Total time of all steps \[s\].
    seconds: f64,
}

/// Episodes that one thread steps.
#[derive(Debug)]
struct Block {
    episodes: Episodes,
    /// Episodes that ended in the last step, if that step starts new ones.
    ended: Ended,
    /// Balls to be reset; working memory.
    over: Vec<usize>,
}

impl Team {
    /// Makes episodes of `count` balls on this number of threads; `None`: as many as processors.
    ///
    /// # Errors
    /// [`Failure`] for no balls, and if threads cannot be started.
    pub fn new(
        arena: Arena,
        count: usize,
        threads: Option<usize>,
        (autoreset, start): (Autoreset, Start),
    ) -> Result<Self, Failure> {
        if count == 0 {
            return Err(Failure::value("num_envs", "must be at least 1, not 0"));
        }
        let arena = Arc::new(arena);
        let block = |first: usize| {
            let balls = BALLS_IN_A_BLOCK.min(count - first);
            let episodes = Episodes::new(Arc::clone(&arena), balls)?;
            Ok(Block { episodes, ended: Ended::default(), over: Vec::new() })
        };
        let blocks: Vec<Block> =
            (0..count).step_by(BALLS_IN_A_BLOCK).map(block).collect::<Result<_, EpisodeError>>()?;
        let pool = threads::pool(threads, blocks.len())?;
        Ok(Self { arena, blocks, pool, autoreset, start, seconds: 0.0 })
    }

    pub fn arena(&self) -> &Arena {
        &self.arena
    }

    /// Returns the number of balls.
    pub fn len(&self) -> usize {
        self.blocks.iter().map(|block| block.episodes.len()).sum()
    }

    /// Returns the episodes that contain a ball, and its index there.
    pub fn find(&self, ball: usize) -> Option<(&Episodes, usize)> {
        let block = self.blocks.get(ball / BALLS_IN_A_BLOCK)?;
        let place = ball % BALLS_IN_A_BLOCK;
        (place < block.episodes.len()).then_some((&block.episodes, place))
    }

    /// Takes a step; there must be an action for each ball.
    ///
    /// # Errors
    /// [`Failure`] if a number would overflow.
    pub fn step(&mut self, actions: &[[f64; 2]]) -> Result<Results, Failure> {
        let (mut results, length) = self.empty_results();
        let (autoreset, start) = (self.autoreset, self.start);
        let step = |((block, actions), rows): ((&mut Block, &[[f64; 2]]), Rows<'_>)| {
            block.step(actions, autoreset, start, rows)
        };
        let rows = results.split(BALLS_IN_A_BLOCK, length);
        let (blocks, began) = (&mut self.blocks, Instant::now());
        match &self.pool {
            None => {
                let actions = actions.chunks(BALLS_IN_A_BLOCK);
                blocks.iter_mut().zip(actions).zip(rows).try_for_each(step)?;
            }
            Some(pool) => pool.install(|| {
                let actions = actions.par_chunks(BALLS_IN_A_BLOCK);
                blocks.par_iter_mut().zip(actions).zip(rows).try_for_each(step)
            })?,
        }
        self.seconds += began.elapsed().as_secs_f64();
        for (number, block) in self.blocks.iter().enumerate() {
            results.ended.append(&block.ended, number * BALLS_IN_A_BLOCK);
        }
        Ok(results)
    }

    fn empty_results(&self) -> (Results, usize) {
        let length = self.arena.observation_length();
        (Results::new(self.len(), length), length)
    }

    /// Starts new episodes of the marked balls, and sets the seed of a ball that has one; both
    /// lists have an entry for each ball.
    ///
    /// # Errors
    /// [`Failure`] if the engine refuses the start.
    pub fn reset(
        &mut self,
        marked: &[bool],
        seeds: &[Option<u64>],
        start: Option<Start>,
    ) -> Result<Results, Failure> {
        let start = start.unwrap_or(self.start);
        let (mut results, length) = self.empty_results();
        let rows = results.split(BALLS_IN_A_BLOCK, length);
        for ((number, block), rows) in self.blocks.iter_mut().enumerate().zip(rows) {
            let balls = block.balls(number);
            block.reset(&marked[balls.clone()], &seeds[balls], start, rows)?;
        }
        Ok(results)
    }

    /// Returns the total time of all steps \[s\].
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// Returns the number of frames of single balls that the rule `exact` refused.
    pub fn rough_frames(&self) -> u64 {
        self.blocks.iter().map(|block| block.episodes.rough_frames()).sum()
    }
}

impl Block {
    /// Returns the indices of the balls in this block, if it is number `number`.
    fn balls(&self, number: usize) -> Range<usize> {
        let first = number * BALLS_IN_A_BLOCK;
        first..first + self.episodes.len()
    }

    fn step(
        &mut self,
        actions: &[[f64; 2]],
        autoreset: Autoreset,
        start: Start,
        mut rows: Rows<'_>,
    ) -> Result<(), EpisodeError> {
        let Self { episodes, ended, over } = self;
        ended.clear();
        if autoreset == Autoreset::NextStep {
            find_over(episodes, over);
        }
        episodes.step(actions)?;
        match autoreset {
            Autoreset::Disabled => rows.write_outcomes(episodes),
            Autoreset::NextStep => {
                episodes.reset(over, start)?;
                rows.write_outcomes(episodes);
            }
            Autoreset::SameStep => {
                find_over(episodes, over);
                ended.push(episodes, over);
                rows.write_outcomes(episodes);
                episodes.reset(over, start)?;
            }
        }
        rows.write_states(episodes);
        Ok(())
    }

    fn reset(
        &mut self,
        marked: &[bool],
        seeds: &[Option<u64>],
        start: Start,
        mut rows: Rows<'_>,
    ) -> Result<(), EpisodeError> {
        let Self { episodes, over, .. } = self;
        over.clear();
        over.extend((0..marked.len()).filter(|&ball| marked[ball]));
        for &ball in over.iter() {
            if let Some(seed) = seeds[ball] {
                episodes.seed(ball, seed)?;
            }
        }
        episodes.reset(over, start)?;
        rows.write_outcomes(episodes);
        rows.write_states(episodes);
        Ok(())
    }
}

/// Finds the balls whose episodes are over.
fn find_over(episodes: &Episodes, over: &mut Vec<usize>) {
    over.clear();
    over.extend((0..episodes.len()).filter(|&it| episodes.outcome(it) != Outcome::Rolling));
}
