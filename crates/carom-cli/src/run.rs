//! The command `run`: steps a scene, records it, sums it up.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use carom::World;
use carom_scene::Library;
use carom_scene::recording::{ImpactTable, Trajectory};
use indicatif::{ProgressBar, ProgressStyle};

use crate::args::Run;
use crate::failure::Failure;
use crate::summary::{Observer, Summary};

/// Runs that take less than this show no progress bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// Runs a scene and prints what became of it.
pub fn run(library: &Library, args: &Run) -> Result<(), Failure> {
    let rule = args.rule.iter().map(|rule| format!("simulation.rule={rule}"));
    let frame_time = args.frame_time.map(|h| format!("simulation.frame_time={h:?}"));
    let scene = args.choice.find(library, rule.chain(frame_time))?;
    let h = scene.simulation.frame_time;
    let frames = frame_count(args, scene.simulation.duration, h)?;

    let mut outputs = Outputs::create(args)?;
    let mut world = scene.world()?;
    let interrupted = interruption()?;
    let observer = Observer::new(&world);
    let (observer, result) =
        step_all(&mut world, (frames, h), (&interrupted, observer), &mut outputs);
    // Whatever happened, what was written so far is made readable.
    let finished = outputs.finish();
    result?;
    finished?;
    Summary::new(&scene, &world, observer).print(args.json)?;
    if interrupted.load(Ordering::Relaxed) { Err(Failure::Interrupted) } else { Ok(()) }
}

fn frame_count(args: &Run, duration: f64, h: f64) -> Result<u64, Failure> {
    if let Some(frames) = args.frames {
        return Ok(frames);
    }
    // Up to whole frames; a billionth of a frame is rounding.
    let frames = (args.seconds.unwrap_or(duration) / h - 1e-9).ceil();
    if frames < 2f64.powi(53) {
        Ok(frames as u64)
    } else {
        Err(Failure::Usage(format!("{frames} frames of {h} s are more than can be counted")))
    }
}

/// Becomes true when the user asks to stop.
fn interruption() -> Result<Arc<AtomicBool>, Failure> {
    let flag = Arc::new(AtomicBool::new(false));
    let handler_flag = Arc::clone(&flag);
    ctrlc::set_handler(move || handler_flag.store(true, Ordering::Relaxed))
        .map_err(|error| Failure::Fault(format!("cannot listen for Ctrl-C: {error}")))?;
    Ok(flag)
}

/// Steps through all frames, or until the user asks to stop or something fails.
fn step_all(
    world: &mut World,
    (frames, h): (u64, f64),
    (interrupted, mut observer): (&AtomicBool, Observer),
    outputs: &mut Outputs,
) -> (Observer, Result<(), Failure>) {
    let mut progress = Progress::new(frames);
    for frame in 1..=frames {
        let start = world.time();
        let result = observer
            .step(world, h)
            .map_err(Failure::from)
            .and_then(|()| outputs.write(frame, start, world));
        if let Err(failure) = result {
            return (observer, Err(failure));
        }
        progress.show(frame, world.time());
        if interrupted.load(Ordering::Relaxed) {
            break;
        }
    }
    (observer, Ok(()))
}

/// The files of a run.
struct Outputs {
    trajectory: Option<Trajectory>,
    impacts: Option<ImpactTable>,
    every: u64,
}

impl Outputs {
    fn create(args: &Run) -> Result<Self, Failure> {
        Ok(Self {
            trajectory: args.out.as_deref().map(Trajectory::create).transpose()?,
            impacts: args.impacts.as_deref().map(ImpactTable::create).transpose()?,
            every: args.every,
        })
    }

    /// Writes the frame that started at `start` \[s\].
    fn write(&mut self, frame: u64, start: f64, world: &World) -> Result<(), Failure> {
        if let Some(impacts) = &mut self.impacts {
            impacts.write(start, &world.report().impacts)?;
        }
        if let Some(trajectory) = &mut self.trajectory
            && frame.is_multiple_of(self.every)
        {
            trajectory.write(world)?;
        }
        Ok(())
    }

    fn finish(self) -> Result<(), Failure> {
        let trajectory = self.trajectory.map_or(Ok(()), Trajectory::finish);
        self.impacts.map_or(Ok(()), ImpactTable::finish)?;
        Ok(trajectory?)
    }
}

/// A progress bar for those who wait; none where nobody watches.
struct Progress {
    frames: u64,
    began: Instant,
    bar: Option<ProgressBar>,
}

impl Progress {
    fn new(frames: u64) -> Self {
        Self { frames, began: Instant::now(), bar: None }
    }

    fn show(&mut self, frame: u64, time: f64) {
        if self.bar.is_none() && self.began.elapsed() > PATIENCE {
            let style = ProgressStyle::with_template("{wide_bar} {msg}, {eta} left");
            let bar = ProgressBar::new(self.frames).with_elapsed(self.began.elapsed());
            self.bar = Some(bar.with_style(style.unwrap_or(ProgressStyle::default_bar())));
        }
        if let Some(bar) = &self.bar {
            bar.set_position(frame);
            bar.set_message(format!("{time:.2} s"));
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        // Nothing can be done about an error stream that is gone.
        io::stderr().flush().ok();
    }
}
