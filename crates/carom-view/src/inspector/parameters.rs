//! The parameters of a scene file.

use carom_scene::Parameter;
use egui::Ui;

use super::value::{Field, derived_number, settled_number};

/// Rows of parameters. Returns one that was given another value: that begins the scene anew.
pub(super) fn show(ui: &mut Ui, parameters: &[Parameter]) -> Option<Parameter> {
    let mut changed = None;
    for parameter in parameters {
        let field = Field::any(&parameter.name, "");
        if parameter.is_formula {
            derived_number(ui, field, parameter.value);
        } else if let Some(value) = settled_number(ui, field, parameter.value, parameter.is_whole) {
            changed = Some(Parameter { value, ..parameter.clone() });
        }
    }
    ui.weak("Another value begins the scene anew.");
    changed
}
