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

#[test]
fn the_trajectory_as_npz_holds_the_same_numbers_as_the_csv() {
    let folder = tempfile::tempdir().unwrap();
    let (table, archive) = (path(&folder, "t.csv"), path(&folder, "t.npz"));
    for file in [&table, &archive] {
        good(&["run", "simtest3", "--seconds", "2", "--out", file]);
    }
    let (_, rows) = rows(&table);
    let mut zip = zip::ZipArchive::new(std::fs::File::open(&archive).unwrap()).unwrap();
    let mut array = |name: &str| {
        let mut bytes = Vec::new();
        zip.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
        bytes
    };
    let floats = |bytes: Vec<u8>| {
        let array = npyz::NpyFile::new(&bytes[..]).unwrap();
        (array.shape().to_vec(), array.into_vec::<f64>().unwrap())
    };
    let integers =
        |bytes: Vec<u8>| npyz::NpyFile::new(&bytes[..]).unwrap().into_vec::<i64>().unwrap();
    let count = rows.len() as u64;
    let (shape, times) = floats(array("t"));
    assert_eq!(shape, [count]);
    let (shape, positions) = floats(array("position"));
    assert_eq!(shape, [count, 3]);
    let (_, velocities) = floats(array("velocity"));
    let balls = integers(array("ball"));
    let starts = integers(array("frame_start"));
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
