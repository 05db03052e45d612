//! Checkpoints: a world read from bytes continues exactly as the world that was written.
#![cfg(feature = "checkpoint")]
#![allow(missing_docs)]

use carom::{
    Collider, Contact, DVec3, Emitter, Error, Exact, Force, Pose, Rule, Settings, Shape, Sphere,
    SphereState, World,
};
use carom_scene::{BUILT_IN_FILES, Checkpoint, CheckpointError, Palette, Scene};

/// Checkpoint of a world, with any scene.
fn checkpoint(world: &World) -> Checkpoint {
    let ball = "[[spheres]]\nposition = [0, 1, 0]\nradius = 0.5\n";
    let scene = Scene::from_toml(ball, "ball.toml").unwrap();
    let palette = Palette::new(&scene).unwrap();
    Checkpoint { snapshot: world.snapshot(), scene, palette }
}

/// World restored from the bytes of another one.
fn twin(world: &World) -> World {
    let bytes = checkpoint(world).to_bytes().unwrap();
    let Checkpoint { snapshot, .. } = Checkpoint::from_bytes(&bytes).unwrap();
    assert_eq!(snapshot.time(), world.time());
    let mut twin = World::default();
    twin.restore(&snapshot);
    assert_eq!(twin.state_hash(), world.state_hash());
    twin
}

/// Steps both worlds and compares them after each frame.
#[track_caller]
fn assert_go_on_alike(world: &mut World, twin: &mut World, frames: u32, dt: f64, about: &str) {
    for frame in 0..frames {
        let impacts = world.step(dt).unwrap().impacts.clone();
        let of_twin = &twin.step(dt).unwrap().impacts;
        let differs = impacts.iter().zip(of_twin).position(|(one, other)| one != other);
        assert_eq!(differs, None, "{about}, first other impact of frame {frame}");
        assert_eq!(of_twin.len(), impacts.len(), "{about}, impacts of frame {frame}");
        assert_eq!(twin.state_hash(), world.state_hash(), "{about}, frame {frame}");
    }
    assert_eq!(twin.contacts(), world.contacts(), "{about}");
}

fn scene(file: &str, text: &str, overrides: &[&str]) -> Scene {
    let overrides: Vec<_> = overrides.iter().map(|it| it.parse().unwrap()).collect();
    Scene::from_toml_with(text, file, &overrides).unwrap()
}

/// Runs a scene and compares it with copies that were restored at several frames.
fn assert_twins_go_on_alike(name: &str, overrides: &[&str], frames: &[u32]) {
    let (file, text) = BUILT_IN_FILES.iter().find(|file| file.0 == name).unwrap();
    let scene = scene(file, text, overrides);
    let dt = scene.simulation.frame_time;
    let mut world = scene.world().unwrap();
    let mut eldest: Option<World> = None;
    for &count in frames {
        for _ in 0..count {
            world.step(dt).unwrap();
            if let Some(eldest) = &mut eldest {
                eldest.step(dt).unwrap();
            }
        }
        let mut twin = twin(&world);
        assert_go_on_alike(&mut world, &mut twin, 5, dt, &format!("{name} {overrides:?}"));
        // Also steps the copy that was made first.
        if let Some(eldest) = &mut eldest {
            for _ in 0..5 {
                eldest.step(dt).unwrap();
            }
            assert_eq!(eldest.state_hash(), world.state_hash(), "{name} {overrides:?}");
        }
        eldest.get_or_insert(twin);
    }
}

#[test]
fn every_scene_goes_on_to_the_bit() {
    for (file, _) in BUILT_IN_FILES {
        assert_twins_go_on_alike(file, &[], &[0, 20]);
    }
}

#[test]
fn every_rule_goes_on_to_the_bit() {
    for file in ["simtest3.toml", "simtest6.toml", "tutorial4.toml", "cradle.toml"] {
        for rule in ["discrete", "bisect", "exact", "contact"] {
            assert_twins_go_on_alike(file, &[&format!("simulation.rule={rule}")], &[10, 30, 60]);
        }
    }
}

/// Scenes with stepped zones, persistent clusters and sleeping spheres.
mod heaps_go_on_to_the_bit {
    use super::assert_twins_go_on_alike;

    #[test]
    fn under_exact() {
        assert_twins_go_on_alike("pour.toml", &["simulation.rule=exact"], &[30, 60, 90]);
    }

    #[test]
    fn under_contact() {
        assert_twins_go_on_alike("pour.toml", &["simulation.rule=contact"], &[30, 60, 90]);
    }

    #[test]
    fn under_exact_in_an_hourglass() {
        assert_twins_go_on_alike("hourglass.toml", &["simulation.rule=exact"], &[30, 60, 90]);
    }
}

#[test]
fn the_same_state_has_the_same_bytes() {
    let (file, text) = BUILT_IN_FILES[0];
    let world = scene(file, text, &[]).world().unwrap();
    assert_eq!(checkpoint(&world).to_bytes(), checkpoint(&world.clone()).to_bytes());
}

#[test]
fn an_emitter_goes_on_where_it_was() {
    let mut world = World::default();
    let ball = Sphere::new(DVec3::ZERO, 0.1).with_velocity(DVec3::X);
    world.add_emitter(Emitter::new(ball, 0.5).with_max_spheres(3)).unwrap();
    for _ in 0..20 {
        world.step(0.1).unwrap();
    }
    let mut twin = twin(&world);
    assert_go_on_alike(&mut world, &mut twin, 40, 0.1, "emitter");
    assert_eq!(twin.spheres().ids(), world.spheres().ids());
}

/// A force defined in user code.
#[derive(Debug)]
struct Spring;

impl Force for Spring {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        -sphere.position
    }
}

#[test]
fn a_force_that_is_code_is_refused_by_its_id() -> Result<(), Error> {
    let mut world = World::default();
    let id = world.add_force(Spring)?;
    let refused = checkpoint(&world).to_bytes();
    assert_eq!(refused, Err(CheckpointError::ForeignForce(id)));
    Ok(())
}

#[test]
fn damaged_bytes_are_refused_wherever_the_damage_is() {
    let mut world =
        World::new(Settings::default().with_rule(Rule::Contact(Contact::default()))).unwrap();
    for place in 0..6u8 {
        world.add_sphere(Sphere::new(DVec3::X * f64::from(place), 0.5)).unwrap();
    }
    world.step(0.1).unwrap();
    let bytes = checkpoint(&world).to_bytes().unwrap();
    for length in 0..bytes.len() {
        assert!(Checkpoint::from_bytes(&bytes[..length]).is_err(), "cut at {length}");
    }
    for place in 0..bytes.len() {
        let mut other = bytes.clone();
        other[place] ^= 0x10;
        assert!(Checkpoint::from_bytes(&other).is_err(), "changed at {place}");
    }
    let mut longer = bytes.clone();
    longer.push(0);
    assert_eq!(Checkpoint::from_bytes(&longer).err(), Some(CheckpointError::Damaged));
    assert_eq!(Checkpoint::from_bytes(b"[scene]").err(), Some(CheckpointError::NoCheckpoint));
}

#[test]
fn another_version_is_named() {
    let mut bytes = checkpoint(&World::default()).to_bytes().unwrap();
    // The first digit of the version follows the magic bytes and its own length.
    bytes[9] = b'9';
    let error = Checkpoint::from_bytes(&bytes).unwrap_err();
    assert!(matches!(&error, CheckpointError::OtherVersion { found } if found.starts_with('9')));
    assert!(error.to_string().contains("only the same version reads it"), "{error}");
}

#[test]
fn another_layout_is_another_version() {
    let lengths = [Rule::from(Exact::default()), Contact::default().into()].map(|rule| {
        let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
        for place in [0.0, 1.0] {
            world.add_sphere(Sphere::new(DVec3::X * place, 0.5).with_friction(0.5)).unwrap();
        }
        world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::NEG_Y))).unwrap();
        world.step(0.1).unwrap();
        let checkpoint = checkpoint(&world);
        checkpoint.to_bytes().unwrap().len() - checkpoint.scene.to_toml().len()
    });
    // If these change, the layout has changed: increase the version in checkpoint.rs.
    assert_eq!(lengths, [4243, 3332]);
}
