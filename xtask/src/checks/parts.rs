//! Every part of the checks, in the order in which they fail fastest.

use std::env;

use super::part::{Part, Reads};
use super::programs::{self, Program};
use crate::commands::{self, Programs};
use crate::shell::{CI, Outcome, cargo, cargo_with, ci_folder, finish, program};
use crate::{
    architecture, c_interface, circles, dependencies, documents, interface, interfaces, js_package,
    parts as python_parts, python, release, scene_reference, setup, sizes, stages, wasm, web,
    web_tools, words,
};

/// Names the packages whose tests run, with commas between them; where it is not set, all do.
pub const PACKAGES: &str = "CAROM_TEST_PACKAGES";

/// The parts.
pub const PARTS: [Part; 15] = [
    Part { name: "set-up", after: &[], reads: Reads::Everything, run: set_up },
    // What is built meanwhile needs nothing of it, or waits for it.
    Part { name: "lint", after: &[], reads: Reads::Everything, run: lint },
    Part {
        name: "modules",
        after: &["lint"],
        reads: Reads::Some { packages: &["carom-js", "carom-web"], paths: &["web/"] },
        run: modules,
    },
    Part { name: "clippy", after: &["lint"], reads: RUST, run: clippy },
    Part { name: "builds", after: &["clippy"], reads: RUST, run: builds },
    Part { name: "tests", after: &["builds"], reads: RUST, run: tests },
    Part {
        name: "physics",
        after: &["builds"],
        reads: Reads::Some { packages: PHYSICS, paths: &["examples/"] },
        run: physics,
    },
    Part { name: "examples", after: &["builds"], reads: RUST, run: examples },
    Part {
        name: "C",
        after: &["builds"],
        reads: Reads::Some { packages: &["carom-c"], paths: &["examples/"] },
        run: c_interface::test_built,
    },
    Part {
        name: "claims",
        after: &["builds"],
        reads: Reads::Some { packages: PHYSICS, paths: &[] },
        run: claims,
    },
    Part {
        name: "documents",
        after: &["builds"],
        reads: Reads::Some { packages: &["carom-cli"], paths: &["docs/", "README.md"] },
        run: commands_of_documents,
    },
    Part {
        name: "threads",
        after: &["builds"],
        reads: Reads::Some { packages: PHYSICS, paths: &[] },
        run: threads,
    },
    Part {
        name: "JavaScript",
        after: &["modules"],
        reads: Reads::Some { packages: &["carom-js"], paths: &["web/", "examples/"] },
        run: js_package::test,
    },
    Part {
        name: "Python",
        after: &["modules", "builds"],
        reads: Reads::Some {
            packages: &["carom-py", "carom-web"],
            paths: &["python/", "pyproject.toml", "web/", "docs/"],
        },
        run: python::test,
    },
    Part {
        name: "page",
        after: &["modules", "builds"],
        reads: Reads::Some { packages: &["carom-web", "carom-cli"], paths: &["web/"] },
        run: web::test,
    },
];

/// Any package.
const RUST: Reads = Reads::Some {
    packages: &["carom", "carom-analysis", "carom-c", "carom-fuzz", "carom-js", "carom-py"],
    paths: &["crates/", "docs/", "examples/"],
};
/// What has a part of its own for its tests.
const PHYSICS: &[&str] = &["carom", "carom-scene"];

/// Installs what all parts need; by itself each part installs what it needs.
fn set_up() -> Outcome {
    setup::everything()
}

/// Checks what needs no build: formats, words, names in documents, the order of modules.
pub fn lint() -> Outcome {
    setup::toolchain()?;
    cargo(&["fmt", "--all", "--check"])?;
    architecture::check()?;
    dependencies::check()?;
    words::check()?;
    circles::check()?;
    sizes::check()?;
    python_parts::check()?;
    stages::check()?;
    scene_reference::check()?;
    documents::check()?;
    interface::check()?;
    interfaces::check()?;
    release::check()
}

/// What the page, the JavaScript package and the viewer for notebooks are put together of.
fn modules() -> Outcome {
    setup::page()?;
    wasm::build("carom-web", wasm::Purpose::Test)?;
    web_tools::wasm_bindgen()?;
    web_tools::npm_packages()
}

fn clippy() -> Outcome {
    setup::toolchain()?;
    setup::graphics()?;
    let profile = ["--profile", CI, "--quiet"];
    let clippy = ["clippy", "--workspace", "--all-targets"];
    cargo(&[&clippy[..], &profile, &["--", "--deny", "warnings"]].concat())?;
    let documents = ["doc", "--workspace", "--no-deps", "--document-private-items"];
    cargo_with(&[&documents[..], &profile].concat(), &[("RUSTDOCFLAGS", "--deny warnings")])
}

/// Everything that tests run, and the builds with fewer features that some readers begin with.
fn builds() -> Outcome {
    programs::build()?;
    let check = |arguments: &[&str]| {
        cargo(&[&["check", "--profile", CI, "--quiet", "--package"], arguments].concat())
    };
    // The scene files can be read without the crates that only recordings need.
    check(&["carom-scene", "--no-default-features"])?;
    // The command line is built without pictures, too, by those who work on the physics; the
    // Python package, by those who have no C++ compiler.
    check(&["carom-cli", "--no-default-features"])?;
    check(&["carom-py", "--no-default-features"])
}

/// All tests but those of the physics.
fn tests() -> Outcome {
    setup::film_tests()?;
    let chosen = env::var(PACKAGES).ok();
    let is_chosen = |program: &Program| {
        chosen.as_ref().is_none_or(|names| names.split(',').any(|it| it == program.package))
    };
    let is_physics = |program: &Program| PHYSICS.contains(&program.package.as_str());
    let mut programs = programs::build()?;
    programs.retain(|program| is_chosen(program) && !is_physics(program));
    // Graphics libraries need this folder, and complain aloud where a system names none.
    let folder = env::var("XDG_RUNTIME_DIR").unwrap_or_else(|_| "/tmp".to_owned());
    programs::run(&programs, &[], &[("XDG_RUNTIME_DIR", &folder)])
}

/// The tests of the physics, once: with assertions, with checks of overflows, without threads. The bits
/// are those of a release on any number of threads, as [`threads`] checks.
fn physics() -> Outcome {
    let checked = |package: &&str| {
        let setting = |name: &str| format!("profile.{CI}.package.{package}.{name}=true");
        ["debug-assertions", "overflow-checks"].map(setting)
    };
    // Rather built soon than fast.
    let mut settings = vec![format!("profile.{CI}.package.carom.opt-level=1")];
    settings.push(format!("profile.{CI}.package.carom.codegen-units=16"));
    settings.extend(PHYSICS.iter().flat_map(checked));
    let settings = settings.iter().flat_map(|setting| ["--config", setting]);
    let packages = PHYSICS.iter().flat_map(|package| ["--package", package]);
    let test = ["test", "--profile", CI, "--lib", "--tests", "--quiet"];
    cargo(&test.into_iter().chain(packages).chain(settings).collect::<Vec<_>>())
}

/// The examples in the documentation of functions.
fn examples() -> Outcome {
    cargo(&["test", "--doc", "--workspace", "--profile", CI, "--quiet"])
}

/// What the physics is held against.
fn claims() -> Outcome {
    programs::build()?;
    finish("carom", program("carom").arg("verify"))
}

fn commands_of_documents() -> Outcome {
    programs::build()?;
    commands::check(&Programs { plain: ci_folder(), drawing: Some(ci_folder()) })
}

/// The same bits on any number of threads.
fn threads() -> Outcome {
    let programs = programs::build()?;
    let named = |package, name| programs::named(&programs, package, name);
    let run = |threads, programs: &[Program], filter: &[&str]| {
        programs::run(programs, filter, &[("RAYON_NUM_THREADS", threads)])
    };
    for threads in ["1", "2", "3", "8"] {
        run(threads, &named("carom", "contact_rule")?, &["bits"])?;
        run(threads, &named("carom", "exact")?, &[])?;
    }
    run("1", &named("carom", "gases_on_threads")?, &[])?;
    run("1", &named("carom-scene", "scenes")?, &["hashes"])?;
    run("3", &named("carom-scene", "scenes")?, &["hashes"])
}
