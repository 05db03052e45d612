//! Builds, packs, tests and measures the JavaScript package `carom`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::files::{copy, emptied, made, said};
use crate::shell::{Outcome, cargo, finish, root, target_folder};
use crate::wasm::{self, Purpose};
use crate::wasm_toolchain::TARGET;
use crate::web_tools::{folder, node, npm_packages, wasm_bindgen};
use crate::{native_hashes, notices, setup};

/// Files of the repository that are copied into the package: source and destination.
const FILES: [(&str, &str); 5] = [
    ("web/package/package.json", "package.json"),
    ("web/package/README.md", "README.md"),
    ("web/package/src", "src"),
    ("LICENSE-APACHE", "LICENSE-APACHE"),
    ("LICENSE-MIT", "LICENSE-MIT"),
];

/// Builds the package and packs it for the npm registry. Returns the archive.
pub fn build(purpose: Purpose) -> Outcome<PathBuf> {
    setup::page()?;
    check_version()?;
    let module = wasm::build("carom-js", purpose)?;
    let package = anew("js-package/package")?;
    for (from, to) in FILES {
        copy(&root().join(from), &package.join(to))?;
    }
    write(&package.join(notices::FILE), &notices::of("carom-js", TARGET)?)?;
    bind(&module, &package.join("src"))?;
    pack(&package)
}

/// The pinball of the examples, which is tested with the package: source and destination.
const GAME: [(&str, &str); 9] = [
    ("examples/pinball/table.toml", "pinball/table.toml"),
    ("examples/pinball/ten_seconds.txt", "pinball/ten_seconds.txt"),
    ("examples/pinball-web/index.html", "pinball-web/index.html"),
    ("examples/pinball-web/style.css", "pinball-web/style.css"),
    ("examples/pinball-web/main.js", "pinball-web/main.js"),
    ("examples/pinball-web/picture.js", "pinball-web/picture.js"),
    ("examples/pinball-web/sound.js", "pinball-web/sound.js"),
    ("examples/pinball-web/table.js", "pinball-web/table.js"),
    ("web/node_modules/three/build", "pinball-web/node_modules/three/build"),
];

/// Builds the package, tests the content of the archive in Node.js, and plays the pinball of the
/// examples in a browser.
pub fn test() -> Outcome {
    let archive = build(Purpose::Test)?;
    npm_packages()?;
    let user = anew("js-package/user")?;
    write(&user.join("package.json"), "{ \"private\": true, \"type\": \"module\" }\n")?;
    let quiet = ["--no-audit", "--no-fund", "--offline", "--quiet"];
    finish("npm", Command::new("npm").arg("install").args(quiet).arg(&archive).current_dir(&user))?;
    copy(&folder().join("package/tests"), &user.join("tests"))?;
    write(&user.join("tests/native_hashes.json"), &native_hashes::json()?)?;
    copy_game(&user)?;
    let compiler = folder().join("node_modules/typescript/bin/tsc");
    let project = ["--project", "tests"];
    finish("tsc", Command::new("node").arg(compiler).args(project).current_dir(&user))?;
    let files = test_files(&user)?;
    finish("node", Command::new("node").arg("--test").args(files).current_dir(&user))?;
    setup::browser()?;
    node(&["tests/pinball_page.js", &user.to_string_lossy()], &[])
}

/// Copies the pinball of the examples, with the packages that its page imports.
fn copy_game(user: &Path) -> Outcome {
    made(user.join("pinball"))?;
    made(user.join("pinball-web/node_modules/three"))?;
    for (from, to) in GAME {
        copy(&root().join(from), &user.join(to))?;
    }
    copy(&user.join("node_modules/carom"), &user.join("pinball-web/node_modules/carom"))
}

/// Compares frame times of the package in Node.js with those of the native engine.
pub fn bench() -> Outcome {
    build(Purpose::Use)?;
    cargo(&["build", "--release", "--package", "carom-js", "--example", "frame_times"])?;
    let native = target_folder().join("release/examples/frame_times");
    let package = target_folder().join("js-package/package/src/index.node.js");
    let script = folder().join("package/bench/compare.js");
    finish("node", Command::new("node").arg(script).arg(native).arg(package))
}

/// Checks that the package has the version of the engine.
fn check_version() -> Outcome {
    let version = format!("\"version\": \"{}\"", env!("CARGO_PKG_VERSION"));
    let file = folder().join("package/package.json");
    let text = fs::read_to_string(&file).map_err(|error| said(&file, &error))?;
    if text.contains(&version) {
        return Ok(());
    }
    Err(format!("{} must say {version}, as Cargo.toml does", file.display()))
}

/// Runs `wasm-bindgen`, which writes a JavaScript module around the engine. The package itself
/// decides where the engine is loaded from.
fn bind(module: &Path, out: &Path) -> Outcome {
    let options = ["--target", "web", "--omit-default-module-path", "--no-typescript"];
    let mut command = Command::new(wasm_bindgen()?);
    command.args(options).args(["--remove-name-section", "--remove-producers-section"]);
    command.args(["--out-name", "engine"]);
    finish("wasm-bindgen", command.arg("--out-dir").arg(out).arg(module))
}

/// Packs a folder. Returns the archive, which is beside the folder.
fn pack(package: &Path) -> Outcome<PathBuf> {
    let folder = package.parent().unwrap_or(package);
    let mut command = Command::new("npm");
    command.args(["pack", "--pack-destination"]).arg(folder).current_dir(package);
    finish("npm", &mut command)?;
    Ok(folder.join(concat!("carom-", env!("CARGO_PKG_VERSION"), ".tgz")))
}

/// Returns an empty folder below the target folder.
fn anew(name: &str) -> Outcome<PathBuf> {
    emptied(target_folder().join(name))
}

/// Returns the test files in `tests/` of a folder by name, because not every version of Node.js
/// finds them by the folder.
fn test_files(folder: &Path) -> Outcome<Vec<String>> {
    let mut names = Vec::new();
    let entries = fs::read_dir(folder.join("tests")).map_err(|error| error.to_string())?;
    for entry in entries {
        let name = entry.map_err(|error| error.to_string())?.file_name();
        let name = name.to_string_lossy();
        if name.ends_with(".test.js") {
            names.push(format!("tests/{name}"));
        }
    }
    names.sort_unstable();
    Ok(names)
}

fn write(file: &Path, text: &str) -> Outcome {
    fs::write(file, text).map_err(|error| said(file, &error))
}
