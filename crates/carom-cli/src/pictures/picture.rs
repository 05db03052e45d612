//! The command `picture`: draws a scene at a time as PNG.

use std::path::Path;

use carom_scene::Library;

use super::args::Picture;
use super::footage::Footage;
use super::stepped::Stepped;
use super::studio::Studio;
use crate::failure::{Failure, complain};
use crate::length::countable;
use crate::progress::Progress;

/// Draws a scene at a time.
pub fn picture(library: &Library, args: &Picture) -> Result<(), Failure> {
    check_ending(&args.out, "png")?;
    args.replacing.check([args.out.as_path()])?;
    let rule = args.rule.iter().map(|rule| format!("simulation.rule={rule}"));
    let scene = args.choice.find(library, rule)?;
    let h = scene.simulation.frame_time;
    let frames = countable((args.at / h).round(), h)?;
    let mut stepped = Stepped::new(scene)?;
    let mut studio = Studio::new(args.look.clone())?;
    if let Some(remark) = studio.remark(stepped.title()) {
        complain(&format!("carom: {remark}"));
    }
    let progress = Progress::new(frames);
    let mut time = 0.0;
    for frame in 1..=frames {
        time = stepped.step()?;
        progress.show(frame, time);
    }
    drop(progress);
    let camera = studio.camera(&mut stepped, time)?;
    studio.picture(&mut stepped, time, &camera)?.save_png(&args.out)?;
    Ok(())
}

/// Refuses a file whose ending names another format.
pub fn check_ending(path: &Path, ending: &str) -> Result<(), Failure> {
    let own = path.extension().unwrap_or_default();
    if own.eq_ignore_ascii_case(ending) {
        return Ok(());
    }
    Err(Failure::Usage(format!("{} must end in .{ending}", path.display())))
}
