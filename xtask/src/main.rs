//! `cargo xtask`: installs what is missing, then runs demonstrations or checks, or updates files.

#![warn(clippy::unwrap_used)]

mod architecture;
mod book;
mod c_interface;
mod checks;
mod circles;
mod commands;
mod demo;
mod dependencies;
mod documents;
mod files;
mod imports;
mod interface;
mod interfaces;
mod js_package;
mod long_tests;
mod markdown;
mod member;
mod miri;
mod native_hashes;
mod notices;
mod parts;
mod python;
mod release;
mod samples;
mod scene_reference;
mod schema;
mod scripts;
mod setup;
mod shell;
mod sizes;
mod sources;
mod stages;
mod tools;
mod wasm;
mod wasm_toolchain;
mod web;
mod web_tools;
mod words;

use std::process::ExitCode;

use wasm::Purpose;

const USAGE: &str = "\
Usage: cargo xtask COMMAND

  demo      set up, run every built-in scene, make pictures and a film in out/, open the window
  test      set up, then every check: format, clippy, tests, documents, schema, the JavaScript
            package in Node.js, the Python package, programs in C, C++ and C#, the page in a browser; `test --full` adds
            the tests that take minutes; `test --part NAME` runs one part, by itself; `test --changed [COMMIT]`
            runs the parts that the changes since a commit can reach, by default the last one of origin
  web       make the page in web/dist and the JavaScript package; `web --serve [PORT]` makes the
            page and serves it on this machine, `web --out DIR` puts it into a folder for a server of
            static files, `web --sizes` says what takes its space, `web --test`
            tests it in a browser; `web --package` makes the package alone, `web --test-package`
            tests it in Node.js
  python    make the wheel of the Python package; `python --test` also installs and tests it
  c         make the shared and the static library of the C interface; `c --test` tests it with
            programs in C, C++ and C#
  header    write crates/carom-c/include/carom.h anew from the C interface
  interface write crates/carom/interface.txt anew: what the crate carom promises
  notebook  put the viewer for notebooks into the Python package, for `pip install .`
  words     `words --sample [SEED]` prints doc comments drawn at random, to be read without the code
  lint      the checks that need no build: format, words, links and names in documents, modules of
            any language that use each other in a circle, files and functions that are too long
  documents run the commands that README.md and docs/ show, except those that draw
  docs      make a site with a search of all documents, in target/book/book (installs mdbook: minutes)
  schema    write scene.schema.json and fields.md in crates/carom-scene/scenes from the scene types, and
            the classes of Python that scenes are made of
  parts     write these classes alone, from the schema that is there
  release   `release --dry-run` makes and checks all that a release publishes, in
            target/release-files, and publishes nothing (many minutes; `--part NAME` makes one part of it,
            `--full` builds once more from every package, `--keep-viewer` takes the viewer for notebooks that
            is there); `release --ready TAG` says what is left to be done before
  soak      a day of simulated time of several scenes: pinned states, hour by hour, and flat memory
            (a quarter of an hour; `soak --hours H` for another time; after a whole day `soak --again`: every
            hour of it once more, side by side)
  fuzz      hostile input for every reader, and worlds that are hard to step: the campaign of
            docs/reliability.md; `fuzz --help` says how to choose
  miri      has Miri interpret tests of the code with unsafe (installs nightly Rust; minutes)
  kills     kills a hundred runs in each format of recordings, and films: what is lost (some minutes)
  bench     the benchmarks whose figures stand in docs/benchmarks.md; `bench pictures` those of
            pictures and of the interface, `bench web` the JavaScript package against the native
            engine";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match arguments[..] {
        ["demo"] => demo::demo(),
        ["test"] => checks::all(),
        ["test", "--full"] => {
            checks::all().and_then(|()| long_tests::run()).and_then(|()| long_tests::kills())
        }
        ["test", "--part", part] => checks::part(part),
        ["test", "--changed"] => checks::changed(None),
        ["test", "--changed", base] => checks::changed(Some(base)),
        ["web"] => web::build().and_then(|()| js_package::build(Purpose::Use)).map(drop),
        ["web", "--serve"] => web::serve(web::PORT),
        ["web", "--serve", port] => web::serve(port),
        ["web", "--out", folder] => web::publish(folder.as_ref()),
        ["web", "--sizes"] => web::sizes(),
        ["web", "--test"] => web::test(),
        ["web", "--package"] => js_package::build(Purpose::Use).map(drop),
        ["web", "--test-package"] => js_package::test(),
        ["python"] => python::build().map(drop),
        ["python", "--test"] => python::test(),
        ["c"] => c_interface::build(),
        ["c", "--test"] => c_interface::test(),
        ["header"] => c_interface::write_header(),
        ["interface"] => interface::write(),
        ["words", "--sample"] => samples::print(None),
        ["words", "--sample", seed] => samples::print(Some(seed)),
        ["notebook"] => web::build_for_notebooks(Purpose::Use),
        ["lint"] => checks::lint(),
        ["documents"] => commands::check_plain(),
        ["docs"] => book::build(),
        ["schema"] => schema::write(),
        ["parts"] => parts::write(),
        ["soak"] => long_tests::soak("24"),
        ["soak", "--hours", hours] => long_tests::soak(hours),
        ["soak", "--again"] => long_tests::soak_again(),
        ["fuzz", ref options @ ..] => long_tests::fuzz(options),
        ["miri"] => miri::test(),
        ["kills"] => long_tests::kills(),
        ["release", "--dry-run", ref options @ ..] => release::dry_run(options),
        ["release", "--ready", tag] => release::check_readiness(tag),
        ["bench"] => shell::cargo(&["bench", "--package", "carom"]),
        ["bench", "web"] => js_package::bench(),
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
