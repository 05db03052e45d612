//! Worlds as scene files.

use carom::{DQuat, DVec3};

use super::drawn::{Drawn, Emitter, Fluid, Material, Obstacle, Shear, Springs};
use super::placed::{Placed, placed};
use super::vector::{HALF, Vector, sum};

/// Whose halves and thirds are numbers of few bits, so that frames of other lengths meet at the same times \[s\].
const FRAME_TIME: f64 = 3.0 / 256.0;

/// Returns the scene file of a world.
pub fn written(drawn: &Drawn) -> String {
    let coefficients = material(&drawn.material);
    let Material { has_pair, law_of_balls, non_additivity, .. } = drawn.material;
    let named = has_pair || law_of_balls.is_some() || non_additivity.is_some();
    let of = |name: &str| if named { format!("material = \"{name}\"\n") } else { String::new() };
    let balls = ["ball", "other"].map(|name| coefficients.clone() + &of(name));
    let material = coefficients + &of("wall");
    let placed = placed(&drawn.balls, drawn.crowding, non_additivity);
    let pieces = [
        if named { pairs(&drawn.material) } else { String::new() },
        simulation(drawn),
        drawn.forces.iter().map(|it| format!("[[forces]]\n{it}\n")).collect(),
        placed.iter().map(|it| ball(drawn, it, &balls[usize::from(it.is_other)])).collect(),
        drawn.fluid.as_ref().map_or(String::new(), |it| fluid(drawn, it, &balls[0])),
        drawn.springs.as_ref().map_or(String::new(), |it| springs(it, placed.len())),
        around(drawn, &material),
        if drawn.has_floor { floor(drawn, &material) } else { String::new() },
        drawn.emitter.as_ref().map_or(String::new(), |it| emitter(drawn, it)),
        drawn.obstacles.iter().map(|it| obstacle(drawn, it, &material)).collect(),
    ];
    pieces.concat()
}

/// Balls of one material or two and walls of another; pairs have coefficients that neither has.
fn pairs(material: &Material) -> String {
    let mut text = "[materials]\nball = {}\nother = {}\nwall = {}\n".to_owned();
    if material.has_pair {
        text += "[[material_pairs]]\nmaterials = [\"ball\", \"wall\"]\nrestitution = 0.6\nfriction = 0.2\n";
    }
    if let Some(law) = material.law_of_balls {
        text += &format!(
            "[[material_pairs]]\nmaterials = [\"ball\", \"ball\"]\nrestitution_law = {{ {law} }}\n"
        );
    }
    if let Some(non_additivity) = material.non_additivity {
        text += &format!(
            "[[material_pairs]]\nmaterials = [\"ball\", \"other\"]\nnon_additivity = {non_additivity:?}\n\
             friction = 0.0\nrolling_friction = 0.0\nspinning_friction = 0.0\n"
        );
    }
    text
}

fn material(material: &Material) -> String {
    let Material { restitution, law, friction, rolling, spinning, tangential, .. } = *material;
    let line = |name: &str, value: Option<f64>| {
        value.map_or(String::new(), |value| format!("{name} = {value:?}\n"))
    };
    [
        line("restitution", Some(restitution)),
        law.map_or(String::new(), |law| format!("restitution_law = {{ {law} }}\n")),
        line("friction", friction),
        line("rolling_friction", rolling),
        line("spinning_friction", spinning),
        line("tangential_restitution", tangential),
    ]
    .concat()
}

fn simulation(drawn: &Drawn) -> String {
    let rule = drawn.rule;
    let mut text = format!("[simulation]\nrule = \"{rule}\"\nframe_time = {FRAME_TIME:?}\n");
    if drawn.is_flat {
        text += "dimensions = 2\n";
    }
    text += &boundary(drawn);
    for choice in &drawn.choices {
        text += &format!("{choice}\n");
    }
    text
}

fn boundary(drawn: &Drawn) -> String {
    let Shear { rate, is_relative, is_open } = drawn.around.shear;
    let is_sheared = drawn.around.kind == "sheared";
    if !is_sheared && drawn.around.kind != "periodic" {
        return String::new();
    }
    let width = 2.0 * HALF;
    let across = if drawn.is_flat || is_sheared && is_open { f64::INFINITY } else { width };
    let shear = if is_sheared {
        format!(", shear_rate = {rate:?}, relative_velocities = {is_relative}")
    } else {
        String::new()
    };
    format!("boundary = {{ periodic = {{ size = [{width:?}, {width:?}, {across:?}]{shear} }} }}\n")
}

/// Returns the velocity that all bodies share, besides their own \[m/s\].
fn velocity_of_all(drawn: &Drawn) -> Vector {
    drawn.around.velocity.unwrap_or_default()
}

fn ball(drawn: &Drawn, placed: &Placed, material: &str) -> String {
    let Placed { position, radius, ball, .. } = placed;
    let (mass, velocity) = (10f64.powf(ball.mass), sum(ball.velocity, velocity_of_all(drawn)));
    let spin = ball.spin.map_or(String::new(), |it| format!("angular_velocity = {it:?}\n"));
    let growth =
        drawn.growth.map_or(String::new(), |it| format!("growth_speed = {:?}\n", it * radius));
    let groups = ball.groups.map_or(String::new(), |[groups, others]| {
        format!("groups = {groups}\ncollides_with = {others}\n")
    });
    format!(
        "[[spheres]]\nposition = {position:?}\nvelocity = {velocity:?}\nradius = {radius:?}\n\
         mass = {mass:?}\ninertia_factor = {:?}\n{spin}{growth}{groups}{material}",
        ball.inertia
    )
}

fn fluid(drawn: &Drawn, fluid: &Fluid, material: &str) -> String {
    let Fluid { count, packing_fraction, temperature, seed } = fluid;
    let corners = if drawn.around.kind == "container" {
        format!("min = {:?}\nmax = {:?}\n", [-HALF; 3], [HALF; 3])
    } else {
        String::new()
    };
    format!(
        "[[generators]]\n[generators.dense-fluid]\ncount = {count}\n\
         packing_fraction = {packing_fraction:?}\ntemperature = {temperature:?}\nseed = {seed}\n\
         {corners}[generators.dense-fluid.sphere]\n{material}"
    )
}

fn springs(springs: &Springs, balls: usize) -> String {
    let Springs { stiffness, damping, only_pulls, has_anchor } = springs;
    let stiffness = 10f64.powf(*stiffness);
    let to_middle =
        (*has_anchor && balls > 0).then(|| "sphere = 0\nanchor = [0.0, 0.0, 0.0]".to_owned());
    let along = (balls > 1).then(|| format!("chain = [0, {}]", balls - 1));
    let spring = |ends: String| {
        format!(
            "[[springs]]\n{ends}\nstiffness = {stiffness:?}\ndamping = {damping:?}\n\
             only_pulls = {only_pulls}\n"
        )
    };
    to_middle.into_iter().chain(along).map(spring).collect()
}

/// Returns the motion of a collider: its own, or the one that it shares with all others.
fn motion(drawn: &Drawn, velocity: Option<Vector>, spin: Option<Vector>) -> String {
    let velocity = sum(velocity.unwrap_or_default(), velocity_of_all(drawn));
    let lines = [("velocity", velocity), ("angular_velocity", spin.unwrap_or_default())];
    let moving = lines.into_iter().filter(|(_, it)| *it != [0.0; 3]);
    moving.map(|(name, it)| format!("{name} = {it:?}\n")).collect()
}

/// Returns a motion of parts, and of the velocity that all bodies share.
fn motion_of_parts(drawn: &Drawn, parts: &[String]) -> String {
    let along = format!("{{ steady = {{ velocity = {:?} }} }}", velocity_of_all(drawn));
    format!("motion = [{}, {along}]\n", parts.join(", "))
}

fn around(drawn: &Drawn, material: &str) -> String {
    let (around, width) = (&drawn.around, 2.0 * HALF);
    let motion = if around.parts.is_empty() {
        motion(drawn, None, around.spin)
    } else {
        motion_of_parts(drawn, &around.parts)
    };
    match around.kind {
        "container" => {
            let open = if around.open.is_empty() {
                String::new()
            } else {
                format!(", open = {}", around.open)
            };
            format!(
                "[[colliders]]\nshape = {{ container = {{ size = [{width:?}, {width:?}, {width:?}]{open} }} }}\n\
                 rotation = {{ euler_degrees = {:?} }}\n{motion}{material}",
                around.turn
            )
        }
        "half-spaces" => [[0.0, 1.0, 0.0], [0.6, 0.8, 0.0], [0.0, 0.3, -1.0]]
            .map(|normal: Vector| {
                let place = (-HALF * DVec3::from_array(normal).normalize()).to_array();
                format!(
                    "[[colliders]]\nshape = \"half-space\"\nposition = {place:?}\n\
                     rotation = {{ normal = {normal:?} }}\n{motion}{material}"
                )
            })
            .concat(),
        _ => String::new(),
    }
}

/// Width of a box of the floor \[m\].
const TILE: f64 = 0.4;
/// Height of the top of the floor in the container, before that is turned \[m\].
const FLOOR: f64 = -0.6;

/// Returns boxes side by side below the middle of the container, on which some balls come to rest.
fn floor(drawn: &Drawn, material: &str) -> String {
    let turn = drawn.around.turn;
    let motion = motion(drawn, None, None);
    let [x, y, z] = turn.map(f64::to_radians);
    let rotation =
        DQuat::from_rotation_y(y) * DQuat::from_rotation_x(x) * DQuat::from_rotation_z(z);
    let tile = |number: i32| {
        let center = DVec3::new(TILE * f64::from(number), FLOOR - 0.2, 0.0);
        let place = (rotation * center).to_array();
        format!(
            "[[colliders]]\nshape = {{ box = {{ size = [{TILE:?}, 0.4, 2.0] }} }}\n\
             position = {place:?}\nrotation = {{ euler_degrees = {turn:?} }}\n{motion}{material}"
        )
    };
    (-3..=3).map(tile).collect()
}

fn emitter(drawn: &Drawn, emitter: &Emitter) -> String {
    let Emitter { period, count, is_ring, needs_room } = emitter;
    let limit = if *is_ring { "max_spheres" } else { "count" };
    let restitution = drawn.material.restitution;
    let own = if drawn.is_flat { [0.0, 2.0, 0.0] } else { [0.0, 2.0, 1.0] };
    let velocity = sum(own, velocity_of_all(drawn));
    format!(
        "[[emitters]]\nperiod = {period:?}\n{limit} = {count}\nneeds_room = {needs_room}\n\
         sphere = {{ radius = 0.1, mass = 1.0, velocity = {velocity:?}, restitution = {restitution:?} }}\n"
    )
}

fn obstacle(drawn: &Drawn, obstacle: &Obstacle, material: &str) -> String {
    let Obstacle { shape, position, turn, velocity, spin, parts, is_trigger, kick, cushion, belt } =
        obstacle;
    let motion = if parts.is_empty() {
        motion(drawn, *velocity, *spin)
    } else {
        motion_of_parts(drawn, parts)
    };
    let trigger = if *is_trigger { "trigger = true\n" } else { "" };
    // Kicks make elastic balls faster without end, and their impacts ever more.
    let kick = kick.filter(|_| drawn.material.restitution < 1.0);
    let kick = kick.map_or(String::new(), |it| format!("kick = {it:?}\n"));
    let cushion = cushion.map_or(String::new(), |it| format!("cushion = {it:?}\n"));
    let belt = belt.map_or(String::new(), |it| format!("surface_velocity = {it:?}\n"));
    format!(
        "[[colliders]]\nshape = {shape}\nposition = {position:?}\n\
         rotation = {{ euler_degrees = {turn:?} }}\n{motion}{belt}{trigger}{kick}{cushion}{material}"
    )
}
