//! Restitution and friction of colliders, in groups of the same name.

use carom::{ColliderId, CombineRule, DVec3, Friction, SphereId};
use carom_scene::scene::{Collider, Motion};
use carom_session::{Command, Edit, View, group_name};
use egui::accesskit::Action;
use egui::{Slider, Ui};

use super::friction;
use super::value::name;

/// Largest number of groups with a slider each; more share one slider.
const LISTED: usize = 24;

/// Width of a slider, in points.
const SLIDER_WIDTH: f32 = 62.0;

const HINT: &str = "Bounciness (restitution): speed after an impact divided by the speed before \
                    it. 1 keeps all, 0 none. No unit.";

/// Colliders of one group name; one without a name is a group of its own.
struct Group<'a> {
    title: String,
    first: (ColliderId, &'a Collider),
    count: usize,
}

impl<'a> Group<'a> {
    /// Returns the groups of all colliders that deflect balls, in the order of their first
    /// colliders.
    fn all(view: &'a View) -> Vec<Self> {
        let mut groups: Vec<Self> = Vec::new();
        let solid = view.setup.colliders.iter().filter(|(_, collider)| !collider.trigger);
        for (i, (id, collider)) in solid.enumerate() {
            let is_named = !collider.name.is_empty();
            let name = group_name(&collider.name);
            let same =
                groups.iter_mut().find(|it| is_named && group_name(&it.first.1.name) == name);
            match same {
                Some(group) => {
                    group.count += 1;
                    group.title = name.to_owned();
                }
                None => {
                    let title =
                        if is_named { collider.name.clone() } else { format!("surface {i}") };
                    groups.push(Self { title, first: (*id, collider), count: 1 });
                }
            }
        }
        groups
    }

    /// Returns the visible name: "peg, 132".
    fn text(&self) -> String {
        match self.count {
            1 => self.title.clone(),
            count => format!("{}, {count}", self.title),
        }
    }

    fn edit_restitution(&self, restitution: f64) -> Edit {
        match self.count {
            1 => Edit::ColliderRestitution(self.first.0, restitution),
            _ => Edit::NamedColliderRestitutions(self.title.clone(), restitution),
        }
    }

    fn edit_friction(&self, friction: Friction) -> Edit {
        match self.count {
            1 => Edit::ColliderFriction(self.first.0, friction),
            _ => Edit::NamedColliderFrictions(self.title.clone(), friction),
        }
    }
}

pub(super) fn show(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    let groups = Group::all(view);
    let Some(Group { first: (_, first), .. }) = groups.first() else {
        ui.weak("none that deflects");
        return;
    };
    ui.weak("Bounciness (restitution)").on_hover_text(HINT);
    let has_friction = friction::acts(view);
    if groups.len() > 1 {
        let mut all = first.restitution;
        if slider(ui, "all", "Bounciness (restitution) of all surfaces", &mut all) {
            commands.push(Command::Edit(Edit::AllColliderRestitutions(all)));
        }
        let mut all = first.surface_friction();
        if has_friction && friction::show(ui, "Friction of all", &mut all) {
            commands.push(Command::Edit(Edit::AllColliderFrictions(all)));
        }
    }
    for group in groups.iter().take(LISTED) {
        ui.push_id(("collider", group.first.0), |ui| row(ui, view, group, commands));
    }
}

/// Shows the values of a group.
fn row(ui: &mut Ui, view: &View, group: &Group, commands: &mut Vec<Command>) {
    let (title, collider) = (&group.title, group.first.1);
    let mut restitution = collider.restitution;
    let text = format!("Bounciness (restitution) of {title}");
    if slider(ui, &group.text(), &text, &mut restitution) {
        commands.push(Command::Edit(group.edit_restitution(restitution)));
    }
    if !collider.motion.is_empty() {
        ui.weak(format!("{title}: {}", motion_of(collider)));
    }
    if let Some((ball, of_contact)) = with_picked(view, restitution) {
        ui.weak(format!("with ball {ball}: {of_contact:.2}"));
    }
    if !friction::acts(view) {
        return;
    }
    let mut said = collider.surface_friction();
    if friction::show(ui, &format!("Friction of {title}"), &mut said) {
        commands.push(Command::Edit(group.edit_friction(said)));
    }
}

/// Returns the parts of the motion of a collider in words.
pub(super) fn motion_of(collider: &Collider) -> String {
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
        Motion::Keyframes { ref times, repeat, .. } => {
            let again = if repeat { ", again and again" } else { "" };
            format!("moves through {} keyframes{again}", times.len())
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
        name(ui, title, HINT);
        let before = *restitution;
        ui.spacing_mut().slider_width = SLIDER_WIDTH;
        let response = ui.add(Slider::new(restitution, 0.0..=1.0).max_decimals(4));
        let is_handled = response.dragged() || response.clicked() || response.has_focus();
        let is_handled = is_handled || response.lost_focus() || response.drag_stopped();
        let is_asked =
            |action| ui.input(|input| input.has_accesskit_action_request(response.id, action));
        let is_handled = is_handled
            || [Action::SetValue, Action::Increment, Action::Decrement].into_iter().any(is_asked);
        response.widget_info(|| egui::WidgetInfo::slider(true, *restitution, text));
        response.on_hover_text(HINT);
        // A slider rounds its value; the change counts only if the user moves it.
        is_handled && *restitution != before
    })
    .inner
}
