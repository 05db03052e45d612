//! Rows with numbers that can be dragged and typed.

use std::cell::OnceCell;

use egui::{Align, DragValue, Label, Layout, Response, RichText, Ui, Vec2, WidgetInfo};

/// Smallest positive number that can be dragged to. Smaller lengths, masses and times belong in
/// scene files.
const SMALLEST: f64 = 1e-9;

/// Number of significant digits shown.
const DIGITS: i32 = 4;

/// Widths of the names and of the values of rows, in points.
const NAME_WIDTH: f32 = 144.0;
const VALUE_WIDTH: f32 = 66.0;

/// Name, unit and range of a number.
#[derive(Clone, Copy)]
pub(super) struct Field<'a> {
    /// The plain word, with the word of the field in brackets where that is another one.
    pub name: &'a str,
    pub unit: &'a str,
    /// Meaning of the value, for its tooltip.
    pub hint: &'a str,
    pub min: f64,
    pub max: f64,
    pub is_whole: bool,
}

impl<'a> Field<'a> {
    pub fn any(name: &'a str, unit: &'a str) -> Self {
        let (min, max) = (f64::NEG_INFINITY, f64::INFINITY);
        Self { name, unit, hint: "", min, max, is_whole: false }
    }

    pub fn positive(name: &'a str, unit: &'a str) -> Self {
        Self { min: SMALLEST, ..Self::any(name, unit) }
    }

    pub fn not_negative(name: &'a str, unit: &'a str) -> Self {
        Self { min: 0.0, ..Self::any(name, unit) }
    }

    pub fn restitution() -> Self {
        let hint = "Speed after an impact divided by the speed before it: 1 keeps all, 0 none";
        Self { min: 0.0, max: 1.0, hint, ..Self::any("Bounciness (restitution)", "") }
    }

    /// Sets the meaning of the value.
    pub fn hint(self, hint: &'a str) -> Self {
        Self { hint, ..self }
    }

    /// Returns the name for assistive technology, with axis and unit.
    fn full_name(&self, axis: &str) -> String {
        let axis = if axis.is_empty() { String::new() } else { format!(" {axis}") };
        let unit = if self.unit.is_empty() { String::new() } else { format!(", {}", self.unit) };
        format!("{}{axis}{unit}", self.name)
    }

    /// Returns the text of the tooltip.
    fn tooltip(&self) -> String {
        let unit = if self.unit.is_empty() { "No unit" } else { self.unit };
        let hint = if self.hint.is_empty() { self.name } else { self.hint };
        format!("{hint}. Unit: {unit}.\nDrag it, or click and type.")
    }
}

/// Formats a number with four significant digits, without zeros at the end.
pub fn significant(number: f64) -> String {
    if number == 0.0 || !number.is_finite() {
        return format!("{number}");
    }
    let magnitude = number.abs().log10().floor() as i32;
    if !(-3..6).contains(&magnitude) {
        return format!("{number:.*e}", DIGITS as usize - 1);
    }
    let decimals = (DIGITS - 1 - magnitude).max(0) as usize;
    let text = format!("{number:.decimals$}");
    if !text.contains('.') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Shows a row with a number. Returns whether it was changed.
pub(super) fn number(ui: &mut Ui, field: Field, value: &mut f64) -> bool {
    row(ui, field, |ui| drag(ui, field, "", value))
}

/// Shows a row with an optional number; without a tick, the other body decides. Returns whether it
/// was changed.
pub(super) fn optional(ui: &mut Ui, field: Field, value: &mut Option<f64>) -> bool {
    row(ui, field, |ui| {
        let mut is_given = value.is_some();
        let tick = ui
            .checkbox(&mut is_given, "")
            .on_hover_text("Without a tick, what it touches decides.");
        let text = format!("{} is given", field.name);
        tick.widget_info(|| WidgetInfo::selected(egui::Role::CheckBox, true, is_given, &text));
        let is_changed = tick.changed();
        if is_changed {
            *value = is_given.then_some(field.min);
        }
        value.as_mut().is_some_and(|value| drag(ui, field, "", value)) | is_changed
    })
}

/// Shows a row with a tick; `hint` explains it. Returns whether it was changed.
pub(super) fn tick(ui: &mut Ui, name: &str, hint: &str, value: &mut bool) -> bool {
    let response = ui.checkbox(value, name).on_hover_text(hint);
    response.widget_info(|| WidgetInfo::selected(egui::Role::CheckBox, true, *value, name));
    response.changed()
}

/// Largest count that can be dragged to; larger numbers belong in scene files.
const MOST: u32 = 1000;

/// Shows a row with a whole number, at least 1. Returns whether it was changed.
pub(super) fn count(ui: &mut Ui, field: Field, value: &mut u32) -> bool {
    row(ui, field, |ui| {
        let before = *value;
        let drag = DragValue::new(value).speed(0.1).range(1..=MOST.max(before));
        let response = ui.add_sized(value_size(ui), drag.update_while_editing(false));
        name_value(&response, field.full_name(""), f64::from(*value));
        response.on_hover_text(field.tooltip());
        *value != before
    })
}

/// Shows the name, and three numbers with their axes below it. Returns whether any was changed.
pub(super) fn vector(ui: &mut Ui, field: Field, value: &mut [f64; 3]) -> bool {
    ui.horizontal(|ui| {
        ui.label(field.name).on_hover_text(field.tooltip());
        ui.label(RichText::new(field.unit).weak());
    });
    ui.horizontal(|ui| {
        let axes = ["x", "y", "z"].into_iter().zip(value);
        axes.fold(false, |changed, (axis, value)| {
            ui.spacing_mut().item_spacing.x = 5.0;
            ui.label(RichText::new(axis).weak());
            let is_changed = drag(ui, field, axis, value);
            ui.add_space(5.0);
            is_changed | changed
        })
    })
    .inner
}

/// Shows a row with a number that changes only when the drag or the typing ends.
pub(super) fn number_at_last(ui: &mut Ui, field: Field, value: &mut f64) -> bool {
    let id = ui.scope_id().with(field.name);
    row(ui, field, |ui| {
        let mut shown = ui.data(|data| data.get_temp(id)).unwrap_or(*value);
        let response = dragged(ui, field, "", &mut shown);
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
        name(ui, field.name, &field.tooltip());
        let changed = contents(ui);
        ui.label(RichText::new(field.unit).weak());
        changed
    })
    .inner
}

/// Shows the name of a row, with the same width in all rows, and a tooltip.
pub(super) fn name(ui: &mut Ui, name: &str, tooltip: &str) -> Response {
    let size = Vec2::new(NAME_WIDTH, ui.spacing().interact_size.y);
    let layout = Layout::left_to_right(Align::Center);
    let shown = ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_width(NAME_WIDTH);
        ui.add(Label::new(name).truncate())
    });
    shown.inner.on_hover_text(tooltip)
}

/// Shows a row with a number that is computed from others.
pub(super) fn derived_number(ui: &mut Ui, field: Field, value: f64) {
    row(ui, field, |ui| ui.weak(significant(value)));
}

fn value_size(ui: &Ui) -> Vec2 {
    Vec2::new(VALUE_WIDTH, ui.spacing().interact_size.y)
}

fn name_value(response: &Response, name: String, value: f64) {
    response.widget_info(|| WidgetInfo {
        label: Some(name.clone()),
        ..WidgetInfo::drag_value(true, value)
    });
}

fn drag(ui: &mut Ui, field: Field, axis: &str, value: &mut f64) -> bool {
    let before = *value;
    dragged(ui, field, axis, value);
    *value != before
}

fn dragged(ui: &mut Ui, field: Field, axis: &str, value: &mut f64) -> Response {
    let before = *value;
    let shown = OnceCell::new();
    let speed = if *value == 0.0 { 0.01 } else { 0.01 * value.abs() };
    let drag = DragValue::new(value)
        .speed(speed)
        .range(field.min..=field.max)
        .custom_formatter(|number, _| {
            let text = if field.is_whole { format!("{number:.0}") } else { significant(number) };
            shown.get_or_init(|| text.clone());
            text
        })
        // An incomplete number is not a value.
        .update_while_editing(false);
    let response = ui.add_sized(value_size(ui), drag);
    // A field that is clicked and left parses its own text, which has fewer digits.
    if shown.get().and_then(|text| text.parse().ok()) == Some(*value) {
        *value = before;
    }
    name_value(&response, field.full_name(axis), *value);
    response.on_hover_text(field.tooltip())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_significant_digits_at_every_size() {
        for (number, text) in [
            (0.0, "0"),
            (0.5, "0.5"),
            (-9.81, "-9.81"),
            (1.0 / 60.0, "0.01667"),
            (123.456, "123.5"),
            (99_999.6, "100000"),
            (12_345.6, "12346"),
            (1e-6, "1.000e-6"),
            (-2.5e9, "-2.500e9"),
        ] {
            assert_eq!(significant(number), text);
        }
    }
}
