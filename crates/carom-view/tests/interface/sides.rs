//! Two pictures side by side, each with its own rule.

use carom_scene::scene::{ImpactLaw, Rule};
use carom_session::Command;
use egui::Key;
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, go_to, press, scene, watching};

fn rules(desk: &Desk) -> [Option<Rule>; 2] {
    let view = scene(desk).view();
    let other = view.other.as_ref().map(|it| it.setup.simulation.rule);
    [Some(view.setup.simulation.rule), other]
}

#[test]
fn each_half_has_its_rule_and_time_is_kept() {
    let mut desk = watching("simtest1");
    go_to(&mut desk, 2.0);
    press(&mut desk, Key::X);
    desk.run_steps(20);
    assert_eq!(scene(&desk).view().frame, 100);
    assert_eq!(rules(&desk), [Some(Rule::Discrete), Some(Rule::Exact)]);
    desk.get_by_label("Rule of the right picture").click();
    desk.run_steps(4);
    desk.get_by_label("contact").click();
    desk.run_steps(30);
    assert_eq!(rules(&desk), [Some(Rule::Discrete), Some(Rule::Contact)]);
    assert_eq!(scene(&desk).view().frame, 100);
    press(&mut desk, Key::X);
    desk.run_steps(20);
    assert_eq!((rules(&desk), scene(&desk).view().frame), ([Some(Rule::Discrete), None], 100));
}

#[test]
fn curves_of_two_rules_say_whose_they_are() {
    let mut desk = watching("tutorial1");
    for key in [Key::X, Key::G] {
        press(&mut desk, key);
    }
    for name in ["total, exact", "total, bisect"] {
        assert!(desk.query_by_label_contains(name).is_some(), "{name}");
    }
    press(&mut desk, Key::L);
    desk.get_by_label_contains("Of the left picture");
}

#[test]
fn each_half_says_how_much_energy_its_rule_keeps() {
    let mut desk = watching("tutorial3");
    press(&mut desk, Key::X);
    go_to(&mut desk, 3.0);
    desk.run_steps(3);
    let kept = desk.query_all_by_label_contains("energy kept: ");
    let kept: Vec<String> = kept.map(|it| it.value().unwrap_or_default()).collect();
    assert_eq!(kept.len(), 2, "{kept:?}");
    let of_exact = scene(&desk).view().setup.simulation.rule == Rule::Exact;
    assert_eq!(kept[usize::from(!of_exact)], "energy kept: 100 %", "{kept:?}");
}

#[test]
fn a_nudge_shows_a_copy_beside_the_run_and_how_the_distance_grows() {
    let mut desk = watching("tutorial3");
    go_to(&mut desk, 0.1);
    press(&mut desk, Key::N);
    desk.run_steps(4);
    let both = rules(&desk);
    assert_eq!(both[1], both[0]);
    assert_eq!(scene(&desk).view().frame, 6);
    desk.get_by_label_contains("Distance of the two, m");
    go_to(&mut desk, 4.0);
    let distances = &scene(&desk).view().distances;
    let [first, last] = [distances.first(), distances.last()].map(|it| it.expect("one").largest);
    assert!(first > 0.0 && last > 2.0 * first, "{first:e} {last:e}");
}

#[test]
fn settings_of_one_half_are_chosen_there_and_the_other_half_keeps_its_own() {
    let mut desk = watching("tutorial1");
    // With two exact simulations, both halves show the settings of that rule.
    let mut simulation = scene(&desk).view().setup.simulation.clone();
    simulation.rule = Rule::Exact;
    let pair = Box::new([simulation.clone(), simulation]);
    desk.state_mut().command(Command::Compare(Some(pair)));
    press(&mut desk, Key::I);
    go_to(&mut desk, 0.5);
    desk.get_all_by_label("Settings").last().expect("of the right half").click();
    desk.run_steps(4);
    desk.get_all_by_label("Impacts (impact law)").last().expect("a choice").click();
    desk.run_steps(4);
    desk.get_by_label("sequential").click();
    desk.run_steps(30);
    let view = scene(&desk).view();
    let laws = [view, view.other.as_ref().expect("two")]
        .map(|side| side.setup.simulation.exact.impact_law);
    assert_eq!(laws, [ImpactLaw::default(), ImpactLaw::Sequential]);
    assert_eq!(view.frame, 30, "time is kept");
}
