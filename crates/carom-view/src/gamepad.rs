//! Sticks of gamepads.

use egui::Vec2;
use gilrs::{Axis, Gilrs};

/// The connected gamepads; none if the system has no support for them.
#[derive(Default)]
pub struct Gamepad {
    /// Opened at the first use.
    gilrs: Option<Option<Gilrs>>,
}

impl Gamepad {
    /// Returns the left stick of the first gamepad: right and down, each in \[-1, 1\].
    pub fn stick(&mut self) -> Option<Vec2> {
        let gilrs = self.gilrs.get_or_insert_with(|| Gilrs::new().ok()).as_mut()?;
        while gilrs.next_event().is_some() {}
        let (_, pad) = gilrs.gamepads().next()?;
        Some(Vec2::new(pad.value(Axis::LeftStickX), -pad.value(Axis::LeftStickY)))
    }
}
