//! Draws the table into pixels: each solid by its distance from the middle of a pixel, which makes smooth edges, with a
//! soft shadow below.

use carom::{Collider, DVec3, Pose, Shape};

use crate::table::{Role, Table};

/// Left and upper edge of the picture on the table, and its size \[m\].
const CORNER: DVec3 = at(-0.275, 0.925);
const SIZE: DVec3 = at(0.6, 0.98);
/// Pixels for a metre.
const SCALE: f64 = 900.0;
pub const WIDTH: usize = (SIZE.x * SCALE) as usize;
pub const HEIGHT: usize = (SIZE.y * SCALE) as usize;
/// How far a shadow falls, and how far it fades \[m\].
const SHADOW: DVec3 = at(0.006, -0.008);
const SOFTNESS: f64 = 0.008;
/// Radius of the ball \[m\].
const BALL: f64 = 0.0135;

/// Red, green and blue in \[0, 1\].
type Color = DVec3;

/// The picture of a table.
pub struct Picture {
    pub pixels: Vec<u32>,
    /// What never moves, drawn once.
    ground: Vec<Color>,
    /// Brightness of each collider, which fades after a hit.
    lights: Vec<f64>,
}

impl Picture {
    pub fn new(table: &Table) -> Self {
        let mut ground: Vec<Color> = (0..WIDTH * HEIGHT).map(playfield).collect();
        let colliders: Vec<_> = table.world.colliders().map(|(_, it)| it).enumerate().collect();
        let still = |number| !matches!(Role::of(number), Role::Flipper | Role::Drain);
        // All shadows lie below all solids; a target lies in the table.
        for (_, collider) in colliders.iter().filter(|(it, solid)| still(*it) && !solid.trigger) {
            draw_shadow(&mut ground, collider);
        }
        for (number, collider) in colliders.iter().filter(|(number, _)| still(*number)) {
            draw_collider(&mut ground, collider, color_of(Role::of(*number)));
        }
        Self { pixels: vec![0; WIDTH * HEIGHT], ground, lights: vec![0.0; colliders.len()] }
    }

    /// Lights a bumper, slingshot or target.
    pub fn flash(&mut self, number: usize) {
        if matches!(Role::of(number), Role::Bumper | Role::Slingshot | Role::Target) {
            self.lights[number] = 1.0;
        }
    }

    /// Draws what moves or shines, with the ball at a place between two frames.
    pub fn draw(&mut self, table: &Table, ball: DVec3) {
        let mut picture = self.ground.clone();
        for (number, (_, collider)) in table.world.colliders().enumerate() {
            let (role, light) = (Role::of(number), self.lights[number]);
            if role == Role::Flipper {
                draw_shadow(&mut picture, collider);
            }
            if role == Role::Flipper || light > 0.01 {
                draw_collider(&mut picture, collider, color_of(role).lerp(Color::ONE, light));
            }
            self.lights[number] *= 0.85;
        }
        draw_plunger(&mut picture, table.pull());
        draw_ball(&mut picture, ball);
        for left in 0..table.balls() {
            let place = CORNER + at(0.02 + 0.024 * f64::from(left), -0.025);
            fill(
                &mut picture,
                place,
                0.008,
                |it| it.distance(place) - 0.008,
                |_| Color::splat(0.9),
            );
        }
        for (pixel, color) in self.pixels.iter_mut().zip(&picture) {
            let [r, g, b] = color.to_array().map(|it| (255.0 * it.clamp(0.0, 1.0)) as u32);
            *pixel = (r << 16) | (g << 8) | b;
        }
    }
}

/// A place in the plane of the table \[m\].
const fn at(x: f64, y: f64) -> DVec3 {
    DVec3::new(x, y, 0.0)
}

fn color_of(role: Role) -> Color {
    match role {
        Role::Bumper | Role::Slingshot => Color::new(0.85, 0.25, 0.2),
        Role::Target => Color::new(0.3, 0.6, 0.9),
        Role::Flipper => Color::new(0.95, 0.75, 0.25),
        Role::Drain | Role::Wall => Color::new(0.5, 0.32, 0.2),
    }
}

/// Returns the place on the table of a pixel.
fn place_of(pixel: usize) -> DVec3 {
    let [x, y] = [pixel % WIDTH, pixel / WIDTH].map(|it| (it as f64 + 0.5) / SCALE);
    CORNER + at(x, -y)
}

/// Returns the colour of the empty table: rings about the bumpers within the arch.
fn playfield(pixel: usize) -> Color {
    let place = place_of(pixel);
    let above = place - at(0.025, 0.625);
    let inside = if above.y > 0.0 { above.length() } else { above.x.abs() } < 0.28;
    if !inside || place.y < 0.0 {
        return Color::new(0.07, 0.05, 0.04);
    }
    let ground = Color::new(0.08, 0.12, 0.25).lerp(Color::new(0.17, 0.32, 0.6), place.y);
    let away = place.distance(at(0.0, 0.64));
    let ring = (away % 0.05 - 0.025).abs();
    let share = if away < 0.25 { 0.25 * (2.5 - ring * SCALE).clamp(0.0, 1.0) } else { 0.0 };
    ground.lerp(Color::new(0.95, 0.75, 0.25), share)
}

fn draw_shadow(picture: &mut [Color], collider: &Collider) {
    let Collider { shape, pose, .. } = collider;
    shade(picture, pose.position, reach(shape), |place| distance(shape, *pose, place));
}

fn draw_collider(picture: &mut [Color], collider: &Collider, color: Color) {
    let (shape, pose) = (&collider.shape, collider.pose);
    let center = pose.position;
    let is_round = matches!(shape, Shape::Sphere { .. });
    let lit = |place: DVec3| {
        let height = if is_round { place.distance(center) / reach(shape) } else { 0.0 };
        color * (1.1 - 0.5 * height * height)
    };
    fill(picture, center, reach(shape), |place| distance(shape, pose, place), lit);
}

fn draw_ball(picture: &mut [Color], center: DVec3) {
    let outside = |place: DVec3| place.distance(center) - BALL;
    shade(picture, center, BALL, outside);
    let shine = center + 0.4 * BALL * at(-1.0, 1.0);
    let lit = |place: DVec3| Color::splat(1.05 - 0.4 * place.distance(shine) / BALL);
    fill(picture, center, BALL, outside, lit);
}

fn draw_plunger(picture: &mut [Color], pull: f64) {
    let center = at(0.28, 0.01 - 0.035 * pull);
    let half = DVec3::new(0.006, 0.03, 1.0);
    let outside = |place: DVec3| ((place - center).abs() - half).max_element();
    fill(picture, center, 0.04, outside, |_| Color::new(0.75, 0.78, 0.82));
}

/// Returns the radius of a circle around the shape \[m\].
fn reach(shape: &Shape) -> f64 {
    match shape {
        Shape::Sphere { radius } => *radius,
        Shape::Box { size } => 0.5 * size.length(),
        Shape::Capsule { radius, length } => 0.5 * length + radius,
        Shape::Rectangle { size_x, .. } => 0.5 * size_x,
        _ => 0.0,
    }
}

/// Returns the distance of a place from a shape \[m\], negative inside.
fn distance(shape: &Shape, pose: Pose, place: DVec3) -> f64 {
    let local = (pose.rotation.inverse() * (place - pose.position));
    let from_box = |half: DVec3| {
        let outside = local.abs() - half;
        outside.max(DVec3::ZERO).length() + outside.max_element().min(0.0)
    };
    match shape {
        Shape::Sphere { radius } => local.length() - radius,
        Shape::Box { size } => from_box(0.5 * *size),
        Shape::Capsule { radius, length } => {
            let end = local.y.clamp(-0.5 * length, 0.5 * length);
            local.distance(at(0.0, end)) - radius
        }
        Shape::Rectangle { size_x, .. } => from_box(DVec3::new(0.5 * size_x, 0.0015, 1.0)),
        _ => f64::INFINITY,
    }
}

/// Darkens the shadow of what has this distance, within `reach` of `center`.
fn shade(picture: &mut [Color], center: DVec3, reach: f64, distance: impl Fn(DVec3) -> f64) {
    for pixel in pixels(center + SHADOW, reach + SOFTNESS) {
        let away = distance(place_of(pixel) - SHADOW);
        picture[pixel] *= 1.0 - 0.6 * (0.5 - away / SOFTNESS).clamp(0.0, 1.0);
    }
}

/// Fills what has this distance, within `reach` of `center`.
fn fill(
    picture: &mut [Color],
    center: DVec3,
    reach: f64,
    distance: impl Fn(DVec3) -> f64,
    color: impl Fn(DVec3) -> Color,
) {
    for pixel in pixels(center, reach + 1.0 / SCALE) {
        let place = place_of(pixel);
        let covered = (0.5 - distance(place) * SCALE).clamp(0.0, 1.0);
        picture[pixel] = picture[pixel].lerp(color(place), covered);
    }
}

/// Lists the pixels of the square about a circle.
fn pixels(center: DVec3, radius: f64) -> impl Iterator<Item = usize> {
    let [left, right] = [-radius, radius].map(|it| (center.x + it - CORNER.x) * SCALE);
    let [top, bottom] = [radius, -radius].map(|it| (CORNER.y - center.y - it) * SCALE);
    // Negative numbers become 0.
    let columns = left as usize..WIDTH.min(right as usize + 1);
    let rows = top as usize..HEIGHT.min(bottom as usize + 1);
    rows.flat_map(move |row| columns.clone().map(move |column| row * WIDTH + column))
}
