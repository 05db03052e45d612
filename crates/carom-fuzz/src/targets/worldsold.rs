//! Small worlds that are hard to step: radii and masses of very different sizes, spheres that touch from the
//! start, edges and corners, surfaces that move, speeds that cross everything within a frame.

use std::fmt::Write;

use carom::{DQuat, DVec3};
use carom_scene::Scene;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

use crate::case::text;
use crate::fault::{Fault, check_error};
use crate::laws;
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "worlds",
    about: "small worlds that are hard to step, under every rule, with the laws of each",
    campaign: 10_000,
    cases: || drawn().prop_map(|it| written(&it).into_bytes()).boxed(),
    check,
};

/// Half the width of what is around the spheres \[m\].
const HALF: f64 = 2.0;

type Vector = [f64; 3];

#[derive(Debug, Clone)]
struct Drawn {
    rule: &'static str,
    boundary: &'static str,
    restitution: f64,
    friction: Option<f64>,
    gravity: Option<Vector>,
    /// A force that has no closed form.
    field: Option<&'static str>,
    /// Whether boxes side by side make a floor, turned as the box is.
    has_floor: bool,
    /// The period of an emitter in the middle \[s\], perhaps of a world that is empty until then.
    emitter: Option<f64>,
    /// Turn of the box \[°\].
    turn: Vector,
    obstacles: Vec<Obstacle>,
    balls: Vec<Ball>,
    springs: Option<Springs>,
}

/// Springs from each ball to the next, and from the first to the middle.
#[derive(Debug, Clone)]
struct Springs {
    /// A power of ten.
    stiffness: f64,
    damping: f64,
    only_pulls: bool,
}

#[derive(Debug, Clone)]
struct Obstacle {
    shape: &'static str,
    position: Vector,
    turn: Vector,
    /// Its velocity \[m/s\], where it moves.
    velocity: Option<Vector>,
}

#[derive(Debug, Clone)]
struct Ball {
    /// Powers of ten.
    radius: f64,
    mass: f64,
    velocity: Vector,
    /// Where it is, or in which direction it touches the ball before.
    place: Vector,
    touches: bool,
}

/// A vector in the cube from -1 to 1.
fn vector() -> impl Strategy<Value = Vector> {
    [-1.0..1.0, -1.0..1.0, -1.0..1.0f64]
}

fn scaled(vector: Vector, factor: f64) -> Vector {
    vector.map(|it| factor * it)
}

fn drawn() -> impl Strategy<Value = Drawn> {
    let settings = (
        prop_oneof![5 => Just("exact"), 3 => Just("contact"), 1 => Just("discrete"), 1 => Just("bisect")],
        prop_oneof![5 => Just("container"), 2 => Just("periodic"), 1 => Just("none")],
        select(&[1.0, 1.0, 0.95, 0.7, 0.3, 0.0][..]),
        proptest::option::weighted(0.3, 0.01..1.0),
        proptest::option::weighted(0.6, vector().prop_map(|it| scaled(it, 10.0))),
        proptest::option::weighted(0.2, select(&FIELDS[..])),
        proptest::bool::weighted(0.2),
        proptest::option::weighted(0.1, 0.1..0.5),
        // Turned or not.
        prop_oneof![Just([0.0; 3]), vector().prop_map(|it| scaled(it, 180.0))],
    );
    let bodies =
        (vec(obstacle(), 0..3), vec(ball(), 0..12), proptest::option::weighted(0.2, springs()));
    (settings, bodies).prop_map(|(settings, (obstacles, balls, springs))| {
        let (rule, boundary, restitution, friction, gravity, field, has_floor, emitter, turn) =
            settings;
        // Under other rules stiff ones are not stable; and many impacts within a force tick heat light balls.
        let is_slow = balls.iter().all(|ball| ball.velocity.iter().all(|it| it.abs() < 10.0));
        let springs = springs.filter(|_| rule == "exact" && is_slow);
        // Held over a tick, drag throws back what is light and fast.
        let is_heavy = balls.iter().all(|ball| ball.mass >= 0.0);
        let field = field.filter(|_| is_slow && is_heavy);
        // There `exact` refuses what has no closed form, for it steps nothing.
        let friction = friction.filter(|_| boundary != "periodic");
        // What stands in the middle leaves no room.
        let obstacles = if emitter.is_some() { Vec::new() } else { obstacles };
        Drawn {
            rule,
            boundary,
            restitution,
            friction,
            gravity,
            field,
            has_floor,
            emitter,
            turn,
            obstacles,
            balls,
            springs,
        }
    })
}

/// Forces without a closed form. None grows without bound.
const FIELDS: [&str; 4] = [
    "quadratic-drag = { density = 1.2 }",
    "buoyancy = { density = 300.0, surface_height = 0.5 }",
    "vortex = { position = [0.3, 0.0, 0.2], circulation = 2.0, core_radius = 0.2, coefficient = 1e-4 }",
    "point-attractor = { position = [0.1, -0.6, 0.0], gravitational_parameter = 5.0, softening = 0.3 }",
];

fn obstacle() -> impl Strategy<Value = Obstacle> {
    let shapes = [
        "{ box = { size = [0.8, 0.5, 0.3] } }",
        "{ sphere = { radius = 0.4 } }",
        "{ box = { size = [1.5, 0.02, 1.5] } }",
    ];
    let velocity = proptest::option::weighted(0.2, vector());
    (select(shapes.to_vec()), vector(), vector(), velocity).prop_map(
        |(shape, position, turn, velocity)| {
            let (position, turn) = (scaled(position, 0.5 * HALF), scaled(turn, 180.0));
            Obstacle { shape, position, turn, velocity }
        },
    )
}

fn ball() -> impl Strategy<Value = Ball> {
    let mass = prop_oneof![Just(0.0), -4.0..4.0];
    let speed = prop_oneof![4 => Just(5.0), 1 => Just(0.0), 1 => (1.0..3.0f64).prop_map(|it| 10f64.powf(it))];
    (-2.5..-0.3, mass, speed, vector(), vector(), any::<bool>()).prop_map(
        |(radius, mass, speed, direction, place, touches)| Ball {
            radius,
            mass,
            velocity: scaled(direction, speed),
            place,
            touches,
        },
    )
}

fn springs() -> impl Strategy<Value = Springs> {
    (-1.0..2.0, prop_oneof![Just(0.0), 0.0..0.05], any::<bool>())
        .prop_map(|(stiffness, damping, only_pulls)| Springs { stiffness, damping, only_pulls })
}

/// Places of the balls with their radii, without those that overlap one before or leave the box.
fn placed(drawn: &Drawn) -> Vec<(Vector, f64, &Ball)> {
    let mut placed: Vec<(Vector, f64, &Ball)> = Vec::new();
    for ball in &drawn.balls {
        let radius = 10f64.powf(ball.radius);
        let length = ball.place.map(|it| it * it).iter().sum::<f64>().sqrt();
        let position = match placed.last() {
            Some(&(last, other, _)) if ball.touches && length > 0.1 => {
                let distance = (radius + other) / length;
                [0, 1, 2].map(|axis| last[axis] + distance * ball.place[axis])
            }
            _ => scaled(ball.place, HALF - radius),
        };
        // Whatever its turn, a ball in this sphere is in the box.
        let distance = |one: Vector, other: Vector| {
            [0, 1, 2].map(|axis| (one[axis] - other[axis]).powi(2)).iter().sum::<f64>().sqrt()
        };
        let is_inside = distance(position, [0.0; 3]) < HALF - radius;
        // Touching counts, overlapping by more than rounding does not.
        let is_free = placed
            .iter()
            .all(|&(other, size, _)| distance(position, other) > (radius + size) * (1.0 - 1e-14));
        if is_inside && is_free {
            placed.push((position, radius, ball));
        }
    }
    placed
}

/// The scene file of a world.
fn written(drawn: &Drawn) -> String {
    let Drawn { rule, boundary, restitution, friction, gravity, turn, obstacles, .. } = drawn;
    let friction = friction.map_or(String::new(), |it| format!("friction = {it:?}\n"));
    let (width, material) = (2.0 * HALF, format!("restitution = {restitution:?}\n{friction}"));
    let mut text = format!("[simulation]\nrule = \"{rule}\"\nframe_time = {FRAME_TIME:?}\n");
    let mut add = |piece: std::fmt::Arguments| {
        // A string takes whatever is written to it.
        let _ = text.write_fmt(piece);
    };
    if *boundary == "periodic" {
        add(format_args!(
            "boundary = {{ periodic = {{ size = [{width:?}, {width:?}, {width:?}] }} }}\n"
        ));
    }
    if let Some(acceleration) = gravity {
        add(format_args!("[[forces]]\ngravity = {{ acceleration = {acceleration:?} }}\n"));
    }
    if let Some(field) = drawn.field {
        add(format_args!("[[forces]]\n{field}\n"));
    }
    let placed = placed(drawn);
    for &(position, radius, ball) in &placed {
        let (mass, velocity) = (10f64.powf(ball.mass), ball.velocity);
        add(format_args!(
            "[[spheres]]\nposition = {position:?}\nvelocity = {velocity:?}\nradius = {radius:?}\n\
             mass = {mass:?}\n{material}"
        ));
    }
    if let Some(Springs { stiffness, damping, only_pulls }) = &drawn.springs {
        let stiffness = 10f64.powf(*stiffness);
        let to_middle =
            (!placed.is_empty()).then(|| "sphere = 0\nanchor = [0.0, 0.0, 0.0]".to_owned());
        let along = (placed.len() > 1).then(|| format!("chain = [0, {}]", placed.len() - 1));
        for ends in to_middle.into_iter().chain(along) {
            add(format_args!(
                "[[springs]]\n{ends}\nstiffness = {stiffness:?}\ndamping = {damping:?}\n\
                 only_pulls = {only_pulls}\n"
            ));
        }
    }
    if *boundary == "container" {
        add(format_args!(
            "[[colliders]]\nshape = {{ container = {{ size = [{width:?}, {width:?}, {width:?}] }} }}\n\
             rotation = {{ euler_degrees = {turn:?} }}\n{material}"
        ));
    }
    if drawn.has_floor {
        // Below the balls that are in the middle of the box, and on which some come to lie.
        for place in floor_places(*turn) {
            add(format_args!(
                "[[colliders]]\nshape = {{ box = {{ size = [{TILE:?}, 0.4, 2.0] }} }}\n\
                 position = {place:?}\nrotation = {{ euler_degrees = {turn:?} }}\n{material}"
            ));
        }
    }
    if let Some(period) = drawn.emitter {
        add(format_args!(
            "[[emitters]]\nperiod = {period:?}\ncount = 3\nneeds_room = true\nsphere = {{ radius = 0.1, \
             mass = 1.0, velocity = [0.0, 2.0, 1.0], restitution = {restitution:?} }}\n"
        ));
    }
    for Obstacle { shape, position, turn, velocity } in obstacles {
        let velocity = velocity.map_or(String::new(), |it| format!("velocity = {it:?}\n"));
        add(format_args!(
            "[[colliders]]\nshape = {shape}\nposition = {position:?}\nrotation = {{ euler_degrees = {turn:?} }}\n\
             {velocity}{material}"
        ));
    }
    text
}

/// Width of a box of the floor \[m\].
const TILE: f64 = 0.4;
/// Height of its top in the box, before that is turned \[m\].
const FLOOR: f64 = -0.6;

/// Centres of the boxes of a floor \[m\], turned by these angles about x, y and z \[°\].
fn floor_places(turn: Vector) -> impl Iterator<Item = Vector> {
    let [x, y, z] = turn.map(|angle| angle.to_radians());
    let rotation =
        DQuat::from_rotation_y(y) * DQuat::from_rotation_x(x) * DQuat::from_rotation_z(z);
    let center = move |number: i32| DVec3::new(TILE * f64::from(number), FLOOR - 0.2, 0.0);
    (-3..=3).map(move |number| (rotation * center(number)).to_array())
}

/// A power of two, so that frames of other lengths meet at the same times \[s\].
const FRAME_TIME: f64 = 1.0 / 64.0;

fn check(case: &[u8]) -> Result<Answer, Fault> {
    match Scene::from_toml(&text(case), "world.toml") {
        Ok(scene) => laws::check(&scene).map(|()| Answer::Accepted),
        Err(error) => check_error(&error.to_string()).map(|()| Answer::Refused),
    }
}
