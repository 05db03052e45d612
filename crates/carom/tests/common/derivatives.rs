//! Derivatives of runs against themselves and against differences of runs.

use carom::{
    DQuat, DVec3, ForceId, Gravity, Sphere, SphereId, SphereTangent, Tangents, Tape, Variation,
    World,
};

use super::Numbers;

/// A world that begins this far along a direction; its gravity is of this force and \[m/s²\].
pub fn varied(
    world: &World,
    direction: &Variation,
    by: f64,
    gravity: Option<(ForceId, DVec3)>,
) -> World {
    let mut varied = world.clone();
    if let Some((force, gravity)) = gravity {
        varied.set_force(force, Gravity::new(gravity + by * direction.acceleration)).unwrap();
    }
    for (id, change) in direction.spheres() {
        let mut sphere = world.sphere(id).unwrap();
        sphere.position += by * change.position;
        sphere.velocity += by * change.velocity;
        sphere.angular_velocity += by * change.angular_velocity;
        sphere.radius += by * change.radius;
        sphere.restitution += by * change.restitution;
        sphere.friction.sliding = sphere.friction.sliding.map(|it| it + by * change.friction);
        let index = world.spheres().index_of(id).unwrap();
        let mass = world.spheres().masses()[index] + by * change.mass;
        varied.set_sphere(id, sphere.with_mass(mass)).unwrap();
    }
    if direction.spheres().any(|(_, change)| change.acceleration != DVec3::ZERO) {
        let spheres = varied.spheres();
        let forces = spheres.ids().iter().zip(spheres.masses());
        let forces = forces.map(|(&id, mass)| mass * by * direction.sphere(id).acceleration);
        let forces: Vec<DVec3> = forces.collect();
        varied.set_applied_forces(&forces).unwrap();
    }
    for (id, change) in direction.colliders() {
        let mut collider = world.collider(id).unwrap();
        collider.pose.position += by * change.position;
        let turned = DQuat::from_scaled_axis(by * change.rotation);
        collider.pose.rotation = (turned * collider.pose.rotation).normalize();
        collider.velocity += by * change.velocity;
        collider.restitution += by * change.restitution;
        collider.friction.sliding = collider.friction.sliding.map(|it| it + by * change.friction);
        varied.set_collider(id, collider).unwrap();
    }
    for (id, change) in direction.springs() {
        let mut spring = world.spring(id).unwrap();
        spring.stiffness += by * change.stiffness;
        spring.rest_length += by * change.rest_length;
        spring.damping += by * change.damping;
        varied.set_spring(id, spring).unwrap();
    }
    varied
}

/// A run, its derivatives along a direction, and its record.
pub struct Followed {
    pub end: World,
    pub tangents: Tangents,
    pub tape: Tape,
}

/// Follows a world along a direction for some frames of a tenth of a second.
pub fn follow(world: &World, direction: &Variation, frames: usize) -> Followed {
    let (mut end, mut recorded) = (world.clone(), world.clone());
    let mut tangents = Tangents::new(world, vec![direction.clone()]).unwrap();
    let mut tape = Tape::start(world).unwrap();
    for _ in 0..frames {
        tangents.step(&mut end, 0.1).unwrap();
        tape.step(&mut recorded, 0.1).unwrap();
    }
    Followed { end, tangents, tape }
}

/// Returns a world after some frames of a tenth of a second.
pub fn after(mut world: World, frames: usize) -> World {
    for _ in 0..frames {
        world.step(0.1).unwrap();
    }
    world
}

/// Asserts that the gradient along the direction of the tangents is their product with what the gradient is of, to
/// rounding.
#[track_caller]
pub fn assert_backwards_equals_forwards(
    (tangents, tape): (&Tangents, &Tape),
    direction: &Variation,
    balls: &[SphereId],
    numbers: &mut Numbers,
) {
    for &ball in balls {
        let by = SphereTangent {
            position: numbers.vector(),
            velocity: numbers.vector(),
            angular_velocity: numbers.vector(),
        };
        let forwards = tangents.sphere(0, ball).unwrap().dot(&by);
        let backwards = tape.gradient(&[(ball, by)]).unwrap().dot(direction);
        let scale = tangents.spheres(0).iter().map(|it| it.dot(it).sqrt()).sum::<f64>();
        assert!(
            (forwards - backwards).abs() <= 1e-12 * scale,
            "{ball:?}: {forwards} {backwards} {scale}"
        );
    }
}

/// Asserts that tangents agree, up to a `part` of them and of 1, with differences of the fourth order, in steps of `h`
/// along their direction, of the worlds at the `end` of runs.
#[track_caller]
pub fn assert_agree_with_differences(
    tangents: &Tangents,
    balls: &[SphereId],
    [h, part]: [f64; 2],
    end: impl Fn(f64) -> World,
) {
    let ends = [-2.0, -1.0, 1.0, 2.0].map(|steps| end(steps * h));
    for &ball in balls {
        let of = |pick: fn(&Sphere) -> DVec3| {
            let [a, b, c, d] = ends.each_ref().map(|end| pick(&end.sphere(ball).unwrap()));
            (8.0 * (c - b) - (d - a)) / (12.0 * h)
        };
        let found = tangents.sphere(0, ball).unwrap();
        let scale = 1.0 + found.position.length() + found.velocity.length();
        for (difference, found) in [
            (of(|it| it.position), found.position),
            (of(|it| it.velocity), found.velocity),
            (of(|it| it.angular_velocity), found.angular_velocity),
        ] {
            let off = (difference - found).length() / (scale + found.length());
            assert!(off < part, "{ball:?}: {off:e} {difference} {found}");
        }
    }
}

/// Factors of the central difference of the eighth order, by the number of steps from the middle.
const EIGHTH_ORDER: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];

/// Returns the differences of the eighth order, in steps of `h`, of the motion of balls at the `end` of runs.
fn differences(balls: &[SphereId], h: f64, end: impl Fn(f64) -> World) -> Vec<SphereTangent> {
    let mut sums = vec![SphereTangent::default(); balls.len()];
    for (steps, factor) in (1..).zip(EIGHTH_ORDER) {
        let by = f64::from(steps) * h;
        let [after, before] = [end(by), end(-by)];
        for (sum, &ball) in sums.iter_mut().zip(balls) {
            let [after, before] = [&after, &before].map(|world| world.sphere(ball).unwrap());
            let part = factor / h;
            sum.position += part * (after.position - before.position);
            sum.velocity += part * (after.velocity - before.velocity);
            sum.angular_velocity += part * (after.angular_velocity - before.angular_velocity);
        }
    }
    sums
}

/// Returns the largest difference of two lists of derivatives, as a part of the largest of them or of 1.
fn apart(one: &[SphereTangent], other: &[SphereTangent]) -> f64 {
    let numbers = |it: &SphereTangent| [it.position, it.velocity, it.angular_velocity];
    let pairs = || one.iter().flat_map(numbers).zip(other.iter().flat_map(numbers));
    let size = pairs().fold(1.0, |size: f64, (a, b)| size.max(a.length()).max(b.length()));
    pairs().fold(0.0, |most: f64, (a, b)| most.max((a - b).length())) / size
}

/// Returns by which part tangents are off differences of the eighth order of the worlds at the `end` of runs, and by
/// which part these differences are off each other: the best of several steps, chosen without the tangents.
pub fn off_differences(
    tangents: &Tangents,
    balls: &[SphereId],
    end: impl Fn(f64) -> World,
) -> [f64; 2] {
    let steps = [4e-3, 1.6e-3, 6e-4, 2.4e-4, 1e-4, 4e-5, 1.6e-5, 6e-6, 2.4e-6, 1e-6];
    let found: Vec<SphereTangent> =
        balls.iter().map(|&ball| tangents.sphere(0, ball).unwrap()).collect();
    let mut before = differences(balls, steps[0], &end);
    let mut best = [f64::NAN, f64::INFINITY];
    for h in &steps[1..] {
        let next = differences(balls, *h, &end);
        let spread = apart(&before, &next);
        if spread < best[1] {
            best = [apart(&found, &next), spread];
        }
        before = next;
    }
    best
}
