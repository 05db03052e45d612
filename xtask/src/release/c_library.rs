//! The archive of the C interface: libraries, header, the class for C#, the guide and its programs.

use std::path::Path;
use std::process::Command;

use super::archive::{Archive, demand, host, unpack};
use super::versions::VERSION;
use super::{files, notices};
use crate::shell::{Outcome, cargo, finish, root, target_folder};

/// What stands in the archive as it stands in the repository: from where, to where.
const FILES: [(&str, &str); 7] = [
    ("crates/carom-c/include/carom.h", "include/carom.h"),
    ("crates/carom-c/csharp/CaromWorld.cs", "csharp/CaromWorld.cs"),
    ("crates/carom-c/examples", "examples"),
    ("docs/c.md", "c.md"),
    ("CHANGELOG.md", "CHANGELOG.md"),
    ("LICENSE-APACHE", "LICENSE-APACHE"),
    ("LICENSE-MIT", "LICENSE-MIT"),
];

/// The shared library, and what a program links to besides.
const LIBRARIES: &[&str] = if cfg!(windows) {
    &["carom_c.dll", "carom_c.dll.lib", "carom_c.lib"]
} else if cfg!(target_os = "macos") {
    &["libcarom_c.dylib", "libcarom_c.a"]
} else {
    &["libcarom_c.so", "libcarom_c.a"]
};

/// Makes the archive, and compiles a program with what it holds.
pub fn make() -> Outcome {
    cargo(&["build", "--profile", "dist", "--package", "carom-c"])?;
    let archive = Archive::new(format!("carom-c-{VERSION}-{}", host()?))?;
    for name in LIBRARIES {
        archive.add(&target_folder().join("dist").join(name), &format!("lib/{name}"))?;
    }
    if cfg!(target_os = "macos") {
        // Programs look for it by this name: where they are, not where it was built.
        let mut command = Command::new("install_name_tool");
        command.args(["-id", "@rpath/libcarom_c.dylib"]);
        finish("install_name_tool", command.arg(archive.place("lib/libcarom_c.dylib")))?;
    }
    for (from, to) in FILES {
        archive.add(&root().join(from), to)?;
    }
    files::write(&archive.place(notices::FILE), notices::of("carom-c")?)?;
    let file = archive.pack()?;
    demand(&file, &["include/carom.h", "csharp/CaromWorld.cs", "c.md", "LICENSE-MIT"])?;
    if cfg!(windows) {
        eprintln!("xtask: the programs of the C interface are not compiled on Windows");
        return Ok(());
    }
    try_out(&unpack(&file)?)
}

/// Compiles the smallest program with the shared and with the static library, and runs both.
fn try_out(folder: &Path) -> Outcome {
    let path = format!("-Wl,-rpath,{}", folder.join("lib").display());
    let shared = ["-Llib", "-lcarom_c", &path];
    let fixed = ["lib/libcarom_c.a", "-lpthread", "-ldl"];
    for (name, libraries) in [("shared", &shared), ("static", &fixed)] {
        let mut compiler = Command::new("cc");
        compiler.args(["-std=c99", "-Iinclude", "examples/bouncing_ball.c"]).args(libraries);
        files::run_in(folder, "cc", compiler.args(["-lm", "-o", name]))?;
        files::run_in(folder, name, &mut Command::new(folder.join(name)))?;
    }
    Ok(())
}
