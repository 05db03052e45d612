//! `carom`: runs scenes of moving spheres from the command line.

#![warn(clippy::unwrap_used)]

use std::process::ExitCode;

/// Uses large pages, which many Linux systems provide only on request: address translation in a
/// world of many spheres then costs less.
#[cfg(target_os = "linux")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    #[cfg(all(target_os = "linux", feature = "pictures"))]
    name_runtime_folder();
    ExitCode::from(carom_cli::main(std::env::args_os(), Vec::new()))
}

/// Restarts the program with a folder in `$XDG_RUNTIME_DIR` if it draws and the variable is not
/// set: otherwise a graphics library prints an error. A program cannot safely change a variable of
/// its own process, because libraries may read it at the same time.
#[cfg(all(target_os = "linux", feature = "pictures"))]
fn name_runtime_folder() {
    use std::os::unix::process::CommandExt;

    const FOLDER: &str = "XDG_RUNTIME_DIR";
    const DRAWING: [&str; 4] = ["picture", "record", "maze", "view"];
    let mut arguments = std::env::args_os();
    let name = arguments.next().unwrap_or_default();
    let arguments: Vec<_> = arguments.collect();
    let draws = arguments.is_empty() || arguments.iter().any(|it| DRAWING.iter().any(|d| it == d));
    if std::env::var_os(FOLDER).is_some() || !draws {
        return;
    }
    let Ok(program) = std::env::current_exe() else { return };
    let mut anew = std::process::Command::new(program);
    // `exec` returns only if it fails; then the line of the graphics library is harmless.
    let _ = anew.arg0(name).args(arguments).env(FOLDER, std::env::temp_dir()).exec();
}
