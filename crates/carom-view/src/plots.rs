//! Plots of what is measured.

use carom::StageCounts;
use carom_session::View;
use egui::{Color32, ScrollArea, Ui};
use egui_plot::{AxisHints, Legend, Line, Plot, PlotPoint, PlotPoints, VLine};

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
    ui.strong(title);
    Plot::new(title)
        .height(HEIGHT)
        .legend(Legend::default())
        .allow_scroll(false)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_boxed_zoom(false)
        .include_x(0.0)
        .custom_x_axes(vec![AxisHints::new_x().label_spacing(30.0..=80.0)])
        .custom_y_axes(vec![AxisHints::new_y().label_spacing(12.0..=30.0).min_thickness(46.0)])
        .show(ui, |plot| {
            for Curve { name, color, points } in curves {
                plot.line(Line::new(name, PlotPoints::Owned(points)).color(color));
            }
            plot.vline(VLine::new("", now).color(GREY.gamma_multiply(0.6)).width(1.0));
        });
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
