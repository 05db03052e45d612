//! A simulator of the course written from its text, with every known mistake and with any wrong
//! numbers. It shares no code with the rule that grades it: it works in the coordinates of each
//! collider, as the course's skeleton does, and knows mistakes by their names only.
#![allow(dead_code, reason = "each file of tests uses some of it")]

use carom_scene::Scene;
use carom_scene::scene::{Collider, Force, Shape};

pub type V = [f64; 3];

/// What is different from the course.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    /// Names of mistakes.
    pub slips: Vec<&'static str>,
    /// Names and values of wrong numbers.
    pub numbers: Vec<(&'static str, Vec<f64>)>,
    /// Whether states are rounded to single precision after each frame.
    pub single: bool,
}

impl Plan {
    fn has(&self, name: &str) -> bool {
        self.slips.contains(&name)
    }

    fn number(&self, name: &str, usual: f64) -> f64 {
        self.numbers.iter().find(|it| it.0 == name).map_or(usual, |it| it.1[0])
    }
}

/// A row of the table.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    pub frame: usize,
    pub time: f64,
    pub ball: usize,
    pub position: V,
    pub velocity: V,
}

struct Ball {
    number: usize,
    x: V,
    v: V,
    /// Velocity at the start of the frame before.
    late: V,
    /// Velocity after the last movement, before collisions.
    saved: V,
    /// Velocity at the emission.
    first: V,
    pile: V,
}

fn add(a: V, b: V) -> V {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn times(a: V, s: f64) -> V {
    a.map(|it| it * s)
}

fn dot(a: V, b: V) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn length(a: V) -> f64 {
    dot(a, a).sqrt()
}

/// Rotates a vector by a unit quaternion x, y, z, w.
fn turned([x, y, z, w]: [f64; 4], v: V) -> V {
    let t = times(cross([x, y, z], v), 2.0);
    add(add(v, times(t, w)), cross([x, y, z], t))
}

fn inverse([x, y, z, w]: [f64; 4]) -> [f64; 4] {
    [-x, -y, -z, w]
}

/// The rotation that uses the number of degrees as radians.
fn confused(q: [f64; 4]) -> [f64; 4] {
    let norm = q.iter().map(|it| it * it).sum::<f64>().sqrt();
    let [x, y, z, w] = q.map(|it| it / norm);
    let sine = length([x, y, z]);
    if sine == 0.0 {
        return q;
    }
    let half = sine.atan2(w).to_degrees();
    let axis = times([x, y, z], half.sin() / sine);
    [axis[0], axis[1], axis[2], half.cos()]
}

/// Runs a scene of the course with one emitter for a time [s].
pub fn simulate(scene: &Scene, plan: &Plan, seconds: f64) -> Vec<Row> {
    let emitter = &scene.emitters[0];
    let usual = plan.number("frame time", scene.simulation.frame_time);
    let frame = if plan.has("display-frames") { 1.0 / 60.0 } else { usual };
    let h = if plan.has("display-step") { 1.0 / 60.0 } else { plan.number("time step", frame) };
    let period = plan.number("period", emitter.period);
    let most = emitter.max_spheres.unwrap() as usize;
    let start = plan.numbers.iter().find(|it| it.0 == "velocity");
    let start: V = start.map_or([0.0; 3], |it| [it.1[0], it.1[1], it.1[2]]);
    let (mut balls, mut emitted, mut rows) = (Vec::<Ball>::new(), 0_usize, Vec::new());
    for number in 0..(seconds / frame).round() as usize {
        while emitted as f64 * period <= number as f64 * frame + 1e-9 {
            let x = emitter.position;
            let first = Ball {
                number: emitted,
                x,
                v: start,
                late: start,
                saved: start,
                first: start,
                pile: [0.0; 3],
            };
            if balls.len() < most {
                balls.push(first);
            } else if !plan.has("ring-stops") {
                let slot = if plan.has("ring-newest") { most - 1 } else { emitted % most };
                let v = if plan.has("ring-keeps-velocity") { balls[slot].v } else { start };
                balls[slot] = Ball { v, ..first };
            }
            emitted += 1;
        }
        for ball in &mut balls {
            if plan.has("collisions-before") {
                collide_all(ball, scene, plan);
                move_by(ball, scene, plan, h);
            } else {
                move_by(ball, scene, plan, h);
                collide_all(ball, scene, plan);
            }
            if plan.single {
                (ball.x, ball.v) =
                    (ball.x.map(|it| f64::from(it as f32)), ball.v.map(|it| f64::from(it as f32)));
            }
            let time = (number + 1) as f64 * frame;
            rows.push(Row {
                frame: number + 1,
                time,
                ball: ball.number,
                position: ball.x,
                velocity: ball.v,
            });
        }
    }
    rows
}

fn move_by(ball: &mut Ball, scene: &Scene, plan: &Plan, h: f64) {
    let mass = plan.number("mass", scene.emitters[0].sphere.mass.unwrap());
    let mut force = if plan.has("forces-not-cleared") { ball.pile } else { [0.0; 3] };
    for each in &scene.forces {
        match each {
            Force::Constant { force: own } => {
                force = add(force, times(*own, plan.number("force", 20.0) / 20.0));
            }
            Force::ViscousDrag { coefficient } => {
                let k = plan.number("drag", *coefficient);
                let (v, k) = match () {
                    () if plan.has("no-drag") => (ball.v, 0.0),
                    () if plan.has("drag-sign") => (ball.v, -k),
                    () if plan.has("drag-not-updated") => (ball.first, k),
                    () if plan.has("drag-late") => (ball.late, k),
                    () if plan.has("drag-quadratic") => (ball.v, k * length(ball.v)),
                    () => (ball.v, k),
                };
                force = add(force, times(v, -k));
            }
            _ => panic!("the course has no such force"),
        }
    }
    ball.pile = force;
    let acceleration = if plan.has("mass-ignored") { force } else { times(force, 1.0 / mass) };
    let before = ball.v;
    ball.v = add(before, times(acceleration, h));
    let with = match () {
        () if plan.has("explicit-euler") => before,
        () if plan.has("old-velocity") => ball.saved,
        () if plan.has("mean-velocity") => times(add(before, ball.v), 0.5),
        () => ball.v,
    };
    ball.x = add(ball.x, times(with, h));
    (ball.late, ball.saved) = (before, ball.v);
}

fn collide_all(ball: &mut Ball, scene: &Scene, plan: &Plan) {
    for (number, collider) in scene.colliders.iter().enumerate() {
        if collide(ball, scene, number, collider, plan) && plan.has("first-collider-only") {
            break;
        }
    }
}

/// `OnCollision` of the course: works in the collider's coordinates.
fn collide(
    ball: &mut Ball,
    scene: &Scene,
    number: usize,
    collider: &Collider,
    plan: &Plan,
) -> bool {
    let norm = collider.rotation.iter().map(|it| it * it).sum::<f64>().sqrt();
    let own = collider.rotation.map(|it| it / norm);
    let to_world = if plan.has("degrees-for-radians") { confused(own) } else { own };
    let to_local = inverse(to_world);
    let radius = plan.number("radius", 0.5 * scene.emitters[0].sphere.diameter.unwrap());
    let radius = match () {
        () if plan.has("radius-ignored") => 0.0,
        () if plan.has("diameter-for-radius") => 2.0 * radius,
        () => radius,
    };
    let local = turned(to_local, add(ball.x, times(collider.position, -1.0)));
    let (occurs, normal, on_top) = match collider.shape {
        Shape::Sphere { radius: other } => {
            let away = length(local);
            let normal = times(local, 1.0 / away);
            let on_top = times(normal, other + radius);
            (away < other + radius, normal, plan.has("on-top-of-spheres").then_some(on_top))
        }
        Shape::Rectangle { size_x, size_z } => {
            let (occurs, normal, nearest) = plane(local, [size_x, size_z], radius, plan);
            let on_top = add(nearest, times(normal, radius));
            (occurs, normal, (!plan.has("not-on-top")).then_some(on_top))
        }
        _ => panic!("the course has no such collider"),
    };
    let velocity = turned(to_local, ball.v);
    let along = dot(velocity, normal);
    if !occurs || along >= 0.0 && !plan.has("no-entering-test") {
        return false;
    }
    let e = plan.number("restitution", collider.restitution);
    let e = plan
        .number(["restitution 0", "restitution 1", "restitution 2", "restitution 3"][number], e);
    let after = if plan.has("normal-not-transformed") {
        // The local normal meets the velocity of the world.
        turned(to_local, bounced(ball.v, normal, e, plan))
    } else {
        bounced(velocity, normal, e, plan)
    };
    ball.v = if plan.has("velocity-not-transformed") { after } else { turned(to_world, after) };
    if let Some(place) = on_top {
        ball.x = add(turned(to_world, place), collider.position);
    }
    true
}

/// Contact with a plane: whether it occurs, its normal, and the nearest point of the plane.
fn plane(local: V, size: [f64; 2], radius: f64, plan: &Plan) -> (bool, V, V) {
    let [mut x, mut z] = size.map(|it| 0.5 * it);
    if plan.has("extent-ignored") {
        (x, z) = (f64::INFINITY, f64::INFINITY);
    } else if plan.has("extent-swapped") {
        (x, z) = (z, x);
    } else if plan.has("extent-doubled") {
        (x, z) = (2.0 * x, 2.0 * z);
    }
    let nearest = [local[0].max(-x).min(x), 0.0, local[2].max(-z).min(z)];
    let offset = add(local, times(nearest, -1.0));
    let is_inside = offset[0] == 0.0 && offset[2] == 0.0;
    let is_underneath = local[1] < 0.0;
    let away = length(offset);
    let normal = match () {
        () if is_inside || plan.has("edge-normal-of-plane") => [0.0, 1.0, 0.0],
        () if plan.has("edge-normal-from-centre") => times(local, 1.0 / length(local)),
        () => times(offset, 1.0 / away),
    };
    let may = (!is_underneath || plan.has("from-underneath"))
        && (is_inside || !plan.has("edges-ignored"));
    (may && away <= radius, normal, nearest)
}

fn bounced(v: V, n: V, e: f64, plan: &Plan) -> V {
    let along = dot(v, n);
    let taken = |share: f64| add(v, times(n, -share * along));
    let after = match () {
        () if plan.has("restitution-whole") => times(taken(2.0), e),
        () if plan.has("velocity-reversed") => times(v, -e),
        () if plan.has("restitution-sqrt") => taken(1.0 + e.sqrt()),
        () if plan.has("restitution-squared") => taken(1.0 + e * e),
        () if plan.has("restitution-ignored") => taken(2.0),
        () if plan.has("one-forgotten") => taken(e),
        () => taken(1.0 + e),
    };
    let left = plan.number("tangential", 1.0);
    let along = times(n, dot(after, n));
    if left == 1.0 { after } else { add(along, times(add(after, times(along, -1.0)), left)) }
}
