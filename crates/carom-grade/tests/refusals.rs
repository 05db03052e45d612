//! Broken tables: one line of error that names the file and the line.

use std::path::Path;

use carom_grade::{Columns, Reading, Recorded};

fn refusal(text: &[u8]) -> String {
    let reading = Reading::default();
    Recorded::parse(Path::new("run.csv"), text, &reading).unwrap_err().to_string()
}

#[test]
fn broken_tables_are_refused_with_the_line() {
    let header = "t,ball,x,y,z\n";
    for (rows, expected) in [
        ("0.02,0,1,2,3\n0.04,0,1,x,3\n", "run.csv:3: \"x\" is no number, in column 4"),
        ("0.02,0,1,2,NaN\n", "run.csv:2: \"NaN\" is no number"),
        ("0.02,0,1,2\n", "run.csv:2: 4 fields where the first line has 5"),
        ("0.02,0,1,2,3\n0.02,0,1,2,3\n", "run.csv:3: ball 0 at this time is in line 2 already"),
        ("-0.02,0,1,2,3\n", "run.csv:2: the time -0.02 s is before the start"),
        ("1e300,0,1,2,3\n", "run.csv:2: the time 1e300 s is more than a day after the start"),
        ("0.02,0,1,2,-1e10\n", "run.csv:2: the ball is farther than 1e9 m"),
        ("0.02,,1,2,3\n", "run.csv:2: the ball is missing"),
        ("", "run.csv: has no rows"),
    ] {
        let error = refusal(format!("{header}{rows}").as_bytes());
        assert!(error.starts_with(expected), "{rows:?}: {error}");
    }
    // A letter of Latin-1.
    let error = refusal(b"t,ball,x,y,z\n0.02,0,1,2,\xff\n");
    assert!(error.starts_with("run.csv:2: \"\u{ff}\" is no number"), "{error}");
}

#[test]
fn a_missing_column_is_named_with_those_that_are_there() {
    let error = refusal(b"seconds,id,x,height,z\n0.02,0,1,2,3\n");
    let expected =
        "there is no column \"y\" for the position; the columns are seconds, id, x, height, z";
    assert!(error.contains(expected) && error.contains("--columns y=NAME"), "{error}");
}

#[test]
fn columns_of_several_balls_are_complete_or_named() {
    for (text, expected) in [
        ("t,x1,y1,x2\n1,2,3,4\n", "run.csv: ball 2 has a column \"x2\", but none for its y"),
        ("t,x1,y1,z1,x2,y2\n1,2,3,4,5,6\n", "ball 2 has a column \"x2\", but none for its z"),
        ("t,red_y,x1,y1\n1,2,3,4\n", "ball red has a column \"red_y\", but none for its x"),
        ("t,x1,y1,X1\n1,2,3,4\n", "the column \"X1\" is there twice: x of ball 1"),
        ("t,x1,y1,x2,y2\n1,2,3,4,oops\n", "run.csv:2: \"oops\" is no number, in column 5"),
        ("t,x1,y1,x2,y2\n1,2,3,4,\n", "run.csv:2: \"\" is no number, in column 5"),
        ("t,x1,y1,x2,y2\n1,2,3\n", "run.csv:2: 3 fields where the first line has 5"),
        ("x1,y1,x2,y2\n1,2,3,4\n", "no column \"t\" for the time"),
        ("t,ball,x1,y1\n1,2,3,4\n", "no column \"x\" for the position"),
        ("t,x_cm,y_cm\n1,2,3\n", "no column \"x\" for the position"),
        ("t,y\n0.02,1\n", "no column \"x\" for the position; the columns are t, y"),
        ("", "run.csv: is empty"),
    ] {
        let error = refusal(text.as_bytes());
        assert!(error.contains(expected), "{text}: {error}");
    }
}

#[test]
fn columns_of_ones_own_make_sense_or_are_refused() {
    assert!("t=time, y=height".parse::<Columns>().is_ok());
    for (text, expected) in [
        ("time", "there is no ="),
        ("time=t", "names no quantity"),
        ("t=a,t=b", "t is there twice"),
    ] {
        let error = text.parse::<Columns>().unwrap_err().to_string();
        assert!(error.contains(expected), "{text}: {error}");
    }
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let error = Recorded::read(Path::new("nowhere.csv"), &Reading::default()).unwrap_err();
    assert!(error.to_string().starts_with("cannot read nowhere.csv: "), "{error}");
}
