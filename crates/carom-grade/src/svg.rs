//! SVG drawings for pages: figures with axes, and pictures of a scene.

use std::fmt::Write;

/// Size of the plotting area of a figure, and margins beside and below it \[px\].
const INSIDE: [f64; 2] = [640.0, 190.0];
const MARGIN: [f64; 2] = [64.0, 34.0];

/// A line of a figure.
pub struct Line {
    /// Class of the style sheet.
    pub class: &'static str,
    pub points: Vec<[f64; 2]>,
}

/// A figure of lines over time.
pub struct Figure {
    pub title: String,
    pub lines: Vec<Line>,
    /// A time to mark \[s\].
    pub mark: Option<f64>,
    /// Whether the vertical axis shows powers of ten; then points contain their exponents.
    pub logarithmic: bool,
}

impl Figure {
    /// Writes the figure as an element of a page.
    pub fn svg(&self) -> String {
        let points = || self.lines.iter().flat_map(|line| &line.points);
        let along = Range::of(points().map(|it| it[0]));
        let up = self.heights();
        let x = |value: f64| MARGIN[0] + along.part(value) * INSIDE[0];
        let y = |value: f64| 8.0 + (1.0 - up.part(value)) * INSIDE[1];
        let (width, height) = (MARGIN[0] + INSIDE[0] + 12.0, INSIDE[1] + MARGIN[1] + 8.0);
        let mut svg = format!(
            "<figure><figcaption>{}</figcaption><svg viewBox=\"0 0 {width} {height}\" role=\"img\">",
            escaped(&self.title)
        );
        let (left, right) = (MARGIN[0], MARGIN[0] + INSIDE[0]);
        let (top, bottom) = (8.0, 8.0 + INSIDE[1]);
        for tick in along.ticks() {
            let at = x(tick);
            let label = short(tick);
            svg += &format!(
                "<path class=\"grid\" d=\"M{at:.1} {top}V{bottom}\"/>\
                 <text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{label}</text>",
                bottom + 15.0
            );
        }
        for tick in up.ticks() {
            if self.logarithmic && tick != tick.round() {
                continue;
            }
            let at = y(tick);
            let label = if self.logarithmic { format!("1e{tick}") } else { short(tick) };
            svg += &format!(
                "<path class=\"grid\" d=\"M{left} {at:.1}H{right}\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
                left - 6.0,
                at + 4.0
            );
        }
        svg += &format!(
            "<text x=\"{right}\" y=\"{:.1}\" text-anchor=\"end\">t, s</text>",
            bottom + 30.0
        );
        // The inner drawing clips lines that leave the axes.
        let [inside_x, inside_y] = INSIDE;
        svg += &format!(
            "<svg x=\"{left}\" y=\"{top}\" width=\"{inside_x}\" height=\"{inside_y}\" \
             viewBox=\"{left} {top} {inside_x} {inside_y}\">"
        );
        for line in &self.lines {
            let points = line.points.iter().map(|it| [x(it[0]), y(it[1])]);
            polyline(&mut svg, line.class, points);
        }
        svg += "</svg>";
        if let Some(mark) = self.mark {
            svg += &format!("<path class=\"mark\" d=\"M{:.1} {top}V{bottom}\"/>", x(mark));
        }
        svg + "</svg></figure>"
    }
}

impl Figure {
    /// Range of the vertical axis: that of the line `right`, and of other lines up to the same
    /// height above and below it, so that a ball far away leaves the others visible.
    fn heights(&self) -> Range {
        let all = || self.lines.iter().flat_map(|line| &line.points).map(|it| it[1]);
        let right = self.lines.iter().filter(|line| line.class == "right");
        let right: Vec<f64> = right.flat_map(|line| &line.points).map(|it| it[1]).collect();
        if right.is_empty() || self.logarithmic {
            return Range::of(all());
        }
        let own = Range::of(right.into_iter());
        let span = own.most - own.least;
        let [least, most] = [own.least - span, own.most + span];
        Range::of(all().map(|it| it.clamp(least, most)).chain([own.least, own.most]))
    }
}

/// A picture of a rectangle in two coordinates.
pub struct Picture {
    svg: String,
    /// Smallest coordinates of the rectangle; then pixels per metre.
    least: [f64; 2],
    scale: f64,
    height: f64,
}

/// Largest width and height of a picture \[px\].
const WIDTH: f64 = 520.0;
const HEIGHT: f64 = 560.0;

impl Picture {
    /// Creates an empty picture of the rectangle between two corners \[m\].
    pub fn new(title: &str, least: [f64; 2], most: [f64; 2]) -> Self {
        let size = [most[0] - least[0], most[1] - least[1]].map(|length| length.max(1e-9));
        let scale = (WIDTH / size[0]).min(HEIGHT / size[1]);
        let [width, height] = size.map(|length| length * scale);
        let svg = format!(
            "<figure><figcaption>{}</figcaption>\
             <svg viewBox=\"0 0 {width:.1} {height:.1}\" role=\"img\" class=\"place\">",
            escaped(title)
        );
        Self { svg, least, scale, height }
    }

    fn at(&self, point: [f64; 2]) -> [f64; 2] {
        let [x, y] = [0, 1].map(|axis| (point[axis] - self.least[axis]) * self.scale);
        [x, self.height - y]
    }

    pub fn circle(&mut self, class: &str, center: [f64; 2], radius: f64, title: &str) {
        let [x, y] = self.at(center);
        let radius = radius * self.scale;
        write!(
            self.svg,
            "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\"><title>{}</title></circle>",
            escaped(title)
        )
        .ok();
    }

    pub fn polygon(&mut self, class: &str, corners: &[[f64; 2]], title: &str) {
        let corners: Vec<String> = corners
            .iter()
            .map(|corner| self.at(*corner))
            .map(|[x, y]| format!("{x:.1},{y:.1}"))
            .collect();
        let corners = corners.join(" ");
        let title = escaped(title);
        write!(
            self.svg,
            "<polygon class=\"{class}\" points=\"{corners}\"><title>{title}</title></polygon>"
        )
        .ok();
    }

    pub fn line(&mut self, class: &str, points: impl Iterator<Item = [f64; 2]>) {
        let points: Vec<[f64; 2]> = points.map(|it| self.at(it)).collect();
        polyline(&mut self.svg, class, points.into_iter());
    }

    /// Writes the picture as an element of a page.
    pub fn finish(self) -> String {
        self.svg + "</svg></figure>"
    }
}

/// Appends a line through points \[px\]; leaves out points that no screen could distinguish.
fn polyline(svg: &mut String, class: &str, points: impl Iterator<Item = [f64; 2]>) {
    let mut path = String::new();
    let mut last = [f64::NEG_INFINITY; 2];
    // Points far outside are clipped by the drawing.
    let bounded = |value: f64| value.clamp(-1e5, 1e5);
    for [x, y] in points.map(|point| point.map(bounded)) {
        if (x - last[0]).abs() + (y - last[1]).abs() > 0.4 {
            write!(path, "{x:.1},{y:.1} ").ok();
            last = [x, y];
        }
    }
    write!(svg, "<polyline class=\"{class}\" points=\"{}\"/>", path.trim_end()).ok();
}

/// Range of values on an axis.
#[derive(Debug, Clone, Copy)]
struct Range {
    least: f64,
    most: f64,
}

impl Range {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.filter(|it| it.is_finite()) {
            (least, most) = (least.min(value), most.max(value));
        }
        if least > most {
            (least, most) = (0.0, 1.0);
        }
        if most - least < 1e-9 * most.abs().max(1e-3) {
            (least, most) = (least - 0.5, most + 0.5);
        }
        Self { least, most }
    }

    fn part(self, value: f64) -> f64 {
        (value - self.least) / (self.most - self.least)
    }

    /// Returns about five round values.
    fn ticks(self) -> Vec<f64> {
        let rough = (self.most - self.least) / 5.0;
        let power = 10_f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|it| it * power).find(|it| *it >= rough);
        let step = step.unwrap_or(rough);
        let first = (self.least / step).ceil() as i64;
        let last = (self.most / step).floor() as i64;
        (first..=last).map(|number| number as f64 * step).collect()
    }
}

/// Formats a number for a tick, as short as possible.
fn short(value: f64) -> String {
    let rounded = format!("{value:.3}");
    let rounded = rounded.trim_end_matches('0').trim_end_matches('.');
    if rounded == "-0" { "0".to_owned() } else { rounded.to_owned() }
}

/// Escapes a text for a page.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for letter in text.chars() {
        match letter {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\'' => escaped += "&#39;",
            control if control.is_control() => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within_the_axis() {
        let range = Range::of([0.13, 11.9].into_iter());
        assert_eq!(range.ticks(), [5.0, 10.0]);
        assert_eq!(Range::of([3.0].into_iter()).ticks().len(), 5);
        assert_eq!(short(0.25), "0.25");
    }

    #[test]
    fn a_line_that_goes_far_leaves_the_axes_as_they_are() {
        let right = Line { class: "right", points: vec![[0.0, 0.0], [1.0, 2.0]] };
        let run = Line { class: "run", points: vec![[0.0, 0.0], [1.0, 1e6]] };
        let lines = vec![right, run];
        let figure = Figure { title: String::new(), lines, mark: None, logarithmic: false };
        let range = figure.heights();
        assert_eq!((range.least, range.most), (0.0, 4.0));
    }

    #[test]
    fn texts_cannot_leave_their_element() {
        assert_eq!(escaped("<a b='\"&\n"), "&lt;a b=&#39;&quot;&amp; ");
    }
}
