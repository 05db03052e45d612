//! The physics and the rules of the game: flippers, a plunger, points and three balls, on the table of `table.toml`.
//!
//! The games in `examples/pinball-web` and `examples/pinball-unity` do the same in the same order, so the same keys lead
//! to the same bits.

use carom::{
    BodyPair, ColliderId, DQuat, DVec3, Error, Pose, Snapshot, SphereId, StepReport, World,
};
use carom_scene::{Scene, SceneError};

/// Length of a frame of the physics \[s\].
pub const FRAME: f64 = 1.0 / 120.0;
/// Balls of a game.
const BALLS: u32 = 3;
/// Where a ball waits for the plunger \[m\].
const START: DVec3 = DVec3::new(0.28, 0.06, 0.0);
/// Frames that the game can go back.
const PAST: usize = 360;
/// Half the length of a flipper between the centres of its ends \[m\].
const HALF_FLIPPER: f64 = 0.045;
/// The axis of the right flipper \[m\].
const PIVOT: [f64; 2] = [0.115, 0.14];
/// A flipper rises by as many steps, one in a frame, from as far below.
const STEPS: i32 = 4;
/// Frames in which the plunger is drawn back whole.
const FULL_PULL: u32 = 64;
/// Impulse of the plunger when it is drawn back whole \[N s\].
const LAUNCH: f64 = 0.2;
/// Slower impacts neither sound nor score \[m/s\].
const SILENT: f64 = 0.05;

/// What a collider is in the game.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Role {
    Flipper,
    Bumper,
    Slingshot,
    Target,
    Drain,
    Wall,
}

impl Role {
    /// Returns the role of the collider with this number in `table.toml`.
    pub fn of(number: usize) -> Self {
        match number {
            0 | 1 => Self::Flipper,
            2..=4 => Self::Bumper,
            5 | 6 => Self::Slingshot,
            7..=9 => Self::Target,
            10 => Self::Drain,
            _ => Self::Wall,
        }
    }

    /// Returns the points for a hit.
    fn points(self) -> u32 {
        match self {
            Self::Bumper => 100,
            Self::Slingshot => 10,
            Self::Target => 500,
            _ => 0,
        }
    }
}

/// Keys that are down.
#[derive(Clone, Copy, Default)]
pub struct Keys {
    pub left: bool,
    pub right: bool,
    pub plunger: bool,
}

/// Something to hear: what the ball touches, by its number in `table.toml`, and how hard.
pub struct Sound {
    pub collider: usize,
    /// \[N s\]; 0 for targets and the drain.
    pub impulse: f64,
}

#[derive(Clone, Copy)]
struct Flipper {
    /// Steps above the middle.
    step: i32,
    /// Whether it has turned in the last frame, so that it has to be stopped.
    turned: bool,
}

/// What a game needs to go on, besides the world.
#[derive(Clone, Copy)]
struct State {
    score: u32,
    /// Balls left, with the one on the table.
    balls: u32,
    flippers: [Flipper; 2],
    /// Frames for which the plunger is drawn back.
    pull: u32,
}

pub struct Table {
    pub world: World,
    state: State,
    ball: SphereId,
    colliders: Vec<ColliderId>,
    /// The last frames, the oldest overwritten first.
    past: Vec<(Snapshot, State)>,
    /// Frames since the start.
    frames: usize,
    /// Frames that can be gone back.
    kept: usize,
}

impl Table {
    /// Makes a table with a ball before the plunger.
    pub fn new() -> Result<Self, SceneError> {
        let world = Scene::from_toml(include_str!("../table.toml"), "table.toml")?.world()?;
        let colliders = world.colliders().map(|(id, _)| id).collect();
        let ball = world.spheres().ids()[0];
        let flipper = Flipper { step: -STEPS, turned: true };
        let state = State { score: 0, balls: BALLS, flippers: [flipper; 2], pull: 0 };
        Ok(Self { world, state, ball, colliders, past: Vec::new(), frames: 0, kept: 0 })
    }

    /// Advances by a frame.
    pub fn step(&mut self, keys: Keys) -> Result<Vec<Sound>, Error> {
        self.remember();
        self.move_flippers([keys.left, keys.right])?;
        self.move_plunger(keys.plunger)?;
        let sounds = sounds(self.world.step(FRAME)?, &self.colliders);
        for sound in &sounds {
            match Role::of(sound.collider) {
                Role::Drain => self.lose_ball()?,
                role => self.state.score += role.points(),
            }
        }
        Ok(sounds)
    }

    /// Turns each flipper by a step; it strikes with the velocity that brings it there in the frame. One that rests is
    /// left alone: then its frames are cheaper.
    fn move_flippers(&mut self, raised: [bool; 2]) -> Result<(), Error> {
        for (number, side) in [(0, -1.0), (1, 1.0)] {
            let Flipper { step, turned } = self.state.flippers[number];
            let next = if raised[number] { STEPS.min(step + 1) } else { (-STEPS).max(step - 1) };
            if next != step || turned {
                let pose = pose_of_flipper(side, next);
                self.world.set_next_pose(self.colliders[number], pose, FRAME)?;
            }
            self.state.flippers[number] = Flipper { step: next, turned: next != step };
        }
        Ok(())
    }

    /// Draws the plunger back, or lets it strike the ball that lies before it. After the last ball, that begins a new
    /// game.
    fn move_plunger(&mut self, is_drawn: bool) -> Result<(), Error> {
        if is_drawn {
            self.state.pull = FULL_PULL.min(self.state.pull + 1);
            return Ok(());
        }
        let pull = std::mem::take(&mut self.state.pull);
        if pull == 0 || !self.is_ball_waiting() {
            return Ok(());
        }
        if self.state.balls == 0 {
            (self.state.balls, self.state.score) = (BALLS, 0);
        }
        let impulse = LAUNCH * (f64::from(pull) / f64::from(FULL_PULL));
        self.world.apply_impulse(self.ball, DVec3::new(0.0, impulse, 0.0))
    }

    /// Puts the next ball before the plunger; after the last one, it waits for a new game.
    fn lose_ball(&mut self) -> Result<(), Error> {
        (self.state.balls, self.state.pull) = (self.state.balls - 1, 0);
        let mut ball = self.world.sphere(self.ball)?;
        (ball.position, ball.velocity) = (START, DVec3::ZERO);
        self.world.set_sphere(self.ball, ball)
    }

    /// Goes back by some frames, as far as they are kept.
    pub fn go_back(&mut self, frames: usize) {
        let frames = frames.min(self.kept);
        if frames == 0 {
            return;
        }
        (self.frames, self.kept) = (self.frames - frames, self.kept - frames);
        let (world, state) = &self.past[self.frames % PAST];
        self.world.restore(world);
        self.state = *state;
    }

    /// Keeps the present state, in the memory of the oldest one.
    fn remember(&mut self) {
        match self.past.get_mut(self.frames % PAST) {
            Some((world, state)) => {
                self.world.snapshot_into(world);
                *state = self.state;
            }
            None => self.past.push((self.world.snapshot(), self.state)),
        }
        (self.frames, self.kept) = (self.frames + 1, PAST.min(self.kept + 1));
    }

    pub fn score(&self) -> u32 {
        self.state.score
    }

    /// Returns the number of balls left, with the one on the table; 0 after a game.
    pub fn balls(&self) -> u32 {
        self.state.balls
    }

    /// Returns whether the ball lies before the plunger.
    pub fn is_ball_waiting(&self) -> bool {
        self.ball().x > START.x - 0.02 && self.ball().y < START.y + 0.01
    }

    /// Returns the part of its way that the plunger is drawn back.
    pub fn pull(&self) -> f64 {
        f64::from(self.state.pull) / f64::from(FULL_PULL)
    }

    /// Returns the centre of the ball \[m\].
    pub fn ball(&self) -> DVec3 {
        self.world.spheres().positions()[0]
    }
}

/// Lists what the ball hits, then the triggers that it enters.
fn sounds(report: &StepReport, colliders: &[ColliderId]) -> Vec<Sound> {
    let number = |id| colliders.iter().position(|it| *it == id).unwrap_or(usize::MAX);
    let hits = report.impacts.iter().filter(|it| it.approach_speed > SILENT);
    let hits = hits.filter_map(|impact| match impact.between {
        BodyPair::Collider { collider, .. } => {
            Some(Sound { collider: number(collider), impulse: impact.impulse })
        }
        BodyPair::Spheres { .. } => None,
    });
    let entries = report.sensor_events.iter().filter(|it| it.enters);
    hits.chain(entries.map(|it| Sound { collider: number(it.collider), impulse: 0.0 })).collect()
}

/// Returns the pose of a flipper on the side -1 or 1, `step` steps above the middle. It turns about its outer end; a
/// capsule lies along its own y.
///
/// A step is one of the tangent of half the angle, from which cosine and sine follow by exact divisions: the same bits in
/// every language, which functions for angles do not promise.
fn pose_of_flipper(side: f64, step: i32) -> Pose {
    let tangent = f64::from(step) / 16.0;
    let square = 1.0 + tangent * tangent;
    let (cosine, sine) = ((1.0 - tangent * tangent) / square, 2.0 * tangent / square);
    let (x, y) = (PIVOT[0] - HALF_FLIPPER * cosine, PIVOT[1] + HALF_FLIPPER * sine);
    let rotation = DQuat::from_xyzw(0.0, 0.0, side * (1.0 - tangent), 1.0 + tangent);
    Pose::at(DVec3::new(side * x, y, 0.0)).rotated(rotation)
}
