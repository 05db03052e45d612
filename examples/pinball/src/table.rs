//! The physics of the game: a ball, two flippers, three bumpers, and a drain below.

use carom::{
    BodyPair, Collider, ColliderId, Contact, DQuat, DVec3, Error, Gravity, Pose, Settings, Shape,
    Sides, Snapshot, Sphere, SphereId, World,
};

/// Length of a frame of the physics \[s\].
pub const FRAME: f64 = 1.0 / 120.0;
/// Size of the table \[m\].
pub const SIZE: [f64; 2] = [0.5, 0.9];
/// Frames that the game can go back.
const PAST: usize = 240;
/// Radius of the ball \[m\].
const BALL: f64 = 0.0135;
/// Length of a flipper between the centres of its ends, and radius of these \[m\].
const FLIPPER: [f64; 2] = [0.085, 0.011];
/// Angles of a flipper at rest and raised \[rad\].
const ANGLES: [f64; 2] = [-0.5, 0.5];
/// Angular speed of a flipper \[rad/s\].
const SPEED: f64 = 15.0;
const BUMPERS: [[f64; 2]; 3] = [[-0.1, 0.6], [0.1, 0.6], [0.0, 0.72]];
const BUMPER: f64 = 0.035;

/// A flipper and its angle \[rad\], on the side -1 or 1.
#[derive(Clone, Copy)]
struct Flipper {
    collider: ColliderId,
    side: f64,
    angle: f64,
}

/// What happens in a frame: something to hear.
pub enum Sound {
    Bumper,
    Wall,
    Drain,
}

/// What a frame begins with, to go back to.
struct Moment {
    world: Snapshot,
    flippers: [Flipper; 2],
    score: u32,
}

pub struct Table {
    pub world: World,
    pub score: u32,
    ball: SphereId,
    flippers: [Flipper; 2],
    bumpers: [ColliderId; 3],
    drain: ColliderId,
    /// The last frames, the oldest overwritten first.
    past: Vec<Moment>,
    frames: usize,
}

impl Table {
    pub fn new() -> Result<Self, Error> {
        let mut world = World::new(Settings::default().with_rule(Contact::default()))?;
        // The table leans by 7 degrees; nothing moves along z.
        world.add_force(Gravity::new(DVec3::new(0.0, -9.81 * 0.122, 0.0)))?;
        let [width, height] = SIZE;
        let walls = Shape::Container { size: DVec3::new(width, height, 1.0), open: Sides::NONE };
        let middle = Pose::at(DVec3::new(0.0, 0.5 * height, 0.0));
        world.add_collider(Collider::new(walls, middle).with_restitution(0.5))?;
        for side in [-1.0, 1.0] {
            let slope = Shape::Box { size: DVec3::new(0.17, 0.02, 1.0) };
            let place = DVec3::new(side * 0.19, 0.19, 0.0);
            let slope = Collider::new(slope, Pose::at(place).rotated(about_z(side * 0.5)));
            world.add_collider(slope.with_restitution(0.3))?;
        }
        let mut bumpers = Vec::new();
        for [x, y] in BUMPERS {
            let bumper = Shape::Sphere { radius: BUMPER };
            let bumper = Collider::new(bumper, Pose::at(DVec3::new(x, y, 0.0)));
            bumpers.push(world.add_collider(bumper.with_restitution(0.6).with_kick(0.8))?);
        }
        let drain = Shape::Box { size: DVec3::new(width, 0.04, 1.0) };
        let drain = world.add_collider(Collider::new(drain, Pose::at(DVec3::ZERO)).as_trigger())?;
        let mut flipper = |side| -> Result<Flipper, Error> {
            let [length, radius] = FLIPPER;
            let shape = Shape::Capsule { radius, length };
            let flipper = Collider::new(shape, pose_of_flipper(side, ANGLES[0]));
            let collider = world.add_collider(flipper.with_restitution(0.4))?;
            Ok(Flipper { collider, side, angle: ANGLES[0] })
        };
        let flippers = [flipper(-1.0)?, flipper(1.0)?];
        let ball = world.add_sphere(new_ball())?;
        let bumpers = [bumpers[0], bumpers[1], bumpers[2]];
        let (past, frames, score) = (Vec::new(), 0, 0);
        Ok(Self { world, score, ball, flippers, bumpers, drain, past, frames })
    }

    /// Advances by a frame, while keys raise the left and the right flipper.
    pub fn step(&mut self, raised: [bool; 2]) -> Result<Vec<Sound>, Error> {
        self.remember();
        for (flipper, raised) in self.flippers.iter_mut().zip(raised) {
            let aim = ANGLES[usize::from(raised)];
            let turn = (aim - flipper.angle).clamp(-SPEED * FRAME, SPEED * FRAME);
            flipper.angle += turn;
            // The flipper strikes with the velocity that brings it there in this frame.
            let pose = pose_of_flipper(flipper.side, flipper.angle);
            self.world.set_next_pose(flipper.collider, pose, FRAME)?;
        }
        let report = self.world.step(FRAME)?;
        let mut sounds = Vec::new();
        for impact in report.impacts.iter().filter(|impact| impact.approach_speed > 0.1) {
            let BodyPair::Collider { collider, .. } = impact.between else { continue };
            let is_bumper = self.bumpers.contains(&collider);
            self.score += 10 * u32::from(is_bumper);
            sounds.push(if is_bumper { Sound::Bumper } else { Sound::Wall });
        }
        if report.sensor_events.iter().any(|event| event.enters && event.collider == self.drain) {
            self.world.set_sphere(self.ball, new_ball())?;
            self.score = 0;
            sounds.push(Sound::Drain);
        }
        Ok(sounds)
    }

    /// Goes back by some frames, as far as they are known.
    pub fn go_back(&mut self, frames: usize) {
        let frames = frames.min(self.past.len()).min(self.frames);
        if frames == 0 {
            return;
        }
        self.frames -= frames;
        let Moment { world, flippers, score } = &self.past[self.frames % PAST];
        self.world.restore(world);
        (self.flippers, self.score) = (*flippers, *score);
        self.past.truncate(self.frames.min(PAST));
    }

    /// Centre and radius of the ball \[m\].
    pub fn ball(&self) -> (DVec3, f64) {
        (self.world.spheres().positions()[0], BALL)
    }

    /// Keeps the present state, in the memory of the oldest one.
    fn remember(&mut self) {
        let (flippers, score) = (self.flippers, self.score);
        match self.past.get_mut(self.frames % PAST) {
            Some(moment) => {
                self.world.snapshot_into(&mut moment.world);
                (moment.flippers, moment.score) = (flippers, score);
            }
            None => self.past.push(Moment { world: self.world.snapshot(), flippers, score }),
        }
        self.frames += 1;
    }
}

fn new_ball() -> Sphere {
    let ball = Sphere::new(DVec3::new(0.02, 0.8, 0.0), BALL);
    ball.with_density(7800.0).with_restitution(0.8)
}

fn about_z(angle: f64) -> DQuat {
    DQuat::from_rotation_z(angle)
}

/// The pose of a flipper that turns about its outer end; a capsule lies along its own y.
fn pose_of_flipper(side: f64, angle: f64) -> Pose {
    let pivot = DVec3::new(side * 0.115, 0.14, 0.0);
    let along = DVec3::new(-side * angle.cos(), angle.sin(), 0.0);
    let rotation = about_z(side * (std::f64::consts::FRAC_PI_2 - angle));
    Pose::at(pivot + 0.5 * FLIPPER[0] * along).rotated(rotation)
}

#[cfg(test)]
mod tests {
    use super::{PAST, SIZE, Table};

    /// Keys of a player who hammers on both flippers.
    fn keys(frame: usize) -> [bool; 2] {
        [frame / 20 % 2 == 0, frame / 27 % 2 == 0]
    }

    #[test]
    fn the_ball_stays_on_the_table() {
        let mut table = Table::new().expect("a table");
        let mut sounds = 0;
        for frame in 0..7200 {
            sounds += table.step(keys(frame)).expect("a frame").len();
            let (ball, radius) = table.ball();
            assert!(ball.x.abs() <= 0.5 * SIZE[0] - radius + 1e-3, "{frame}: {ball}");
            assert!((0.0..SIZE[1]).contains(&ball.y) && ball.z == 0.0, "{frame}: {ball}");
        }
        assert!(sounds > 50, "{sounds}");
    }

    #[test]
    fn a_game_that_goes_back_and_repeats_its_keys_ends_in_the_same_bits() {
        let mut table = Table::new().expect("a table");
        for frame in 0..600 {
            table.step(keys(frame)).expect("a frame");
        }
        let end = (table.world.state_hash(), table.score);
        table.go_back(PAST);
        for frame in 600 - PAST..600 {
            table.step(keys(frame)).expect("a frame");
        }
        assert_eq!((table.world.state_hash(), table.score), end);
    }
}
