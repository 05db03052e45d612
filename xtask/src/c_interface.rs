//! The C interface: its libraries, its header, and programs in C, C++ and C# that use them.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::checks::programs;
use crate::files::said;
use crate::shell::{
    CI, Outcome, cargo, cargo_with, ci_folder, finish, host, root, succeeds, target_folder,
};
use crate::{native_hashes, setup};

/// Builds the libraries for programs, and prints their paths.
pub fn build() -> Outcome {
    cargo(&["build", "--release", "--package", "carom-c"])?;
    eprintln!("\n{}", target_folder().join("release").display());
    eprintln!("{}", root().join("crates/carom-c/include/carom.h").display());
    Ok(())
}

/// Rewrites the header; a test in `carom-c` fails if the header is outdated.
pub fn write_header() -> Outcome {
    let test = ["test", "--quiet", "--package", "carom-c", "--test", "header", "the_header_is"];
    cargo_with(&test, &[("CAROM_WRITE_HEADER", "1")])
}

/// Runs the tests of the C interface, then its programs.
pub fn test() -> Outcome {
    cargo(&["test", "--quiet", "--profile", CI, "--package", "carom-c"])?;
    run_programs(&["--package", "carom-c"])
}

/// Runs the programs with the library that the build of all tests has made.
pub fn test_built() -> Outcome {
    programs::build()?;
    run_programs(&["--workspace"])
}

/// Compiles the programs in a folder below the target folder, and runs them. `packages` are those
/// that the library was built with.
fn run_programs(packages: &[&str]) -> Outcome {
    if cfg!(windows) {
        eprintln!("xtask: the programs of the C interface are not compiled on Windows");
        return Ok(());
    }
    setup::c_interface()?;
    let programs = Programs::new()?;
    for name in ["bouncing_ball", "state_hashes", "every_function", "every_query"] {
        programs.compile_c(name)?;
    }
    programs.compile_cpp("cradle")?;
    programs.compile_statically("bouncing_ball", "bouncing_ball_static")?;
    for name in ["bouncing_ball", "bouncing_ball_static", "cradle"] {
        finish(name, &mut programs.program(name))?;
    }
    programs.compare_hashes()?;
    programs.check_memory(packages)?;
    programs.run_csharp()
}

/// Compiler options: every warning is an error.
const STRICT: [&str; 5] = ["-Wall", "-Wextra", "-Werror", "-pedantic", "-g"];
/// A memory checker, which fails for every finding, also for memory that is never freed.
const VALGRIND: &str = "valgrind --quiet --error-exitcode=9 --leak-check=full \
                        --show-leak-kinds=definite --errors-for-leak-kinds=definite";

/// Programs that use the C interface, and the library.
struct Programs {
    /// Folder of the compiled programs.
    folder: PathBuf,
    /// Folder of the libraries.
    libraries: PathBuf,
    sources: PathBuf,
}

impl Programs {
    fn new() -> Outcome<Self> {
        let folder = target_folder().join("c");
        fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        // Building tests leaves the library in this folder.
        let libraries = ci_folder().join("deps");
        Ok(Self { folder, libraries, sources: root().join("crates/carom-c") })
    }

    /// Returns the command of a compiled program.
    fn program(&self, name: &str) -> Command {
        Command::new(self.folder.join(name))
    }

    fn compile_c(&self, name: &str) -> Outcome {
        let mut command = self.compiler("cc", "-std=c99", &format!("{name}.c"));
        self.link(&mut command);
        finish("cc", command.arg("-o").arg(self.folder.join(name)))
    }

    fn compile_cpp(&self, name: &str) -> Outcome {
        let mut command = self.compiler("c++", "-std=c++17", &format!("{name}.cpp"));
        self.link(&mut command);
        finish("c++", command.arg("-o").arg(self.folder.join(name)))
    }

    fn compile_statically(&self, name: &str, program: &str) -> Outcome {
        let mut command = self.compiler("cc", "-std=c99", &format!("{name}.c"));
        command.arg(self.libraries.join("libcarom_c.a")).args(["-lm", "-lpthread", "-ldl"]);
        finish("cc", command.arg("-o").arg(self.folder.join(program)))
    }

    /// Returns the command of a compiler for a program, without libraries.
    fn compiler(&self, program: &str, standard: &str, source: &str) -> Command {
        let mut command = Command::new(program);
        command.arg(standard).args(STRICT).arg("-I").arg(self.sources.join("include"));
        command.arg(self.sources.join("examples").join(source));
        command
    }

    /// Adds the shared library to a command, with its path at run time.
    fn link(&self, command: &mut Command) {
        command.arg("-L").arg(&self.libraries).args(["-lcarom_c", "-lm"]);
        command.arg(format!("-Wl,-rpath,{}", self.libraries.display()));
    }

    /// Compares the state hashes of all scenes with those of the native engine.
    fn compare_hashes(&self) -> Outcome {
        let pinned = native_hashes::pinned()?;
        let mut command = self.program("state_hashes");
        command.arg("10").args(pinned.iter().map(|(scene, _)| scene));
        eprintln!("\n== state_hashes 10 ... ({} scenes)", pinned.len());
        let output = command.output().map_err(|error| format!("state_hashes: {error}"))?;
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        let wanted: String =
            pinned.iter().map(|(scene, hash)| format!("{scene} {hash}\n")).collect();
        if !output.status.success() || printed != wanted {
            let errors = String::from_utf8_lossy(&output.stderr).into_owned();
            return Err(format!("state hashes through C:\n{printed}{errors}but pinned:\n{wanted}"));
        }
        Ok(())
    }

    /// Calls every function of the header, and makes ten thousand wrong calls, under a memory
    /// checker.
    fn check_memory(&self, packages: &[&str]) -> Outcome {
        if !cfg!(target_os = "linux") {
            finish("every_function", &mut self.program("every_function"))?;
            return finish("every_query", &mut self.program("every_query"));
        }
        for name in ["every_function", "every_query"] {
            let mut words = VALGRIND.split_whitespace();
            let mut command = Command::new(words.next().unwrap_or_default());
            finish("valgrind", command.args(words).arg(self.folder.join(name)))?;
        }
        let test = ["test", "--quiet", "--profile", CI];
        let test = [&test[..], packages, &["--test", "misuse"]].concat();
        let target = host()?.to_uppercase().replace('-', "_");
        cargo_with(&test, &[(&format!("CARGO_TARGET_{target}_RUNNER"), VALGRIND)])
    }

    /// Compiles and runs the programs in C#: worlds with and without the part for Unity, and the
    /// pinball of the examples.
    fn run_csharp(&self) -> Outcome {
        if !cfg!(target_os = "linux") && !succeeds("mcs", &["--version"]) {
            eprintln!("xtask: there is no mono, so the programs in C# are not run");
            return Ok(());
        }
        let pinned = native_hashes::pinned()?;
        let is_short = |scene: &str| scene.starts_with("simtest") || scene.starts_with("tutorial");
        let own = pinned.iter().filter(|(scene, _)| is_short(scene));
        let hashes: Vec<String> = own.map(|(scene, hash)| format!("{scene}={hash}")).collect();
        let examples = self.sources.join("examples");
        let worlds = ["Worlds.cs", "UnityEngine.cs"].map(|file| examples.join(file));
        self.compile_csharp("Worlds.exe", &[], &worlds)?;
        self.compile_csharp("Unity.exe", &[UNITY], &worlds)?;
        for name in ["Worlds.exe", "Unity.exe"] {
            self.run_mono(name, &hashes)?;
        }
        let game = root().join("examples/pinball-unity/Assets/Scripts");
        let game = ["Table.cs", "PinballGame.cs"].map(|file| game.join(file));
        let test = ["Pinball.cs", "UnityEngine.cs"].map(|file| examples.join(file));
        self.compile_csharp("Pinball.exe", &[UNITY], &[game, test].concat())?;
        let table = root().join("examples/pinball");
        let reached = table.join("ten_seconds.txt");
        let reached = fs::read_to_string(&reached).map_err(|error| said(&reached, &error))?;
        let arguments = [table.to_string_lossy().into_owned(), reached.trim().to_owned()];
        self.run_mono("Pinball.exe", &arguments)
    }

    /// Compiles a program of these sources and the class of worlds.
    fn compile_csharp(&self, program: &str, options: &[&str], sources: &[PathBuf]) -> Outcome {
        let mut compiler = Command::new("mcs");
        compiler.args(["-warnaserror", "-warn:4"]).args(options);
        compiler.arg(format!("-out:{}", self.folder.join(program).display()));
        compiler.arg(self.sources.join("csharp/CaromWorld.cs")).args(sources);
        finish("mcs", &mut compiler)
    }

    fn run_mono(&self, program: &str, arguments: &[String]) -> Outcome {
        let mut mono = Command::new("mono");
        mono.arg(self.folder.join(program)).args(arguments).env(LIBRARY_PATH, &self.libraries);
        finish("mono", &mut mono)
    }
}

/// Compiler option for the parts that need Unity.
const UNITY: &str = "-define:UNITY_5_3_OR_NEWER";

/// Environment variable with the folders of shared libraries.
const LIBRARY_PATH: &str =
    if cfg!(target_os = "macos") { "DYLD_LIBRARY_PATH" } else { "LD_LIBRARY_PATH" };
