//! Derivatives of runs against themselves and against differences of runs.

use carom::{
    DVec3, ForceId, Gravity, Sphere, SphereId, SphereTangent, Tangents, Tape, Variation, World,
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
        let sphere = sphere.with_mass(world.spheres().masses()[index] + by * change.mass);
        varied.set_sphere(id, sphere).unwrap();
    }
    for (id, change) in direction.colliders() {
        let mut collider = world.collider(id).unwrap();
        collider.pose.position += by * change.position;
        collider.velocity += by * change.velocity;
        collider.restitution += by * change.restitution;
        collider.friction.sliding = collider.friction.sliding.map(|it| it + by * change.friction);
        varied.set_collider(id, collider).unwrap();
    }
    varied
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
