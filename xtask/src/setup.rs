//! What the checks need besides the toolchain itself.

use std::fs::File;
use std::path::Path;

use crate::files::{made, said};
use crate::shell::{Outcome, output, run, succeeds, target_folder};

/// Adds the toolchain's formatter and linter where they are missing.
pub fn toolchain() -> Outcome {
    for (command, component) in [("fmt", "rustfmt"), ("clippy", "clippy")] {
        if !succeeds("cargo", &[command, "--version"]) {
            run("rustup", &["component", "add", component])?;
        }
    }
    Ok(())
}

/// Something outside of Rust: how to tell that it is there, and the Debian packages that bring it.
#[derive(Clone, Copy)]
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

/// What puts the page together.
const PAGE: &[Need] = &[Need { is_met: has_node, packages: &["nodejs", "npm"] }];

/// What tests of the page look at it with: a browser, graphics in software, letters.
const BROWSER: &[Need] = &[
    Need { is_met: || succeeds("/usr/bin/chromium", &["--version"]), packages: &["chromium"] },
    Need {
        is_met: has_opengl_driver,
        packages: &["libegl1", "libgles2", "libegl-mesa0", "libgl1-mesa-dri"],
    },
    Need { is_met: || has_files("/usr/share/fonts"), packages: &["fonts-dejavu-core"] },
];

/// What builds and tests the Python package.
const PYTHON: &[Need] = &[Need { is_met: has_python, packages: &["python3", "python3-venv"] }];

/// What programs of the C interface are compiled and run with: compilers, a runtime of C#, a checker of memory, which
/// needs the symbols of the C library.
const C_INTERFACE: &[Need] = &[
    Need { is_met: || succeeds("c++", &["--version"]), packages: &["g++"] },
    Need {
        is_met: || succeeds("mcs", &["--version"]) && succeeds("mono", &["--version"]),
        packages: &["mono-mcs", "mono-runtime"],
    },
    Need {
        is_met: || succeeds("valgrind", &["--quiet", "true"]),
        packages: &["valgrind", "libc6-dbg"],
    },
];

/// What compiles for browsers where the standard library for them cannot be fetched.
const DEBIAN_WASM: &[Need] = &[Need {
    is_met: || succeeds("/usr/bin/wasm-ld-22", &["--version"]) && has_files("/usr/lib/rustlib/src"),
    packages: &["rustc-web", "cargo-web", "rust-web-src", "lld-22"],
}];

/// Installs what pictures, films and windows need.
pub fn graphics() -> Outcome {
    install(GRAPHICS)
}

/// Installs what the tests need besides.
pub fn film_tests() -> Outcome {
    install(FILM_TESTS)
}

/// Installs what puts the page together.
pub fn page() -> Outcome {
    install(PAGE)?;
    if has_node() {
        Ok(())
    } else {
        Err(format!("the page needs Node.js {NODE} or newer, and npm"))
    }
}

/// Installs what the tests of the page need besides.
pub fn browser() -> Outcome {
    install(BROWSER)
}

/// Installs what builds and tests the Python package.
pub fn python() -> Outcome {
    install(PYTHON)?;
    if has_python() {
        Ok(())
    } else {
        Err("the Python package needs CPython 3.10 or newer, with venv".to_owned())
    }
}

/// Installs what the programs of the C interface are compiled and run with.
pub fn c_interface() -> Outcome {
    install(C_INTERFACE)
}

/// Installs what all of it takes, at once.
pub fn everything() -> Outcome {
    install(&[GRAPHICS, FILM_TESTS, PAGE, BROWSER, PYTHON, C_INTERFACE].concat())
}

/// Installs Debian's compiler for browsers.
pub fn debian_wasm() -> Outcome {
    install(DEBIAN_WASM)
}

/// Installs what is missing with the system's package manager, if that is Debian's or one like it;
/// elsewhere says what is needed and goes on.
fn install(needs: &[Need]) -> Outcome {
    if missing(needs).is_empty() || !cfg!(target_os = "linux") {
        return Ok(());
    }
    // One at a time: another part of the checks may be installing the same.
    let path = made(target_folder())?.join("install.lock");
    let lock = File::create(&path).map_err(|error| said(&path, &error))?;
    lock.lock().map_err(|error| said(&path, &error))?;
    let missing = missing(needs);
    if missing.is_empty() {
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
    // Rather fail than remove what another program uses.
    let install = ["install", "-y", "-qq", "--no-install-recommends", "--no-remove"];
    with(&[&install[..], &missing].concat())
}

/// The packages of what is not there.
fn missing(needs: &[Need]) -> Vec<&'static str> {
    let missing = needs.iter().filter(|need| !(need.is_met)());
    missing.flat_map(|need| need.packages.iter().copied()).collect()
}

/// Whether the loader of Vulkan finds a driver.
fn has_vulkan_driver() -> bool {
    has_files("/usr/share/vulkan/icd.d") || has_files("/etc/vulkan/icd.d")
}

/// Whether the loader of EGL finds a driver.
fn has_opengl_driver() -> bool {
    has_files("/usr/share/glvnd/egl_vendor.d")
}

fn has_files(folder: &str) -> bool {
    Path::new(folder).read_dir().is_ok_and(|mut files| files.next().is_some())
}

/// Oldest version of Node.js whose test runner takes files one after another.
const NODE: u32 = 20;

/// Whether Node.js is there, new enough, with its package manager.
fn has_node() -> bool {
    let major = output("node", &["--version"])
        .and_then(|text| text.trim_start_matches('v').split('.').next()?.parse::<u32>().ok());
    major.is_some_and(|major| major >= NODE) && succeeds("npm", &["--version"])
}

/// The Python of this machine: `$PYTHON`, or the usual one.
pub fn python_program() -> String {
    let usual = if cfg!(windows) { "python" } else { "python3" };
    std::env::var("PYTHON").unwrap_or_else(|_| usual.to_owned())
}

/// Whether Python is there, new enough, and can make environments.
fn has_python() -> bool {
    let program = "import ensurepip, sys, venv; print(sys.version_info >= (3, 10))";
    output(python_program(), &["-c", program]).is_some_and(|answer| answer.trim() == "True")
}
