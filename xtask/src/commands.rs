//! Runs the commands in documents, in the order of reading.
//!
//! A block tagged `sh` holds commands; those that start with `carom` are run. A block that starts
//! with `# file: NAME` is a file to be written. A block tagged `text` below commands holds lines of
//! their output. Comments at the end of a command are marks: `# opens a window`, `# takes minutes`
//! and `# needs a recording` skip it, and `# fails` means that it must fail.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::documents;
use crate::markdown::{Block, Markdown};
use crate::shell::{CI, Outcome, cargo, ci_folder, succeeds, target_folder};

/// Documents whose commands are run.
const DOCUMENTS: [&str; 16] = [
    "README.md",
    "docs/tutorial.md",
    "docs/command-line.md",
    "docs/scenes.md",
    "docs/viewer.md",
    "docs/courses.md",
    "docs/physics/motion.md",
    "docs/physics/contact-times.md",
    "docs/physics/impacts.md",
    "docs/physics/persistent-contacts.md",
    "docs/physics/exact.md",
    "docs/physics/growth.md",
    "docs/physics/stress.md",
    "docs/physics/zones.md",
    "docs/physics/contact.md",
    "docs/physics/bisect-and-discrete.md",
];
/// Marks of commands that are skipped.
const LEFT_OUT: [&str; 3] = ["# opens a window", "# takes minutes", "# needs a recording"];
/// Subcommands that a build without pictures lacks.
const DRAWING: [&str; 4] = ["picture", "record", "maze", "view"];

/// Folders of the programs that documents call `carom`.
pub struct Programs {
    /// Folder of the program without pictures and window.
    pub plain: PathBuf,
    /// Folder of the program with them; `None` skips commands that draw.
    pub drawing: Option<PathBuf>,
}

/// A step of a reader of a document.
#[derive(Debug, PartialEq, Eq)]
enum Step {
    Write { file: String, text: String },
    Run { line: usize, command: String },
    Read { line: usize, printed: String },
}

/// Builds the program without pictures, and runs the commands that it supports.
pub fn check_plain() -> Outcome {
    let plain = ["--package", "carom-cli", "--no-default-features"];
    cargo(&[&["build", "--profile", CI, "--quiet"], &plain[..]].concat())?;
    check(&Programs { plain: ci_folder(), drawing: None })
}

/// Runs the commands of all documents.
pub fn check(programs: &Programs) -> Outcome {
    if !succeeds("sh", &["-c", "true"]) {
        eprintln!("xtask: there is no shell, so the commands of the documents are not run");
        return Ok(());
    }
    for document in DOCUMENTS {
        eprintln!("\n== the commands of {document}");
        let folder = target_folder().join("documents").join(document.replace('/', "_"));
        if folder.exists() {
            fs::remove_dir_all(&folder).map_err(|error| said(&folder, &error))?;
        }
        fs::create_dir_all(&folder).map_err(|error| said(&folder, &error))?;
        follow(&steps(&documents::read(document)?), programs, &folder)
            .map_err(|fault| format!("{document}:{fault}"))?;
    }
    Ok(())
}

/// Returns the steps of a document from top to bottom.
fn steps(document: &Markdown) -> Vec<Step> {
    document.blocks.iter().flat_map(steps_of).collect()
}

fn steps_of(block: &Block) -> Vec<Step> {
    if let Some(file) = block.text.lines().next().and_then(|line| line.strip_prefix("# file: ")) {
        return vec![Step::Write { file: file.trim().to_owned(), text: block.text.clone() }];
    }
    let is_run = |line: &str| {
        let is_ours = line.split_whitespace().next() == Some("carom");
        is_ours && !LEFT_OUT.iter().any(|mark| line.contains(mark))
    };
    match block.tag.as_str() {
        "sh" => (block.line..)
            .zip(block.text.lines())
            .filter(|(_, line)| is_run(line))
            .map(|(line, text)| Step::Run { line, command: text.to_owned() })
            .collect(),
        "text" => vec![Step::Read { line: block.line, printed: block.text.clone() }],
        _ => Vec::new(),
    }
}

/// Follows the steps in a folder; an error begins with its line.
fn follow(steps: &[Step], programs: &Programs, folder: &Path) -> Outcome {
    // Output of the commands since the last block of text.
    let mut printed = String::new();
    for step in steps {
        match step {
            Step::Write { file, text } => {
                let path = folder.join(file);
                fs::write(&path, text).map_err(|error| format!(" {}", said(&path, &error)))?;
            }
            Step::Run { line, command } => {
                let output = run(command, programs, folder);
                printed += &output.map_err(|fault| format!("{line}: {fault}"))?;
            }
            Step::Read { line, printed: expected } => {
                let missing = missing_line(expected, &printed);
                if let Some(missing) = missing.filter(|_| !printed.is_empty()) {
                    return Err(format!("{line}: no command above prints: {missing}"));
                }
                printed.clear();
            }
        }
    }
    Ok(())
}

/// Runs a command. Returns its output.
fn run(command: &str, programs: &Programs, folder: &Path) -> Outcome<String> {
    let Some(program) = programs.folder_for(command) else {
        eprintln!("   left out: {command}");
        return Ok(String::new());
    };
    let before = std::env::var_os("PATH").unwrap_or_default();
    let others = std::env::split_paths(&before);
    let path = std::env::join_paths(std::iter::once(program.to_owned()).chain(others))
        .map_err(|error| error.to_string())?;
    let mut shell = Command::new("sh");
    shell.args(["-euc", command]).current_dir(folder).env("PATH", path).stdin(Stdio::null());
    shell.env_remove("CAROM_SCENES").env_remove("CAROM_PAGE");
    let output = shell.output().map_err(|error| format!("{command}: {error}"))?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (printed, errors) = (text(&output.stdout), text(&output.stderr));
    let must_fail = command.contains("# fails");
    match (output.status.success(), must_fail) {
        (true, true) => Err(format!("this must fail, and does not: {command}")),
        (false, false) => Err(format!("{command}\n{printed}{errors}")),
        _ => Ok(printed + &errors),
    }
}

impl Programs {
    /// Returns the folder of the program that a command needs.
    fn folder_for(&self, command: &str) -> Option<&Path> {
        if draws(command) { self.drawing.as_deref() } else { Some(&self.plain) }
    }
}

/// Returns whether a command draws or opens windows.
fn draws(command: &str) -> bool {
    let words: Vec<&str> = command.split_whitespace().collect();
    words.windows(2).any(|pair| pair[0] == "carom" && DRAWING.contains(&pair[1]))
}

/// Returns the first expected line that was not printed.
fn missing_line<'a>(expected: &'a str, printed: &str) -> Option<&'a str> {
    let printed = without_durations(printed);
    expected.lines().find(|line| !printed.contains(&without_durations(line)))
}

/// Returns a text with single spaces between words and without seconds, which differ between runs.
fn without_durations(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    let is_second = |place: usize| {
        let unit = words.get(place + 1).map(|unit| unit.trim_end_matches([',', ';']));
        unit == Some("s") && words[place].parse::<f64>().is_ok()
    };
    let shown = |place: usize| if is_second(place) { "#" } else { words[place] };
    (0..words.len()).map(shown).collect::<Vec<_>>().join(" ")
}

fn said(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}

#[cfg(test)]
mod tests {
    use super::{Step, draws, missing_line, steps};
    use crate::markdown::Markdown;

    const TEXT: &str = "\
```toml
# file: a.toml
name = \"a\"
```

```sh
cargo xtask demo
carom run a.toml    # with a comment
carom               # opens a window
carom bench         # takes minutes
carom check b.toml  # fails
```

```text
wall time        0.001 s, 0.001 s of it physics
```
";

    #[test]
    fn a_reader_writes_files_and_runs_what_is_not_left_out() {
        let run = |line, command: &str| Step::Run { line, command: command.to_owned() };
        let [write, first, second, read] = &steps(&Markdown::parse(TEXT))[..] else {
            panic!("{:?}", steps(&Markdown::parse(TEXT)))
        };
        let text = "# file: a.toml\nname = \"a\"\n".to_owned();
        assert_eq!(*write, Step::Write { file: "a.toml".to_owned(), text });
        assert_eq!(*first, run(8, "carom run a.toml    # with a comment"));
        assert_eq!(*second, run(11, "carom check b.toml  # fails"));
        assert!(matches!(read, Step::Read { line: 15, .. }), "{read:?}");
    }

    #[test]
    fn commands_that_draw_are_known() {
        assert!(draws("carom picture x --out x.png") && draws("carom show x > y && carom view y"));
        assert!(!draws("carom run picture") && !draws("carom scenes"));
    }

    #[test]
    fn what_is_printed_is_compared_without_durations() {
        let printed = "impacts          46\nwall time        1.250 s, 0.001 s of it physics\n";
        assert_eq!(missing_line("impacts 46\nwall time 0.001 s, 0.001 s of it", printed), None);
        assert_eq!(missing_line("impacts          47", printed), Some("impacts          47"));
    }
}
