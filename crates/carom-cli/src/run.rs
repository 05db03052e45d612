//! The command `run`: steps a scene, records it and prints a summary.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use carom::{StopRequest, World};
use carom_gltf::{Animation, ExportError};
use carom_scene::recording::{ImpactTable, LedgerTable, RecordingError, Trajectory, WellTable};
use carom_scene::scene::Rule;
use carom_scene::{Budget, ChangedFile, Library, Source};
use carom_session::Replay;

use crate::args::Run;
use crate::failure::{Failure, both, complain};
use crate::interruption::interruption;
use crate::link;
use crate::progress::Progress;
use crate::sensitivity::Sensitivity;
use crate::standard_input::{STANDARD, is_standard};
use crate::summary::{Observer, Summary};

/// Runs a scene and prints a summary; repeatedly, if its file is watched. `links` limits the scene
/// of a link.
pub fn run(library: &Library, args: &Run, links: Budget) -> Result<(), Failure> {
    let series = args.out.as_deref().into_iter().flat_map(series);
    let tables = outputs_of(args).into_iter().flatten().cloned();
    let files: Vec<PathBuf> = tables.chain(series).collect();
    // The shell is responsible for the file to which the standard output is redirected.
    let named = files.iter().map(PathBuf::as_path).filter(|file| !is_standard(file));
    args.replacing.check(named)?;
    let interrupted = interruption()?;
    if !args.watch {
        return once(library, args, links, &interrupted);
    }
    let mut file = ChangedFile::new(&watched(library, args)?);
    loop {
        match once(library, args, links, &interrupted) {
            Err(failure @ (Failure::Interrupted | Failure::OutputClosed)) => return Err(failure),
            Err(failure) => _ = failure.report(),
            Ok(()) => {}
        }
        complain(&format!("carom: waiting for a change of {}; Ctrl-C ends", file.path().display()));
        if !wait_for_change(&mut file, &interrupted) {
            return Err(Failure::Interrupted);
        }
    }
}

/// Files that a run writes, as far as they are given.
fn outputs_of(args: &Run) -> [&Option<PathBuf>; 4] {
    [&args.out, &args.impacts, &args.wells, &args.ledger]
}

/// Interval between checks of a watched file.
const INTERVAL: Duration = Duration::from_millis(200);

/// Waits until the file is changed or `interrupted` is set; returns whether it was changed.
fn wait_for_change(file: &mut ChangedFile, interrupted: &AtomicBool) -> bool {
    while !interrupted.load(Ordering::Relaxed) {
        if file.look() {
            return true;
        }
        std::thread::sleep(INTERVAL);
    }
    false
}

/// Path of the file to watch.
fn watched(library: &Library, args: &Run) -> Result<PathBuf, Failure> {
    let scene = args.scene.as_deref().unwrap_or_default();
    match args.changes.find(library, scene, []) {
        Ok((_, Source::File(path))) => Ok(path),
        Ok(_) => Err(Failure::Usage(format!("--watch needs a scene file, which {scene} is not"))),
        // An invalid file may be corrected while it is watched.
        Err(failure) => {
            let files = [PathBuf::from(scene), PathBuf::from(format!("{scene}.toml"))];
            files.into_iter().find(|file| file.is_file()).ok_or(failure)
        }
    }
}

fn once(
    library: &Library,
    args: &Run,
    links: Budget,
    interrupted: &Arc<AtomicBool>,
) -> Result<(), Failure> {
    let (mut replay, frames) = match (&args.link, &args.scene) {
        (Some(link), _) => link::begin(link, links)?,
        // Without a link there is a scene: the arguments require it.
        (None, Some(scene)) if scene.contains("#scene=") || scene.contains("#file=") => {
            return Err(Failure::Usage("a link is run by --link".to_owned()));
        }
        (None, scene) => begin(library, scene.as_deref().unwrap_or_default(), args)?,
    };

    let mut sensitivity = Sensitivity::of(replay.world(), &args.sensitivity)?;
    let mut outputs = Outputs::create(args, &replay, frames, sensitivity.as_ref())?;
    replay.set_stop_request(Some(StopRequest::from(interrupted.clone())));
    let mut observer = Observer::new(replay.world());
    if let Some(volume) = args.stress {
        observer.measure_stress(replay.world(), volume)?;
    }
    let progress = Progress::new(frames);
    let mut result = Ok(());
    for frame in 1..=frames {
        let start = replay.world().time();
        result = observer
            .step(&mut replay, |replay| match &mut sensitivity {
                Some(sensitivity) => replay.step_by(|world, dt| sensitivity.step(world, dt)),
                None => Ok(replay.step()?),
            })
            .and_then(|()| outputs.write(frame, start, replay.world(), sensitivity.as_ref()));
        progress.show(frame, replay.world().time());
        if result.is_err() || interrupted.load(Ordering::Relaxed) {
            break;
        }
    }
    if matches!(result, Err(Failure::Interrupted)) {
        // The current frame was abandoned; earlier ones count.
        result = Ok(());
    }
    drop(progress);
    // Completes the files even after an error.
    let finished = outputs.finish();
    both(result, finished)?;
    check_energy(replay.world())?;
    let summary = Summary::new(&replay, observer);
    let tables = outputs_of(args).into_iter().flatten();
    if tables.into_iter().any(|table| is_standard(table)) {
        summary.print(&mut io::stderr().lock(), args.json)?;
    } else {
        summary.print(&mut io::stdout().lock(), args.json)?;
    }
    if interrupted.load(Ordering::Relaxed) {
        return Err(Failure::Interrupted);
    }
    if args.strict && !summary.broken().is_empty() {
        let rule = replay.simulation().rule.name();
        let broken = summary.broken().join("; ");
        return Err(Failure::Fault(format!("the rule {rule} was not kept: {broken}")));
    }
    Ok(())
}

/// Refuses to summarize a run whose numbers have overflowed.
fn check_energy(world: &World) -> Result<(), Failure> {
    if world.total_energy().is_finite() {
        return Ok(());
    }
    let time = world.time();
    let problem =
        format!("at {time} s, the energy is not finite: numbers of the scene are too large");
    Err(Failure::Fault(problem))
}

/// Returns a scene at its start, and the number of frames to take.
fn begin(library: &Library, scene: &str, args: &Run) -> Result<(Replay, u64), Failure> {
    let rule = args.rule.iter().map(|rule| format!("simulation.rule={rule}"));
    let (scene, _) = args.changes.find(library, scene, rule.chain(args.length.overrides()))?;
    let simulation = &scene.simulation;
    let frames = args.length.frames(simulation.duration, simulation.frame_time)?;
    Ok((Replay::new(scene)?, frames))
}

/// Other files of a series for ParaView: its list, and its first frame.
fn series(out: &Path) -> Vec<PathBuf> {
    let is_one = out.extension().is_some_and(|it| it == "pvd" || it == "vtp");
    let stem = out.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let first = out.with_file_name(format!("{stem}_frames")).join("000000.vtp");
    if is_one { vec![out.with_extension("pvd"), first] } else { Vec::new() }
}

/// Whether the ending of a trajectory is that of an animation.
fn is_animation(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("glb"))
}

/// Creates the file of a trajectory, with columns for derivatives.
fn trajectory(
    path: &Path,
    replay: &Replay,
    sensitivity: Option<&Sensitivity>,
) -> Result<Trajectory, Failure> {
    let file = trajectory_file(path, replay)?;
    Ok(match sensitivity {
        Some(sensitivity) => file.with_columns(sensitivity.columns())?,
        None => file,
    })
}

/// Creates the file of a trajectory. Animations are handled here, other formats by `recording`.
fn trajectory_file(path: &Path, replay: &Replay) -> Result<Trajectory, Failure> {
    if is_standard(path) {
        return Ok(Trajectory::csv(io::stdout(), STANDARD));
    }
    if is_animation(path) {
        let animation = Animation::create(path, replay.scene(), replay.world());
        let animation = animation.map_err(|error| match error {
            ExportError::Scene(error) => error.into(),
            error => Failure::Fault(format!("cannot write {}: {error}", path.display())),
        })?;
        return Ok(Trajectory::in_format(path, Box::new(animation)));
    }
    Ok(Trajectory::create(path)?)
}

/// Creates a table, if it has a path: in a file, or on the standard output.
fn table<T>(
    path: Option<&Path>,
    create: impl FnOnce(&Path) -> Result<T, RecordingError>,
    csv: impl FnOnce(io::Stdout, &str) -> Result<T, RecordingError>,
) -> Result<Option<T>, RecordingError> {
    let Some(path) = path else { return Ok(None) };
    if is_standard(path) { csv(io::stdout(), STANDARD) } else { create(path) }.map(Some)
}

/// Canonical path of a file, which may not exist yet.
fn place_of(file: &Path) -> PathBuf {
    if is_standard(file) {
        return PathBuf::from(STANDARD);
    }
    let folder = match file.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let in_folder = || Some(folder.canonicalize().ok()?.join(file.file_name()?));
    file.canonicalize().ok().or_else(in_folder).unwrap_or_else(|| file.to_owned())
}

/// Converts an error of a trajectory, and adds the number of frames kept.
fn with_kept(error: RecordingError, frames: u64) -> Failure {
    match Failure::from(error) {
        Failure::Fault(message) => {
            Failure::Fault(format!("{message}; kept are the {frames} frames before"))
        }
        failure => failure,
    }
}

/// Refuses a file whose ending is that of no table that the option writes. The ending of `--out` selects a format, which
/// refuses others.
fn check_ending(option: &str, file: &Path) -> Result<(), Failure> {
    let known: &[&str] = match option {
        "--out" => return Ok(()),
        "--impacts" => &["csv", "npz"],
        _ => &["csv"],
    };
    let ending = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if ending.is_empty() || known.contains(&ending.as_str()) {
        return Ok(());
    }
    let known = known.join(" or .");
    Err(Failure::Usage(format!("{option} {}: it is a table, .{known}", file.display())))
}

/// Files of a run.
struct Outputs {
    trajectory: Option<Trajectory>,
    impacts: Option<ImpactTable>,
    wells: Option<WellTable>,
    ledger: Option<LedgerTable>,
    every: u64,
}

impl Outputs {
    /// Creates the files of a run.
    fn create(
        args: &Run,
        replay: &Replay,
        frames: u64,
        sensitivity: Option<&Sensitivity>,
    ) -> Result<Self, Failure> {
        let names = ["--out", "--impacts", "--wells", "--ledger"];
        let files = names.iter().zip(outputs_of(args));
        let named = files.filter_map(|(name, file)| Some((*name, file.as_deref()?)));
        let named: Vec<(&str, &Path)> = named.collect();
        for (i, (name, file)) in named.iter().enumerate() {
            let same = named[..i].iter().find(|(_, other)| place_of(other) == place_of(file));
            if let Some((other, _)) = same {
                return Err(Failure::Usage(format!("{other} and {name} are the same file")));
            }
            check_ending(name, file)?;
        }
        if named.iter().any(|(name, _)| *name == "--out") && args.every > frames && frames > 0 {
            let text = format!(
                "--every {}: the run has {frames} frames, and would write none",
                args.every
            );
            return Err(Failure::Usage(text));
        }
        if args.ledger.is_some() && replay.simulation().rule != Rule::Exact {
            let message = "--ledger needs the rule exact: the other rules keep no ledger";
            return Err(Failure::Usage(message.to_owned()));
        }
        let trajectory = |path| trajectory(path, replay, sensitivity);
        // The trajectory comes last: if it is dropped, an unfinished file remains.
        Ok(Self {
            impacts: table(args.impacts.as_deref(), ImpactTable::create, ImpactTable::csv)?,
            wells: table(args.wells.as_deref(), WellTable::create, WellTable::csv)?,
            ledger: table(args.ledger.as_deref(), LedgerTable::create, LedgerTable::csv)?,
            trajectory: args.out.as_deref().map(trajectory).transpose()?,
            every: args.every,
        })
    }

    /// Writes the frame that started at `start` \[s\].
    fn write(
        &mut self,
        frame: u64,
        start: f64,
        world: &World,
        sensitivity: Option<&Sensitivity>,
    ) -> Result<(), Failure> {
        if let Some(impacts) = &mut self.impacts {
            impacts.write(start, &world.report().impacts)?;
        }
        if let Some(wells) = &mut self.wells {
            wells.write(start, &world.report().well_events)?;
        }
        if let Some(ledger) = &mut self.ledger {
            ledger.write(start, world.report())?;
        }
        if let Some(trajectory) = &mut self.trajectory
            && frame.is_multiple_of(self.every)
        {
            let rows = sensitivity.map(Sensitivity::rows).unwrap_or_default();
            let written = trajectory.write_with(world, &rows);
            written.map_err(|error| with_kept(error, trajectory.frames()))?;
        }
        Ok(())
    }

    /// Completes all files; reports all errors.
    fn finish(self) -> Result<(), Failure> {
        let trajectory = self.trajectory.map_or(Ok(()), Trajectory::finish);
        let impacts = self.impacts.map_or(Ok(()), ImpactTable::finish);
        let wells = self.wells.map_or(Ok(()), WellTable::finish);
        let ledger = self.ledger.map_or(Ok(()), LedgerTable::finish);
        // If the reader of the trajectory closed it, other errors are still reported.
        let results = [impacts, wells, ledger, trajectory].map(|it| it.map_err(Failure::from));
        results.into_iter().fold(Ok(()), both)
    }
}
