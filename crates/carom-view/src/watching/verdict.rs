//! Whether a rule keeps the energy that the scene should keep.

use carom_session::View;
use egui::{Color32, RichText, Ui};

/// Largest relative change of the energy that counts as kept: less than a reader sees in a plot.
const KEPT: f64 = 5e-3;

/// How much of its energy a run has kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Verdict {
    /// Energy now relative to that at the start, 1 if it is the same.
    pub kept: f64,
    /// Whether nothing in the scene takes energy.
    pub must_keep: bool,
}

impl Verdict {
    /// Returns the verdict on a view; `None` while nothing has moved, and where new balls, edits or
    /// moving surfaces add energy.
    pub fn of(view: &View) -> Option<Self> {
        let first = view.readings.first()?;
        if has_sources(view) {
            return None;
        }
        let moved = view.readings.iter().map(|it| it.kinetic_energy).fold(0.0, f64::max);
        if moved <= 0.0 {
            return None;
        }
        // The zero of the potential energy is arbitrary, so changes are compared with the motion.
        let kept = 1.0 + (view.now.total_energy() - first.total_energy()) / moved;
        Some(Self { kept, must_keep: is_lossless(view) })
    }

    pub fn text(self) -> String {
        let percent = 100.0 * self.kept;
        if self.must_keep {
            format!("energy kept: {percent:.0} %")
        } else {
            format!("energy left: {percent:.0} %")
        }
    }

    fn color(self, ui: &Ui) -> Color32 {
        let is_dark = ui.visuals().dark_mode;
        match (self.must_keep, (self.kept - 1.0).abs() <= KEPT) {
            (false, _) => ui.visuals().text_color(),
            (true, true) if is_dark => Color32::from_rgb(120, 220, 140),
            (true, true) => Color32::from_rgb(0, 110, 40),
            (true, false) => ui.visuals().error_fg_color,
        }
    }

    pub fn show(self, ui: &mut Ui) {
        let hint = "Energy of motion and height, relative to the start and to the largest energy \
                    of motion";
        ui.label(RichText::new(self.text()).strong().color(self.color(ui))).on_hover_text(hint);
    }
}

/// Returns whether emitters, edits or moving surfaces may add energy.
fn has_sources(view: &View) -> bool {
    let setup = &view.setup;
    let moves = setup.colliders.iter().any(|(_, it)| !it.trigger && !it.motion.is_empty());
    !view.changes.is_empty() || !setup.emitters.is_empty() || moves
}

/// Returns whether nothing in the scene takes energy: no loss in impacts, drag, friction or damping.
fn is_lossless(view: &View) -> bool {
    let setup = &view.setup;
    let has_friction = setup.simulation.rule.has_friction()
        && setup
            .colliders
            .iter()
            .any(|(_, it)| it.surface_friction() != carom::Friction::default());
    setup.forces.iter().all(|(_, it)| it.has_potential())
        && setup
            .colliders
            .iter()
            .all(|(_, it)| it.trigger || (it.restitution == 1.0 && it.restitution_law.is_none()))
        && view.scene.material_pairs.is_empty()
        && !has_friction
        && view.spheres.restitutions.iter().all(|it| *it == 1.0)
        && view.spheres.restitution_laws.iter().all(Option::is_none)
        && view.spheres.frictions.iter().all(|it| *it == carom::Friction::default())
        && view.springs.iter().all(|(_, it)| it.damping == 0.0)
}
