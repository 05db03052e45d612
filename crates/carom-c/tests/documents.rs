//! Documents and C# agree with the interface.

use std::fs;
use std::path::Path;

fn read(file: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap()
}

/// Returns the blocks of C code in a document.
fn blocks(document: &str) -> Vec<String> {
    let starts = document.split("\n```c\n").skip(1);
    starts.map(|rest| format!("{}\n", rest.split("\n```").next().unwrap())).collect()
}

#[test]
fn the_first_lines_of_guide_and_readme_are_of_a_program_that_tests_run() {
    let program = read("examples/bouncing_ball.c");
    let lines: Vec<&str> = program.lines().map(str::trim).collect();
    for document in ["../../docs/c.md", "../../README.md"] {
        for line in blocks(&read(document))[0].lines() {
            assert!(lines.contains(&line.trim()), "{document}: {line}");
        }
    }
}

/// Returns the names of an enumeration of the header in order: `CAROM_LIST_LEFT_OUT = 6` becomes
/// `leftout`. They must count up from 0.
fn of_header(name: &str) -> Vec<String> {
    let (header, prefix) = (read("include/carom.h"), format!("CAROM_{name}_"));
    let numbered =
        header.lines().filter_map(|line| line.trim().strip_prefix(&prefix)?.split_once(" = "));
    let numbered: Vec<(String, String)> = numbered
        .map(|(name, number)| (name.replace('_', "").to_lowercase(), number.replace(',', "")))
        .collect();
    for (place, (name, number)) in numbered.iter().enumerate() {
        assert_eq!(*number, place.to_string(), "{name}");
    }
    numbered.into_iter().map(|(name, _)| name).collect()
}

/// Returns the names of an enumeration of C# in order.
fn of_csharp(name: &str) -> Vec<String> {
    let source = read("csharp/CaromWorld.cs");
    let (_, rest) = source.split_once(&format!("public enum {name}")).unwrap();
    let body = rest.split(['{', '}']).nth(1).unwrap();
    let names = body.split(',').map(|name| name.trim().to_lowercase());
    names.filter(|name| !name.is_empty()).collect()
}

#[test]
fn enumerations_of_csharp_are_those_of_the_header() {
    for name in ["Status", "Quantity", "Shape", "List"] {
        let found = of_csharp(&format!("Carom{name}"));
        assert!(found.len() > 5, "{name}: {found:?}");
        assert_eq!(found, of_header(&name.to_uppercase()), "{name}");
    }
}

#[test]
fn csharp_calls_functions_of_the_header() {
    let (header, source) = (read("include/carom.h"), read("csharp/CaromWorld.cs"));
    let declared = source.lines().filter_map(|line| line.split_once("extern ")?.1.split_once('('));
    let names: Vec<&str> = declared.filter_map(|(line, _)| line.split(' ').next_back()).collect();
    assert!(names.len() > 40, "{names:?}");
    for name in names {
        assert!(
            header.contains(&format!(" {name}(")) || header.contains(&format!("*{name}(")),
            "{name}"
        );
    }
    assert!(source.contains(&format!("AbiVersion = {};", carom_c::CAROM_ABI_VERSION)));
}
