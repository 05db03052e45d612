//! Files of killed runs: tables and series can be read. These tests have found a series whose list
//! contained none of thousands of frames.

mod command;

use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::{Duration, Instant};

use command::{carom, moments, path};

/// Longer than any step of these tests on a shared machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// Runs a scene of several days with this option, and kills it `later` \[ms\] after `is_enough`
/// returns true.
fn kill(option: &[&str], later: u64, is_enough: impl Fn() -> bool) {
    let mut command = carom();
    let run = ["run", "simtest1", "--rule", "exact", "--seconds", "1e6"];
    let mut child = command.args(run).args(option).stdout(Stdio::null()).spawn().unwrap();
    let began = Instant::now();
    while !is_enough() && began.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(20));
    }
    std::thread::sleep(Duration::from_millis(later));
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(is_enough(), "nothing is on the disk after {:?}", began.elapsed());
}

fn read(file: &str) -> String {
    std::fs::read_to_string(file).unwrap_or_default()
}

#[test]
fn a_killed_run_leaves_a_list_of_frames_that_are_all_there() {
    for later in [0, 7, 61] {
        let folder = tempfile::tempdir().unwrap();
        let file = path(&folder, "run.pvd");
        kill(&["--out", &file], later, || read(&file).contains("timestep"));
        let list = read(&file);
        assert!(list.ends_with("</VTKFile>\n"));
        let frames =
            list.lines().filter_map(|line| line.split("file=\"").nth(1)?.split('"').next());
        for frame in frames {
            let text = read(Path::new(&file).with_file_name(frame).to_str().unwrap());
            assert!(text.trim_end().ends_with("</VTKFile>"), "{frame}");
        }
    }
}

#[test]
fn a_killed_run_leaves_the_rows_of_its_tables() {
    for later in [0, 13, 89] {
        let folder = tempfile::tempdir().unwrap();
        let (table, impacts) = (path(&folder, "t.csv"), path(&folder, "i.csv"));
        let has_rows = || [&table, &impacts].iter().all(|file| read(file).lines().count() > 2);
        kill(&["--out", &table, "--impacts", &impacts], later, has_rows);
        for file in [&table, &impacts] {
            let text = read(file);
            let width = |line: &str| line.split(',').count();
            let whole = text.rfind('\n').unwrap();
            let mut lines = text[..whole].lines();
            let header = width(lines.next().unwrap());
            assert!(lines.all(|line| width(line) == header), "only the last line may be cut short");
        }
    }
}

/// Records a gas to a file until it is killed, `milliseconds` after its first impact; returns the
/// time of the last impact that was printed before \[s\].
fn killed_gas(file: &str, milliseconds: u64) -> f64 {
    let run = ["run", "gas", "--seconds", "1e6", "--impacts", "/dev/stdout", "--out", file];
    let mut child = carom().args(run).stdout(Stdio::piped()).spawn().unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    lines.next().unwrap().unwrap();
    let first = Instant::now();
    let mut last = 0.0;
    while let Some(Ok(line)) = lines.next() {
        last = line.split(',').next().unwrap().parse().unwrap();
        if first.elapsed() >= Duration::from_millis(milliseconds) {
            break;
        }
    }
    child.kill().unwrap();
    child.wait().unwrap();
    last
}

/// Computes the state of the gas frame by frame, as numbers of 17 digits.
struct Gas {
    world: carom::World,
    frame_time: f64,
    frames: Vec<(f64, Vec<f64>)>,
}

impl Gas {
    fn new() -> Self {
        let (scene, _) = carom_scene::Library::new().find("gas", &[]).unwrap();
        let frame_time = scene.simulation.frame_time;
        Self { world: scene.world().unwrap(), frame_time, frames: Vec::new() }
    }

    fn frame(&mut self, frame: usize) -> &(f64, Vec<f64>) {
        while self.frames.len() <= frame {
            self.world.step(self.frame_time).unwrap();
            let positions = self.world.spheres().positions();
            let positions = positions.iter().flat_map(|it| it.to_array()).collect();
            self.frames.push((self.world.time(), positions));
        }
        &self.frames[frame]
    }

    /// Checks that a recording contains all frames except the current one, bit for bit.
    fn check(&mut self, recorded: &[(f64, Vec<f64>)], told: f64) {
        self.check_rounded(recorded, told, |number| number);
    }

    /// Checks the frames of a recording after rounding by `rounded`.
    fn check_rounded(
        &mut self,
        recorded: &[(f64, Vec<f64>)],
        told: f64,
        rounded: impl Fn(f64) -> f64,
    ) {
        for (i, (time, positions)) in recorded.iter().enumerate() {
            let (expected_time, expected) = self.frame(i);
            assert_eq!(time.to_bits(), rounded(*expected_time).to_bits(), "frame {i}");
            let expected = expected.iter().map(|number| rounded(*number));
            assert!(positions.iter().copied().eq(expected), "frame {i}");
        }
        // The last impact may belong to the frame that was being computed.
        let last = recorded.last().map_or(0.0, |frame| frame.0);
        assert!(last >= told - 1.001 * self.frame_time, "{last} s of {told} s");
    }
}

/// Times \[s\] and files of the frames of a series.
fn listed(list: &str) -> Vec<(f64, PathBuf)> {
    let text = read(list);
    assert!(text.ends_with("</VTKFile>\n"));
    let attribute = |line: &str, name: &str| {
        let value = line.split(&format!("{name}=\"")).nth(1)?.split('"').next()?;
        Some(value.to_owned())
    };
    let row = |line| {
        let time = attribute(line, "timestep")?.parse().unwrap();
        Some((time, Path::new(list).with_file_name(attribute(line, "file")?)))
    };
    text.lines().filter_map(row).collect()
}

/// Positions \[m\] in a frame of a series, as a flat list.
fn positions(frame: &Path) -> Vec<f64> {
    use vtkio::model::{DataSet, Piece};

    let DataSet::PolyData { pieces, .. } = vtkio::Vtk::import(frame).unwrap().data else {
        panic!("poly data")
    };
    let Piece::Inline(piece) = &pieces[0] else { panic!("inline") };
    piece.points.clone().into_vec().unwrap()
}

#[test]
#[cfg(target_os = "linux")]
fn the_list_of_a_killed_series_lacks_the_frames_of_a_second_at_most() {
    /// How coarse the modification times of files are, and how long a busy machine may hold the
    /// command between a list and the look at its clock.
    const TICK: Duration = Duration::from_millis(500);
    let mut gas = Gas::new();
    for moment in moments() {
        let folder = tempfile::tempdir().unwrap();
        let file = path(&folder, "run.pvd");
        killed_gas(&file, moment);
        let rows = listed(&file);
        for (time, frame) in &rows {
            assert!(read(frame.to_str().unwrap()).trim_end().ends_with("</VTKFile>"), "{time} s");
        }
        for place in [0, rows.len() / 2, rows.len().saturating_sub(1)] {
            let Some((time, frame)) = rows.get(place) else { continue };
            assert_eq!((*time, positions(frame)), *gas.frame(place));
        }
        // Even on a busy machine, a frame written more than a second after the list causes a new
        // list before the next frame.
        let modified = |file: &Path| std::fs::metadata(file).and_then(|it| it.modified());
        let written = modified(Path::new(&file)).unwrap();
        let frames = (rows.len()..).map(|frame| format!("run_frames/{frame:06}.vtp"));
        let times = frames.map_while(|frame| modified(&folder.path().join(frame)).ok());
        let mut later: Vec<_> = times.map(|it| it.duration_since(written).ok()).collect();
        // The last file may be incomplete.
        later.pop();
        assert!(later.iter().flatten().all(|later| *later < Duration::from_secs(1) + TICK));
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_killed_run_leaves_all_frames_of_an_archive_but_the_one_at_work() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "run.npz");
    let mut gas = Gas::new();
    for moment in moments() {
        let told = killed_gas(&file, moment);
        assert!(!Path::new(&file).exists());
        command::good(&["recover", &file]);
        let mut zip = zip::ZipArchive::new(std::fs::File::open(&file).unwrap()).unwrap();
        let mut array = |name: &str| {
            let mut bytes = Vec::new();
            zip.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
            npyz::NpyFile::new(&bytes[..]).unwrap().into_vec::<f64>().unwrap()
        };
        let (times, positions) = (array("time"), array("position"));
        let width = positions.len() / times.len().max(1);
        let frames = times.into_iter().zip(positions.chunks(width.max(1)).map(<[f64]>::to_vec));
        gas.check(&frames.collect::<Vec<_>>(), told);
        std::fs::remove_file(&file).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing else is left");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_killed_run_leaves_all_frames_of_an_animation_but_the_one_at_work() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "run.glb");
    let mut gas = Gas::new();
    for moment in moments() {
        let told = killed_gas(&file, moment);
        assert!(!Path::new(&file).exists());
        command::good(&["recover", &file]);
        gas.check_rounded(&command::keys(&file), told, |number| f64::from(number as f32));
        std::fs::remove_file(&file).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing else is left");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_killed_run_leaves_all_frames_of_a_table_but_the_one_at_work() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "run.csv");
    let mut gas = Gas::new();
    for moment in moments() {
        let told = killed_gas(&file, moment);
        command::good(&["recover", &file]);
        let mut frames: Vec<(f64, Vec<f64>)> = Vec::new();
        for line in read(&file).lines().skip(1) {
            let row: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
            if frames.last().is_none_or(|frame| frame.0 != row[0]) {
                frames.push((row[0], Vec::new()));
            }
            frames.last_mut().unwrap().1.extend(&row[2..5]);
        }
        // The last frame may lack balls.
        let whole = gas.frame(0).1.len();
        frames.pop_if(|frame| frame.1.len() < whole);
        gas.check(&frames, told);
        std::fs::remove_file(&file).unwrap();
    }
}

#[test]
#[cfg(unix)]
fn what_is_damaged_stays_and_what_is_foreign_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "run.npz");
    killed_gas(&file, 200);
    let unfinished = format!("{file}.0.unfinished");
    let mut bytes = std::fs::read(&unfinished).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&unfinished, &bytes).unwrap();
    let told = command::good(&["recover", &file]);
    assert!(told.contains("are damaged, and stay in"), "{told}");
    assert!(Path::new(&unfinished).exists() && Path::new(&file).exists());
    assert!(command::bad_line(&["recover", &file], 2).contains("--force"));
    std::fs::write(&unfinished, "something else").unwrap();
    let refused = command::bad_line(&["recover", &file, "--force"], 2);
    assert!(refused.contains("is no unfinished recording"), "{refused}");
}

#[test]
#[cfg(unix)]
fn a_recording_without_ends_of_lines_is_refused() {
    use carom_scene::recording::Replay;

    let (scene, _) = carom_scene::Library::new().find("simtest1", &[]).unwrap();
    let error = Replay::open(Path::new("/dev/zero"), &scene).unwrap_err();
    assert!(error.to_string().starts_with("/dev/zero:1: longer than 65536 bytes"), "{error}");
}
