//! A cue in the hand: a drag from the cue ball sets direction and speed of a blow, and letting go strikes.

use carom::{DVec3, SphereId};
use carom_session::{Aim, Command, Edit, SphereChange, View};
use egui::{Align2, Color32, CursorIcon, FontId, Painter, PointerButton, Pos2, Response, Ui, Vec2};

use super::Watching;
use super::cue::Cue;
use super::hand::ray;
use super::marker::{Projection, three_digits};
use super::sides::side_of;
use crate::look;

/// Time in which a ball covers the drag that strikes it \[s\]: a drag over a billiard table breaks.
const DRAG_SECS: f64 = 0.25;

/// Radius of a dot of the path, in points.
const DOT: f32 = 2.0;

/// Colours of dots and text, and of their borders.
const INK: [Color32; 2] = [Color32::WHITE, Color32::from_black_alpha(200)];

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
        let (orbit, view) = (self.viewpoint.orbit()?, side_of(self.driver.view(), cue.side));
        let index = view.spheres.index_of(cue.ball)?;
        let center = look::place(view, index, self.driver.blend());
        let (origin, direction) = ray(orbit, rect, pointer);
        let distance = (center.y - origin.y) / direction.y;
        let way = (origin + direction * distance - center).with_y(0.0);
        let is_off = way.length() > view.spheres.radii[index];
        (distance > 0.0 && way.is_finite() && is_off).then(|| way / DRAG_SECS)
    }

    /// Draws the path of the ball that is aimed, and its speed.
    pub(super) fn draw_aim(&self, painter: &Painter, projection: &Projection, side: usize) {
        let Some(cue) = self.cue.filter(|cue| cue.side == side) else { return };
        let view = self.driver.view();
        let places = view.aimed.iter().filter_map(|point| projection.place(*point));
        for place in places {
            painter.circle_filled(place, DOT + 1.0, INK[1]);
            painter.circle_filled(place, DOT, INK[0]);
        }
        let Some((start, velocity)) = view.aimed.first().zip(cue.velocity) else { return };
        let Some(place) = projection.place(*start) else { return };
        let text = format!("{} m/s", three_digits(velocity.length()));
        let galley = painter.layout_no_wrap(text, FontId::proportional(14.0), INK[0]);
        let size = galley.size() + Vec2::new(10.0, 4.0);
        let back = Align2::LEFT_TOP.anchor_size(place + Vec2::splat(12.0), size);
        painter.rect_filled(back, 4.0, INK[1]);
        painter.galley(back.min + Vec2::new(5.0, 2.0), galley, INK[0]);
    }
}

/// Returns the cue ball: the first sphere of the scene with a strike, if it is still there.
fn cue_ball(view: &View) -> Option<SphereId> {
    let number = view.scene.spheres.iter().position(|it| it.strike.is_some())? as u64;
    let id = view.spheres.ids.iter().find(|id| id.number() == number)?;
    view.seeking.is_none().then_some(*id)
}
