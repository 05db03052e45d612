//! Results of a step: arrays with a row for each ball.

use carom_maze::{Episodes, Outcome};

/// Arrays with a row for each ball.
#[derive(Debug)]
pub struct Results {
    /// The observation of each ball.
    pub observations: Vec<f32>,
    pub rewards: Vec<f64>,
    pub terminated: Vec<bool>,
    pub truncated: Vec<bool>,
    /// Number of collectibles of each ball.
    pub collected: Vec<i64>,
    /// Whether each ball touched an end wall.
    pub won: Vec<bool>,
    pub ended: Ended,
}

/// Episodes that ended in a step that starts new ones at once, with their last state.
#[derive(Debug, Default)]
pub struct Ended {
    pub balls: Vec<i64>,
    pub observations: Vec<f32>,
    pub collected: Vec<i64>,
    pub won: Vec<bool>,
}

/// The rows of consecutive balls.
#[derive(Debug)]
pub struct Rows<'a> {
    observations: &'a mut [f32],
    rewards: &'a mut [f64],
    terminated: &'a mut [bool],
    truncated: &'a mut [bool],
    collected: &'a mut [i64],
    won: &'a mut [bool],
}

impl Results {
    /// Returns rows of zeros.
    pub fn new(balls: usize, observation_length: usize) -> Self {
        Self {
            observations: vec![0.0; balls * observation_length],
            rewards: vec![0.0; balls],
            terminated: vec![false; balls],
            truncated: vec![false; balls],
            collected: vec![0; balls],
            won: vec![false; balls],
            ended: Ended::default(),
        }
    }

    /// Splits the rows into parts of `balls` rows; the last may have fewer.
    pub fn split(&mut self, balls: usize, observation_length: usize) -> Vec<Rows<'_>> {
        let mut rewards = self.rewards.chunks_mut(balls);
        let mut terminated = self.terminated.chunks_mut(balls);
        let mut truncated = self.truncated.chunks_mut(balls);
        let mut collected = self.collected.chunks_mut(balls);
        let mut won = self.won.chunks_mut(balls);
        let rows =
            self.observations.chunks_mut(balls * observation_length).map(|observations| Rows {
                observations,
                rewards: rewards.next().unwrap_or_default(),
                terminated: terminated.next().unwrap_or_default(),
                truncated: truncated.next().unwrap_or_default(),
                collected: collected.next().unwrap_or_default(),
                won: won.next().unwrap_or_default(),
            });
        rows.collect()
    }
}

impl Rows<'_> {
    /// Writes rewards and ends of the step.
    pub fn write_outcomes(&mut self, episodes: &Episodes) {
        for ball in 0..episodes.len() {
            let outcome = episodes.outcome(ball);
            self.rewards[ball] = episodes.reward(ball);
            self.terminated[ball] = matches!(outcome, Outcome::Won | Outcome::Fell);
            self.truncated[ball] = outcome == Outcome::TimeUp;
        }
    }

    /// Writes the present states of the balls.
    pub fn write_states(&mut self, episodes: &Episodes) {
        let length = episodes.arena().observation_length();
        for (ball, observation) in self.observations.chunks_exact_mut(length).enumerate() {
            episodes.observe(ball, observation);
            self.collected[ball] = collected(episodes, ball);
            self.won[ball] = episodes.outcome(ball) == Outcome::Won;
        }
    }
}

impl Ended {
    pub fn clear(&mut self) {
        self.balls.clear();
        self.observations.clear();
        self.collected.clear();
        self.won.clear();
    }

    /// Appends the last states of the episodes of some balls.
    pub fn push(&mut self, episodes: &Episodes, balls: &[usize]) {
        for &ball in balls {
            let begin = self.observations.len();
            self.balls.push(ball as i64);
            self.observations.resize(begin + episodes.arena().observation_length(), 0.0);
            episodes.observe(ball, &mut self.observations[begin..]);
            self.collected.push(collected(episodes, ball));
            self.won.push(episodes.outcome(ball) == Outcome::Won);
        }
    }

    /// Appends the ended episodes of another block, whose first ball has the index `first`.
    pub fn append(&mut self, other: &Self, first: usize) {
        self.balls.extend(other.balls.iter().map(|ball| ball + first as i64));
        self.observations.extend_from_slice(&other.observations);
        self.collected.extend_from_slice(&other.collected);
        self.won.extend_from_slice(&other.won);
    }
}

fn collected(episodes: &Episodes, ball: usize) -> i64 {
    episodes.taken(ball).count_ones().into()
}
