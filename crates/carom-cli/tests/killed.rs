//! What a run leaves whose process is killed: tables and series that can be read. What it has caught:
//! a series whose list named none of thousands of frames.

mod command;

use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use command::{carom, path};

/// Longer than anything here takes on a machine that is shared.
const PATIENCE: Duration = Duration::from_secs(60);

/// Runs a scene that lasts for days with this option, and kills it once `is_enough` says so, a little later
/// each time.
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
