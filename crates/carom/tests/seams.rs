//! Seams between flush faces: nothing is felt of how a surface is put together from colliders. Each floor of tiles is
//! compared with one half-space; what is no seam, such as a step or a groove, must still be met.

mod common;

use std::f64::consts::TAU;

use carom::{
    Body, Collider, Contact, DQuat, DVec3, Exact, Gravity, Groups, Mesh, MotionPart, Pose,
    QueryFilter, Rule, Shape, Sphere, SphereId, World,
};
use common::{G, Numbers, bisect, discrete, vec, world};

fn rules() -> [Rule; 4] {
    [Rule::Exact(Exact::default()), Rule::Contact(Contact::default()), discrete(), bisect()]
}

fn a_box(size: [f64; 3], place: [f64; 3]) -> Collider {
    let shape = Shape::Box { size: DVec3::from_array(size) };
    Collider::new(shape, Pose::at(DVec3::from_array(place)))
}

fn rectangle([size_x, size_z]: [f64; 2], place: [f64; 3]) -> Collider {
    Collider::new(Shape::Rectangle { size_x, size_z }, Pose::at(DVec3::from_array(place)))
}

/// A square of a mesh, half of its length to each side.
fn square(half: f64, place: [f64; 3]) -> Collider {
    let vertices = [[-half, -half], [-half, half], [half, half], [half, -half]];
    let vertices = vertices.map(|[x, z]| vec(x, 0.0, z)).to_vec();
    let mesh = Mesh::new(vertices, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    Collider::new(Shape::Mesh(mesh), Pose::at(DVec3::from_array(place)))
}

/// Tiles about the origin, one for each of `count` by `count` cells of this length, shifted from row to row.
fn tiles(
    count: usize,
    length: f64,
    shift: f64,
    tile: impl Fn(usize, [f64; 3]) -> Collider,
) -> Vec<Collider> {
    let start = -0.5 * length * (count - 1) as f64;
    let cells = (0..count * count).map(|number| {
        let (row, column) = (number / count, number % count);
        let x = start + length * column as f64 + shift * length * (row % 2) as f64;
        tile(number + row, [x, 0.0, start + length * row as f64])
    });
    cells.collect()
}

/// Floors whose surface is the plane y = 0, from -1.4 to 1.4 at least.
fn floors() -> Vec<(&'static str, Vec<Collider>)> {
    let (length, deep) = (0.25, [0.25, 0.1, 0.25]);
    let below = |[x, y, z]: [f64; 3]| [x, y - 0.05, z];
    let sunk = tiles(5, 2.0 * length, 0.0, |_, place| a_box(deep, below(place)));
    let ground = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
    let mixed = |number: usize, place: [f64; 3]| match number % 3 {
        0 => rectangle([length; 2], place),
        1 => a_box(deep, below(place)),
        _ => square(0.5 * length, place),
    };
    vec![
        ("boxes", tiles(13, length, 0.0, |_, place| a_box(deep, below(place)))),
        ("rectangles", tiles(13, length, 0.0, |_, place| rectangle([length; 2], place))),
        ("bond", tiles(14, length, 0.5, |_, place| a_box(deep, below(place)))),
        ("mixed", tiles(13, length, 0.0, mixed)),
        ("mixed bond", tiles(14, length, 0.3, mixed)),
        ("sunk", std::iter::once(ground).chain(sunk).collect()),
    ]
}

/// A world of colliders with these coefficients, turned about the origin with its gravity.
fn on(colliders: &[Collider], rule: Rule, [restitution, friction]: [f64; 2], turn: DQuat) -> World {
    let mut world = world(rule);
    world.add_force(Gravity::new(turn * vec(0.0, -G, 0.0))).unwrap();
    for it in colliders {
        let pose = Pose::at(turn * it.pose.position).rotated(turn * it.pose.rotation);
        let it = it.clone().with_pose(pose).with_restitution(restitution);
        world.add_collider(it.with_friction(friction)).unwrap();
    }
    world
}

fn one_floor() -> Vec<Collider> {
    vec![Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))]
}

/// The farthest that two worlds come apart, and the impacts of both.
fn apart(worlds: &mut [World; 2], sphere: Sphere, frames: usize) -> (f64, [usize; 2]) {
    let ids = [0, 1].map(|number| worlds[number].add_sphere(sphere).unwrap());
    let (mut most, mut impacts) = (0.0f64, [0; 2]);
    for _ in 0..frames {
        for (world, count) in worlds.iter_mut().zip(&mut impacts) {
            *count += world.step(1.0 / 60.0).unwrap().impacts.len();
        }
        let [one, other] = [0, 1].map(|number| worlds[number].sphere(ids[number]).unwrap());
        most = most.max((one.position - other.position).length());
        most = most.max((one.velocity - other.velocity).length());
    }
    (most, impacts)
}

/// Slides, rolls and bounces: restitution, friction and height above the floor.
const WAYS: [[f64; 3]; 5] =
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.4, 0.0], [1.0, 0.2, 0.0], [0.8, 0.3, 0.3]];

#[test]
fn a_ball_feels_no_seam_of_a_floor_in_any_direction() {
    let mut numbers = Numbers(11);
    let turned = DQuat::from_xyzw(0.1, -0.3, 0.2, 0.8).normalize();
    for (name, floor) in floors() {
        for rule in rules() {
            for [restitution, friction, height] in WAYS {
                if matches!(rule, Rule::Bisect(_)) && restitution == 1.0 {
                    // What lies and is elastic bounces within its tolerance, and feels when it comes to a new face.
                    continue;
                }
                let direction = TAU * numbers.between(0.0, 1.0);
                let speed = numbers.between(0.05, 1.0);
                let velocity = speed * vec(libm::cos(direction), 0.0, libm::sin(direction));
                let start = vec(numbers.between(-0.3, 0.3), 0.1 + height, 0.125);
                let coefficients = [restitution, friction];
                let turn = if numbers.next() < 0.5 { DQuat::IDENTITY } else { turned };
                let [start, velocity] = [start, velocity].map(|it| turn * it);
                let mut worlds = [&floor, &one_floor()].map(|it| on(it, rule, coefficients, turn));
                let sphere = Sphere::new(start, 0.1).with_velocity(velocity);
                let (most, impacts) = apart(&mut worlds, sphere, 60);
                let what = format!("{name} {rule:?} {coefficients:?} {height} {velocity}: {most}");
                // Times and places of events are rounded; sub-steps only add.
                let tolerance = if matches!(rule, Rule::Exact(_)) { 1e-12 } else { 1e-9 };
                assert!(most <= tolerance, "{what}");
                // In turned frames rounding decides whether a ball that lies there has come to the floor.
                let is_rounded = turn != DQuat::IDENTITY;
                let by_frames = matches!(rule, Rule::Discrete(_) | Rule::Bisect(_));
                assert!(impacts[0] == impacts[1] || (is_rounded && by_frames), "{what}");
            }
        }
    }
}

#[test]
fn a_fast_ball_neither_hops_nor_changes_its_speed_on_a_row_of_tiles() {
    let row: Vec<Collider> = (0..60)
        .map(|number| a_box([0.25, 0.1, 3.0], [-1.0 + 0.25 * f64::from(number), -0.05, 0.0]))
        .collect();
    for rule in rules() {
        for (restitution, speed) in [(0.0, 0.05), (1.0, 0.05), (0.0, 5.0), (1.0, 2.0), (1.0, 5.0)] {
            let mut world = on(&row, rule, [restitution, 0.0], DQuat::IDENTITY);
            if matches!(rule, Rule::Bisect(_)) && restitution == 1.0 {
                continue;
            }
            let sphere = Sphere::new(vec(-0.5, 0.1, 0.013), 0.1);
            let id = world.add_sphere(sphere.with_velocity(vec(speed, 0.0, 0.0))).unwrap();
            for _ in 0..200 {
                world.step(0.01).unwrap();
                let now = world.sphere(id).unwrap();
                let what = format!("{rule:?} {restitution} {speed}: {now:?}");
                // Frames of `discrete` and `bisect` sink in by less than g dt² each.
                let by_frames = matches!(rule, Rule::Discrete(_) | Rule::Bisect(_));
                let depth = if by_frames { 2e-3 } else { 1e-12 };
                assert!((now.position.y - 0.1).abs() <= depth, "{what}");
                assert!((now.velocity.x - speed).abs() <= 1e-12, "{what}");
            }
        }
    }
}

#[test]
fn a_ball_dropped_on_a_seam_or_where_four_tiles_meet_bounces_straight_up() {
    for (name, floor) in floors() {
        for rule in rules() {
            for place in [[0.125, 0.125], [0.125, 0.0], [0.03, 0.125]] {
                let start = vec(place[0], 0.4, place[1]);
                let mut worlds =
                    [&floor, &one_floor()].map(|it| on(it, rule, [1.0, 0.0], DQuat::IDENTITY));
                let (most, impacts) = apart(&mut worlds, Sphere::new(start, 0.1), 60);
                let what = format!("{name} {rule:?} {place:?}: {most} {impacts:?}");
                let tolerance = if matches!(rule, Rule::Exact(_)) { 1e-12 } else { 1e-9 };
                assert!(most <= tolerance && impacts[0] == impacts[1], "{what}");
            }
        }
    }
}

/// A block of 2 by 2 by 2 boxes, and one box of its size.
fn blocks() -> [Vec<Collider>; 2] {
    let size = vec(0.6, 0.4, 0.5);
    let part = |number: usize| {
        let side = |bit: usize| if number >> bit & 1 == 1 { 0.25 } else { -0.25 };
        let place = size * vec(side(0), side(1), side(2));
        a_box((0.5 * size).to_array(), place.to_array())
    };
    [(0..8).map(part).collect(), vec![a_box(size.to_array(), [0.0; 3])]]
}

#[test]
fn eight_boxes_are_one_to_balls_that_strike_their_faces_edges_and_corners() {
    let mut numbers = Numbers(3);
    let turned = DQuat::from_xyzw(0.1, -0.3, 0.2, 0.8).normalize();
    for number in 0..60 {
        let from = 2.0 * numbers.unit_vector();
        let aim = 0.45 * numbers.vector();
        let sphere = Sphere::new(from, 0.15).with_velocity(aim - from);
        let turn = if number % 2 == 0 { DQuat::IDENTITY } else { turned };
        let mut worlds = blocks().map(|block| {
            let mut world = world(Exact::default());
            for it in block {
                let pose = Pose::at(turn * it.pose.position).rotated(turn);
                world.add_collider(it.with_pose(pose)).unwrap();
            }
            world
        });
        let (most, impacts) = apart(&mut worlds, sphere, 100);
        assert!(most <= 1e-11, "{number}: {most}");
        // An edge of the one box is one of each of its faces.
        assert!(impacts[0] <= impacts[1], "{number}: {impacts:?}");
        assert_eq!(impacts[0] > 0, impacts[1] > 0, "{number}: {impacts:?}");
    }
}

/// Impacts of a ball that slides over a step of this height between two tiles, which is as large as a metre.
fn impacts_at_step(height: f64) -> usize {
    let tiles = [a_box([1.0; 3], [0.0, -0.5, 0.0]), a_box([1.0; 3], [1.0, height - 0.5, 0.0])];
    let mut world = on(&tiles, Exact::default().into(), [0.0, 0.0], DQuat::IDENTITY);
    let sphere = Sphere::new(vec(0.0, 0.1, 0.0), 0.1).with_velocity(DVec3::X);
    let id = world.add_sphere(sphere).unwrap();
    let impacts = (0..60).map(|_| world.step(1.0 / 60.0).unwrap().impacts.len()).sum();
    let now = world.sphere(id).unwrap();
    assert!(now.position.x > 0.9, "{height}: {now:?}");
    impacts
}

#[test]
fn a_step_below_a_billionth_of_the_tiles_is_flush_and_a_higher_one_is_an_edge() {
    for height in [1e-15, 1e-12, -1e-12, 5e-10, -5e-10] {
        assert_eq!(impacts_at_step(height), 0, "{height}");
    }
    for height in [1e-7, 1e-5, 1e-3] {
        assert!(impacts_at_step(height) > 0, "{height}");
    }
}

#[test]
fn the_tile_under_the_contact_point_decides_restitution_and_friction() {
    let tile = |x: f64| a_box([2.0, 0.1, 2.0], [x, -0.05, 0.0]);
    for rule in [Rule::Exact(Exact::default()), Rule::Contact(Contact::default())] {
        // Balls that fall on either side of the seam rise to e² of their height.
        for (x, restitution) in [(-1e-3, 1.0), (1e-3, 0.5)] {
            let mut world = on(&[], rule, [1.0, 0.0], DQuat::IDENTITY);
            world.add_collider(tile(-1.0)).unwrap();
            world.add_collider(tile(1.0).with_restitution(0.5)).unwrap();
            let id = world.add_sphere(Sphere::new(vec(x, 0.6, 0.0), 0.1)).unwrap();
            let mut top = 0.0f64;
            let fall = (2.0 * 0.5 / G).sqrt();
            while world.time() < fall * (1.0 + 2.0 * restitution) - 0.05 {
                world.step(0.01).unwrap();
                if world.time() > fall + 0.02 {
                    top = top.max(world.sphere(id).unwrap().position.y - 0.1);
                }
            }
            let expected = restitution * restitution * 0.5;
            assert!((top - expected).abs() <= 2e-3, "{rule:?} {x}: {top} {expected}");
        }
        // What slides without friction is slowed from the seam on: it comes to rest after v²/(2 μ g), if it does
        // not roll: it has no moment of friction on a ball that keeps sliding, so it rolls at 5/7 of its speed.
        let mut world = on(&[], rule, [0.0, 0.0], DQuat::IDENTITY);
        world.add_collider(tile(-1.0)).unwrap();
        world.add_collider(tile(1.0).with_friction(0.5)).unwrap();
        let sphere = Sphere::new(vec(-0.5, 0.1, 0.0), 0.1).with_friction(0.5);
        let id = world.add_sphere(sphere.with_velocity(DVec3::X)).unwrap();
        for _ in 0..120 {
            world.step(1.0 / 120.0).unwrap();
        }
        let speed = world.sphere(id).unwrap().velocity.x;
        assert!((speed - 5.0 / 7.0).abs() <= 1e-3, "{rule:?}: {speed}");
    }
}

#[test]
fn seams_follow_what_is_added_removed_and_moved() {
    let tile = |x: f64| a_box([1.0; 3], [x, -0.5, 0.0]);
    let mut changed =
        on(&[tile(0.0), tile(1.0), tile(3.0)], rules()[0], [0.5, 0.0], DQuat::IDENTITY);
    let far = changed.colliders().last().unwrap().0;
    changed.set_collider(far, tile(2.0).with_restitution(0.5)).unwrap();
    let sphere = Sphere::new(vec(0.0, 0.1, 0.0), 0.1).with_velocity(vec(2.0, 0.0, 0.0));
    let id = changed.add_sphere(sphere).unwrap();
    for _ in 0..60 {
        assert!(changed.step(1.0 / 60.0).unwrap().impacts.is_empty());
    }
    assert_eq!(changed.sphere(id).unwrap().velocity, vec(2.0, 0.0, 0.0));
    // Without the tile that it is coming from, the edge of the one that it comes to is met.
    let mut broken = on(&[tile(0.0), tile(1.0)], rules()[0], [1.0, 0.0], DQuat::IDENTITY);
    let first = broken.colliders().next().unwrap().0;
    broken.remove_collider(first).unwrap();
    let below = Sphere::new(vec(-0.5, -0.02, 0.0), 0.1).with_velocity(vec(8.0, 0.0, 0.0));
    let id = broken.add_sphere(below).unwrap();
    for _ in 0..30 {
        broken.step(1.0 / 60.0).unwrap();
    }
    assert!(broken.sphere(id).unwrap().velocity.x < 0.0);
}

#[test]
fn tiles_that_share_a_motion_are_one_plate() {
    let shaken =
        MotionPart::Oscillate { axis: DVec3::Y, amplitude: 0.02, frequency: 3.0, phase: 0.3 };
    let turning = |x: f64| MotionPart::Turn { axis: DVec3::Z, pivot: vec(-x, 0.0, 0.0), rate: 0.5 };
    let rising = vec(0.1, 0.2, 0.0);
    let moved = |it: Collider, way: usize| match way {
        0 => it.with_motion([shaken.clone()]),
        1 => {
            let part = turning(it.pose.position.x);
            it.with_motion([part])
        }
        _ => it.moving(rising, DVec3::ZERO),
    };
    for turns in 0..3 {
        let tiles = [-0.5, 0.5].map(|x| moved(rectangle([1.0; 2], [x, 0.0, 0.0]), turns));
        let plate = moved(rectangle([2.0, 1.0], [0.0; 3]), turns);
        let mut worlds = [tiles.to_vec(), vec![plate]]
            .map(|it| on(&it, rules()[0], [0.7, 0.0], DQuat::IDENTITY));
        let sphere = Sphere::new(vec(-0.2, 0.3, 0.0), 0.1).with_velocity(vec(0.4, 0.0, 0.0));
        let (most, impacts) = apart(&mut worlds, sphere, 60);
        // The way of a turning plate is searched, to some ε of its coordinates for each impact.
        assert!(most <= 1e-10, "{turns}: {most} {impacts:?}");
        assert_eq!(impacts[0], impacts[1], "{turns}");
    }
}

#[test]
fn a_wall_of_turned_boxes_that_move_together_is_the_same_at_any_size() {
    // Each step rounds the poses of the boxes, and their seams follow; powers of two round nothing.
    let state_after = |length: f64, time: f64| {
        let exact = Exact::default();
        let mut world = world(exact.with_contact_duration(exact.contact_duration * time));
        let turn = DQuat::from_rotation_z(1.429_303_5);
        let velocity = 0.353_967_976_149_224_76 * length / time * DVec3::Z;
        for number in 0..7 {
            let place = turn * vec(0.4 * f64::from(number) - 1.2, -0.8, 0.0);
            let shape = Shape::Box { size: length * vec(0.4, 0.4, 2.0) };
            let wall = Collider::new(shape, Pose::at(length * place).rotated(turn));
            world.add_collider(wall.moving(velocity, DVec3::ZERO)).unwrap();
        }
        let towards = turn * vec(0.7, -1.3, 0.2) * length / time;
        let ball = Sphere::new(DVec3::ZERO, 0.2 * length).with_velocity(velocity + towards);
        let ball = world.add_sphere(ball).unwrap();
        let mut impacts = 0;
        for _ in 0..60 {
            impacts += world.step(0.011_718_75 * time).unwrap().impacts.len();
        }
        assert_eq!(impacts, 1);
        let Sphere { position, velocity, .. } = world.sphere(ball).unwrap();
        (position / length, velocity * (time / length))
    };
    let large = f64::from(1 << 20);
    let at_one = state_after(1.0, 1.0);
    assert_eq!(state_after(large, f64::from(1 << 17)), at_one);
    assert_eq!(state_after(large.recip(), f64::from(1 << 14).recip()), at_one);
}

#[test]
fn a_ball_that_passes_through_the_next_tile_leaves_its_own_over_the_edge() {
    let tile = |x: f64| a_box([1.0; 3], [x, -0.5, 0.0]);
    let other = tile(1.0).with_groups(Groups { groups: 2, collides_with: 2 });
    let mut worlds = [vec![tile(0.0), other], vec![tile(0.0)]]
        .map(|it| on(&it, rules()[0], [0.5, 0.0], DQuat::IDENTITY));
    let sphere = Sphere::new(vec(0.0, 0.1, 0.0), 0.1).with_velocity(vec(0.5, 0.0, 0.0));
    let (most, _) = apart(&mut worlds, sphere, 90);
    assert_eq!(most, 0.0);
    let fallen = worlds[0].spheres().positions()[0];
    assert!(fallen.y < 0.0);
}

#[test]
fn queries_and_predictions_see_one_floor() {
    let (_, floor) = floors().swap_remove(0);
    let mut world = on(&floor, rules()[0], [1.0, 0.0], DQuat::IDENTITY);
    let mut numbers = Numbers(5);
    for _ in 0..200 {
        let start = vec(numbers.between(-0.5, 0.5), 0.4, numbers.between(-0.5, 0.5));
        let aim = vec(numbers.between(-0.5, 0.5), 0.0, numbers.between(-0.5, 0.5));
        let hit = world.cast_sphere(start, 0.1, aim - start, &QueryFilter::DEFAULT).unwrap();
        let hit = hit.unwrap();
        assert!((hit.normal - DVec3::Y).length() <= 1e-12, "{hit:?}");
        assert!(matches!(hit.body, Body::Collider(_)));
    }
    let sphere = Sphere::new(vec(-0.5, 0.3, 0.02), 0.1).with_velocity(vec(0.6, 0.0, 0.1));
    let id: SphereId = world.add_sphere(sphere).unwrap();
    let path = world.predict(id, 1.0, 100).unwrap();
    for _ in 0..32 {
        world.step(1.0 / 32.0).unwrap();
    }
    let now = world.sphere(id).unwrap();
    assert_eq!(path.position_at(1.0), Some(now.position));
    assert!((now.velocity.x - 0.6).abs() <= 1e-12);
}
