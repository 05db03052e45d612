//! Mouse and fingers in the picture of a scene.

use carom::{DVec3, Sphere, SphereId};
use carom_session::{Command, Edit};
use egui::{CursorIcon, Modifiers, PointerButton, Pos2, Rect, Response, Ui};

use super::Watching;
use super::grab::Grab;
use super::sides::side_of;
use super::surface::surface_at;
use crate::inspector::Throw;
use crate::look;
use crate::orbit::{Orbit, zoom_asked};
use crate::projection::Projection;

/// Distance from a ball within which the pointer takes it, in points.
const REACH: f32 = 8.0;

impl Watching {
    /// Handles mouse and fingers in the picture.
    pub(super) fn hand(&mut self, ui: &Ui, response: &Response, side: usize) {
        let is_taken = self.aim(ui, response, side)
            || self.grab(ui, response, side)
            || self.drag_surface(ui, response, side);
        if is_taken {
            return;
        }
        let Some(mut orbit) = self.viewpoint.orbit() else { return };
        let height = f64::from(response.rect.height().max(1.0));
        let drag = response.drag_delta();
        let (right, down) = (f64::from(drag.x) / height, f64::from(drag.y) / height);
        let (modifiers, fingers) = ui.input(|input| (input.modifiers, input.multi_touch()));
        if let Some(fingers) = fingers.filter(|_| response.hovered()) {
            let [right, down] = <[f32; 2]>::from(fingers.translation_delta).map(f64::from);
            orbit.pan(right / height, -down / height);
        } else if response.dragged_by(PointerButton::Primary) && !modifiers.shift {
            orbit.turn(std::f64::consts::PI * right, -std::f64::consts::PI * down);
        } else if response.dragged() {
            orbit.pan(right, -down);
        }
        let factor = zoom_asked(ui);
        if response.hovered() && factor != 1.0 {
            match self.subject(ui, response, side) {
                Some(subject) => orbit.zoom_on(factor, subject),
                None => orbit.zoom(factor),
            }
        }
        self.viewpoint.take(orbit);
        if let Some(pointer) = response.interact_pointer_pos()
            && response.clicked()
        {
            self.click(response, pointer, modifiers, side);
        }
    }

    /// Handles a drag of the picked ball; returns whether the drag is one.
    fn grab(&mut self, ui: &Ui, response: &Response, side: usize) -> bool {
        let rect = response.rect;
        if self.grabbed.is_some_and(|grab| grab.side != side) {
            return false;
        }
        if self.grabbed.is_none() {
            let (pointer, pressed) =
                ui.input(|input| (input.pointer.hover_pos(), input.pointer.press_origin()));
            let is_near = |place: &Pos2| self.is_at_picked(rect, *place, side);
            if response.hovered() && pointer.is_some_and(|it| is_near(&it)) {
                ui.ctx().set_cursor_icon(CursorIcon::Grab);
            }
            let begins = response.drag_started_by(PointerButton::Primary);
            let Some(pressed) = pressed.filter(is_near).filter(|_| begins) else { return false };
            self.grabbed = self.taken(rect, pressed, side);
        }
        let (Some(mut grab), Some(orbit)) = (self.grabbed.take(), self.viewpoint.orbit()) else {
            return false;
        };
        let view = self.driver.view();
        grab.see_spring(view);
        let is_held = response.dragged_by(PointerButton::Primary);
        if is_held {
            ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
        }
        let moved = response.interact_pointer_pos().filter(|_| is_held).and_then(|pointer| {
            let (origin, direction) = ray(orbit, rect, pointer);
            grab.anchor_on(origin, direction)
        });
        self.grabbed = grab.go_on(moved, is_held, view, &mut self.commands);
        true
    }

    /// Returns whether a place on the screen is at the picked ball.
    fn is_at_picked(&self, rect: Rect, place: Pos2, side: usize) -> bool {
        let picked = side_of(self.driver.view(), side).picked;
        picked.is_some_and(|id| self.is_at(rect, place, side, id))
    }

    /// Returns whether a place on the screen is at a ball.
    pub(super) fn is_at(&self, rect: Rect, place: Pos2, side: usize, id: SphereId) -> bool {
        let (view, blend) = (side_of(self.driver.view(), side), self.driver.blend());
        let found = view.spheres.index_of(id).and_then(|index| {
            let (center, radius) = (look::place(view, index, blend), view.spheres.radii[index]);
            let projection = self.projection(rect)?;
            Some((projection.place(center)?, projection.radius(center, radius)?))
        });
        found.is_some_and(|(center, radius)| center.distance(place) <= radius.max(REACH))
    }

    /// Takes the picked ball at a place on the screen into the hand.
    fn taken(&mut self, rect: Rect, place: Pos2, side: usize) -> Option<Grab> {
        let (orbit, blend) = (self.viewpoint.orbit()?, self.driver.blend());
        let view = side_of(self.driver.view(), side);
        let index = view.spheres.index_of(view.picked.filter(|_| view.seeking.is_none())?)?;
        let center = look::place(view, index, blend);
        let normal = ray(orbit, rect, rect.center()).1;
        let grab = Grab::new(view, index, center, normal, &mut self.commands);
        let (origin, direction) = ray(orbit, rect, place);
        let under = grab.anchor_on(origin, direction).unwrap_or(center);
        Some(grab.held_at(under, side))
    }

    fn click(&mut self, response: &Response, pointer: Pos2, modifiers: Modifiers, side: usize) {
        let Some(mut orbit) = self.viewpoint.orbit() else { return };
        let (origin, direction) = ray(orbit, response.rect, pointer);
        if modifiers.command {
            self.throw_along(direction, orbit);
            return;
        }
        let blend = self.driver.blend();
        let view = side_of(self.driver.view(), side);
        let picked = look::sphere_at(view, blend, origin, direction);
        if response.double_clicked()
            && let Some(index) = picked.and_then(|id| view.spheres.index_of(id))
        {
            orbit.center_on(look::place(view, index, blend));
            self.viewpoint.take(orbit);
        }
        self.surface = match picked {
            Some(_) => None,
            None => surface_at(view, orbit.camera.near, [origin, direction]).map(|(id, _)| id),
        };
        self.viewpoint.unfollow();
        self.commands.push(Command::Pick(picked));
    }

    /// Throws a ball along a direction (unit vector), from in front of the camera, so that the user
    /// sees it fly away.
    fn throw_along(&mut self, direction: DVec3, Orbit { camera, .. }: Orbit) {
        let Throw { radius, mass, speed, restitution } = self.throw;
        let sphere =
            Sphere::new(camera.position + direction * (camera.near + 3.0 * radius), radius)
                .with_velocity(direction * speed)
                .with_mass(mass)
                .with_restitution(restitution);
        self.commands.push(Command::Edit(Edit::Throw { sphere: Box::new(sphere), color: None }));
    }

    /// Throws a ball to where the camera looks; it is picked as soon as it is there.
    pub(super) fn throw_ahead(&mut self) {
        let Some(orbit) = self.viewpoint.orbit() else { return };
        self.thrown_after = Some(self.view().spheres.ids.last().copied());
        self.throw_along(orbit.camera.ahead(), orbit);
    }

    /// Picks the ball that [`Self::throw_ahead`] has thrown, once it is there.
    pub(super) fn pick_thrown(&mut self) {
        let newest = self.view().spheres.ids.last().copied();
        if self.thrown_after.is_some_and(|before| newest > before) {
            self.thrown_after = None;
            self.commands.push(Command::Pick(newest));
        }
    }

    /// Returns what a zoom is about \[m\]: the ball under the pointer, else the picked one, else the
    /// middle of those in the picture; `None` without any.
    fn subject(&self, ui: &Ui, response: &Response, side: usize) -> Option<DVec3> {
        let orbit = self.viewpoint.orbit()?;
        let blend = self.driver.blend();
        let view = side_of(self.driver.view(), side);
        let projection = self.projection(response.rect)?;
        let is_seen = |place: &DVec3| {
            projection.place(*place).is_some_and(|place| response.rect.contains(place))
        };
        let pointed = ui.input(|input| input.pointer.hover_pos()).and_then(|pointer| {
            let (origin, direction) = ray(orbit, response.rect, pointer);
            look::sphere_at(view, blend, origin, direction)
        });
        let one = pointed.or(view.picked).and_then(|id| view.spheres.index_of(id));
        let one = one.map(|index| look::place(view, index, blend)).filter(is_seen);
        one.or_else(|| middle(view.spheres.positions.iter().copied().filter(is_seen)))
    }

    /// Returns the camera of a picture that fills `picture`.
    pub(super) fn projection(&self, picture: Rect) -> Option<Projection> {
        let aspect = f64::from(picture.width() / picture.height());
        let camera = self.viewpoint.orbit()?.in_picture(aspect);
        Some(Projection { camera, rect: picture })
    }

    /// Returns the position on the screen of the sphere at an index, for a picture that fills
    /// `picture`; `None` behind the camera.
    pub fn place_of(&self, index: usize, picture: Rect) -> Option<Pos2> {
        let center = look::place(self.view(), index, self.driver.blend());
        self.projection(picture)?.place(center)
    }

    /// Returns the radius on the screen of the sphere at an index, in points, for a picture that
    /// fills `picture`; `None` if the camera is within it.
    pub fn radius_of(&self, index: usize, picture: Rect) -> Option<f32> {
        let center = look::place(self.view(), index, self.driver.blend());
        self.projection(picture)?.radius(center, self.view().spheres.radii[index])
    }
}

/// Returns origin \[m\] and direction of the ray through a place of the picture in `rect`.
pub(super) fn ray(orbit: Orbit, rect: Rect, pointer: Pos2) -> (DVec3, DVec3) {
    let place = (pointer - rect.center()) / (0.5 * rect.size());
    let aspect = f64::from(rect.width() / rect.height());
    let camera = orbit.in_picture(aspect);
    (camera.position, camera.ray(glam::Vec2::new(place.x, -place.y), aspect))
}

/// Returns the point whose coordinates are the medians of those of all points.
fn middle(points: impl Iterator<Item = DVec3>) -> Option<DVec3> {
    let points: Vec<DVec3> = points.collect();
    let along = |axis: usize| {
        let mut values: Vec<f64> = points.iter().map(|it| it[axis]).collect();
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied()
    };
    Some(DVec3::new(along(0)?, along(1)?, along(2)?))
}
