//! A game of nine-ball: strikes in a world, judged by the rules.

use carom::{Body, ColliderId, DVec3, QueryFilter, Snapshot, SphereId, World};
use carom_scene::scene::Strike;

use crate::error::{GameError, MoveError};
use crate::moves::Move;
use crate::nine_ball::{BallInHand, NINE, Rack, Stage, Verdict};
use crate::shot::{CUE, Referee};
use crate::table::Table;

/// Longest duration of a shot \[s\]; balls that still move are then stopped, as on a table without friction.
const LONGEST_SHOT: f64 = 60.0;

/// Speed below which a ball counts as at rest, in radii a second: far below what the eye sees.
const REST: f64 = 1e-3;

/// Shortest time in which a strike may send the cue \[s\] over the table: faster than the fastest breaks.
const SHORTEST_CROSSING: f64 = 0.2;

/// Largest offset of a strike, in parts of the radius: a tip slips off farther out (Alciatore, The Illustrated Principles of
/// Pool and Billiards, 2004).
const LARGEST_OFFSET: f64 = 0.5;

/// Depth below the table at which a ball has left it, in radii.
const FALLEN: f64 = 4.0;

/// Steps of the search for a free spot, as a part of the radius.
const SPOT_STEP: f64 = 1.0 / 16.0;

/// Time for which the path of a strike is predicted \[s\].
const PATH_SECS: f64 = 3.0;

/// Largest number of impacts on the path: a ball hops on the cloth after each cushion.
const PATH_IMPACTS: usize = 64;

/// Number of points of a path over its whole time.
const PATH_POINTS: u32 = 120;

/// The best rack of one player alone.
#[derive(Debug, Clone, PartialEq)]
pub struct Best {
    /// Shots, each foul counted as one more.
    pub strokes: u32,
    /// The moves, which give the same rack again.
    pub moves: Vec<Move>,
}

/// A game of nine-ball for one or two players, rack after rack.
#[derive(Debug, Clone)]
pub struct Game {
    table: Table,
    world: World,
    start: Snapshot,
    cloth: ColliderId,
    cushions: Vec<ColliderId>,
    pockets: Vec<ColliderId>,
    rack: Rack,
    referee: Referee,
    /// Frames since the strike, while balls roll.
    rolling: Option<u64>,
    frames: u64,
    moves: Vec<Move>,
    racks_won: [u32; 2],
    best: Option<Best>,
}

impl Game {
    /// Makes a game that has not begun, of one or two players.
    ///
    /// # Errors
    /// [`MoveError::Players`], else only errors that [`Table::from_scene`] has found already.
    pub fn new(table: Table, players: usize) -> Result<Self, GameError> {
        let rack = Rack::new(players, 0)?;
        let mut world = table.scene().world()?;
        // The strike of the scene waits for a player.
        for id in world.spheres().ids().to_vec() {
            world.set_velocity(id, DVec3::ZERO)?;
            world.set_angular_velocity(id, DVec3::ZERO)?;
        }
        let ids: Vec<ColliderId> = world.colliders().map(|(id, _)| id).collect();
        let of = |indices: &[usize]| indices.iter().map(|index| ids[*index]).collect();
        Ok(Self {
            start: world.snapshot(),
            cloth: ids[table.cloth()],
            cushions: of(table.cushions()),
            pockets: of(table.pockets()),
            world,
            rack,
            referee: Referee::default(),
            rolling: None,
            frames: 0,
            moves: Vec::new(),
            racks_won: [0; 2],
            best: None,
            table,
        })
    }

    /// Makes a move of the player at the table.
    ///
    /// # Errors
    /// [`GameError::Move`] if the rules refuse it at this time, [`GameError::Physics`] if the world does. The game is then
    /// unchanged.
    pub fn play(&mut self, wanted: Move) -> Result<(), GameError> {
        if self.rolling.is_some() {
            return Err(MoveError::Shot.into());
        }
        match &wanted {
            Move::PushOut => self.rack.push_out()?,
            Move::Answer { shoots } => self.rack.answer(*shoots)?,
            Move::Place { x, z } => self.place_cue_ball(*x, *z)?,
            Move::Strike(strike) => self.strike(strike)?,
        }
        self.moves.push(wanted);
        Ok(())
    }

    fn place_cue_ball(&mut self, x: f64, z: f64) -> Result<(), GameError> {
        let (id, mut ball) = self.cue_ball().ok_or(MoveError::NotInHand)?;
        ball.position = DVec3::new(x, ball.position.y, z);
        if self.rack.in_hand() == BallInHand::No || matches!(self.rack.stage(), Stage::Won) {
            return Err(MoveError::NotInHand.into());
        }
        if !self.may_place(x, z) {
            return Err(MoveError::Place.into());
        }
        Ok(self.world.set_sphere(id, ball)?)
    }

    /// Returns whether the cue ball, in hand, may be put to a place \[m\].
    pub fn may_place(&self, x: f64, z: f64) -> bool {
        let Some((id, ball)) = self.cue_ball() else { return false };
        let place = DVec3::new(x, ball.position.y, z);
        let head_string = self.table.ball(CUE).map_or(DVec3::ZERO, |it| it.position);
        let is_behind = (place - head_string).dot(self.table.along()) <= 0.0;
        let is_allowed = match self.rack.in_hand() {
            BallInHand::No => false,
            BallInHand::BehindHeadString => is_behind,
            BallInHand::Anywhere => true,
        };
        is_allowed && self.is_free(place, ball.radius, Some(id))
    }

    /// Returns whether a ball at a place would be on the table and touch nothing but the cloth.
    fn is_free(&self, place: DVec3, radius: f64, except: Option<SphereId>) -> bool {
        let mut filter = QueryFilter::default();
        (filter.triggers, filter.except) = (true, except);
        let touched = self.world.overlapping(place, radius, &filter);
        let is_cloth = |body: Body| body == Body::Collider(self.cloth);
        self.table.is_within(place) && touched.is_ok_and(|it| it.iter().all(|it| is_cloth(it.body)))
    }

    fn strike(&mut self, strike: &Strike) -> Result<(), GameError> {
        if matches!(self.rack.stage(), Stage::Answer | Stage::Won) {
            return Err(MoveError::Shot.into());
        }
        let [right, up] = strike.offset;
        let is_cue = strike.azimuth_degrees.is_finite()
            && (0.0..=self.fastest_strike()).contains(&strike.speed)
            && (0.0..=90.0).contains(&strike.elevation_degrees)
            && right * right + up * up <= LARGEST_OFFSET * LARGEST_OFFSET;
        let (id, ball) = self.cue_ball().filter(|_| is_cue).ok_or(MoveError::Strike)?;
        self.world.strike(id, strike.on_radius(ball.radius))?;
        let balls = self.balls().collect();
        self.referee = Referee::new(balls, self.cushions.clone(), self.pockets.clone());
        self.rolling = Some(0);
        Ok(())
    }

    /// Advances the balls by a frame; returns the verdict once they are at rest. Without a shot nothing changes.
    ///
    /// # Errors
    /// [`GameError::Physics`] if the rule of the world refuses the frame. The game is then unchanged.
    pub fn step(&mut self) -> Result<Option<Verdict>, GameError> {
        let Some(rolling) = self.rolling else { return Ok(None) };
        let start = self.world.time();
        let report = self.world.step(self.table.scene().simulation.frame_time)?;
        self.referee.read(report, start);
        self.frames += 1;
        self.rolling = Some(rolling + 1);
        self.remove_where(|depth, radius| depth > FALLEN * radius)?;
        let is_over = (rolling + 1) as f64 * self.frame_time() >= LONGEST_SHOT;
        if is_over || self.is_at_rest() { self.end_shot().map(Some) } else { Ok(None) }
    }

    /// Returns whether all balls are at rest.
    fn is_at_rest(&self) -> bool {
        let spheres = self.world.spheres();
        let motions = spheres.velocities().iter().zip(spheres.angular_velocities());
        let mut moving = motions.zip(spheres.radii()).filter(|((velocity, spin), radius)| {
            velocity.length() > REST * *radius || spin.length() > REST
        });
        moving.next().is_none()
    }

    /// Removes the balls whose depth below their height on the table \[m\], with their radius \[m\], is that of a ball that
    /// has left it.
    fn remove_where(&mut self, has_left: impl Fn(f64, f64) -> bool) -> Result<(), GameError> {
        let level = self.table.ball(CUE).map_or(0.0, |it| it.position.y);
        for (id, ball) in self.balls().collect::<Vec<_>>() {
            let sphere = self.world.sphere(id)?;
            if has_left(level - sphere.position.y, sphere.radius) {
                self.world.remove_sphere(id)?;
                self.referee.note_off_table(ball);
            }
        }
        Ok(())
    }

    /// Judges the shot, and puts balls back onto the table.
    fn end_shot(&mut self) -> Result<Verdict, GameError> {
        // A ball may also have come to rest on a rail.
        self.remove_where(|depth, radius| depth.abs() > radius)?;
        for id in self.world.spheres().ids().to_vec() {
            self.world.set_velocity(id, DVec3::ZERO)?;
            self.world.set_angular_velocity(id, DVec3::ZERO)?;
        }
        self.rolling = None;
        let verdict = self.rack.judge(self.referee.shot())?;
        let along = self.table.along();
        if verdict.spots_nine {
            self.spot(NINE, self.table.ball(1).map(|it| it.position), along)?;
        }
        if self.cue_ball().is_none() {
            self.spot(CUE, self.table.ball(CUE).map(|it| it.position), -along)?;
        }
        if let Some(winner) = verdict.winner {
            self.racks_won[winner] += 1;
            self.note_best();
        }
        Ok(verdict)
    }

    /// Puts a ball back to a spot, or to the nearest free place along a direction, or else against it.
    fn spot(&mut self, ball: u8, spot: Option<DVec3>, way: DVec3) -> Result<(), GameError> {
        let (Some(spot), Some(mut sphere)) = (spot, self.table.ball(ball).copied()) else {
            return Ok(());
        };
        let step = SPOT_STEP * sphere.radius;
        let steps = (self.table.length() / step) as u32;
        let places = [way, -way]
            .into_iter()
            .flat_map(|way| (0..steps).map(move |i| spot + way * (f64::from(i) * step)));
        let mut free = places.filter(|place| self.is_free(*place, sphere.radius, None));
        sphere.position = free.next().unwrap_or(spot);
        self.world.add_sphere(sphere)?;
        Ok(())
    }

    /// Keeps the rack of one player alone if it is the best.
    fn note_best(&mut self) {
        let strokes = self.rack.strokes();
        if self.rack.players() == 1 && self.best.as_ref().is_none_or(|it| strokes < it.strokes) {
            self.best = Some(Best { strokes, moves: self.moves.clone() });
        }
    }

    /// Begins the next rack, which the winner of the last one breaks; the balls are at their first places.
    pub fn play_again(&mut self) {
        let breaker = self.rack.winner().unwrap_or(0);
        self.begin(self.rack.players(), breaker);
    }

    /// Starts a game of one or two players, with no rack won.
    ///
    /// # Errors
    /// [`MoveError::Players`]
    pub fn set_players(&mut self, players: usize) -> Result<(), MoveError> {
        Rack::new(players, 0)?;
        self.racks_won = [0; 2];
        self.begin(players, 0);
        Ok(())
    }

    fn begin(&mut self, players: usize, breaker: usize) {
        if let Ok(rack) = Rack::new(players, breaker) {
            self.rack = rack;
        }
        self.world.restore(&self.start);
        self.rolling = None;
        self.frames = 0;
        self.moves.clear();
    }

    /// Returns points of the path that a strike would give the cue ball \[m\], at equal intervals of time, up to where it has
    /// no closed form; none if the strike is refused.
    pub fn path(&self, strike: &Strike) -> Vec<DVec3> {
        let mut tried = self.clone();
        if tried.strike(strike).is_err() {
            return Vec::new();
        }
        let world = &tried.world;
        let Some((id, _)) = tried.cue_ball() else { return Vec::new() };
        let Ok(path) = world.predict(id, PATH_SECS, PATH_IMPACTS) else { return Vec::new() };
        let time = |i: u32| world.time() + PATH_SECS * f64::from(i) / f64::from(PATH_POINTS);
        (0..=PATH_POINTS).map_while(|i| path.position_at(time(i))).collect()
    }

    /// Returns the table.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// Returns the world; the `user_data` of its spheres are the numbers of the balls.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Returns the id and the number of each ball on the table.
    pub fn balls(&self) -> impl Iterator<Item = (SphereId, u8)> {
        let spheres = self.world.spheres();
        let number = |index: usize| spheres.get(index).user_data as u8;
        spheres.ids().iter().enumerate().map(move |(index, id)| (*id, number(index)))
    }

    /// Returns the id of the cue ball, and the ball.
    pub fn cue_ball(&self) -> Option<(SphereId, carom::Sphere)> {
        let (id, _) = self.balls().find(|(_, ball)| *ball == CUE)?;
        Some((id, self.world.sphere(id).ok()?))
    }

    /// Returns the rack: whose turn it is, and what the rules ask.
    pub fn rack(&self) -> &Rack {
        &self.rack
    }

    /// Returns whether balls roll.
    pub fn is_rolling(&self) -> bool {
        self.rolling.is_some()
    }

    /// Returns the largest speed of a cue \[m/s\].
    pub fn fastest_strike(&self) -> f64 {
        self.table.length() / SHORTEST_CROSSING
    }

    /// Returns the racks that each player has won.
    pub fn racks_won(&self) -> [u32; 2] {
        self.racks_won
    }

    /// Returns the moves of this rack.
    pub fn moves(&self) -> &[Move] {
        &self.moves
    }

    /// Sets the best rack of one player alone, to continue from an earlier session.
    pub fn set_best(&mut self, best: Option<Best>) {
        self.best = best;
    }

    /// Returns the best rack of one player alone.
    pub fn best(&self) -> Option<&Best> {
        self.best.as_ref()
    }

    /// Returns the duration of a frame \[s\].
    pub fn frame_time(&self) -> f64 {
        self.table.scene().simulation.frame_time
    }

    /// Returns the time for which balls rolled in this rack \[s\].
    pub fn elapsed(&self) -> f64 {
        self.frames as f64 * self.frame_time()
    }
}
