//! A picture in memory, and as a PNG file.

#[cfg(not(target_arch = "wasm32"))]
use std::io::{self, Write};
#[cfg(not(target_arch = "wasm32"))]
use std::path::{Path, PathBuf};

use thiserror::Error;

#[cfg(not(target_arch = "wasm32"))]
use crate::new_file::NewFile;

/// Why a picture could not be written or read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The size does not match the number of bytes.
    #[error("a picture of {width} x {height} pixels cannot consist of {bytes} bytes")]
    Size {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Bytes of the pixels.
        bytes: usize,
    },
    /// The picture cannot be encoded as PNG.
    #[error("cannot encode the picture as PNG: {0}")]
    Encode(#[source] png::EncodingError),
    /// The file is not a PNG, or is damaged.
    #[error("cannot read the picture as PNG: {0}")]
    Decode(#[from] png::DecodingError),
    /// The file cannot be written.
    #[cfg(not(target_arch = "wasm32"))]
    #[error("cannot write {path}: {source}")]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
}

/// A picture: 8 bits each of red, green, blue (sRGB) and opacity, in rows from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// `4 width height` bytes; colours are not multiplied by the opacity.
    pub pixels: Vec<u8>,
}

impl Picture {
    /// Joins pictures from left to right. Rows below the height of the lowest picture are cut off.
    pub fn side_by_side(pictures: &[Self]) -> Self {
        let height = pictures.iter().map(|picture| picture.height).min().unwrap_or_default();
        let width = pictures.iter().map(|picture| picture.width).sum();
        let mut pixels = Vec::with_capacity(4 * width as usize * height as usize);
        for row in 0..height as usize {
            for picture in pictures {
                let line = 4 * picture.width as usize;
                pixels.extend(picture.pixels.iter().skip(row * line).take(line));
            }
        }
        Self { width, height, pixels }
    }

    /// Encodes the picture as a PNG file, marked as sRGB.
    ///
    /// # Errors
    /// If there are no pixels, or if their number does not match the size.
    pub fn to_png(&self) -> Result<Vec<u8>, PictureError> {
        self.check_size()?;
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header().map_err(PictureError::Encode)?;
        writer.write_image_data(&self.pixels).map_err(PictureError::Encode)?;
        writer.finish().map_err(PictureError::Encode)?;
        Ok(file)
    }

    /// Decodes a PNG file. A picture without opacity becomes opaque; 16 bits become 8.
    ///
    /// # Errors
    /// If the file is not a PNG, is incomplete, or would take too much memory.
    pub fn from_png(file: &[u8]) -> Result<Self, PictureError> {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(file));
        let transformations = png::Transformations::normalize_to_color8();
        decoder.set_transformations(transformations | png::Transformations::ALPHA);
        let mut reader = decoder.read_info()?;
        let size = reader.output_buffer_size().ok_or(png::DecodingError::LimitsExceeded)?;
        let mut bytes = vec![0; size];
        let info = reader.next_frame(&mut bytes)?;
        bytes.truncate(info.buffer_size());
        let pixels = match info.color_type {
            png::ColorType::GrayscaleAlpha => bytes
                .chunks_exact(2)
                .flat_map(|pixel| [pixel[0], pixel[0], pixel[0], pixel[1]])
                .collect(),
            _ => bytes,
        };
        let picture = Self { width: info.width, height: info.height, pixels };
        picture.check_size()?;
        Ok(picture)
    }

    /// Writes the picture to a PNG file and creates missing folders. The file gets its name when it
    /// is complete; on an error a file that was there before is unchanged.
    ///
    /// # Errors
    /// As [`Self::to_png`], and [`PictureError::Unwritable`] for a path that cannot be written or a
    /// full disk.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn save_png(&self, path: impl AsRef<Path>) -> Result<(), PictureError> {
        let content = self.to_png()?;
        let path = path.as_ref();
        let write = || {
            let mut file = NewFile::create(path)?;
            file.write_all(&content)?;
            file.complete()
        };
        write().map_err(|source| PictureError::Unwritable { path: path.to_owned(), source })
    }

    pub(crate) fn check_size(&self) -> Result<(), PictureError> {
        let Self { width, height, ref pixels } = *self;
        let bytes = 4 * u128::from(width) * u128::from(height);
        if bytes == 0 || bytes != pixels.len() as u128 {
            return Err(PictureError::Size { width, height, bytes: pixels.len() });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture in which all pixels of a row differ.
    fn gradient(width: u32, height: u32) -> Picture {
        let pixels = (0..width * height).flat_map(|i| {
            let (x, y) = (i % width, i / width);
            [x as u8, y as u8, (x * y) as u8, 255 - x as u8]
        });
        Picture { width, height, pixels: pixels.collect() }
    }

    #[test]
    fn a_picture_comes_back_from_its_png() {
        for picture in [gradient(1, 1), gradient(37, 5), gradient(200, 120)] {
            assert_eq!(Picture::from_png(&picture.to_png().unwrap()).unwrap(), picture);
        }
    }

    #[test]
    fn a_grey_png_becomes_an_opaque_picture() {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, 2, 1);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.write_header().unwrap().write_image_data(&[7, 200]).unwrap();
        let picture = Picture::from_png(&file).unwrap();
        assert_eq!(picture.pixels, [7, 7, 7, 255, 200, 200, 200, 255]);
    }

    #[test]
    fn missing_folders_are_made() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("output/frames/0001.png");
        let picture = gradient(8, 4);
        picture.save_png(&path).unwrap();
        assert_eq!(Picture::from_png(&std::fs::read(&path).unwrap()).unwrap(), picture);
    }

    #[test]
    fn a_failed_save_names_the_file_and_why() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("file"), "").unwrap();
        let path = folder.path().join("file/picture.png");
        let error = gradient(2, 2).save_png(&path).unwrap_err().to_string();
        assert!(error.starts_with(&format!("cannot write {}: ", path.display())), "{error}");
        let error = gradient(2, 2).save_png(folder.path()).unwrap_err().to_string();
        assert!(error.contains("directory"), "{error}");
    }

    /// `/dev/full` is a full disk on Linux.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_told() {
        let error = gradient(2, 2).save_png("/dev/full").unwrap_err().to_string();
        assert!(error.contains("No space left"), "{error}");
    }

    #[test]
    fn pixels_that_do_not_fit_the_size_are_refused() {
        let wrong = Picture { width: 2, height: 2, pixels: vec![0; 15] };
        assert!(matches!(wrong.to_png(), Err(PictureError::Size { bytes: 15, .. })));
        let empty = Picture { width: 0, height: 0, pixels: Vec::new() };
        assert!(matches!(empty.to_png(), Err(PictureError::Size { .. })));
        let huge = Picture { width: u32::MAX, height: u32::MAX, pixels: Vec::new() };
        assert!(matches!(huge.to_png(), Err(PictureError::Size { .. })));
    }

    #[test]
    fn what_is_no_png_is_refused() {
        let file = gradient(30, 30).to_png().unwrap();
        assert!(Picture::from_png(b"GIF89a").is_err());
        assert!(Picture::from_png(&file[..file.len() / 2]).is_err());
    }
}
