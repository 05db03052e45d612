//! Broken files are refused with the file, the line, and the problem.

mod fixtures;

use std::fs;

use carom_unity::{ImportError, Mapping, Options, Project, import};
use fixtures::Copy;

const FIRST: &str = "Assets/Scenes/First.unity";
const BALL: &str = "Assets/Prefabs/Ball.prefab";

/// Replaces a text in a file and imports the first scene; returns the error.
#[track_caller]
fn refusal(file: &str, old: &str, new: &str) -> String {
    let copy = Copy::new();
    copy.change(file, old, new);
    copy.refusal("First")
}

/// Number of the first line with `text` in a file of the project.
fn line(file: &str, text: &str) -> usize {
    let whole = fs::read_to_string(fixtures::project().join(file)).unwrap();
    1 + whole.lines().position(|line| line.contains(text)).unwrap()
}

#[test]
fn a_file_that_is_no_text_is_refused() {
    let copy = Copy::new();
    fs::write(copy.path(FIRST), b"%YAML 1.1\n\xff\xfe").unwrap();
    assert!(copy.refusal("First").starts_with("First.unity:2: is no text: in Unity set"));
    fs::write(copy.path(FIRST), "name = 'a scene of Carom'").unwrap();
    let begin = "First.unity:1: is no file of Unity: it must begin with %YAML";
    assert_eq!(copy.refusal("First"), begin);
}

#[test]
fn a_head_of_a_document_that_is_broken_is_named_by_its_line() {
    let at = line(FIRST, "--- !u!104");
    assert_eq!(
        refusal(FIRST, "--- !u!104 &90", "--- !u!104 & 90"),
        format!("First.unity:{at}: must be the head of a document, like `--- !u!4 &123`")
    );
}

#[test]
fn a_conflict_of_a_merge_is_named_as_such() {
    let conflict = "<<<<<<< HEAD\n  m_Fog: 0";
    let at = line(FIRST, "m_Fog");
    assert_eq!(
        refusal(FIRST, "  m_Fog: 0", conflict),
        format!("First.unity:{at}: has a conflict of a merge: solve it first")
    );
}

#[test]
fn broken_yaml_is_named_by_its_line() {
    let at = line(FIRST, "m_Fog");
    let text = refusal(FIRST, "m_Fog: 0", "m_Fog: {x: 1");
    // The parser reports the missing bracket on the next line.
    assert!(text.starts_with(&format!("First.unity:{}: is no YAML: ", at + 1)), "{text}");
    let deep = format!("m_Fog: {}{}", "[".repeat(80), "]".repeat(80));
    let text = refusal(FIRST, "m_Fog: 0", &deep);
    assert_eq!(text, format!("First.unity:{at}: has values more than 64 deep in each other"));
    let text = refusal(FIRST, "m_Fog: 0", &format!("m_Fog: {}", "[".repeat(100_000)));
    assert!(text.starts_with(&format!("First.unity:{at}: ")), "{text}");
    let text = refusal(FIRST, "m_Fog: 0", "m_Fog: &a 1\n  m_Other: *a");
    assert!(text.ends_with("has an alias, which Unity never writes"), "{text}");
}

#[test]
fn numbers_that_are_none_are_named_by_their_line() {
    let at = line(FIRST, "period");
    assert_eq!(
        refusal(FIRST, "period: 0.7", "period: soon"),
        format!("First.unity:{at}: period must be a finite number, not \"soon\"")
    );
    assert_eq!(
        refusal(FIRST, "{x: 0.64, y: 12.21, z: 0}", "{x: 0.64, y: 12.21}"),
        format!("First.unity:{}: m_LocalPosition must have x, y, z", line(FIRST, "x: 0.64"))
    );
    let text = refusal(FIRST, "w: 0.8754261", "w: 1e300");
    assert!(text.ends_with("m_LocalRotation must be a quaternion of length 1"), "{text}");
}

#[test]
fn values_that_make_no_sense_in_a_scene_are_named_by_their_script() {
    // The line is that of the script's header.
    let at = line(FIRST, "&81");
    let text = refusal(FIRST, "period: 0.7", "period: 0");
    assert!(text.starts_with(&format!("First.unity:{at}: emitters[0]")), "{text}");
    let text = refusal(FIRST, "maxSpheres: 25", "maxSpheres: 2.5");
    assert_eq!(text, format!("First.unity:{at}: max spheres cannot be 2.5"));
    let text = refusal(FIRST, "--- !u!4 &6\n", "--- !u!4 &9\n");
    assert!(text.ends_with("the id 9 is there twice"), "{text}");
}

#[test]
fn a_broken_prefab_is_named_by_its_own_file() {
    let at = line(BALL, "m_LocalRotation");
    assert_eq!(
        refusal(BALL, "m_LocalRotation: {x: 0", "m_LocalRotation: {x: "),
        format!("Ball.prefab:{at}: m_LocalRotation.x must be a finite number, not \"\"")
    );
}

#[test]
fn transforms_and_prefabs_in_circles_are_refused() {
    let text = refusal(FIRST, "m_Father: {fileID: 0}", "m_Father: {fileID: 41}");
    assert!(text.ends_with("the transform hangs on itself"), "{text}");

    let copy = Copy::new();
    let guid = |name: &str| {
        let meta = fs::read_to_string(copy.path(&format!("Assets/Prefabs/{name}.meta"))).unwrap();
        meta.lines().find_map(|line| line.strip_prefix("guid: ")).unwrap().to_owned()
    };
    let variant = "Assets/Prefabs/Large.prefab";
    let source = format!("m_SourcePrefab: {{fileID: 100100000, guid: {}", guid("Ball.prefab"));
    copy.change(variant, &source, &source.replace(&guid("Ball.prefab"), &guid("Large.prefab")));
    let text = copy.refusal("Nested");
    assert!(
        text.starts_with("Large.prefab:3: the prefab ") && text.ends_with("holds itself"),
        "{text}"
    );
}

#[test]
fn prefabs_that_double_again_and_again_are_refused_in_time() {
    let copy = Copy::new();
    let head = "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n";
    let instance = |id: u64, guid: &str| {
        format!(
            "--- !u!1001 &{id}\nPrefabInstance:\n  m_SourcePrefab: {{fileID: 1, guid: {guid}}}\n"
        )
    };
    let start = std::time::Instant::now();
    for level in 0..30 {
        let below = format!("{:032}", level + 1);
        let text = match level {
            29 => format!("{head}--- !u!1 &{}\nGameObject:\n  m_Name: leaf\n", 1_u64 << 60),
            // Each level uses its own bits, so that all ids differ.
            _ => {
                let id = 1 << (2 * level);
                format!("{head}{}{}", instance(id, &below), instance(2 * id, &below))
            }
        };
        let path = copy.path(&format!("Assets/{level}.prefab"));
        fs::write(&path, text).unwrap();
        fs::write(path.with_extension("prefab.meta"), format!("guid: {level:032}\n")).unwrap();
    }
    fs::write(copy.path(FIRST), format!("{head}{}", instance(1 << 61, &"0".repeat(32)))).unwrap();
    let text = copy.refusal("First");
    assert!(text.ends_with("all instances of prefabs take more than 512 MiB"), "{text}");
    // Copying half a gigabyte takes some seconds.
    assert!(start.elapsed().as_secs() < 120);
}

#[test]
fn a_mapping_file_with_a_slip_is_named_by_its_line() {
    let copy = Copy::new();
    copy.change("fields.toml", "period =", "perod =");
    let error = Mapping::from_file(&copy.path("fields.toml")).unwrap_err().to_string();
    assert!(error.contains("fields.toml:5: ") && error.contains("perod"), "{error}");
}

#[test]
fn a_scene_that_is_not_there_is_unreadable() {
    let missing = fixtures::scene("Missing");
    let error = Project::around(&missing).unwrap_err();
    assert!(matches!(error, ImportError::Unreadable { .. }), "{error}");
    let project = Project::around(&fixtures::project()).unwrap();
    let error = import(&missing, &project, &Options::default()).unwrap_err();
    assert!(matches!(error, ImportError::Unreadable { .. }), "{error}");
}
