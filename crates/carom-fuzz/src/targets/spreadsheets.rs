//! Students' runs in spreadsheets.

use std::io::{Cursor, Write};
use std::path::Path;

use carom_grade::{Reading, Recorded};
use proptest::prelude::*;
use zip::write::SimpleFileOptions;

use crate::fault::{Fault, check_error};
use crate::mutation::mutated;
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "spreadsheets",
    about: "spreadsheets to be graded whose sheet has a few things wrong",
    campaign: 2_000,
    cases: || {
        let balls = sheet(["x1", "y1", "x2", "y2"]);
        mutated(vec![sheet(["ball", "x", "y", "z"]), balls]).boxed()
    },
    check,
};

const KIND: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
const MAIN: &str = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
const PACKAGE: &str = "http://schemas.openxmlformats.org/package/2006/relationships";

/// Returns the sheet of a short run; these are the names of its columns after the time.
fn sheet(names: [&str; 4]) -> Vec<u8> {
    let name = |it: &str| format!("<c t=\"inlineStr\"><is><t>{it}</t></is></c>");
    let names: String = std::iter::once("t").chain(names).map(name).collect();
    let mut rows = format!("<row r=\"1\">{names}</row>");
    for frame in 1..6 {
        let number = |column: &str, value: f64| {
            let row = frame + 1;
            format!("<c r=\"{column}{row}\"><v>{value}</v></c>")
        };
        let time = 0.02 * f64::from(frame);
        let cells = [("A", time), ("B", 0.0), ("C", 0.64), ("D", 12.2 - time), ("E", 0.0)];
        let cells = cells.map(|(column, value)| number(column, value)).concat();
        rows += &format!("<row r=\"{}\">{cells}</row>", frame + 1);
    }
    format!("<worksheet xmlns=\"{MAIN}\"><sheetData>{rows}</sheetData></worksheet>").into_bytes()
}

/// Packs a sheet into a spreadsheet.
fn packed(sheet: &[u8]) -> Result<Vec<u8>, zip::result::ZipError> {
    let relation = |kind: &str, target: &str| {
        format!(
            "<Relationships xmlns=\"{PACKAGE}\">\
             <Relationship Id=\"r1\" Type=\"{KIND}/{kind}\" Target=\"{target}\"/></Relationships>"
        )
    };
    let book = format!(
        "<workbook xmlns=\"{MAIN}\" xmlns:r=\"{KIND}\"><sheets>\
         <sheet name=\"run\" sheetId=\"1\" r:id=\"r1\"/></sheets></workbook>"
    );
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in [
        ("_rels/.rels", relation("officeDocument", "xl/workbook.xml").as_bytes()),
        ("xl/workbook.xml", book.as_bytes()),
        ("xl/_rels/workbook.xml.rels", relation("worksheet", "worksheets/sheet1.xml").as_bytes()),
        ("xl/worksheets/sheet1.xml", sheet),
    ] {
        archive.start_file(name, SimpleFileOptions::default())?;
        archive.write_all(text)?;
    }
    Ok(archive.finish()?.into_inner())
}

fn check(case: &[u8]) -> Result<Answer, Fault> {
    let failed = |it: zip::result::ZipError| Fault::Law(format!("cannot be tried: {it}"));
    let book = packed(case).map_err(failed)?;
    match Recorded::parse(Path::new("run.xlsx"), &book, &Reading::default()) {
        Ok(_) => Ok(Answer::Accepted),
        Err(error) => check_error(&error.to_string()).map(|()| Answer::Refused),
    }
}
