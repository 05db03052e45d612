//! Parses numbers of tables, which programs in any language may have written.

/// Parses a finite number with a decimal point or comma.
pub fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    let value: f64 = match text.parse() {
        Ok(value) => value,
        Err(_) => text.replacen(',', ".", 1).parse().ok()?,
    };
    value.is_finite().then_some(value)
}

/// Number of decimals; negative if the last digit stands for tens or more.
pub fn decimals(text: &str) -> i32 {
    let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let decimals = digits.split_once(['.', ',']).map_or(0, |(_, decimals)| decimals.trim().len());
    // Further digits are below the rounding error of any position.
    (decimals as i32 - exponent.parse::<i32>().unwrap_or(0)).clamp(-9, 17)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_and_commas_are_read_and_what_is_not_finite_is_refused() {
        assert_eq!(number(" 1.5 "), Some(1.5));
        assert_eq!(number("1,5"), Some(1.5));
        assert_eq!(number("-2E-3"), Some(-0.002));
        for wrong in ["", "x", "NaN", "inf", "1,5,2", "1e999"] {
            assert_eq!(number(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn decimals_are_counted_with_the_exponent() {
        assert_eq!(["1.25", "1,250", "3", "1.25e-2", "1.2500e2"].map(decimals), [2, 3, 0, 4, 2]);
    }
}
