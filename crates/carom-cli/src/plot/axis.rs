//! An axis of a plot, with marks at round numbers.

use std::ops::Range;

use carom_session::figures::{Figure, Form, Marks, Scale};
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// Part of an axis of values that stays free above and below them.
const ROOM: f64 = 0.05;

/// An axis of a plot.
pub struct Axis {
    scale: Scale,
    /// Places of the ends.
    range: Range<f64>,
    marks: Marks,
    decimal_comma: bool,
}

impl Axis {
    /// Axis of the places at which a figure has values.
    pub fn across(figure: &Figure, decimal_comma: bool) -> Self {
        Self::new(Scale::Linear, range(figure, |[x, _]| x, 0.0), decimal_comma)
    }

    /// Axis of the values of a figure.
    pub fn up(figure: &Figure, decimal_comma: bool) -> Self {
        let scale = figure.scale;
        Self::new(scale, range(figure, |[_, y]| scale.place(y), ROOM), decimal_comma)
    }

    fn new(scale: Scale, range: Range<f64>, decimal_comma: bool) -> Self {
        let marks = scale.marks(range.start, range.end);
        Self { scale, range, marks, decimal_comma }
    }

    /// Returns the place of a value on the axis: 0 at its start, 1 at its end.
    pub fn part(&self, value: f64) -> f64 {
        (self.scale.place(value) - self.range.start) / (self.range.end - self.range.start)
    }

    /// Returns the marked values with their texts.
    pub fn marks(&self) -> impl Iterator<Item = (f64, String)> + '_ {
        self.marks.values.iter().map(|value| (*value, self.format_ext(value)))
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (first, last): (i32, i32)) -> i32 {
        first + (self.part(*value) * f64::from(last - first)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        // There are no finer lines between them.
        if hint.weight().allow_light_points() { Vec::new() } else { self.marks.values.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.scale.value(self.range.start)..self.scale.value(self.range.end)
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        let text = self.scale.text(*value, self.marks.step);
        if self.decimal_comma { text.replace('.', ",") } else { text }
    }
}

/// Returns the range of the points of a figure, wider by a part of it at both ends; never empty. Bars count
/// whole.
fn range(figure: &Figure, along: impl Fn([f64; 2]) -> f64, room: f64) -> Range<f64> {
    let corners = figure.curves.iter().flat_map(|curve| {
        let (half, is_bars) = match curve.form {
            Form::Line => (0.0, false),
            Form::Bars(width) => (0.5 * width, true),
        };
        let feet = curve.points.iter().filter(move |_| is_bars).map(|[x, _]| [*x, 0.0]);
        let points = curve.points.iter().copied().chain(feet);
        points.flat_map(move |[x, y]| [[x - half, y], [x + half, y]])
    });
    let ends = corners.map(along).filter(|it| it.is_finite());
    let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    if low > high {
        return 0.0..1.0;
    }
    let size = high - low;
    // Less is rounding, which would fill the figure.
    if size <= 1e-12 * high.abs().max(low.abs()) {
        let around = if high == 0.0 { 1.0 } else { 0.5 * high.abs() };
        return low - around..high + around;
    }
    low - room * size..high + room * size
}
