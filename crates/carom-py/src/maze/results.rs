//! What a step gives agents: arrays with a row for each ball.

use carom_maze::{Episodes, Outcome};

/// Arrays with a row for each ball.
#[derive(Debug, Default)]
pub struct Results {
    /// As many numbers as an observation has, for each ball.
    pub observations: Vec<f32>,
    pub rewards: Vec<f64>,
    pub terminated: Vec<bool>,
    pub truncated: Vec<bool>,
    pub states: States,
    /// Where the step that ends an episode starts a new one: which ended, and how.
    pub ended: Vec<i64>,
    pub ended_observations: Vec<f32>,
    pub ended_states: States,
}

/// What else is told of balls.
#[derive(Debug, Default)]
pub struct States {
    /// How many collectibles each has.
    pub collected: Vec<i64>,
    /// Whether it touched an end wall.
    pub won: Vec<bool>,
}

impl States {
    fn clear(&mut self) {
        self.collected.clear();
        self.won.clear();
    }

    fn push(&mut self, episodes: &Episodes, ball: usize) {
        self.collected.push(episodes.taken(ball).count_ones().into());
        self.won.push(episodes.outcome(ball) == Outcome::Won);
    }

    fn append(&mut self, other: &Self) {
        self.collected.extend_from_slice(&other.collected);
        self.won.extend_from_slice(&other.won);
    }
}

impl Results {
    pub fn with_capacity(balls: usize, observation_length: usize) -> Self {
        Self {
            observations: Vec::with_capacity(balls * observation_length),
            rewards: Vec::with_capacity(balls),
            terminated: Vec::with_capacity(balls),
            truncated: Vec::with_capacity(balls),
            ..Self::default()
        }
    }

    pub fn clear(&mut self) {
        self.observations.clear();
        self.rewards.clear();
        self.terminated.clear();
        self.truncated.clear();
        self.states.clear();
        self.ended.clear();
        self.ended_observations.clear();
        self.ended_states.clear();
    }

    /// What the step did: earned, ended.
    pub fn push_outcomes(&mut self, episodes: &Episodes) {
        for ball in 0..episodes.len() {
            let outcome = episodes.outcome(ball);
            self.rewards.push(episodes.reward(ball));
            self.terminated.push(matches!(outcome, Outcome::Won | Outcome::Fell));
            self.truncated.push(outcome == Outcome::TimeUp);
        }
    }

    /// Where the balls are now.
    pub fn push_states(&mut self, episodes: &Episodes) {
        for ball in 0..episodes.len() {
            observe(episodes, ball, &mut self.observations);
            self.states.push(episodes, ball);
        }
    }

    /// How the episodes of some balls ended.
    pub fn push_ended(&mut self, episodes: &Episodes, balls: &[usize]) {
        for &ball in balls {
            self.ended.push(ball as i64);
            observe(episodes, ball, &mut self.ended_observations);
            self.ended_states.push(episodes, ball);
        }
    }

    /// Appends the rows of other balls, the first of which has this number.
    pub fn append(&mut self, other: &Self, first: usize) {
        self.observations.extend_from_slice(&other.observations);
        self.rewards.extend_from_slice(&other.rewards);
        self.terminated.extend_from_slice(&other.terminated);
        self.truncated.extend_from_slice(&other.truncated);
        self.states.append(&other.states);
        self.ended.extend(other.ended.iter().map(|ball| ball + first as i64));
        self.ended_observations.extend_from_slice(&other.ended_observations);
        self.ended_states.append(&other.ended_states);
    }
}

fn observe(episodes: &Episodes, ball: usize, observations: &mut Vec<f32>) {
    let begin = observations.len();
    observations.resize(begin + episodes.arena().observation_length(), 0.0);
    episodes.observe(ball, &mut observations[begin..]);
}
