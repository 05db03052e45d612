//! Laws that need no reference: results do not depend on the unit of length, on who looks on, on the length of
//! frames, or on which side a mirror shows. Such laws find lengths that are written down in metres, predictions
//! that begin with a frame, and impacts of one instant that are answered one after the other.

mod common;

use carom::{
    Collider, Contact, DQuat, DVec3, Exact, Gravity, ImpactLaw, Pose, Rule, Settings, Shape, Sides,
    Sphere, World,
};
use common::{G, Numbers, vec};

const FRAME: f64 = 1.0 / 60.0;

/// A half-space that faces this way, through a point \[m\].
fn half_space(normal: DVec3, position: DVec3) -> Collider {
    let rotation = DQuat::from_rotation_arc(DVec3::Y, normal);
    Collider::new(Shape::HalfSpace, Pose { position, rotation })
}

fn closed_box(size: DVec3) -> Collider {
    let shape = Shape::Container { size, open: Sides::default() };
    Collider::new(shape, Pose::at(DVec3::ZERO))
}

/// Spheres at random in a cube of two metres, none of which touches another one; places \[m\], radii \[m\] and
/// velocities of some metres per second.
fn scattered(seed: u64, count: usize, radii: [f64; 2]) -> Vec<Sphere> {
    let mut numbers = Numbers(seed);
    let mut spheres: Vec<Sphere> = Vec::new();
    while spheres.len() < count {
        let (place, radius) = (0.8 * numbers.vector(), numbers.between(radii[0], radii[1]));
        let is_apart = |it: &Sphere| (it.position - place).length() > it.radius + radius + 0.01;
        if spheres.iter().all(is_apart) {
            // More or less to the middle.
            let velocity = numbers.vector() - place;
            spheres.push(Sphere::new(place, radius).with_velocity(velocity));
        }
    }
    spheres
}

/// The sphere in a scene whose lengths are this many times as long.
fn of_length(sphere: Sphere, length: f64) -> Sphere {
    let larger = Sphere::new(length * sphere.position, length * sphere.radius);
    larger.with_velocity(length * sphere.velocity)
}

/// Balls that fall on round things and come to rest, in a scene whose lengths are this many times as long.
fn scene_of_length(rule: Rule, length: f64) -> World {
    let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
    world.add_force(Gravity::new(vec(0.0, -G * length, 0.0))).unwrap();
    for sphere in scattered(21, 5, [0.1, 0.2]) {
        world.add_sphere(of_length(sphere, length).with_restitution(0.5)).unwrap();
    }
    let walls = closed_box(length * DVec3::splat(2.0)).with_restitution(0.4).with_friction(0.3);
    world.add_collider(walls).unwrap();
    let dome = Pose::at(length * vec(0.0, -3.3, 0.0));
    let dome = Collider::new(Shape::Sphere { radius: length * 2.5 }, dome);
    world.add_collider(dome.with_restitution(0.6)).unwrap();
    world
}

/// A ball that bounces on a dome and rolls over it, beside a box, in a scene whose lengths are this many times as
/// long.
fn dome_of_length(rule: Rule, length: f64) -> World {
    let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
    world.add_force(Gravity::new(vec(0.0, -G * length, 0.0))).unwrap();
    let ball = Sphere::new(length * vec(0.71, 0.6, 0.0), length * 0.1).with_restitution(0.9);
    world.add_sphere(ball).unwrap();
    for (shape, y) in [
        (Shape::Sphere { radius: length * 2.0 }, -2.0),
        (Shape::Box { size: length * DVec3::splat(0.5) }, 0.0),
        (Shape::HalfSpace, -3.0),
    ] {
        let x = if y == 0.0 { 1.0 } else { 0.0 };
        let collider = Collider::new(shape, Pose::at(length * vec(x, y, 0.0)));
        world.add_collider(collider.with_restitution(0.6)).unwrap();
    }
    world
}

#[test]
fn results_do_not_depend_on_the_unit_of_length() {
    let scenes = [scene_of_length, dome_of_length];
    let rules = [Rule::Exact(Exact::default()), Rule::Contact(Contact::default())];
    for (scene, rule) in scenes.into_iter().flat_map(|scene| rules.map(|rule| (scene, rule))) {
        let mut worlds = [-20, 0, 3, 5, 6, 9].map(|power| {
            let length = libm::exp2(f64::from(power));
            (length, scene(rule, length))
        });
        for frame in 0..240 {
            let [expected, states @ ..] = worlds.each_mut().map(|(length, world)| {
                world.step(FRAME).unwrap();
                let spheres = world.spheres();
                let states = spheres.positions().iter().zip(spheres.velocities());
                // Powers of two round nothing.
                states.map(|(x, v)| [*x / *length, *v / *length]).collect::<Vec<_>>()
            });
            assert!(states.iter().all(|state| *state == expected), "{rule:?}, frame {frame}");
        }
    }
}

/// A ball that falls beside others, so that lanes of the processor's vectors stay empty.
#[test]
fn a_long_fall_has_no_more_searches_than_a_short_one() {
    let searches = [1.0, 1024.0].map(|length| {
        let mut world = World::new(Settings::default().with_rule(Contact::default())).unwrap();
        world.add_force(Gravity::new(vec(0.0, -G * length, 0.0))).unwrap();
        for sphere in scattered(21, 3, [0.1, 0.2]) {
            world.add_sphere(of_length(sphere, length)).unwrap();
        }
        (0..30).map(|_| world.step(FRAME).unwrap().work.searches).sum::<u64>()
    });
    assert_eq!(searches[0], searches[1]);
}

/// A ball: its place, velocity, radius and mass.
type Ball = ([f64; 3], [f64; 3], f64, f64);

/// Balls that pass with a common velocity, and meet in threes in a sub-step: places \[m\], velocities \[m/s\], radii
/// \[m\] and masses \[kg\].
const PASSING: [Ball; 9] = [
    (
        [-0.5769229291730253, 0.6541470607405642, 0.15891728952995476],
        [-36.541580915564865, 75.1806146974851, -3.502863873093686],
        0.29137418699426865,
        3.9295865346157735,
    ),
    (
        [0.6229015516231036, 0.700632302372691, 0.594286893456978],
        [-37.77248247206976, 75.12659381626638, -4.088772003443457],
        0.2870409508175793,
        7.189517389889655,
    ),
    (
        [-0.07247052712560587, 0.14211982742605678, -0.11032767265061894],
        [-37.01380027117132, 75.70350594941216, -3.4204719812562248],
        0.2696266038105408,
        1.1599841499707102,
    ),
    (
        [-0.6553999281332561, -0.45196105936364034, 0.6132627201655332],
        [-36.477692694978245, 76.32325800630605, -3.9749455606260327],
        0.2553849548791106,
        3.262060910979227,
    ),
    (
        [0.78480520615047, -0.5926949206224152, -0.7327777557233905],
        [-37.86132359416068, 76.49784511361347, -2.7716447667394375],
        0.20638420568710175,
        3.7250398629654136,
    ),
    (
        [0.49776581144438903, 0.21670557851941963, -0.51963440913755],
        [-37.63988664649422, 75.54873183270904, -2.920769287735386],
        0.18966260233328447,
        3.8500507086253557,
    ),
    (
        [0.5163881588159257, -0.16437945835510037, 0.7455618528610796],
        [-37.62449359891255, 76.08795687888882, -4.209675724586516],
        0.15076526000712479,
        1.968687598547658,
    ),
    (
        [-0.31684956380271856, -0.6370248282103483, -0.27955708245248334],
        [-36.84314413883528, 76.47389969552577, -3.1057577087007937],
        0.14202674301591642,
        1.8200581784448717,
    ),
    (
        [-0.15887954508224644, 0.3511233884207855, -0.8497576578366879],
        [-36.94618620854961, 75.40472434709923, -2.5329473588682125],
        0.1265654591517107,
        2.333923247557177,
    ),
];

#[test]
fn who_looks_on_does_not_matter_to_balls_in_free_space() {
    let common = PASSING.iter().map(|ball| DVec3::from_array(ball.1)).sum::<DVec3>() / 9.0;
    let mut impacts = [0; 2];
    let [passing, still] = [0, 1].map(|looks| {
        let mut world = World::new(Settings::default().with_rule(Contact::default())).unwrap();
        for (place, velocity, radius, mass) in PASSING {
            let velocity = DVec3::from_array(velocity) - f64::from(looks) * common;
            let sphere = Sphere::new(place.into(), radius).with_velocity(velocity);
            world.add_sphere(sphere.with_mass(mass)).unwrap();
        }
        for _ in 0..120 {
            impacts[looks as usize] += world.step(FRAME).unwrap().impacts.len();
        }
        world
    });
    assert!(impacts[0] == impacts[1] && impacts[0] > 10, "{impacts:?}");
    let pairs = passing.spheres().positions().iter().zip(still.spheres().positions());
    for (passing, still) in pairs {
        // Coordinates of 170 m are rounded in each sub-step, and impacts make more of it.
        let apart = (*passing - 2.0 * common - *still).length();
        assert!(apart < 1e-8, "{apart} m");
    }
}

/// Two to five balls in a box, some of them rough, that come to rest there.
fn balls_in_a_box(number: u64) -> World {
    let mut numbers = Numbers(number);
    let laws = [ImpactLaw::Simultaneous, ImpactLaw::Reflection, ImpactLaw::Sequential];
    let exact = Exact::default().with_impact_law(laws[number as usize % 3]);
    let mut world = World::new(Settings::default().with_rule(exact)).unwrap();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let count = 2 + number as usize % 4;
    let mut places: Vec<(DVec3, f64)> = Vec::new();
    while places.len() < count {
        let (place, radius) = (0.6 * numbers.vector(), numbers.between(0.08, 0.18));
        if places.iter().all(|(other, r)| (*other - place).length() > r + radius + 0.01) {
            places.push((place, radius));
        }
    }
    let restitution = [0.0, 0.2, 0.5][number as usize / 3 % 3];
    for (place, radius) in places {
        let sphere = Sphere::new(place, radius).with_velocity(numbers.vector());
        let sphere = sphere.with_restitution(restitution);
        let rough = if numbers.next() < 0.5 { sphere.with_friction(0.2) } else { sphere };
        world.add_sphere(rough).unwrap();
    }
    let walls = closed_box(vec(1.6, 2.0, 1.6)).with_restitution(0.2);
    world
        .add_collider(if number.is_multiple_of(2) { walls.with_friction(0.4) } else { walls })
        .unwrap();
    world
}

#[test]
fn frames_of_any_length_lead_to_the_same_bits_through_contacts_and_zones() {
    let mut stepped = 0;
    for number in 0..48 {
        let [end, others @ ..] = [1.0 / 16.0, 0.25, 1.0 / 256.0].map(|frame| {
            let mut world = balls_in_a_box(number);
            while world.time() < 1.5 {
                world.step(frame).unwrap();
            }
            stepped += u32::from(world.was_stepped());
            world
        });
        for other in others {
            assert_eq!(other.spheres().positions(), end.spheres().positions(), "{number}");
            assert_eq!(other.spheres().velocities(), end.spheres().velocities(), "{number}");
        }
    }
    assert!(stepped > 10, "{stepped}");
}

#[test]
fn a_rack_that_is_its_own_mirror_image_stays_so() {
    for law in [ImpactLaw::Simultaneous, ImpactLaw::Reflection] {
        let exact = Exact::default().with_impact_law(law);
        let mut world = World::new(Settings::default().with_rule(exact)).unwrap();
        world.add_force(Gravity::new(vec(0.0, -10.0, 0.0))).unwrap();
        world.add_collider(half_space(DVec3::Y, DVec3::ZERO).with_restitution(0.0)).unwrap();
        let (radius, half, row) = (0.125, 0.125125, -0.21672285729705573);
        let ball = |x: f64, z: f64| Sphere::new(vec(x, radius, z), radius).with_restitution(0.0);
        let rack = [
            ball(0.0, 0.0),
            ball(-half, row),
            ball(half, row),
            ball(-2.0 * half, 2.0 * row),
            ball(0.0, 2.0 * row),
            ball(2.0 * half, 2.0 * row),
            ball(0.0, 1.0).with_velocity(vec(0.0, 0.0, -1.0)),
        ];
        for ball in rack {
            world.add_sphere(ball).unwrap();
        }
        for _ in 0..64 {
            world.step(1.0 / 64.0).unwrap();
            let at = world.spheres().positions().to_vec();
            let mirrored = |it: DVec3| vec(0.0 - it.x, it.y, it.z);
            for (one, other) in [(0, 0), (1, 2), (3, 5), (4, 4), (6, 6)] {
                assert_eq!(at[one], mirrored(at[other]), "{law:?}, {} s", world.time());
            }
        }
        assert!(world.spheres().positions()[1].z < row - 0.01, "{law:?}: nothing moved");
    }
}

#[test]
fn a_ball_that_rolls_along_a_wall_stays_out_of_it_for_any_time() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let rough = |it: Collider| it.with_friction(0.1).with_restitution(0.3);
    world.add_collider(rough(half_space(DVec3::Y, DVec3::ZERO))).unwrap();
    world.add_collider(rough(half_space(DVec3::NEG_Z, vec(0.0, 0.0, 1.0)))).unwrap();
    let radius = 0.1;
    let ball = Sphere::new(vec(0.0, radius, 0.0), radius).with_velocity(vec(1.0, 0.0, 1.0));
    let ball = world.add_sphere(ball.with_angular_velocity(vec(10.0, 0.0, -10.0))).unwrap();
    for _ in 0..200 {
        world.step(100.0).unwrap();
        let overlap = world.overlaps(0.0).iter().map(|it| it.depth).fold(0.0, f64::max);
        assert!(overlap < 1e-7 * radius, "{overlap} m at {} s", world.time());
    }
    assert!(!world.was_stepped());
    // It has rolled along all the time.
    let ball = world.sphere(ball).unwrap();
    assert!(ball.position.x > 1e4 && ball.position.z < 1.0, "{}", ball.position);
}

/// A ball between a wall at rest and a piston that comes towards it.
fn before_a_piston(frame: f64, seconds: f64) -> Sphere {
    let mut world = World::new(Settings::default().with_rule(Contact::default())).unwrap();
    world.add_collider(half_space(DVec3::X, DVec3::ZERO)).unwrap();
    let piston = half_space(DVec3::NEG_X, DVec3::X);
    world.add_collider(piston.moving(vec(-0.25, 0.0, 0.0), DVec3::ZERO)).unwrap();
    let ball = Sphere::new(vec(0.7, 0.0, 0.0), 0.02).with_velocity(vec(22.0, 0.0, 0.0));
    let id = world.add_sphere(ball).unwrap();
    while world.time() < seconds - 0.5 * frame {
        world.step(frame).unwrap();
        let overlap = world.overlaps(0.0).iter().map(|it| it.depth).fold(0.0, f64::max);
        assert!(overlap < 0.002, "{overlap} m at {} s", world.time());
    }
    world.sphere(id).unwrap()
}

#[test]
fn an_elastic_ball_does_not_stick_to_a_piston_in_long_frames() {
    let speed = |frame: f64, seconds: f64| before_a_piston(frame, seconds).velocity.x.abs();
    // While it comes to one of both in a sub-step, speeds are those of short frames.
    assert!((speed(0.0625, 1.5) - speed(0.0078125, 1.5)).abs() < 1e-9);
    // Later it is late, but never stops: each impact on the piston adds half a metre per second.
    let mut last = 22.0;
    for seconds in [1.0, 1.5, 2.0, 2.5, 3.0, 3.5] {
        let now = speed(0.0625, seconds);
        assert!(now >= last, "{now} m/s after {seconds} s");
        last = now;
    }
    assert!(last > 80.0, "{last} m/s");
}

#[test]
fn a_ball_that_a_closing_corner_pinches_is_not_flung_away() {
    // The three faces of a corner press it against a slanted wall: no velocity opens all four, and impulses without
    // bound would be those that rounding asks for.
    let mut numbers = Numbers(9);
    for number in 0..30 {
        let mut world = World::default();
        let speed = numbers.between(1.0, 30.0);
        let velocity = vec(0.0, 0.0, speed);
        for normal in DVec3::AXES {
            let wall = half_space(normal, DVec3::ZERO).with_restitution(0.5);
            world.add_collider(wall.moving(velocity, DVec3::ZERO)).unwrap();
        }
        let (x, y) = (numbers.between(0.01, 0.3), numbers.between(0.01, 0.3));
        let slanted = half_space(-vec(x, y, 1.0).normalize(), vec(0.0, 0.0, 2.0));
        world.add_collider(slanted.with_restitution(0.7)).unwrap();
        let ball = Sphere::new(vec(0.3, 0.35, 0.32), 0.16).with_restitution(0.7);
        let ball = world.add_sphere(ball).unwrap();
        let mut squeezed = 0;
        for _ in 0..200 {
            squeezed += world.step(0.02 / speed).unwrap().contact_account.squeezed;
            let fastest = world.sphere(ball).unwrap().velocity.length();
            // A wedge that closes drives it out as much faster as it is slender.
            let most = 4.0 * speed / x.min(y);
            assert!(fastest < most, "{number}: {fastest} m/s at {speed} m/s");
        }
        assert!(squeezed > 0, "{number}: not squeezed");
    }
}

#[test]
fn what_is_squeezed_is_counted() {
    for rule in [Rule::Exact(Exact::default()), Rule::Contact(Contact::default())] {
        let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
        for normal in [DVec3::X, DVec3::NEG_X] {
            let jaw = half_space(normal, -0.2 * normal).with_restitution(0.5);
            world.add_collider(jaw.moving(0.1 * normal, DVec3::ZERO)).unwrap();
        }
        world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
        let mut counts = [0; 2];
        for (count, until) in counts.iter_mut().zip([1.2, 2.0]) {
            while world.time() < until {
                *count += world.step(0.01).unwrap().contact_account.squeezed;
            }
        }
        // Until a fifth of the second after they touch they press it by a fifth of its radius.
        assert_eq!(counts[0], 0, "{rule:?}");
        assert!(counts[1] > 0, "{rule:?}");
    }
}
