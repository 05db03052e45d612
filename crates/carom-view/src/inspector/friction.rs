//! Friction coefficients of balls and surfaces.

use carom::Friction;
use carom_session::View;
use egui::Ui;

use super::value::{Field, optional};

/// Returns whether friction acts under a rule that is shown.
pub(super) fn acts(view: &View) -> bool {
    let acts = |view: &View| view.setup.simulation.rule.has_friction();
    acts(view) || view.other.as_deref().is_some_and(acts)
}

/// Shows the coefficients under a title that unfolds them. Returns whether any was changed.
pub(super) fn show(ui: &mut Ui, title: &str, friction: &mut Friction) -> bool {
    ui.collapsing(title, |ui| rows(ui, friction)).body_returned.unwrap_or(false)
}

fn rows(ui: &mut Ui, friction: &mut Friction) -> bool {
    let tangential = Field {
        name: "Grip (tang. restitution)",
        hint: "Tangential restitution: part of the slip that an impact turns round",
        ..Field::restitution()
    };
    let of = |name, hint| Field::not_negative(name, "").hint(hint);
    let rows = [
        (of("Sliding friction", "Force along the surface over force onto it"), {
            &mut friction.sliding
        }),
        (of("Rolling friction", "Resistance to rolling over weight times radius"), {
            &mut friction.rolling
        }),
        (of("Spinning friction", "Resistance to spinning over weight times radius"), {
            &mut friction.spinning
        }),
        (tangential, &mut friction.tangential_restitution),
    ];
    rows.into_iter().fold(false, |changed, (field, value)| optional(ui, field, value) | changed)
}
