//! The JavaScript package and the page of a release.

use std::process::Command;

use super::archive::{Archive, demand, unpack};
use super::files;
use super::versions::VERSION;
use crate::shell::{Outcome, root};
use crate::wasm::Purpose;
use crate::wasm_toolchain::TARGET;
use crate::web_tools::folder;
use crate::{js_package, notices, web};

/// Loads the unpacked package and steps a world.
const PROGRAM: &str = "import { World } from './src/index.node.js'; \
                       const world = World.fromScene('tutorial4'); \
                       world.step(); console.log(world.stateHash());";

/// Packs the JavaScript package, and tries the content of the archive.
pub fn make_package() -> Outcome {
    let file = files::publish(&js_package::build(Purpose::Use)?)?;
    let wanted = ["package.json", "README.md", "LICENSE-MIT", "src/engine_bg.wasm"];
    demand(&file, &wanted)?;
    demand(&file, &[notices::FILE, "src/index.js", "src/index.node.js", "src/index.d.ts"])?;
    let package = unpack(&file)?;
    let mut node = Command::new("node");
    files::run_in(&package, "node", node.args(["--input-type=module", "--eval", PROGRAM]))
}

/// Packs the page for any server of static files.
pub fn make_page() -> Outcome {
    web::build()?;
    let archive = Archive::new(format!("carom-page-{VERSION}"))?;
    archive.add(&folder().join("dist"), "page")?;
    for licence in ["LICENSE-APACHE", "LICENSE-MIT"] {
        archive.add(&root().join(licence), licence)?;
    }
    files::write(&archive.place(notices::FILE), notices::of("carom-web", TARGET)?)?;
    demand(&archive.pack()?, &["page/index.html", "LICENSE-MIT"])
}
