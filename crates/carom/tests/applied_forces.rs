//! Forces applied to single spheres, and what goes with them: spheres put elsewhere, the clock set.

use carom::{
    Boundary, Collider, DQuat, DVec3, Discrete, Error, Exact, Gravity, Pose, Rule, Settings, Shape,
    Sphere, SphereId, SphereMotion, World,
};

const FRAME: f64 = 0.02;

fn rules() -> [Rule; 2] {
    [Discrete::default().into(), exact()]
}

fn exact() -> Rule {
    Exact::default().with_max_impacts(10_000).into()
}

/// A world of spheres that pass through each other.
fn world_of(rule: Rule, spheres: &[Sphere], colliders: &[Collider]) -> World {
    let settings = Settings::default().with_rule(rule).with_spheres_collide(false);
    let mut world = World::new(settings).unwrap();
    for sphere in spheres {
        world.add_sphere(*sphere).unwrap();
    }
    for collider in colliders {
        world.add_collider(collider.clone()).unwrap();
    }
    world
}

/// A tray: a floor that faces up at height 0, and four walls 2 m from its centre.
fn tray() -> Vec<Collider> {
    let floor = Shape::Rectangle { size_x: 4.0, size_z: 4.0 };
    let wall = |x: f64, z: f64| {
        let size =
            DVec3::new(if x == 0.0 { 4.4 } else { 0.2 }, 1.0, if z == 0.0 { 4.4 } else { 0.2 });
        Collider::new(Shape::Box { size }, Pose::at(DVec3::new(x, 0.5, z)))
    };
    let walls = [wall(2.1, 0.0), wall(-2.1, 0.0), wall(0.0, 2.1), wall(0.0, -2.1)];
    let mut all = vec![Collider::new(floor, Pose::at(DVec3::ZERO)).with_restitution(0.0)];
    all.extend(walls.map(|wall| wall.with_restitution(0.3)));
    all
}

/// The weight of 1 kg on a tray that was tilted, another way in every frame and for every sphere.
fn weight(frame: usize, sphere: usize) -> DVec3 {
    let phase = (7 * frame + 13 * sphere) as f64;
    let (x, z) = (libm::sin(0.003 * phase), libm::cos(0.002 * phase));
    DVec3::new(2.0 * x, -9.0, 2.0 * z)
}

fn balls_on_the_floor(count: usize) -> Vec<Sphere> {
    let place = |number: usize| DVec3::new(0.3 * number as f64 - 1.2, 0.25, 0.1 * number as f64);
    (0..count).map(|number| Sphere::new(place(number), 0.25)).collect()
}

fn steer(world: &mut World, frame: usize) {
    let forces: Vec<DVec3> = (0..world.spheres().len()).map(|ball| weight(frame, ball)).collect();
    world.set_applied_forces(&forces).unwrap();
}

#[test]
fn an_applied_weight_is_gravity() {
    let g = DVec3::new(0.5, -9.81, 0.25);
    let ball = Sphere::new(DVec3::new(0.0, 3.0, 0.0), 0.5).with_mass(2.0);
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
    for rule in rules() {
        let mut applied = world_of(rule, &[ball], std::slice::from_ref(&floor));
        let mut falling = applied.clone();
        applied.set_applied_forces(&[2.0 * g]).unwrap();
        falling.add_force(Gravity::new(g)).unwrap();
        for _ in 0..100 {
            applied.step(FRAME).unwrap();
            falling.step(FRAME).unwrap();
            let (a, b) = (applied.spheres().get(0), falling.spheres().get(0));
            // A flight that begins anew in every frame rounds some 1e-16 m in each; elastic bounces
            // keep that small.
            assert!((a.position - b.position).length() < 1e-12, "{rule:?} {a:?} {b:?}");
            assert!((a.velocity - b.velocity).length() < 1e-12, "{rule:?} {a:?} {b:?}");
        }
    }
}

#[test]
fn each_sphere_follows_the_force_applied_to_it() {
    let spheres = [1.0, 2.0, 4.0].map(|mass| Sphere::new(DVec3::ZERO, 0.1).with_mass(mass));
    let forces = [DVec3::X, DVec3::Y, DVec3::Z];
    let mut world = world_of(exact(), &spheres, &[]);
    world.set_applied_forces(&forces).unwrap();
    for _ in 0..50 {
        world.step(FRAME).unwrap();
    }
    for (index, force) in forces.into_iter().enumerate() {
        let acceleration = force / spheres[index].kilograms();
        // x = a t² / 2 at t = 1 s; 50 frames round some 1e-16 m each.
        let gap = (world.spheres().positions()[index] - 0.5 * acceleration).length();
        assert!(gap < 1e-14, "{index} {gap}");
    }
}

#[test]
fn a_ball_on_a_floor_follows_its_tilt_and_stays_on_it() {
    let mut world = world_of(exact(), &balls_on_the_floor(1), &tray());
    let start = world.spheres().get(0);
    let (mut position, mut velocity) = (start.position, start.velocity);
    for frame in 0..25 {
        let along = weight(frame, 0) * DVec3::new(1.0, 0.0, 1.0);
        steer(&mut world, frame);
        world.step(FRAME).unwrap();
        position += FRAME * velocity + 0.5 * FRAME * FRAME * along;
        velocity += FRAME * along;
        let ball = world.spheres().get(0);
        assert_eq!(ball.position.y, 0.25, "frame {frame}");
        // Both sums round some 1e-16 in each frame.
        assert!((ball.position - position).length() < 1e-13, "frame {frame} {ball:?}");
        assert!((ball.velocity - velocity).length() < 1e-13, "frame {frame} {ball:?}");
    }
}

#[test]
fn contacts_that_go_on_move_spheres_like_contacts_found_anew() {
    let mut carried = world_of(exact(), &balls_on_the_floor(8), &tray());
    let mut anew = carried.clone();
    let mut impacts = 0;
    for frame in 0..300 {
        steer(&mut carried, frame);
        steer(&mut anew, frame);
        // Settings that are set, even to what they are, end all flights and persistent contacts.
        anew.set_settings(*anew.settings()).unwrap();
        impacts += carried.step(FRAME).unwrap().impacts.len();
        anew.step(FRAME).unwrap();
        for (a, b) in carried.spheres().positions().iter().zip(anew.spheres().positions()) {
            // The same places but for rounding, which bounces off walls let grow.
            assert!((*a - *b).length() < 1e-9, "frame {frame}: {a} {b}");
        }
    }
    assert!(impacts > 20, "balls met walls {impacts} times");
    assert!(carried.overlaps(1e-9).is_empty());
}

#[test]
fn a_ball_pressed_into_a_corner_stays_until_the_tilt_turns() {
    let corner = Sphere::new(DVec3::new(1.75, 0.25, 1.75), 0.25);
    let mut world = world_of(exact(), &[corner], &tray());
    for _ in 0..50 {
        world.set_applied_forces(&[DVec3::new(2.0, -9.0, 1.0)]).unwrap();
        world.step(FRAME).unwrap();
        let ball = world.spheres().get(0);
        assert_eq!((ball.position, ball.velocity), (corner.position, DVec3::ZERO));
    }
    // Now it leaves one wall, slides along the other, and stays on the floor.
    let frames = 20;
    for _ in 0..frames {
        world.set_applied_forces(&[DVec3::new(2.0, -9.0, -1.0)]).unwrap();
        world.step(FRAME).unwrap();
    }
    let ball = world.spheres().get(0);
    let time = f64::from(frames) * FRAME;
    let way = 0.5 * time * time;
    assert_eq!((ball.position.x, ball.position.y), (1.75, 0.25));
    assert!((ball.position.z - (1.75 - way)).abs() < 1e-13, "{ball:?}");
}

#[test]
fn a_ball_steered_over_the_edge_of_a_floor_falls() {
    let floor = Collider::new(
        Shape::Rectangle { size_x: 2.0, size_z: 2.0 },
        Pose { position: DVec3::ZERO, rotation: DQuat::IDENTITY },
    );
    let ball = Sphere::new(DVec3::new(0.9, 0.1, 0.0), 0.1).with_velocity(DVec3::X);
    let mut world = world_of(exact(), &[ball], &[floor.with_restitution(0.0)]);
    for _ in 0..25 {
        world.set_applied_forces(&[DVec3::new(0.0, -9.81, 0.0)]).unwrap();
        world.step(FRAME).unwrap();
    }
    let ball = world.spheres().get(0);
    // At the edge after 0.1 s at the latest, it then falls for 0.4 s, held up by the edge at first.
    assert!(ball.position.y < -0.3 && ball.position.x > 1.2, "{ball:?}");
}

#[test]
fn spheres_put_elsewhere_leave_the_others_alone_to_the_bit() {
    let count = 30;
    let mut world = world_of(exact(), &balls_on_the_floor(8), &tray());
    let mut other = world.clone();
    for frame in 0..count {
        steer(&mut world, frame);
        steer(&mut other, frame);
        if frame % 5 == 4 {
            let id = SphereId::from_number(3);
            let position = DVec3::new(0.1, 0.3, -0.2);
            other.set_motions(&[SphereMotion { id, position, velocity: DVec3::Z }]).unwrap();
        }
        world.step(FRAME).unwrap();
        other.step(FRAME).unwrap();
        for index in [0, 1, 2, 4, 5, 6, 7] {
            assert_eq!(world.spheres().get(index), other.spheres().get(index), "frame {frame}");
        }
    }
    assert_ne!(world.spheres().get(3), other.spheres().get(3));
}

#[test]
fn spheres_put_elsewhere_still_meet_each_other() {
    let size = DVec3::splat(4.0);
    for boundary in [Boundary::Open, Boundary::Periodic { size }] {
        let settings = Settings::default().with_boundary(boundary);
        let mut world = World::new(settings).unwrap();
        for x in -3..=3 {
            for z in -3..=3 {
                let place = DVec3::new(0.5 * f64::from(x), 0.0, 0.5 * f64::from(z));
                world.add_sphere(Sphere::new(place, 0.2)).unwrap();
            }
        }
        let still = vec![DVec3::ZERO; world.spheres().len()];
        world.set_applied_forces(&still).unwrap();
        world.step(FRAME).unwrap();
        let first = SphereId::from_number(0);
        let (place, fast) = (DVec3::new(0.0, 1.9, 0.0), DVec3::new(0.0, -20.0, 0.0));
        world.set_motions(&[SphereMotion { id: first, position: place, velocity: fast }]).unwrap();
        let mut impacts = 0;
        for _ in 0..20 {
            impacts += world.step(FRAME).unwrap().impacts.len();
            assert!(world.overlaps(1e-9).is_empty(), "{boundary:?}");
        }
        assert!(impacts > 0, "{boundary:?}");
        // All spheres have 1 kg, and impacts change no momentum but by rounding.
        assert!((world.momentum() - fast).length() < 1e-12, "{boundary:?}");
    }
}

#[test]
fn a_run_from_a_clock_set_back_repeats_to_the_bit() {
    for rule in rules() {
        let mut world = world_of(rule, &balls_on_the_floor(8), &tray());
        let start: Vec<_> = (0..8).map(|index| world.spheres().get(index)).collect();
        let mut hashes = Vec::new();
        for _ in 0..3 {
            for frame in 0..100 {
                world.set_time(0.0).unwrap();
                steer(&mut world, frame);
                world.step(FRAME).unwrap();
            }
            hashes.push(world.state_hash());
            let motions: Vec<_> = world
                .spheres()
                .ids()
                .iter()
                .zip(&start)
                .map(|(&id, ball)| SphereMotion {
                    id,
                    position: ball.position,
                    velocity: ball.velocity,
                })
                .collect();
            world.set_motions(&motions).unwrap();
        }
        assert_eq!([hashes[0]; 3], hashes[..], "{rule:?}");
    }
}

#[test]
fn applied_forces_go_with_the_spheres_and_with_snapshots() {
    let mut world = world_of(exact(), &balls_on_the_floor(3), &[]);
    world.set_applied_forces(&[DVec3::X, DVec3::Y, DVec3::Z]).unwrap();
    let before = world.snapshot();
    world.remove_sphere(SphereId::from_number(1)).unwrap();
    world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
    assert_eq!(world.spheres().applied_forces(), [DVec3::X, DVec3::Z, DVec3::ZERO]);
    world.restore(&before);
    assert_eq!(world.spheres().applied_forces(), [DVec3::X, DVec3::Y, DVec3::Z]);
    world.set_applied_forces(&[]).unwrap();
    let speeds = |world: &World| world.spheres().velocities().to_vec();
    let old = speeds(&world);
    world.step(FRAME).unwrap();
    assert_eq!(speeds(&world), old);
}

#[test]
fn what_makes_no_sense_is_refused_and_changes_nothing() {
    let mut world = world_of(exact(), &balls_on_the_floor(2), &tray());
    steer(&mut world, 0);
    world.step(FRAME).unwrap();
    let (hash, forces) = (world.state_hash(), world.spheres().applied_forces().to_vec());
    let known = SphereId::from_number(0);
    let moved = |id, position, velocity| SphereMotion { id, position, velocity };
    let unknown = SphereId::from_number(9);
    let nowhere = DVec3::splat(f64::NAN);
    let errors = [
        world.set_applied_forces(&[DVec3::X]),
        world.set_applied_forces(&[DVec3::X, nowhere]),
        world.set_motions(&[moved(known, DVec3::X, DVec3::X), moved(unknown, DVec3::X, DVec3::X)]),
        world.set_motions(&[moved(known, DVec3::X, DVec3::X), moved(known, nowhere, DVec3::X)]),
        world.set_motions(&[moved(known, DVec3::X, DVec3::INFINITY)]),
        world.set_time(f64::NAN),
    ];
    let told = [
        "one for each sphere",
        "`applied force` must be finite",
        "there is no sphere 9",
        "`position` must be finite",
        "`velocity` must be finite",
        "`time` must be finite",
    ];
    for (error, told) in errors.into_iter().zip(told) {
        let said = error.map_err(|error: Error| error.to_string()).unwrap_err();
        assert!(said.contains(told), "{said}");
    }
    assert_eq!(world.state_hash(), hash);
    assert_eq!(world.spheres().applied_forces(), forces);
}

#[test]
fn what_a_force_has_given_stays_when_it_ends() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add_sphere(Sphere::new(DVec3::ZERO, 1.0)).unwrap();
    world.set_applied_forces(&[2.0 * DVec3::X]).unwrap();
    world.step(0.5).unwrap();
    world.set_applied_forces(&[DVec3::ZERO]).unwrap();
    world.step(0.5).unwrap();
    assert_eq!(world.spheres().velocities()[0], DVec3::X);
    assert_eq!(world.spheres().positions()[0], 0.75 * DVec3::X);
}

#[test]
fn an_impulse_changes_the_velocity_by_impulse_over_mass_and_nothing_else() {
    for rule in rules() {
        let ball = Sphere::new(DVec3::X, 0.5).with_velocity(DVec3::Y).with_mass(4.0);
        let ball = ball.with_angular_velocity(DVec3::Z);
        let mut world = world_of(rule, &[ball, ball], &[]);
        let [first, second] = [0, 1].map(SphereId::from_number);
        world.step(FRAME).unwrap();
        let before = world.sphere(first).unwrap();
        world.apply_impulse(first, DVec3::new(8.0, -4.0, 0.0)).unwrap();
        let expected = before.with_velocity(DVec3::new(2.0, 0.0, 0.0));
        assert_eq!(world.sphere(first).unwrap(), expected);
        assert_eq!(world.sphere(second).unwrap(), before);
        world.set_velocity(first, DVec3::ZERO).unwrap();
        world.step(FRAME).unwrap();
        assert_eq!(world.sphere(first).unwrap().position, before.position);
        let unknown = SphereId::from_number(9);
        assert!(matches!(world.apply_impulse(unknown, DVec3::X), Err(Error::Unknown { .. })));
        let error = world
            .apply_impulse(first, DVec3::splat(f64::MAX))
            .and_then(|()| world.apply_impulse(first, DVec3::splat(f64::INFINITY)));
        assert!(error.unwrap_err().to_string().contains("`velocity` must be finite"));
    }
}
