//! Scenes of glTF, with a file beside them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use carom_gltf::{Options, import};
use proptest::prelude::*;

use crate::fault::{Fault, check_error};
use crate::mutation::mutated;
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "gltf",
    about: "scenes of glTF with a few things wrong, in text and in containers",
    campaign: 20_000,
    cases: || mutated(files()).boxed(),
    check,
};

/// Returns the folder of the files that cases change.
fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../carom-gltf/tests/fixtures")
}

fn files() -> Vec<Vec<u8>> {
    let names = ["bodies.gltf", "meshes.gltf", "run.glb"];
    names.into_iter().filter_map(|name| fs::read(fixtures().join(name)).ok()).collect()
}

fn check(case: &[u8]) -> Result<Answer, Fault> {
    let failed = |error: io::Error| Fault::Law(format!("cannot be tried: {error}"));
    let folder = tempfile::tempdir().map_err(failed)?;
    fs::copy(fixtures().join("meshes.bin"), folder.path().join("meshes.bin")).map_err(failed)?;
    let path = folder.path().join(if case.starts_with(b"glTF") { "case.glb" } else { "case.gltf" });
    fs::write(&path, case).map_err(failed)?;
    match import(&path, &Options::default()) {
        Ok(imported) => {
            let made = imported.scene.world().map(drop);
            made.map_err(|it| Fault::Law(format!("is imported, but makes no world: {it}")))?;
            Ok(Answer::Accepted)
        }
        Err(error) => check_error(&error.to_string()).map(|()| Answer::Refused),
    }
}
