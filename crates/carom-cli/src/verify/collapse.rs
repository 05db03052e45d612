//! Collapsing columns of grains: run-out, height and angle of the remaining heap.

use carom::{BodyPair, Contact, DVec3, Error, Friction, Rule, Sphere, SphereId, World};

use super::claim::{Claim, Expected, Fault, Measured, Outcome, Tolerance};
use super::grains::{DIAMETER, add_floor, add_shaft, empty, fill, grain, settle, top};
use super::setup::half_space;
use crate::numbers::Numbers;

pub fn claims() -> Vec<Claim> {
    let zhou = "Zhou et al., Phys. Rev. E 64, 021301 (2001)";
    let steps = "it rises or does not";
    let claims = vec![
        Claim::new(
            "angle of a heap rises with mu = 0.1, 0.3, 0.9 [steps upwards]",
            Expected::value(2.0, zhou),
            Tolerance::none(steps),
            |_| rises([0.1, 0.3, 0.9].map(|mu| Friction::sliding(mu).with_rolling(0.1))),
        ),
        Claim::new(
            "angle of a heap rises with rolling friction 0.02, 0.1, 0.3 [steps upwards]",
            Expected::value(2.0, zhou),
            Tolerance::none(steps),
            |_| rises([0.02, 0.1, 0.3].map(|mu_r| Friction::sliding(0.5).with_rolling(mu_r))),
        ),
        Claim::new(
            "column of discs, 120 wide and 60 high, collapses: run-out [2.5 a]",
            Expected::value(1.0, "Staron and Hinch, J. Fluid Mech. 545, 1 (2005)"),
            Tolerance::absolute(
                0.25,
                "the front ends where it is thinner than a disc: 0.12, and 0.28 at half the size; chance 0.04",
            ),
            |_| run_out(),
        )
        .slow(),
        Claim::new(
            "heap that a column of discs leaves: power of a with which it rises, from a = 1 to 4",
            Expected::value(0.37, "Lajeunesse et al. (2005): 1/3; Lube et al. (2005): 2/5"),
            Tolerance::absolute(0.06, "what the two experiments differ by; statistics 0.03"),
            |_| height_exponent(),
        )
        .slow(),
    ];
    claims.into_iter().map(|claim| claim.about(Rule::Contact(Contact::default()))).collect()
}

/// Counts the steps from one friction to the next at which the angle of the heap increases.
fn rises(frictions: [Friction; 3]) -> Outcome {
    let (mut last, mut steps, mut heaps) = (f64::INFINITY, 0, Vec::new());
    for friction in frictions {
        let heap = angle_of_repose(friction)?;
        steps += u32::from(heap.value > last);
        last = heap.value;
        heaps.push(heap);
    }
    Ok(Measured { value: f64::from(steps), ..Measured::sum(heaps) })
}

/// Angle of the heap that a collapsed column leaves \[degrees\]: that of a cone with the same mean
/// height (a quarter of its height) and mean distance from the axis (half of its radius).
fn angle_of_repose(friction: Friction) -> Outcome {
    let mut world = empty()?;
    add_floor(&mut world, friction)?;
    let width = 8.0 * DIAMETER;
    let walls = add_shaft(&mut world, width, 0.0)?;
    fill(&mut world, grain(DIAMETER, friction), 500, width)?;
    settle(&mut world, 3.0)?;
    for wall in walls {
        world.remove_collider(wall)?;
    }
    settle(&mut world, 6.0)?;
    let positions = world.spheres().positions();
    let height: f64 = positions.iter().map(|position| position.y).sum();
    let away: f64 = positions.iter().map(|position| position.with_y(0.0).length()).sum();
    Ok(Measured::in_world(&world, libm::atan(2.0 * height / away).to_degrees()))
}

/// A column of discs and its heap, in units of half its width.
struct Collapse {
    /// Height of the column.
    aspect: f64,
    /// Distance of the front of the connected heap from its start.
    run_out: f64,
    /// Height of the heap.
    height: f64,
    measured: Measured,
}

/// Run-out relative to 2.5 times the height of the column.
fn run_out() -> Outcome {
    let collapse = collapse(60.0, 1.0)?;
    let part = collapse.run_out / (2.5 * collapse.aspect);
    Ok(Measured { value: part, ..collapse.measured })
}

fn height_exponent() -> Outcome {
    let (low, high) = (collapse(20.0, 1.0)?, collapse(20.0, 4.0)?);
    let power = libm::log(high.height / low.height) / libm::log(high.aspect / low.aspect);
    Ok(Measured { value: power, ..Measured::sum([low.measured, high.measured]) })
}

/// Lets a column of discs collapse to both sides, with the friction and restitution of Staron and
/// Hinch. Half of its width is `half` diameters; its height is about `aspect` times that.
fn collapse(half: f64, aspect: f64) -> Result<Collapse, Fault> {
    let mut world = empty()?;
    add_floor(&mut world, 1.0)?;
    let count = (2.0 * half * half * aspect) as usize;
    let half = half * DIAMETER;
    let walls = [DVec3::X, DVec3::NEG_X]
        .map(|normal| world.add_collider(half_space(-half * normal, normal).with_restitution(0.0)));
    add_discs(&mut world, count, half)?;
    settle(&mut world, 8.0)?;
    let before = top(&world) + 0.5 * DIAMETER;
    for wall in walls {
        world.remove_collider(wall?)?;
    }
    settle(&mut world, 9.0)?;
    let place = |i: usize| world.spheres().positions()[i];
    let (mut left, mut right, mut after) = (0.0_f64, 0.0_f64, 0.0_f64);
    for i in connected(&world) {
        (left, right) = (left.min(place(i).x), right.max(place(i).x));
        after = after.max(place(i).y);
    }
    let run_out = 0.5 * (right - left + DIAMETER) / half - 1.0;
    let height = (after + 0.5 * DIAMETER) / half;
    let measured = Measured::in_world(&world, run_out);
    Ok(Collapse { aspect: before / half, run_out, height, measured })
}

/// Adds discs in loose layers between two walls: spheres in a plane with the mass and inertia of
/// discs. Their radii vary by a fifth.
fn add_discs(world: &mut World, count: usize, half: f64) -> Result<(), Error> {
    let mut numbers = Numbers::new(1);
    let row = ((2.0 * half / DIAMETER - 0.2) / 1.25) as usize;
    let spacing = 2.0 * half / row as f64;
    for number in 0..count {
        let radius = numbers.between(0.4, 0.6) * DIAMETER;
        let x = ((number % row) as f64 + numbers.between(0.45, 0.55)) * spacing - half;
        let y = (0.7 + 1.25 * (number / row) as f64) * DIAMETER;
        let disc = Sphere::new(DVec3::new(x, y, 0.0), radius)
            .with_mass(radius * radius)
            .with_inertia_factor(0.5)
            .with_restitution(0.5)
            .with_friction(1.0);
        world.add_sphere(disc)?;
    }
    Ok(())
}

/// Returns the largest group of spheres connected by contacts, as indices.
fn connected(world: &World) -> Vec<usize> {
    let spheres = world.spheres();
    let mut neighbours = vec![Vec::new(); spheres.len()];
    let index = |id: SphereId| spheres.index_of(id).unwrap_or(0);
    for contact in world.contacts() {
        if let BodyPair::Spheres(first, second) = contact.between {
            neighbours[index(first)].push(index(second));
            neighbours[index(second)].push(index(first));
        }
    }
    let mut is_found = vec![false; spheres.len()];
    let mut largest = Vec::new();
    for start in 0..spheres.len() {
        let (mut group, mut ahead) = (Vec::new(), vec![start]);
        while let Some(i) = ahead.pop() {
            if !std::mem::replace(&mut is_found[i], true) {
                group.push(i);
                ahead.extend(&neighbours[i]);
            }
        }
        if group.len() > largest.len() {
            largest = group;
        }
    }
    largest
}
