//! What rules keep: energy, places, the account of what moving colliders do.

use carom::{BodyPair, ColliderId, DQuat, DVec3, PersistentContact, Pose, World};
use carom_scene::Scene;
use carom_scene::scene::{Boundary, Collider, Force, Rule, Shape};

use crate::fault::Fault;

/// Part of the energy by which the account of a frame of `exact` may be open: far more than the rounding of its entries.
const OPEN_ACCOUNT: f64 = 1e-9;

/// The same part where surfaces move: there the energy of a piece of path is not restored.
const OPEN_ACCOUNT_OF_MOVERS: f64 = 1e-5;

/// The same part where spheres lie on each other: what a piece of their path may add.
const OPEN_ACCOUNT_OF_HEAPS: f64 = 1e-7;

/// Part of the energy that a frame of `contact` may add, besides the first-order error of the energy in a field of a
/// sphere that meets several bodies in a sub-step: it moves by its last velocity.
const CONTACT_GAIN: f64 = 1e-3;

/// Allowed overlap, as a part of the smallest radius, plus a part of the largest one, by which a piece of path
/// along a curve may miss.
const OVERLAP: f64 = 1e-6;
const MISS: f64 = 1e-7;

/// Part of the largest speed of approach in a frame above which a speed counts as closing.
const CLOSES: f64 = 1e-6;

/// Part of the impulses of moving colliders, times the speeds of these, by which their work may differ from impulses times
/// ways: rounding of a sum, and of the places where they are at an impact.
const OPEN_WORK: f64 = 1e-12;

/// Laws that the rule of a scene keeps, with what is needed to check them in the next frame.
#[derive(Debug, Clone)]
pub struct Keeps {
    /// Part of the energy by which the account of a frame may be open.
    account: Option<f64>,
    /// Part of the energy that a frame may add.
    gain: Option<f64>,
    /// Change of its speed \[m/s\] that accounts for a further error of the energy of a sphere.
    speed_error: f64,
    no_overlap: bool,
    /// Whether colliders move.
    is_driven: bool,
    /// The container that keeps what is inside, with its id.
    container: Option<(ColliderId, Collider)>,
    /// Energy after the frame before \[J\].
    energy: f64,
    /// The largest energy of any kind so far \[J\].
    scale: f64,
    /// Whether spheres were stepped in the frame before, and whether they ever were.
    was_stepped: bool,
    has_been_stepped: bool,
    /// Whether spheres lay on each other at the end of this frame or of the one before.
    are_heaped: [bool; 2],
    /// Time of the world after the frame before \[s\].
    time: f64,
}

/// Whether surfaces move; they do work, and their places depend on frames.
pub fn is_driven(scene: &Scene) -> bool {
    scene.colliders.iter().any(|it| {
        it.velocity != [0.0; 3] || it.angular_velocity != [0.0; 3] || !it.motion.is_empty()
    })
}

impl Keeps {
    /// What is kept of a world that its scene has just made.
    pub fn of(scene: &Scene, world: &World) -> Self {
        let rule = scene.simulation.rule;
        let is_driven = is_driven(scene);
        let ids = world.colliders().map(|(id, _)| id);
        let mut colliders = ids.zip(&scene.colliders);
        let container = colliders.find(|(_, it)| matches!(it.shape, Shape::Container { .. }));
        let is_solid = matches!(rule, Rule::Exact | Rule::Contact);
        let is_kept = is_solid && !is_driven;
        // What moves may press a sphere through another collider, or leave an emitter behind.
        let is_alone = scene.colliders.len() == 1 && scene.emitters.is_empty();
        let is_closed = is_solid && (!is_driven || is_alone);
        // A motion may begin elsewhere.
        let holds_all = |id: ColliderId, container: &Collider| {
            let is_in = |center: &DVec3, pose: Pose| !is_out(*center, container, pose);
            let positions = world.spheres().positions();
            world.collider(id).is_ok_and(|it| positions.iter().all(|at| is_in(at, it.pose)))
        };
        let is_constant =
            |force: &Force| matches!(force, Force::Gravity { .. } | Force::Constant { .. });
        let is_held = |force: &Force| matches!(force, Force::MutualGravity { .. });
        let is_open = scene.simulation.boundary == Boundary::default();
        // Potentials jump at the faces of a periodic box.
        let is_free = scene.forces.is_empty() && scene.springs.is_empty();
        let has_account = (is_open || is_free) && !scene.forces.iter().any(is_held);
        // Under `contact` it is rounding where no field bends a path.
        let is_exact = rule == Rule::Exact || rule == Rule::Contact && is_free && !is_open;
        let keeps_energy = is_open
            && scene.springs.is_empty()
            && scene.forces.iter().all(is_constant)
            && scene.colliders.iter().all(|it| it.surface_velocity == [0.0; 3])
            && scene.emitters.is_empty();
        let open = if is_driven { OPEN_ACCOUNT_OF_MOVERS } else { OPEN_ACCOUNT };
        let energy = world.total_energy();
        Self {
            account: (is_exact && has_account).then_some(open),
            gain: match rule {
                Rule::Contact if is_kept && keeps_energy => Some(CONTACT_GAIN),
                _ => None,
            },
            speed_error: if rule == Rule::Contact { speed_of_sub_step(scene) } else { 0.0 },
            no_overlap: rule == Rule::Exact
                && !is_driven
                && scene.simulation.spheres_collide
                // What is emitted has room where it overlaps by a thousandth.
                && scene.emitters.is_empty()
                && !scene.colliders.iter().any(passes),
            is_driven,
            container: container
                .filter(|(id, it)| is_closed && holds_all(*id, it))
                .map(|(id, it)| (id, it.clone())),
            energy,
            scale: energy.abs().max(world.kinetic_energy()),
            was_stepped: false,
            has_been_stepped: false,
            are_heaped: [false; 2],
            time: world.time(),
        }
    }

    /// Checks a world after a step.
    ///
    /// # Errors
    /// What was not kept.
    pub fn check(&mut self, world: &World) -> Result<(), Fault> {
        let zones = world.report().zone_account;
        let in_zone = zones.joined > 0 || zones.spheres > 0;
        self.has_been_stepped |= in_zone;
        // A frame after one of stepped spheres may end what that began.
        let is_possible = !leaves_no_way_out(world);
        let is_exact = !in_zone && !self.was_stepped && is_possible;
        // What moving surfaces do in a zone is known less well.
        let closes = is_exact || is_possible && !self.is_driven;
        let is_pair = |it: &PersistentContact| matches!(it.between, BodyPair::Spheres(..));
        self.are_heaped = [self.are_heaped[1], world.contacts().iter().any(is_pair)];
        self.check_energy(world, is_exact, closes)
            .and_then(|()| self.check_work(world))
            .and_then(|()| self.check_places(world))
            .map_err(|said| Fault::Law(format!("{said}, at {} s", world.time())))?;
        (self.was_stepped, self.time) = (in_zone, world.time());
        Ok(())
    }

    /// Checks the account of a frame where it `closes`, and that the energy of one that `is_exact` does not grow.
    fn check_energy(&mut self, world: &World, is_exact: bool, closes: bool) -> Result<(), String> {
        let account = world.report().energy_account;
        let now = world.total_energy();
        if !now.is_finite() {
            return Err(format!("has energy {now}"));
        }
        let of_bodies = [account.contacts, account.colliders, account.kicks, account.growth];
        let driven = [account.shear, account.thermostat];
        let others = [account.forces, account.applied, account.emission];
        let most = self.scale.max(world.kinetic_energy());
        self.scale = of_bodies
            .iter()
            .chain(&driven)
            .chain(&others)
            .fold(most, |most, it| most.max(it.abs()));
        let (change, scale) = (now - self.energy, self.scale);
        self.energy = now;
        let rest = change - account.total();
        let heaps = if self.are_heaped.contains(&true) { OPEN_ACCOUNT_OF_HEAPS } else { 0.0 };
        if closes && self.account.is_some_and(|most| rest.abs() > most.max(heaps) * scale) {
            return Err(format!(
                "has {rest:e} J too much for its account {account:?}, its energy being {scale:e} J"
            ));
        }
        let gain = change - account.correction.max(0.0) - account.kicks;
        let uncertain = self.speed_error * momenta(world);
        if is_exact && self.gain.is_some_and(|most| gain > most * scale + uncertain) {
            return Err(format!("gains {gain:e} J, its energy being {scale:e} J"));
        }
        Ok(())
    }

    /// Force times way: the work that moving colliders did in the impacts of a group is that of their impulses on the way of
    /// the surface.
    fn check_work(&self, world: &World) -> Result<(), String> {
        // There a place may be that of an image, which what moves has not.
        if world.settings().boundary != carom::Boundary::Open {
            return Ok(());
        }
        let report = world.report();
        for group in &report.groups {
            let (mut work, mut scale) = (0.0, 0.0);
            for impact in &report.impacts[group.first..group.first + group.count] {
                let BodyPair::Collider { collider, .. } = impact.between else { continue };
                let Ok(collider) = world.collider(collider) else { continue };
                if !collider.motion.is_empty() {
                    // How fast it was then does not follow from how fast it is.
                    (work, scale) = (group.collider_work, 0.0);
                    break;
                }
                // Colliders are where the frame ends.
                let left = world.time() - (self.time + impact.time);
                let arm = impact.point - (collider.pose.position - left * collider.velocity);
                let turned = DQuat::from_scaled_axis(-left * collider.angular_velocity);
                let belt =
                    turned * (collider.pose.rotation.normalize() * collider.surface_velocity);
                let velocity = collider.velocity + collider.angular_velocity.cross(arm);
                let impulse = impact.impulse * impact.normal + impact.tangential_impulse;
                work += impulse.dot(velocity) + impact.tangential_impulse.dot(belt);
                let turning = collider.angular_velocity.length() * arm.length();
                let speed = collider.velocity.length() + belt.length() + turning;
                scale += impulse.length() * speed;
            }
            let told = group.collider_work;
            if (told - work).abs() > OPEN_WORK * scale {
                return Err(format!("has {told:e} J of colliders, whose impulses did {work:e} J"));
            }
        }
        Ok(())
    }

    fn check_places(&self, world: &World) -> Result<(), String> {
        let spheres = world.spheres();
        if spheres.positions().iter().any(|it| !it.is_finite()) {
            return Err("is nowhere".to_owned());
        }
        if let Some((id, container)) = &self.container
            && let Ok(now) = world.collider(*id)
            && let Some(out) =
                spheres.positions().iter().find(|&&it| is_out(it, container, now.pose))
        {
            return Err(format!("has a sphere outside its container, at {out}"));
        }
        let smallest = spheres.radii().iter().copied().fold(f64::INFINITY, f64::min);
        let largest = spheres.radii().iter().copied().fold(0.0, f64::max);
        let overlap = world.overlaps(0.0).into_iter().map(|it| it.depth).fold(0.0, f64::max);
        let is_exact = self.no_overlap && !self.has_been_stepped;
        if is_exact && overlap > OVERLAP * smallest + MISS * largest {
            return Err(format!("overlaps by {:e} of its smallest radius", overlap / smallest));
        }
        Ok(())
    }
}

/// Whether spheres come through it from behind.
fn passes(collider: &Collider) -> bool {
    let shape = &collider.shape;
    matches!(
        shape,
        Shape::Rectangle { .. }
            | Shape::Disc { .. }
            | Shape::HeightField(_)
            | Shape::Mesh(_)
            | Shape::Track(_)
    )
}

/// Whether bodies still close after an impact: surfaces that move leave a ball no way out, and no impulses answer that.
fn leaves_no_way_out(world: &World) -> bool {
    let impacts = &world.report().impacts;
    let fastest = impacts.iter().map(|it| it.approach_speed.abs()).fold(0.0, f64::max);
    impacts.iter().any(|it| it.separation_speed < -CLOSES * fastest)
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

/// Whether the centre of a sphere is outside a container without open sides, which has this pose now.
fn is_out(center: DVec3, container: &Collider, pose: Pose) -> bool {
    let Shape::Container { size, ref open } = container.shape else { return false };
    if !open.is_empty() {
        return false;
    }
    let place = pose.rotation.normalize().inverse() * (center - pose.position);
    place.abs().cmpgt(0.5 * DVec3::from_array(size)).any()
}
