//! Rows with numbers that can be dragged and typed.

use std::cell::OnceCell;

use egui::emath::format_with_decimals_in_range;
use egui::{DragValue, Response, RichText, Ui};

/// Smallest positive number that can be dragged to. Smaller lengths, masses and times belong in
/// scene files.
const SMALLEST: f64 = 1e-9;

/// Largest number of decimals.
const MOST_DECIMALS: usize = 9;

/// Name, unit and range of a number.
#[derive(Clone, Copy)]
pub(super) struct Field<'a> {
    pub name: &'a str,
    pub unit: &'a str,
    pub min: f64,
    pub max: f64,
    /// Largest number of decimals shown.
    pub decimals: usize,
}

impl<'a> Field<'a> {
    pub fn any(name: &'a str, unit: &'a str) -> Self {
        let (min, max) = (f64::NEG_INFINITY, f64::INFINITY);
        Self { name, unit, min, max, decimals: MOST_DECIMALS }
    }

    pub fn positive(name: &'a str, unit: &'a str) -> Self {
        Self { min: SMALLEST, ..Self::any(name, unit) }
    }

    pub fn not_negative(name: &'a str, unit: &'a str) -> Self {
        Self { min: 0.0, ..Self::any(name, unit) }
    }

    pub fn restitution() -> Self {
        Self { min: 0.0, max: 1.0, ..Self::any("restitution", "") }
    }
}

/// Shows a row with a number. Returns whether it was changed.
pub(super) fn number(ui: &mut Ui, field: Field, value: &mut f64) -> bool {
    row(ui, field, |ui| drag(ui, field, value))
}

/// Shows a row with an optional number; without a tick, the other body decides. Returns whether it
/// was changed.
pub(super) fn optional(ui: &mut Ui, field: Field, value: &mut Option<f64>) -> bool {
    row(ui, field, |ui| {
        let mut is_given = value.is_some();
        let tick = ui
            .checkbox(&mut is_given, "")
            .on_hover_text("Without a tick, what it touches decides.");
        let text = format!("{} {} is given", field.name, field.unit);
        tick.widget_info(|| {
            egui::WidgetInfo::selected(egui::Role::CheckBox, true, is_given, &text)
        });
        let is_changed = tick.changed();
        if is_changed {
            *value = is_given.then_some(field.min);
        }
        value.as_mut().is_some_and(|value| drag(ui, field, value)) | is_changed
    })
}

/// Shows a row with a tick; `hint` explains it. Returns whether it was changed.
pub(super) fn tick(ui: &mut Ui, name: &str, hint: &str, value: &mut bool) -> bool {
    row(ui, Field::any(name, ""), |ui| {
        let response = ui.checkbox(value, "").on_hover_text(hint);
        response
            .widget_info(|| egui::WidgetInfo::selected(egui::Role::CheckBox, true, *value, name));
        response.changed()
    })
}

/// Largest count that can be dragged to; larger numbers belong in scene files.
const MOST: u32 = 1000;

/// Shows a row with a whole number, at least 1. Returns whether it was changed.
pub(super) fn count(ui: &mut Ui, name: &str, value: &mut u32) -> bool {
    row(ui, Field::any(name, ""), |ui| {
        let before = *value;
        let drag = DragValue::new(value).speed(0.1).range(1..=MOST.max(before));
        let response: Response = ui.add(drag.update_while_editing(false));
        response.widget_info(|| egui::WidgetInfo {
            label: Some(name.to_owned()),
            ..egui::WidgetInfo::drag_value(true, f64::from(*value))
        });
        *value != before
    })
}

/// Shows a row with three numbers. Returns whether any was changed.
pub(super) fn vector(ui: &mut Ui, field: Field, value: &mut [f64; 3]) -> bool {
    row(ui, field, |ui| value.iter_mut().fold(false, |changed, it| drag(ui, field, it) | changed))
}

/// Shows a row with a number that changes only when the drag or the typing ends.
pub(super) fn number_at_last(ui: &mut Ui, field: Field, value: &mut f64) -> bool {
    let id = ui.scope_id().with(field.name);
    row(ui, field, |ui| {
        let mut shown = ui.data(|data| data.get_temp(id)).unwrap_or(*value);
        let response = dragged(ui, field, &mut shown);
        if response.drag_stopped() || response.lost_focus() {
            ui.data_mut(|data| data.remove::<f64>(id));
            let changed = shown != *value;
            *value = shown;
            return changed;
        }
        if response.changed() {
            ui.data_mut(|data| data.insert_temp(id, shown));
        }
        false
    })
}

fn row<R>(ui: &mut Ui, field: Field, contents: impl FnOnce(&mut Ui) -> R) -> R {
    ui.horizontal(|ui| {
        name(ui, field.name);
        let changed = contents(ui);
        ui.label(RichText::new(field.unit).weak());
        changed
    })
    .inner
}

/// Shows the name of a row, with the same width in all rows.
pub(super) fn name(ui: &mut Ui, name: &str) -> Response {
    let label = egui::Label::new(name).halign(egui::Align::LEFT);
    ui.add_sized([84.0, ui.spacing().interact_size.y], label)
}

/// Shows a row with a number that is computed from others.
pub(super) fn derived_number(ui: &mut Ui, field: Field, value: f64) {
    row(ui, field, |ui| ui.weak(format!("{value}")));
}

fn drag(ui: &mut Ui, field: Field, value: &mut f64) -> bool {
    let before = *value;
    dragged(ui, field, value);
    *value != before
}

fn dragged(ui: &mut Ui, field: Field, value: &mut f64) -> Response {
    let before = *value;
    let shown = OnceCell::new();
    let speed = if *value == 0.0 { 0.01 } else { 0.01 * value.abs() };
    let drag = DragValue::new(value)
        .speed(speed)
        .range(field.min..=field.max)
        .max_decimals(field.decimals)
        .custom_formatter(|number, decimals| {
            let text = format_with_decimals_in_range(number, decimals);
            shown.get_or_init(|| text.clone());
            text
        })
        // An incomplete number is not a value.
        .update_while_editing(false);
    let response: Response = ui.add(drag);
    // A field that is clicked and left parses its own text, which has fewer digits.
    if shown.get().and_then(|text| text.parse().ok()) == Some(*value) {
        *value = before;
    }
    let text = field.name;
    response.widget_info(|| egui::WidgetInfo {
        label: Some(text.to_owned()),
        ..egui::WidgetInfo::drag_value(true, *value)
    });
    response
}
