//! The command line: options with meaningless values.

use std::fs::File;
use std::io::{self, Read};
use std::path::PathBuf;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use proptest::prelude::*;
use proptest::sample::select;

use crate::case::text;
use crate::fault::{Fault, check_line};
use crate::mutation::{mutated, values};
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "options",
    about: "command lines with meaningless options, each a run of `carom`",
    campaign: 2_000,
    cases: || lines().boxed(),
    check,
};

/// Longest that a program may take on the clock, on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// Command lines with a place for a value. None can be made to run for long.
const COMMANDS: [&str; 20] = [
    "run simtest1 --frames 2 --every @",
    "run simtest1 --frames 2 --out @",
    "run simtest1 --frames 2 --impacts @",
    "run simtest1 --frames 2 --ledger @",
    "run simtest1 --frames 2 --set @",
    "run simtest1 --frames 2 --frame-time @",
    "run simtest1 --frames 2 --rule @",
    "run simtest1 --frames 2 --max-spheres @",
    "run simtest1 --frames 2 @",
    "run @ --frames 2",
    "run --link @ --frames 2",
    "check @",
    "show @",
    "scenes --scenes @",
    "link simtest1 --seconds @",
    "link simtest1 --page @",
    "link simtest1 --set @",
    "compare simtest1 --frames 2 --rules @",
    "import @",
    "completions @",
];

/// Values that make sense somewhere.
const VALUES: [&str; 10] = [
    "2",
    "0.01",
    "exact",
    "bisect-all",
    "run.csv",
    "run.npz",
    "run.pvd",
    "spheres[0].radius=0.2",
    "http://127.0.0.1:8042/#scene=simtest1&t=0.5",
    "simtest2",
];

/// Draws command lines: each line of the text is an argument.
fn lines() -> impl Strategy<Value = Vec<u8>> {
    let own = mutated(VALUES.map(|it| it.as_bytes().to_vec()).to_vec());
    let value = prop_oneof![own, values().prop_map(|it| it.as_bytes().to_vec())];
    (select(&COMMANDS[..]), value).prop_map(|(command, value)| {
        // The system passes no zeros, and a new line would end the argument.
        let value = text(&value).replace(['\0', '\n'], "?").replace("..", "__");
        // A path leads nowhere but into the folder of the case.
        let value = value.strip_prefix('/').map_or(value.clone(), |rest| format!("./{rest}"));
        let words = command.split(' ').map(|word| if word == "@" { &value } else { word });
        words.collect::<Vec<_>>().join("\n").into_bytes()
    })
}

/// Returns the path of the program, beside this one or in the folder above.
fn program() -> io::Result<PathBuf> {
    let own = std::env::current_exe()?;
    let name = format!("carom{}", std::env::consts::EXE_SUFFIX);
    let found = own.ancestors().skip(1).take(2).map(|it| it.join(&name)).find(|it| it.is_file());
    found.ok_or_else(|| io::Error::other("there is no program `carom`; build carom-cli first"))
}

fn check(case: &[u8]) -> Result<Answer, Fault> {
    let failed = |error: io::Error| Fault::Law(format!("cannot be tried: {error}"));
    let folder = tempfile::tempdir().map_err(failed)?;
    let errors = folder.path().join("errors.txt");
    // What it writes is in a folder of its own, also where a path leads to the one around it.
    let place = folder.path().join("in/side");
    std::fs::create_dir_all(&place).map_err(failed)?;
    let mut program = Command::new(program().map_err(failed)?)
        .args(text(case).split('\n'))
        .current_dir(&place)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(File::create(&errors).map_err(failed)?)
        .spawn()
        .map_err(failed)?;
    let status = wait(&mut program)?;
    let mut said = String::new();
    File::open(&errors).and_then(|mut it| it.read_to_string(&mut said)).map_err(failed)?;
    match status.code() {
        Some(0) => Ok(Answer::Accepted),
        // The parser of options answers in several lines, with what is allowed; as long as the words of the
        // person that typed them.
        Some(1 | 2) if !said.trim().is_empty() => {
            said.lines().try_for_each(check_line).map(|()| Answer::Refused)
        }
        code => Err(Fault::Panic(format!("code {code:?}: {said}"))),
    }
}

/// Waits for a program, as long as there is patience.
fn wait(program: &mut Child) -> Result<ExitStatus, Fault> {
    let began = Instant::now();
    loop {
        match program.try_wait() {
            Ok(Some(status)) => return Ok(status),
            Ok(None) if began.elapsed() > PATIENCE => {
                // One that has just ended cannot be killed.
                let _ = program.kill().and_then(|()| program.wait().map(drop));
                return Err(Fault::Slow(began.elapsed()));
            }
            Ok(None) => thread::sleep(Duration::from_millis(1)),
            Err(error) => return Err(Fault::Law(format!("cannot be tried: {error}"))),
        }
    }
}
