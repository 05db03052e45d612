//! A picture in memory.

/// A picture: 8 bits each of red, green, blue (sRGB) and opacity, row by row from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Pixels of a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `4 width height` bytes.
    pub pixels: Vec<u8>,
}
