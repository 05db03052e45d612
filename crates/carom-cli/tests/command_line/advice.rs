//! What the summary says beyond its table: how a run broke its rule, and what helps.

use serde_json::Value;

use crate::command::{bad, good, path};
use crate::summary;

/// A ball with backspin that falls on a floor with friction.
const BACKSPIN: &str = r#"
name = "backspin"
forces = [{ gravity = { acceleration = [0.0, -9.81, 0.0] } }]
spheres = [{ position = [0, 0.3, 0], velocity = [2, 0, 0], angular_velocity = [0, 0, 60], radius = 0.1 }]
colliders = [{ shape = "half-space", restitution = 0.5, friction = 0.3 }]
"#;

#[test]
fn the_rule_contact_tells_what_it_did_to_energy() {
    let folder = tempfile::tempdir().unwrap();
    let scene = path(&folder, "backspin.toml");
    std::fs::write(&scene, BACKSPIN).unwrap();
    let run = ["run", &scene, "--rule", "contact", "--seconds", "1"];
    let figures = summary(&run);
    let (contact, balance) = (&figures["contact"], &figures["energy_balance"]);
    let number = |value: &Value| value.as_f64().unwrap();
    let lost = number(&figures["energy_at_start"]) - number(&figures["energy_at_end"]);
    assert!(number(&balance["contacts"]) < -0.1, "{balance}");
    let of_bodies = ["contacts", "colliders", "kicks", "growth"];
    let others = ["forces", "applied", "correction", "emission", "integration"];
    let entries = of_bodies.iter().chain(&others);
    let accounted: f64 = entries.map(|name| number(&balance[name])).sum();
    assert!((lost + accounted).abs() < 1e-12 * lost, "{lost} J: {balance}");
    // Free flight is exact.
    assert!(number(&balance["integration"]).abs() < 1e-3 * lost, "{lost} J: {balance}");
    assert!((0.0..=1.0).contains(&number(&contact["residual"])), "{contact}");
    assert!(number(&contact["largest_overlap"]) < 0.1);
    assert_eq!((&figures["sub_steps"], &figures["sweeps"]), (&8.into(), &2.into()));
    assert!(figures["work"]["sweeps"].as_u64().unwrap() > 0);
    let text = good(&run);
    for line in ["sub-steps 8, sweeps 2", "  contacts", "  integration", "overlap ", "residual "] {
        assert!(text.contains(line), "{line}: {text}");
    }
    assert!(summary(&["run", &scene, "--seconds", "0.1"])["contact"].is_null());
    let compared = good(&["compare", &scene, "--rules", "exact,contact", "--seconds", "0.1"]);
    assert!(compared.contains("\ncontact "), "{compared}");
}

/// A ball that passes a wall under rules that only check the ends of frames.
const FAST_IN_A_BOX: &str = r#"
name = "fast"
spheres = [{ position = [0, 0, 0], velocity = [200, 0, 0], radius = 0.1 }]
colliders = [{ name = "crate", shape = { container = { size = [2, 2, 2] } } }]
"#;

#[test]
fn a_ball_that_leaves_a_closed_container_is_named_with_its_time() {
    let folder = tempfile::tempdir().unwrap();
    let scene = path(&folder, "fast.toml");
    std::fs::write(&scene, FAST_IN_A_BOX).unwrap();
    let run = ["run", &scene, "--seconds", "1", "--frame-time", "0.01", "--strict", "--rule"];
    let refusal = bad(&[&run[..], &["discrete"]].concat(), 1);
    let told = "ball 0 has left the closed container crate by 0.0100 s";
    assert!(refusal.contains(told), "{refusal}");
    for rule in ["exact", "contact"] {
        assert!(!good(&[&run[..], &[rule]].concat()).contains("not kept"), "{rule}");
    }
}

/// Balls in a container at a face of the periodic box, and some that do not collide with it.
const NOT_KEPT_IN: &str = r#"
name = "crates"
simulation = { boundary = { periodic = { size = [4, 4, 4] } } }
spheres = [
  { position = [1.8, 0, 0], velocity = [2, 0, 0], radius = 0.1 },
  { position = [1.8, 0.5, 0], velocity = [2, 0, 0], radius = 0.1, groups = 2, collides_with = 2 },
]
colliders = [{ shape = { container = { size = [1, 2, 2] } }, position = [1.9, 0, 0] }]
"#;

#[test]
fn balls_leave_no_container_through_a_periodic_face_nor_one_that_they_do_not_collide_with() {
    let folder = tempfile::tempdir().unwrap();
    let scene = path(&folder, "crates.toml");
    std::fs::write(&scene, NOT_KEPT_IN).unwrap();
    for rule in ["exact", "contact"] {
        let run = good(&["run", &scene, "--seconds", "2", "--strict", "--rule", rule]);
        assert!(!run.contains("not kept"), "{rule}: {run}");
    }
}

/// Balls that fall onto each other in a box of their width.
const STACK: &str = r#"
name = "stack"
forces = [{ gravity = { acceleration = [0.0, -9.81, 0.0] } }]
colliders = [{ shape = { container = { size = [1.02, 12, 1.02], open = "top" } }, position = [0, 6, 0] }]
generators = [{ lattice = { counts = [1, 5, 1], start = [0, 0.6, 0], spacing = [1, 1.1, 1], sphere = { radius = 0.5, restitution = 0.5 } } }]
"#;

#[test]
fn a_heap_under_another_rule_is_advised_to_use_contact() {
    let folder = tempfile::tempdir().unwrap();
    let scene = path(&folder, "stack.toml");
    std::fs::write(&scene, STACK).unwrap();
    let advice = |rule: &str| {
        let figures = summary(&["run", &scene, "--rule", rule, "--seconds", "3"]);
        figures["advice"].as_str().map(str::to_owned)
    };
    for rule in ["discrete", "bisect"] {
        let advice = advice(rule).unwrap_or_default();
        assert!(advice.contains("--rule contact"), "{rule}: {advice}");
    }
    assert_eq!(advice("contact"), None);
    assert!(summary(&["run", "simtest1"])["advice"].is_null());
}

#[test]
fn an_emitter_that_puts_balls_into_others_is_advised_to_leave_them_room() {
    let folder = tempfile::tempdir().unwrap();
    let advice = |more: &str| {
        let scene = path(&folder, "tap.toml");
        let ball = "sphere = { radius = 0.2, velocity = [1, 0, 0] }";
        std::fs::write(&scene, format!("[[emitters]]\n{ball}\n{more}\n")).unwrap();
        let figures = summary(&["run", &scene, "--seconds", "2"]);
        figures["advice"].as_str().map(str::to_owned)
    };
    assert!(advice("period = 0.3").unwrap().contains("`needs_room = true`"));
    assert_eq!(advice("period = 0.3\nneeds_room = true"), None);
    assert_eq!(advice("period = 0.5"), None);
}

#[test]
fn a_scene_in_which_nothing_can_move_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let advice = |text: &str| {
        let scene = path(&folder, "scene.toml");
        std::fs::write(&scene, text).unwrap();
        let figures = summary(&["run", &scene, "--seconds", "0.1"]);
        figures["advice"].as_str().map(str::to_owned)
    };
    let table = "colliders = [{ shape = \"half-space\" }]\n";
    for text in ["", table] {
        let advice = advice(text).unwrap_or_default();
        assert!(advice.contains("no balls"), "{text:?}: {advice}");
    }
    assert_eq!(advice("spheres = [{ radius = 1 }]"), None);
    assert_eq!(advice("emitters = [{ period = 1, sphere = { radius = 1 } }]"), None);
}
