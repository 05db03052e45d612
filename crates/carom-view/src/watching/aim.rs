//! A cue in the hand: a drag from the cue ball sets direction and speed of a blow, and letting go strikes.

use carom::{DVec3, SphereId};
use carom_session::{Aim, Command, Edit, SphereChange, View};
use egui::{CursorIcon, Painter, PointerButton, Pos2, Response, Ui};

use super::Watching;
use super::cue::Cue;
use super::sides::side_of;
use crate::aiming;
use crate::look;
use crate::projection::Projection;

impl Watching {
    /// Handles a drag from the cue ball; returns whether the drag is one.
    pub(super) fn aim(&mut self, ui: &Ui, response: &Response, side: usize) -> bool {
        let Some(ball) = cue_ball(side_of(self.driver.view(), side)) else {
            self.cue = None;
            return false;
        };
        let rect = response.rect;
        if self.cue.is_none() {
            let (pointer, pressed) =
                ui.input(|input| (input.pointer.hover_pos(), input.pointer.press_origin()));
            let is_near = |place: Pos2| self.is_at(rect, place, side, ball);
            if response.hovered() && pointer.is_some_and(is_near) {
                ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
            }
            let begins = response.drag_started_by(PointerButton::Primary);
            if !begins || !pressed.is_some_and(is_near) {
                return false;
            }
            self.cue = Some(Cue { ball, velocity: None, side });
        }
        let Some(cue) = self.cue.filter(|cue| cue.side == side) else { return false };
        if response.dragged_by(PointerButton::Primary) {
            let velocity = response.interact_pointer_pos().map(|it| self.blow(rect, it, cue));
            let cue = Cue { velocity: velocity.unwrap_or(cue.velocity), ..cue };
            let aim = cue.velocity.map(|velocity| Aim { sphere: cue.ball, velocity });
            self.commands.push(Command::Aim(aim));
            self.cue = Some(cue);
            return true;
        }
        self.cue = None;
        self.commands.push(Command::Aim(None));
        if let Some(velocity) = cue.velocity {
            let change = SphereChange { velocity: Some(velocity), ..SphereChange::default() };
            let edit = Edit::Sphere(cue.ball, Box::new(change));
            self.commands.extend([Command::Edit(edit), Command::Play]);
        }
        true
    }

    /// Returns the velocity of a blow \[m/s\] towards the point of the table under the pointer; `None` on the ball.
    fn blow(&self, rect: egui::Rect, pointer: Pos2, cue: Cue) -> Option<DVec3> {
        let view = side_of(self.driver.view(), cue.side);
        let index = view.spheres.index_of(cue.ball)?;
        let center = look::place(view, index, self.driver.blend());
        aiming::blow(&self.projection(rect)?, pointer, center, view.spheres.radii[index])
    }

    /// Draws the path of the ball that is aimed, and its speed.
    pub(super) fn draw_aim(&self, painter: &Painter, projection: &Projection, side: usize) {
        let Some(cue) = self.cue.filter(|cue| cue.side == side) else { return };
        let speed = cue.velocity.map(|it| it.length());
        aiming::draw_path(painter, projection, &self.driver.view().aimed, speed);
    }
}

/// Returns the cue ball: the first sphere of the scene with a strike, if it is still there.
fn cue_ball(view: &View) -> Option<SphereId> {
    let number = view.scene.spheres.iter().position(|it| it.strike.is_some())? as u64;
    let id = view.spheres.ids.iter().find(|id| id.number() == number)?;
    view.seeking.is_none().then_some(*id)
}
