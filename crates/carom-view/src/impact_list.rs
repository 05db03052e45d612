//! The last impacts as a table.

use carom::{BodyPair, ColliderId};
use carom_session::{Command, ListedImpact, View};
use egui::{Grid, ScrollArea, Ui};

/// Largest number of rows: as many as a reader can take in.
const ROWS: usize = 60;

/// Shows the last impacts, newest first; a click picks the ball.
pub fn show(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    if view.other.is_some() {
        ui.strong(format!("Of the left picture, {}", view.setup.simulation.rule));
    }
    ui.weak("Energy is that of all impacts at the same instant, where the rule keeps account.");
    ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        Grid::new("impacts").num_columns(5).striped(true).spacing([14.0, 3.0]).show(ui, |ui| {
            for title in ["Time, s", "Bodies", "Approach, m/s", "Impulse, N s", "Energy, J"] {
                ui.strong(title);
            }
            ui.end_row();
            for impact in view.impacts.iter().rev().take(ROWS) {
                ui.monospace(format!("{:.6}", impact.time));
                let (text, ball) = match impact.between {
                    BodyPair::Spheres(first, second) => (format!("{first} - {second}"), second),
                    BodyPair::Collider { collider, sphere } => {
                        (format!("{} - {sphere}", name_of(view, collider)), sphere)
                    }
                };
                if ui.link(text).on_hover_text("Pick this ball").clicked() {
                    commands.push(Command::Pick(Some(ball)));
                }
                ui.monospace(format!("{:.4}", impact.approach_speed));
                ui.monospace(format!("{:.4e}", impact.impulse));
                match impact.energy_change {
                    Some(change) => ui.monospace(format!("{change:+.3e}")),
                    None => ui.weak("-"),
                };
                ui.end_row();
            }
        });
    });
}

/// Returns a sentence about the hardest impact after a time \[s\], for people who do not see the picture; `None`
/// without an impact. In a row of touching balls, only the first impact has a speed of approach.
pub fn hardest_after(view: &View, time: f64) -> Option<String> {
    let work = |impact: &ListedImpact| impact.impulse * impact.approach_speed;
    let after = view.impacts.iter().filter(|it| it.time > time && work(it) > 0.0);
    let hardest = after.max_by(|a, b| work(a).total_cmp(&work(b)))?;
    Some(sentence(view, hardest))
}

fn sentence(view: &View, impact: &ListedImpact) -> String {
    let speed = impact.approach_speed;
    match impact.between {
        BodyPair::Spheres(first, second) => {
            format!("ball {first} hit ball {second}, {speed:.2} m/s")
        }
        BodyPair::Collider { collider, sphere } => {
            format!("ball {sphere} hit {}, {speed:.2} m/s", name_of(view, collider))
        }
    }
}

/// Returns the name of a collider for users.
fn name_of(view: &View, collider: ColliderId) -> &str {
    let known = view.setup.colliders.iter().find(|(id, _)| *id == collider);
    let name = known.map_or("", |(_, collider)| collider.name.as_str());
    if name.is_empty() { "surface" } else { name }
}
