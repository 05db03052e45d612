//! Builds, serves and tests the page.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use crate::checks::programs;
use crate::setup;
use crate::shell::{Outcome, ci_folder, finish, target_folder};
use crate::wasm::{self, Purpose};
use crate::web_tools::{folder, node, npm_packages, wasm_bindgen};

/// The default port of the page's server.
pub const PORT: &str = "8042";

/// Largest compressed size of everything that a browser fetches to show the page \[bytes\].
const BUDGET: u64 = 4_000_000;

/// Builds the page in `web/dist`, checks its size, and prints how it is seen.
pub fn build() -> Outcome {
    let began = Instant::now();
    build_module(&folder().join("module"), Purpose::Use)?;
    node(&["bundle.js", "module", "dist"], &[])?;
    check_size(&folder().join("dist"))?;
    println!("{}", built(began.elapsed()));
    Ok(())
}

/// Returns the line after a build that took this long.
fn built(took: Duration) -> String {
    let (minutes, seconds) = (took.as_secs() / 60, took.as_secs() % 60);
    let address = format!("http://127.0.0.1:{PORT}/");
    format!("Built in {minutes} min {seconds:02} s: cargo xtask web --serve shows it at {address}")
}

/// Builds a page in `web/dist` faster, which behaves like that of [`build`] but is large.
pub fn build_for_tests() -> Outcome {
    build_module(&folder().join("module"), Purpose::Test)?;
    node(&["bundle.js", "module", "dist", "--quick"], &[])
}

/// Builds the interface for notebooks into the Python package, whose wheel contains it.
pub fn build_for_notebooks(purpose: Purpose) -> Outcome {
    // Not in the folder of the page, because both may be built at the same time.
    let module = target_folder().join("notebook-module");
    build_module(&module, purpose)?;
    node(&["notebook.js", &module.to_string_lossy(), "../python/carom/notebook/built"], &[])
}

/// Builds the module in a folder.
fn build_module(out: &Path, purpose: Purpose) -> Outcome {
    setup::page()?;
    npm_packages()?;
    let module = wasm::build("carom-web", purpose)?;
    bind(&module, out, &["--remove-name-section"])
}

/// Builds the page, and serves it on this machine.
pub fn serve(port: &str) -> Outcome {
    build()?;
    node(&["serve.js", "dist", port], &[])
}

/// Builds the page, and copies it into a folder for any server of static files.
pub fn publish(out: &Path) -> Outcome {
    build()?;
    let dist = folder().join("dist");
    if fs::canonicalize(out).ok() == fs::canonicalize(&dist).ok() {
        return Ok(());
    }
    let copied = fs::create_dir_all(out).and_then(|()| {
        fs::read_dir(&dist)?.try_for_each(|entry| {
            let path = entry?.path();
            fs::copy(&path, out.join(path.file_name().unwrap_or_default())).map(drop)
        })
    });
    copied.map_err(|error| format!("cannot put the page into {}: {error}", out.display()))?;
    println!("The page is in {}: any server of static files can serve it.", out.display());
    Ok(())
}

/// Prints the size of each crate in the module.
pub fn sizes() -> Outcome {
    npm_packages()?;
    let module = wasm::build("carom-web", Purpose::Use)?;
    let named = target_folder().join("web-named");
    bind(&module, &named, &[])?;
    node(&["sizes.js", &named.join("carom_web_bg.wasm").to_string_lossy()], &[])
}

/// Builds the page, and tests it in a browser.
pub fn test() -> Outcome {
    build_for_tests()?;
    setup::browser()?;
    let prettier = "node_modules/prettier/bin/prettier.cjs";
    let of_notebooks = "../python/carom/notebook/*.{js,css}";
    // Files outside of this folder are formatted by its settings, too.
    node(&[prettier, "--check", "--config", "package.json", ".", of_notebooks], &[])?;
    node(&["node_modules/typescript/bin/tsc", "--project", "."], &[])?;
    // Tests compare the page with the native program.
    programs::build()?;
    let carom = ci_folder().join("carom");
    let carom = carom.to_string_lossy();
    node(&["tests/run.js"], &[("CAROM", &carom)])
}

/// Runs `wasm-bindgen`, which writes a JavaScript module around a WebAssembly module.
fn bind(module: &Path, out: &Path, options: &[&str]) -> Outcome {
    let mut command = Command::new(wasm_bindgen()?);
    command.args(["--target", "web", "--remove-producers-section"]).args(options);
    finish("wasm-bindgen", command.arg("--out-dir").arg(out).arg(module))
}

/// Prints the sizes of the page's files, and fails if the page is too large.
fn check_size(dist: &Path) -> Outcome {
    let size = |path: &Path| fs::metadata(path).map(|it| it.len());
    let mut files = Vec::new();
    for entry in fs::read_dir(dist).map_err(|error| error.to_string())? {
        let path = entry.map_err(|error| error.to_string())?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let compressed = dist.join(format!("{name}.gz"));
        if let (Ok(raw), Ok(compressed)) = (size(&path), size(&compressed)) {
            files.push((compressed, raw, name));
        }
    }
    files.sort_unstable_by(|a, b| b.cmp(a));
    eprintln!("\n{:>10} {:>10}  web/dist", "bytes", "gzip");
    for (compressed, raw, name) in &files {
        eprintln!("{raw:>10} {compressed:>10}  {name}");
    }
    let all: u64 = files.iter().map(|(compressed, ..)| compressed).sum();
    eprintln!("{:>10} {all:>10}  all", "");
    if all > BUDGET {
        return Err(format!("the page is {all} bytes compressed; it may be {BUDGET}"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_a_build_its_time_and_the_address_of_the_page_are_printed() {
        let line = built(Duration::from_secs(247));
        assert!(line.starts_with("Built in 4 min 07 s: "), "{line}");
        assert!(line.ends_with("http://127.0.0.1:8042/"), "{line}");
    }
}
