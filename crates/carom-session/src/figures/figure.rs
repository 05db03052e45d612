//! Figures: curves over one axis, with names and units.

use super::axis::Scale;

/// Colour of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hue {
    /// The main quantity, or the third axis.
    Blue,
    /// The second of several, or the second axis.
    Green,
    /// The first of several, or the first axis.
    Red,
    /// What others are compared with.
    Grey,
}

impl Hue {
    /// Red, green and blue, legible on a light and on a dark ground.
    pub fn rgb(self) -> [u8; 3] {
        match self {
            Self::Blue => [66, 133, 214],
            Self::Green => [60, 160, 100],
            Self::Red => [214, 80, 70],
            Self::Grey => [140, 140, 150],
        }
    }
}

/// How the points of a curve are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Form {
    /// As a line through them.
    Line,
    /// As bars of this width, centred at them.
    Bars(f64),
}

/// A line or a set of bars in a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Name in the legend and in tables.
    pub name: String,
    /// Colour.
    pub hue: Hue,
    /// Places on the horizontal axis, with the values there.
    pub points: Vec<[f64; 2]>,
    /// How the points are drawn.
    pub form: Form,
}

impl Curve {
    /// Makes a line with one point for each item.
    pub fn line<T>(
        name: impl Into<String>,
        hue: Hue,
        of: &[T],
        point: impl Fn(&T) -> (f64, f64),
    ) -> Self {
        let points = of.iter().map(point).map(|(x, y)| [x, y]).collect();
        Self { name: name.into(), hue, points, form: Form::Line }
    }

    /// Makes bars of this width, centred at the points.
    pub fn bars(
        name: impl Into<String>,
        hue: Hue,
        width: f64,
        of: impl Iterator<Item = (f64, f64)>,
    ) -> Self {
        let points = of.map(|(x, y)| [x, y]).collect();
        Self { name: name.into(), hue, points, form: Form::Bars(width) }
    }
}

/// Curves over one axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name of what is shown.
    pub title: String,
    /// Unit of the vertical axis.
    pub unit: &'static str,
    /// Name and unit of the horizontal axis.
    pub across: (String, &'static str),
    /// Scale of the vertical axis.
    pub scale: Scale,
    /// What is drawn, the last one in front.
    pub curves: Vec<Curve>,
    /// Marked position on the horizontal axis: the present time.
    pub mark: Option<f64>,
    /// Position on the horizontal axis after which values no longer set the scale.
    pub scale_until: Option<f64>,
}

impl Figure {
    /// Makes a figure of quantities over time, with the present time marked \[s\].
    pub fn over_time(
        title: impl Into<String>,
        unit: &'static str,
        now: f64,
        curves: Vec<Curve>,
    ) -> Self {
        let across = ("time", "s");
        Self { mark: Some(now), ..Self::over(title, unit, across, curves) }
    }

    /// Makes a figure of one quantity over another.
    pub fn over(
        title: impl Into<String>,
        unit: &'static str,
        across: (impl Into<String>, &'static str),
        curves: Vec<Curve>,
    ) -> Self {
        Self {
            title: title.into(),
            unit,
            across: (across.0.into(), across.1),
            scale: Scale::default(),
            curves,
            mark: None,
            scale_until: None,
        }
    }

    /// Title with its unit.
    pub fn heading(&self) -> String {
        labelled(&self.title, self.unit)
    }

    /// Name of the horizontal axis with its unit.
    pub fn axis(&self) -> String {
        labelled(&self.across.0, self.across.1)
    }

    /// Returns the range of the places of the values that set the scale, with a margin; `None` if all
    /// values set it.
    pub fn bounds(&self) -> Option<(f64, f64)> {
        let until = self.scale_until?;
        let values = self.curves.iter().flat_map(|it| &it.points).filter(|it| it[0] <= until);
        let (low, high) = values
            .map(|[_, value]| self.scale.place(*value))
            .filter(|place| place.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), place| {
                (low.min(place), high.max(place))
            });
        let room = 0.05 * (high - low);
        (room > 0.0 && room.is_finite()).then_some((low - room, high + room))
    }

    /// Returns the numbers as a table; see [`table`].
    pub fn to_csv(&self) -> String {
        table(std::slice::from_ref(self), TableStyle::default())
    }
}

/// How the numbers of a table are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TableStyle {
    /// Number of significant digits; without it, as many as give back the same number.
    pub digits: Option<u8>,
    /// Whether numbers have a decimal comma, and cells a semicolon between them.
    pub decimal_comma: bool,
}

impl TableStyle {
    fn separator(self) -> char {
        if self.decimal_comma { ';' } else { ',' }
    }

    /// Formats a number.
    fn number(self, value: f64) -> String {
        let rounded = |digits: u8| {
            let text = format!("{value:.*e}", usize::from(digits.max(1)) - 1);
            text.parse().unwrap_or(value)
        };
        let text = self.digits.map_or(value, rounded).to_string();
        if self.decimal_comma { text.replace('.', ",") } else { text }
    }

    /// Returns a cell of a table, in quotation marks if it contains a separator (RFC 4180).
    fn quoted(self, cell: &str) -> String {
        let is_plain = !cell.contains([self.separator(), '"', '\n']);
        if is_plain { cell.to_owned() } else { format!("\"{}\"", cell.replace('"', "\"\"")) }
    }
}

/// Returns the numbers of figures as a table in CSV: a column for the horizontal axis and one for each
/// curve. A curve at other positions than the one before has two columns.
pub fn table(figures: &[Figure], style: TableStyle) -> String {
    let mut columns: Vec<(String, Vec<f64>)> = Vec::new();
    let mut along: &[[f64; 2]] = &[];
    for figure in figures {
        for curve in &figure.curves {
            let is_same = columns.len() > 1
                && along.iter().map(|it| it[0]).eq(curve.points.iter().map(|it| it[0]));
            if !is_same {
                along = &curve.points;
                columns.push((figure.axis(), along.iter().map(|it| it[0]).collect()));
            }
            let name = if figure.curves.len() > 1 { &curve.name } else { &figure.title };
            let values = curve.points.iter().map(|it| it[1]).collect();
            columns.push((labelled(name, figure.unit), values));
        }
    }
    let rows = columns.iter().map(|(_, values)| values.len()).max().unwrap_or_default();
    let names: Vec<String> = columns.iter().map(|(name, _)| style.quoted(name)).collect();
    let separator = style.separator().to_string();
    let row = |row: usize| {
        let cell = |(_, values): &(_, Vec<f64>)| {
            values.get(row).map(|value| style.number(*value)).unwrap_or_default()
        };
        columns.iter().map(cell).collect::<Vec<_>>().join(&separator)
    };
    let lines = std::iter::once(names.join(&separator)).chain((0..rows).map(row));
    lines.map(|line| line + "\n").collect()
}

/// Returns a name with its unit, for display.
fn labelled(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name}, {unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(curves: Vec<Curve>) -> Figure {
        Figure::over_time("Energy", "J", 0.0, curves)
    }

    #[test]
    fn a_table_has_one_column_of_times_for_curves_that_share_them() {
        let readings = [(0.0, 1.0, 0.1), (0.5, 2.0, 1e-9)];
        let curves = vec![
            Curve::line("kinetic", Hue::Red, &readings, |it| (it.0, it.1)),
            Curve::line("total", Hue::Blue, &readings, |it| (it.0, it.2)),
            Curve::line("total, right", Hue::Grey, &readings[..1], |it| (it.0, it.1)),
        ];
        let text = figure(curves).to_csv();
        let expected = "\"time, s\",\"kinetic, J\",\"total, J\",\"time, s\",\"total, right, J\"\n\
                        0,1,0.1,0,1\n0.5,2,0.000000001,,\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn digits_count_from_the_first_one_that_is_not_zero() {
        let style = TableStyle { digits: Some(3), decimal_comma: false };
        let values = [123_456.0, 0.001_234_56, -2.0 / 3.0, 0.0, 9.999, f64::NAN];
        let texts = values.map(|value| style.number(value));
        assert_eq!(texts, ["123000", "0.00123", "-0.667", "0", "10", "NaN"]);
    }

    #[test]
    fn a_table_with_decimal_commas_has_semicolons_between_its_cells() {
        let curve = Curve::line("all", Hue::Red, &[1.25], |it| (*it, 2.0 * it));
        let style = TableStyle { digits: None, decimal_comma: true };
        assert_eq!(table(&[figure(vec![curve])], style), "time, s;Energy, J\n1,25;2,5\n");
    }

    #[test]
    fn a_single_curve_is_called_as_its_figure() {
        let text = figure(vec![Curve::line("all", Hue::Red, &[1.0], |it| (*it, *it))]).to_csv();
        assert_eq!(text, "\"time, s\",\"Energy, J\"\n1,1\n");
    }

    #[test]
    fn what_comes_after_the_last_ball_in_sight_sets_no_scale() {
        let points: Vec<f64> = (0..10).map(f64::from).collect();
        let curve = Curve::line("falling", Hue::Red, &points, |t| (*t, -t * t));
        let mut falling = figure(vec![curve]);
        assert_eq!(falling.bounds(), None);
        falling.scale_until = Some(2.0);
        assert_eq!(falling.bounds(), Some((-4.2, 0.2)));
        falling.scale_until = Some(0.0);
        assert_eq!(falling.bounds(), None, "one value alone has no scale");
    }
}
