//! Scenes of Unity with files around them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use carom_unity::{Options, Project, import};
use proptest::prelude::*;

use crate::fault::{Fault, check_error};
use crate::mutation::mutated;
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "unity",
    about: "scenes of Unity with a few things wrong",
    campaign: 5_000,
    cases: || mutated(scenes()).boxed(),
    check,
};

/// Returns the folder of the project whose scenes cases change.
fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../carom-unity/tests/fixtures/Project")
}

fn scenes() -> Vec<Vec<u8>> {
    let names = ["First", "Nested", "Bodies", "Own"];
    let read = |name| fs::read(project().join(format!("Assets/Scenes/{name}.unity"))).ok();
    names.into_iter().filter_map(read).collect()
}

fn check(case: &[u8]) -> Result<Answer, Fault> {
    let failed = |error: io::Error| Fault::Law(format!("cannot be tried: {error}"));
    let folder = tempfile::tempdir().map_err(failed)?;
    copy(&project(), folder.path()).map_err(failed)?;
    let path = folder.path().join("Assets/Scenes/Case.unity");
    fs::write(&path, case).map_err(failed)?;
    let imported = Project::around(&path).and_then(|it| import(&path, &it, &Options::default()));
    match imported {
        Ok(imported) => {
            let made = imported.scene.world().map(drop);
            made.map_err(|it| Fault::Law(format!("is imported, but makes no world: {it}")))?;
            Ok(Answer::Accepted)
        }
        Err(error) => {
            check_error(&error.to_string())?;
            Ok(Answer::Refused)
        }
    }
}

fn copy(from: &Path, to: &Path) -> io::Result<()> {
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let (path, target) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            fs::create_dir_all(&target)?;
            copy(&path, &target)?;
        } else {
            fs::copy(&path, &target)?;
        }
    }
    Ok(())
}
