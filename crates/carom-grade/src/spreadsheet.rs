//! Reads the cells of spreadsheets (.xlsx).

use std::io::{Cursor, Read};

use calamine::{DataRef, Reader, Xlsx, XlsxError};

/// Most bytes of all parts of a spreadsheet, unpacked.
const MOST_UNPACKED: u64 = 64 << 20;

/// Most parts of a spreadsheet.
const MOST_PARTS: usize = 1_000;

/// Most columns of a sheet that are read.
const MOST_COLUMNS: u32 = 256;

/// Most bytes of text in the cells of a sheet.
const MOST_TEXT: usize = 64 << 20;

/// Rows of a sheet, each with its number from 1.
pub(crate) type Sheet = Vec<(u64, csv::StringRecord)>;

/// Reads all sheets of a spreadsheet.
///
/// # Errors
/// What is wrong with it, as the end of a sentence about the file.
pub(crate) fn sheets(bytes: &[u8]) -> Result<Vec<Sheet>, String> {
    check_sizes(bytes)?;
    let broken = |error: XlsxError| format!("is no spreadsheet that can be read: {error}");
    let mut book: Xlsx<_> = Xlsx::new(Cursor::new(bytes)).map_err(broken)?;
    book.sheet_names().into_iter().map(|name| sheet(&mut book, &name)).collect()
}

/// Unpacks all parts once, because the sizes that the archive states may be wrong.
fn check_sizes(bytes: &[u8]) -> Result<(), String> {
    let broken = |error: &dyn std::fmt::Display| format!("is a broken spreadsheet: {error}");
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).map_err(|it| broken(&it))?;
    if archive.len() > MOST_PARTS {
        return Err(format!("is a spreadsheet of more than {MOST_PARTS} parts"));
    }
    let mut left = MOST_UNPACKED;
    for number in 0..archive.len() {
        let part = archive.by_index(number).map_err(|it| broken(&it))?;
        let size = std::io::copy(&mut part.take(left + 1), &mut std::io::sink());
        left = left
            .checked_sub(size.map_err(|it| broken(&it))?)
            .ok_or("is a spreadsheet of more than 64 MiB")?;
    }
    Ok(())
}

/// Reads the cells of a sheet one by one: a sheet of two distant cells has no cells between them.
fn sheet(book: &mut Xlsx<Cursor<&[u8]>>, name: &str) -> Result<Sheet, String> {
    let broken = |error: XlsxError| format!("has a sheet that cannot be read: {error}");
    let mut cells = match book.worksheet_cells_reader(name) {
        Ok(cells) => cells,
        // A sheet of charts has no cells.
        Err(XlsxError::WorksheetNotFound(_) | XlsxError::NotAWorksheet(_)) => return Ok(Vec::new()),
        Err(error) => return Err(broken(error)),
    };
    let (mut rows, mut fields) = (Sheet::new(), Vec::<String>::new());
    let (mut current, mut size) = (None, 0);
    while let Some(cell) = cells.next_cell().map_err(broken)? {
        let (row, column) = cell.get_position();
        if current != Some(row) {
            rows.extend(current.map(|row| record(row, &mut fields)));
            current = Some(row);
        }
        let text = text(cell.get_value());
        if column >= MOST_COLUMNS || text.is_empty() {
            continue;
        }
        size += text.len() + fields.len().abs_diff(column as usize);
        if size > MOST_TEXT {
            return Err("is a spreadsheet of more than 64 MiB of text".to_owned());
        }
        fields.resize(fields.len().max(column as usize + 1), String::new());
        fields[column as usize] = text;
    }
    rows.extend(current.map(|row| record(row, &mut fields)));
    Ok(rows)
}

/// Takes the fields of a row.
fn record(row: u32, fields: &mut Vec<String>) -> (u64, csv::StringRecord) {
    (u64::from(row) + 1, csv::StringRecord::from(std::mem::take(fields)))
}

fn text(value: &DataRef) -> String {
    match value {
        DataRef::Empty => String::new(),
        DataRef::Int(value) => value.to_string(),
        DataRef::Float(value) => value.to_string(),
        DataRef::String(value) => value.clone(),
        DataRef::SharedString(value) => (*value).to_owned(),
        DataRef::Bool(value) => value.to_string(),
        DataRef::DateTime(value) => value.as_f64().to_string(),
        DataRef::DateTimeIso(value) | DataRef::DurationIso(value) => value.clone(),
        DataRef::Error(value) => value.to_string(),
    }
}
