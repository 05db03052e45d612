//! The source distribution of the Python package.

use std::path::Path;
use std::process::{Command, Stdio};

use super::{archive, files};
use crate::files::only_file;
use crate::member::{Member, all, built_from};
use crate::python::Environment;
use crate::shell::{Outcome, cargo_program, printed, root};

/// The crate that the Python package is built from.
const ENGINE: &str = "carom-py";
/// Files of the distribution besides crates.
const HELD: [&str; 8] = [
    "Cargo.lock",
    "Cargo.toml",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "PKG-INFO",
    "pyproject.toml",
    "python/README.md",
    "python/carom/__init__.py",
];
/// Files that cargo adds to a package of a crate.
const ADDED: [&str; 3] = [".cargo_vcs_info.json", "Cargo.lock", "Cargo.toml.orig"];

/// Makes the distribution and checks that it is complete. Builds a wheel from it if `builds` is
/// true.
pub fn make(builds: bool) -> Outcome {
    let environment = Environment::new("python/release")?;
    environment.pip(&["install", "maturin"])?;
    let folder = files::staging("sdist")?;
    let mut maturin = environment.command();
    maturin.args(["-m", "maturin", "sdist", "--out"]).arg(&folder);
    files::run_in(&root(), "maturin", &mut maturin)?;
    let file = files::publish(&only_file(&folder)?)?;
    check(&file)?;
    if builds {
        let wheels = files::staging("wheel-of-sdist")?;
        let (file, wheels) = (file.to_string_lossy(), wheels.to_string_lossy());
        environment.pip(&["wheel", "--no-deps", "--wheel-dir", &wheels, &file])?;
    }
    Ok(())
}

/// Fails if a distribution lacks a file of a crate that it is built from.
fn check(file: &Path) -> Outcome {
    archive::demand(file, &HELD)?;
    let names = archive::names_in(file)?;
    if !names.iter().any(|name| name.contains("/notebook/built/")) {
        return Err(format!("{} has no viewer for notebooks", file.display()));
    }
    resolve(&archive::unpack(file)?)?;
    for member in built_from(&all()?, ENGINE) {
        let folder = member.folder.strip_prefix(root()).unwrap_or(&member.folder);
        let folder = folder.to_string_lossy().replace('\\', "/");
        let wanted: Vec<String> =
            packaged(member)?.into_iter().map(|name| format!("{folder}/{name}")).collect();
        archive::demand(file, &wanted)?;
    }
    Ok(())
}

/// Lets cargo resolve the unpacked manifests, which fails if a dependency is missing.
fn resolve(folder: &Path) -> Outcome {
    let mut command = Command::new(cargo_program());
    command.args(["metadata", "--format-version", "1", "--quiet", "--manifest-path"]);
    command.arg(folder.join("crates").join(ENGINE).join("Cargo.toml"));
    files::run_in(folder, "cargo", command.stdout(Stdio::null()))
}

/// Returns the files in the package of a crate.
fn packaged(member: &Member) -> Outcome<Vec<String>> {
    let mut command = Command::new(cargo_program());
    command.args(["package", "--list", "--quiet", "--allow-dirty", "--package", &member.name]);
    let text = printed("cargo package", &mut command)?;
    let names = text.lines().filter(|name| !ADDED.contains(name));
    Ok(names.map(|name| name.replace('\\', "/")).collect())
}
