//! Settings of the simulation.

use carom_scene::scene::{CombineRule, ImpactLaw, Integrator, Rule, Simulation, Zones};
use carom_session::{Command, Edit, View};
use egui::{ComboBox, Ui};

use super::value::{Field, count, name, number};

pub(super) fn show(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    let mut simulation: Simulation = view.setup.simulation.clone();
    // In a comparison each side has its own rule, chosen over its picture.
    if view.other.is_none() {
        choice(ui, "rule", &RULES, &mut simulation.rule);
    }
    edit(ui, &mut simulation);
    if simulation != view.setup.simulation {
        commands.push(Command::Edit(Edit::Simulation(Box::new(simulation))));
    }
}

const RULES: [(Rule, &str); 4] = [
    (Rule::Exact, "exact"),
    (Rule::Contact, "contact"),
    (Rule::Bisect, "bisect"),
    (Rule::Discrete, "discrete"),
];

/// Shows all settings but the rule.
pub fn edit(ui: &mut Ui, simulation: &mut Simulation) {
    const INTEGRATORS: [(Integrator, &str); 4] = [
        (Integrator::SemiImplicitEuler, "semi-implicit Euler"),
        (Integrator::ExplicitEuler, "explicit Euler"),
        (Integrator::VelocityVerlet, "velocity Verlet"),
        (Integrator::RungeKutta4, "Runge-Kutta 4"),
    ];
    const LAWS: [(ImpactLaw, &str); 3] = [
        (ImpactLaw::Reflection, "reflection"),
        (ImpactLaw::Simultaneous, "simultaneous"),
        (ImpactLaw::Sequential, "sequential"),
    ];
    const ZONES: [(Zones, &str); 2] = [(Zones::Automatic, "automatic"), (Zones::Never, "never")];
    const COMBINE_RULES: [(CombineRule, &str); 5] = [
        (CombineRule::Product, "product"),
        (CombineRule::Minimum, "minimum"),
        (CombineRule::Maximum, "maximum"),
        (CombineRule::Average, "average"),
        (CombineRule::GeometricMean, "geometric mean"),
    ];
    match simulation.rule {
        Rule::Exact => {
            choice(ui, "impact law", &LAWS, &mut simulation.exact.impact_law);
            choice(ui, "stepped zones", &ZONES, &mut simulation.exact.zones);
        }
        Rule::Bisect => {
            choice(ui, "integrator", &INTEGRATORS, &mut simulation.bisect.integrator);
        }
        Rule::Discrete => {
            choice(ui, "integrator", &INTEGRATORS, &mut simulation.discrete.integrator);
        }
        Rule::Contact => {
            count(ui, "sub-steps", &mut simulation.contact.sub_steps);
            count(ui, "sweeps", &mut simulation.contact.sweeps);
        }
    }
    if simulation.rule.has_friction() {
        choice(ui, "friction", &COMBINE_RULES, &mut simulation.friction_combine_rule);
    }
    number(ui, Field::positive("frame time", "s"), &mut simulation.frame_time);
    choice(ui, "restitution", &COMBINE_RULES, &mut simulation.combine_rule);
    ui.checkbox(&mut simulation.spheres_collide, "balls collide with each other");
}

fn choice<T: Copy + PartialEq>(ui: &mut Ui, title: &str, all: &[(T, &str)], value: &mut T) {
    let text = all.iter().find(|(it, _)| it == value).map_or("", |(_, text)| text);
    ui.horizontal(|ui| {
        let label = name(ui, title);
        let shown = ComboBox::from_id_salt(title).selected_text(text).show_ui(ui, |ui| {
            for (it, text) in all {
                ui.selectable_value(value, *it, *text);
            }
        });
        shown.response.labelled_by(label.id);
    });
}
