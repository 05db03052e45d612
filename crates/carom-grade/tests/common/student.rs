//! The course's program as a student writes it in Unity: single precision, left-handed coordinates,
//! and collisions in the coordinates of each collider. It shares no code with the rule that grades
//! it.

use std::fmt::Write;

use carom_scene::Scene;
use carom_scene::scene::{Force, Shape};

type V = [f32; 3];

/// Mistakes of this student.
#[derive(Debug, Clone, Copy, Default)]
pub struct Slips {
    pub explicit_euler: bool,
    pub velocity_stays_local: bool,
    pub width_for_height: bool,
    pub no_entering_test: bool,
    pub whole_restitution: bool,
}

struct Ball {
    position: V,
    velocity: V,
}

fn add(a: V, b: V) -> V {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn scaled(a: V, s: f32) -> V {
    a.map(|it| it * s)
}

fn dot(a: V, b: V) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Rotates a vector, as Unity's `Quaternion * Vector3`.
fn turned([x, y, z, w]: [f32; 4], v: V) -> V {
    let u = [x, y, z];
    let t = scaled(cross(u, v), 2.0);
    add(add(v, scaled(t, w)), cross(u, t))
}

fn single(v: [f64; 3]) -> V {
    // Left-handed: z is mirrored.
    [v[0] as f32, v[1] as f32, -v[2] as f32]
}

/// Writes the table of the student's recorder, in Unity's coordinates.
pub fn table(scene: &Scene, seconds: f64, slips: Slips) -> String {
    let emitter = &scene.emitters[0];
    let (mass, radius) =
        (emitter.sphere.mass.unwrap() as f32, 0.5 * emitter.sphere.diameter.unwrap() as f32);
    let dt = scene.simulation.frame_time as f32;
    let mut balls: Vec<Ball> = Vec::new();
    let (mut emitted, mut text) = (0_usize, "time,sphere,px,py,pz\n".to_owned());
    for frame in 0..(seconds / f64::from(dt)).round() as usize {
        if emitted as f64 * emitter.period <= frame as f64 * scene.simulation.frame_time + 1e-9 {
            let new = Ball { position: single(emitter.position), velocity: [0.0; 3] };
            let max = emitter.max_spheres.unwrap() as usize;
            if emitted < max {
                balls.push(new);
            } else {
                balls[emitted % max] = new;
            }
            emitted += 1;
        }
        for (number, ball) in balls.iter_mut().enumerate() {
            move_ball(ball, scene, (dt, mass), slips);
            for collider in &scene.colliders {
                collide(ball, collider, radius, slips);
            }
            let [x, y, z] = ball.position;
            writeln!(text, "{},Ball-{number},{x},{y},{z}", (frame + 1) as f32 * dt).unwrap();
        }
    }
    text
}

fn move_ball(ball: &mut Ball, scene: &Scene, (dt, mass): (f32, f32), slips: Slips) {
    let mut force = [0.0; 3];
    for each in &scene.forces {
        force = match each {
            Force::Constant { force: constant } => add(force, single(*constant)),
            Force::ViscousDrag { coefficient } => {
                add(force, scaled(ball.velocity, -(*coefficient as f32)))
            }
            _ => force,
        };
    }
    let old = ball.velocity;
    ball.velocity = add(old, scaled(force, dt / mass));
    let with = if slips.explicit_euler { old } else { ball.velocity };
    ball.position = add(ball.position, scaled(with, dt));
}

fn collide(ball: &mut Ball, collider: &carom_scene::scene::Collider, radius: f32, slips: Slips) {
    let [x, y, z, w] = collider.rotation.map(|it| it as f32);
    // The rotation in Unity's mirrored coordinates, and its inverse.
    let (to_world, to_local) = ([-x, -y, z, w], [x, y, -z, w]);
    let center = single(collider.position);
    let position = turned(to_local, add(ball.position, scaled(center, -1.0)));
    let velocity = turned(to_local, ball.velocity);
    let (occurs, normal, nearest) = match collider.shape {
        Shape::Sphere { radius: own } => {
            let length = dot(position, position).sqrt();
            (length < own as f32 + radius, scaled(position, 1.0 / length), None)
        }
        Shape::Rectangle { size_x, size_z } => {
            let (x, z) = (0.5 * size_x as f32, 0.5 * size_z as f32);
            let (x, z) = if slips.width_for_height { (z, x) } else { (x, z) };
            let nearest = [position[0].clamp(-x, x), 0.0, position[2].clamp(-z, z)];
            let offset = add(position, scaled(nearest, -1.0));
            let length = dot(offset, offset).sqrt();
            let is_inside = offset[0] == 0.0 && offset[2] == 0.0;
            let normal = if is_inside { [0.0, 1.0, 0.0] } else { scaled(offset, 1.0 / length) };
            (position[1] >= 0.0 && length <= radius, normal, Some(nearest))
        }
        _ => return,
    };
    let along = dot(velocity, normal);
    if !occurs || (along >= 0.0 && !slips.no_entering_test) {
        return;
    }
    let e = collider.restitution as f32;
    let after = if slips.whole_restitution {
        scaled(add(velocity, scaled(normal, -2.0 * along)), e)
    } else {
        add(velocity, scaled(normal, -(1.0 + e) * along))
    };
    ball.velocity = if slips.velocity_stays_local { after } else { turned(to_world, after) };
    if let Some(nearest) = nearest {
        let on_top = add(nearest, scaled(normal, radius));
        ball.position = add(turned(to_world, on_top), center);
    }
}
