//! Where pictures and films go.

use std::path::{Path, PathBuf};

/// The folder for pictures unless another is asked for: `Pictures/carom` in the user's own folder,
/// the present folder without one.
pub fn default_folder() -> PathBuf {
    let home = std::env::var_os("HOME").or_else(|| std::env::var_os("USERPROFILE"));
    home.map(PathBuf::from).unwrap_or_default().join("Pictures").join("carom")
}

/// A name in the folder that no file has yet: scene, time \[s\], and a number where needed.
pub fn new_name(folder: &Path, scene: &str, time: f64, ending: &str) -> PathBuf {
    let scene: String =
        scene.chars().map(|it| if it.is_alphanumeric() || it == '-' { it } else { '_' }).collect();
    let base = format!("{scene}-{time:.3}s");
    let first = folder.join(format!("{base}.{ending}"));
    let more = (2..).map(|number| folder.join(format!("{base}-{number}.{ending}")));
    std::iter::once(first).chain(more).find(|path| !path.exists()).unwrap_or_default()
}

/// What is written on a picture.
pub fn stamp_text(scene: &str, time: f64) -> String {
    format!("{scene}   t = {time:.3} s")
}
