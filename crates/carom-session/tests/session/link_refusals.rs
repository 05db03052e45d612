//! A text that is no link returns an error in words, and no text makes the parser panic.

use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use carom_session::{Edit, Link, LinkSource, MAX_MOVES, MAX_UNPACKED, Session, SessionError};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use proptest::prelude::*;

use crate::busy_scene;

fn packed(bytes: &[u8]) -> String {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes).unwrap();
    URL_SAFE_NO_PAD.encode(encoder.finish().unwrap())
}

#[track_caller]
fn refusal(link: &str) -> String {
    let error = Link::parse(link).unwrap_err().to_string();
    assert_eq!(error.lines().count(), 1, "{error}");
    assert!(error.chars().count() <= LONGEST, "{error}");
    error
}

/// Longest error of a link \[characters\]: three lines of a window. Parts written by the author of
/// the link are shortened.
const LONGEST: usize = 300;

#[test]
fn every_mistake_is_told() {
    let parts = "scene, file, name, set, rule, edits, beside, beside-edits, t, camera, goal, moves";
    let empty = "the link is empty: after # it needs scene=NAME or file=...";
    let time =
        |t| format!("the link says t={t}; the time must be a number of seconds, zero or positive");
    let goal = |it| {
        format!("the link says goal={it}; the result to beat must be a number, zero or positive")
    };
    let camera = |it| {
        let form = "it must be x,y,z to look from and x,y,z to look at, in m, and may have a field of view in degrees";
        format!("the link says camera={it}; {form}")
    };
    let rule_in = |part, it| {
        format!("the link says {part}={it}; the rules are exact, contact, bisect, discrete")
    };
    let rule = |it| rule_in("rule", it);
    let unknown = |it| format!("the link has a part \"{it}\"; links know only {parts}");
    let long = format!("{}...", "x".repeat(40));
    let cases = [
        ("", empty.to_owned()),
        ("   ", empty.to_owned()),
        ("#", empty.to_owned()),
        ("http://127.0.0.1:8042/", empty.to_owned()),
        ("https://example.org/?scene=simtest1", empty.to_owned()),
        ("#&&", empty.to_owned()),
        ("t=1", "the link names no scene: it needs scene=NAME or file=...".to_owned()),
        ("simtest1", unknown("simtest1")),
        ("sceen=simtest1", unknown("sceen")),
        (&format!("scene=simtest1&{}=1", "x".repeat(1000)), unknown(&long)),
        ("scene=a&scene=b", "the link says scene twice".to_owned()),
        ("scene=a&goal=-1", goal("-1.0")),
        ("scene=a&goal=many", goal("many")),
        ("scene=a&t=1&t=1", "the link says t twice".to_owned()),
        ("scene=a&rule=exact&rule=exact", "the link says rule twice".to_owned()),
        (
            "scene=a&file=b",
            "the link says both scene and file; it can lead to one of them only".to_owned(),
        ),
        ("scene=a&name=b", "the link says name, which is for a file, but no file".to_owned()),
        ("scene=%FF%FE", "scene of the link is garbled: it is no text".to_owned()),
        ("scene=a&rule=fast", rule("fast")),
        ("scene=a&rule", rule("")),
        ("scene=a&beside=fast", rule_in("beside", "fast")),
        (
            "scene=a&beside-edits=x",
            "the link says beside-edits, which is for a second run, but no beside".to_owned(),
        ),
        ("scene=a&t=", time("")),
        ("scene=a&camera=1,2,3", camera("1,2,3")),
        ("scene=a&camera=1,2,3,1,2,3", camera("1,2,3,1,2,3")),
        ("scene=a&camera=1,2,3,4,5,inf", camera("1,2,3,4,5,inf")),
        ("scene=a&camera=1,2,3,4,5,x", camera("1,2,3,4,5,x")),
        ("scene=a&camera=1,2,3,4,5,6,7,8", camera("1,2,3,4,5,6,7,8")),
        ("scene=a&camera=1,2,3,4,5,6,180", camera("1,2,3,4,5,6,180")),
        ("scene=a&t=soon", time("soon")),
        ("scene=a&t=-1", time("-1.0")),
        ("scene=a&t=NaN", time("NaN")),
        ("scene=a&t=inf", time("inf")),
        ("scene=a&t=1e999", time("inf")),
        ("scene=a&set=x", "x: write it as path=value".to_owned()),
    ];
    for (link, expected) in cases {
        assert_eq!(refusal(link), expected, "{link}");
    }
}

#[test]
fn errors_of_scenes_in_links_are_short_whatever_the_link_says() {
    let long = "n".repeat(5000);
    let scenes = [
        format!("name = 3\n{long} = 1"),
        format!("{long} = 1"),
        format!("[simulation]\nrule = \"{long}\""),
        format!("[[spheres]]\nradius = \"{long}\""),
        format!("[[spheres]]\nradius = \"=2 * {long}\""),
        format!("[parameters]\n{long} = 1\n[[spheres]]\nradius = \"=2 * {long}x\""),
        format!("[[colliders]]\nshape = \"{long}\""),
        format!("include = \"{long}\""),
        format!("name = \"{long}\""),
        format!("[[spheres]]\ncolor = \"{long}\"\nradius = 1"),
        format!("spheres = [{long}]"),
    ];
    for scene in scenes {
        for set in ["", &format!("&set=simulation.{long}=1")] {
            let file = packed(scene.as_bytes());
            let link = Link::parse(&format!("file={file}&name={long}.toml{set}")).unwrap();
            let error = link.open().unwrap_err().to_string();
            assert_eq!(error.lines().count(), 1, "{error}");
            assert!(error.chars().count() <= LONGEST, "{}: {error}", error.len());
        }
    }
    for link in [format!("scene={long}"), format!("scene=simtest1&set=simulation.rule={long}")] {
        let error = Link::parse(&link).unwrap().open().unwrap_err().to_string();
        assert!(error.chars().count() <= LONGEST, "{}: {error}", error.len());
    }
    refusal(&format!("scene=simtest1&set={long}"));
    refusal(&format!("scene=simtest1&edits={}", packed(format!("{long} = 1").as_bytes())));
}

#[test]
fn packed_parts_that_are_not_whole_are_told() {
    let garbled =
        |part| format!("{part} of the link is cut short or garbled; was all of the link copied?");
    let text = packed(b"name = \"one\"");
    let cut = &text[..text.len() - 2];
    let trailing = URL_SAFE_NO_PAD
        .encode([URL_SAFE_NO_PAD.decode(&text).unwrap(), b"and more".to_vec()].concat());
    for file in ["", "!!!", "AAAA", cut, &trailing, &text.replace(&text[8..9], "")] {
        assert_eq!(refusal(&format!("file={file}")), garbled("file"), "{file}");
        assert_eq!(refusal(&format!("scene=simtest1&edits={file}")), garbled("edits"));
    }
    assert_eq!(
        refusal(&format!("file={}", packed(&[0xFF, 0xFE]))),
        "file of the link does not unpack to text"
    );
}

#[test]
fn what_would_fill_the_memory_is_refused() {
    let most = packed(&vec![b'#'; MAX_UNPACKED]);
    assert!(most.len() < MAX_UNPACKED / 100);
    Link::parse(&format!("file={most}")).unwrap();
    let longest = format!("scene=pinball&moves={}", packed(&vec![b'#'; MAX_MOVES]));
    assert_eq!(Link::parse(&longest).unwrap().moves().map(str::len), Some(MAX_MOVES));
    let error = refusal(&format!("scene=pinball&moves={}", packed(&vec![b'#'; MAX_MOVES + 1])));
    assert_eq!(error, "the moves of the link are longer than 64 KiB, the limit");
    let error = refusal(&format!("file={}", packed(&vec![b'#'; MAX_UNPACKED + 1])));
    assert_eq!(error, "file of the link unpacks to more than 8 MiB, the limit");
}

#[test]
fn what_would_end_the_stack_is_refused() {
    let deep = 100_000;
    let (dots, brackets) = (vec!["a"; deep].join("."), "[".repeat(deep));
    let text = |text: &str| packed(text.as_bytes());
    for refused in [
        format!("scene=simtest1&set={dots}=1"),
        format!("scene=simtest1&edits={}", text(&format!("{dots}=1"))),
        format!("scene=simtest1&edits={}", text(&format!("changes={brackets}"))),
    ] {
        assert!(Link::parse(&refused).is_err(), "{}...", &refused[..40]);
    }
    // These errors are found when the scene is read.
    for broken in [
        format!("scene=simtest1&set=title={brackets}"),
        format!("file={}", text(&format!("[{dots}]"))),
        format!("file={}", text(&format!("a={brackets}"))),
    ] {
        let _ = Link::parse(&broken).unwrap().open();
    }
}

#[test]
fn edits_that_make_no_sense_are_told() {
    let cases = [
        ("changes = 1", "in line 1, "),
        ("[[changes]]\nframe = -1\nchange = \"failed-step\"", "in line 2, "),
        ("[[changes]]\nframe = 1\nchange = \"undone\"", "in line 3, unknown variant `undone`"),
        (&format!("[[changes]]\n{} = 1", "x".repeat(1000)), "in line 2, unknown field"),
        ("[[changes]]\nframe = 1\nchange.frame-time = \"short\"", "in line 3, "),
        (
            "changes = [{ frame = 2, change = \"failed-step\" }, \
             { frame = 1, change = \"failed-step\" }]",
            "they are not in the order of their frames",
        ),
    ];
    for (text, expected) in cases {
        let link = format!("scene=simtest1&edits={}", packed(text.as_bytes()));
        let error = refusal(&link);
        assert!(error.starts_with("the edits of the link are invalid: "), "{error}");
        assert!(error.contains(expected), "{error}");
    }
}

proptest! {
    #[test]
    fn no_text_makes_it_panic(text in ".{0,60}") {
        let _ = Link::parse(&text);
    }

    #[test]
    fn no_parts_make_it_panic(
        parts in prop::collection::vec(
            ("(scene|file|name|set|rule|edits|t)", "=?", "[ -~]{0,12}"), 0..6)
    ) {
        let parts: Vec<String> = parts.iter().map(|(a, b, c)| format!("{a}{b}{c}")).collect();
        if let Ok(link) = Link::parse(&parts.join("&")) {
            // A text that is a link can be written as one.
            prop_assert_eq!(Link::parse(&link.to_fragment()).unwrap(), link);
        }
    }

    #[test]
    fn no_change_of_something_packed_goes_unnoticed(at in 0..100_usize, with in "[A-Za-z0-9_-]") {
        let text = busy_scene().to_toml();
        let whole = Link::new(LinkSource::File { name: String::new(), text });
        let mut fragment = whole.to_fragment();
        let at = "file=".len() + at * (fragment.len() - "file=".len()) / 100;
        fragment.replace_range(at..=at, &with);
        if let Ok(link) = Link::parse(&fragment) {
            prop_assert_eq!(link, whole);
        }
    }

    #[test]
    fn overrides_come_back_as_they_were(path in "[a-z][a-z0-9_.]{0,10}[a-z]", value in ".{0,20}") {
        if let Ok(it) = format!("{path}={value}").parse::<carom_scene::Override>() {
            let link = Link::new(LinkSource::BuiltIn("simtest1".to_owned()));
            let link = link.with_overrides([it]);
            prop_assert_eq!(Link::parse(&link.to_fragment()).unwrap(), link);
        }
    }
}

#[test]
fn a_time_that_cannot_be_counted_in_frames_is_refused() {
    let link = Link::parse("scene=simtest1&t=1e300").unwrap();
    let error = Session::replay(link.open().unwrap(), &link).unwrap_err();
    assert!(matches!(error, SessionError::TooFar { .. }), "{error}");
}

#[test]
fn what_is_no_edit_is_refused_in_a_line_that_says_why() {
    let refused = |text: &str| Edit::from_toml(text).unwrap_err();
    assert!(refused("change = { explode = 1 }").contains("explode"));
    assert!(refused("change = { all-collider-restitutions = \"high\" }").contains("line 1"));
    assert_eq!(refused("change = \"failed-step\""), "a failed step is no edit");
    assert!(refused("").contains("change"));
}

#[test]
fn a_link_reaches_for_no_file() {
    for name in ["scenes/simtest1.toml", "../../scenes/simtest1.toml", "/etc/passwd", "a.toml"] {
        let link = Link::new(LinkSource::BuiltIn(name.to_owned()));
        let error = link.open().unwrap_err().to_string();
        assert_eq!(error, format!("there is no scene \"{name}\""));
    }
}
