//! Laws that hold of every world, or of those of a rule, without anything to compare with but the world itself.
//!
//! A world is taken some frames. What its rule *keeps* is checked after each of them ([`keeps`]); it comes to the same
//! end from a snapshot, from bytes and the second time; and a [`Pair`](pair::Pair) of it, the same world scaled,
//! mirrored, in motion, in another order, in other frames or run back, goes the same way as far as rounding lets that be seen.

mod elsewhere;
mod frames;
mod keeps;
mod mirror;
mod motion;
mod order;
mod pair;
mod perturbed;
mod reversal;
mod run;
mod scaling;
mod trace;

use carom::World;
use carom_scene::{Checkpoint, Scene};

use self::keeps::Keeps;
use self::pair::Law;
use self::run::{FRAMES, checkpoint, jams, law, run, world};
use self::trace::Trace;
use crate::fault::Fault;

/// Laws about a world and a changed copy of it.
const LAWS: [Law; 7] = [
    scaling::SMALLER,
    scaling::LARGER,
    mirror::LAW,
    order::LAW,
    motion::LAW,
    frames::LAW,
    reversal::LAW,
];

/// Steps a world some frames, and checks its laws.
///
/// # Errors
/// The law that does not hold.
pub fn check(scene: &Scene) -> Result<(), Fault> {
    if jams(scene)? {
        return Ok(());
    }
    let mut world = world(scene)?;
    let mut keeps = Keeps::of(scene, &world);
    let mut trace = Trace::new(&world);
    run(scene, &mut world, FRAMES / 2, &mut keeps, &mut trace)?;
    let (snapshot, bytes, middle) = (world.snapshot(), checkpoint(scene, &world)?, keeps.clone());
    run(scene, &mut world, FRAMES / 2, &mut keeps, &mut trace)?;
    let end = world.state_hash();
    let is_same = |it: &World, what: &str| {
        let hash = it.state_hash();
        law(hash == end, || format!("ends otherwise {what}: {hash}, not {end}"))
    };

    world.restore(&snapshot);
    let ignored = &mut Trace::default();
    run(scene, &mut world, FRAMES / 2, &mut middle.clone(), ignored)?;
    is_same(&world, "from a snapshot")?;

    let read = Checkpoint::from_bytes(&bytes);
    let read = read.map_err(|error| Fault::Law(format!("its checkpoint is refused: {error}")))?;
    let mut other = run::world(scene)?;
    other.restore(&read.snapshot);
    run(scene, &mut other, FRAMES / 2, &mut middle.clone(), ignored)?;
    is_same(&other, "from a checkpoint")?;

    let mut other = run::world(scene)?;
    let mut keeps = Keeps::of(scene, &other);
    run(scene, &mut other, FRAMES, &mut keeps, ignored)?;
    is_same(&other, "the second time")?;
    pair::check(&LAWS, scene, &trace)
}
