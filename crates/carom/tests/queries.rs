//! Queries: rays, spheres on their way, what is nearest and what overlaps, against loops over all bodies and
//! against steps. Has caught rays that rounding put behind a rectangle.

mod common;

use carom::{
    Body, Boundary, Collider, DQuat, DVec3, Error, Hit, Pose, QueryFilter, Settings, Shape, Sides,
    Sphere, SphereId, World,
};
use common::{Numbers, assert_close, assert_close_vec, vec};

const ALL: QueryFilter = QueryFilter::DEFAULT;

/// Spheres of radii from 0.02 to 0.3 in a cube from -`half` to `half`.
fn scattered(count: usize, half: f64, seed: u64) -> World {
    let mut numbers = Numbers(seed);
    let mut world = World::default();
    for _ in 0..count {
        let center = half * numbers.vector();
        world.add_sphere(Sphere::new(center, numbers.between(0.02, 0.3))).unwrap();
    }
    world
}

/// Part of the way before a ray meets a sphere, by the quadratic formula.
fn by_formula(origin: DVec3, way: DVec3, center: DVec3, radius: f64) -> Option<f64> {
    let offset = origin - center;
    let (a, b) = (way.dot(way), offset.dot(way));
    let discriminant = b * b - a * (offset.dot(offset) - radius * radius);
    let fraction = (-b - discriminant.sqrt()) / a;
    (discriminant > 0.0 && (0.0..=1.0).contains(&fraction)).then_some(fraction)
}

#[test]
fn a_ray_meets_the_first_sphere_of_the_loop_over_all() {
    let world = scattered(400, 2.0, 1);
    let (queries, mut numbers, mut met) = (world.queries(), Numbers(2), 0);
    for _ in 0..2_000 {
        let (origin, way) = (4.0 * numbers.unit_vector(), 8.0 * numbers.vector());
        let spheres = world.spheres();
        let bodies = spheres.positions().iter().zip(spheres.radii()).zip(spheres.ids());
        let times = bodies.filter_map(|((&center, &radius), &id)| {
            by_formula(origin, way, center, radius).map(|fraction| (fraction, id))
        });
        let expected = times.min_by(|a, b| a.0.total_cmp(&b.0));
        let found = queries.cast_ray(origin, way, &ALL).unwrap();
        assert_eq!(found.map(|hit| hit.body), expected.map(|(_, id)| Body::Sphere(id)));
        if let (Some(hit), Some((fraction, id))) = (found, expected) {
            met += 1;
            // A grazing ray loses half the digits in the formula.
            assert_close(hit.fraction, fraction, 1e-7);
            let sphere = world.sphere(id).unwrap();
            let outward = (hit.point - sphere.position) / sphere.radius;
            assert_close_vec(hit.normal, outward, 1e-13);
        }
    }
    assert!(met > 150, "{met}");
}

#[test]
fn sorted_bodies_give_the_bits_of_a_single_query() {
    let mut world = scattered(300, 2.0, 3);
    world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(vec(0.0, -2.0, 0.0)))).unwrap();
    for collider in colliders() {
        world.add_collider(collider.moving(vec(0.5, 0.0, -0.25), DVec3::ZERO)).unwrap();
    }
    // Single queries look only at surfaces near them, where these are now.
    world.step(0.5).unwrap();
    let (queries, mut numbers) = (world.queries(), Numbers(4));
    for _ in 0..300 {
        let (place, way) = (2.0 * numbers.vector(), 5.0 * numbers.vector());
        let ray = queries.cast_ray(place, way, &ALL);
        assert_eq!(ray, world.cast_ray(place, way, &ALL));
        let sphere = queries.cast_sphere(place, 0.1, way, &ALL);
        assert_eq!(sphere, world.cast_sphere(place, 0.1, way, &ALL));
        for within in [0.1, 1.0, f64::INFINITY] {
            assert_eq!(queries.nearest(place, within, &ALL), world.nearest(place, within, &ALL));
        }
        assert_eq!(queries.overlapping(place, 0.4, &ALL), world.overlapping(place, 0.4, &ALL));
    }
}

fn colliders() -> Vec<Collider> {
    let turned = DQuat::from_axis_angle(vec(0.6, 0.0, 0.8), 0.7);
    let open = Sides { top: true, ..Sides::NONE };
    vec![
        Collider::new(Shape::Sphere { radius: 0.5 }, Pose::at(vec(2.0, 1.0, 0.0))),
        Collider::new(Shape::HalfSpace, Pose::at(vec(0.0, -3.0, 0.0))),
        Collider::new(
            Shape::Box { size: vec(1.0, 2.0, 0.5) },
            Pose::at(vec(-2.0, 0.0, 1.0)).rotated(turned),
        ),
        Collider::new(
            Shape::Rectangle { size_x: 2.0, size_z: 1.0 },
            Pose::at(vec(0.0, 0.0, -2.0)).rotated(turned),
        ),
        Collider::new(
            Shape::Container { size: vec(2.0, 1.0, 2.0), open },
            Pose::at(vec(0.0, -1.5, 2.0)),
        ),
    ]
}

#[test]
fn a_cast_sphere_meets_what_a_ball_meets_in_a_step() {
    let mut numbers = Numbers(5);
    let mut met = 0;
    for _ in 0..600 {
        let mut world = World::default();
        for collider in colliders() {
            world.add_collider(collider).unwrap();
        }
        let center = 3.0 * numbers.unit_vector() + vec(0.0, 0.5, 0.0);
        if !world.overlapping(center, 0.2, &ALL).unwrap().is_empty() {
            continue;
        }
        let way = 6.0 * numbers.vector();
        let hit = world.cast_sphere(center, 0.2, way, &ALL).unwrap();
        world.add_sphere(Sphere::new(center, 0.2).with_velocity(way)).unwrap();
        let impacts = world.step(1.0).unwrap().impacts.clone();
        assert_eq!(hit.is_some(), !impacts.is_empty(), "{center} {way}");
        if let (Some(hit), Some(impact)) = (hit, impacts.first()) {
            met += 1;
            // Both are exact to rounding of coordinates of some metres.
            assert_close(hit.fraction, impact.time, 1e-13);
            assert_close_vec(hit.point, impact.point, 1e-12);
            assert_close_vec(hit.normal, impact.normal, 1e-10);
        }
    }
    assert!(met > 150, "{met}");
}

#[test]
fn no_ray_at_the_face_of_a_rectangle_or_a_box_is_lost() {
    let mut numbers = Numbers(6);
    for collider in &colliders()[2..4] {
        let mut world = World::default();
        world.add_collider(collider.clone()).unwrap();
        let rotation = collider.pose.rotation;
        // Of the box the side towards +y has the same size along x.
        let lift = if matches!(collider.shape, Shape::Box { .. }) { 1.0 } else { 0.0 };
        for _ in 0..3_000 {
            let local = vec(numbers.between(-0.49, 0.49), lift, numbers.between(-0.24, 0.24));
            let point = collider.pose.position + rotation * local;
            let mut from = numbers.unit_vector() * numbers.between(0.1, 9.0);
            if from.dot(rotation * DVec3::Y) < 0.0 {
                from = -from;
            }
            let hit = world.cast_ray(point + from, -2.0 * from, &ALL).unwrap();
            let hit = hit.unwrap_or_else(|| panic!("a ray from {from} at {point} is lost"));
            // The nearer the ray is to the plane, the farther rounding moves the point along it.
            let slope = from.normalize().dot(rotation * DVec3::Y);
            assert_close_vec(hit.point, point, 1e-14 / slope);
        }
    }
}

#[test]
fn a_rectangle_is_met_from_its_front_only() {
    let mut world = World::default();
    let size = Shape::Rectangle { size_x: 2.0, size_z: 2.0 };
    world.add_collider(Collider::new(size, Pose::at(DVec3::ZERO))).unwrap();
    let down = world.cast_ray(vec(0.5, 1.0, 0.0), vec(0.0, -2.0, 0.0), &ALL).unwrap().unwrap();
    assert_eq!((down.fraction, down.normal), (0.5, DVec3::Y));
    assert_eq!(world.cast_ray(vec(0.5, -1.0, 0.0), vec(0.0, 2.0, 0.0), &ALL), Ok(None));
    assert_eq!(world.cast_ray(vec(1.5, 1.0, 0.0), vec(0.0, -2.0, 0.0), &ALL), Ok(None));
}

#[test]
fn a_ray_that_starts_in_a_body_meets_it_at_once_but_not_the_walls_of_a_container() {
    let mut world = World::default();
    let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 1.0)).unwrap();
    let hit = world.cast_ray(vec(0.2, 0.0, 0.0), DVec3::X, &ALL).unwrap().unwrap();
    assert_eq!((hit.body, hit.fraction), (Body::Sphere(ball), 0.0));
    let except = QueryFilter::default().without_sphere(ball);
    let size = vec(4.0, 4.0, 4.0);
    let shape = Shape::Container { size, open: Sides::NONE };
    let walls = world.add_collider(Collider::new(shape, Pose::at(DVec3::ZERO))).unwrap();
    let hit = world.cast_ray(DVec3::ZERO, vec(8.0, 0.0, 0.0), &except).unwrap().unwrap();
    assert_eq!((hit.body, hit.fraction), (Body::Collider(walls), 0.25));
    assert_eq!(hit.normal, DVec3::NEG_X);
}

#[test]
fn a_ray_that_leaves_the_surface_it_starts_on_meets_nothing() {
    let mut numbers = Numbers(7);
    let center = vec(0.3, -0.7, 1.1);
    let mut world = World::default();
    world.add_sphere(Sphere::new(center, 0.6)).unwrap();
    for _ in 0..1_000 {
        let (normal, away) = (numbers.unit_vector(), numbers.unit_vector());
        let way = if away.dot(normal) < 0.0 { -away } else { away };
        assert_eq!(world.cast_ray(center + 0.6 * normal, way, &ALL), Ok(None), "{normal} {way}");
    }
}

#[test]
fn the_nearest_body_is_that_of_the_loop_over_all() {
    let world = scattered(300, 2.0, 8);
    let (queries, mut numbers) = (world.queries(), Numbers(9));
    for _ in 0..500 {
        let point = 3.0 * numbers.vector();
        let spheres = world.spheres();
        let distance = |(center, radius): (&DVec3, &f64)| point.distance(*center) - radius;
        let distances = spheres.positions().iter().zip(spheres.radii()).map(distance);
        let expected = distances.fold(f64::INFINITY, f64::min);
        let found = queries.nearest(point, f64::INFINITY, &ALL).unwrap().unwrap();
        assert_close(found.distance, expected, 1e-14);
        // From the point the nearest point of the surface is along the normal.
        assert_close_vec(found.point + found.distance * found.normal, point, 1e-14);
        let nothing = queries.nearest(point, (expected - 1e-6).max(0.0), &ALL).unwrap();
        assert!(nothing.is_none() || expected < 0.0);
    }
}

#[test]
fn overlapping_bodies_come_once_and_in_order() {
    let mut world = scattered(100, 1.0, 10);
    for collider in colliders() {
        world.add_collider(collider).unwrap();
    }
    let found = world.overlapping(vec(-1.5, 0.0, 1.0), 1.0, &ALL).unwrap();
    assert!(found.windows(2).all(|two| two[0].body < two[1].body), "{found:?}");
    let center = vec(-1.5, 0.0, 1.0);
    let spheres: Vec<SphereId> = world
        .spheres()
        .ids()
        .iter()
        .copied()
        .filter(|&id| {
            let sphere = world.sphere(id).unwrap();
            sphere.position.distance(center) <= sphere.radius + 1.0
        })
        .collect();
    let near_spheres = found.iter().filter_map(|near| match near.body {
        Body::Sphere(id) => Some(id),
        Body::Collider(_) => None,
    });
    assert_eq!(near_spheres.collect::<Vec<_>>(), spheres);
    assert_eq!(found.len(), spheres.len() + 1, "the solid box, once");
    assert!(found.last().unwrap().distance < -1.0, "the place is in it");
}

fn periodic(size: DVec3) -> World {
    World::new(Settings::default().with_boundary(Boundary::Periodic { size })).unwrap()
}

#[test]
fn queries_see_through_the_faces_of_a_periodic_box() {
    let mut world = periodic(DVec3::splat(4.0));
    let ball = world.add_sphere(Sphere::new(vec(-1.8, 0.0, 0.0), 0.5)).unwrap();
    let hit = world.cast_ray(vec(1.0, 0.0, 0.0), vec(2.0, 0.0, 0.0), &ALL).unwrap().unwrap();
    // Its image is at 2.2.
    assert_eq!(hit.body, Body::Sphere(ball));
    assert_close(hit.fraction, 0.35, 1e-15);
    assert_close_vec(hit.point, vec(1.7, 0.0, 0.0), 1e-15);
    let near = world.nearest(vec(1.5, 0.0, 0.0), f64::INFINITY, &ALL).unwrap().unwrap();
    assert_close(near.distance, 0.2, 1e-15);
    assert_close_vec(near.point, vec(1.7, 0.0, 0.0), 1e-15);
    assert_eq!(world.overlapping(vec(1.9, 0.0, 0.0), 0.3, &ALL).unwrap().len(), 1);
    assert!(world.overlapping(vec(0.9, 0.0, 0.0), 0.3, &ALL).unwrap().is_empty());
}

#[test]
fn a_ray_across_many_periodic_boxes_meets_what_it_meets_in_the_first_one() {
    let mut numbers = Numbers(11);
    let mut world = periodic(DVec3::splat(4.0));
    for _ in 0..3 {
        world.add_sphere(Sphere::new(2.0 * numbers.vector(), 0.1)).unwrap();
    }
    let mut far = 0;
    for _ in 0..300 {
        let (origin, way) = (2.0 * numbers.vector(), 400.0 * numbers.unit_vector());
        let Some(hit) = world.cast_ray(origin, way, &ALL).unwrap() else { continue };
        let Body::Sphere(id) = hit.body else { panic!("there are spheres only") };
        // The point is on the way, and on the sphere.
        assert_close_vec(hit.point, origin + hit.fraction * way, 1e-10);
        let center = world.sphere(id).unwrap().position;
        let offset = world.settings().boundary.nearest_image(hit.point - center);
        if offset.length() > 1e-9 {
            assert_close(offset.length(), 0.1, 1e-10);
        }
        far += usize::from(hit.fraction > 0.1);
    }
    assert!(far > 100, "{far}");
}

#[test]
fn filters_choose_what_is_found() {
    let mut world = World::default();
    let ball = world.add_sphere(Sphere::new(vec(1.0, 0.0, 0.0), 0.1)).unwrap();
    let pose = Pose::at(vec(2.0, 0.0, 0.0));
    let sensor = Collider::new(Shape::Sphere { radius: 0.1 }, pose).as_trigger();
    let sensor = world.add_collider(sensor).unwrap();
    let solid = Collider::new(Shape::Box { size: DVec3::splat(0.2) }, Pose::at(vec(3.0, 0.0, 0.0)));
    let solid = world.add_collider(solid).unwrap();
    let seen = |filter: QueryFilter| {
        let hit: Option<Hit> = world.cast_ray(DVec3::ZERO, vec(5.0, 0.0, 0.0), &filter).unwrap();
        hit.map(|hit| hit.body)
    };
    assert_eq!(seen(ALL), Some(Body::Sphere(ball)));
    assert_eq!(seen(ALL.without_sphere(ball)), Some(Body::Collider(solid)));
    let with_triggers = ALL.with_spheres(false).with_triggers(true);
    assert_eq!(seen(with_triggers), Some(Body::Collider(sensor)));
    assert_eq!(seen(ALL.with_spheres(false).with_colliders(false)), None);
}

#[test]
fn lengths_of_any_scale_give_the_same_fractions() {
    let fractions = |scale: f64| -> Vec<Option<f64>> {
        let mut numbers = Numbers(12);
        let mut world = World::default();
        for _ in 0..50 {
            let (center, radius) = (numbers.vector(), numbers.between(0.02, 0.2));
            world.add_sphere(Sphere::new(scale * center, scale * radius)).unwrap();
        }
        for mut collider in colliders() {
            collider.pose.position *= scale;
            collider.shape = match collider.shape {
                Shape::Sphere { radius } => Shape::Sphere { radius: scale * radius },
                Shape::Box { size } => Shape::Box { size: scale * size },
                Shape::Container { size, open } => Shape::Container { size: scale * size, open },
                Shape::Rectangle { size_x, size_z } => {
                    Shape::Rectangle { size_x: scale * size_x, size_z: scale * size_z }
                }
                shape => shape,
            };
            world.add_collider(collider).unwrap();
        }
        let queries = world.queries();
        let ray = |_| {
            let (origin, way) = (3.0 * numbers.vector(), 6.0 * numbers.vector());
            let hit = queries.cast_ray(scale * origin, scale * way, &ALL).unwrap();
            hit.map(|hit| hit.fraction)
        };
        (0..200).map(ray).collect()
    };
    let expected = fractions(1.0);
    assert!(expected.iter().flatten().count() > 50);
    // Powers of two change no digit.
    assert_eq!(fractions(1.0 / 1_048_576.0), expected);
    assert_eq!(fractions(1_048_576.0), expected);
}

#[test]
fn an_empty_world_has_nothing_to_find() {
    let world = World::default();
    assert_eq!(world.cast_ray(DVec3::ZERO, DVec3::X, &ALL), Ok(None));
    assert_eq!(world.nearest(DVec3::ZERO, f64::INFINITY, &ALL), Ok(None));
    assert_eq!(world.overlapping(DVec3::ZERO, 1.0, &ALL), Ok(Vec::new()));
    assert_eq!(periodic(DVec3::ONE).cast_ray(DVec3::ZERO, vec(1e3, 0.0, 0.0), &ALL), Ok(None));
}

#[test]
fn numbers_that_make_no_sense_are_refused_by_name() {
    let world = periodic(DVec3::splat(2.0));
    let refused = |result: Result<(), Error>| result.unwrap_err().to_string();
    let ray = |origin, way| refused(world.cast_ray(origin, way, &ALL).map(drop));
    assert!(ray(DVec3::NAN, DVec3::X).contains("query: `origin` must be finite"));
    assert!(ray(DVec3::ZERO, DVec3::INFINITY).contains("query: `way` must be finite"));
    assert!(ray(DVec3::ZERO, 1e9 * DVec3::X).contains("at most 65,536 boxes long"));
    let sphere = |radius| refused(world.cast_sphere(DVec3::ZERO, radius, DVec3::X, &ALL).map(drop));
    assert!(sphere(0.0).contains("`radius` must be positive"));
    assert!(sphere(3.0).contains("shortest edge of the periodic box"));
    let nearest = world.nearest(DVec3::ZERO, -1.0, &ALL).map(drop);
    assert!(refused(nearest).contains("`within` must be zero or positive"));
}
