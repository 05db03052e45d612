//! Mouse and fingers in the picture of a scene.

use carom::{DVec3, Sphere};
use carom_session::{Command, Edit};
use egui::{Modifiers, PointerButton, Pos2, Rect, Response, Ui};

use super::Watching;
use super::marker::Projection;
use super::sides::side_of;
use crate::inspector::Throw;
use crate::look;
use crate::orbit::{Orbit, zoom_asked};

impl Watching {
    /// Handles mouse and fingers in the picture.
    pub(super) fn hand(&mut self, ui: &Ui, response: &Response, side: usize) {
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

    fn click(&mut self, response: &Response, pointer: Pos2, modifiers: Modifiers, side: usize) {
        let Some(mut orbit) = self.viewpoint.orbit() else { return };
        let (origin, direction) = ray(orbit, response.rect, pointer);
        if modifiers.command {
            let Throw { radius, mass, speed, restitution } = self.throw;
            // In front of the camera, so that the user sees it fly away.
            let position = origin + direction * (orbit.camera.near + 3.0 * radius);
            let sphere = Sphere::new(position, radius)
                .with_velocity(direction * speed)
                .with_mass(mass)
                .with_restitution(restitution);
            self.commands
                .push(Command::Edit(Edit::Throw { sphere: Box::new(sphere), color: None }));
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
        self.viewpoint.unfollow();
        self.commands.push(Command::Pick(picked));
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
fn ray(orbit: Orbit, rect: Rect, pointer: Pos2) -> (DVec3, DVec3) {
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
