//! Round numbers along an axis.

/// Round numbers along an axis, at equal steps.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Marks {
    /// The numbers, ascending.
    pub values: Vec<f64>,
    /// Distance between two marks.
    pub step: f64,
}

impl Marks {
    /// Returns the marks between two numbers: at least two, and few enough for their labels; none
    /// if the range is empty or not finite.
    pub fn between(min: f64, max: f64) -> Self {
        const PARTS: f64 = 4.0;
        let found = round_numbers(min, max, PARTS);
        // An axis around zero may contain only one round number.
        if found.values.len() == 1 { round_numbers(min, max, 2.0 * PARTS) } else { found }
    }
}

/// Returns the round numbers in a range, at steps of at least its length divided by `parts`.
fn round_numbers(min: f64, max: f64, parts: f64) -> Marks {
    // Guards against an endless loop, also if a step is below the rounding of the numbers.
    const MOST: f64 = 20.0;
    let least = (max - min) / parts;
    let power = 10f64.powf(least.log10().floor());
    let round = [1.0, 2.0, 5.0, 10.0].into_iter().find(|it| it * power >= least);
    let step = round.unwrap_or(10.0) * power;
    let (first, last) = ((min / step).ceil(), (max / step).floor());
    if !(step > 0.0 && step.is_finite() && last - first <= MOST) {
        return Marks::default();
    }
    let count = (last - first + 1.0).max(0.0) as usize;
    Marks { values: (0..count).map(|i| (first + i as f64) * step).collect(), step }
}

/// Returns the text of a mark, with just enough digits to distinguish it from those a `step` away.
pub fn text_of_mark(value: f64, step: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    // Outside this range, exponents are easier to read than zeros.
    if !(1e-4..1e6).contains(&step) {
        let digits = (value.abs().log10().floor() - step.log10().floor()).max(0.0);
        return format!("{value:.*e}", digits as usize);
    }
    let decimals = (-step.log10()).ceil().max(0.0);
    format!("{value:.*}", decimals as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_an_axis_are_told_apart() {
        let text = text_of_mark;
        assert_eq!((text(0.5, 0.5), text(50.0, 50.0)), ("0.5".to_owned(), "50".to_owned()));
        assert_eq!((text(0.02, 0.01), text(0.0, 1e-9)), ("0.02".to_owned(), "0".to_owned()));
        assert_eq!((text(3e-9, 1e-9), text(1.5e7, 5e6)), ("3e-9".to_owned(), "1.5e7".to_owned()));
    }

    #[test]
    fn every_axis_has_round_numbers_and_few_of_them() {
        let values = |min, max| Marks::between(min, max).values;
        assert_eq!(values(0.0, 100.0), [0.0, 50.0, 100.0]);
        assert_eq!(values(-3.1, 33.0), [0.0, 10.0, 20.0, 30.0]);
        assert_eq!(values(-45.0, 45.0), [-40.0, -20.0, 0.0, 20.0, 40.0]);
        for (min, max) in [(0.0, 4e-9), (0.3, 0.31), (-1e9, 2.0), (5e3, 6.7e3), (-1.0, 1e-3)] {
            let count = values(min, max).len();
            assert!((2..=6).contains(&count), "{min} to {max}: {count}");
        }
        for (min, max) in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            assert_eq!(values(min, max), [0.0; 0], "{min} to {max}");
        }
    }
}
