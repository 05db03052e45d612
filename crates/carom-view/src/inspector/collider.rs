//! Restitution and friction of colliders.

use carom::{CombineRule, DVec3, SphereId};
use carom_scene::scene::{Collider, Motion};
use carom_session::{Command, Edit, View};
use egui::accesskit::Action;
use egui::{Slider, Ui};

use super::friction;
use super::value::name;

/// Largest number of surfaces with a slider each; more share one slider.
const LISTED: usize = 24;

pub(super) fn show(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    let solid = || view.setup.colliders.iter().filter(|(_, collider)| !collider.trigger);
    let Some((_, first)) = solid().next() else {
        ui.weak("none that deflects");
        return;
    };
    let has_friction = friction::acts(view);
    if solid().nth(1).is_some() {
        let mut all = first.restitution;
        if slider(ui, "all", "Restitution of all surfaces", &mut all) {
            commands.push(Command::Edit(Edit::AllColliderRestitutions(all)));
        }
        let mut all = first.surface_friction();
        if has_friction && friction::show(ui, "Friction of all", &mut all) {
            commands.push(Command::Edit(Edit::AllColliderFrictions(all)));
        }
    }
    for (i, (id, collider)) in solid().take(LISTED).enumerate() {
        let title =
            if collider.name.is_empty() { format!("surface {i}") } else { collider.name.clone() };
        let mut restitution = collider.restitution;
        let text = format!("Restitution of {title}");
        let is_changed =
            ui.push_id(("collider", *id), |ui| slider(ui, &title, &text, &mut restitution)).inner;
        if is_changed {
            commands.push(Command::Edit(Edit::ColliderRestitution(*id, restitution)));
        }
        if !collider.motion.is_empty() {
            ui.weak(format!("{title}: {}", motion_of(collider)));
        }
        if let Some((ball, of_contact)) = with_picked(view, restitution) {
            ui.weak(format!("with ball {ball}: {of_contact:.2}"));
        }
        if !has_friction {
            continue;
        }
        let mut said = collider.surface_friction();
        let text = format!("Friction of {title}");
        if ui.push_id(("friction", *id), |ui| friction::show(ui, &text, &mut said)).inner {
            commands.push(Command::Edit(Edit::ColliderFriction(*id, said)));
        }
    }
}

/// Returns the parts of the motion of a collider in words.
fn motion_of(collider: &Collider) -> String {
    let part = |motion: &Motion| match *motion {
        Motion::Steady { velocity } => {
            format!("moves with {:.3} m/s", DVec3::from_array(velocity).length())
        }
        Motion::Oscillate { amplitude, frequency, .. } => {
            format!("oscillates by {amplitude} m at {frequency} Hz")
        }
        Motion::Turn { rate, .. } => format!("turns with {rate} rad/s"),
        Motion::Swing { amplitude_degrees, frequency, .. } => {
            format!("swings by {amplitude_degrees}° at {frequency} Hz")
        }
    };
    collider.motion.iter().map(part).collect::<Vec<_>>().join(", ")
}

/// Returns the picked ball and the restitution of its contact with a surface of this restitution.
fn with_picked(view: &View, restitution: f64) -> Option<(SphereId, f64)> {
    let ball = view.picked?;
    let of_ball = view.spheres.restitutions[view.spheres.index_of(ball)?];
    let rule = CombineRule::from(view.setup.simulation.combine_rule);
    Some((ball, rule.combine(restitution, of_ball)))
}

fn slider(ui: &mut Ui, title: &str, text: &str, restitution: &mut f64) -> bool {
    ui.horizontal(|ui| {
        name(ui, title);
        let before = *restitution;
        let response = ui.add(Slider::new(restitution, 0.0..=1.0));
        let is_handled = response.dragged() || response.clicked() || response.has_focus();
        let is_handled = is_handled || response.lost_focus() || response.drag_stopped();
        let is_asked =
            |action| ui.input(|input| input.has_accesskit_action_request(response.id, action));
        let is_handled = is_handled
            || [Action::SetValue, Action::Increment, Action::Decrement].into_iter().any(is_asked);
        response.widget_info(|| egui::WidgetInfo::slider(true, *restitution, text));
        // A slider rounds its value; the change counts only if the user moves it.
        is_handled && *restitution != before
    })
    .inner
}
