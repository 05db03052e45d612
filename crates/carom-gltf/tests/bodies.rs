//! Imports of files with `KHR_physics_rigid_bodies`: bodies are as described, whatever their meshes
//! are.

mod files;

use carom_scene::scene::{CombineRule, Force, Shape};
use files::{Gltf, report, sphere};
use serde_json::{Value, json};

/// Creates a file with shapes, materials and nodes.
fn file(shapes: Value, materials: Value, nodes: Value) -> Gltf {
    let bodies = json!({ "physicsMaterials": materials });
    let extensions =
        json!({ "KHR_implicit_shapes": { "shapes": shapes }, "KHR_physics_rigid_bodies": bodies });
    Gltf::with_nodes(nodes).with("extensions", extensions)
}

fn node(mut node: Value, body: Value) -> Value {
    node["extensions"] = json!({ "KHR_physics_rigid_bodies": body });
    node
}

fn shapes() -> Value {
    json!([
        { "type": "sphere", "sphere": { "radius": 0.25 } },
        { "type": "box", "box": { "size": [1, 2, 3] } },
        { "type": "plane", "plane": { "sizeX": 4, "sizeZ": 5 } },
        { "type": "plane" },
        { "type": "capsule", "capsule": { "height": 1 } },
    ])
}

fn collider(shape: u64) -> Value {
    json!({ "geometry": { "shape": shape }, "physicsMaterial": 0 })
}

fn rubber() -> Value {
    json!([{ "staticFriction": 0.3, "dynamicFriction": 0.3, "restitution": 0.8,
        "frictionCombine": "minimum", "restitutionCombine": "multiply" }])
}

#[test]
fn a_body_has_its_mass_velocity_and_surface() {
    let half = 0.5_f64.sqrt();
    let motion = json!({ "mass": 2.5, "linearVelocity": [1, 0, 0], "angularVelocity": [0, 0, 3],
        "inertiaDiagonal": [0.1, 0.1, 0.1] });
    let ball =
        json!({ "translation": [1, 2, 3], "rotation": [0, half, 0, half], "scale": [2, 2, 2] });
    let nodes = json!([node(ball, json!({ "motion": motion, "collider": collider(0) }))]);
    let imported = file(shapes(), rubber(), nodes).imported();
    let [ball] = &imported.scene.spheres[..] else { panic!("{:?}", report(&imported)) };
    assert_eq!((ball.position, ball.radius, ball.mass), ([1.0, 2.0, 3.0], Some(0.5), Some(2.5)));
    assert_eq!((ball.restitution, ball.friction), (0.8, Some(0.3)));
    // 0.1 kg m² at 2.5 kg and 0.5 m.
    assert!((ball.inertia_factor - 0.16).abs() < 1e-12);
    // Velocities are in the coordinates of the node, which is rotated about y: +x becomes -z, +z
    // becomes +x.
    for (velocity, expected) in
        [(ball.velocity, [0.0, 0.0, -1.0]), (ball.angular_velocity, [3.0, 0.0, 0.0])]
    {
        assert!(velocity.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{velocity:?}");
    }
    assert_eq!(imported.scene.simulation.combine_rule, CombineRule::Product);
    assert_eq!(imported.scene.simulation.friction_combine_rule, CombineRule::Minimum);
    assert_eq!(report(&imported), [""; 0]);
}

#[test]
fn colliders_without_motion_stay() {
    let nodes = json!([
        node(json!({ "name": "Ball" }), json!({ "collider": collider(0) })),
        node(json!({ "name": "Box", "scale": [1, 1, 2] }), json!({ "collider": collider(1) })),
        node(json!({ "name": "Plate" }), json!({ "collider": collider(2) })),
        node(
            json!({ "name": "Ground", "translation": [0, -1, 0] }),
            json!({ "collider": collider(3) })
        ),
        node(json!({ "name": "Gate" }), json!({ "trigger": { "geometry": { "shape": 1 } } })),
        // The form in files that precede `geometry`.
        node(json!({ "name": "Old" }), json!({ "collider": { "shape": 0 } })),
    ]);
    let imported = file(shapes(), rubber(), nodes).imported();
    let colliders: Vec<_> = imported.scene.colliders.iter().map(|it| it.shape.clone()).collect();
    let size = [1.0, 2.0, 3.0];
    let expected = [
        Shape::Sphere { radius: 0.25 },
        Shape::Box { size: [1.0, 2.0, 6.0] },
        Shape::Rectangle { size_x: 4.0, size_z: 5.0 },
        Shape::HalfSpace,
        Shape::Box { size },
        Shape::Sphere { radius: 0.25 },
    ];
    assert_eq!(colliders, expected);
    let triggers: Vec<bool> = imported.scene.colliders.iter().map(|it| it.trigger).collect();
    assert_eq!(triggers, [false, false, false, false, true, false]);
    // The default material of the specification.
    assert_eq!(
        (imported.scene.colliders[5].restitution, imported.scene.colliders[5].friction),
        (0.0, Some(0.6))
    );
    assert!(imported.scene.forces.is_empty(), "nothing falls");
}

#[test]
fn triggers_say_nothing_of_how_materials_combine() {
    let nodes = json!([
        node(json!({}), json!({ "collider": collider(1) })),
        node(json!({}), json!({ "trigger": { "geometry": { "shape": 1 } } })),
    ]);
    let imported = file(shapes(), rubber(), nodes).imported();
    assert_eq!(imported.scene.simulation.combine_rule, CombineRule::Product);
    assert_eq!(report(&imported), [""; 0]);
}

#[test]
fn kinematic_bodies_are_colliders_that_move() {
    let motion =
        json!({ "isKinematic": true, "linearVelocity": [0, 0, 2], "angularVelocity": [0, 1, 0] });
    let nodes = json!([node(json!({}), json!({ "motion": motion, "collider": collider(1) }))]);
    let imported = file(shapes(), rubber(), nodes).imported();
    let [collider] = &imported.scene.colliders[..] else { panic!() };
    assert_eq!((collider.velocity, collider.angular_velocity), ([0.0, 0.0, 2.0], [0.0, 1.0, 0.0]));
}

#[test]
fn the_collider_of_a_body_may_be_a_child_and_a_mesh() {
    let (vertices, indices) = sphere([0.0; 3], 0.5, 16);
    let collider = json!({ "geometry": { "node": 1 } });
    let nodes = json!([
        node(json!({ "children": [1] }), json!({ "motion": { "mass": 3 } })),
        node(json!({ "mesh": 0, "translation": [0, 1, 0] }), json!({ "collider": collider })),
    ]);
    let imported = file(shapes(), rubber(), nodes).with_mesh(&vertices, &indices, None).imported();
    let [ball] = &imported.scene.spheres[..] else { panic!("{:?}", report(&imported)) };
    assert_eq!((ball.position, ball.radius, ball.mass), ([0.0, 1.0, 0.0], Some(0.5), Some(3.0)));
}

#[test]
fn gravity_is_that_of_the_bodies() {
    let gravity = |factors: &[f64]| {
        let bodies = factors.iter().enumerate().map(|(i, factor)| {
            let motion = json!({ "gravityFactor": factor });
            let body = json!({ "motion": motion, "collider": collider(0) });
            node(json!({ "translation": [i, 0, 0] }), body)
        });
        let imported = file(shapes(), rubber(), json!(bodies.collect::<Vec<_>>())).imported();
        (imported.scene.forces.clone(), report(&imported))
    };
    let falling = Force::Gravity { acceleration: [0.0, -9.81, 0.0] };
    assert_eq!(gravity(&[1.0]).0, std::slice::from_ref(&falling));
    assert_eq!(gravity(&[0.0]).0, []);
    assert_eq!(gravity(&[0.5]).0, [Force::Gravity { acceleration: [0.0, -4.905, 0.0] }]);
    let (forces, report) = gravity(&[1.0, 0.0]);
    assert_eq!(forces, [falling]);
    assert!(report[0].contains("gravityFactor: bodies have several"), "{report:?}");
}

#[test]
fn what_has_no_counterpart_is_listed() {
    let (vertices, indices) = sphere([0.0; 3], 0.5, 16);
    let moving =
        |shape| json!({ "motion": { "centerOfMass": [0, 1, 0] }, "collider": collider(shape) });
    let filtered = json!({ "geometry": { "shape": 0 }, "collisionFilter": 0 });
    let nodes = json!([
        node(json!({ "name": "Block" }), moving(1)),
        node(json!({ "name": "Pill" }), json!({ "collider": collider(4) })),
        node(json!({ "name": "Top", "translation": [9, 0, 0] }), moving(0)),
        node(json!({ "name": "Hinge" }), json!({ "joint": { "joint": 0 } })),
        node(json!({ "name": "Ghost", "translation": [3, 0, 0] }), json!({ "collider": filtered })),
        node(json!({ "name": "Feather" }), json!({ "motion": {} })),
        json!({ "name": "Statue", "mesh": 0 }),
        node(json!({ "name": "Later", "scale": [0, 0, 0] }), json!({ "collider": collider(0) })),
    ]);
    let imported = file(shapes(), rubber(), nodes).with_mesh(&vertices, &indices, None).imported();
    let report = report(&imported);
    for line in [
        "Block: collider: only spheres move",
        "Pill: collider: a capsule has no counterpart",
        "Top: motion: its centre of mass is not in the middle; here it is",
        "Hinge: joint: has no counterpart",
        "Ghost: collider: its collision filter has no counterpart: it meets all bodies",
        "Feather: motion: it has no collider",
        "Statue: mesh: is only drawn: it has no collider",
        "Later: collider: has no size at the start: it appears later",
        "scene: physics materials: materials combine in several ways; the scene takes the first of average, minimum, \
         maximum, multiply for all",
    ] {
        assert!(report.contains(&line.to_owned()), "{line}: {report:#?}");
    }
}
