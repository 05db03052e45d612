//! Figures: curves over one axis, with names and units.

use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, RichText, TextStyle, Ui};
use egui_plot::{
    AxisHints, Bar, BarChart, GridInput, GridMark, Line, Plot, PlotPoint, PlotPoints, VLine,
};

const HEIGHT: f32 = 132.0;
pub const BLUE: Color32 = Color32::from_rgb(66, 133, 214);
pub const GREEN: Color32 = Color32::from_rgb(60, 160, 100);
pub const RED: Color32 = Color32::from_rgb(214, 80, 70);
pub const GREY: Color32 = Color32::from_rgb(140, 140, 150);

/// A line or a set of bars in a figure.
pub struct Curve {
    pub name: String,
    color: Color32,
    points: Vec<PlotPoint>,
    form: Form,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Form {
    Line,
    /// Bars of this width.
    Bars(f64),
}

/// Curves over one axis.
pub struct Figure {
    pub title: String,
    /// Unit of the vertical axis.
    pub unit: &'static str,
    /// Name and unit of the horizontal axis.
    pub across: (String, &'static str),
    pub curves: Vec<Curve>,
    /// Marked position on the horizontal axis: the present time.
    pub mark: Option<f64>,
    /// Position on the horizontal axis after which values no longer set the scale.
    pub scale_until: Option<f64>,
}

impl Curve {
    /// Makes a line with one point for each item.
    pub fn line<T>(
        name: impl Into<String>,
        color: Color32,
        of: &[T],
        point: impl Fn(&T) -> (f64, f64),
    ) -> Self {
        let points = of.iter().map(point).map(|(x, y)| PlotPoint::new(x, y)).collect();
        Self { name: name.into(), color, points, form: Form::Line }
    }

    /// Makes bars of this width, centred at the points.
    pub fn bars(
        name: impl Into<String>,
        color: Color32,
        width: f64,
        of: impl Iterator<Item = (f64, f64)>,
    ) -> Self {
        let points = of.map(|(x, y)| PlotPoint::new(x, y)).collect();
        Self { name: name.into(), color, points, form: Form::Bars(width) }
    }
}

impl Figure {
    /// Makes a figure of quantities over time, with the present time marked \[s\].
    pub fn over_time(
        title: impl Into<String>,
        unit: &'static str,
        now: f64,
        curves: Vec<Curve>,
    ) -> Self {
        let across = ("time".to_owned(), "s");
        Self { title: title.into(), unit, across, curves, mark: Some(now), scale_until: None }
    }

    /// Makes a figure of one quantity over another.
    pub fn over(
        title: impl Into<String>,
        unit: &'static str,
        across: (impl Into<String>, &'static str),
        curves: Vec<Curve>,
    ) -> Self {
        let across = (across.0.into(), across.1);
        Self { title: title.into(), unit, across, curves, mark: None, scale_until: None }
    }

    /// Draws the figure and its title. Returns whether the user wants to save its numbers.
    pub fn show(&self, ui: &mut Ui) -> bool {
        let is_wanted = ui.horizontal_wrapped(|ui| {
            ui.strong(labelled(&self.title, self.unit));
            let save = ui.small_button(RichText::new("CSV").size(9.0));
            let save = save.on_hover_text("Save the numbers of this figure");
            save.widget_info(|| {
                let text = format!("Save the numbers of {}", self.title);
                egui::WidgetInfo::labeled(egui::Role::Button, true, text)
            });
            self.name_curves(ui);
            save.clicked()
        });
        self.plot(ui, if self.mark.is_some() { HEIGHT } else { 1.5 * HEIGHT });
        is_wanted.inner
    }

    /// Draws the figure without controls, with this height in points below its title.
    pub fn print(&self, ui: &mut Ui, height: f32) {
        ui.horizontal_wrapped(|ui| {
            ui.strong(labelled(&self.title, self.unit));
            self.name_curves(ui);
        });
        self.plot(ui, height);
    }

    /// Shows the names of the curves if there are several. A legend inside the plot would cover
    /// them.
    fn name_curves(&self, ui: &mut Ui) {
        if self.curves.len() > 1 {
            for Curve { name, color, .. } in &self.curves {
                ui.label(legend(ui, name, *color));
            }
        }
    }

    fn plot(&self, ui: &mut Ui, height: f32) {
        let text = |mark, _: &_| text_of(mark);
        let across = AxisHints::new_x().label_spacing(1.0..=2.0).formatter(text);
        let across = across.label(labelled(&self.across.0, self.across.1));
        let up = AxisHints::new_y().label_spacing(1.0..=2.0).min_thickness(46.0);
        let mut plot = Plot::new(&self.title)
            .height(height)
            .allow_scroll(false)
            .allow_drag(false)
            .allow_zoom(false)
            .allow_boxed_zoom(false)
            .custom_x_axes(vec![across])
            .x_grid_spacer(marks)
            .y_grid_spacer(marks)
            .custom_y_axes(vec![up.formatter(text)]);
        if self.mark.is_some() {
            plot = plot.include_x(0.0);
        }
        if self.curves.iter().all(|curve| curve.points.len() < 2) {
            // A single value has no range.
            plot = plot.include_x(0.0).include_x(1.0);
        }
        plot.show(ui, |plot| {
            for Curve { name, color, points, form } in &self.curves {
                if let Form::Bars(width) = form {
                    let bar = |it: &PlotPoint| Bar::new(it.x, it.y).width(*width);
                    let bars = points.iter().map(bar).collect();
                    plot.bar_chart(BarChart::new(name, bars).color(color.gamma_multiply(0.7)));
                } else {
                    plot.line(Line::new(name, PlotPoints::Borrowed(points)).color(*color));
                }
            }
            if let Some(mark) = self.mark {
                plot.vline(VLine::new("", mark).color(GREY.gamma_multiply(0.6)).width(1.0));
            }
            if let Some((low, high)) = self.scale() {
                plot.set_plot_bounds_y(low..=high);
            }
        });
    }

    /// Returns the range of the values that set the scale, with a margin; `None` if all values set
    /// it.
    fn scale(&self) -> Option<(f64, f64)> {
        let until = self.scale_until?;
        let values = self.curves.iter().flat_map(|it| &it.points).filter(|it| it.x <= until);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| {
            (low.min(point.y), high.max(point.y))
        });
        let room = 0.05 * (high - low);
        (room > 0.0 && room.is_finite()).then_some((low - room, high + room))
    }

    /// Returns the numbers as a table: a column for the horizontal axis and one for each curve. A
    /// curve at other positions has two columns.
    pub fn to_csv(&self) -> String {
        let mut columns: Vec<(String, Vec<f64>)> = Vec::new();
        let mut along: &[PlotPoint] = &[];
        for curve in &self.curves {
            let is_same = columns.len() > 1
                && along.iter().map(|it| it.x).eq(curve.points.iter().map(|it| it.x));
            if !is_same {
                along = &curve.points;
                let name = labelled(&self.across.0, self.across.1);
                columns.push((name, along.iter().map(|it| it.x).collect()));
            }
            let name = if self.curves.len() > 1 { &curve.name } else { &self.title };
            let values = curve.points.iter().map(|it| it.y).collect();
            columns.push((labelled(name, self.unit), values));
        }
        let rows = columns.iter().map(|(_, values)| values.len()).max().unwrap_or_default();
        let names: Vec<String> = columns.iter().map(|(name, _)| quoted(name)).collect();
        let row = |row: usize| {
            let cell = |(_, values): &(_, Vec<f64>)| {
                values.get(row).map(|value| value.to_string()).unwrap_or_default()
            };
            columns.iter().map(cell).collect::<Vec<_>>().join(",")
        };
        let lines = std::iter::once(names.join(",")).chain((0..rows).map(row));
        lines.map(|line| line + "\n").collect()
    }
}

/// Returns a name with its unit, for display.
fn labelled(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name}, {unit}") }
}

/// Returns a cell of a table, in quotation marks if it contains a separator (RFC 4180).
fn quoted(cell: &str) -> String {
    let is_plain = !cell.contains([',', '"', '\n']);
    if is_plain { cell.to_owned() } else { format!("\"{}\"", cell.replace('"', "\"\"")) }
}

/// Returns the marks of an axis: round numbers, at least two, and few enough for their labels.
fn marks(axis: GridInput) -> Vec<GridMark> {
    const PARTS: f64 = 4.0;
    let found = round_numbers(axis.bounds, PARTS);
    // An axis around zero may contain only one round number.
    if found.len() == 1 { round_numbers(axis.bounds, 2.0 * PARTS) } else { found }
}

/// Returns the round numbers in a range, at steps of at least its length divided by `parts`.
fn round_numbers((min, max): (f64, f64), parts: f64) -> Vec<GridMark> {
    // Guards against an endless loop, also if a step is below the rounding of the numbers.
    const MOST: f64 = 20.0;
    let least = (max - min) / parts;
    let power = 10f64.powf(least.log10().floor());
    let round = [1.0, 2.0, 5.0, 10.0].into_iter().find(|it| it * power >= least);
    let step_size = round.unwrap_or(10.0) * power;
    let (first, last) = ((min / step_size).ceil(), (max / step_size).floor());
    if !(step_size > 0.0 && step_size.is_finite() && last - first <= MOST) {
        return Vec::new();
    }
    let count = (last - first + 1.0).max(0.0) as usize;
    let mark = |i| GridMark { value: (first + i as f64) * step_size, step_size };
    (0..count).map(mark).collect()
}

/// Returns the text of a mark, with just enough digits to distinguish it from the next.
fn text_of(mark: GridMark) -> String {
    let GridMark { value, step_size } = mark;
    if value == 0.0 {
        return "0".to_owned();
    }
    // Outside this range, exponents are easier to read than zeros.
    if !(1e-4..1e6).contains(&step_size) {
        let digits = (value.abs().log10().floor() - step_size.log10().floor()).max(0.0);
        return format!("{value:.*e}", digits as usize);
    }
    let decimals = (-step_size.log10()).ceil().max(0.0);
    format!("{value:.*}", decimals as usize)
}

/// Returns the name of a curve beside a patch of its colour. A name in that colour would be too
/// faint.
fn legend(ui: &Ui, name: &str, color: Color32) -> LayoutJob {
    let font = TextStyle::Small.resolve(ui.style());
    let mut job = LayoutJob::default();
    job.append("■\u{a0}", 0.0, TextFormat::simple(font.clone(), color));
    job.append(name, 0.0, TextFormat::simple(font, ui.visuals().text_color()));
    job
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(bounds: (f64, f64)) -> Vec<f64> {
        marks(GridInput { bounds, base_step_size: 1.0 }).iter().map(|mark| mark.value).collect()
    }

    #[test]
    fn numbers_of_an_axis_are_told_apart() {
        let text = |value, step_size| text_of(GridMark { value, step_size });
        assert_eq!((text(0.5, 0.5), text(50.0, 50.0)), ("0.5".to_owned(), "50".to_owned()));
        assert_eq!((text(0.02, 0.01), text(0.0, 1e-9)), ("0.02".to_owned(), "0".to_owned()));
        assert_eq!((text(3e-9, 1e-9), text(1.5e7, 5e6)), ("3e-9".to_owned(), "1.5e7".to_owned()));
    }

    #[test]
    fn every_axis_has_round_numbers_and_few_of_them() {
        assert_eq!(values((0.0, 100.0)), [0.0, 50.0, 100.0]);
        assert_eq!(values((-3.1, 33.0)), [0.0, 10.0, 20.0, 30.0]);
        assert_eq!(values((-45.0, 45.0)), [-40.0, -20.0, 0.0, 20.0, 40.0]);
        for (min, max) in [(0.0, 4e-9), (0.3, 0.31), (-1e9, 2.0), (5e3, 6.7e3), (-1.0, 1e-3)] {
            let count = values((min, max)).len();
            assert!((2..=6).contains(&count), "{min} to {max}: {count}");
        }
        for (min, max) in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            assert_eq!(values((min, max)), [0.0; 0], "{min} to {max}");
        }
    }

    fn figure(curves: Vec<Curve>) -> Figure {
        Figure::over_time("Energy", "J", 0.0, curves)
    }

    #[test]
    fn a_table_has_one_column_of_times_for_curves_that_share_them() {
        let readings = [(0.0, 1.0, 0.1), (0.5, 2.0, 1e-9)];
        let curves = vec![
            Curve::line("kinetic", RED, &readings, |it| (it.0, it.1)),
            Curve::line("total", BLUE, &readings, |it| (it.0, it.2)),
            Curve::line("total, right", GREY, &readings[..1], |it| (it.0, it.1)),
        ];
        let text = figure(curves).to_csv();
        let expected = "\"time, s\",\"kinetic, J\",\"total, J\",\"time, s\",\"total, right, J\"\n\
                        0,1,0.1,0,1\n0.5,2,0.000000001,,\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn a_single_curve_is_called_as_its_figure() {
        let text = figure(vec![Curve::line("all", RED, &[1.0], |it| (*it, *it))]).to_csv();
        assert_eq!(text, "\"time, s\",\"Energy, J\"\n1,1\n");
    }

    #[test]
    fn what_comes_after_the_last_ball_in_sight_sets_no_scale() {
        let points: Vec<f64> = (0..10).map(f64::from).collect();
        let curve = Curve::line("falling", RED, &points, |t| (*t, -t * t));
        let mut falling = figure(vec![curve]);
        assert_eq!(falling.scale(), None);
        falling.scale_until = Some(2.0);
        assert_eq!(falling.scale(), Some((-4.2, 0.2)));
        falling.scale_until = Some(0.0);
        assert_eq!(falling.scale(), None, "one value alone has no scale");
    }
}
