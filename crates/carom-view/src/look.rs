//! Turns the view of a session into a drawing.

use carom::{ColliderId, DQuat, DVec3, SphereId};
use carom_render::{Arrow, Ball, Body, Drawing, Light, Pattern, add_surroundings, spring_line};
use carom_scene::scene::{self, Color, Finish};
use carom_scene::{Coat, Palette};
use carom_session::View;

use serde::{Deserialize, Serialize};

use crate::contact_forces;

/// Marks drawn besides spheres and surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Marks {
    /// Velocities as arrows.
    pub velocities: bool,
    /// Recent contacts with their normals.
    pub contacts: bool,
    /// Forces of persistent contacts as arrows.
    pub forces: bool,
    /// Simulated time in which a sphere travels the length of its arrow \[s\].
    pub velocity_scale: f64,
}

impl Default for Marks {
    fn default() -> Self {
        Self { velocities: false, contacts: false, forces: false, velocity_scale: 0.2 }
    }
}

/// How a view is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawOptions {
    /// Marks.
    pub marks: Marks,
    /// Whether the sky is dark.
    pub dark: bool,
    /// Part of the way from the previous to the present positions, in \[0, 1\].
    pub blend: f64,
    /// The picked surface.
    pub picked: Option<ColliderId>,
}

/// Colour of triggers that have none.
const TRIGGER: Color = [0.95, 0.76, 0.20];
const VELOCITY: Color = [0.13, 0.55, 0.33];
/// Colour that a picked surface is mixed with, and its part.
const PICKED: (Color, f64) = ([0.20, 0.55, 0.95], 0.5);
const CONTACT: Color = [0.93, 0.26, 0.21];

/// Length of the normal of a contact, in radii of the sphere.
const NORMAL_LENGTH: f64 = 1.5;

/// Replaces a drawing by that of a view.
pub fn draw(view: &View, look: &DrawOptions, drawing: &mut Drawing) {
    drawing.clear();
    let light = Light::of_scene(&view.scene);
    drawing.light = if look.dark { light.at_dusk() } else { light };
    add_colliders(view, look.picked, drawing);
    add_spheres(view, look, drawing);
    add_springs(view, look, drawing);
    let forces = view.setup.forces.iter().map(|(_, force)| force);
    add_surroundings(forces, &bodies(view, look.blend), drawing);
    if look.marks.contacts {
        add_contacts(view, drawing);
    }
    if look.marks.forces {
        contact_forces::add(view, look.blend, drawing);
    }
}

/// Returns the position at which a sphere is drawn \[m\].
pub fn place(view: &View, index: usize, blend: f64) -> DVec3 {
    let (before, now) = (view.spheres.previous_positions[index], view.spheres.positions[index]);
    before.lerp(now, blend)
}

/// Returns the colour of a collider of the scene.
fn collider_color(collider: &scene::Collider, colors: Option<&scene::Colors>) -> Color {
    let default = if collider.trigger { TRIGGER } else { Palette::COLLIDER };
    let of_scene = colors.and_then(|colors| colors.colliders).unwrap_or(default);
    collider.color.unwrap_or(of_scene)
}

fn add_colliders(view: &View, picked: Option<ColliderId>, drawing: &mut Drawing) {
    let colors = view.scene.colors.as_ref();
    for ((id, collider), pose) in view.setup.colliders.iter().zip(&view.poses) {
        if !collider.visible {
            continue;
        }
        let plain = collider_color(collider, colors);
        let color = if picked == Some(*id) { picked_color(plain) } else { plain };
        let coat = Coat { color, finish: collider.finish };
        // A mesh that cannot be made is in no world.
        let Ok(shape) = collider.shape.physical() else { continue };
        drawing.add_collider(shape, *pose, coat, collider.trigger);
    }
}

/// Returns the colour of a surface while it is picked.
fn picked_color(plain: Color) -> Color {
    let (color, part) = PICKED;
    std::array::from_fn(|it| plain[it] + part * (color[it] - plain[it]))
}

/// Returns the colour of a sphere.
fn sphere_color(view: &View, index: usize) -> Color {
    let of_scene = view.scene.colors.as_ref().and_then(|colors| colors.spheres);
    view.spheres.paints[index].color.or(of_scene).unwrap_or(Palette::SPHERE)
}

/// Returns the spheres as bodies that may have orbits.
fn bodies(view: &View, blend: f64) -> Vec<Body> {
    let spheres = &view.spheres;
    let body = |index: usize| Body {
        position: place(view, index, blend),
        velocity: spheres.velocities[index],
        mass: spheres.masses[index],
        color: sphere_color(view, index),
    };
    (0..spheres.ids.len()).map(body).collect()
}

fn add_spheres(view: &View, look: &DrawOptions, drawing: &mut Drawing) {
    let spheres = &view.spheres;
    for i in 0..spheres.ids.len() {
        let center = place(view, i, look.blend);
        let coat = Coat { color: sphere_color(view, i), finish: spheres.paints[i].finish };
        let orientation = spheres.orientation(i, look.blend);
        drawing.balls.push(Ball::from_sphere(center, spheres.radii[i], coat, orientation));
        if look.marks.velocities {
            let way = look.marks.velocity_scale * spheres.velocities[i];
            let Some(ahead) = way.try_normalize() else { continue };
            let start = center + ahead * spheres.radii[i];
            drawing.arrows.push(Arrow {
                start,
                end: start + way,
                color: VELOCITY,
                width: 2.5,
                head: true,
                in_front: false,
            });
        }
    }
}

fn add_springs(view: &View, look: &DrawOptions, drawing: &mut Drawing) {
    let center = |id| Some(place(view, view.spheres.index_of(id)?, look.blend));
    let boundary = view.setup.simulation.boundary.into();
    let lines = view.springs.iter();
    let lines = lines.filter_map(|(_, spring)| spring_line(spring, boundary, center));
    drawing.arrows.extend(lines);
}

fn add_contacts(view: &View, drawing: &mut Drawing) {
    for impact in view.marks() {
        let radius = radius_of(view, impact.between);
        let (point, normal) = (impact.point, impact.normal);
        let end = point + normal * NORMAL_LENGTH * radius;
        drawing.arrows.push(Arrow {
            start: point,
            end,
            color: CONTACT,
            width: 2.0,
            head: true,
            in_front: false,
        });
        drawing.balls.push(Ball {
            center: point,
            radius: 0.12 * radius,
            color: CONTACT,
            rotation: DQuat::IDENTITY,
            pattern: Pattern::Glowing,
            finish: Finish::default(),
        });
    }
}

/// Returns the radius of body 2 of an impact \[m\], or 0 if it no longer exists.
fn radius_of(view: &View, between: carom::BodyPair) -> f64 {
    let sphere: SphereId = match between {
        carom::BodyPair::Spheres(_, sphere) => sphere,
        carom::BodyPair::Collider { sphere, .. } => sphere,
    };
    view.spheres.index_of(sphere).map_or(0.0, |index| view.spheres.radii[index])
}

/// Returns the first sphere on a ray from `origin` along `direction` (unit vector), as drawn.
pub fn sphere_at(view: &View, blend: f64, origin: DVec3, direction: DVec3) -> Option<SphereId> {
    let mut first = (f64::INFINITY, None);
    for (i, id) in view.spheres.ids.iter().enumerate() {
        let to_center = place(view, i, blend) - origin;
        let along = to_center.dot(direction);
        let miss = (to_center - along * direction).length();
        if along > 0.0 && miss < view.spheres.radii[i] && along < first.0 {
            first = (along, Some(*id));
        }
    }
    first.1
}

#[cfg(test)]
mod tests {
    use carom::DQuat;
    use carom_scene::Scene;
    use carom_session::{Edit, Session};

    use super::*;

    #[test]
    fn spheres_with_spin_are_banded_and_turn_between_two_frames() {
        let mut session = Session::new(Scene::new("spin")).unwrap();
        let mut ball = |angular_velocity| {
            let sphere =
                carom::Sphere::new(DVec3::ZERO, 1.0).with_angular_velocity(angular_velocity);
            session.edit(Edit::Throw { sphere: Box::new(sphere), color: None }).unwrap();
            session.step().unwrap();
            let mut view = View::default();
            session.fill(&mut view);
            let look =
                DrawOptions { marks: Marks::default(), dark: false, blend: 0.5, picked: None };
            let mut drawing = Drawing::default();
            draw(&view, &look, &mut drawing);
            let half_frame = 0.5 * session.frame_time();
            session.edit(Edit::RemoveSphere(view.spheres.ids[0])).unwrap();
            (drawing.balls[0], half_frame)
        };
        let (plain, _) = ball(DVec3::ZERO);
        assert_eq!((plain.pattern, plain.rotation), (Pattern::Plain, DQuat::IDENTITY));
        let (banded, time) = ball(DVec3::X);
        assert_eq!(banded.pattern, Pattern::Banded);
        // Zero up to the rounding of a cosine.
        assert!(banded.rotation.angle_between(DQuat::from_rotation_x(time)) < 1e-6);
    }
}
