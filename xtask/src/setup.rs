//! What the checks need besides the toolchain itself.

use std::path::Path;

use crate::shell::{Outcome, run, succeeds};

/// Adds the toolchain's formatter and linter where they are missing.
pub fn toolchain() -> Outcome {
    for (command, component) in [("fmt", "rustfmt"), ("clippy", "clippy")] {
        if !succeeds("cargo", &[command, "--version"]) {
            run("rustup", &["component", "add", component])?;
        }
    }
    Ok(())
}

/// Adds the standard library of another target where it is missing.
pub fn browser_target(target: &str) -> Outcome {
    run("rustup", &["target", "add", target])
}

/// Something outside of Rust: how to tell that it is there, and the Debian packages that bring it.
struct Need {
    is_met: fn() -> bool,
    packages: &'static [&'static str],
}

/// What pictures, films and windows need to be built and drawn.
const GRAPHICS: &[Need] = &[
    Need { is_met: || succeeds("c++", &["--version"]), packages: &["g++"] },
    // Films are encoded three times as fast with it.
    Need { is_met: || succeeds("nasm", &["-v"]), packages: &["nasm"] },
    Need {
        is_met: || succeeds("pkg-config", &["--exists", "libudev"]),
        packages: &["pkg-config", "libudev-dev"],
    },
    Need { is_met: has_vulkan_driver, packages: &["libvulkan1", "mesa-vulkan-drivers"] },
];

/// What tests of films look at them with.
const FILM_TESTS: &[Need] =
    &[Need { is_met: || succeeds("ffprobe", &["-version"]), packages: &["ffmpeg"] }];

/// Installs what pictures, films and windows need.
pub fn graphics() -> Outcome {
    install(GRAPHICS)
}

/// Installs what the tests need besides.
pub fn film_tests() -> Outcome {
    install(FILM_TESTS)
}

/// Installs what is missing with the system's package manager, if that is Debian's or one like it;
/// elsewhere says what is needed and goes on.
fn install(needs: &[Need]) -> Outcome {
    let missing: Vec<&str> = needs
        .iter()
        .filter(|need| !(need.is_met)())
        .flat_map(|need| need.packages.iter().copied())
        .collect();
    if missing.is_empty() || !cfg!(target_os = "linux") {
        return Ok(());
    }
    if !succeeds("apt-get", &["--version"]) {
        eprintln!("xtask: this needs what Debian calls {}", missing.join(", "));
        return Ok(());
    }
    let (program, first) = if succeeds("test", &["-w", "/usr/bin"]) {
        ("apt-get", None)
    } else {
        ("sudo", Some("apt-get"))
    };
    let with = |arguments: &[&str]| {
        let all: Vec<&str> = first.into_iter().chain(arguments.iter().copied()).collect();
        run(program, &all)
    };
    with(&["update", "-qq"])?;
    with(&[&["install", "-y", "-qq", "--no-install-recommends"], &missing[..]].concat())
}

/// Whether the loader of Vulkan finds a driver.
fn has_vulkan_driver() -> bool {
    let folders = ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"];
    folders
        .iter()
        .any(|folder| Path::new(folder).read_dir().is_ok_and(|mut files| files.next().is_some()))
}
