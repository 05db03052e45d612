//! The wheel of the Python package: one for every CPython from 3.10 on.

use super::files;
use super::versions::VERSION;
use crate::files::only_file;
use crate::notices;
use crate::python::Environment;
use crate::shell::{Outcome, host, root, target_folder};

/// Part of the name of every wheel that states the supported versions of Python.
const VERSIONS_OF_PYTHON: &str = "-cp310-abi3-";
/// Runs a scene with the installed package and prints its version.
const PROGRAM: &str = "import importlib.metadata, carom; \
                       carom.load('simtest1').run(seconds=1); \
                       print(importlib.metadata.version('carom'))";

/// Makes the wheel, and tries it in a clean environment.
///
/// On Linux, maturin refuses libraries that some distributions lack, and puts the oldest supported
/// C library into the name of the wheel (`manylinux_2_35`: glibc 2.35).
pub fn make() -> Outcome {
    let environment = Environment::new("python/release")?;
    environment.pip(&["install", "maturin"])?;
    let notices = notices::of("carom-py", &host()?)?;
    files::write(&root().join("python/carom").join(notices::FILE), notices)?;
    let folder = files::staging("wheel")?;
    let mut maturin = environment.command();
    maturin.args(["-m", "maturin", "build", "--profile", "dist", "--locked", "--out"]).arg(&folder);
    maturin.env("CARGO_TARGET_DIR", target_folder());
    files::run_in(&root(), "maturin", &mut maturin)?;
    let wheel = files::publish(&only_file(&folder)?)?;
    let name = wheel.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let is_for_linux = cfg!(target_os = "linux");
    if !name.contains(VERSIONS_OF_PYTHON) || is_for_linux && !name.contains("manylinux") {
        return Err(format!("{name} is not for every CPython from 3.10 on, or for every system"));
    }
    let user = Environment::new("python/release-user")?;
    user.pip(&["install", &wheel.to_string_lossy()])?;
    let version = user.printed(&["-c", PROGRAM])?;
    if version.trim() == VERSION {
        return Ok(());
    }
    Err(format!("the wheel has version {version:?}, not {VERSION}"))
}
