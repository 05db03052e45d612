//! Scales of axes, and round numbers along them.

/// How values are placed along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Scale {
    /// The axis shows the values themselves.
    #[default]
    Linear,
    /// The axis shows decimal logarithms.
    Logarithmic,
}

impl Scale {
    /// Returns the place of a value; not a finite number if the axis has none.
    pub fn place(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Logarithmic => value.log10(),
        }
    }

    /// Returns the value at a place.
    pub fn value(self, place: f64) -> f64 {
        match self {
            Self::Linear => place,
            Self::Logarithmic => 10f64.powf(place),
        }
    }

    /// Returns the marks between two places: round numbers, on a logarithmic axis powers of ten.
    pub fn marks(self, min: f64, max: f64) -> Marks {
        match self {
            Self::Linear => Marks::between(min, max),
            Self::Logarithmic => {
                let Marks { values, step } = Marks::of_whole_numbers(min, max);
                Marks { values: values.into_iter().map(|it| self.value(it)).collect(), step }
            }
        }
    }

    /// Returns the text of a mark, with just enough digits to distinguish it from the others.
    pub fn text(self, mark: f64, step: f64) -> String {
        match self {
            Self::Linear => text_of_mark(mark, step),
            Self::Logarithmic => format!("1e{:.0}", mark.log10()),
        }
    }
}

/// Round numbers along an axis, at places with equal steps.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Marks {
    /// The numbers, ascending.
    pub values: Vec<f64>,
    /// Distance between the places of two marks.
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

    /// Returns those of the marks between two numbers that are whole; of a short range, all whole numbers.
    fn of_whole_numbers(min: f64, max: f64) -> Self {
        let found = Self::between(min, max);
        if found.step >= 1.0 { found } else { round_numbers(min, max, max - min) }
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
fn text_of_mark(value: f64, step: f64) -> String {
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
    fn a_logarithmic_axis_is_marked_at_powers_of_ten() {
        let scale = Scale::Logarithmic;
        let marks = |low: f64, high: f64| {
            let marks = scale.marks(scale.place(low), scale.place(high));
            marks.values.iter().map(|it| scale.text(*it, marks.step)).collect::<Vec<_>>()
        };
        assert_eq!(marks(3e-11, 0.7), ["1e-10", "1e-5"]);
        assert_eq!(marks(0.5, 150.0), ["1e0", "1e1", "1e2"]);
        assert_eq!(marks(2.0, 3.0), [""; 0]);
        assert!(!scale.place(0.0).is_finite() && !scale.place(-1.0).is_finite());
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
