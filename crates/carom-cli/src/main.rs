//! `carom`: runs scenes of moving spheres from the command line.

#![warn(clippy::unwrap_used)]

use std::process::ExitCode;

/// Requests large pages, which many Linux systems give only on request: a world of many spheres
/// then waits less for addresses to be translated.
#[cfg(target_os = "linux")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    #[cfg(all(target_os = "linux", feature = "pictures"))]
    name_runtime_folder();
    ExitCode::from(carom_cli::main(std::env::args_os(), Vec::new()))
}

/// Starts the program anew with a folder in `$XDG_RUNTIME_DIR`, where it is to draw and the system
/// names none: a graphics library prints an error line then. A program cannot safely change a
/// variable of its own, for a library may read it meanwhile.
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
    // This returns only where it fails; the error line does no harm then.
    let _ = anew.arg0(name).args(arguments).env(FOLDER, std::env::temp_dir()).exec();
}
