//! Trajectories and impacts as CSV, NPZ and VTK.

use std::io::Read;

use crate::command::{good, path};
use crate::{rows, summary};

#[test]
fn the_trajectory_as_csv_has_a_row_per_ball_and_frame_with_17_digits() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "t.csv");
    good(&["run", "simtest1", "--seconds", "1", "--out", &file]);
    let (header, rows) = rows(&file);
    assert_eq!(header, vec!["t", "ball", "x", "y", "z", "vx", "vy", "vz"]);
    // The second ball appears in frame 36, at 0.7 s.
    assert_eq!(rows.len(), 50 + 15);
    let number = |field: &str| field.parse::<f64>().unwrap();
    assert_eq!(number(&rows[0][0]), 0.02);
    assert_eq!(rows[49 + 15][1], "1");
    // v = -g t under this scheme; 17 digits distinguish any two doubles.
    assert_eq!(rows[0][6], "-4.0000000000000002e-1");
    assert!(
        rows[34]
            .iter()
            .skip(2)
            .all(|field| { field.split('e').next().unwrap().trim_start_matches('-').len() == 18 })
    );
}

#[test]
fn every_thins_the_trajectory() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "t.csv");
    good(&["run", "tutorial2", "--frames", "20", "--every", "6", "--out", &file]);
    assert_eq!(rows(&file).1.len(), 3 * 10);
}

/// An NPZ file.
struct Archive(zip::ZipArchive<std::fs::File>);

impl Archive {
    fn open(path: &str) -> Self {
        Self(zip::ZipArchive::new(std::fs::File::open(path).unwrap()).unwrap())
    }

    fn bytes(&mut self, name: &str) -> Vec<u8> {
        let mut bytes = Vec::new();
        self.0.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
        bytes
    }

    /// Shape and values of an array.
    fn numbers(&mut self, name: &str) -> (Vec<u64>, Vec<f64>) {
        let bytes = self.bytes(name);
        let array = npyz::NpyFile::new(&bytes[..]).unwrap();
        (array.shape().to_vec(), array.into_vec().unwrap())
    }

    fn integers(&mut self, name: &str) -> Vec<i64> {
        npyz::NpyFile::new(&self.bytes(name)[..]).unwrap().into_vec().unwrap()
    }
}

#[test]
fn the_trajectory_as_npz_holds_the_same_numbers_as_the_csv() {
    let folder = tempfile::tempdir().unwrap();
    let (table, archive) = (path(&folder, "t.csv"), path(&folder, "t.npz"));
    for file in [&table, &archive] {
        good(&["run", "simtest3", "--seconds", "2", "--out", file]);
    }
    let (_, rows) = rows(&table);
    let mut archive = Archive::open(&archive);
    let count = rows.len() as u64;
    let (shape, times) = archive.numbers("t");
    assert_eq!(shape, [count]);
    let (shape, positions) = archive.numbers("position");
    assert_eq!(shape, [count, 3]);
    let (_, velocities) = archive.numbers("velocity");
    let balls = archive.integers("ball");
    let starts = archive.integers("frame_start");
    assert_eq!((starts.len(), starts[0], starts[100]), (101, 0, count as i64));
    for (i, row) in rows.iter().enumerate() {
        assert_eq!(row[0].parse::<f64>().unwrap(), times[i]);
        assert_eq!(row[1].parse::<i64>().unwrap(), balls[i]);
        for k in 0..3 {
            assert_eq!(row[2 + k].parse::<f64>().unwrap(), positions[3 * i + k]);
            assert_eq!(row[5 + k].parse::<f64>().unwrap(), velocities[3 * i + k]);
        }
    }
}

#[test]
fn the_trajectory_as_vtk_is_a_series_with_a_list_of_its_times() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "run.pvd");
    good(&["run", "tutorial2", "--frames", "10", "--every", "5", "--out", &file]);
    let list = std::fs::read_to_string(&file).unwrap();
    let listed: Vec<&str> = list.lines().filter(|line| line.contains("<DataSet")).collect();
    assert_eq!(listed.len(), 2);
    assert!(listed[1].contains("timestep=\"0.16666666666666666\" file=\"run_frames/000001.vtp\""));
    let frame = vtkio::Vtk::import(folder.path().join("run_frames/000001.vtp")).unwrap();
    let vtkio::model::DataSet::PolyData { pieces, .. } = frame.data else { panic!("poly data") };
    let vtkio::model::Piece::Inline(piece) = &pieces[0] else { panic!("inline") };
    assert_eq!(piece.points.len(), 3 * 10);
    assert_eq!(piece.data.point.len(), 4);
}

#[test]
fn a_shorter_series_leaves_no_frame_of_a_longer_one() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "run.pvd");
    let frames = || std::fs::read_dir(folder.path().join("run_frames")).unwrap().count();
    for (count, expected) in [("10", 10), ("4", 4)] {
        good(&["run", "tutorial2", "--frames", count, "--out", &file, "--force"]);
        assert_eq!(frames(), expected);
    }
}

#[test]
fn impacts_as_npz_are_those_of_the_csv() {
    let folder = tempfile::tempdir().unwrap();
    let (table, archive) = (path(&folder, "i.csv"), path(&folder, "i.npz"));
    for file in [&table, &archive] {
        good(&["run", "tutorial4", "--seconds", "2", "--impacts", file]);
    }
    let (_, rows) = rows(&table);
    let mut archive = Archive::open(&archive);
    let [colliders, firsts, seconds] =
        ["collider", "sphere_1", "sphere_2"].map(|name| archive.integers(name));
    let single = ["time", "approach_speed", "impulse"].map(|name| archive.numbers(name));
    let triple = ["point", "normal", "tangential_impulse"].map(|name| archive.numbers(name));
    let (count, parse) = (rows.len() as u64, |field: &String| field.parse::<f64>().unwrap());
    assert!(count > 100 && single.iter().all(|(shape, _)| *shape == [count]));
    assert!(triple.iter().all(|(shape, _)| *shape == [count, 3]));
    for (i, row) in rows.iter().enumerate() {
        let first = row[2].parse::<i64>().unwrap();
        let bodies = if row[1] == "sphere" { [-1, first] } else { [first, -1] };
        assert_eq!([colliders[i], firsts[i]], bodies);
        assert_eq!(seconds[i], row[3].parse::<i64>().unwrap());
        let columns = [&row[4..7], &row[7..10], &row[12..15]];
        assert_eq!([&row[0], &row[10], &row[11]].map(parse), [0, 1, 2].map(|k| single[k].1[i]));
        for ((_, values), column) in triple.iter().zip(columns) {
            assert_eq!(values[3 * i..3 * i + 3], column.iter().map(parse).collect::<Vec<_>>());
        }
    }
}

#[test]
fn the_impact_table_has_a_row_for_each_impact() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "impacts.csv");
    let summary = summary(&["run", "tutorial4", "--seconds", "2", "--impacts", &file]);
    let (header, rows) = rows(&file);
    assert_eq!(rows.len() as u64, summary["impacts"].as_u64().unwrap());
    assert!(rows.len() > 100);
    let column = |name: &str| header.iter().position(|field| field == name).unwrap();
    let times: Vec<f64> = rows.iter().map(|row| row[column("t")].parse().unwrap()).collect();
    assert!(times.is_sorted() && times[0] > 0.0 && times[rows.len() - 1] <= 2.0);
    for row in &rows {
        assert!(["sphere", "collider"].contains(&row[column("kind1")].as_str()));
        assert!(row[column("approach_speed")].parse::<f64>().unwrap() > 0.0);
        assert!(row[column("impulse")].parse::<f64>().unwrap() > 0.0);
    }
}
