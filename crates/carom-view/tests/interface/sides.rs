//! Two pictures side by side, each with its own rule.

use carom_scene::scene::Rule;
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
