//! The space that a picture of a scene must show: where its balls are during its first seconds.

use std::collections::{BTreeMap, BTreeSet};

use carom::{Collider, DVec3, Shape, SpringEnd, World};
use carom_scene::Scene;
use carom_scene::scene::{Emitter, Simulation};

use crate::bounds::Bounds;

/// The part of space that a camera is fitted to. Surfaces without end are cut off there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Framing {
    /// Box around the balls and all finite surfaces.
    pub whole: Bounds,
    /// Box around the balls alone, without those that fly away.
    pub balls: Bounds,
}

/// Simulated time that is examined \[s\].
const FIRST_SECONDS: f64 = 3.0;

/// Largest number of frames times balls that are simulated to find where balls go: some tenths of a
/// second at worst.
const MOST_WORK: usize = 20_000;

/// Distance within which a plane without end belongs to a scene, in radii of its balls and in radii
/// of the box around them.
const NEAR_PLANE: [f64; 2] = [100.0, 4.0];

/// Distance from the scene's initial box within which balls stay in the picture if they never go
/// farther, in radii of that box and in radii of the balls.
const STAYING: [f64; 2] = [1.0, 40.0];

/// Multiples of [`STAYING`], from which the first is taken within which half of the balls stay; the first of all if
/// there is none. Only two where finite surfaces would become small.
const STAYING_TIMES: [f64; 3] = [1.0, 2.0, 4.0];

/// [`STAYING`] for balls that go farther than that while others stay.
const LEAVING: [f64; 2] = [0.25, 12.0];

/// [`STAYING`] if all balls go farther than that: no ball becomes a dot beside others.
const ALL_LEAVING: [f64; 2] = [2.0, 250.0];

impl Framing {
    /// The framing of an empty scene.
    pub const UNIT: Self = Self { whole: Bounds::UNIT, balls: Bounds::UNIT };

    /// Returns the space swept in the first seconds of a scene, or in all of a shorter one; `None`
    /// for a scene without balls and finite surfaces. A ball that flies away from the others no
    /// longer counts once it has left, unless springs and threads hold it at a fixed point. A scene
    /// of very many balls is taken as it is at the start.
    pub fn of_scene(scene: &Scene) -> Option<Self> {
        let mut world = scene.world().ok()?;
        let visible: Vec<_> = scene.all_colliders().iter().map(|it| it.visible).collect();
        let colliders =
            || world.colliders().zip(&visible).filter(|it| *it.1).map(|((_, it), _)| it);
        let finite = surfaces(&world, &visible, |_| true);
        let fixed = Bounds::around(finite.into_iter().chain(fixed_ends(&world)));
        let balls = Bounds::around(spheres(&world).map(|it| it.1).chain(emitters(scene)));
        let balls = balls.or(fixed)?;
        let radius = mean_radius(&world, scene).unwrap_or(0.1 * balls.radius());
        let reach = |[of_balls, of_box]: [f64; 2]| (of_balls * radius).max(of_box * balls.radius());
        let feet = feet(colliders(), &balls, reach(NEAR_PLANE));
        let start = [fixed, feet].into_iter().flatten().fold(balls, Bounds::with);
        let around = |[of_box, of_balls]: [f64; 2]| {
            start.grown((of_box * start.radius()).max(of_balls * radius))
        };
        let staying = STAYING_TIMES.map(|times| STAYING.map(|it| it * times));
        let limits: Vec<Bounds> =
            (staying.into_iter().chain([LEAVING, ALL_LEAVING])).map(around).collect();
        let sweep = Sweep::new(&mut world, &scene.simulation, &limits, &visible);
        Some(sweep.framing(start, balls, finite.is_some()))
    }
}

/// Returns the box around the finite visible colliders for which `counts` is true.
fn surfaces(world: &World, visible: &[bool], counts: fn(&Collider) -> bool) -> Option<Bounds> {
    let shown = world.colliders().zip(visible).filter(|it| *it.1).map(|((_, it), _)| it);
    let boxes = shown.filter(|it| counts(it));
    Bounds::around(boxes.filter_map(|it| Bounds::of_shape(it.shape.clone(), it.pose)))
}

fn moves(collider: &Collider) -> bool {
    let has_velocity = collider.velocity != DVec3::ZERO || collider.angular_velocity != DVec3::ZERO;
    has_velocity || !collider.motion.is_empty()
}

/// Returns the number of each sphere and the box around it.
fn spheres(world: &World) -> impl Iterator<Item = (u64, Bounds)> {
    let spheres = world.spheres();
    let places = spheres.positions().iter().zip(spheres.radii());
    let boxes = places.map(|(center, radius)| Bounds::from_sphere(*center, *radius));
    spheres.ids().iter().map(|id| id.number()).zip(boxes)
}

/// Returns boxes around the positions at which emitters release balls.
fn emitters(scene: &Scene) -> impl Iterator<Item = Bounds> {
    let around = |it: &Emitter| Bounds::from_sphere(it.position.into(), emitted_radius(it));
    scene.emitters.iter().map(around)
}

fn emitted_radius(emitter: &Emitter) -> f64 {
    let sphere = &emitter.sphere;
    sphere.radius.or(sphere.diameter.map(|it| 0.5 * it)).unwrap_or(0.5)
}

/// Returns the points at which springs and threads are fixed.
fn fixed_ends(world: &World) -> impl Iterator<Item = Bounds> {
    world.springs().filter_map(|(_, spring)| match spring.to {
        SpringEnd::Point(point) => Some(Bounds::at(point)),
        SpringEnd::Sphere(_) => None,
    })
}

/// Returns the numbers of the spheres that springs and threads connect to a fixed point, directly
/// or through other spheres.
fn tethered(world: &World) -> BTreeSet<u64> {
    let mut joined = BTreeMap::<u64, Vec<u64>>::new();
    let mut found = Vec::new();
    for (_, spring) in world.springs() {
        let first = spring.sphere.number();
        match spring.to {
            SpringEnd::Point(_) => found.push(first),
            SpringEnd::Sphere(second) => {
                joined.entry(first).or_default().push(second.number());
                joined.entry(second.number()).or_default().push(first);
            }
        }
    }
    let mut tethered = BTreeSet::new();
    while let Some(number) = found.pop() {
        if tethered.insert(number) {
            found.extend(joined.get(&number).into_iter().flatten());
        }
    }
    tethered
}

/// Returns the mean radius of the balls at the start, else of those that emitters release.
fn mean_radius(world: &World, scene: &Scene) -> Option<f64> {
    let emitted = || scene.emitters.iter().map(emitted_radius).collect();
    let radii = world.spheres().radii();
    let radii = if radii.is_empty() { emitted() } else { radii.to_vec() };
    (!radii.is_empty()).then(|| radii.iter().sum::<f64>() / radii.len() as f64)
}

/// Returns the box around the points that are nearest to a box on planes without end, for planes
/// not farther away than `reach` \[m\].
fn feet<'a>(
    colliders: impl Iterator<Item = &'a Collider>,
    of: &Bounds,
    reach: f64,
) -> Option<Bounds> {
    let planes = colliders.filter(|it| it.shape == Shape::HalfSpace && !it.trigger);
    let feet = planes.flat_map(|plane| {
        let normal = plane.pose.rotation.normalize() * DVec3::Y;
        let feet = of.corners().map(|corner| {
            let height = normal.dot(corner - plane.pose.position);
            (height, corner - height * normal)
        });
        let nearest = feet.iter().map(|it| it.0).fold(f64::INFINITY, f64::min);
        feet.into_iter().filter(move |_| nearest <= reach).map(|(_, foot)| foot)
    });
    Bounds::around(feet.map(Bounds::at))
}

/// Space that a ball sweeps within a limit.
#[derive(Clone, Copy, Default)]
struct Swept {
    within: Option<Bounds>,
    left: bool,
}

impl Swept {
    fn add(&mut self, limit: &Bounds, sphere: Bounds) {
        if limit.holds(&sphere) {
            self.within = Some(self.within.map_or(sphere, |it| it.with(sphere)));
        } else {
            self.left = true;
        }
    }
}

/// Space that balls and moving surfaces sweep in the first seconds.
struct Sweep {
    /// Swept path of each ball within each limit. Tethered balls have the last limit in place of
    /// every other.
    balls: BTreeMap<u64, Vec<Swept>>,
    surfaces: Option<Bounds>,
}

impl Sweep {
    /// Simulates the first seconds of a world, whose colliders are `visible` or not.
    fn new(
        world: &mut World,
        simulation: &Simulation,
        limits: &[Bounds],
        visible: &[bool],
    ) -> Self {
        let tethered = tethered(world);
        let farthest = &limits[limits.len() - 1];
        let mut sweep = Self { balls: BTreeMap::new(), surfaces: None };
        let frame_time = simulation.frame_time;
        let frames = (FIRST_SECONDS.min(simulation.duration) / frame_time).ceil() as usize;
        let mut work = 0;
        for _ in 0..frames {
            work += world.spheres().len().max(1);
            if work > MOST_WORK || world.step(frame_time).is_err() {
                break;
            }
            for (number, sphere) in spheres(world) {
                let new = || vec![Swept::default(); limits.len()];
                let swept = sweep.balls.entry(number).or_insert_with(new);
                let is_tethered = tethered.contains(&number);
                for (swept, limit) in swept.iter_mut().zip(limits) {
                    swept.add(if is_tethered { farthest } else { limit }, sphere);
                }
            }
            let moving = surfaces(world, visible, moves).filter(|it| limits[0].holds(it));
            sweep.surfaces = Bounds::around(moving.into_iter().chain(sweep.surfaces));
        }
        sweep
    }

    /// Returns the framing of a scene whose parts are in the box `start`, its balls in the box `balls`, at the start.
    fn framing(&self, start: Bounds, balls: Bounds, has_surfaces: bool) -> Framing {
        let [near, farthest] = [STAYING_TIMES.len(), STAYING_TIMES.len() + 1];
        let stay = |limit: &usize| self.balls.values().filter(|it| !it[*limit].left).count();
        let limits = 0..if has_surfaces { 2 } else { STAYING_TIMES.len() };
        let limit = limits.into_iter().find(|it| 2 * stay(it) >= self.balls.len()).unwrap_or(0);
        let around = |stays: bool, within: usize| {
            let balls = self.balls.values().filter(|it| it[limit].left != stays);
            Bounds::around(balls.filter_map(|it| it[within].within))
        };
        let staying = around(true, limit);
        let leaving = match (staying, has_surfaces) {
            (Some(_), _) => near,
            (None, true) => limit,
            (None, false) => farthest,
        };
        let balls = staying.map_or(balls, |swept| balls.with(swept));
        let others = [around(false, leaving), self.surfaces].into_iter().flatten();
        Framing { whole: others.fold(start, Bounds::with).with(balls), balls }
    }
}
