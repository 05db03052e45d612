//! Installs what the checks need besides the toolchain.

use std::fs::File;
use std::path::Path;

use crate::files::{made, said};
use crate::shell::{Outcome, output, run, succeeds, target_folder};

/// Installs the toolchain's formatter and linter if they are missing.
pub fn toolchain() -> Outcome {
    for (command, component) in [("fmt", "rustfmt"), ("clippy", "clippy")] {
        if !succeeds("cargo", &[command, "--version"]) {
            run("rustup", &["component", "add", component])?;
        }
    }
    Ok(())
}

/// A requirement outside of Rust: a test whether it is met, and the Debian packages that provide
/// it.
#[derive(Clone, Copy)]
struct Need {
    is_met: fn() -> bool,
    packages: &'static [&'static str],
}

/// Requirements of pictures, films and windows.
const GRAPHICS: &[Need] = &[
    Need { is_met: || succeeds("c++", &["--version"]), packages: &["g++"] },
    // Encoding films is three times as fast with it.
    Need { is_met: || succeeds("nasm", &["-v"]), packages: &["nasm"] },
    Need {
        is_met: || succeeds("pkg-config", &["--exists", "libudev"]),
        packages: &["pkg-config", "libudev-dev"],
    },
    Need { is_met: has_vulkan_driver, packages: &["libvulkan1", "mesa-vulkan-drivers"] },
];

/// Requirements of tests of films.
const FILM_TESTS: &[Need] =
    &[Need { is_met: || succeeds("ffprobe", &["-version"]), packages: &["ffmpeg"] }];

/// Requirements of building the page.
const PAGE: &[Need] = &[Need { is_met: has_node, packages: &["nodejs", "npm"] }];

/// Requirements of tests of the page: a browser, software graphics, fonts.
const BROWSER: &[Need] = &[
    Need { is_met: || succeeds("/usr/bin/chromium", &["--version"]), packages: &["chromium"] },
    Need {
        is_met: has_opengl_driver,
        packages: &["libegl1", "libgles2", "libegl-mesa0", "libgl1-mesa-dri"],
    },
    Need { is_met: || has_files("/usr/share/fonts"), packages: &["fonts-dejavu-core"] },
];

/// Requirements of building and testing the Python package.
const PYTHON: &[Need] = &[Need { is_met: has_python, packages: &["python3", "python3-venv"] }];

/// Requirements of programs of the C interface: compilers, a C# runtime, a memory checker, which
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

/// Debian's compiler for browsers, used if the standard library for them cannot be downloaded.
const DEBIAN_WASM: &[Need] = &[Need {
    is_met: || succeeds("/usr/bin/wasm-ld-22", &["--version"]) && has_files("/usr/lib/rustlib/src"),
    packages: &["rustc-web", "cargo-web", "rust-web-src", "lld-22"],
}];

/// Installs the requirements of pictures, films and windows.
pub fn graphics() -> Outcome {
    install(GRAPHICS)
}

/// Installs the additional requirements of tests of films.
pub fn film_tests() -> Outcome {
    install(FILM_TESTS)
}

/// Installs the requirements of building the page.
pub fn page() -> Outcome {
    install(PAGE)?;
    if has_node() {
        Ok(())
    } else {
        Err(format!("the page needs Node.js {NODE} or newer, and npm"))
    }
}

/// Installs the additional requirements of tests of the page, which makes films, too.
pub fn browser() -> Outcome {
    install(&[BROWSER, FILM_TESTS].concat())
}

/// Installs the requirements of building and testing the Python package.
pub fn python() -> Outcome {
    install(PYTHON)?;
    if has_python() {
        Ok(())
    } else {
        Err("the Python package needs CPython 3.10 or newer, with venv".to_owned())
    }
}

/// Installs the requirements of programs of the C interface.
pub fn c_interface() -> Outcome {
    install(C_INTERFACE)
}

/// Installs all requirements at once.
pub fn everything() -> Outcome {
    install(&[GRAPHICS, FILM_TESTS, PAGE, BROWSER, PYTHON, C_INTERFACE].concat())
}

/// Installs Debian's compiler for browsers.
pub fn debian_wasm() -> Outcome {
    install(DEBIAN_WASM)
}

/// Installs missing requirements with Debian's package manager. On other systems prints what is
/// needed and continues.
fn install(needs: &[Need]) -> Outcome {
    if missing(needs).is_empty() || !cfg!(target_os = "linux") {
        return Ok(());
    }
    // Only one process at a time: another part of the checks may install the same packages.
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
    // Fails rather than remove packages that other programs use.
    let install = ["install", "-y", "-qq", "--no-install-recommends", "--no-remove"];
    with(&[&install[..], &missing].concat())
}

/// Returns the packages of unmet requirements.
fn missing(needs: &[Need]) -> Vec<&'static str> {
    let missing = needs.iter().filter(|need| !(need.is_met)());
    missing.flat_map(|need| need.packages.iter().copied()).collect()
}

/// Returns whether the Vulkan loader finds a driver.
fn has_vulkan_driver() -> bool {
    has_files("/usr/share/vulkan/icd.d") || has_files("/etc/vulkan/icd.d")
}

/// Returns whether the EGL loader finds a driver.
fn has_opengl_driver() -> bool {
    has_files("/usr/share/glvnd/egl_vendor.d")
}

fn has_files(folder: &str) -> bool {
    Path::new(folder).read_dir().is_ok_and(|mut files| files.next().is_some())
}

/// Oldest version of Node.js whose test runner runs files one after another.
const NODE: u32 = 20;

/// Returns whether Node.js is installed, recent enough, with npm.
fn has_node() -> bool {
    let major = output("node", &["--version"])
        .and_then(|text| text.trim_start_matches('v').split('.').next()?.parse::<u32>().ok());
    major.is_some_and(|major| major >= NODE) && succeeds("npm", &["--version"])
}

/// Returns the Python of this machine: `$PYTHON`, or the default one.
pub fn python_program() -> String {
    let usual = if cfg!(windows) { "python" } else { "python3" };
    std::env::var("PYTHON").unwrap_or_else(|_| usual.to_owned())
}

/// Returns whether Python is installed, recent enough, and can make environments.
fn has_python() -> bool {
    let program = "import ensurepip, sys, venv; print(sys.version_info >= (3, 10))";
    output(python_program(), &["-c", program]).is_some_and(|answer| answer.trim() == "True")
}
