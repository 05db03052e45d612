//! Converts colours between sRGB in scenes and linear values in glTF.

/// Converts from sRGB to linear (IEC 61966-2-1).
pub(crate) fn linear(part: f64) -> f64 {
    if part <= 0.04045 { part / 12.92 } else { libm::pow((part + 0.055) / 1.055, 2.4) }
}

/// Converts from linear to sRGB, limited to \[0, 1\].
pub(crate) fn srgb(part: f64) -> f64 {
    let part = part.clamp(0.0, 1.0);
    if part <= 0.003_130_8 { 12.92 * part } else { 1.055 * libm::pow(part, 1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_come_back_from_linear_ones() {
        for part in [0.0, 0.01, 0.04045, 0.2, 0.5, 1.0] {
            // The two pieces of the curve agree only to 1e-8, by definition.
            assert!((srgb(linear(part)) - part).abs() < 1e-7, "{part}");
        }
    }
}
