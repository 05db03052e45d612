//! Settings over the two halves of a comparison.

use carom_scene::scene::{Rule, Simulation};
use carom_session::{Command, View};
use egui::{ComboBox, Frame, Id, Rect, Stroke, Ui, UiBuilder, Vec2};

use super::verdict::Verdict;
use crate::inspector;

const RULES: [Rule; 4] = [Rule::Exact, Rule::Contact, Rule::Bisect, Rule::Discrete];

/// Returns the view of one of two rules, or the only view.
pub(super) fn side_of(view: &View, side: usize) -> &View {
    if side == 0 { view } else { view.other.as_deref().unwrap_or(view) }
}

/// Shows the rule of one half, which fills `rect`, and its settings.
pub(super) fn show(ui: &mut Ui, rect: Rect, view: &View, side: usize, commands: &mut Vec<Command>) {
    if side == 1 {
        let painter = ui.painter_at(rect);
        painter.vline(rect.left(), rect.y_range(), Stroke::new(2.0, egui::Color32::GRAY));
    }
    let present = &side_of(view, side).setup.simulation;
    // A dragged value is applied when the drag ends, because each change restarts the run.
    let ids = [Id::unique(("settings", side)), Id::unique(("draft", side))];
    let (mut is_open, draft) = ui.data_mut(|data| {
        (data.get_temp(ids[0]).unwrap_or(false), data.get_temp::<Simulation>(ids[1]))
    });
    let mut own = draft.unwrap_or_else(|| present.clone());
    let upper =
        Rect::from_min_size(rect.min + Vec2::splat(8.0), Vec2::new(rect.width() - 16.0, 30.0));
    ui.scope_builder(UiBuilder::new().max_rect(upper).id_salt(("side", side)), |ui| {
        Frame::popup(ui.style()).inner_margin(4.0).show(ui, |ui| {
            ui.horizontal(|ui| {
                let text = format!("Rule of the {} picture", ["left", "right"][side]);
                let combo = ComboBox::from_id_salt("rule").selected_text(own.rule.to_string());
                let shown = combo.show_ui(ui, |ui| {
                    for rule in RULES {
                        ui.selectable_value(&mut own.rule, rule, rule.to_string());
                    }
                });
                shown.response.widget_info(|| {
                    let rule = present.rule.to_string();
                    egui::WidgetInfo {
                        current_text_value: Some(rule),
                        ..egui::WidgetInfo::labeled(egui::Role::ComboBox, true, &text)
                    }
                });
                ui.toggle_value(&mut is_open, "Settings");
                if let Some(verdict) = Verdict::of(side_of(view, side)) {
                    verdict.show(ui);
                }
            });
            if is_open {
                ui.set_max_width(300.0);
                inspector::simulation::edit(ui, &mut own);
            }
        });
    });
    let is_held = ui.input(|input| input.pointer.any_down()) || ui.ctx().text_edit_focused();
    ui.data_mut(|data| {
        data.insert_temp(ids[0], is_open);
        data.remove::<Simulation>(ids[1]);
        if is_held && own != *present {
            data.insert_temp(ids[1], own.clone());
        }
    });
    if !is_held && own != *present {
        commands.push(Command::Compare(Some(Box::new(pair(view, side, own)))));
    }
}

/// Returns both simulations after that of one side became `own`.
fn pair(view: &View, side: usize, own: Simulation) -> [Simulation; 2] {
    let mut pair = [0, 1].map(|side| side_of(view, side).setup.simulation.clone());
    pair[1 - side].frame_time = own.frame_time;
    pair[side] = own;
    pair
}
