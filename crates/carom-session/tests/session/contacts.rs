//! Persistent contacts in views: they exist while they are requested and the rule knows them. The
//! tests of the world check their forces.

use carom::DVec3;
use carom_scene::Scene;
use carom_scene::scene::Rule;
use carom_session::{Command, Comparison, Driver, Edit, Session};

/// A ball of 2 kg at rest on the floor.
const RESTING: &str = r#"
name = "resting"
forces = [{ gravity = { acceleration = [0.0, -10.0, 0.0] } }]

[[colliders]]
shape = "half-space"
restitution = 0.0

[[spheres]]
position = [0.0, 1.0, 0.0]
radius = 1.0
mass = 2.0
restitution = 0.0
"#;

fn resting() -> Scene {
    Scene::from_toml(RESTING, "resting").unwrap()
}

/// Number of contacts in the view after these commands.
fn contacts_after(driver: &mut Driver, commands: impl IntoIterator<Item = Command>) -> usize {
    commands.into_iter().for_each(|command| driver.send(command).unwrap());
    driver.update(0.0, || false);
    driver.view().contacts.len()
}

#[test]
fn views_have_contacts_while_they_are_asked_for() {
    let mut driver = Driver::inline(Session::new(resting()).unwrap());
    assert_eq!(contacts_after(&mut driver, [Command::Step]), 0);
    assert_eq!(contacts_after(&mut driver, [Command::ShowContacts(true)]), 1);
    let [contact] = driver.view().contacts[..] else { panic!("{:?}", driver.view().contacts) };
    assert!((contact.normal_force - 20.0).abs() < 1e-12, "{contact:?}");
    assert_eq!(contact.normal, DVec3::Y);
    assert_eq!(contacts_after(&mut driver, [Command::ShowContacts(false)]), 0);
}

#[test]
fn no_contact_is_shown_where_none_is_known() {
    let mut driver = Driver::inline(Session::new(resting()).unwrap());
    assert_eq!(contacts_after(&mut driver, [Command::ShowContacts(true)]), 0, "no step yet");
    assert_eq!(contacts_after(&mut driver, [Command::Step, Command::Step]), 1);
    assert_eq!(contacts_after(&mut driver, [Command::StepBack]), 1);
    assert_eq!(contacts_after(&mut driver, [Command::StepBack]), 0, "back at the beginning");
    assert_eq!(contacts_after(&mut driver, [Command::Step]), 1);
    let id = driver.view().spheres.ids[0];
    let removed = Command::Edit(Edit::RemoveSphere(id));
    assert_eq!(contacts_after(&mut driver, [removed]), 0);
}

#[test]
fn each_of_two_rules_shows_its_own_contacts() {
    let comparison = Comparison::new(&resting(), [Rule::Discrete, Rule::Exact]).unwrap();
    let mut driver = Driver::inline(comparison);
    assert_eq!(contacts_after(&mut driver, [Command::ShowContacts(true), Command::Step]), 0);
    let other = driver.view().other.as_ref().unwrap();
    assert_eq!(other.contacts.len(), 1);
}
