//! The worlds of a batch.

use std::collections::BTreeMap;
use std::sync::Arc;

use carom::{Collider, ColliderId, DVec3, SphereId, StepReport, StopRequest, World};
use carom_scene::scene::Motion;
use rayon::prelude::*;

use super::observed::{Columns, Row};
use super::stroke::Stroke;
use crate::editing;
use crate::failure::Failure;
use crate::inner::Inner;
use crate::next_poses::NextPoses;
use crate::quantity::Quantity;
use crate::setting;
use crate::snapshot::State;
use crate::stop::Watch;
use crate::threads::Pool;
use crate::written::{self, Written};

/// Smallest number of spheres per task of a thread: sharing less work costs more than it saves.
const SPHERES_PER_TASK: usize = 64;

/// Worlds that step together. No result depends on the number of threads.
#[derive(Debug)]
pub struct Members {
    members: Vec<Member>,
    /// `None` if one thread does everything.
    pool: Option<Pool>,
    memory: Memory,
}

/// Working memory of worlds that step one after the other.
#[derive(Debug, Default)]
struct Memory {
    /// Has the memory of steps.
    spare: World,
    values: Vec<f64>,
}

/// What all worlds are to do in a step.
struct Orders<'a> {
    /// \[s\]; `None` for each world's own frame time.
    dt: Option<f64>,
    poses: Option<&'a NextPoses>,
    request: StopRequest,
    watch: &'a Watch,
}

/// A world, its frames and the place of its observation.
type Task<'a, 'b> = (&'a mut Member, (&'a mut Progress, &'a mut Row<'b>));

/// Remaining work of a world.
#[derive(Debug, Clone, Default)]
pub struct Progress {
    /// Number of frames.
    pub left: u64,
    /// The row of the world in what is given for each world that steps.
    pub row: usize,
    /// Error of the frame that the world refused; then no frames remain.
    pub refused: Option<Failure>,
}

impl Progress {
    /// Returns whether a signal handler ended the frames.
    pub fn is_stopped(&self) -> bool {
        self.refused.as_ref().is_some_and(Failure::is_stop)
    }
}

#[derive(Debug)]
struct Member {
    now: Inner,
    start: Arc<State>,
    /// Number of impacts in the last step.
    impacts: u64,
}

impl Members {
    /// Makes worlds in these states: one state for all `count`, or one for each.
    ///
    /// # Errors
    /// [`Failure`] for no worlds, and if there is not enough memory.
    pub fn new(starts: Vec<State>, count: usize, pool: Option<Pool>) -> Result<Self, Failure> {
        if count == 0 || ![1, count].contains(&starts.len()) {
            return Err(Failure::value("n", format_args!("must be at least 1, not {count}")));
        }
        let mut starts: Vec<Arc<State>> = starts.into_iter().map(Arc::new).collect();
        let last = Arc::clone(&starts[starts.len() - 1]);
        let mut members: Vec<Member> = Vec::new();
        let no_room = |_| Failure::memory(format_args!("there is no memory for {count} worlds"));
        members.try_reserve_exact(count).map_err(no_room)?;
        starts.try_reserve_exact(count).map_err(no_room)?;
        starts.resize(count, last);
        members.extend(starts.into_iter().map(Member::new));
        Ok(Self { members, pool, memory: Memory::default() })
    }

    pub fn len(&self) -> usize {
        self.members.len()
    }

    pub fn worlds(&self) -> impl Iterator<Item = &World> {
        self.members.iter().map(Member::world)
    }

    /// Returns the report of the last frame of each world, and the time when the frame started
    /// \[s\].
    pub fn reports(&self) -> impl Iterator<Item = (f64, &StepReport)> {
        self.members.iter().map(|it| (it.now.frame_start, it.world().report()))
    }

    /// Returns the frame time of the first world's scene \[s\].
    pub fn frame_time(&self) -> f64 {
        self.members[0].now.frame_time(None)
    }

    /// Returns the largest number of spheres in any world.
    pub fn most_spheres(&self) -> usize {
        self.worlds().map(|world| world.spheres().len()).max().unwrap_or(0)
    }

    /// Returns the shape of an array of all worlds.
    pub fn shape_of(&self, quantity: Quantity) -> Vec<usize> {
        [vec![self.len()], quantity.shape(self.most_spheres())].concat()
    }

    /// Takes the frames of `progress`, of `dt` \[s\] or of each world's own frame time. The first one takes a collider to
    /// `poses`. Then writes observations into rows. A world that refuses a frame keeps its state before that frame. An
    /// exception in a signal handler stops all worlds.
    pub fn step(
        &mut self,
        (dt, poses): (Option<f64>, Option<&NextPoses>),
        progress: &mut [Progress],
        observed: Option<(Vec<Row<'_>>, &Columns)>,
    ) {
        let watch = Watch::begin();
        let orders = Orders { dt, poses, request: watch.request(), watch: &watch };
        let share = (SPHERES_PER_TASK / self.most_spheres().max(1)).max(1);
        let (mut rows, columns) =
            observed.map_or((Vec::new(), None), |(rows, columns)| (rows, Some(columns)));
        rows.resize_with(self.members.len(), || Row::Nowhere);
        let step = |memory: &mut Memory, (member, (progress, row)): Task<'_, '_>| {
            member.take_frames(&orders, progress, memory);
            if let Some(columns) = columns {
                row.write(member.world(), columns, &mut memory.values);
            }
        };
        let Self { members, pool, memory } = self;
        match pool {
            None => {
                let tasks = members.iter_mut().zip(progress.iter_mut().zip(&mut rows));
                tasks.for_each(|task| step(memory, task));
            }
            Some(pool) => pool.watch(&watch, || {
                let tasks = members.par_iter_mut().zip(progress.par_iter_mut().zip(&mut rows));
                tasks.with_min_len(share).for_each_init(Memory::default, step);
            }),
        }
    }

    /// Resets the worlds with these indices to their start. Ignores unknown indices.
    pub fn reset(&mut self, worlds: &[usize]) {
        for &world in worlds {
            if let Some(member) = self.members.get_mut(world) {
                member.reset();
            }
        }
    }

    /// Returns the number of impacts of each world in the last step.
    pub fn impact_counts(&self) -> impl Iterator<Item = i64> {
        self.members.iter().map(|member| member.impacts as i64)
    }

    /// Returns the state of a world.
    pub fn snapshot(&self, world: usize) -> Option<State> {
        self.members.get(world).map(|member| member.now.snapshot())
    }

    /// Returns the start states without repetition, and for each world the index of its start
    /// state.
    pub fn starts(&self) -> (Vec<State>, Vec<usize>) {
        let mut starts = Vec::new();
        let mut places = BTreeMap::new();
        let place = |member: &Member| {
            *places.entry(Arc::as_ptr(&member.start)).or_insert_with(|| {
                starts.push(State::clone(&member.start));
                starts.len() - 1
            })
        };
        let of_worlds = self.members.iter().map(place).collect();
        (starts, of_worlds)
    }

    /// Sets the state of a world, but keeps its start state.
    ///
    /// # Errors
    /// Those of [`Self::restore`].
    pub fn go_on_from(&mut self, world: usize, snapshot: &State) -> Result<(), Failure> {
        let start = self.members.get(world).map(|member| Arc::clone(&member.start));
        self.restore(world, snapshot)?;
        if let Some((member, start)) = self.members.get_mut(world).zip(start) {
            member.start = start;
        }
        Ok(())
    }

    /// Sets both the state and the start state of a world.
    ///
    /// # Errors
    /// [`Failure`] if there is no such world.
    pub fn restore(&mut self, world: usize, snapshot: &State) -> Result<(), Failure> {
        let member = Member::new(Arc::new(snapshot.clone()));
        let count = self.len();
        let place = self.members.get_mut(world).ok_or_else(|| {
            Failure::value("index", format_args!("must be below {count}, not {world}"))
        })?;
        *place = member;
        Ok(())
    }

    /// Sets a quantity of all spheres in all worlds; if a value is refused, none is set. In
    /// `values` each world has space for the largest number of spheres in any world.
    ///
    /// # Errors
    /// [`Failure`] for an invalid number.
    pub fn set(&mut self, quantity: Quantity, values: &[f64]) -> Result<(), Failure> {
        let places = (quantity.width() * self.most_spheres()).max(1);
        let own_of = |world: &World, number: usize| {
            let first = number * places;
            &values[first..first + quantity.width() * world.spheres().len()]
        };
        // Values that no world accepts are found before any world is changed.
        let may_be = |own: &[f64]| own.iter().all(|&value| quantity.may_be(value));
        let is_wrong = |&number: &usize| !may_be(own_of(self.members[number].world(), number));
        if let Some(number) = (0..self.len()).find(is_wrong) {
            let world = &mut self.members[number].now.world;
            let own = own_of(world, number);
            return setting::set_all(world, quantity, own);
        }
        let mut before = Vec::new();
        for number in 0..self.len() {
            let world = &mut self.members[number].now.world;
            if quantity.is_bounded() {
                before.push(world.snapshot());
            }
            let own = own_of(world, number);
            if let Err(failure) = setting::set_all(world, quantity, own) {
                let both = self.members.iter_mut().zip(&before);
                both.for_each(|(member, before)| member.now.world.restore(before));
                return Err(failure);
            }
        }
        Ok(())
    }
}

impl Members {
    /// Applies the values that a script wrote into arrays of all worlds. If a world refuses a
    /// value, all worlds stay unchanged.
    ///
    /// # Errors
    /// [`Failure`] with the array, the world and the row.
    pub fn take_over(&mut self, written: &[Written]) -> Result<(), Failure> {
        let most = self.most_spheres();
        let of_all = |row: usize| format!("{}, {}", row / most, row % most);
        let spheres_in = |number: usize| self.members[number].world().spheres().len();
        for written in written {
            let is_empty = |row: &&usize| *row % most >= spheres_in(*row / most);
            if let Some(&row) = written.rows.iter().find(is_empty) {
                let spheres = spheres_in(row / most);
                let problem = format_args!("this world has {spheres} spheres");
                return Err(Failure::value(&written.place(&of_all(row)), problem));
            }
            written.check(of_all)?;
        }
        let is_safe = !written.iter().any(|written| written.quantity.is_bounded());
        let mut before = Vec::new();
        let first_rows =
            written.iter().flat_map(|it| it.rows.chunk_by(|&a, &b| a / most == b / most));
        let mut numbers: Vec<usize> = first_rows.map(|rows| rows[0] / most).collect();
        numbers.sort_unstable();
        numbers.dedup();
        for number in numbers {
            let world = &mut self.members[number].now.world;
            let spheres = world.spheres().len();
            let of_world = |it: &Written| it.of_world(number * most, spheres);
            let own: Vec<Written> = written.iter().filter_map(of_world).collect();
            if !is_safe {
                before.push((number, world.snapshot()));
            }
            let taken = written::set_checked(world, &own, |row| format!("{number}, {row}"));
            if taken.is_err() {
                let restore = |(number, before): &(usize, carom::Snapshot)| {
                    self.members[*number].now.world.restore(before);
                };
                before.iter().for_each(restore);
                return taken;
            }
        }
        Ok(())
    }
}

impl Members {
    /// Replaces a collider in these worlds by what `changed` returns for each world and its place among them. If one is
    /// refused, none is replaced.
    ///
    /// # Errors
    /// [`Failure`] with the index of the world.
    pub fn set_colliders(
        &mut self,
        worlds: &[usize],
        id: ColliderId,
        changed: impl Fn(&World, usize) -> Result<Collider, Failure>,
    ) -> Result<(), Failure> {
        let of_world = |(row, &number): (usize, &usize)| {
            changed(self.members[number].world(), row).map_err(|it| it.in_world(number))
        };
        let colliders: Vec<Collider> =
            worlds.iter().enumerate().map(of_world).collect::<Result<_, _>>()?;
        for (&number, collider) in worlds.iter().zip(colliders) {
            self.members[number].now.world.set_collider(id, collider)?;
        }
        Ok(())
    }

    /// Writes the motion of a collider into the descriptions of these worlds.
    ///
    /// # Errors
    /// [`Failure`] if there is no such collider.
    pub fn describe_motion(
        &mut self,
        worlds: &[usize],
        id: ColliderId,
        motion: &[Motion],
    ) -> Result<(), Failure> {
        for &number in worlds {
            let now = &mut self.members[number].now;
            let (_, place) = editing::find_collider(&now.world, id.number())?;
            now.described_mut().colliders[place].motion = motion.to_vec();
        }
        Ok(())
    }

    /// Changes the motion of a sphere in these worlds, by a vector for each of them. If one is refused, none is changed.
    ///
    /// # Errors
    /// [`Failure`] with the index of the world.
    pub fn strike(
        &mut self,
        worlds: &[usize],
        id: SphereId,
        stroke: Stroke,
        rows: &[DVec3],
    ) -> Result<(), Failure> {
        for (&number, &row) in worlds.iter().zip(rows) {
            let checked = stroke.check(self.members[number].world(), id, row);
            checked.map_err(|it| it.in_world(number))?;
        }
        for (&number, &row) in worlds.iter().zip(rows) {
            stroke.apply(&mut self.members[number].now.world, id, row)?;
        }
        Ok(())
    }
}

impl Member {
    fn new(start: Arc<State>) -> Self {
        let (described, palette) = (Arc::clone(&start.described), Arc::clone(&start.palette));
        let mut now = Inner::new(World::default(), described, palette);
        now.restore(&start);
        Self { now, start, impacts: 0 }
    }

    fn world(&self) -> &World {
        &self.now.world
    }

    /// Takes the frames of `progress`.
    fn take_frames(&mut self, orders: &Orders<'_>, progress: &mut Progress, memory: &mut Memory) {
        self.impacts = 0;
        if progress.left == 0 {
            return;
        }
        self.now.world.set_stop_request(Some(orders.request.clone()));
        self.now.world.swap_memory(&mut memory.spare);
        let taken = self.try_frames(orders, progress);
        self.now.world.swap_memory(&mut memory.spare);
        progress.left = 0;
        progress.refused = taken.err();
    }

    fn try_frames(&mut self, orders: &Orders<'_>, progress: &Progress) -> Result<(), Failure> {
        let length = self.now.frame_time(orders.dt);
        if let Some(poses) = orders.poses {
            let collider = poses.collider(&self.now.world, progress.row, length)?;
            self.now.world.set_collider(poses.id(), collider)?;
        }
        for _ in 0..progress.left {
            self.now.take_frame(length, orders.watch)?;
            self.impacts += self.world().report().impacts.len() as u64;
        }
        Ok(())
    }

    fn reset(&mut self) {
        self.now.restore(&self.start);
        self.impacts = 0;
    }
}
