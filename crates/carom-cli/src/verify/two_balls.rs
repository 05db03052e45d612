//! A ball that is pushed against another one, which is to come to a goal: task 3 of Zhong et al. 2022, arXiv 2207.05060.
//!
//! Of two elastic balls of 0.2 m and 1 kg at rest, the first is pushed by a force for up to 1 s. The loss is the square of
//! the distance of the second from the goal after that, and a tenth of the integral of the square of the force. The force
//! is cut into 480 steps, as in the paper; there it is free in each of them, here linear in time up to the impact, which
//! the best force is.

use carom::{DVec3, Rule, Sphere, SphereId, SphereTangent, Tape, World};

use super::claim::{Fault, Measured, Outcome};
use super::setup::world;

const STEPS: u32 = 480;
const SECONDS: f64 = 1.0;
/// Weight of the integral of the square of the force.
const COST: f64 = 0.1;
/// Least part of the predicted decrease of the loss that a step of the descent makes (Armijo 1966).
const DECREASE: f64 = 1e-4;
/// Size of the gradient at which the descent ends: the loss is off by the square of it.
const FLAT: f64 = 1e-7;

/// Loss and its gradient by the force at the start and by its rate of change.
struct Loss {
    value: f64,
    gradient: [f64; 2],
}

/// The balls on a diagonal, along which everything moves; distances along it are counted from the goal.
struct Balls {
    world: World,
    first: SphereId,
    second: SphereId,
}

fn diagonal() -> DVec3 {
    DVec3::new(1.0, 1.0, 0.0).normalize()
}

fn balls(rule: Rule) -> Result<Balls, Fault> {
    let mut world = world(rule)?;
    let ball = |x: f64| Sphere::new(DVec3::new(x, x, 0.0), 0.2).with_mass(1.0);
    let [first, second] = [world.add_sphere(ball(-2.0))?, world.add_sphere(ball(-1.0))?];
    Ok(Balls { world, first, second })
}

/// Finds the force by the method of Broyden, Fletcher, Goldfarb and Shanno, and returns the loss.
pub(super) fn least_loss(rule: Rule) -> Outcome {
    let Balls { world, .. } = balls(rule)?;
    // The paper begins with 3 N along each axis.
    let mut force = [3.0 * DVec3::ONE.truncate().length(), 0.0];
    let mut loss = loss(rule, force)?;
    let mut inverse = [[1.0, 0.0], [0.0, 1.0]];
    for _ in 0..50 {
        if dot(loss.gradient, loss.gradient) < FLAT * FLAT {
            return Ok(Measured::in_world(&world, loss.value));
        }
        let way = inverse.map(|row| -dot(row, loss.gradient));
        let (step, next) = decrease(rule, force, &loss, way)?;
        let change = [0, 1].map(|i| next.gradient[i] - loss.gradient[i]);
        inverse = updated(inverse, step, change);
        force = [force[0] + step[0], force[1] + step[1]];
        loss = next;
    }
    Err("the descent did not end".into())
}

/// Returns the longest step along a way, of its halves, that decreases the loss, and the loss there.
fn decrease(
    rule: Rule,
    force: [f64; 2],
    loss: &Loss,
    way: [f64; 2],
) -> Result<([f64; 2], Loss), Fault> {
    let mut part = 1.0;
    while part > 1e-12 {
        let step = way.map(|it| part * it);
        let next = self::loss(rule, [force[0] + step[0], force[1] + step[1]]);
        if let Ok(next) = next
            && next.value <= loss.value + DECREASE * dot(step, loss.gradient)
        {
            return Ok((step, next));
        }
        part *= 0.5;
    }
    Err("no step decreases the loss".into())
}

/// Returns the approximate inverse of the second derivatives after a step and its change of the gradient.
fn updated(inverse: [[f64; 2]; 2], step: [f64; 2], change: [f64; 2]) -> [[f64; 2]; 2] {
    let along = dot(step, change);
    if along <= 0.0 {
        return inverse;
    }
    let turned = inverse.map(|row| dot(row, change));
    let factor = (1.0 + dot(turned, change) / along) / along;
    let entry = |i: usize, j: usize| {
        inverse[i][j] - (step[i] * turned[j] + turned[i] * step[j]) / along
            + factor * step[i] * step[j]
    };
    [0, 1].map(|i| [0, 1].map(|j| entry(i, j)))
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Runs with a force along the diagonal that is `first + rate t` in the middle of each step \[N\].
fn loss(rule: Rule, [start, rate]: [f64; 2]) -> Result<Loss, Fault> {
    let Balls { mut world, first, second } = balls(rule)?;
    let dt = SECONDS / f64::from(STEPS);
    let mut tapes = Vec::new();
    let mut impact = None;
    for number in 0..STEPS {
        let middle = (f64::from(number) + 0.5) * dt;
        let force = start + rate * middle;
        world.set_applied_forces(&[force * diagonal(), DVec3::ZERO])?;
        let mut tape = Tape::start(&world)?;
        tape.step(&mut world, dt)?;
        tapes.push((tape, middle, force));
        if let Some(found) = world.report().impacts.first() {
            impact = Some(f64::from(number) * dt + found.time);
            break;
        }
    }
    let impact = impact.ok_or("the balls do not meet")?;
    world.set_applied_forces(&[])?;
    let mut rest = Tape::start(&world)?;
    rest.step(&mut world, SECONDS - tapes.len() as f64 * dt)?;
    let end = world.sphere(second)?;
    let (place, speed) = (end.position.dot(diagonal()), end.velocity.dot(diagonal()));
    let along = diagonal();
    let of_place = SphereTangent { position: along, ..SphereTangent::default() };
    let of_speed = SphereTangent { velocity: along, ..SphereTangent::default() };
    let by_place = by_forces((&tapes, &rest), [first, second], of_place)?;
    let by_speed = by_forces((&tapes, &rest), [first, second], of_speed)?;
    let mut loss = Loss { value: place * place, gradient: [0.0; 2] };
    for (number, &(_, middle, force)) in tapes.iter().enumerate() {
        let time = (impact - number as f64 * dt).min(dt);
        let last = tapes.last().map_or(0.0, |it| it.2);
        // The place at the end is that before the impact, and the speed for the rest of the time.
        let later = (by_speed[number] * (SECONDS - impact) - by_place[number]) / speed;
        let by = 2.0 * place * by_place[number] + COST * (2.0 * force * time + last * last * later);
        loss.value += COST * force * force * time;
        loss.gradient = [loss.gradient[0] + by, loss.gradient[1] + by * middle];
    }
    Ok(loss)
}

/// Returns the derivatives of a number at the end by the force in each step.
fn by_forces(
    (tapes, rest): (&[(Tape, f64, f64)], &Tape),
    [first, second]: [SphereId; 2],
    of_second: SphereTangent,
) -> Result<Vec<f64>, Fault> {
    let mut by = [(first, SphereTangent::default()), (second, of_second)];
    let mut forces = vec![0.0; tapes.len()];
    let mut gradient = rest.gradient(&by)?;
    for (place, (tape, ..)) in tapes.iter().enumerate().rev() {
        for (id, by) in &mut by {
            let sphere = gradient.sphere(*id);
            by.position = sphere.position;
            by.velocity = sphere.velocity;
        }
        gradient = tape.gradient(&by)?;
        forces[place] = gradient.sphere(first).acceleration.dot(diagonal());
    }
    Ok(forces)
}
