//! Imports of files without physics: meshes of spheres become spheres, those of boxes and
//! rectangles colliders, and everything else is reported.

mod files;

use carom::{DQuat, DVec3};
use carom_scene::scene::{Finish, Shape};
use files::{Gltf, cube, import_bytes, rectangle, report, sphere};
use serde_json::json;

fn one_mesh(node: serde_json::Value, (vertices, indices): (Vec<[f32; 3]>, Vec<u16>)) -> Gltf {
    Gltf::with_nodes(json!([node])).with_mesh(&vertices, &indices, None)
}

#[test]
fn a_sphere_like_mesh_is_the_sphere_around_it() {
    let node = json!({ "mesh": 0, "translation": [1, 2, 3], "scale": [0.5, 0.5, 0.5] });
    for slices in [8, 16, 64] {
        let imported = one_mesh(node.clone(), sphere([0.25, 0.0, 0.0], 2.0, slices)).imported();
        let [ball] = &imported.scene.spheres[..] else {
            panic!("{slices}: {:?}", report(&imported))
        };
        // Vertices have 24 bits.
        let away = DVec3::from_array(ball.position).distance(DVec3::new(1.125, 2.0, 3.0));
        assert!(away < 1e-6, "{slices}: {away}");
        assert_eq!(ball.radius, Some(1.0), "{slices}");
    }
}

#[test]
fn cylinders_and_cubes_are_no_spheres_though_their_corners_are_at_one_distance() {
    // The cylinder that fills most of its bounding sphere: its height is sqrt(2) radii.
    let (mut vertices, mut indices) = (Vec::new(), Vec::new());
    let sides = 48_u16;
    for i in 0..sides {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(sides);
        let [x, z] = [angle.cos() as f32, angle.sin() as f32];
        vertices.extend([[x, 0.70710677, z], [x, -0.70710677, z]]);
        let [top, next] = [2 * i, 2 * ((i + 1) % sides)];
        indices.extend([top, next, next + 1, top, next + 1, top + 1]);
        indices.extend([0, next, top, 1, top + 1, next + 1]);
    }
    let cylinder = one_mesh(json!({ "name": "Tin", "mesh": 0 }), (vertices, indices)).imported();
    assert!(cylinder.scene.spheres.is_empty());
    assert_eq!(report(&cylinder), ["Tin: mesh: its mesh is neither sphere, box nor rectangle"]);
    let cube = one_mesh(json!({ "mesh": 0 }), cube([1.0; 3])).imported();
    assert!(cube.scene.spheres.is_empty());
    assert_eq!(cube.scene.colliders[0].shape, Shape::Box { size: [1.0; 3] });
}

#[test]
fn an_ellipsoid_is_the_sphere_around_it_and_is_listed() {
    let node = json!({ "name": "Egg", "mesh": 0, "scale": [1, 2, 1] });
    let imported = one_mesh(node, sphere([0.0; 3], 1.0, 16)).imported();
    assert_eq!(imported.scene.spheres[0].radius, Some(2.0));
    let line = "Egg: mesh: is scaled to an ellipsoid; the sphere around it is taken";
    assert_eq!(report(&imported), [line]);
}

#[test]
fn boxes_are_found_along_the_axes_and_turned_in_their_mesh() {
    let half = 0.5_f64.sqrt();
    let (vertices, indices) = cube([2.0, 4.0, 6.0]);
    let turn = DQuat::from_xyzw(0.1, 0.7, -0.3, 0.64).normalize();
    let turned: Vec<[f32; 3]> = vertices
        .iter()
        .map(|it| (turn * DVec3::from_array(it.map(f64::from))).to_array().map(|it| it as f32))
        .collect();
    let node = json!({ "mesh": 0, "rotation": [0, half, 0, half] });
    for (vertices, rotation) in [(vertices, DQuat::IDENTITY), (turned, turn)] {
        let imported = one_mesh(node.clone(), (vertices, indices.clone())).imported();
        let collider = &imported.scene.colliders[0];
        let Shape::Box { size } = collider.shape else { panic!("{:?}", collider.shape) };
        // The axes of the box may be in any order, with the lengths that belong to them.
        let own = DQuat::from_array(collider.rotation);
        let expected = DQuat::from_xyzw(0.0, half, 0.0, half) * rotation;
        for (axis, length) in [(DVec3::X, 2.0), (DVec3::Y, 4.0), (DVec3::Z, 6.0)] {
            let local = (own.inverse() * (expected * axis)).abs().to_array();
            let along: f64 = local.iter().zip(size).map(|(part, size)| part * size).sum();
            // Vertices have 24 bits.
            assert!((along - length).abs() < 1e-5, "{size:?} {along}");
        }
    }
}

#[test]
fn a_rectangle_faces_where_its_triangles_do() {
    let (vertices, mut indices) = rectangle(3.0, 5.0);
    for sign in [1.0, -1.0] {
        let imported =
            one_mesh(json!({ "mesh": 0 }), (vertices.clone(), indices.clone())).imported();
        let [collider] = &imported.scene.colliders[..] else { panic!() };
        assert_eq!(collider.shape, Shape::Rectangle { size_x: 3.0, size_z: 5.0 });
        let normal = DQuat::from_array(collider.rotation) * DVec3::Y;
        assert!(normal.distance(sign * DVec3::Y) < 1e-12, "{normal}");
        indices.reverse();
    }
}

#[test]
fn a_mirrored_rectangle_faces_the_other_way() {
    let node = json!({ "mesh": 0, "scale": [1, -1, 1] });
    let imported = one_mesh(node, rectangle(1.0, 1.0)).imported();
    let normal = DQuat::from_array(imported.scene.colliders[0].rotation) * DVec3::Y;
    assert!(normal.distance(DVec3::NEG_Y) < 1e-12, "{normal}");
}

#[test]
fn a_rectangle_that_is_seen_from_both_sides_is_hit_from_both() {
    let (vertices, indices) = rectangle(1.0, 1.0);
    let file = Gltf::with_nodes(json!([{ "mesh": 0 }]))
        .with_mesh(&vertices, &indices, Some(0))
        .with("materials", json!([{ "doubleSided": true }]));
    let imported = file.imported();
    let normals: Vec<DVec3> = imported
        .scene
        .colliders
        .iter()
        .map(|it| DQuat::from_array(it.rotation) * DVec3::Y)
        .collect();
    assert_eq!(normals.len(), 2);
    assert!(normals[0].distance(-normals[1]) < 1e-12);
}

#[test]
fn children_are_where_parents_put_them() {
    let half = 0.5_f64.sqrt();
    let nodes = json!([
        { "name": "Arm", "translation": [1, 0, 0], "rotation": [0, 0, half, half], "scale": [2, 2, 2],
          "children": [1] },
        { "name": "Hand", "translation": [3, 0, 0], "mesh": 0 },
        { "name": "Matrix", "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1], "mesh": 0 },
    ]);
    let (vertices, indices) = sphere([0.0; 3], 0.5, 16);
    let imported = Gltf::with_nodes(nodes).with_mesh(&vertices, &indices, None).imported();
    let [hand, by_matrix] = &imported.scene.spheres[..] else { panic!() };
    // The child is 6 m away along +y, to which the parent rotates +x.
    assert!(DVec3::from_array(hand.position).distance(DVec3::new(1.0, 6.0, 0.0)) < 1e-8);
    assert_eq!(hand.radius, Some(1.0));
    assert_eq!((by_matrix.position, by_matrix.radius), ([5.0, 6.0, 7.0], Some(1.0)));
}

#[test]
fn materials_give_colour_and_finish() {
    let (vertices, indices) = sphere([0.0; 3], 0.5, 16);
    let pbr = |metallic: f64, roughness: f64| {
        json!({ "pbrMetallicRoughness": { "baseColorFactor": [1, 0.21404114, 0, 1],
            "metallicFactor": metallic, "roughnessFactor": roughness } })
    };
    let glass =
        json!({ "extensions": { "KHR_materials_transmission": { "transmissionFactor": 1 } } });
    let materials = json!([pbr(0.0, 0.9), pbr(0.0, 0.1), pbr(1.0, 0.2), glass, {}]);
    let nodes: Vec<_> =
        (0..5).map(|i| json!({ "mesh": i, "translation": [2 * i, 0, 0] })).collect();
    let mut file = Gltf::with_nodes(json!(nodes)).with("materials", materials);
    for i in 0..5 {
        file = file.with_mesh(&vertices, &indices, Some(i));
    }
    let imported = file.imported();
    let finishes: Vec<Finish> = imported.scene.spheres.iter().map(|it| it.finish).collect();
    let expected = [Finish::Matte, Finish::Glossy, Finish::Metal, Finish::Glass, Finish::Satin];
    assert_eq!(finishes, expected);
    let color = imported.scene.spheres[0].color.unwrap();
    // 0.214 in linear light is half of sRGB's scale.
    assert!((color[1] - 0.5).abs() < 1e-6 && color[0] == 1.0 && color[2] == 0.0, "{color:?}");
    assert_eq!(imported.scene.spheres[4].color, None);
}

#[test]
fn camera_and_light_are_taken_over() {
    let half = 0.5_f64.sqrt();
    let nodes = json!([
        { "camera": 0, "translation": [0, 1, 9] },
        { "rotation": [-half, 0, 0, half], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        { "name": "Lamp", "extensions": { "KHR_lights_punctual": { "light": 1 } } },
        { "name": "Second", "camera": 0 },
    ]);
    let lights = json!([{ "type": "directional", "intensity": 683 * 5 }, { "type": "point" }]);
    let perspective = json!({ "yfov": 1.0471975511965976, "znear": 0.1, "zfar": 100 });
    let imported = Gltf::with_nodes(nodes)
        .with("cameras", json!([{ "type": "perspective", "perspective": perspective }]))
        .with("extensions", json!({ "KHR_lights_punctual": { "lights": lights } }))
        .with("extensionsUsed", json!(["KHR_lights_punctual"]))
        .imported();
    let camera = imported.scene.camera.as_ref().unwrap();
    assert_eq!((camera.position, camera.vertical_fov_degrees), ([0.0, 1.0, 9.0], 60.0));
    assert_eq!((camera.near, camera.far), (0.1, 100.0));
    let sun = imported.scene.sun.as_ref().unwrap();
    let ahead = DQuat::from_array(sun.rotation) * DVec3::NEG_Z;
    assert!(ahead.distance(DVec3::NEG_Y) < 1e-12, "{ahead}");
    assert_eq!(sun.intensity, 1.0);
    let report = report(&imported);
    assert!(
        report.iter().any(|it| it.starts_with("Lamp: light: only a directional")),
        "{report:?}"
    );
    assert!(report.iter().any(|it| it == "Second: camera: a scene has one camera"), "{report:?}");
    assert!(report.iter().any(|it| it.contains("photometry")), "{report:?}");
}

#[test]
fn what_is_not_read_is_listed() {
    let (vertices, indices) = sphere([0.0; 3], 0.5, 16);
    let mut file = Gltf::with_nodes(json!([{ "mesh": 0 }, { "name": "Lines", "mesh": 1 }]))
        .with_mesh(&vertices, &indices, None)
        .with_mesh(&vertices, &indices, None)
        .with("animations", json!([{ "channels": [], "samplers": [] }]))
        .with("skins", json!([{ "joints": [0] }]))
        .with("textures", json!([{}]))
        .with("extensionsUsed", json!(["EXT_something"]));
    file.json["meshes"][1]["primitives"][0]["mode"] = json!(1);
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": 0 }]);
    file.json["scenes"] = json!([{ "nodes": [0, 1] }, { "nodes": [] }]);
    let report = report(&file.imported());
    for part in ["animations", "skins", "textures", "EXT_something", "morph targets", "scenes"] {
        assert!(
            report.iter().any(|it| it.starts_with(&format!("scene: {part}"))),
            "{part}: {report:?}"
        );
    }
    assert!(report.contains(&"Lines: mesh: its mesh has lines or points".to_owned()), "{report:?}");
}

#[test]
fn balls_fall_and_bounce_off_what_was_imported() {
    let (ball, of_ball) = sphere([0.0; 3], 0.5, 16);
    let (floor, of_floor) = rectangle(10.0, 10.0);
    let nodes = json!([{ "mesh": 0, "translation": [0, 5.5, 0] }, { "name": "Floor", "mesh": 1 }]);
    let imported = Gltf::with_nodes(nodes)
        .with_mesh(&ball, &of_ball, None)
        .with_mesh(&floor, &of_floor, None)
        .imported();
    assert_eq!(imported.scene.colliders[0].name, "Floor");
    let mut world = imported.scene.world().unwrap();
    // Down 5 m and up again, without loss.
    let time = 2.0 * (2.0 * 5.0 / 9.81_f64).sqrt();
    world.step(time).unwrap();
    assert!((world.spheres().positions()[0].y - 5.5).abs() < 1e-9);
}

#[test]
fn text_with_its_buffer_beside_it_and_binary_are_the_same_scene() {
    let (vertices, indices) = sphere([0.0; 3], 0.5, 16);
    let file = Gltf::with_nodes(json!([{ "mesh": 0 }])).with_mesh(&vertices, &indices, None);
    let expected = file.imported().scene.spheres;
    assert_eq!(import_bytes("scene.glb", &file.binary()).unwrap().scene.spheres, expected);
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::create_dir(folder.path().join("my buffers")).unwrap();
    std::fs::write(folder.path().join("my buffers/all.bin"), file.buffer()).unwrap();
    let path = folder.path().join("scene.gltf");
    std::fs::write(&path, file.text_with_buffer("my%20buffers/all.bin")).unwrap();
    let imported = carom_gltf::import(&path, &carom_gltf::Options::default()).unwrap();
    assert_eq!(imported.scene.spheres, expected);
}
