//! Rays, moving spheres and neighbours answer with entities and closed forms.

mod common;

use bevy_ecs::prelude::*;
use bevy_ecs::system::RunSystemOnce;
use bevy_math::{DVec3, Dir3, Ray3d, Vec3};
use bevy_transform::components::Transform;
use carom_bevy::carom::QueryFilter;
use carom_bevy::prelude::*;
use common::{app, steps};

#[test]
fn a_ray_meets_the_nearest_body() {
    let mut app = app();
    let floor = app.world_mut().spawn(Collider::half_space()).id();
    let place = Transform::from_xyz(0.0, 4.0, 0.0);
    let ball = app.world_mut().spawn((Ball::new(1.0), place)).id();
    steps(&mut app, 1);
    let answers = app.world_mut().run_system_once_with(ask, ball);
    let [first, behind, missed] = answers.expect("it runs").expect("valid questions");
    let first = first.expect("the ball is below");
    assert_eq!((first.entity, first.distance), (ball, 3.0));
    assert_eq!((first.point, first.normal), (DVec3::new(0.0, 5.0, 0.0), DVec3::Y));
    let behind = behind.expect("the floor is below");
    assert_eq!((behind.entity, behind.distance), (floor, 8.0));
    assert_eq!(missed, None);
}

type Answers = [Option<carom_bevy::BodyHit>; 3];

fn ask(In(ball): In<Entity>, query: SpatialQuery) -> Result<Answers, carom_bevy::carom::Error> {
    let ray = Ray3d { origin: Vec3::new(0.0, 8.0, 0.0), direction: Dir3::NEG_Y };
    let all = QueryFilter::default();
    let hit = query.cast_ray(ray, 100.0, &all)?;
    let behind = query.cast_ray(ray, 100.0, &query.without(all, ball))?;
    let missed = query.cast_ray(ray, 2.5, &all)?;
    Ok([hit, behind, missed])
}

#[test]
fn neighbours_are_found_with_their_distance() {
    let mut app = app();
    let place = Transform::from_xyz(3.0, 0.0, 0.0);
    let ball = app.world_mut().spawn((Ball::new(1.0), place)).id();
    steps(&mut app, 1);
    let found = app.world_mut().run_system_once(|query: SpatialQuery| {
        let all = QueryFilter::default();
        let nearest = query.nearest(DVec3::ZERO, 10.0, &all)?;
        let ray = Ray3d { origin: Vec3::ZERO, direction: Dir3::X };
        let swept = query.cast_sphere(ray, 0.5, 10.0, &all)?;
        let count = query.overlapping(DVec3::ZERO, 2.5, &all)?.len();
        Ok::<_, carom_bevy::carom::Error>((nearest, swept, count))
    });
    let (nearest, swept, count) = found.expect("it runs").expect("valid questions");
    let nearest = nearest.expect("a ball");
    assert_eq!((nearest.entity, nearest.distance), (ball, 2.0));
    assert_eq!(swept.map(|hit| (hit.entity, hit.distance)), Some((ball, 1.5)));
    assert_eq!(count, 1);
}
