//! Two runs side by side.

use carom::DVec3;
use carom_scene::scene::{Rule, Simulation};
use carom_session::Command;

use super::Watching;
use crate::action::Action;

/// How far a ball is nudged, in its radii: too little to see before impacts enlarge it.
const NUDGE: f64 = 1e-9;

impl Watching {
    /// Shows the scene under two rules, or a single run if there are two.
    pub(super) fn compare(&mut self) {
        let view = self.driver.view();
        let own = view.setup.simulation.clone();
        let pair = view.other.is_none().then(|| {
            let rule = if own.rule == Rule::Exact { Rule::Discrete } else { Rule::Exact };
            Box::new([own.clone(), Simulation { rule, ..own }])
        });
        self.commands.push(Command::Compare(pair));
    }

    /// Shows a copy of the run beside it, with the picked ball, or else the first, nudged along x; of two
    /// runs, nudges the ball of the second. The plots show how the distance grows.
    pub(super) fn nudge(&mut self) {
        let view = self.driver.view();
        let picked = view.picked.and_then(|it| view.spheres.index_of(it));
        let index = picked.unwrap_or_default();
        let (ids, radii) = (&view.spheres.ids, &view.spheres.radii);
        let Some((&id, &radius)) = ids.get(index).zip(radii.get(index)) else { return };
        self.commands.push(Command::Nudge(id, NUDGE * radius * DVec3::X));
        if !self.open_panels().plots {
            self.toggle_panel(Action::Plots);
        }
    }
}
