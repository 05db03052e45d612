//! Archives of arrays for NumPy (NPZ).

use std::io::{self, BufWriter, Seek, Write};

use npyz::WriterBuilder;
use zip::result::ZipError;
use zip::write::SimpleFileOptions;

use super::failing_once::FailingOnce;

/// An archive that grows array by array.
pub(super) type Zip<W> = zip::ZipWriter<FailingOnce<BufWriter<W>>>;

/// Writes an archive; `write` adds its arrays.
pub(super) fn archive<W: Write + Seek>(
    file: W,
    write: impl FnOnce(&mut Zip<W>) -> io::Result<()>,
) -> io::Result<()> {
    let mut zip = zip::ZipWriter::new(FailingOnce::new(BufWriter::new(file)));
    let written = write(&mut zip).and_then(|()| zip.finish()?.flush());
    written.map_err(|error| {
        let of_zip = error.get_ref().and_then(|it| it.downcast_ref::<ZipError>());
        match of_zip {
            // The disk failed, not the format of the archive.
            Some(ZipError::Io(inner)) => io::Error::new(inner.kind(), inner.to_string()),
            _ => error,
        }
    })
}

/// Starts an array in the archive and returns a writer for its values.
pub(super) fn begin<'a, T: npyz::AutoSerialize, W: Write + Seek>(
    zip: &'a mut Zip<W>,
    name: &str,
    shape: &[u64],
) -> io::Result<npyz::NpyWriter<T, &'a mut Zip<W>>> {
    let options = SimpleFileOptions::default().large_file(true);
    zip.start_file(npyz::npz::file_name_from_array_name(name), options)?;
    npyz::WriteOptions::new().default_dtype().shape(shape).writer(zip).begin_nd()
}

/// Writes an array with these values.
pub(super) fn append_all<T: npyz::AutoSerialize, W: Write + Seek>(
    zip: &mut Zip<W>,
    name: &str,
    values: impl ExactSizeIterator<Item = T>,
) -> io::Result<()> {
    let mut array = begin(zip, name, &[values.len() as u64])?;
    array.extend(values)?;
    array.finish()
}
