//! The archive of the C interface: libraries, header, C# class, guide and example programs.

use std::path::Path;
use std::process::Command;

use super::archive::{Archive, demand, unpack};
use super::files;
use super::versions::VERSION;
use crate::notices;
use crate::shell::{Outcome, cargo, finish, host, root, target_folder};
use crate::sources::read;

/// Files of the repository that are copied into the archive: source and destination.
const FILES: [(&str, &str); 6] = [
    ("crates/carom-c/include/carom.h", "include/carom.h"),
    ("crates/carom-c/csharp/CaromWorld.cs", "csharp/CaromWorld.cs"),
    ("crates/carom-c/examples", "examples"),
    ("CHANGELOG.md", "CHANGELOG.md"),
    ("LICENSE-APACHE", "LICENSE-APACHE"),
    ("LICENSE-MIT", "LICENSE-MIT"),
];

/// The shared library, and the files that programs link to.
const LIBRARIES: &[&str] = if cfg!(windows) {
    &["carom_c.dll", "carom_c.dll.lib", "carom_c.lib"]
} else if cfg!(target_os = "macos") {
    &["libcarom_c.dylib", "libcarom_c.a"]
} else {
    &["libcarom_c.so", "libcarom_c.a"]
};

/// Makes the archive, and compiles a program with its content.
pub fn make() -> Outcome {
    cargo(&["build", "--profile", "dist", "--package", "carom-c"])?;
    let archive = Archive::new(format!("carom-c-{VERSION}-{}", host()?))?;
    for name in LIBRARIES {
        archive.add(&target_folder().join("dist").join(name), &format!("lib/{name}"))?;
    }
    if cfg!(target_os = "macos") {
        // Programs find the library by this name relative to themselves, not by the path of its
        // build.
        let mut command = Command::new("install_name_tool");
        command.args(["-id", "@rpath/libcarom_c.dylib"]);
        finish("install_name_tool", command.arg(archive.place("lib/libcarom_c.dylib")))?;
    }
    for (from, to) in FILES {
        archive.add(&root().join(from), to)?;
    }
    let guide = read(&root().join("docs/c.md"))?;
    files::write(&archive.place("c.md"), for_archive(&guide))?;
    files::write(&archive.place(notices::FILE), notices::of("carom-c", &host()?)?)?;
    let file = archive.pack()?;
    demand(&file, &["include/carom.h", "csharp/CaromWorld.cs", "c.md", "LICENSE-MIT"])?;
    if cfg!(windows) {
        eprintln!("xtask: the programs of the C interface are not compiled on Windows");
        return Ok(());
    }
    try_out(&unpack(&file)?)
}

/// Returns the guide with links to files in the archive; other links become plain text.
fn for_archive(guide: &str) -> String {
    let guide = guide.replace("](../crates/carom-c/", "](");
    let mut text = String::new();
    let mut rest = guide.as_str();
    while let Some((before, after)) = rest.split_once("](") {
        let target = after.split(')').next().unwrap_or(after);
        let is_elsewhere = target.contains(".md") && !target.contains("://");
        match before.rfind('[').filter(|_| is_elsewhere) {
            Some(start) => {
                text += &before[..start];
                text += &before[start + 1..];
                rest = after.get(target.len() + 1..).unwrap_or_default();
            }
            None => {
                text += before;
                text += "](";
                rest = after;
            }
        }
    }
    text + rest
}

/// Compiles the smallest program with the shared and the static library, and runs both.
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

#[cfg(test)]
mod tests {
    use super::for_archive;

    #[test]
    fn links_of_the_guide_lead_into_the_archive_or_are_text() {
        let guide =
            "[a](../crates/carom-c/include/a.h), [b `c`](d/e.md#f) and [g](https://h/i.md).";
        let changed = "[a](include/a.h), b `c` and [g](https://h/i.md).";
        assert_eq!(for_archive(guide), changed);
    }
}
