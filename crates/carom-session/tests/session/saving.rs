//! The present as a scene.

use carom::World;
use carom_scene::scene::Rule;
use carom_scene::{Library, Scene};
use carom_session::{Edit, Session, View};

use crate::{built_in, busy, busy_scene, hashes};

/// Compares spheres and colliders of two worlds bit for bit, without the ids of spheres. `Debug`
/// formats numbers exactly, and distinguishes -0 from 0.
fn assert_same(one: &World, other: &World) {
    let text = |world: &World| {
        let spheres: Vec<_> = (0..world.spheres().len()).map(|i| world.spheres().get(i)).collect();
        let colliders: Vec<_> = world.colliders().map(|(_, collider)| collider.clone()).collect();
        let forces: Vec<_> = world.forces().map(|it| format!("{:?}", it.1)).collect();
        let emitters: Vec<_> = world.emitters().map(|(_, emitter)| *emitter).collect();
        format!("{:?} {spheres:?} {colliders:?} {forces:?} {emitters:?}", world.settings())
    };
    assert_eq!(text(one), text(other));
}

#[test]
fn the_present_opened_again_is_the_same_world() {
    for name in ["simtest1", "simtest4", "simtest6", "tutorial1", "tutorial4"] {
        let mut session = built_in(name);
        hashes(&mut session, 40);
        let scene = session.scene_now();
        assert_same(session.world(), &scene.world().unwrap());
        let read = Scene::from_toml(&scene.to_toml(), name).unwrap();
        assert_eq!(read, scene, "{name}");
        assert_same(session.world(), &read.world().unwrap());
    }
}

#[test]
fn what_was_edited_is_in_the_file() {
    let mut session = busy();
    hashes(&mut session, 50);
    let force = session.setup().forces[1].0;
    session.edit(Edit::RemoveForce(force)).unwrap();
    session.edit(Edit::AllColliderRestitutions(0.3)).unwrap();
    session.edit(Edit::FrameTime(0.005)).unwrap();
    hashes(&mut session, 5);
    let scene = Scene::from_toml(&session.scene_now().to_toml(), "saved").unwrap();
    assert_same(session.world(), &scene.world().unwrap());
    assert_eq!(scene.simulation.frame_time, 0.005);
    assert_eq!(scene.colliders[1].name, "paddle");
    // The colours are the present ones.
    let again = Session::new(scene).unwrap();
    let colors = |session: &Session| {
        let mut view = View::default();
        session.fill(&mut view);
        view.spheres.paints
    };
    assert_eq!(colors(&session), colors(&again));
}

#[test]
fn spheres_that_overlap_can_be_saved() {
    // Under a rule that finds contacts late, spheres overlap.
    let mut scene = busy_scene();
    scene.simulation.rule = Rule::Discrete;
    let mut session = Session::new(scene).unwrap();
    hashes(&mut session, 200);
    assert!(!session.world().overlaps(1e-6).is_empty(), "the example shows nothing");
    let scene = session.scene_now();
    assert!(scene.simulation.allow_overlap);
    Scene::from_toml(&scene.to_toml(), "saved").unwrap();
}

#[test]
fn every_built_in_scene_can_be_opened_stepped_and_saved() {
    for entry in Library::new().entries().unwrap() {
        let mut session = Session::new(entry.scene.unwrap()).unwrap();
        hashes(&mut session, 2);
        Scene::from_toml(&session.scene_now().to_toml(), &entry.name).unwrap();
    }
}
