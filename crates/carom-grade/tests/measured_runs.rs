//! Runs of an independent simulator: wrong numbers, alone and in pairs, are measured; tables in
//! another form and tables with scatter are recognised as such.

#[path = "common/planting.rs"]
mod planting;
#[path = "common/simulator.rs"]
mod simulator;

use carom_grade::{Course, Grader, Verdict};
use planting::{EXACT, Table, grade, read, said, scene, table, verdict};
use simulator::{Plan, simulate};

fn wrong(numbers: &[(&'static str, f64)]) -> Plan {
    Plan {
        numbers: numbers.iter().map(|(name, value)| (*name, vec![*value])).collect(),
        ..Plan::default()
    }
}

/// Checks that a verdict names this, that it explains all rows, and that the table is not called
/// the same.
fn names(verdict: &Verdict, expected: &str) {
    let said = said(verdict);
    assert!(!verdict.same && said.contains(expected), "{expected}: {said}");
    assert!(verdict.explanations[0].fit.is_complete(), "{said}");
}

#[test]
fn the_simulator_without_mistakes_is_the_same_as_the_rule() {
    for number in 1..=6 {
        let verdict = verdict(&format!("simtest{number}"), &Plan::default(), 12.0, EXACT);
        assert!(verdict.same && verdict.digits.unwrap() >= 9, "{}", said(&verdict));
    }
}

#[test]
fn a_wrong_number_is_named_with_its_value_to_three_digits() {
    for (scene, number, value, expected) in [
        ("simtest3", "time step", 0.04, "time step 0.0400 s (0.02 s expected)"),
        ("simtest3", "frame time", 0.01, "length of a frame 0.0100 s (0.02 s expected)"),
        ("simtest3", "drag", 0.5, "drag coefficient 0.500 kg/s (0.25 kg/s expected)"),
        ("simtest3", "mass", 2.0, "mass 2.00 kg (1 kg expected)"),
        ("simtest3", "force", 9.8, "constant force 9.80 N (20 N expected)"),
        ("simtest1", "restitution 0", 0.9, "restitution of PlaneCollider 0.900 (0.8 expected)"),
        ("simtest5", "restitution", 0.6, "restitution of every collider 0.600 (0.75 expected)"),
        ("simtest1", "period", 0.72, "emitter period 0.720 s (0.7 s expected)"),
        ("simtest6", "radius", 0.45, "radius 0.450 m (0.5 m expected)"),
        ("simtest2", "tangential", 0.9, "tangential factor 0.900 (1 expected)"),
    ] {
        names(&verdict(scene, &wrong(&[(number, value)]), 8.0, EXACT), expected);
    }
}

#[test]
fn a_wrong_initial_velocity_is_named_with_three_coordinates() {
    let plan = Plan { numbers: vec![("velocity", vec![0.5, 0.0, -1.25])], ..Plan::default() };
    let expected = "initial velocity (0.500, 0.000, -1.25) m/s ((0, 0, 0) m/s expected)";
    names(&verdict("simtest3", &plan, 6.0, EXACT), expected);
}

#[test]
fn two_wrong_numbers_are_named_together() {
    let plan = wrong(&[("force", 9.81), ("restitution 0", 0.9)]);
    let verdict = verdict("simtest3", &plan, 4.0, EXACT);
    names(&verdict, "constant force 9.81 N (20 N expected) + restitution of PlaneCollider 0.900");
}

#[test]
fn a_known_mistake_and_a_wrong_number_are_named_together() {
    let plan = Plan { slips: vec!["restitution-whole"], ..wrong(&[("drag", 0.1)]) };
    let verdict = verdict("simtest3", &plan, 4.0, EXACT);
    names(&verdict, "restitution-whole + drag coefficient 0.100 kg/s (0.25 kg/s expected)");
}

#[test]
fn numbers_that_a_run_cannot_tell_apart_are_named_together() {
    // Without drag, only the ratio of force and mass can be seen.
    let verdict = verdict("simtest1", &wrong(&[("mass", 2.0)]), 6.0, EXACT);
    names(&verdict, "this run cannot tell them apart");
    let said = said(&verdict);
    assert!(said.contains("mass 2.00 kg") && said.contains("constant force 10.0 N"), "{said}");
}

#[test]
fn tables_in_another_form_are_the_same() {
    type Form = fn(f64, [f64; 3]) -> (f64, [f64; 3]);
    let forms: [(&str, Form, &str); 9] = [
        ("simtest1", |t, [x, y, z]| (t, [-x, y, z]), "x mirrored"),
        ("simtest3", |t, [x, y, z]| (t, [x, y, -z]), "z mirrored (--unity)"),
        ("simtest3", |t, [x, y, z]| (t, [x, z, y]), "y and z swapped (--columns y=z,z=y)"),
        ("simtest6", |t, [x, y, z]| (t, [y, z, x]), "another order (--columns x=z,y=x,z=y)"),
        ("simtest3", |t, x| ((t / 0.02).round(), x), "time in frames (--time-unit frames)"),
        ("simtest5", |t, x| (1e3 * t, x), "time in milliseconds (--time-unit ms)"),
        ("simtest5", |t, x| (t, x.map(|it| 1e2 * it)), "lengths in cm (--length-unit cm)"),
        ("simtest3", |t, x| (t + 0.5, x), "-0.500 s added to its times (--time-offset -0.500)"),
        ("simtest4", |t, [x, y, z]| (t, [x - 1.5, y, z]), "(1.5000, 0.0000, 0.0000) m added"),
    ];
    for (name, form, expected) in forms {
        let scene = scene(name);
        let verdict = grade(&scene, &table(&simulate(&scene, &Plan::default(), 5.0), EXACT, form));
        assert!(verdict.same && verdict.headline().contains(expected), "{}", said(&verdict));
    }
}

#[test]
fn a_mistake_is_named_in_a_table_of_another_form() {
    let scene = scene("simtest3");
    let plan = Plan { slips: vec!["explicit-euler"], ..Plan::default() };
    let form = |t: f64, [x, y, z]: [f64; 3]| ((t / 0.02).round(), [x, z, y]);
    let verdict = grade(&scene, &table(&simulate(&scene, &plan, 6.0), EXACT, form));
    names(&verdict, "mistake: explicit-euler");
    assert!(verdict.headline().contains("y and z swapped"), "{}", verdict.headline());
    assert!(verdict.headline().contains("time in frames"), "{}", verdict.headline());
}

#[test]
fn scatter_is_recognised_with_its_size_and_the_tolerance_that_allows_it() {
    let style = Table { scatter: 1e-3, ..EXACT };
    let scene = scene("simtest3");
    let text = table(&simulate(&scene, &Plan::default(), 8.0), style, |t, x| (t, x));
    let verdict = grade(&scene, &text);
    let expected = "scatter: 1.0 mm in each coordinate; --tolerance 0.006 allows it";
    assert!(!verdict.same && said(&verdict).contains(expected), "{}", said(&verdict));
    // With that tolerance, the run is the same.
    let mut grader = Grader::new(Course::of(&scene).unwrap(), 0.006);
    assert!(grader.grade(&read(&text)).verdict.same);
}

#[test]
fn a_mistake_is_named_in_spite_of_scatter() {
    let style = Table { scatter: 2e-3, every: 2, ..EXACT };
    let plan = Plan { slips: vec!["one-forgotten"], ..Plan::default() };
    let verdict = verdict("simtest3", &plan, 8.0, style);
    names(&verdict, "mistake: one-forgotten");
    // The estimate from some thousand numbers.
    let scatter = verdict.scatter.unwrap();
    assert!((scatter.deviation - 2e-3).abs() < 2e-4, "{}", said(&verdict));
}

#[test]
fn a_wrong_number_is_measured_in_spite_of_scatter() {
    let verdict =
        verdict("simtest3", &wrong(&[("force", 9.8)]), 6.0, Table { scatter: 1e-3, ..EXACT });
    names(&verdict, "constant force 9.80 N (20 N expected)");
}
