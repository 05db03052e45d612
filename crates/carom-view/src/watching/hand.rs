//! Mouse and fingers in the picture of a scene.

use carom::Sphere;
use carom_session::{Command, Edit};
use egui::{Modifiers, PointerButton, Pos2, Rect, Response, Ui, Vec2};

use super::Watching;
use super::sides::side_of;
use crate::inspector::Throw;
use crate::look;
use crate::orbit::zoom_asked;

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
        if response.hovered() {
            orbit.zoom(zoom_asked(ui));
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
        let rect = response.rect;
        let place = (pointer - rect.center()) / (0.5 * rect.size());
        let aspect = f64::from(rect.width() / rect.height());
        let direction =
            orbit.camera.in_picture(aspect).ray(glam::Vec2::new(place.x, -place.y), aspect);
        let origin = orbit.camera.position;
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

    /// Returns the position on the screen of the sphere at an index, for a picture that fills
    /// `picture`; `None` behind the camera.
    pub fn place_of(&self, index: usize, picture: Rect) -> Option<Pos2> {
        let aspect = f64::from(picture.width() / picture.height());
        let camera = self.viewpoint.orbit()?.camera.in_picture(aspect);
        let center = look::place(self.view(), index, self.driver.blend());
        let place = camera.place(center, aspect)?;
        Some(picture.center() + Vec2::new(place.x, -place.y) * 0.5 * picture.size())
    }
}
