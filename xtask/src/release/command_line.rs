//! The archive of the command `carom`: program, shell completions, manual page, licences.

use std::path::Path;
use std::process::Command;

use super::archive::{Archive, demand, unpack};
use super::files;
use super::versions::VERSION;
use crate::shell::{Outcome, cargo, finish, host, printed, root, target_folder};
use crate::{notices, setup};

/// Files of the repository that are copied into the archive: source and destination.
const FILES: [(&str, &str); 4] = [
    ("crates/carom-cli/README.md", "README.md"),
    ("CHANGELOG.md", "CHANGELOG.md"),
    ("LICENSE-APACHE", "LICENSE-APACHE"),
    ("LICENSE-MIT", "LICENSE-MIT"),
];
/// Shells, and the names of their completion files.
const SHELLS: [(&str, &str); 5] = [
    ("bash", "carom.bash"),
    ("elvish", "carom.elv"),
    ("fish", "carom.fish"),
    ("powershell", "_carom.ps1"),
    ("zsh", "_carom"),
];

/// Makes the archive, and runs the program in it.
pub fn make() -> Outcome {
    setup::graphics()?;
    cargo(&["build", "--profile", "dist", "--package", "carom-cli"])?;
    let program = format!("carom{}", std::env::consts::EXE_SUFFIX);
    let built = target_folder().join("dist").join(&program);
    let archive = Archive::new(format!("carom-{VERSION}-{}", host()?))?;
    archive.add(&built, &program)?;
    for (from, to) in FILES {
        archive.add(&root().join(from), to)?;
    }
    for (shell, file) in SHELLS {
        let script = printed("carom", Command::new(&built).args(["completions", shell]))?;
        files::write(&archive.place("completions").join(file), script)?;
    }
    finish("carom", Command::new(&built).arg("man").arg(archive.place("man")))?;
    files::write(&archive.place(notices::FILE), notices::of("carom-cli", &host()?)?)?;
    let file = archive.pack()?;
    demand(&file, &[&program, "completions/carom.bash", "man/carom.1", "LICENSE-MIT"])?;
    try_out(&unpack(&file)?, &program)
}

/// Runs a scene with the program, and checks its version.
fn try_out(folder: &Path, program: &str) -> Outcome {
    let program = folder.join(program);
    files::run_in(folder, "carom", Command::new(&program).args(["run", "simtest1"]))?;
    let version = printed("carom", Command::new(&program).arg("--version"))?;
    if version.trim() == format!("carom {VERSION}") {
        return Ok(());
    }
    Err(format!("the program in the archive is {version:?}, not {VERSION}"))
}
