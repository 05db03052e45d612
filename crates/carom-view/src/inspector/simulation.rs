//! Settings of the simulation.

use carom_scene::scene::{CombineRule, ImpactLaw, Integrator, Rule, Simulation, Zones};
use carom_session::{Command, Edit, View};
use egui::{CollapsingHeader, ComboBox, Role, Ui, WidgetInfo};

use super::value::{Field, count, name, number, tick};

/// Width of a menu of a row, in points.
const MENU_WIDTH: f32 = 118.0;

pub(super) fn show(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    let mut simulation: Simulation = view.setup.simulation.clone();
    // In a comparison each side has its own rule, chosen over its picture.
    if view.other.is_none() {
        choice(ui, ("Method (rule)", RULE), &RULES, &mut simulation.rule);
    }
    collide(ui, &mut simulation);
    CollapsingHeader::new("More settings").show(ui, |ui| rare(ui, &mut simulation));
    if simulation != view.setup.simulation {
        commands.push(Command::Edit(Edit::Simulation(Box::new(simulation))));
    }
}

const RULE: &str = "How the motion is computed. exact: from event to event; contact: for heaps and \
                    games; bisect and discrete: as in the two courses";

const RULES: [(Rule, &str); 4] = [
    (Rule::Exact, "exact"),
    (Rule::Contact, "contact"),
    (Rule::Bisect, "bisect"),
    (Rule::Discrete, "discrete"),
];

/// Shows all settings but the rule.
pub fn edit(ui: &mut Ui, simulation: &mut Simulation) {
    collide(ui, simulation);
    rare(ui, simulation);
}

fn collide(ui: &mut Ui, simulation: &mut Simulation) {
    let hint = "Otherwise balls pass through each other and meet surfaces only";
    tick(ui, "Balls collide with each other", hint, &mut simulation.spheres_collide);
}

/// Shows settings that are rarely changed.
fn rare(ui: &mut Ui, simulation: &mut Simulation) {
    const INTEGRATORS: [(Integrator, &str); 4] = [
        (Integrator::SemiImplicitEuler, "semi-implicit Euler"),
        (Integrator::ExplicitEuler, "explicit Euler"),
        (Integrator::VelocityVerlet, "velocity Verlet"),
        (Integrator::RungeKutta4, "Runge-Kutta 4"),
    ];
    const INTEGRATOR: (&str, &str) =
        ("Motion (integrator)", "How velocities and positions follow from forces in a frame");
    const LAWS: [(ImpactLaw, &str); 3] = [
        (ImpactLaw::Reflection, "reflection"),
        (ImpactLaw::Simultaneous, "simultaneous"),
        (ImpactLaw::Sequential, "sequential"),
    ];
    const LAW: (&str, &str) =
        ("Impacts (impact law)", "How impacts of several balls at the same instant are answered");
    const ZONES: [(Zones, &str); 2] = [(Zones::Automatic, "automatic"), (Zones::Never, "never")];
    const HEAPS: (&str, &str) =
        ("Heaps (stepped zones)", "Whether large heaps are stepped, where exact events are many");
    const COMBINE_RULES: [(CombineRule, &str); 5] = [
        (CombineRule::Product, "product"),
        (CombineRule::Minimum, "minimum"),
        (CombineRule::Maximum, "maximum"),
        (CombineRule::Average, "average"),
        (CombineRule::GeometricMean, "geometric mean"),
    ];
    match simulation.rule {
        Rule::Exact => {
            choice(ui, LAW, &LAWS, &mut simulation.exact.impact_law);
            choice(ui, HEAPS, &ZONES, &mut simulation.exact.zones);
        }
        Rule::Bisect => {
            choice(ui, INTEGRATOR, &INTEGRATORS, &mut simulation.bisect.integrator);
        }
        Rule::Discrete => {
            choice(ui, INTEGRATOR, &INTEGRATORS, &mut simulation.discrete.integrator);
        }
        Rule::Contact => {
            let sub_steps = Field::any("Steps (sub-steps)", "").hint("Parts of each frame");
            count(ui, sub_steps, &mut simulation.contact.sub_steps);
            let sweeps =
                Field::any("Passes (sweeps)", "").hint("Passes of the solver in each step");
            count(ui, sweeps, &mut simulation.contact.sweeps);
        }
    }
    if simulation.rule.has_friction() {
        let of_pair = ("Friction of a pair", "How the friction of two bodies is combined");
        choice(ui, of_pair, &COMBINE_RULES, &mut simulation.friction_combine_rule);
    }
    let of_pair = ("Bounciness of a pair", "How the restitution of two bodies is combined");
    choice(ui, of_pair, &COMBINE_RULES, &mut simulation.combine_rule);
    let frame_time = Field::positive("Frame time", "s").hint("Simulated time between two pictures");
    number(ui, frame_time, &mut simulation.frame_time);
}

/// Shows a row with a menu, named by what it sets; the second text is its tooltip.
fn choice<T: Copy + PartialEq>(
    ui: &mut Ui,
    (title, hint): (&str, &str),
    all: &[(T, &str)],
    value: &mut T,
) {
    let text = all.iter().find(|(it, _)| it == value).map_or("", |(_, text)| text);
    ui.horizontal(|ui| {
        name(ui, title, hint);
        let combo = ComboBox::from_id_salt(title).selected_text(text).width(MENU_WIDTH).truncate();
        let shown = combo.show_ui(ui, |ui| {
            for (it, text) in all {
                ui.selectable_value(value, *it, *text);
            }
        });
        shown.response.widget_info(|| WidgetInfo {
            current_text_value: Some(text.to_owned()),
            ..WidgetInfo::labeled(Role::ComboBox, true, title)
        });
        shown.response.on_hover_text(hint);
    });
}
