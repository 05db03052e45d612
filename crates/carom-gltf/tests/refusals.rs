//! Broken files are refused with file, place and reason, and no file can refer to files outside its
//! folder.

mod files;

use carom_gltf::Options;
use files::{Gltf, import_bytes, sphere};
use serde_json::{Value, json};

/// Imports a text; returns the error.
fn refusal(text: &str) -> String {
    let error = import_bytes("scene.gltf", text.as_bytes()).unwrap_err().to_string();
    let (_, rest) = error.split_once("scene.gltf: ").unwrap_or_else(|| panic!("{error}"));
    rest.to_owned()
}

fn ball() -> Gltf {
    let (vertices, indices) = sphere([0.0; 3], 0.5, 8);
    Gltf::with_nodes(json!([{ "name": "Ball", "mesh": 0 }])).with_mesh(&vertices, &indices, None)
}

/// Imports a file with one value changed; returns the error.
fn changed(pointer: &str, value: Value) -> String {
    let mut file = ball();
    *file.json.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}")) = value;
    refusal(&file.text())
}

#[test]
fn text_that_is_no_gltf_is_refused_with_its_line() {
    assert_eq!(refusal("{\n  \"asset\": {\n"), "line 3, asset: EOF while parsing an object");
    assert!(refusal("").starts_with("line 1: EOF"));
    assert_eq!(refusal("{}"), "asset: is missing: this is no glTF");
    assert_eq!(
        refusal(r#"{ "asset": { "version": "1.0" } }"#),
        "asset.version: is 1.0; 2.0 is read"
    );
    let wrong =
        refusal("{ \"asset\": { \"version\": \"2.0\" },\n\"nodes\": [{ \"mesh\": \"ball\" }] }");
    assert_eq!(wrong, "line 2, nodes[0].mesh: invalid type: string \"ball\", expected usize");
}

#[test]
fn json_of_more_than_64_mib_is_refused_before_it_is_read() {
    assert_eq!(refusal(&" ".repeat((64 << 20) + 1)), "JSON: is larger than 64 MiB");
}

#[test]
fn what_refers_to_what_is_not_there_is_refused_with_its_place() {
    assert_eq!(changed("/nodes/0/mesh", json!(7)), "meshes[7]: is not there");
    assert_eq!(changed("/scene", json!(3)), "scene: is not there");
    assert_eq!(changed("/scenes/0/nodes", json!([4])), "nodes[4]: is not there");
    let attributes = "/meshes/0/primitives/0/attributes/POSITION";
    assert_eq!(changed(attributes, json!(9)), "accessors[9]: is not there");
    assert_eq!(
        changed("/accessors/0/bufferView", json!(9)),
        "accessors[0]: its bufferView is not there"
    );
    assert_eq!(changed("/bufferViews/0/buffer", json!(5)), "buffers[5]: is not there");
    let mut file = ball();
    file.json["nodes"][0]["camera"] = json!(2);
    assert_eq!(refusal(&file.text()), "cameras[2]: is not there");
}

#[test]
fn numbers_beyond_their_buffers_are_refused() {
    assert_eq!(
        changed("/accessors/0/count", json!(1e15 as u64)),
        "accessors[0]: is beyond its bufferView"
    );
    assert_eq!(
        changed("/accessors/0/count", json!(u64::MAX)),
        "accessors[0]: is beyond its bufferView"
    );
    let offset = changed("/bufferViews/0/byteOffset", json!(u64::MAX));
    assert_eq!(offset, "accessors[0]: its bufferView is beyond its buffer");
    assert_eq!(
        changed("/accessors/0/componentType", json!(1)),
        "accessors[0]: has an unknown componentType"
    );
    assert_eq!(changed("/accessors/0/type", json!("VEC2")), "accessors[0]: is no VEC3");
}

#[test]
fn nodes_that_hang_on_themselves_are_refused() {
    let nodes = json!([{ "children": [1] }, { "children": [0] }]);
    let mut file = Gltf::with_nodes(nodes);
    file.json["scenes"] = json!([{ "nodes": [0] }]);
    assert_eq!(refusal(&file.text()), "nodes[0]: hangs on two nodes, or on itself");
    let twice = Gltf::with_nodes(json!([{ "children": [2] }, { "children": [2] }, {}]));
    assert_eq!(refusal(&twice.text()), "nodes[2]: hangs on two nodes, or on itself");
}

#[test]
fn values_that_make_no_sense_are_refused_at_their_node() {
    let mut file = ball();
    file.json["nodes"][0]["rotation"] = json!([0, 0, 0, 0]);
    let problem = "nodes[0]: has an invalid place, rotation or scale";
    assert_eq!(refusal(&file.text()), problem);
    let body = json!({ "motion": { "mass": -1 }, "collider": { "geometry": { "shape": 0 } } });
    let nodes = json!([{ "name": "Ball", "extensions": { "KHR_physics_rigid_bodies": body } }]);
    let shapes = json!({ "KHR_implicit_shapes": { "shapes": [{ "type": "sphere" }] } });
    let text = Gltf::with_nodes(nodes).with("extensions", shapes).text();
    let error = refusal(&text);
    assert!(error.starts_with("nodes[0] (Ball): spheres[0].mass: "), "{error}");
}

#[test]
fn an_extension_that_is_needed_and_not_read_is_refused() {
    let file = ball().with("extensionsRequired", json!(["KHR_draco_mesh_compression"]));
    let problem = "extensionsRequired[0]: KHR_draco_mesh_compression is not read";
    assert_eq!(refusal(&file.text()), problem);
}

#[test]
fn buffers_come_from_the_folder_of_the_file_only() {
    let outside = [
        "../secret.bin",
        "/etc/passwd",
        "a/../../secret.bin",
        "..%2Fsecret.bin",
        "file:///etc/passwd",
        "https://example.org/a.bin",
        "C:\\secret.bin",
        "",
    ];
    let folder = tempfile::TempDir::new().unwrap();
    std::fs::write(folder.path().join("secret.bin"), ball().buffer()).unwrap();
    let inner = folder.path().join("scene");
    std::fs::create_dir(&inner).unwrap();
    let path = inner.join("scene.gltf");
    let refused = |uri: &str| {
        std::fs::write(&path, ball().text_with_buffer(uri)).unwrap();
        carom_gltf::import(&path, &Options::default()).unwrap_err().to_string()
    };
    for uri in outside {
        let error = refused(uri);
        assert!(
            error.contains("buffers[0].uri: ") && error.contains("is no file in the folder"),
            "{uri}: {error}"
        );
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(folder.path().join("secret.bin"), inner.join("link.bin"))
            .unwrap();
        assert!(refused("link.bin").contains("is no file in the folder"));
    }
    assert!(refused("missing.bin").contains("cannot read missing.bin"));
    assert!(refused("data:,abc").contains("holds no base64"));
    assert!(refused("data:;base64,!!").contains("is no base64"));
    std::fs::write(inner.join("short.bin"), [0; 8]).unwrap();
    assert!(refused("short.bin").contains("is shorter than its byteLength"));
}

#[test]
fn broken_containers_are_refused() {
    let whole = ball().binary();
    let refusal = |bytes: &[u8]| import_bytes("scene.glb", bytes).unwrap_err().to_string();
    for len in [5, 11, 12, 16, 30, whole.len() - 1] {
        let error = refusal(&whole[..len]);
        assert!(error.contains("scene.glb: container: "), "{len}: {error}");
    }
    let mut version = whole.clone();
    version[4] = 1;
    assert!(refusal(&version).contains("has version 1 of the container; 2 is read"));
    assert!(refusal(b"glTF\x02\0\0\0\x0c\0\0\0").contains("has no JSON"));
    assert!(import_bytes("scene.glb", &whole).is_ok());
}

#[test]
fn many_meshes_of_the_same_bytes_and_deep_trees_end_in_time() {
    // Each mesh would read 30,000 numbers, all together a billion.
    let vertices = vec![[0.0; 3]; 10_000];
    let mut file = Gltf::with_nodes(json!([])).with_mesh(&vertices, &[0, 1, 2], None);
    let mesh = file.json["meshes"][0].clone();
    file.json["meshes"] = json!(vec![mesh; 30_000]);
    let nodes: Vec<_> = (0..30_000).map(|i| json!({ "mesh": i })).collect();
    (file.json["nodes"], file.json["scenes"]) = (json!(nodes), Value::Array(Vec::new()));
    let imported = file.imported();
    let report = files::report(&imported);
    assert!(report.iter().any(|it| it.contains("100,000,000 numbers")), "{report:?}");

    let collider = json!({ "collider": { "geometry": { "shape": 0 } } });
    let body = json!({ "KHR_physics_rigid_bodies": collider });
    let nodes: Vec<_> = (0..30_000)
        .map(|i| json!({ "name": "A long name", "children": [i + 1], "extensions": body }))
        .chain([json!({})])
        .collect();
    let shapes = json!({ "KHR_implicit_shapes": { "shapes": [{ "type": "sphere" }] } });
    let mut file = Gltf::with_nodes(json!([{}])).with("extensions", shapes);
    (file.json["nodes"], file.json["scenes"]) = (json!(nodes), json!([{ "nodes": [0] }]));
    assert_eq!(file.imported().scene.colliders.len(), 30_000);
}
