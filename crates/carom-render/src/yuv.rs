//! Converts sRGB to the colours of films: brightness, and colour at half the resolution.

use openh264::formats::YUVSource;

use crate::picture::Picture;

/// Weights of red and blue in the brightness: ITU-R BT.709-6, item 3.2.
const RED: f64 = 0.2126;
const BLUE: f64 = 0.0722;
const GREEN: f64 = 1.0 - RED - BLUE;

/// Fraction bits of the weights: their error is far below a level.
const BITS: u32 = 16;
const fn fixed(weight: f64) -> i32 {
    let scaled = weight * (1 << BITS) as f64;
    (if weight < 0.0 { scaled - 0.5 } else { scaled + 0.5 }) as i32
}

/// Steps from black to white, and from the least to the most colour, for the 255 steps of a picture
/// (limited range, ITU-R BT.709-6, item 5.6).
const LUMA: f64 = 219.0 / 255.0;
const CHROMA: f64 = 224.0 / 255.0;
const Y: [i32; 3] = [fixed(RED * LUMA), fixed(GREEN * LUMA), fixed(BLUE * LUMA)];
const CB: [i32; 3] = chroma([-RED, -GREEN, 1.0 - BLUE], BLUE);
const CR: [i32; 3] = chroma([1.0 - RED, -GREEN, -BLUE], RED);

/// Returns the weights of a colour difference: colour minus brightness. `share` is the weight of
/// that colour in the brightness.
const fn chroma(difference: [f64; 3], share: f64) -> [i32; 3] {
    let scale = CHROMA / (2.0 * (1.0 - share));
    [fixed(difference[0] * scale), fixed(difference[1] * scale), fixed(difference[2] * scale)]
}

/// A picture as Y'CbCr 4:2:0, BT.709, limited range. Colour values lie on the left of their two
/// columns and between their two rows, as decoders of H.264 assume.
pub(crate) struct Planes {
    width: usize,
    height: usize,
    y: Vec<u8>,
    cb: Vec<u8>,
    cr: Vec<u8>,
}

impl Planes {
    /// Returns a black picture; width and height are even.
    pub fn new(width: u32, height: u32) -> Self {
        let [width, height] = [width as usize, height as usize];
        let quarter = vec![128; width * height / 4];
        Self { width, height, y: vec![16; width * height], cb: quarter.clone(), cr: quarter }
    }

    /// Converts a picture of the same size; its opacity is ignored.
    pub fn read(&mut self, picture: &Picture) {
        for (pixel, y) in picture.pixels.chunks_exact(4).zip(&mut self.y) {
            *y = weigh(&Y, [pixel[0], pixel[1], pixel[2]].map(i32::from), 16, BITS);
        }
        let rows = picture.pixels.chunks_exact(4 * 2 * self.width);
        let cb = self.cb.chunks_exact_mut(self.width / 2);
        let cr = self.cr.chunks_exact_mut(self.width / 2);
        for ((rows, cb), cr) in rows.zip(cb).zip(cr) {
            let (upper, lower) = rows.split_at(4 * self.width);
            read_colors(upper, lower, cb, cr);
        }
    }
}

/// Computes the colours of two rows of pixels.
fn read_colors(upper: &[u8], lower: &[u8], cb: &mut [u8], cr: &mut [u8]) {
    let column = |x: usize| {
        [0, 1, 2].map(|part| i32::from(upper[4 * x + part]) + i32::from(lower[4 * x + part]))
    };
    // A mean over three columns with the weights 1, 2, 1, and two rows: the weights sum to 8.
    let mut left = column(0);
    for (i, (cb, cr)) in cb.iter_mut().zip(cr).enumerate() {
        let (middle, right) = (column(2 * i), column(2 * i + 1));
        let sum = [0, 1, 2].map(|part| left[part] + 2 * middle[part] + right[part]);
        *cb = weigh(&CB, sum, 128, BITS + 3);
        *cr = weigh(&CR, sum, 128, BITS + 3);
        left = right;
    }
}

/// Returns `offset` plus the weighted sum of the parts, rounded; the weights have `bits` fraction
/// bits.
fn weigh(weights: &[i32; 3], parts: [i32; 3], offset: i32, bits: u32) -> u8 {
    let sum: i32 = weights.iter().zip(parts).map(|(weight, part)| weight * part).sum();
    (offset + ((sum + (1 << (bits - 1))) >> bits)) as u8
}

impl YUVSource for Planes {
    fn dimensions(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    fn strides(&self) -> (usize, usize, usize) {
        (self.width, self.width / 2, self.width / 2)
    }

    fn y(&self) -> &[u8] {
        &self.y
    }

    fn u(&self) -> &[u8] {
        &self.cb
    }

    fn v(&self) -> &[u8] {
        &self.cr
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_plain([r, g, b]: [u8; 3]) -> [u8; 3] {
        let mut planes = Planes::new(6, 4);
        planes.read(&Picture { width: 6, height: 4, pixels: [r, g, b, 255].repeat(24) });
        for plane in [&planes.y, &planes.cb, &planes.cr] {
            assert!(plane.iter().all(|value| *value == plane[0]), "plain stays plain");
        }
        [planes.y[0], planes.cb[0], planes.cr[0]]
    }

    /// Values of the 75 % and 100 % colour bars of BT.709, as in SMPTE RP 219.
    #[test]
    fn colour_bars_have_their_standard_values() {
        assert_eq!(of_plain([0, 0, 0]), [16, 128, 128]);
        assert_eq!(of_plain([255, 255, 255]), [235, 128, 128]);
        assert_eq!(of_plain([191, 191, 0]), [168, 44, 136]);
        assert_eq!(of_plain([255, 0, 0]), [63, 102, 240]);
        assert_eq!(of_plain([0, 255, 0]), [173, 42, 26]);
        assert_eq!(of_plain([0, 0, 255]), [32, 240, 118]);
    }

    #[test]
    fn an_edge_of_colour_stays_where_it_is() {
        // Red begins at column 4. The colour of columns 4 and 5 lies on column 4, and takes a
        // quarter from column 3.
        let (grey, red) = ([77_u8, 77, 77, 255], [255, 0, 0, 255]);
        let row = [grey, grey, grey, grey, red, red, red, red].concat();
        let mut planes = Planes::new(8, 2);
        planes.read(&Picture { width: 8, height: 2, pixels: row.repeat(2) });
        let three_quarters = (240 - 128) / 4 * 3;
        assert_eq!(planes.cr, [128, 128, 128 + three_quarters, 240]);
    }
}
