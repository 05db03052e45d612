//! The space that a picture of a scene must show: where its balls are during its first seconds.

use std::collections::{BTreeMap, BTreeSet};

use carom::{Collider, DVec3, Shape, SpringEnd, World};
use carom_scene::Scene;
use carom_scene::scene::Simulation;

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
        let surfaces = colliders().filter_map(|it| Bounds::of_shape(it.shape.clone(), it.pose));
        let surfaces = Bounds::around(surfaces.chain(fixed_ends(&world)));
        let balls = Bounds::around(spheres(&world).map(|it| it.1).chain(emitters(scene)));
        let balls = balls.or(surfaces)?;
        let radius = mean_radius(&world).unwrap_or(0.1 * balls.radius());
        let reach = |[of_balls, of_box]: [f64; 2]| (of_balls * radius).max(of_box * balls.radius());
        let feet = feet(colliders(), &balls, reach(NEAR_PLANE));
        let start = [surfaces, feet].into_iter().flatten().fold(balls, Bounds::with);
        let around = |[of_box, of_balls]: [f64; 2]| {
            start.grown((of_box * start.radius()).max(of_balls * radius))
        };
        let limits = [STAYING, LEAVING, ALL_LEAVING].map(around);
        let [staying, leaving, all_leaving] = sweep(&mut world, &scene.simulation, limits);
        let balls = staying.map_or(balls, |swept| balls.with(swept));
        let leaving = if staying.is_some() { leaving } else { all_leaving };
        let whole = leaving.map_or(start, |swept| start.with(swept)).with(balls);
        Some(Self { whole, balls })
    }
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
    scene.emitters.iter().map(|emitter| {
        let sphere = &emitter.sphere;
        let radius = sphere.radius.or(sphere.diameter.map(|it| 0.5 * it)).unwrap_or(0.5);
        Bounds::from_sphere(emitter.position.into(), radius)
    })
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

fn mean_radius(world: &World) -> Option<f64> {
    let radii = world.spheres().radii();
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

/// Simulates the first seconds and returns three boxes around the space that balls sweep. The first
/// is of balls that stay within `far`, or within `farthest` if they are tethered. The second is of
/// the other balls while they are within `near`, the third of the same balls while they are within
/// `farthest`.
fn sweep(
    world: &mut World,
    simulation: &Simulation,
    [far, near, farthest]: [Bounds; 3],
) -> [Option<Bounds>; 3] {
    #[derive(Clone, Copy, Default)]
    struct Swept {
        far: Option<Bounds>,
        near: Option<Bounds>,
        farthest: Option<Bounds>,
        left: bool,
    }
    let add =
        |to: &mut Option<Bounds>, more: Bounds| *to = Some(to.map_or(more, |it| it.with(more)));
    let tethered = tethered(world);
    let mut of_balls = BTreeMap::<u64, Swept>::new();
    let frame_time = simulation.frame_time;
    let frames = (FIRST_SECONDS.min(simulation.duration) / frame_time).ceil() as usize;
    let mut work = 0;
    for _ in 0..frames {
        work += world.spheres().len().max(1);
        if work > MOST_WORK || world.step(frame_time).is_err() {
            break;
        }
        for (number, sphere) in spheres(world) {
            let swept = of_balls.entry(number).or_default();
            let limit = if tethered.contains(&number) { &farthest } else { &far };
            swept.left |= !limit.holds(&sphere);
            if !swept.left {
                add(&mut swept.far, sphere);
            }
            if near.holds(&sphere) {
                add(&mut swept.near, sphere);
            }
            if farthest.holds(&sphere) {
                add(&mut swept.farthest, sphere);
            }
        }
    }
    let around = |left: bool, which: fn(&Swept) -> Option<Bounds>| {
        Bounds::around(of_balls.values().filter(|it| it.left == left).filter_map(which))
    };
    [around(false, |it| it.far), around(true, |it| it.near), around(true, |it| it.farthest)]
}
