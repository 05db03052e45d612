//! Meshes and height fields of scene files: all that says a surface says the same surface, and mistakes are named by
//! line and number.

use std::fs;

use carom::Shape;
use carom_scene::{Budget, Scene, SceneText, mesh_remarks};

const VERTICES: &str = "vertices = [[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]]";
const TRIANGLES: &str = "triangles = [[0, 1, 2], [0, 2, 3]]";

/// A scene with a collider of this shape.
fn scene_of(shape: &str) -> String {
    format!("[[colliders]]\nshape = {{ {shape} }}\n")
}

fn mesh_of(scene: &Scene) -> carom::Mesh {
    let world = scene.world().unwrap();
    let (_, collider) = world.colliders().next().unwrap();
    match &collider.shape {
        Shape::Mesh(mesh) => mesh.clone(),
        other => panic!("{other:?}"),
    }
}

fn problem_of(text: &str) -> String {
    Scene::from_toml(text, "one.toml").unwrap_err().to_string()
}

#[test]
fn files_of_all_kinds_say_what_lists_say() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).unwrap();
    write("a.obj", b"v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nf 1 2 3 4\n");
    let facet = |corners: [&str; 3]| {
        let [a, b, c] = corners;
        format!(
            "facet normal 0 1 0\nouter loop\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n"
        )
    };
    let facets = [["0 0 0", "0 0 1", "1 0 1"], ["0 0 0", "1 0 1", "1 0 0"]].map(facet).concat();
    write("a.stl", format!("solid a\n{facets}endsolid a\n").as_bytes());
    write("a.gltf", gltf().as_bytes());
    let listed = scene_of(&format!("mesh = {{ {VERTICES}, {TRIANGLES}, scale = 0.5 }}"));
    let listed = mesh_of(&Scene::from_toml(&listed, "listed.toml").unwrap());
    for name in ["a.obj", "a.stl", "a.gltf"] {
        let path = folder.path().join("scene.toml");
        fs::write(&path, scene_of(&format!("mesh = {{ file = \"{name}\", scale = 0.5 }}")))
            .unwrap();
        let read = mesh_of(&Scene::from_file(&path, &[]).unwrap());
        assert_eq!(read.bounds(), listed.bounds(), "{name}");
        assert_eq!(read.triangles().len(), 2, "{name}");
        fs::write(&path, scene_of(&format!("mesh = \"{name}\""))).unwrap();
        let whole = mesh_of(&Scene::from_file(&path, &[]).unwrap());
        assert_eq!(whole.bounds()[1], 2.0 * read.bounds()[1], "{name}");
    }
}

/// The same square, whose node is moved from one metre below.
fn gltf() -> String {
    let numbers: [f32; 12] = [0.0, -1.0, 0.0, 0.0, -1.0, 1.0, 1.0, -1.0, 1.0, 1.0, -1.0, 0.0];
    let mut bytes: Vec<u8> = numbers.iter().flat_map(|it| it.to_le_bytes()).collect();
    bytes.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|it| it.to_le_bytes()));
    let base64 = base64(&bytes);
    format!(
        r#"{{ "asset": {{ "version": "2.0" }}, "scenes": [{{ "nodes": [0] }}], "scene": 0,
        "nodes": [{{ "mesh": 0, "translation": [0, 1, 0] }}],
        "meshes": [{{ "primitives": [{{ "attributes": {{ "POSITION": 0 }}, "indices": 1 }}] }}],
        "accessors": [
            {{ "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
               "min": [0, -1, 0], "max": [1, -1, 1] }},
            {{ "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" }}],
        "bufferViews": [
            {{ "buffer": 0, "byteOffset": 0, "byteLength": 48 }},
            {{ "buffer": 0, "byteOffset": 48, "byteLength": 12 }}],
        "buffers": [{{ "byteLength": 60, "uri": "data:application/octet-stream;base64,{base64}" }}] }}"#
    )
}

/// Encodes a multiple of three bytes.
fn base64(bytes: &[u8]) -> String {
    let letters = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let three = |it: &[u8]| {
        let bits = u32::from_be_bytes([0, it[0], it[1], it[2]]);
        [18, 12, 6, 0].map(|shift| char::from(letters[(bits >> shift & 63) as usize]))
    };
    bytes.chunks_exact(3).flat_map(three).collect()
}

#[test]
fn a_scene_with_a_mesh_is_written_and_read_again() {
    for shape in [
        format!("mesh = {{ {VERTICES}, {TRIANGLES}, one_sided = true }}"),
        "height-field = { size_x = 2.0, size_z = 3.0, heights = [[0, 1], [1, 0]] }".to_owned(),
    ] {
        let scene = Scene::from_toml(&scene_of(&shape), "one.toml").unwrap();
        let again = Scene::from_toml(&scene.to_toml(), "again.toml").unwrap();
        assert_eq!(again.colliders, scene.colliders);
        assert_eq!(mesh_of(&again), mesh_of(&scene));
    }
}

#[test]
fn mistakes_in_a_mesh_are_named_by_line_and_number() {
    let problem =
        problem_of(&scene_of(&format!("mesh = {{ {VERTICES}, triangles = [[0, 1, 4]] }}")));
    assert!(problem.contains("one.toml:2: colliders[0].shape.mesh"), "{problem}");
    assert!(problem.contains("triangle 0 of the mesh names vertex 4"), "{problem}");
    let problem = problem_of(&scene_of("mesh = \"nowhere.obj\""));
    assert!(problem.contains("cannot read \"nowhere.obj\""), "{problem}");
    let problem = problem_of(&scene_of("mesh = \"track.png\""));
    assert!(problem.contains(".glb, .gltf, .obj or .stl"), "{problem}");
    let rows = "height-field = { size_x = 2, size_z = 3, heights = [[0, 1], [1]] }";
    let problem = problem_of(&scene_of(rows));
    assert!(problem.contains("shape.height-field: row 1 of the heights"), "{problem}");
}

#[test]
fn spheres_and_emitters_inside_a_closed_mesh_are_refused_as_in_a_box() {
    let corners = "vertices = [[-1, -1, -1], [3, -1, -1], [-1, 3, -1], [-1, -1, 3]]";
    let closed = "triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]";
    let open = "triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2]]";
    let sphere = "[[spheres]]\nposition = [0, 0, -0.5]\nradius = 0.1\n";
    let emitter = "[[emitters]]\nposition = [0, 0, -0.5]\nperiod = 1\nsphere = { radius = 0.1 }\n";
    let with = |triangles: &str, more: &str| {
        let rock = scene_of(&format!("mesh = {{ {corners}, {triangles} }}"));
        format!("{}name = \"rock\"\n{more}", rock)
    };
    let problem = problem_of(&with(closed, sphere));
    let expected = "sphere number 0 overlaps colliders[0] \"rock\" by 6.000e-1 m at the start";
    assert!(problem.contains(expected), "{problem}");
    let problem = problem_of(&with(closed, emitter));
    assert!(problem.contains("emitters[0].position: puts spheres into a collider"), "{problem}");
    for more in [sphere, emitter] {
        Scene::from_toml(&with(open, more), "open.toml").unwrap();
    }
    let allowed = format!("[simulation]\nallow_overlap = true\n{}", with(closed, sphere));
    Scene::from_toml(&allowed, "allowed.toml").unwrap();
}

#[test]
fn a_link_opens_no_file() {
    let text = SceneText::new(&scene_of("mesh = \"/etc/track.obj\""), "link").unwrap();
    let problem = text.within(Budget::LINK).scene(&[]).unwrap_err().to_string();
    assert!(problem.contains("a link opens no file"), "{problem}");
}

#[test]
fn what_may_not_be_meant_is_listed_by_number() {
    let square = format!("{VERTICES}, triangles = [[0, 1, 2], [0, 3, 2], [1, 1, 2]]");
    let scene = Scene::from_toml(&scene_of(&format!("mesh = {{ {square} }}")), "one.toml").unwrap();
    let remarks = mesh_remarks(&mesh_of(&scene)).join("\n");
    assert!(remarks.contains("without an area, left out: triangles 2"), "{remarks}");
    assert!(remarks.contains("facing otherwise than a neighbour: triangles 1"), "{remarks}");
    assert!(remarks.contains("met from both sides: edges 0-1"), "{remarks}");
}
