//! Tables as other programs write them, and files that are none.

#[path = "common/planting.rs"]
mod planting;
#[path = "common/simulator.rs"]
mod simulator;

use std::io::Write;
use std::path::Path;

use carom_grade::{Course, Grader, Reading, Recorded, TOLERANCE, Verdict};
use carom_scene::recording::Trajectory;
use planting::{said, scene};
use simulator::{Plan, Row, simulate};

/// The first ball of SimTest3.
fn ball() -> Vec<Row> {
    let rows = simulate(&scene("simtest3"), &Plan::default(), 4.0);
    rows.into_iter().filter(|row| row.ball == 0).collect()
}

fn graded(bytes: &[u8]) -> Verdict {
    let recorded = Recorded::parse(Path::new("run.csv"), bytes, &Reading::default());
    let mut grader = Grader::new(Course::of(&scene("simtest3")).unwrap(), TOLERANCE);
    grader.grade(&recorded.unwrap_or_else(|error| panic!("{error}"))).verdict
}

/// Checks that a text is read as the right run.
fn passes(text: &str) {
    let verdict = graded(text.as_bytes());
    assert!(verdict.same, "{}\n{text:.300}", said(&verdict));
}

fn lines(row: impl Fn(&Row) -> String) -> String {
    ball().iter().map(|it| row(it) + "\n").collect()
}

#[test]
fn particle_files_of_a_run_are_graded_as_its_table() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene("simtest1");
    let course = || Course::of(&scene).unwrap();
    for ending in ["csv", "xyz", "lammpstrj", "gsd"] {
        let path = folder.path().join("run").with_extension(ending);
        let mut world = scene.world().unwrap();
        let mut trajectory = Trajectory::create(&path).unwrap();
        for _ in 0..200 {
            world.step(scene.simulation.frame_time).unwrap();
            trajectory.write(&world).unwrap();
        }
        trajectory.finish().unwrap();
        let recorded = Recorded::read(&path, &Reading::default()).unwrap();
        let verdict = Grader::new(course(), TOLERANCE).grade(&recorded).verdict;
        assert!(verdict.same, "{ending}: {}", said(&verdict));
    }
    let path = folder.path().join("bare.xyz");
    std::fs::write(&path, "1\n\nX 0 0 0\n").unwrap();
    let refused = Recorded::read(&path, &Reading::default()).unwrap_err().to_string();
    assert!(refused.ends_with("bare.xyz: frame 0 has no time"), "{refused}");
    std::fs::write(&path, "1\n\nX 0 0 no\n").unwrap();
    let refused = Recorded::read(&path, &Reading::default()).unwrap_err().to_string();
    assert!(refused.contains("bare.xyz:3: column 4 is no finite number"), "{refused}");
}

#[test]
fn tables_of_tracker_have_the_name_of_the_mass_first_and_two_coordinates() {
    let rows = lines(|it| format!("{:E}\t{:E}\t{:E}", it.time, it.position[0], it.position[1]));
    let verdict = graded(format!("mass_A\t\t\nt\tx\ty\n{rows}").as_bytes());
    assert!(verdict.same, "{}", said(&verdict));
    assert!(verdict.notes.iter().any(|it| it.contains("no z")), "{:?}", verdict.notes);
}

#[test]
fn tables_of_logger_pro_have_the_run_and_the_unit_in_the_heading() {
    let rows = lines(|it| {
        let [x, y, z] = it.position.map(|it| 100.0 * it);
        format!("{},{x},{y},{z}", it.time)
    });
    let heading = "\"Latest: Time (s)\",\"Latest: X (cm)\",\"Latest: Y (cm)\",\"Latest: Z (cm)\"";
    passes(&format!("{heading}\n{rows}"));
}

#[test]
fn tables_of_vernier_have_lines_before_the_heading_and_a_line_of_units() {
    let rows = lines(|it| {
        let [x, y, z] = it.position;
        format!("{}\t{x}\t{y}\t{z}", 1e3 * it.time)
    });
    passes(&format!(
        "Vernier Format 2\nball.cmbl 5/4/2026\nRun 1\nTime\tX\tY\tZ\nms\tm\tm\tm\n\n{rows}"
    ));
}

#[test]
fn german_tables_have_decimal_commas() {
    let number = |value: f64| value.to_string().replace('.', ",");
    let rows = lines(|it| {
        let [x, y, z] = it.position.map(number);
        format!("{};0;{x};{y};{z}", number(it.time))
    });
    passes(&format!("Höhenmessung\nZeit;Ball;x;y;z\n{rows}"));
}

/// Name of a column, from its axis and its ball.
type Named<'a> = &'a dyn Fn(&str, usize) -> String;

/// A table of SimTest3 with a line for each time and three columns for each ball, named by `column`.
fn wide(column: impl Fn(&str, usize) -> String, unit: f64) -> String {
    let rows = simulate(&scene("simtest3"), &Plan::default(), 4.0);
    let balls = 1 + rows.iter().map(|row| row.ball).max().unwrap();
    let names = (0..balls).flat_map(|ball| ["x", "y", "z"].map(|axis| column(axis, ball)));
    let mut text = format!("t,{}\n", names.collect::<Vec<_>>().join(","));
    for frame in rows.chunk_by(|a, b| a.frame == b.frame) {
        let cells = (0..balls).flat_map(|ball| {
            let row = frame.iter().find(|row| row.ball == ball);
            // A ball that is not there yet has no place.
            row.map_or([const { String::new() }; 3], |row| {
                row.position.map(|it| (it / unit).to_string())
            })
        });
        let cells: Vec<String> = cells.collect();
        text += &format!("{},{}\n", frame[0].time, cells.join(","));
    }
    text
}

#[test]
fn several_balls_side_by_side_are_all_read() {
    let colours = ["red", "green", "blue", "white", "black", "grey", "pink"];
    let names: [Named; 4] = [
        &|axis, ball| format!("{axis}{}", ball + 1),
        &|axis, ball| format!("Ball {ball} {axis}"),
        &|axis, ball| format!("{}_{axis}", colours[ball]),
        &|axis, ball| format!("pos_{axis}.{ball}"),
    ];
    for name in names {
        let verdict = graded(wide(name, 1.0).as_bytes());
        assert!(verdict.same && verdict.balls > 4, "{}", said(&verdict));
        assert!(!verdict.notes.iter().any(|it| it.contains("not in the table")), "{verdict:?}");
    }
    let verdict = graded(wide(|axis, ball| format!("{axis}{ball} (cm)"), 0.01).as_bytes());
    assert!(verdict.same && verdict.form.is_empty(), "{}", said(&verdict));
    // The last ball moved by a millimetre.
    let wrong = wide(|axis, ball| format!("{axis}{ball}"), 1.0);
    let last = wrong.trim_end().rsplit_once(',').unwrap();
    let moved = last.1.parse::<f64>().unwrap() + 1e-3;
    let verdict = graded(format!("{},{moved}\n", last.0).as_bytes());
    let departure = verdict.departure.unwrap();
    assert_eq!(departure.ball, (verdict.balls - 1).to_string());
}

#[test]
fn two_coordinates_of_several_balls_are_read() {
    let text = wide(|axis, ball| format!("{axis}{ball}"), 1.0);
    let is_seen = |place: usize| place == 0 || !place.is_multiple_of(3);
    let kept = |line: &str| {
        let cells = line.split(',').enumerate().filter(|it| is_seen(it.0)).map(|it| it.1);
        cells.collect::<Vec<_>>().join(",") + "\n"
    };
    let verdict = graded(text.lines().map(kept).collect::<String>().as_bytes());
    assert!(verdict.same && verdict.balls > 4, "{}", said(&verdict));
    assert!(verdict.notes.iter().any(|it| it.contains("no z")), "{:?}", verdict.notes);
}

#[test]
fn latin_1_and_utf_16_are_read() {
    let rows = lines(|it| {
        let [x, y, z] = it.position;
        format!("{},Größe,{x},{y},{z}", it.time)
    });
    let text = format!("t,ball,x,y,z\n{rows}");
    let latin: Vec<u8> = text.chars().map(|it| it as u8).collect();
    assert!(graded(&latin).same);
    let units: Vec<u16> = text.encode_utf16().collect();
    let little: Vec<u8> = units.iter().flat_map(|it| it.to_le_bytes()).collect();
    assert!(graded(&little).same);
    let marked: Vec<u8> = [0xfeff].iter().chain(&units).flat_map(|it| it.to_be_bytes()).collect();
    assert!(graded(&marked).same);
}

/// A spreadsheet whose sheet has these rows.
fn spreadsheet(rows: &str) -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let kind = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    let main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
    let sheet_type = "application/vnd.openxmlformats-officedocument.spreadsheetml.worksheet+xml";
    let book_type = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet.main+xml";
    let parts = [
        (
            "[Content_Types].xml",
            format!(
                "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\
                 <Override PartName=\"/xl/workbook.xml\" ContentType=\"{book_type}\"/>\
                 <Override PartName=\"/xl/worksheets/sheet1.xml\" ContentType=\"{sheet_type}\"/></Types>"
            ),
        ),
        (
            "_rels/.rels",
            format!(
                "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\
                 <Relationship Id=\"r1\" Type=\"{kind}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/workbook.xml",
            format!(
                "<workbook xmlns=\"{main}\" xmlns:r=\"{kind}\"><sheets>\
                 <sheet name=\"run\" sheetId=\"1\" r:id=\"r1\"/></sheets></workbook>"
            ),
        ),
        (
            "xl/_rels/workbook.xml.rels",
            format!(
                "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\
                 <Relationship Id=\"r1\" Type=\"{kind}/worksheet\" Target=\"worksheets/sheet1.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/worksheets/sheet1.xml",
            format!("<worksheet xmlns=\"{main}\"><sheetData>{rows}</sheetData></worksheet>"),
        ),
    ];
    let stored = zip::write::SimpleFileOptions::default();
    let stored = stored.compression_method(zip::CompressionMethod::Stored);
    for (name, text) in parts {
        archive.start_file(name, stored).unwrap();
        archive.write_all(text.as_bytes()).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

#[test]
fn spreadsheets_are_read() {
    let names =
        ["t", "x", "y", "z"].map(|it| format!("<c t=\"inlineStr\"><is><t>{it}</t></is></c>"));
    let mut rows = format!("<row>{}</row>", names.concat());
    for row in ball() {
        let [x, y, z] = row.position;
        let cells = [row.time, x, y, z].map(|it| format!("<c><v>{it}</v></c>"));
        rows += &format!("<row>{}</row>", cells.concat());
    }
    let verdict = graded(&spreadsheet(&rows));
    assert!(verdict.same, "{}", said(&verdict));
}

fn refusal(bytes: &[u8]) -> String {
    Recorded::parse(Path::new("run.csv"), bytes, &Reading::default()).unwrap_err().to_string()
}

#[test]
fn two_distant_cells_take_no_room() {
    let cell = |place: &str| format!("<c r=\"{place}\"><v>1</v></c>");
    let rows =
        format!("<row r=\"1\">{}</row><row r=\"1048576\">{}</row>", cell("A1"), cell("XFD1048576"));
    assert!(refusal(&spreadsheet(&rows)).contains("no column"));
}

#[test]
fn a_spreadsheet_that_unpacks_to_much_is_refused() {
    let error = refusal(&spreadsheet(&" ".repeat(65 << 20)));
    assert!(error.contains("more than 64 MiB"), "{error}");
}

#[test]
fn files_that_are_no_tables_are_named() {
    for (bytes, expected) in [
        (&b"%PDF-1.7\n"[..], "is a PDF document"),
        (b"\xff\xd8\xff\xe0\0\x10JFIF", "is a photo"),
        (b"\x89PNG\r\n\x1a\n", "is a picture"),
        (b"\0\0\0\x20ftypisom", "is a film"),
        (b"<!DOCTYPE html><html>", "is a web page"),
        (b"<?xml version=\"1.0\"?><document>", "export the table as CSV"),
        (b"PK\x03\x04 and no more", "is a broken spreadsheet"),
    ] {
        let error = refusal(bytes);
        assert!(error.starts_with("run.csv: ") && error.contains(expected), "{error}");
    }
}
