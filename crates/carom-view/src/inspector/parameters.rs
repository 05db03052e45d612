//! The parameters of a scene file.

use carom_scene::Parameter;
use egui::Ui;

use super::value::{Field, derived_number, number_at_last};

/// Shows the parameters. Returns one if its value was changed, which restarts the scene.
pub(super) fn show(ui: &mut Ui, parameters: &[Parameter]) -> Option<Parameter> {
    let mut changed = None;
    for parameter in parameters {
        let hint = "A parameter of the scene file";
        let field = Field::any(&parameter.name, "").hint(hint);
        let field = Field { is_whole: parameter.is_whole, ..field };
        let mut value = parameter.value;
        if parameter.is_formula {
            derived_number(ui, field, value);
        } else if number_at_last(ui, field, &mut value) {
            let value = if parameter.is_whole { value.round() } else { value };
            changed = Some(Parameter { value, ..parameter.clone() });
        }
    }
    ui.weak("Another value begins the scene anew.");
    changed
}
