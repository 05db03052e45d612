//! `cargo xtask`: sets up what is missing, then demonstrates, checks, or brings files up to date.

#![warn(clippy::unwrap_used)]

mod architecture;
mod demo;
mod schema;
mod setup;
mod shell;
mod test;
mod wasm;

use std::process::ExitCode;

const USAGE: &str = "\
Usage: cargo xtask COMMAND

  demo      set up, run every built-in scene, make pictures and a film in out/, open the window
  test      set up, then every check: format, clippy, tests, documents, schema, the browser's target
  schema    write scenes/scene.schema.json anew from the scene types
  bench     the benchmarks whose figures stand in docs/benchmarks.md; `bench pictures` those of
            pictures and of the interface";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match arguments[..] {
        ["demo"] => demo::demo(),
        ["test"] => test::test(),
        ["schema"] => schema::write(),
        ["bench"] => shell::cargo(&["bench", "--package", "carom"]),
        ["bench", "pictures"] => {
            shell::cargo(&["bench", "--package", "carom-render", "--package", "carom-view"])
        }
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}
