//! Groups, user data, kicks and belts of scene files reach the world, are written again, and wrong ones are refused with
//! their line.

use carom::Groups;
use carom_scene::Scene;

const TEXT: &str = "name = 'game'
[[spheres]]
radius = 0.1
groups = 0b101
collides_with = 0b1
user_data = 42

[[colliders]]
shape = 'half-space'
position = [0, -1, 0]
kick = '150 cm/s'
cushion = 1.7
surface_velocity = ['36 km/h', 0, 0.5]
groups = 0b10

[[emitters]]
period = 1
position = [0, 5, 0]
sphere = { radius = 0.1, groups = 0b10 }
";

fn read(text: &str) -> Scene {
    Scene::from_toml(text, "game.toml").unwrap()
}

#[test]
fn groups_user_data_kicks_and_belts_reach_the_world() {
    let world = read(TEXT).world().unwrap();
    let sphere = world.spheres().get(0);
    assert_eq!(sphere.groups, Groups { groups: 5, collides_with: 1 });
    assert_eq!(sphere.user_data, 42);
    let (_, floor) = world.colliders().next().unwrap();
    assert_eq!((floor.kick, floor.user_data, floor.cushion), (1.5, 0, Some(1.7)));
    assert_eq!(floor.surface_velocity.to_array(), [10.0, 0.0, 0.5]);
    assert_eq!(floor.groups, Groups { groups: 2, collides_with: u32::MAX });
    let (_, emitter) = world.emitters().next().unwrap();
    assert_eq!(emitter.sphere.groups.groups, 2);
}

#[test]
fn a_written_scene_has_them_again_and_no_defaults() {
    let scene = read(TEXT);
    let written = scene.to_toml();
    assert_eq!(read(&written), scene);
    assert_eq!(written.matches("groups").count(), 3, "{written}");
    assert_eq!(written.matches("user_data").count(), 1, "{written}");
    assert_eq!(written.matches("surface_velocity").count(), 1, "{written}");
}

#[test]
fn wrong_ones_are_refused_with_their_line() {
    let refusal = |text: &str| match Scene::from_toml(text, "game.toml") {
        Ok(scene) => scene.world().unwrap_err().to_string(),
        Err(error) => error.to_string(),
    };
    let kick = refusal(&TEXT.replace("'150 cm/s'", "-1"));
    assert!(kick.contains("11") && kick.contains("kick"), "{kick}");
    let cushion = refusal(&TEXT.replace("1.7", "2.1"));
    assert!(cushion.contains("12") && cushion.contains("cushion"), "{cushion}");
    let belt = refusal(&TEXT.replace("'36 km/h'", "inf"));
    assert!(belt.contains("surface_velocity"), "{belt}");
    let units = refusal(&TEXT.replace("'36 km/h'", "'3 kg'"));
    assert!(units.contains("13") && units.contains("m/s"), "{units}");
    let groups = refusal(&TEXT.replace("0b101", "-1"));
    assert!(groups.contains("4") && groups.contains("groups"), "{groups}");
}
