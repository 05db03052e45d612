//! Draws figures below each other, as SVG or in pixels.

use std::sync::OnceLock;

use carom_session::figures::{Curve, Figure, Form};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;

use super::axis::Axis;
use crate::failure::Failure;

/// The font: in pixels that of the window, in an SVG file one of the reader.
const FONT: &str = "sans-serif";
/// Height of the heading in points.
const HEADING: u32 = 36;
/// Height of the title of a figure in points.
const TITLE: u32 = 26;
/// Width of the marks beside the vertical axis in points.
const BESIDE: u32 = 64;
/// Height of the marks below the horizontal axis in points.
const BELOW: u32 = 36;
/// Free space around the parts in points.
const MARGIN: u32 = 12;

/// Finer pixels on each side of a pixel, whose mean it shows: edges of lines are smooth.
const SMOOTHNESS: u32 = 2;

/// Points of a piece of a line in pixels. Longer ones are filled as polygons by the even-odd rule, so that a
/// line that runs over itself would vanish.
const SEGMENT: usize = 2;

/// Lines of the grid, and of the frame.
const GRID: RGBColor = RGBColor(225, 225, 230);
const FRAME: RGBColor = RGBColor(120, 120, 130);
const INK: RGBColor = RGBColor(30, 30, 36);

/// A heading and figures below it.
pub struct Sheet {
    pub heading: String,
    pub figures: Vec<Figure>,
    /// Width and height of a figure in points.
    pub size: [u32; 2],
    /// Whether numbers have a decimal comma.
    pub decimal_comma: bool,
}

impl Sheet {
    /// Returns the sheet as an SVG file.
    pub fn svg(&self) -> Result<String, Failure> {
        let mut text = String::new();
        let root = SVGBackend::with_string(&mut text, self.size_in_pixels(1)).into_drawing_area();
        self.draw(&root, (1, usize::MAX)).map_err(|error| cannot_draw(&error))?;
        drop(root);
        Ok(text)
    }

    /// Returns width, height and pixels with red, green, blue and opacity; `fineness` pixels per point.
    pub fn pixels(&self, fineness: u32) -> Result<([u32; 2], Vec<u8>), Failure> {
        let (fine_width, fine_height) = self.size_in_pixels(SMOOTHNESS * fineness);
        let mut fine = vec![0; 3 * fine_width as usize * fine_height as usize];
        let size = (fine_width, fine_height);
        let root = BitMapBackend::with_buffer(&mut fine, size).into_drawing_area();
        self.draw(&root, (SMOOTHNESS * fineness, SEGMENT)).map_err(|error| cannot_draw(&error))?;
        drop(root);
        let (width, height) = self.size_in_pixels(fineness);
        let places = (0..height).flat_map(|row| (0..width).map(move |column| (row, column)));
        let pixels = places.flat_map(|(row, column)| {
            let [red, green, blue] =
                mean(&fine, fine_width, (SMOOTHNESS * row, SMOOTHNESS * column));
            [red, green, blue, u8::MAX]
        });
        Ok(([width, height], pixels.collect()))
    }

    fn size_in_pixels(&self, fineness: u32) -> (u32, u32) {
        let [width, height] = self.size;
        (fineness * width, fineness * (HEADING + height * self.figures.len() as u32))
    }

    /// Draws everything, with `unit` pixels per point, and lines in pieces of `piece` points.
    fn draw<B: DrawingBackend>(&self, root: &Area<B>, (unit, piece): (u32, usize)) -> Drawn<B> {
        load_font();
        root.fill(&WHITE)?;
        let (top, rest) = root.split_vertically(unit * HEADING);
        let style = font(unit, 18).color(&INK);
        top.draw_text(&self.heading, &style, (at(unit, MARGIN), at(unit, 10)))?;
        for (part, figure) in rest.split_evenly((self.figures.len(), 1)).iter().zip(&self.figures) {
            let axes = [Axis::across, Axis::up].map(|axis| axis(figure, self.decimal_comma));
            draw_figure(part, figure, axes, (unit, piece))?;
        }
        root.present()
    }
}

/// Returns the mean colour of a square of pixels that begins at a row and a column.
fn mean(pixels: &[u8], width: u32, (row, column): (u32, u32)) -> [u8; 3] {
    let mut sums = [0_u32; 3];
    for row in row..row + SMOOTHNESS {
        let first = 3 * (row as usize * width as usize + column as usize);
        for pixel in pixels[first..].chunks_exact(3).take(SMOOTHNESS as usize) {
            sums.iter_mut().zip(pixel).for_each(|(sum, part)| *sum += u32::from(*part));
        }
    }
    sums.map(|sum| (sum / (SMOOTHNESS * SMOOTHNESS)) as u8)
}

type Area<B> = DrawingArea<B, Shift>;
type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

fn cannot_draw(error: &impl std::error::Error) -> Failure {
    Failure::Fault(format!("cannot draw the plot: {error}"))
}

/// Makes the font known, once.
fn load_font() {
    static LOADED: OnceLock<()> = OnceLock::new();
    LOADED.get_or_init(|| {
        // A font that is part of the program is valid; without it, labels are missing.
        let _ = register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT);
    });
}

fn font(unit: u32, size: u32) -> TextStyle<'static> {
    (FONT, unit * size).into_text_style(&(0, 0))
}

fn at(unit: u32, points: u32) -> i32 {
    (unit * points) as i32
}

/// Draws a figure with its title and the names of its curves.
fn draw_figure<B: DrawingBackend>(
    area: &Area<B>,
    figure: &Figure,
    [across, up]: [Axis; 2],
    (unit, piece): (u32, usize),
) -> Drawn<B> {
    let (title, body) = area.split_vertically(unit * TITLE);
    draw_title(&title, figure, unit)?;
    let mut chart = ChartBuilder::on(&body)
        .margin_right(unit * 2 * MARGIN)
        .margin_bottom(unit * MARGIN)
        .x_label_area_size(unit * BELOW)
        .y_label_area_size(unit * BESIDE)
        .build_cartesian_2d(across, up)?;
    chart
        .configure_mesh()
        .bold_line_style(GRID.stroke_width(unit))
        .axis_style(FRAME.stroke_width(unit))
        .label_style(font(unit, 13).color(&INK))
        .x_desc(figure.axis())
        .axis_desc_style(font(unit, 13).color(&INK))
        .draw()?;
    for curve in &figure.curves {
        let color = color_of(curve);
        let points = curve.points.iter().map(|[x, y]| (*x, *y)).filter(|it| it.1.is_finite());
        match curve.form {
            Form::Line => {
                let points: Vec<(f64, f64)> = points.collect();
                let style = color.stroke_width(2 * unit);
                let line = |piece: &[_]| PathElement::new(piece.to_vec(), style);
                chart.draw_series(pieces(&points, piece).map(line))?;
            }
            Form::Bars(width) => {
                let bar = |(x, y)| {
                    let corners = [(x - 0.5 * width, 0.0), (x + 0.5 * width, y)];
                    Rectangle::new(corners, color.mix(0.7).filled())
                };
                chart.draw_series(points.map(bar))?;
            }
        }
    }
    Ok(())
}

/// Draws the title, and after it the names of the curves if there are several.
fn draw_title<B: DrawingBackend>(area: &Area<B>, figure: &Figure, unit: u32) -> Drawn<B> {
    let style = font(unit, 15).color(&INK);
    let (title, mut left) = (figure.heading(), at(unit, MARGIN));
    area.draw_text(&title, &style, (left, at(unit, 4)))?;
    if figure.curves.len() < 2 {
        return Ok(());
    }
    let width = |text: &str| area.estimate_text_size(text, &style).map(|(width, _)| width as i32);
    left += width(&title)? + at(unit, 20);
    for curve in &figure.curves {
        let (top, side) = (at(unit, 5), at(unit, 10));
        let patch = [(left, top), (left + side, top + side)];
        area.draw(&Rectangle::new(patch, color_of(curve).filled()))?;
        left += side + at(unit, 5);
        area.draw_text(&curve.name, &style, (left, at(unit, 4)))?;
        left += width(&curve.name)? + at(unit, 16);
    }
    Ok(())
}

/// Cuts a line into pieces of this many points, each of which begins where the one before ends.
fn pieces<T>(points: &[T], longest: usize) -> impl Iterator<Item = &[T]> {
    let starts = (0..points.len().saturating_sub(1)).step_by(longest - 1);
    starts.map(move |start| &points[start..start.saturating_add(longest).min(points.len())])
}

fn color_of(curve: &Curve) -> RGBColor {
    let [red, green, blue] = curve.hue.rgb();
    RGBColor(red, green, blue)
}
