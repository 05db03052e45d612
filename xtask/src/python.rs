//! The Python package `carom`: built, installed as users do it, tested.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::checks::programs;
use crate::files::{copy, made, only_file, remove, said};
use crate::shell::{Outcome, ci_folder, finish, printed, root, target_folder};
use crate::wasm::Purpose;
use crate::{native_hashes, setup, web};

/// Builds the wheel, and says where it is.
pub fn build() -> Outcome<PathBuf> {
    let environment = Environment::new("python/build")?;
    let wheel = wheel(&environment)?;
    eprintln!("\n{}", wheel.display());
    Ok(wheel)
}

/// Builds the wheel, installs it into a clean environment, and runs every check of it: format,
/// lints, tests, examples in documentation, types, stubs, the reference.
pub fn test() -> Outcome {
    // Notebooks are shown in it.
    setup::browser()?;
    let environment = Environment::with_requirements("python/test")?;
    let wheel = wheel_for_tests(&environment)?;
    let wheel = wheel.to_string_lossy();
    environment.pip(&["install", "--no-deps", "--force-reinstall", &wheel])?;
    let hashes = environment.folder.join("native_hashes.json");
    fs::write(&hashes, native_hashes::json()?).map_err(|error| said(&hashes, &error))?;

    let folder = root().join("python");
    let folder = folder.to_string_lossy();
    environment.python(&["-m", "ruff", "format", "--quiet", "--check", "--diff", &folder])?;
    environment.python(&["-m", "ruff", "check", "--quiet", "--no-cache", &folder])?;
    let tests = root().join("python/tests");
    environment.python(&[
        "-m",
        "pytest",
        "-q",
        "--durations=30",
        "-p",
        "no:cacheprovider",
        &tests.to_string_lossy(),
    ])?;
    // What is installed, not what lies in the repository.
    let examples = ["-m", "pytest", "-q", "-p", "no:cacheprovider", "--doctest-modules"];
    // What they stand on is not installed.
    let others = ["--ignore-glob=*/carom/torch.py", "--ignore-glob=*/carom/jax.py"];
    environment.python(&[&examples[..], &others, &["--pyargs", "carom"]].concat())?;
    let configuration = root().join("pyproject.toml");
    let configuration = configuration.to_string_lossy();
    let types = ["-m", "mypy", "--config-file", &configuration, "--package", "carom"];
    environment.python(&types)?;
    let types = ["-m", "mypy", "--config-file", &configuration, &tests.to_string_lossy()];
    environment.python(&types)?;
    let stubs = ["-m", "mypy.stubtest", "--mypy-config-file", &configuration, "carom._carom"];
    environment.python(&stubs)?;
    let reference = environment.folder.join("reference");
    let pages = [
        "-m",
        "pdoc",
        "carom",
        "carom._carom",
        "carom._run.bodies",
        "carom._run.queries",
        "carom.gym",
        "carom.notebook",
        "--docformat",
        "google",
        "--no-show-source",
    ];
    environment
        .python(&[&pages[..], &["--output-directory", &reference.to_string_lossy()]].concat())
}

/// Versions of all that the package is built and tested with.
const REQUIREMENTS: &str = "python/requirements-test.txt";

/// Builds the wheel as `pip install .` does, with the viewer for notebooks. Returns the file.
fn wheel(environment: &Environment) -> Outcome<PathBuf> {
    web::build_for_notebooks(Purpose::Use)?;
    let wheels = environment.folder.join("wheels");
    let folder = wheels.to_string_lossy();
    environment.pip(&["wheel", ".", "--no-deps", "--wheel-dir", &folder])?;
    only_file(&wheels)
}

/// Packs a wheel with the library that is built for tests together with all other crates: by itself
/// it would be compiled with other features of what these crates use, and they with it.
fn wheel_for_tests(environment: &Environment) -> Outcome<PathBuf> {
    web::build_for_notebooks(Purpose::Test)?;
    programs::build()?;
    let unpacked = made(environment.folder.join("unpacked"))?;
    let mut describe = environment.command();
    describe.args(["-m", "maturin", "pep517", "write-dist-info", "--metadata-directory"]);
    finish("maturin", describe.arg(&unpacked).current_dir(root()))?;
    copy(&root().join("python/carom"), &unpacked.join("carom"))?;
    let [prefix, suffix] = [std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX];
    let library = ci_folder().join(format!("{prefix}_carom{suffix}"));
    let module = if cfg!(windows) { "_carom.pyd" } else { "_carom.abi3.so" };
    copy(&library, &unpacked.join("carom").join(module))?;
    let wheels = made(environment.folder.join("wheels"))?;
    let [from, to] = [&unpacked, &wheels].map(|folder| folder.to_string_lossy());
    environment.python(&["-m", "wheel", "pack", &from, "--dest-dir", &to])?;
    only_file(&wheels)
}

/// An environment of Python's own, with nothing in it at first.
pub struct Environment {
    folder: PathBuf,
}

impl Environment {
    /// Creates the environment in a folder of the build.
    pub fn new(name: &str) -> Outcome<Self> {
        setup::python()?;
        // The package draws.
        setup::graphics()?;
        let folder = target_folder().join(name);
        remove(&folder)?;
        let place = folder.join("environment");
        let python = setup::python_program();
        finish(&python, Command::new(&python).args(["-m", "venv"]).arg(place))?;
        Ok(Self { folder })
    }

    /// Returns one in which [`REQUIREMENTS`] are installed: the one that is there, if it was made of the same
    /// ones by the same Python, or a new one.
    fn with_requirements(name: &str) -> Outcome<Self> {
        let folder = target_folder().join(name);
        let file = root().join(REQUIREMENTS);
        let requirements = fs::read_to_string(&file).map_err(|error| said(&file, &error))?;
        let python = printed("python", Command::new(setup::python_program()).arg("--version"))?;
        let made_of = format!("{python}\n{requirements}");
        let note = folder.join("made_of.txt");
        if fs::read_to_string(&note).is_ok_and(|text| text == made_of) {
            setup::graphics()?;
            for leftover in ["wheels", "unpacked", "reference"] {
                remove(&folder.join(leftover))?;
            }
            return Ok(Self { folder });
        }
        let environment = Self::new(name)?;
        environment.pip(&["install", "--requirement", REQUIREMENTS])?;
        // Last, so that one half made is made anew.
        fs::write(&note, made_of).map_err(|error| said(&note, &error))?;
        Ok(environment)
    }

    /// Installs or builds with the versions that [`REQUIREMENTS`] names, in the root of the
    /// repository.
    pub fn pip(&self, arguments: &[&str]) -> Outcome {
        let mut command = self.command();
        command.args(["-m", "pip", "--quiet", "--disable-pip-version-check"]).args(arguments);
        command.env("PIP_CONSTRAINT", root().join(REQUIREMENTS));
        finish("pip", command.env("CARGO_TARGET_DIR", target_folder()).current_dir(root()))
    }

    /// Runs Python where nothing of the repository is found by accident.
    fn python(&self, arguments: &[&str]) -> Outcome {
        let mut command = self.command();
        command.args(arguments).current_dir(&self.folder);
        command.env("CAROM_NATIVE_HASHES", self.folder.join("native_hashes.json"));
        finish("python", &mut command)
    }

    /// What a program prints that runs where nothing of the repository is found by accident.
    pub fn printed(&self, arguments: &[&str]) -> Outcome<String> {
        printed("python", self.command().args(arguments).current_dir(&self.folder))
    }

    /// Returns the command of its Python, without arguments.
    pub fn command(&self) -> Command {
        let scripts = if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" };
        Command::new(self.folder.join("environment").join(scripts))
    }
}
