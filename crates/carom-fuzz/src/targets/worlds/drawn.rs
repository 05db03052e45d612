//! Random descriptions of worlds.

use proptest::collection::vec;
use proptest::option::weighted;
use proptest::prelude::*;
use proptest::sample::select;

use super::meshes::mesh;
use super::vector::{HALF, Vector, scaled};

#[derive(Debug, Clone)]
pub struct Drawn {
    pub rule: &'static str,
    /// Whether balls are discs in a plane.
    pub is_flat: bool,
    /// Lines of the table `simulation` that set options of the rules.
    pub choices: Vec<&'static str>,
    pub around: Around,
    pub material: Material,
    /// Lines of the tables `forces`, one for each force.
    pub forces: Vec<String>,
    /// Whether boxes side by side make a floor, turned like the container.
    pub has_floor: bool,
    pub emitter: Option<Emitter>,
    pub obstacles: Vec<Obstacle>,
    pub balls: Vec<Ball>,
    /// Part of the room that the balls fill.
    pub crowding: f64,
    pub springs: Option<Springs>,
    /// Rate at which radii grow \[1/s\].
    pub growth: Option<f64>,
    pub fluid: Option<Fluid>,
}

/// A dense fluid in place of balls.
#[derive(Debug, Clone)]
pub struct Fluid {
    pub count: u32,
    pub packing_fraction: f64,
    /// Temperature k T \[J\].
    pub temperature: f64,
    pub seed: u32,
}

/// The enclosure of the balls.
#[derive(Debug, Clone)]
pub struct Around {
    pub kind: &'static str,
    /// Rotation of a container \[°\].
    pub turn: Vector,
    /// Velocity of a container and its content \[m/s\].
    pub velocity: Option<Vector>,
    /// Angular velocity of a container \[rad/s\].
    pub spin: Option<Vector>,
    /// Parts of the motion of a container, if it is not steady.
    pub parts: Vec<String>,
    /// Sides without a wall.
    pub open: &'static str,
    pub shear: Shear,
}

/// How a sheared box moves.
#[derive(Debug, Clone, Copy)]
pub struct Shear {
    /// Shear rate \[1/s\].
    pub rate: f64,
    /// Whether balls begin with velocities relative to the flow.
    pub is_relative: bool,
    /// Whether the box has no end along z.
    pub is_open: bool,
}

/// Materials of the bodies.
#[derive(Debug, Clone)]
pub struct Material {
    pub restitution: f64,
    /// Restitution law in place of a coefficient, as written in scene files.
    pub law: Option<&'static str>,
    /// Whether balls and walls have different materials, with coefficients for their pair.
    pub has_pair: bool,
    /// Restitution law of each two balls, as written in scene files.
    pub law_of_balls: Option<&'static str>,
    /// Non-additivity parameter of each two balls next to each other in the list, which are of two materials.
    pub non_additivity: Option<f64>,
    pub friction: Option<f64>,
    pub rolling: Option<f64>,
    pub spinning: Option<f64>,
    pub tangential: Option<f64>,
}

#[derive(Debug, Clone)]
pub struct Emitter {
    /// Period \[s\].
    pub period: f64,
    /// Number of spheres in all; with `ring`, at one time.
    pub count: u32,
    pub is_ring: bool,
    pub needs_room: bool,
}

/// Springs from each ball to the next, and from the first to the middle of the room.
#[derive(Debug, Clone)]
pub struct Springs {
    /// Stiffness, as a power of ten.
    pub stiffness: f64,
    pub damping: f64,
    pub only_pulls: bool,
    pub has_anchor: bool,
}

#[derive(Debug, Clone)]
pub struct Obstacle {
    /// As written in scene files.
    pub shape: String,
    pub position: Vector,
    pub turn: Vector,
    /// Velocity of an obstacle that moves \[m/s\].
    pub velocity: Option<Vector>,
    /// Angular velocity of an obstacle that turns \[rad/s\].
    pub spin: Option<Vector>,
    /// Parts of the motion, if it is not steady.
    pub parts: Vec<String>,
    pub is_trigger: bool,
    /// Speed that an impact on the obstacle adds \[m/s\].
    pub kick: Option<f64>,
    pub cushion: Option<f64>,
    /// Velocity of the material along the surface \[m/s\].
    pub belt: Option<[f64; 3]>,
}

#[derive(Debug, Clone)]
pub struct Ball {
    /// Radius, as a power of ten.
    pub radius: f64,
    pub mass: f64,
    pub velocity: Vector,
    /// Angular velocity at the start \[rad/s\]; `None` for a ball that does not turn.
    pub spin: Option<Vector>,
    pub inertia: f64,
    /// Place of the ball, or the direction in which it touches the ball before.
    pub place: Vector,
    pub touches: bool,
    /// Groups of the ball, and those that it collides with, among them the first, to which all
    /// other bodies belong.
    pub groups: Option<[u32; 2]>,
}

/// A vector in the cube from -1 to 1.
fn vector() -> impl Strategy<Value = Vector> {
    [-1.0..1.0, -1.0..1.0, -1.0..1.0f64]
}

fn vector_of(size: f64) -> impl Strategy<Value = Vector> {
    vector().prop_map(move |it| scaled(it, size))
}

pub fn drawn() -> impl Strategy<Value = Drawn> {
    let rule = prop_oneof![
        5 => Just("exact"), 3 => Just("contact"), 1 => Just("discrete"), 1 => Just("bisect")
    ];
    let rule = (rule, proptest::bool::weighted(0.1));
    let settings = (rule, choices(), around(), material(), forces());
    let emitter = weighted(0.1, emitter());
    let bodies = (
        proptest::bool::weighted(0.2),
        emitter,
        vec(obstacle(), 0..3),
        (vec(ball(), 0..14), select(&[1.0, 1.0, 0.4][..])),
        weighted(0.2, springs()),
        (weighted(0.04, 0.01..0.3), weighted(0.04, fluid())),
    );
    (settings, bodies).prop_map(|(settings, bodies)| {
        let ((rule, is_flat), choices, around, material, forces) = settings;
        let (has_floor, emitter, obstacles, (balls, crowding), springs, (growth, fluid)) = bodies;
        Drawn {
            rule,
            is_flat,
            choices,
            around,
            material,
            forces: forces.into_iter().collect(),
            has_floor,
            emitter,
            obstacles,
            balls,
            crowding,
            springs,
            growth,
            fluid,
        }
    })
}

/// Draws lines that set options.
fn choices() -> impl Strategy<Value = Vec<&'static str>> {
    let lines = [
        "spheres_collide = false",
        "combine_rule = \"minimum\"",
        "combine_rule = \"maximum\"",
        "combine_rule = \"average\"",
        "friction_combine_rule = \"maximum\"",
        "exact = { impact_law = \"sequential\" }",
        "exact = { impact_law = \"simultaneous\" }",
        "exact = { zone_budget = 2000 }",
        "pair_potential = { square-well = { depth = 0.3, range_ratio = 1.5 } }",
        "pair_potential = { square-well = { depth = -0.1, range_ratio = 1.2 } }",
        "pair_potential = { square-well = { depth = 2.0, range_ratio = 1.01 } }",
        "contact = { sub_steps = 3, sweeps = 5, sleep_speed = 0.0 }",
        "contact = { sleep_speed = 0.0 }",
        "contact = { converged = true }",
        "bisect = { integrator = \"runge-kutta-4\" }",
        "bisect = { integrator = \"velocity-verlet\", wind_back = \"all\" }",
        "discrete = { integrator = \"velocity-verlet\" }",
        "discrete = { integrator = \"explicit-euler\" }",
    ];
    let line = prop_oneof![2 => Just(None), 1 => select(lines.to_vec()).prop_map(Some)];
    let thermostat = weighted(0.08, select(&THERMOSTATS[..]));
    (line, thermostat).prop_map(|(line, thermostat)| line.into_iter().chain(thermostat).collect())
}

const THERMOSTATS: [&str; 3] = [
    "thermostat = { andersen = { frequency = 8.0, temperature = 0.5, seed = 4 } }",
    "thermostat = { rescale = { interval = 0.05, temperature = 0.5 } }",
    "thermostat = { white-noise = { interval = 0.03, strength = 0.5, seed = 4 } }",
];

fn around() -> impl Strategy<Value = Around> {
    let kind = prop_oneof![
        10 => Just("container"), 4 => Just("periodic"), 2 => Just("sheared"), 2 => Just("nothing"), 1 => Just("half-spaces")
    ];
    // Turned or not.
    let turn = prop_oneof![Just([0.0; 3]), vector_of(180.0)];
    let open = prop_oneof![8 => Just(""), 1 => Just("\"top\""), 1 => Just("[\"left\", \"front\"]")];
    let velocity = weighted(0.1, prop_oneof![vector_of(1.0), vector_of(30.0)]);
    let parts = prop_oneof![8 => Just(Vec::new()), 1 => vec(part(), 1..3)];
    let shear =
        (select(&[1.5, 1.5, -0.25, 12.0][..]), any::<bool>(), proptest::bool::weighted(0.2))
            .prop_map(|(rate, is_relative, is_open)| Shear { rate, is_relative, is_open });
    (kind, turn, velocity, weighted(0.05, vector_of(0.5)), parts, (open, shear)).prop_map(
        |(kind, turn, velocity, spin, parts, (open, shear))| Around {
            kind,
            turn,
            velocity,
            spin,
            parts,
            open,
            shear,
        },
    )
}

fn material() -> impl Strategy<Value = Material> {
    (
        select(&[1.0, 1.0, 0.95, 0.7, 0.3, 0.0][..]),
        weighted(0.1, select(&LAWS[..])),
        (
            proptest::bool::weighted(0.1),
            weighted(0.1, select(&LAWS[..])),
            weighted(0.1, select(&[-0.6, -0.1, 0.2, 0.7][..])),
        ),
        weighted(0.3, 0.01..1.0),
        weighted(0.3, 0.001..0.1),
        weighted(0.2, 0.001..0.1),
        weighted(0.2, 0.0..1.0),
    )
        .prop_map(|(restitution, law, pairs, friction, rolling, spinning, tangential)| {
            let (has_pair, law_of_balls, non_additivity) = pairs;
            Material {
                restitution,
                law,
                has_pair,
                law_of_balls,
                non_additivity,
                friction,
                rolling: rolling.filter(|_| friction.is_some()),
                spinning: spinning.filter(|_| friction.is_some()),
                tangential: tangential.filter(|_| friction.is_some()),
            }
        })
}

/// Restitution laws, as written in scene files.
const LAWS: [&str; 3] = [
    "power-law = { restitution = 0.9, speed = 0.5 }",
    "viscoelastic = { speed = 1e4 }",
    "cutoff = { restitution = 0.8, speed = 1e-3 }",
];

fn forces() -> impl Strategy<Value = Vec<String>> {
    let gravity = vector_of(10.0).prop_map(|it| format!("gravity = {{ acceleration = {it:?} }}"));
    let field = weighted(0.25, select(&FIELDS[..]));
    (weighted(0.6, gravity), field)
        .prop_map(|(gravity, field)| gravity.into_iter().chain(field.map(str::to_owned)).collect())
}

/// Other forces, none of which grows without bound.
const FIELDS: [&str; 10] = [
    "constant = { force = [0.3, -0.2, 0.1] }",
    "viscous-drag = { coefficient = 0.05 }",
    "wind = { velocity = [1.0, 0.5, -2.0], coefficient = 0.02 }",
    "quadratic-drag = { density = 1.2 }",
    "quadratic-drag = { density = 1.2, viscosity = 1.8e-5, wind = [1.0, 0.0, 2.0] }",
    "buoyancy = { density = 300.0, surface_height = 0.5 }",
    "buoyancy = { density = 300.0, surface_height = 0.25, gravity = [3.0, -4.0, 1.0] }",
    "vortex = { position = [0.3, 0.0, 0.2], axis = [0.5, 1.0, -0.25], circulation = 2.0, core_radius = 0.2, coefficient = 1e-4 }",
    "point-attractor = { position = [0.1, -0.6, 0.0], gravitational_parameter = 5.0, softening = 0.3 }",
    "mutual-gravity = { constant = 1e-4, softening = 0.3 }",
];

fn fluid() -> impl Strategy<Value = Fluid> {
    (1..40u32, 0.05..0.58, select(&[0.0, 1.0, 30.0][..]), any::<u32>()).prop_map(
        |(count, packing_fraction, temperature, seed)| Fluid {
            count,
            packing_fraction,
            temperature,
            seed,
        },
    )
}

fn emitter() -> impl Strategy<Value = Emitter> {
    (0.1..0.5, 1..4u32, any::<bool>(), proptest::bool::weighted(0.8)).prop_map(
        |(period, count, is_ring, needs_room)| Emitter { period, count, is_ring, needs_room },
    )
}

/// Flat shapes and spheres.
const FLAT: [&str; 6] = [
    "{ box = { size = [0.8, 0.5, 0.3] } }",
    "{ sphere = { radius = 0.4 } }",
    "{ box = { size = [1.5, 0.02, 1.5] } }",
    "{ rectangle = { size_x = 1.5, size_z = 0.75 } }",
    "{ container = { size = [1.5, 1.0, 1.25], open = \"top\" } }",
    "{ sphere = { radius = 0.02 } }",
];

/// Shapes of revolution.
const ROUND: [&str; 10] = [
    "{ cylinder = { radius = 0.3, height = 0.8 } }",
    "{ cone = { bottom_radius = 0.4, height = 0.7 } }",
    "{ cone = { bottom_radius = 0.4, top_radius = 0.15, height = 0.5 } }",
    "{ capsule = { radius = 0.15, length = 0.6 } }",
    "{ disc = { radius = 0.7 } }",
    "{ torus = { ring_radius = 0.5, tube_radius = 0.15 } }",
    "{ pipe = { radius = 0.5, length = 0.9 } }",
    "{ pipe = { radius = 0.6, length = 0.7, closed = \"bottom\" } }",
    "{ bowl = { radius = 0.7 } }",
    "{ funnel = { bottom_radius = 0.15, top_radius = 0.7, height = 0.6 } }",
];

/// A tetrahedron, two triangles with a valley between them, ground, and a track with a loop and a gap.
const MESHES: [&str; 4] = [
    "{ mesh = { vertices = [[0.5, -0.3, 0.0], [-0.3, -0.3, 0.4], [-0.3, -0.3, -0.4], [0.0, 0.5, 0.0]], \
     triangles = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]] } }",
    "{ mesh = { vertices = [[0.0, 0.0, -0.7], [0.0, 0.0, 0.7], [0.7, 0.3, 0.0], [-0.7, 0.2, 0.0]], \
     triangles = [[0, 1, 2], [1, 0, 3]] } }",
    "{ height-field = { size_x = 1.6, size_z = 1.6, heights = [[0.3, 0.2, 0.2, 0.3], [0.2, -0.1, 0.0, 0.2], \
     [0.2, 0.1, -0.1, 0.2], [0.3, 0.2, 0.2, 0.3]] } }",
    "{ track = { radius = 0.15, sides = 9, facet_degrees = 20.0, pitch_degrees = -20.0, pieces = [{ straight = { length = 0.3 } }, \
     { curve = { radius = 0.3, degrees = 90.0, bank_degrees = 20.0 } }, { gap = { length = 0.1, drop = 0.05 } }, \
     { bend = { radius = 0.2, degrees = 360.0, shift = 0.3 } }] } }",
];

fn obstacle() -> impl Strategy<Value = Obstacle> {
    let fixed =
        prop_oneof![3 => select(&FLAT[..]), 3 => select(&ROUND[..]), 1 => select(&MESHES[..])];
    let shape = prop_oneof![6 => fixed.prop_map(str::to_owned), 1 => mesh()];
    let velocity = weighted(0.15, prop_oneof![3 => vector(), 1 => vector_of(20.0)]);
    let place = (vector_of(0.5 * HALF), prop_oneof![1 => Just([0.0; 3]), 3 => vector_of(180.0)]);
    let spin = weighted(0.1, vector_of(3.0));
    let parts = prop_oneof![6 => Just(Vec::new()), 1 => vec(part(), 1..4)];
    let belt = weighted(0.15, vector_of(3.0));
    let thrown = (weighted(0.1, 0.1..5.0), weighted(0.2, 1.0..2.0));
    let answer = (proptest::bool::weighted(0.05), thrown, belt);
    (shape, place, velocity, (spin, parts), answer).prop_map(
        |(shape, (position, turn), velocity, (spin, parts), (is_trigger, thrown, belt))| Obstacle {
            shape,
            position,
            turn,
            velocity,
            spin,
            parts,
            is_trigger,
            kick: thrown.0,
            cushion: thrown.1,
            belt,
        },
    )
}

/// Draws a part of a motion, with speeds of some metres per second, seldom of up to a hundred.
fn part() -> impl Strategy<Value = String> {
    let axis = vector().prop_filter("has a direction", |it| it.iter().any(|part| part.abs() > 0.1));
    let frequency = (-1.0..1.5f64).prop_map(|it| 10f64.powf(it));
    let speed = prop_oneof![4 => Just(1.0), 1 => (0.0..1.2f64).prop_map(|it| 10f64.powf(it))];
    (0..5, axis, vector(), frequency, (-1.0..1.0, speed, 0.0..360.0)).prop_map(
        |(kind, axis, pivot, frequency, (size, speed, phase))| {
            let size = speed * size;
            let (amplitude, angle) = (size / frequency, 60.0 * size / frequency.max(1.0));
            let sine = format!("frequency = {frequency:?}, phase_degrees = {phase:?}");
            let axis = format!("axis = {axis:?}");
            match kind {
                0 => format!("{{ steady = {{ velocity = {:?} }} }}", scaled(pivot, speed)),
                1 => format!("{{ oscillate = {{ {axis}, amplitude = {amplitude:?}, {sine} }} }}"),
                2 => format!("{{ turn = {{ {axis}, pivot = {pivot:?}, rate = {:?} }} }}", 5.0 * size),
                3 => {
                    let times = [0.0, 0.25, 0.5, 1.0].map(|part| part / frequency);
                    let [x, y, z] = pivot.map(|it| it * amplitude);
                    let turned = format!("{{ {axis}, degrees = {angle:?} }}");
                    let unturned = "[0, 0, 0, 1]";
                    format!(
                        "{{ keyframes = {{ times = {times:?}, repeat = {}, pivot = {pivot:?}, \
                         positions = [[0, 0, 0], [{x:?}, {y:?}, {z:?}], [{y:?}, {z:?}, 0], \
                         [0, 0, 0]], rotations = [{unturned}, {turned}, {turned}, {unturned}] }} }}",
                        phase < 180.0
                    )
                }
                _ => format!(
                    "{{ swing = {{ {axis}, pivot = {pivot:?}, amplitude_degrees = {angle:?}, {sine} }} }}"
                ),
            }
        },
    )
}

fn ball() -> impl Strategy<Value = Ball> {
    let mass = prop_oneof![Just(0.0), -4.0..4.0];
    let speed = prop_oneof![4 => Just(5.0), 1 => Just(0.0), 1 => (1.0..3.0f64).prop_map(|it| 10f64.powf(it))];
    let turning = (weighted(0.3, vector_of(20.0)), select(&[0.4, 0.4, 2.0 / 3.0, 0.1][..]));
    let place = (vector(), proptest::bool::weighted(0.3));
    let groups = weighted(0.1, select(&[[1, 1], [2, 1], [2, 3], [3, 5]][..]));
    (-2.5..-0.3, mass, speed, vector(), turning, place, groups).prop_map(
        |(radius, mass, speed, direction, (spin, inertia), (place, touches), groups)| Ball {
            radius,
            mass,
            velocity: scaled(direction, speed),
            spin,
            inertia,
            place,
            touches,
            groups,
        },
    )
}

fn springs() -> impl Strategy<Value = Springs> {
    let damping = prop_oneof![Just(0.0), 0.0..0.05];
    (-1.0..2.0, damping, any::<bool>(), any::<bool>()).prop_map(
        |(stiffness, damping, only_pulls, has_anchor)| Springs {
            stiffness,
            damping,
            only_pulls,
            has_anchor,
        },
    )
}
