//! What pictures and films are called, and what is written on them.

/// Scene and time \[s\], without an ending.
pub fn file_name(scene: &str, time: f64) -> String {
    let scene: String =
        scene.chars().map(|it| if it.is_alphanumeric() || it == '-' { it } else { '_' }).collect();
    format!("{scene}-{time:.3}s")
}

/// What is written on a picture.
pub fn stamp_text(scene: &str, time: f64) -> String {
    format!("{scene}   t = {time:.3} s")
}
