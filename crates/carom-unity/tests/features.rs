//! Imports of scenes, feature by feature.

mod fixtures;

use std::fs;

use carom_scene::scene::{Collider, CombineRule, Finish, Force, Rule, Scene, Shape};
use carom_unity::{Mapping, Options, Project, import};
use fixtures::{Copy, imported, project, reasons, scene};

#[track_caller]
fn collider<'a>(scene: &'a Scene, name: &str) -> &'a Collider {
    let found = scene.colliders.iter().find(|it| it.name == name);
    found.unwrap_or_else(|| panic!("no {name} in {:?}", scene.colliders))
}

/// Compares numbers of Unity, which have 24 bits.
#[track_caller]
fn assert_near<const N: usize>(numbers: [f64; N], expected: [f64; N]) {
    let near = numbers.iter().zip(expected).all(|(it, other)| (it - other).abs() < 1e-6);
    assert!(near, "{numbers:?}, not {expected:?}");
}

#[test]
fn six_planes_of_nested_prefabs_become_the_box_that_they_enclose() {
    let scene = imported("Nested").scene;
    let wall = collider(&scene, "Wall/Scaler");
    let Shape::Box { size } = wall.shape else { panic!("{wall:?}") };
    assert_near(size, [8.0, 2.0, 0.5]);
    // Its parent is at z = 2 and is rotated by a quarter turn about y; both are mirrored.
    assert_near(wall.position, [1.0, 1.0, -2.0]);
    let half = 0.5_f64.sqrt();
    assert_near(wall.rotation, [0.0, -half, 0.0, half]);
    assert_eq!(wall.restitution, 0.2);
    let others = scene.colliders.iter().filter(|it| matches!(it.shape, Shape::Rectangle { .. }));
    assert_eq!(others.count(), 0);
}

#[test]
fn planes_that_bounce_differently_stay_planes() {
    let copy = Copy::new();
    copy.change("Assets/Prefabs/Box.prefab", "value: 0.2", "value: 0.3");
    let scene = copy.import("Nested").unwrap().scene;
    let planes = scene.colliders.iter().filter(|it| matches!(it.shape, Shape::Rectangle { .. }));
    assert_eq!(planes.count(), 6);
}

#[test]
fn a_variant_of_a_prefab_is_changed_by_its_own_instance() {
    let scene = imported("Nested").scene;
    let large = collider(&scene, "Large");
    assert_eq!(large.shape, Shape::Sphere { radius: 1.0 });
    assert_eq!(large.position, [0.0, 0.0, -3.0]);
}

#[test]
fn removed_inactive_and_lost_objects_are_left_out_and_listed() {
    let imported = imported("Nested");
    let names: Vec<_> = imported.scene.colliders.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["Wall/Scaler", "Large", "Coin"]);
    assert_eq!(
        reasons(&imported),
        [
            "Assets/Scenes/Nested.unity: prefab instance: no file of the project has its guid dead0000000000000000000000000000",
            "Lost: game object: hangs on an object that is not in the file, or in no known prefab",
            "Hidden and 1 more: game object: is inactive, or hangs on one that is",
            "Bare: mesh: is only drawn: it has no collider",
        ]
    );
}

#[test]
fn a_restitution_of_minus_one_is_a_trigger() {
    assert!(collider(&imported("Nested").scene, "Coin").trigger);
}

#[test]
fn rigid_bodies_that_are_spheres_move_under_the_project_s_gravity() {
    let scene = imported("Bodies").scene;
    assert_eq!(scene.simulation.rule, Rule::Exact);
    assert_eq!(scene.simulation.frame_time, 0.02);
    let [ball] = &scene.spheres[..] else { panic!("{:?}", scene.spheres) };
    assert_eq!((ball.position, ball.radius, ball.mass), ([0.0, 4.0, -3.0], Some(1.0), Some(2.5)));
    assert_eq!((ball.restitution, ball.friction), (0.75, Some(0.25)));
    assert_eq!((ball.color, ball.finish), (Some([0.75, 0.25, 0.125]), Finish::Glossy));
    assert_eq!(
        scene.forces,
        [
            Force::Gravity { acceleration: [0.0, -9.81, 0.0] },
            // Unity's drag is a rate.
            Force::ViscousDrag { coefficient: 0.5 },
        ]
    );
}

#[test]
fn physic_materials_say_how_contacts_combine() {
    let simulation = imported("Bodies").scene.simulation;
    assert_eq!(simulation.combine_rule, CombineRule::Maximum);
    assert_eq!(simulation.friction_combine_rule, CombineRule::Minimum);
}

#[test]
fn colliders_have_their_scaled_forms_and_centres() {
    let scene = imported("Bodies").scene;
    let crate_ = collider(&scene, "Crate");
    assert_eq!(crate_.shape, Shape::Box { size: [2.0, 2.0, 3.0] });
    assert_near(crate_.position, [1.0, 2.0, -1.0]);
    let floor = collider(&scene, "Floor");
    assert_eq!(floor.shape, Shape::Rectangle { size_x: 30.0, size_z: 20.0 });
    assert!(!floor.visible, "nothing draws it");
    let goal = collider(&scene, "Goal");
    assert_eq!(goal.shape, Shape::Sphere { radius: 0.25 });
    assert_eq!((goal.position, goal.trigger), ([0.0, 2.0, -5.0], true));
}

#[test]
fn a_capsule_lies_along_its_direction() {
    const SCENE: &str = "Assets/Scenes/Bodies.unity";
    for (direction, along) in [(0, [1.0, 0.0, 0.0]), (1, [0.0, 1.0, 0.0]), (2, [0.0, 0.0, 1.0])] {
        let copy = Copy::new();
        copy.change(SCENE, "--- !u!135 &42\nSphereCollider:", "--- !u!136 &42\nCapsuleCollider:");
        let fields = format!("m_Radius: 0.25\n  m_Height: 2\n  m_Direction: {direction}");
        copy.change(SCENE, "m_Radius: 0.25", &fields);
        let scene = copy.import("Bodies").unwrap().scene;
        let goal = collider(&scene, "Goal");
        assert_eq!(goal.shape, Shape::Capsule { radius: 0.25, length: 1.5 });
        let axis = carom::DQuat::from_array(goal.rotation).normalize() * carom::DVec3::Y;
        assert_near(axis.abs().to_array(), along);
    }
}

#[test]
fn a_capsule_that_is_lower_than_wide_is_a_sphere() {
    const SCENE: &str = "Assets/Scenes/Bodies.unity";
    let copy = Copy::new();
    copy.change(SCENE, "--- !u!135 &42\nSphereCollider:", "--- !u!136 &42\nCapsuleCollider:");
    copy.change(SCENE, "m_Radius: 0.25", "m_Radius: 0.25\n  m_Height: 0.4");
    let scene = copy.import("Bodies").unwrap().scene;
    assert_eq!(collider(&scene, "Goal").shape, Shape::Sphere { radius: 0.25 });
}

#[test]
fn a_quad_faces_what_comes_to_it_along_unity_s_z() {
    let scene = imported("Bodies").scene;
    let screen = collider(&scene, "Screen");
    assert_eq!(screen.shape, Shape::Rectangle { size_x: 4.0, size_z: 3.0 });
    // The normal, local +y, is Unity's -z, mirrored to +z.
    let normal = carom::DQuat::from_array(screen.rotation).normalize() * carom::DVec3::Y;
    assert_near(normal.to_array(), [0.0, 0.0, 1.0]);
}

#[test]
fn what_unity_s_physics_has_without_a_counterpart_is_listed() {
    assert_eq!(
        reasons(&imported("Bodies")),
        [
            "Pill: MeshCollider: a capsule has no counterpart",
            "Block: Rigidbody: only spheres move",
            "Statue: mesh: is only drawn: it has no collider",
        ]
    );
}

/// The project with a model for the collider "Pill", which has this scale.
fn with_model(name: &str, text: &str, scale: &str) -> Copy {
    const SCENE: &str = "Assets/Scenes/Bodies.unity";
    let copy = Copy::new();
    fs::create_dir(copy.path("Assets/Models")).unwrap();
    fs::write(copy.path(&format!("Assets/Models/{name}")), text).unwrap();
    let meta = "fileFormatVersion: 2\nguid: 90de1000000000000000000000000001\nModelImporter:\n  meshes:\n    \
                globalScale: 2\n";
    fs::write(copy.path(&format!("Assets/Models/{name}.meta")), meta).unwrap();
    let pill = "m_Mesh: {fileID: 10208, guid: 0000000000000000e000000000000000, type: 0}";
    copy.change(
        SCENE,
        pill,
        "m_Mesh: {fileID: 43, guid: 90de1000000000000000000000000001, type: 3}",
    );
    let place = "m_GameObject: {fileID: 50}\n  m_LocalRotation: {x: 0, y: 0, z: 0, w: 1}\n  m_LocalPosition: \
                 {x: 0, y: 0, z: 0}\n  m_LocalScale: ";
    copy.change(SCENE, &format!("{place}{{x: 1, y: 1, z: 1}}"), &format!("{place}{scale}"));
    copy
}

#[test]
fn a_model_of_the_project_is_a_mesh_with_its_scales() {
    const RAMP: &str = "v 0 0 0\nv 1 0 0\nv 0 2 3\nf 1 2 3\n";
    // Unity has (-x, y, z) of the file, times 2; here z is mirrored, too.
    for (scale, factor, order) in [
        ("{x: 1, y: 3, z: 0.5}", [1.0, 3.0, 0.5], [0, 1, 2]),
        ("{x: -1, y: 3, z: 0.5}", [-1.0, 3.0, 0.5], [0, 2, 1]),
    ] {
        let imported = with_model("Ramp.obj", RAMP, scale).import("Bodies").unwrap();
        let Shape::Mesh(mesh) = &collider(&imported.scene, "Pill").shape else { panic!() };
        assert_eq!(mesh.triangles, [order]);
        assert!(mesh.one_sided);
        let expected = [[0.0; 3], [-2.0, 0.0, 0.0], [0.0, 4.0, -6.0]];
        for (vertex, expected) in mesh.vertices.iter().zip(expected) {
            let [x, y, z] = factor;
            assert_near(*vertex, [x * expected[0], y * expected[1], z * expected[2]]);
        }
        assert!(!reasons(&imported).iter().any(|it| it.starts_with("Pill")));
    }
}

#[test]
fn a_model_that_is_not_read_is_listed() {
    let reason = |name, text| {
        let imported = with_model(name, text, "{x: 1, y: 1, z: 1}").import("Bodies").unwrap();
        reasons(&imported).into_iter().find(|it| it.starts_with("Pill")).unwrap()
    };
    let shown = "Pill: MeshCollider: its mesh";
    assert_eq!(
        reason("Ramp.fbx", "Kaydara"),
        format!("{shown} is in \"Assets/Models/Ramp.fbx\"; of models, only .obj files are read")
    );
    let two = "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no b\nv 0 0 1\nf 1 2 4\n";
    assert_eq!(
        reason("Two.obj", two),
        format!("{shown} \"Assets/Models/Two.obj\" is not read: it holds several objects")
    );
}

#[test]
fn a_script_of_one_s_own_is_read_by_a_mapping_file() {
    let unknown = imported("Own");
    assert!(unknown.scene.emitters.is_empty());
    assert_eq!(
        reasons(&unknown),
        ["Gun: script: Thrower.cs is not known; its fields are every, size, speed, label"]
    );

    let mapping = Mapping::from_file(&project().join("fields.toml")).unwrap();
    let options = Options { mapping, ..Options::default() };
    let path = scene("Own");
    let known = import(&path, &Project::around(&path).unwrap(), &options).unwrap();
    assert_eq!(reasons(&known), [] as [&str; 0]);
    let [gun] = &known.scene.emitters[..] else { panic!("{:?}", known.scene.emitters) };
    assert_eq!((gun.period, gun.max_spheres), (0.5, None));
    assert_eq!(gun.sphere.velocity, [0.0, 1.0, -3.0]);
    assert_eq!((gun.sphere.diameter, gun.sphere.mass), (Some(0.2), Some(0.5)));
    assert_eq!(known.scene.forces, [Force::Gravity { acceleration: [0.0, -9.81, 0.0] }]);
}

#[test]
fn options_come_before_the_settings_of_the_project() {
    let options = Options {
        rule: Some(Rule::Bisect),
        frame_time: Some(0.005),
        duration: Some(3.0),
        ..Options::default()
    };
    let path = scene("First");
    let scene = import(&path, &Project::around(&path).unwrap(), &options).unwrap().scene;
    let simulation = scene.simulation;
    assert_eq!(simulation.rule, Rule::Bisect);
    assert_eq!((simulation.frame_time, simulation.duration), (0.005, 3.0));
}

#[test]
fn a_time_step_in_ticks_is_understood() {
    let copy = Copy::new();
    let ticks = "Fixed Timestep:\n    m_Count: 1411200\n    m_Rate:\n      m_Denominator: 1\n      m_Numerator: 141120000";
    copy.change("ProjectSettings/TimeManager.asset", "Fixed Timestep: 0.02", ticks);
    assert_eq!(copy.import("First").unwrap().scene.simulation.frame_time, 0.01);
}

#[test]
fn every_scene_of_a_folder_is_found() {
    let scenes = Project::around(&project()).unwrap().scenes(&project()).unwrap();
    let names: Vec<_> = scenes.iter().map(|it| it.file_stem().unwrap().to_owned()).collect();
    assert_eq!(names, ["Bodies", "First", "Nested", "Own"]);
}

#[test]
fn spheres_that_overlap_at_the_start_may() {
    let copy = Copy::new();
    copy.change("Assets/Scenes/Bodies.unity", "{x: 0, y: 4, z: 3}", "{x: 1, y: 1, z: 1}");
    let imported = copy.import("Bodies").unwrap();
    assert!(imported.scene.simulation.allow_overlap);
    assert!(imported.omissions.iter().any(|it| it.component == "start"));
}

#[test]
fn an_imported_scene_is_read_again_from_its_file() {
    for name in ["First", "Nested", "Bodies", "Own"] {
        let scene = imported(name).scene;
        assert_eq!(Scene::from_toml(&scene.to_toml(), name).unwrap(), scene);
    }
}

#[test]
fn lines_of_windows_make_no_difference() {
    let copy = Copy::new();
    let path = copy.path("Assets/Scenes/First.unity");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace('\n', "\r\n")).unwrap();
    assert_eq!(copy.import("First").unwrap().scene, imported("First").scene);
}

#[test]
fn metalness_smoothness_and_opacity_give_the_finish() {
    let copy = Copy::new();
    let finish = |old: &str, new: &str| {
        copy.change("Assets/Materials/Red.mat", old, new);
        copy.import("Bodies").unwrap().scene.spheres[0].finish
    };
    assert_eq!(finish("_Glossiness: 0.9", "_Smoothness: 0.5"), Finish::Satin);
    assert_eq!(finish("_Smoothness: 0.5", "_Smoothness: 0.1"), Finish::Matte);
    assert_eq!(finish("_Metallic: 0", "_Metallic: 1"), Finish::Metal);
    assert_eq!(finish("_Mode: 0", "_Mode: 3"), Finish::Metal, "it is opaque");
    assert_eq!(finish("b: 0.125, a: 1", "b: 0.125, a: 0.3"), Finish::Glass);
}

#[test]
fn textures_and_glow_of_materials_are_listed_once() {
    let copy = Copy::new();
    let material = "Assets/Materials/Red.mat";
    copy.change(
        material,
        "m_Texture: {fileID: 0}",
        "m_Texture: {fileID: 2800000, guid: 77, type: 3}",
    );
    copy.change(material, "_EmissionColor: {r: 0", "_EmissionColor: {r: 2");
    let reasons = reasons(&copy.import("Bodies").unwrap());
    for reason in ["its textures have no counterpart", "its glow has no counterpart"] {
        let lines = reasons.iter().filter(|it| it.contains(&format!("Material: {reason}")));
        assert_eq!(lines.count(), 1, "{reasons:#?}");
    }
}
