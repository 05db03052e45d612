//! What lies over the picture: hints and the card of the scene.

use carom_session::SessionError;
use egui::{Rect, Ui};

use super::hints::{self, Way};
use super::{Watching, card};
use crate::action::Action;
use crate::layout::is_compact;

impl Watching {
    /// Shows the card of the scene over a picture, and does what its sliders ask for.
    pub(super) fn card(&mut self, ui: &Ui, picture: Rect) {
        let view = self.driver.view();
        if view.scene.tries.is_empty() || view.other.is_some() || is_compact(ui) {
            return;
        }
        let Some((index, number)) = self.card.show(ui, picture, view) else { return };
        match card::commands(view, index, number) {
            Ok(commands) => self.commands.extend(commands),
            Err(error) => self.refused = Some(SessionError::from(error)),
        }
    }

    /// Shows the hints over the picture. Returns the actions of their buttons.
    pub(super) fn hints(&mut self, ui: &mut Ui, picture: Rect) -> Vec<Action> {
        let Some(orbit) = self.viewpoint.orbit() else { return Vec::new() };
        let camera = orbit.in_picture(f64::from(picture.width() / picture.height()));
        let Self { driver, commands, way, restarted, .. } = self;
        *way = Way::of(driver.view(), *way);
        let told = hints::HintState {
            way: way.as_ref(),
            restarted: *restarted,
            seconds_at_work: driver.seconds_at_work(),
        };
        hints::show(ui, picture, driver.view(), told, &camera, commands)
    }
}
