//! Friction and spin under the rule `exact`: bounces and sliding, rolling, spinning and stopping
//! balls compared with closed forms; and shots of billiards.

use carom::{
    Collider, DVec3, Error, Exact, Friction, Gravity, Pose, Shape, Sphere, SphereId, World,
};

use super::claim::{Claim, Expected, Fault, Measured, Outcome, Tolerance};
use super::friction;
use super::setup::{FRAME, G, world};

const RADIUS: f64 = 0.03;
const ROUNDING: &str = "rounding of some events";
const CORIOLIS: &str = "Coriolis, Effets du jeu de billard (1835)";
const SHORT: &str = "what is shorter than a contact's duration has ended";

pub fn claims() -> Vec<Claim> {
    let mut claims = on_the_level();
    claims.extend(shots());
    claims.extend(inclines());
    claims.extend(curves());
    claims.extend(bounces());
    claims.extend(billiards());
    claims.into_iter().map(|claim| claim.about(Exact::default().into())).collect()
}

/// Claims about balls on a level floor.
fn on_the_level() -> Vec<Claim> {
    let (v, mu) = (3.0, 0.2);
    let rolls_at = 2.0 * v / (7.0 * mu * G);
    let slides = move |time: f64| roll(mu, DVec3::Y * -G, ball(v * DVec3::X, DVec3::ZERO), time);
    let (rolling, spinning) = (0.01, 0.04);
    let stops = 1.0 / (2.0 * 5.0 / 7.0 * rolling * G);
    vec![
        Claim::new(
            "exact: a sliding ball rolls with 5/7 of its speed [part of it]",
            Expected::value(5.0 / 7.0, CORIOLIS),
            Tolerance::relative(1e-12, ROUNDING),
            move |_| slides(rolls_at + 1.0)?.measure(|ball| ball.velocity.x / v),
        ),
        Claim::new(
            "exact: it rolls after 2 v/(7 mu g): slip then [m/s]",
            Expected::no_error(CORIOLIS),
            Tolerance::absolute(1e-12, ROUNDING),
            move |_| slides(rolls_at)?.measure(|ball| slip(ball).length()),
        ),
        Claim::new(
            "exact: just before, it still slides: slip a microsecond earlier [m/s]",
            Expected::value(3.5 * mu * G * 1e-6, CORIOLIS),
            Tolerance::relative(1e-8, "rounding of 3 m/s in a slip of 7e-6"),
            move |_| slides(rolls_at - 1e-6)?.measure(|ball| slip(ball).length()),
        ),
        Claim::new(
            "exact: and it slides for 12 v²/(49 mu g) [m]",
            Expected::value(12.0 * v * v / (49.0 * mu * G), CORIOLIS),
            Tolerance::relative(1e-12, ROUNDING),
            move |_| slides(rolls_at)?.measure(|ball| ball.position.x),
        ),
        Claim::new(
            "exact: rolling friction stops a ball after v²/(2 5/7 mu g) [m]",
            Expected::value(stops, "torque mu r N"),
            Tolerance::relative(1e-11, ROUNDING),
            move |_| {
                let rolling = Friction::sliding(0.5).with_rolling(rolling);
                let ball = ball(DVec3::X, -1.0 / RADIUS * DVec3::Z);
                roll(rolling, DVec3::Y * -G, ball, 60.0)?.measure(|ball| ball.position.x)
            },
        ),
        Claim::new(
            "exact: spinning friction slows a ball by 5/2 mu g/r [rad/s after 1 s]",
            Expected::value(80.0 - 2.5 * spinning * G / RADIUS, "torque mu r N"),
            Tolerance::relative(1e-12, ROUNDING),
            move |_| {
                let spinning = Friction::sliding(0.3).with_spinning(spinning);
                let ball = ball(DVec3::ZERO, 80.0 * DVec3::Y);
                roll(spinning, DVec3::Y * -G, ball, 1.0)?.measure(|ball| ball.angular_velocity.y)
            },
        ),
    ]
}

/// Claims about balls struck with spin.
fn shots() -> Vec<Claim> {
    let mu = 0.2;
    let draw = ball(DVec3::X, 150.0 * DVec3::Z);
    let masse = ball(1.5 * DVec3::X, DVec3::new(60.0, 25.0, 90.0));
    let bends_until = 2.0 * slip(&masse).length() / (7.0 * mu * G);
    let leaves = masse.velocity - 2.0 / 7.0 * slip(&masse);
    let bent = masse.position + 0.5 * bends_until * (masse.velocity + leaves);
    vec![
        Claim::new(
            "exact: a draw shot comes back with 5/7 v - 2/7 r w [m/s]",
            Expected::value(5.0 / 7.0 - 2.0 / 7.0 * RADIUS * 150.0, CORIOLIS),
            Tolerance::relative(1e-12, ROUNDING),
            move |_| roll(mu, DVec3::Y * -G, draw, 3.0)?.measure(|ball| ball.velocity.x),
        ),
        Claim::new(
            "exact: a masse shot goes along a parabola: error of its end [m]",
            Expected::no_error(CORIOLIS),
            Tolerance::absolute(1e-12, ROUNDING),
            move |_| {
                let shot = roll(mu, DVec3::Y * -G, masse, bends_until)?;
                shot.measure(|ball| (ball.position - bent).length())
            },
        ),
        Claim::new(
            "exact: then straight on with v - 2/7 of its slip: error [m/s]",
            Expected::no_error(CORIOLIS),
            Tolerance::absolute(1e-11, ROUNDING),
            move |_| {
                let shot = roll(mu, DVec3::Y * -G, masse, bends_until + 1.0)?;
                shot.measure(|ball| (ball.velocity - leaves).length())
            },
        ),
    ]
}

/// Claims about balls on inclines, in coordinates tilted with the incline.
fn inclines() -> Vec<Claim> {
    let mut claims = Vec::new();
    for (mu, expected) in [(0.5, 5.0 / 7.0), (0.16, 5.0 / 7.0), (0.1, 1.0 - 0.1 / libm::tan(0.5))] {
        claims.push(Claim::new(
            format!("exact: an incline of 0.5 rad, mu = {mu}: acceleration [part of g sin a]"),
            Expected::value(expected, "rolls while tan a <= 7/2 mu, slides else"),
            Tolerance::relative(1e-12, ROUNDING),
            move |_| {
                let (sine, cosine) = libm::sincos(0.5);
                let gravity = G * DVec3::new(sine, -cosine, 0.0);
                let down = roll(mu, gravity, ball(DVec3::ZERO, DVec3::ZERO), 2.0)?;
                down.measure(|ball| ball.velocity.x / (2.0 * G * sine))
            },
        ));
    }
    let (mu, pull) = (0.3, 2.0);
    let shot = ball(DVec3::new(-0.4, 0.0, 2.0), DVec3::new(10.0, 0.0, 5.0));
    let (s, loss) = (slip(&shot), 3.5 * mu * G);
    let rolls_at = (loss * s.length() + s.x * pull) / (loss * loss - pull * pull);
    let across = move |time: f64| roll(mu, DVec3::new(pull, -G, 0.0), shot, time);
    claims.push(Claim::new(
        "exact: sliding across an incline, |s|(c + p cos) falls steadily: slip at its end [m/s]",
        Expected::no_error("s' = p - c s/|s|"),
        Tolerance::absolute(1e-9, SHORT),
        move |_| across(rolls_at)?.measure(|ball| slip(ball).length()),
    ));
    let rolls = shot.velocity - 2.0 / 7.0 * s + 5.0 / 7.0 * pull * rolls_at * DVec3::X;
    claims.push(Claim::new(
        "exact: with the velocity of its rolling: error [m/s]",
        Expected::no_error("(v - 2/7 s)' = 5/7 p"),
        Tolerance::absolute(1e-9, SHORT),
        move |_| across(rolls_at)?.measure(|ball| (ball.velocity - rolls).length()),
    ));
    claims
}

/// Claims about a ball that rolls off a fixed sphere, and one that rolls over an edge.
fn curves() -> [Claim; 2] {
    let source = "conservation of energy; it leaves at cos = 10/17";
    let reason = "pieces of path of a thousandth of a radian";
    [
        Claim::new(
            "exact: a ball rolls off a fixed sphere: error of 7/10 v² = g R (1 - cos) [relative]",
            Expected::no_error(source),
            Tolerance::absolute(1e-6, reason),
            |_| dome(),
        ),
        Claim::new(
            "exact: a ball rolls over the edge of a table: energy lost or gained [relative]",
            Expected::no_error("rolling does no work"),
            Tolerance::absolute(1e-6, reason),
            |_| table(),
        ),
    ]
}

/// Largest error of the speed of a ball that rolls off a fixed sphere, without the last degrees,
/// where it slides.
fn dome() -> Outcome {
    let mut world = world(Exact::default().into())?;
    world.add_force(Gravity::new(-G * DVec3::Y))?;
    let fixed = Collider::new(Shape::Sphere { radius: 1.0 }, Pose::at(DVec3::ZERO));
    world.add_collider(fixed.with_restitution(0.0).with_friction(50.0))?;
    let (sine, cosine) = libm::sincos(0.05);
    let distance = 1.0 + RADIUS;
    let id = world.add_sphere(Sphere::new(distance * DVec3::new(sine, cosine, 0.0), RADIUS))?;
    let mut error = 0.0_f64;
    loop {
        world.step(FRAME / 8.0)?;
        let ball = world.sphere(id)?;
        let now = ball.position.y / distance;
        if now < 0.62 {
            return Ok(Measured::in_world(&world, error));
        }
        let kinetic = 0.7 * ball.velocity.dot(ball.velocity);
        let fallen = G * distance * (cosine - now);
        error = error.max((kinetic - fallen).abs() / (G * distance));
    }
}

/// Largest relative change of energy of a ball that rolls over the edge of a table.
fn table() -> Outcome {
    let mut world = world(Exact::default().into())?;
    world.add_force(Gravity::new(-G * DVec3::Y))?;
    let size = DVec3::new(1.0, 0.2, 1.0);
    let table = Collider::new(Shape::Box { size }, Pose::at(-0.1 * DVec3::Y));
    world.add_collider(table.with_restitution(0.0).with_friction(50.0))?;
    let (velocity, spin) = (DVec3::new(0.1, 0.0, 0.02), DVec3::new(0.02, 0.0, -0.1) / RADIUS);
    let start = ball(velocity, spin).with_position(DVec3::new(0.48, RADIUS, 0.0));
    let id = world.add_sphere(start)?;
    let energy = world.total_energy();
    let mut error = 0.0_f64;
    while world.sphere(id)?.position.y > 0.0 {
        world.step(FRAME / 8.0)?;
        error = error.max((world.total_energy() / energy - 1.0).abs());
    }
    Ok(Measured::in_world(&world, error))
}

/// Claims about balls that bounce with friction.
fn bounces() -> Vec<Claim> {
    let mut claims = vec![Claim::new(
        "exact: a superball turns its slip round, and keeps its energy [relative]",
        Expected::no_error("Garwin, Am. J. Phys. 37, 88 (1969)"),
        Tolerance::absolute(1e-14, ROUNDING),
        friction::superball,
    )];
    for (degrees, tangential) in [(45.0, 0.8178), (60.0, 0.8948), (75.0, 0.9512)] {
        claims.push(Claim::new(
            format!("exact: oblique bounce at {degrees} degrees: tangential restitution"),
            Expected::value(
                tangential,
                "Chung and Ooi, Granular Matter 13, 643 (2011), test 4; rigid balls",
            ),
            Tolerance::absolute(5e-5, "the published figure has four digits"),
            move |rule| friction::oblique(rule, degrees).map(|(tangential, _)| tangential),
        ));
    }
    claims
}

/// Claims about a shot computed by pooltool, and about a break.
fn billiards() -> Vec<Claim> {
    let source = "pooltool 0.3.3, elastic balls without friction, cloth 0.2, 0.01 and 0.0127";
    let reason = "it finds the time of the impact to 4e-11 m";
    let mut claims: Vec<Claim> = POOLTOOL
        .into_iter()
        .map(|event| {
            Claim::new(
                format!("exact: a draw shot, {}: error of places and velocities", event.name),
                Expected::no_error(source),
                Tolerance::absolute(2e-9, reason),
                move |_| draw_shot(&event),
            )
        })
        .collect();
    claims.push(Claim::new(
        "exact: a break of fifteen balls gains no energy in ten seconds [part of it]",
        Expected::no_error("friction and restitution only take"),
        Tolerance::absolute(1e-12, ROUNDING),
        |_| rack_break(),
    ));
    claims
}

/// Creates a ball that touches the floor.
fn ball(velocity: DVec3, angular_velocity: DVec3) -> Sphere {
    let ball = Sphere::new(RADIUS * DVec3::Y, RADIUS).with_velocity(velocity);
    ball.with_angular_velocity(angular_velocity)
}

/// Velocity of the ball's surface at its contact with the floor \[m/s\].
fn slip(ball: &Sphere) -> DVec3 {
    ball.velocity.with_y(0.0) + ball.angular_velocity.cross(-ball.radius * DVec3::Y)
}

/// Creates a world with a floor at height 0 and this gravity.
fn floor(friction: impl Into<Friction>, gravity: DVec3) -> Result<World, Error> {
    let mut world = world(Exact::default().into())?;
    world.add_force(Gravity::new(gravity))?;
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.0);
    world.add_collider(floor.with_friction(friction))?;
    Ok(world)
}

/// A ball after rolling, in its world.
struct Rolled {
    world: World,
    id: SphereId,
}

/// Simulates a ball on a floor for `time` \[s\].
fn roll(
    friction: impl Into<Friction>,
    gravity: DVec3,
    ball: Sphere,
    time: f64,
) -> Result<Rolled, Fault> {
    let mut world = floor(friction, gravity)?;
    let id = world.add_sphere(ball)?;
    go_to(&mut world, time)?;
    Ok(Rolled { world, id })
}

/// Advances a world to `time` \[s\], in whole frames and a shorter last one.
fn go_to(world: &mut World, time: f64) -> Result<(), Error> {
    while world.time() + FRAME < time {
        world.step(FRAME)?;
    }
    if world.time() < time {
        world.step(time - world.time())?;
    }
    Ok(())
}

impl Rolled {
    fn measure(self, quantity: impl Fn(&Sphere) -> f64) -> Outcome {
        let value = quantity(&self.world.sphere(self.id)?);
        Ok(Measured::in_world(&self.world, value))
    }
}

/// State of a draw shot at one of its events: two balls on a cloth.
struct PooltoolEvent {
    name: &'static str,
    /// Time \[s\].
    time: f64,
    /// Positions on the cloth \[m\] and velocities \[m/s\] of the cue ball and the object ball.
    state: [[[f64; 2]; 2]; 2],
}

const POOLTOOL: [PooltoolEvent; 3] = [
    PooltoolEvent {
        name: "the cue ball begins to roll",
        time: 0.34216071827042993,
        state: [
            [[0.498366183635847, 0.8425221945075312], [-0.04877187935676671, -0.04518212253350446]],
            [[0.5068392342333433, 0.920941836294232], [0.06348875847037837, 0.7228938882862351]],
        ],
    },
    PooltoolEvent {
        name: "the object ball begins to roll",
        time: 0.427896665400188,
        state: [
            [
                [0.4944491752961718, 0.8388934897476968],
                [-0.04260189024181224, -0.03946626315103053],
            ],
            [[0.5116516202880939, 0.9757364889361821], [0.048771879356766766, 0.5553249796763616]],
        ],
    },
    PooltoolEvent {
        name: "the cue ball stops",
        time: 1.0198771926505548,
        state: [
            [[0.4818394305725667, 0.8272118601133225], [0.0, 0.0]],
            [[0.539019762398005, 1.2873548469205256], [0.04369110160320078, 0.4974743731393453]],
        ],
    },
];

/// Largest difference of a position \[m\] or a velocity \[m/s\] from the state at an event.
///
/// The rolling friction of pooltool is a deceleration: 5/7 of the value that Carom uses.
fn draw_shot(event: &PooltoolEvent) -> Outcome {
    let radius = 0.028575;
    let cloth = Friction::sliding(0.2).with_rolling(0.01 * 7.0 / 5.0);
    let mut world = floor(cloth.with_spinning(radius * 4.0 / 9.0), -G * DVec3::Y)?;
    // The balls have no friction on each other.
    let on_cloth = |x: f64, y: f64| Sphere::new(DVec3::new(x, radius, -y), radius);
    let cue = on_cloth(0.5, 0.5).with_velocity(-1.4 * DVec3::Z);
    let balls = [cue.with_angular_velocity(60.0 * DVec3::X), on_cloth(0.505, 0.9)];
    let ids = [world.add_sphere(balls[0])?, world.add_sphere(balls[1])?];
    go_to(&mut world, event.time)?;
    let mut error = 0.0_f64;
    for (id, [place, velocity]) in ids.into_iter().zip(event.state) {
        let ball = world.sphere(id)?;
        let expected = [place, velocity].map(|[x, y]| DVec3::new(x, 0.0, -y));
        error = error.max((ball.position.with_y(0.0) - expected[0]).length());
        error = error.max((ball.velocity - expected[1]).length());
    }
    Ok(Measured::in_world(&world, error))
}

/// Largest relative gain of energy in a frame of a break, with a rack of touching balls.
fn rack_break() -> Outcome {
    let cloth = Friction::sliding(0.2).with_rolling(0.01).with_spinning(0.04);
    let mut world = floor(cloth, -G * DVec3::Y)?;
    let touching =
        |place: DVec3| Sphere::new(place, RADIUS).with_restitution(0.95).with_friction(0.05);
    for (row, place) in (0..5u32).flat_map(|row| (0..=row).map(move |place| (row, place))) {
        let (row, place) = (f64::from(row), f64::from(place));
        let z = RADIUS * (2.0 * place - row);
        world.add_sphere(touching(DVec3::new(1.0 + row * RADIUS * 3f64.sqrt(), RADIUS, z)))?;
    }
    let cue = touching(RADIUS * DVec3::Y).with_velocity(DVec3::new(9.0, 0.0, 0.02));
    world.add_sphere(cue.with_angular_velocity(DVec3::new(0.0, 30.0, -200.0)))?;
    let energy = |world: &World| world.kinetic_energy() + world.potential_energy();
    let (mut before, mut gained) = (energy(&world), 0.0_f64);
    while world.time() < 10.0 {
        world.step(FRAME)?;
        let after = energy(&world);
        gained = gained.max(after / before - 1.0);
        before = after;
    }
    Ok(Measured::in_world(&world, gained))
}
