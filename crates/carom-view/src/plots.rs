//! Plots of what is measured.

use carom::StageCounts;
use carom_session::View;
use egui::{Color32, RichText, ScrollArea, Ui};
use egui_plot::{AxisHints, GridInput, GridMark, Line, Plot, PlotPoint, PlotPoints, VLine};

/// Which plots are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shown {
    /// Kinetic, potential and total energy.
    pub energy: bool,
    /// Parts and size of the momentum.
    pub momentum: bool,
    /// Impacts per second.
    pub impacts: bool,
    /// Height and speed of the picked ball.
    pub picked: bool,
    /// Work of each frame, by stage.
    pub work: bool,
}

impl Default for Shown {
    fn default() -> Self {
        Self { energy: true, momentum: true, impacts: true, picked: true, work: false }
    }
}

const HEIGHT: f32 = 118.0;
const BLUE: Color32 = Color32::from_rgb(66, 133, 214);
const GREEN: Color32 = Color32::from_rgb(60, 160, 100);
const RED: Color32 = Color32::from_rgb(214, 80, 70);
const GREY: Color32 = Color32::from_rgb(140, 140, 150);

/// One line of a plot.
struct Curve<'a> {
    name: &'a str,
    color: Color32,
    points: Vec<PlotPoint>,
}

/// All plots that are switched on, below each other, over the same time.
pub fn show(ui: &mut Ui, view: &View, shown: &mut Shown) {
    ui.horizontal_wrapped(|ui| {
        ui.checkbox(&mut shown.energy, "Energy");
        ui.checkbox(&mut shown.momentum, "Momentum");
        ui.checkbox(&mut shown.impacts, "Impacts");
        ui.checkbox(&mut shown.picked, "Picked ball");
        ui.checkbox(&mut shown.work, "Work");
    });
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        if view.other.is_some() {
            distances(ui, view);
        }
        if shown.energy {
            energies(ui, view);
        }
        if shown.momentum {
            momenta(ui, view);
        }
        if shown.impacts {
            impact_rates(ui, view);
        }
        if shown.picked {
            picked(ui, view);
        }
        if shown.work {
            work(ui, view);
        }
    });
}

fn curve<'a, T>(
    name: &'a str,
    color: Color32,
    readings: &[T],
    point: impl Fn(&T) -> (f64, f64),
) -> Curve<'a> {
    let point = |reading| {
        let (x, y) = point(reading);
        PlotPoint::new(x, y)
    };
    Curve { name, color, points: readings.iter().map(point).collect() }
}

fn plot(ui: &mut Ui, title: &str, now: f64, curves: Vec<Curve>) {
    ui.horizontal_wrapped(|ui| {
        ui.strong(title);
        // Above the curves: within, a legend would cover them.
        if curves.len() > 1 {
            for Curve { name, color, .. } in &curves {
                ui.label(RichText::new(format!("■ {name}")).color(*color).small());
            }
        }
    });
    Plot::new(title)
        .height(HEIGHT)
        .allow_scroll(false)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_boxed_zoom(false)
        .include_x(0.0)
        .custom_x_axes(vec![AxisHints::new_x().label_spacing(30.0..=80.0)])
        .y_grid_spacer(marks)
        .custom_y_axes(vec![
            AxisHints::new_y()
                .label_spacing(1.0..=2.0)
                .min_thickness(46.0)
                .formatter(|mark, _| text_of(mark)),
        ])
        .show(ui, |plot| {
            for Curve { name, color, points } in curves {
                plot.line(Line::new(name, PlotPoints::Owned(points)).color(color));
            }
            plot.vline(VLine::new("", now).color(GREY.gamma_multiply(0.6)).width(1.0));
        });
}

/// Round numbers along an axis, so few that there is room to write all of them.
fn marks(axis: GridInput) -> Vec<GridMark> {
    const PARTS: f64 = 4.0;
    // More than this, or numbers that steps no longer tell apart, would not end.
    const MOST: f64 = 20.0;
    let (min, max) = axis.bounds;
    let least = (max - min) / PARTS;
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

/// A number of an axis, with as many digits as tell it from the next.
fn text_of(mark: GridMark) -> String {
    let GridMark { value, step_size } = mark;
    if value == 0.0 {
        return "0".to_owned();
    }
    // Beyond these, zeros would be counted.
    if !(1e-4..1e6).contains(&step_size) {
        let digits = (value.abs().log10().floor() - step_size.log10().floor()).max(0.0);
        return format!("{value:.*e}", digits as usize);
    }
    let decimals = (-step_size.log10()).ceil().max(0.0);
    format!("{value:.*}", decimals as usize)
}

fn energies(ui: &mut Ui, view: &View) {
    let readings = &view.readings;
    let mut curves = vec![
        curve("kinetic", RED, readings, |it| (it.time, it.kinetic_energy)),
        curve("potential", GREEN, readings, |it| (it.time, it.potential_energy)),
        curve("total", BLUE, readings, |it| (it.time, it.total_energy())),
    ];
    if let Some(other) = &view.other {
        let total = curve("total, right", GREY, &other.readings, |it| (it.time, it.total_energy()));
        curves.push(total);
    }
    plot(ui, "Energy, J", view.time, curves);
}

fn momenta(ui: &mut Ui, view: &View) {
    let readings = &view.readings;
    let curves = vec![
        curve("x", RED, readings, |it| (it.time, it.momentum.x)),
        curve("y", GREEN, readings, |it| (it.time, it.momentum.y)),
        curve("z", BLUE, readings, |it| (it.time, it.momentum.z)),
        curve("size", GREY, readings, |it| (it.time, it.momentum.length())),
    ];
    plot(ui, "Momentum, kg m/s", view.time, curves);
}

fn impact_rates(ui: &mut Ui, view: &View) {
    let curves = vec![curve("all", BLUE, &view.readings, |it| (it.time, it.impact_rate))];
    plot(ui, "Impacts per second", view.time, curves);
}

fn picked(ui: &mut Ui, view: &View) {
    let Some(id) = view.picked else {
        ui.weak("Click on a ball to plot its height and speed.");
        return;
    };
    let readings = &view.picked_readings;
    let height = vec![curve("height", GREEN, readings, |it| (it.time, it.height))];
    plot(ui, &format!("Height of ball {id}, m"), view.time, height);
    let speed = vec![curve("speed", RED, readings, |it| (it.time, it.speed))];
    plot(ui, &format!("Speed of ball {id}, m/s"), view.time, speed);
}

/// Work of each frame by stage, a plot for each: the numbers differ by orders of magnitude.
fn work(ui: &mut Ui, view: &View) {
    let count = |name, color, count: fn(&StageCounts) -> u64| {
        curve(name, color, &view.readings, |it| (it.time, count(&it.work) as f64))
    };
    for (title, color, of) in [
        ("Pair tests per frame", BLUE, (|it| it.pair_tests) as fn(&StageCounts) -> u64),
        ("Events per frame", GREEN, |it| it.events),
        ("Solver iterations per frame", RED, |it| it.solver_iterations),
    ] {
        plot(ui, title, view.time, vec![count("all", color, of)]);
    }
}

fn distances(ui: &mut Ui, view: &View) {
    let curves = vec![
        curve("largest", RED, &view.distances, |it| (it.time, it.largest)),
        curve("root mean square", BLUE, &view.distances, |it| (it.time, it.root_mean_square)),
    ];
    plot(ui, "Distance of the two, m", view.time, curves);
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
        for (min, max) in [(0.0, 4e-9), (0.3, 0.31), (-1e9, 2.0), (5e3, 6.7e3), (-1.0, 1e-3)] {
            let count = values((min, max)).len();
            assert!((2..=6).contains(&count), "{min} to {max}: {count}");
        }
        for (min, max) in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            assert_eq!(values((min, max)), [0.0; 0], "{min} to {max}");
        }
    }
}
