//! Records a film with a progress bar.

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use carom::StopRequest;
use carom_render::{FilmError, FilmSummary};

use super::film::{Filming, Order};
use super::footage::Footage;
use super::studio::Studio;
use crate::failure::{Failure, both, complain};
use crate::length::whole_frames;
use crate::progress::Progress;

/// Records `seconds` of footage, rounded up to whole frames, and prints a line about the film.
///
/// After an error or an interruption, the frames recorded so far are kept as a film.
pub fn shoot(
    order: Order,
    (mut footage, seconds): (Box<dyn Footage>, f64),
    studio: &mut Studio,
    interrupted: &Arc<AtomicBool>,
) -> Result<(), Failure> {
    let began = Instant::now();
    footage.set_stop_request(StopRequest::from(Arc::clone(interrupted)));
    let path = order.path;
    // A film has at least one frame.
    let frames = whole_frames(seconds, 1.0 / f64::from(order.fps))?.max(1);
    if let Some(remark) = studio.remark(footage.title()) {
        complain(&format!("carom: {remark}"));
    }
    let mut filming = Filming::begin(order, footage.as_mut(), studio)?;
    let progress = Progress::new(frames);
    let mut result: Result<(), Failure> = Ok(());
    for frame in 1..=frames {
        let taken = filming.take_frame().map_err(Failure::from);
        result = taken.map(|time| progress.show(frame, time));
        if result.is_err() || interrupted.load(Ordering::Relaxed) {
            break;
        }
    }
    drop(progress);
    let told = match filming.finish() {
        Ok(summary) => tell(path, summary, began).map_err(Failure::from),
        // The reason for having no frame is already known.
        Err(FilmError::Empty { .. }) if result.is_err() => Ok(()),
        Err(error) => Err(error.into()),
    };
    if matches!(result, Err(Failure::Interrupted)) {
        // The current frame was abandoned; if the earlier frames cannot be saved, that error is
        // reported.
        result = Ok(());
    }
    both(result, told)?;
    if interrupted.load(Ordering::Relaxed) { Err(Failure::Interrupted) } else { Ok(()) }
}

fn tell(path: &Path, film: FilmSummary, began: Instant) -> io::Result<()> {
    let FilmSummary { frames, seconds, bytes } = film;
    let megabytes = bytes as f64 / 1e6;
    let took = began.elapsed().as_secs_f64();
    let name = path.display();
    let line = format!("{name}: {frames} frames, {seconds:.2} s, {megabytes:.2} MB");
    writeln!(io::stdout().lock(), "{line}, made in {took:.1} s")
}
