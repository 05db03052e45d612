//! The worlds of a batch.

use std::sync::Arc;

use carom::{StepReport, World};
use rayon::ThreadPool;
use rayon::prelude::*;

use crate::arrays::{Arrays, Quantity};
use crate::engine::{self, Inner};
use crate::failure::Failure;
use crate::snapshot::Snapshot;

/// Spheres that a thread steps before it takes more work: below it, to share costs more.
const SPHERES_PER_TASK: usize = 64;

/// Worlds with the same number of spheres. No result depends on how many threads there are.
#[derive(Debug)]
pub struct Members {
    members: Vec<Member>,
    /// Spheres in each.
    spheres: usize,
    /// None where one thread does everything.
    pool: Option<ThreadPool>,
}

#[derive(Debug)]
struct Member {
    now: Inner,
    start: Arc<Snapshot>,
}

impl Members {
    /// Worlds that start in these states: one state for all `count`, or one for each.
    ///
    /// # Errors
    /// [`Failure`] for no worlds, for worlds with emitters, and for other numbers of spheres than in
    /// the first one.
    pub fn new(
        starts: Vec<Snapshot>,
        count: usize,
        pool: Option<ThreadPool>,
    ) -> Result<Self, Failure> {
        if count == 0 || ![1, count].contains(&starts.len()) {
            return Err(Failure::value("n", format_args!("must be at least 1, not {count}")));
        }
        let mut starts: Vec<Arc<Snapshot>> = starts.into_iter().map(Arc::new).collect();
        let last = Arc::clone(&starts[starts.len() - 1]);
        starts.resize(count, last);
        let members: Vec<Member> = starts.into_iter().map(Member::new).collect();
        let spheres = members[0].world().spheres().len();
        let members = Self { members, spheres, pool };
        for (number, member) in members.members.iter().enumerate() {
            members.check(number, member.world())?;
        }
        Ok(members)
    }

    /// Refuses a world that does not fit among the others.
    fn check(&self, number: usize, world: &World) -> Result<(), Failure> {
        let (own, others) = (world.spheres().len(), self.spheres);
        if own != others {
            let problem = format_args!("world {number} has {own} spheres, the first has {others}");
            return Err(Failure::value("scene", problem));
        }
        if world.emitters().len() > 0 {
            let problem = "has emitters; the worlds of a batch keep their spheres";
            return Err(Failure::value("scene", problem));
        }
        Ok(())
    }

    pub fn len(&self) -> usize {
        self.members.len()
    }

    pub fn worlds(&self) -> impl Iterator<Item = &World> {
        self.members.iter().map(Member::world)
    }

    /// The report of the last frame of each world, and when that started \[s\].
    pub fn reports(&self) -> impl Iterator<Item = (f64, &StepReport)> {
        self.members.iter().map(|it| (it.now.frame_start, it.world().report()))
    }

    /// Length of a frame of the first world's scene \[s\].
    pub fn frame_time(&self) -> f64 {
        self.members[0].now.frame_time(None)
    }

    /// The shape of an array of all worlds.
    pub fn shape_of(&self, quantity: Quantity) -> Vec<usize> {
        [vec![self.len()], quantity.shape(self.spheres)].concat()
    }

    /// Takes frames of `dt` \[s\], or of each world's own length, in every world. One that refuses a
    /// frame stays as it was before that; returns the numbers of such worlds, with the reasons.
    pub fn step(&mut self, dt: Option<f64>, frames: u64) -> Vec<(usize, Failure)> {
        let step = |(number, member): (usize, &mut Member)| {
            let length = member.now.frame_time(dt);
            let mut frames = 0..frames;
            let refused = frames.find_map(|_| member.now.take_frame(length).err());
            refused.map(|error| (number, Failure::from(error)))
        };
        let share = (SPHERES_PER_TASK / self.spheres.max(1)).max(1);
        let members = &mut self.members;
        match &self.pool {
            None => members.iter_mut().enumerate().filter_map(step).collect(),
            Some(pool) => pool.install(|| {
                let members = members.par_iter_mut().enumerate().with_min_len(share);
                members.filter_map(step).collect()
            }),
        }
    }

    /// Has worlds return to where they started: those of these numbers that are there, or all.
    pub fn reset(&mut self, worlds: Option<&[usize]>) {
        match worlds {
            None => self.members.iter_mut().for_each(Member::reset),
            Some(worlds) => {
                for &world in worlds {
                    if let Some(member) = self.members.get_mut(world) {
                        member.reset();
                    }
                }
            }
        }
    }

    /// The state of a world.
    pub fn snapshot(&self, world: usize) -> Option<Snapshot> {
        self.members.get(world).map(|member| member.now.snapshot())
    }

    /// Puts a world into another state, from which it starts from now on.
    ///
    /// # Errors
    /// [`Failure`] if that does not fit among the others, or there is no such world.
    pub fn restore(&mut self, world: usize, snapshot: &Snapshot) -> Result<(), Failure> {
        let member = Member::new(Arc::new(snapshot.clone()));
        self.check(world, member.world())?;
        let count = self.len();
        let place = self.members.get_mut(world).ok_or_else(|| {
            Failure::value("index", format_args!("must be below {count}, not {world}"))
        })?;
        *place = member;
        Ok(())
    }

    /// Sets a quantity of all spheres of all worlds; if a value is refused, none is set.
    ///
    /// # Errors
    /// [`Failure`] for a number that makes no sense.
    pub fn set(&mut self, quantity: Quantity, values: &[f64]) -> Result<(), Failure> {
        let row = quantity.shape(self.spheres).iter().product::<usize>().max(1);
        if let Some(place) = values.iter().position(|&value| !quantity.may_be(value)) {
            let (number, own) = (place / row, place / row * row);
            let world = &mut self.members[number].now.world;
            return engine::set_all(world, quantity, &values[own..own + row]);
        }
        let mut before = Vec::new();
        for (member, own) in self.members.iter_mut().zip(values.chunks_exact(row)) {
            if quantity.is_bounded() {
                before.push(member.world().snapshot());
            }
            if let Err(failure) = engine::set_all(&mut member.now.world, quantity, own) {
                let both = self.members.iter_mut().zip(&before);
                both.for_each(|(member, before)| member.now.world.restore(before));
                return Err(failure);
            }
        }
        Ok(())
    }
}

impl Member {
    fn new(start: Arc<Snapshot>) -> Self {
        let mut now = Inner {
            world: World::default(),
            described: Arc::clone(&start.described),
            palette: Arc::clone(&start.palette),
            arrays: Arrays::default(),
            frame_start: start.time,
        };
        now.restore(&start);
        Self { now, start }
    }

    fn world(&self) -> &World {
        &self.now.world
    }

    fn reset(&mut self) {
        self.now.restore(&self.start);
    }
}
