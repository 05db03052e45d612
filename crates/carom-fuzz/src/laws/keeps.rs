//! Laws that hold of every world, or of those of a rule.

use carom::{DQuat, DVec3, StopRequest, World};
use carom_scene::scene::{Boundary, Collider, Force, Rule, Shape};
use carom_scene::{Checkpoint, Palette, Scene};

use crate::fault::Fault;
use crate::target::PATIENCE;

/// Frames that a world is taken.
const FRAMES: usize = 64;

/// Part of the energy by which the account of a frame of `exact` may be open: the square of the angle by which a normal
/// turns in a piece of path along a curve.
const OPEN_ACCOUNT: f64 = 1e-6;

/// That where surfaces move: nothing restores the energy of a piece of path then.
const OPEN_ACCOUNT_OF_MOVERS: f64 = 1e-5;

/// That of `contact`, besides what a field does in a sub-step to a sphere that meets several bodies in it: that moves by its
/// last velocity, and its energy in the field is right in first order.
const CONTACT_GAIN: f64 = 1e-3;

/// Overlap that may be, as a part of the smallest radius; and besides, as one of the largest: by so much a piece of
/// path along a curve may miss.
const OVERLAP: f64 = 1e-6;
const MISS: f64 = 1e-7;

/// Takes a world some frames, and checks what must hold of it.
///
/// # Errors
/// The law that does not hold.
pub fn check(scene: &Scene) -> Result<(), Fault> {
    let mut world = world(scene)?;
    let middle = run(scene, &mut world, FRAMES / 2, Seen::default())?;
    let (snapshot, bytes) = (world.snapshot(), checkpoint(scene, &world)?);
    let seen = run(scene, &mut world, FRAMES / 2, middle)?;
    let end = world.state_hash();
    let is_same = |it: &World, what: &str| {
        let hash = it.state_hash();
        law(hash == end, || format!("ends otherwise {what}: {hash}, not {end}"))
    };

    world.restore(&snapshot);
    run(scene, &mut world, FRAMES / 2, middle)?;
    is_same(&world, "from a snapshot")?;

    let read = Checkpoint::from_bytes(&bytes);
    let read = read.map_err(|error| Fault::Law(format!("its checkpoint is refused: {error}")))?;
    let mut other = self::world(scene)?;
    other.restore(&read.snapshot);
    run(scene, &mut other, FRAMES / 2, middle)?;
    is_same(&other, "from a checkpoint")?;

    let mut other = self::world(scene)?;
    run(scene, &mut other, FRAMES, Seen::default())?;
    is_same(&other, "the second time")?;
    if scene.simulation.rule == Rule::Exact && !is_driven(scene) && seen == Seen::default() {
        check_other_frames(scene, &world)?;
    }
    Ok(())
}

/// What was seen of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Seen {
    /// Whether spheres were stepped, which loses what holds of events.
    zone: bool,
    /// Whether a contact lasted: its forces may be held for a time.
    contact: bool,
}

/// Whether surfaces move, which do work, and are where frames take them.
fn is_driven(scene: &Scene) -> bool {
    scene.colliders.iter().any(|it| it.velocity != [0.0; 3])
}

fn law(holds: bool, broken: impl FnOnce() -> String) -> Result<(), Fault> {
    if holds { Ok(()) } else { Err(Fault::Law(broken())) }
}

fn world(scene: &Scene) -> Result<World, Fault> {
    let mut world = scene.world().map_err(|it| Fault::Law(format!("makes no world: {it}")))?;
    let began = std::time::Instant::now();
    world.set_stop_request(Some(StopRequest::new(move || began.elapsed() > PATIENCE)));
    Ok(world)
}

fn checkpoint(scene: &Scene, world: &World) -> Result<Vec<u8>, Fault> {
    let palette = Palette::new(scene).map_err(|it| Fault::Law(format!("has no colours: {it}")))?;
    let bytes = Checkpoint::bytes_of(&world.snapshot(), scene, &palette);
    bytes.map_err(|it| Fault::Law(format!("has no bytes: {it}")))
}

/// Takes a world some frames, and checks the laws of its rule after each; tells what was seen until then, with what was
/// before.
fn run(scene: &Scene, world: &mut World, frames: usize, before: Seen) -> Result<Seen, Fault> {
    let keeps = Keeps::of(scene);
    let mut seen = before;
    let (mut energy, mut was_stepped) = (world.total_energy(), false);
    let mut scale = energy.abs().max(world.kinetic_energy());
    for _ in 0..frames {
        let report = world.step(scene.simulation.frame_time);
        let report = report.map_err(|it| match it {
            carom::Error::Stopped { .. } => Fault::Slow(PATIENCE),
            it => Fault::Law(format!("stops: {it}")),
        })?;
        let in_zone = report.zone_account.joined > 0 || report.zone_account.spheres > 0;
        seen.zone |= in_zone;
        let account = report.energy_account;
        seen.contact |= !world.contacts().is_empty();
        let at = format!("at {} s", world.time());
        let now = world.total_energy();
        let given = [account.contacts, account.colliders, account.emission];
        scale = given.iter().fold(scale.max(world.kinetic_energy()), |most, it| most.max(it.abs()));
        law(now.is_finite(), || format!("has energy {now} {at}"))?;
        let rest = now - energy - account.total();
        let is_closed = keeps.account.is_none_or(|most| rest.abs() <= most * scale);
        law(in_zone || was_stepped || is_closed, || {
            format!(
                "has {rest:e} J too much for its account {account:?}, its energy being {scale:e} J, {at}"
            )
        })?;
        let gain = now - energy - account.correction.max(0.0);
        // A frame after one of stepped spheres may end what that began.
        let uncertain = keeps.speed_error * momenta(world);
        let is_kept = keeps.gain.is_none_or(|most| gain <= most * scale + uncertain);
        law(in_zone || was_stepped || is_kept, || {
            format!("gains {gain:e} J, its energy being {scale:e} J, {at}")
        })?;
        (energy, was_stepped) = (now, in_zone);
        check_places(world, &keeps, seen.zone).map_err(|it| Fault::Law(format!("{it} {at}")))?;
    }
    Ok(seen)
}

/// What the rule of a scene keeps.
struct Keeps {
    /// Part of the energy by which the account of a frame may be open.
    account: Option<f64>,
    /// Part of the energy that a frame may add.
    gain: Option<f64>,
    /// By which change of its speed \[m/s\] the energy of a sphere may be wrong besides.
    speed_error: f64,
    no_overlap: bool,
    /// The container that keeps what is inside.
    container: Option<Collider>,
}

impl Keeps {
    fn of(scene: &Scene) -> Self {
        let rule = scene.simulation.rule;
        let is_driven = is_driven(scene);
        let mut colliders = scene.colliders.iter();
        let container = colliders.find(|it| matches!(it.shape, Shape::Container { .. }));
        let is_solid = matches!(rule, Rule::Exact | Rule::Contact);
        // What moves may press a sphere through what stands.
        let is_kept = is_solid && !is_driven;
        // Where an impact cuts the time for which they are held, springs keep energy to the second order only.
        let is_constant =
            |force: &Force| matches!(force, Force::Gravity { .. } | Force::Constant { .. });
        let has_account = scene.simulation.boundary == Boundary::default()
            && scene.springs.is_empty()
            && scene.forces.iter().all(is_constant);
        let keeps_energy = has_account && scene.emitters.is_empty();
        let open = if is_driven { OPEN_ACCOUNT_OF_MOVERS } else { OPEN_ACCOUNT };
        Self {
            account: (rule == Rule::Exact && has_account).then_some(open),
            gain: match rule {
                Rule::Contact if is_kept && keeps_energy => Some(CONTACT_GAIN),
                _ => None,
            },
            speed_error: if rule == Rule::Contact { speed_of_sub_step(scene) } else { 0.0 },
            no_overlap: rule == Rule::Exact && !is_driven,
            container: container.filter(|_| is_kept).cloned(),
        }
    }
}

/// Sum of the sizes of all momenta \[kg m/s\].
fn momenta(world: &World) -> f64 {
    let spheres = world.spheres();
    let moving = spheres.masses().iter().zip(spheres.velocities());
    moving.map(|(mass, velocity)| mass * velocity.length()).sum()
}

/// What gravity adds to a speed in a sub-step of `contact` \[m/s\].
fn speed_of_sub_step(scene: &Scene) -> f64 {
    let length = scene.simulation.frame_time / f64::from(scene.simulation.contact.sub_steps);
    let gravity = scene.forces.iter().map(|force| match force {
        Force::Gravity { acceleration } => DVec3::from_array(*acceleration).length(),
        _ => 0.0,
    });
    length * gravity.sum::<f64>()
}

/// Whether the centre of a sphere is outside a container.
fn is_out(center: DVec3, container: &Collider) -> bool {
    let Shape::Container { size, .. } = container.shape else { return false };
    let rotation = DQuat::from_array(container.rotation).normalize();
    let place = rotation.inverse() * (center - DVec3::from_array(container.position));
    place.abs().cmpgt(0.5 * DVec3::from_array(size)).any()
}

fn check_places(world: &World, keeps: &Keeps, in_zone: bool) -> Result<(), String> {
    let spheres = world.spheres();
    if spheres.positions().iter().any(|it| !it.is_finite()) {
        return Err("is nowhere".to_owned());
    }
    if let Some(container) = &keeps.container
        && let Some(out) = spheres.positions().iter().find(|&&it| is_out(it, container))
    {
        return Err(format!("has a sphere outside its container, at {out}"));
    }
    let smallest = spheres.radii().iter().copied().fold(f64::INFINITY, f64::min);
    let largest = spheres.radii().iter().copied().fold(0.0, f64::max);
    let overlap = world.overlaps(0.0).into_iter().map(|it| it.depth).fold(0.0, f64::max);
    if keeps.no_overlap && !in_zone && overlap > OVERLAP * smallest + MISS * largest {
        return Err(format!("overlaps by {:e} of its smallest radius", overlap / smallest));
    }
    Ok(())
}

/// Frames of half the length come to the same place: forces that are held know no frames.
fn check_other_frames(scene: &Scene, end: &World) -> Result<(), Fault> {
    let mut scene = scene.clone();
    scene.simulation.frame_time *= 0.5;
    let mut world = world(&scene)?;
    if run(&scene, &mut world, 2 * FRAMES, Seen::default())? != Seen::default() {
        return Ok(());
    }
    let (positions, expected) = (world.spheres().positions(), end.spheres().positions());
    law(positions == expected, || {
        let pairs = positions.iter().zip(expected);
        let far = pairs.map(|(one, other)| (*one - *other).length()).fold(0.0, f64::max);
        format!("comes to another place by frames of half the length, {far:e} m away")
    })
}
