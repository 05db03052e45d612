//! Names of pictures and films, and the text on them.

/// Returns a file name made from scene and time \[s\], without an ending.
pub fn file_name(scene: &str, time: f64) -> String {
    let scene: String =
        scene.chars().map(|it| if it.is_alphanumeric() || it == '-' { it } else { '_' }).collect();
    format!("{scene}-{time:.3}s")
}

/// Returns the text that is written on a picture.
pub fn stamp_text(scene: &str, time: f64) -> String {
    format!("{scene}   t = {time:.3} s")
}
