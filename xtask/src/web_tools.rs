//! Programs that build and test the page.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::shell::{Outcome, finish, root};
use crate::tools::Tool;

/// Returns the folder of the page.
pub fn folder() -> PathBuf {
    root().join("web")
}

/// Returns the command `wasm-bindgen` in the version of the modules. Installs it into the target
/// folder if the system has another version or none.
pub fn wasm_bindgen() -> Outcome<PathBuf> {
    let version = &locked_version("wasm-bindgen")?;
    Tool { package: "wasm-bindgen-cli", program: "wasm-bindgen", version, arguments: &[] }
        .installed()
}

/// Returns the version of a package in `Cargo.lock`.
fn locked_version(package: &str) -> Outcome<String> {
    let lock = read(&root().join("Cargo.lock"))?;
    let heading = format!("name = \"{package}\"\nversion = \"");
    lock.split_once(&heading)
        .and_then(|(_, rest)| rest.split_once('"'))
        .map(|(version, _)| version.to_owned())
        .ok_or_else(|| format!("Cargo.lock holds no {package}"))
}

/// Installs the packages in `package-lock.json` into `web/node_modules`, unless that is up to date.
pub fn npm_packages() -> Outcome {
    let installed = folder().join("node_modules/.package-lock.json");
    let wanted = folder().join("package-lock.json");
    let time = |path: &Path| path.metadata().and_then(|it| it.modified()).ok();
    if time(&installed).is_some_and(|installed| Some(installed) >= time(&wanted)) {
        return Ok(());
    }
    // No package needs its scripts.
    let arguments = ["ci", "--ignore-scripts", "--no-audit", "--no-fund"];
    finish("npm", Command::new("npm").args(arguments).current_dir(folder()))
}

/// Runs Node.js in the folder of the page.
pub fn node(arguments: &[&str], variables: &[(&str, &str)]) -> Outcome {
    let mut command = Command::new("node");
    command.args(arguments).envs(variables.iter().copied()).current_dir(folder());
    finish("node", &mut command)
}

fn read(path: &Path) -> Outcome<String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}
