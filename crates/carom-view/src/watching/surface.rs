//! The picked surface: found under the pointer, and dragged with Ctrl.

use carom::{Collider, ColliderId, DVec3, Pose, QueryFilter, Shape, World};
use carom_session::{Command, Edit, View};
use egui::{CursorIcon, PointerButton, Pos2, Response, Ui};

use super::Watching;
use super::held_surface::HeldSurface;
use super::sides::side_of;
use crate::projection::Projection;

/// Distance up to which a surface is found, in nearest distances drawn.
const FARTHEST: f64 = 1e7;

impl Watching {
    /// Handles a drag of the picked surface; returns whether the drag is one.
    pub(super) fn drag_surface(&mut self, ui: &Ui, response: &Response, side: usize) -> bool {
        let Some(projection) = self.projection(response.rect) else { return false };
        if self.held_surface.is_none() && response.drag_started_by(PointerButton::Primary) {
            let (pressed, is_meant) =
                ui.input(|input| (input.pointer.press_origin(), input.modifiers.command));
            let pressed = pressed.filter(|_| is_meant);
            self.held_surface =
                pressed.and_then(|place| self.taken_surface(&projection, place, side));
        }
        let held = self.held_surface.filter(|held| held.side == side);
        let Some(mut held) = held else { return false };
        if !response.dragged_by(PointerButton::Primary) {
            self.held_surface = None;
            return false;
        }
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
        let pointer = response.interact_pointer_pos();
        let place = pointer.and_then(|it| held.position_on(ray(&projection, it)));
        if let Some(position) = place.filter(|it| *it != held.position) {
            let edit = Edit::ColliderPose(held.id, Pose { position, ..held.from });
            let command = if held.has_moved { Command::EditFurther } else { Command::Edit };
            self.commands.push(command(edit));
            (held.position, held.has_moved) = (position, true);
        }
        self.held_surface = Some(held);
        true
    }

    /// Takes the picked surface into the hand if it is at this place on the screen.
    fn taken_surface(
        &self,
        projection: &Projection,
        place: Pos2,
        side: usize,
    ) -> Option<HeldSurface> {
        let view = side_of(self.driver.view(), side);
        let (id, point) = surface_at(view, projection.camera.near, ray(projection, place))?;
        let index = view.setup.colliders.iter().position(|it| it.0 == id)?;
        let from = view.poses[index];
        let normal = projection.ray(projection.rect.center());
        let held = HeldSurface {
            id,
            from,
            point,
            normal,
            position: from.position,
            has_moved: false,
            side,
        };
        Some(held).filter(|_| self.surface == Some(id))
    }
}

/// Returns origin \[m\] and direction of the ray through a place on the screen.
fn ray(projection: &Projection, place: Pos2) -> [DVec3; 2] {
    [projection.camera.position, projection.ray(place)]
}

/// Returns the first surface that deflects on a ray (origin, unit vector), and where the ray meets it \[m\]; `near`
/// \[m\] is the nearest distance drawn.
pub(super) fn surface_at(
    view: &View,
    near: f64,
    [origin, direction]: [DVec3; 2],
) -> Option<(ColliderId, DVec3)> {
    let way = FARTHEST * near * direction;
    let mut first: Option<(f64, ColliderId, DVec3)> = None;
    for ((id, collider), pose) in view.setup.colliders.iter().zip(&view.poses) {
        if !collider.visible || collider.trigger {
            continue;
        }
        // A mesh that cannot be made is in no world.
        let Ok(shape) = collider.shape.physical() else { continue };
        if !may_meet(&shape, *pose, [origin, direction]) {
            continue;
        }
        let mut alone = World::default();
        let is_there = alone.add_collider(Collider::new(shape, *pose)).is_ok();
        let hit = alone.cast_ray(origin, way, &QueryFilter::default()).ok().flatten();
        let Some(hit) = hit.filter(|_| is_there) else { continue };
        if first.is_none_or(|(fraction, ..)| hit.fraction < fraction) {
            first = Some((hit.fraction, *id, hit.point));
        }
    }
    first.map(|(_, id, point)| (id, point))
}

/// Returns whether a ray comes near enough to a mesh to meet it; other shapes are cheap to try.
fn may_meet(shape: &Shape, pose: Pose, [origin, direction]: [DVec3; 2]) -> bool {
    let Shape::Mesh(mesh) = shape else { return true };
    let [min, max] = mesh.bounds();
    let center = pose.position + pose.rotation.normalize() * (0.5 * (min + max));
    let to_center = center - origin;
    let miss = (to_center - to_center.dot(direction) * direction).length();
    miss <= 0.501 * (max - min).length()
}
