//! Plots of measured quantities.

mod distribution;
mod figure;

use carom::StageCounts;
use carom_render::Readback;
use carom_session::View;
use egui::{Context, Pos2, Rect, RichText, ScrollArea, Ui, UiBuilder, Vec2};
use serde::{Deserialize, Serialize};

pub use figure::Figure;
use figure::{BLUE, Curve, GREEN, GREY, RED};

use crate::layout::press_word;
use crate::studio::Studio;

/// The plots that are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct PlotChoice {
    /// Kinetic, potential and total energy.
    pub energy: bool,
    /// Components and magnitude of the momentum.
    pub momentum: bool,
    /// Impacts per second.
    pub impacts: bool,
    /// Height and speed of the picked ball, and its path in phase space.
    pub picked: bool,
    /// Speeds of all balls, their temperature and pressure.
    pub gas: bool,
    /// Work of each frame, by stage.
    pub work: bool,
    /// Axis of the plot in phase space: 0, 1, 2 for x, y, z.
    pub direction: usize,
}

impl Default for PlotChoice {
    fn default() -> Self {
        Self {
            energy: true,
            momentum: true,
            impacts: true,
            picked: true,
            gas: false,
            work: false,
            direction: 1,
        }
    }
}

/// What the user wants to save of the plots.
pub enum Wanted {
    /// A table; `name` is the end of its file name.
    Table { name: String, csv: String },
    /// A picture of these figures.
    Picture(Vec<Figure>),
}

/// Shows the selected plots below each other. From time `left` on \[s\] some balls have left; later
/// values set no scale. Returns what the user wants to save.
pub fn show(ui: &mut Ui, view: &View, left: Option<f64>, shown: &mut PlotChoice) -> Option<Wanted> {
    let mut wanted = None;
    ui.horizontal_wrapped(|ui| {
        ui.checkbox(&mut shown.energy, "Energy");
        ui.checkbox(&mut shown.momentum, "Momentum");
        ui.checkbox(&mut shown.impacts, "Impacts");
        ui.checkbox(&mut shown.picked, "Picked ball");
        ui.checkbox(&mut shown.gas, "Gas");
        ui.checkbox(&mut shown.work, "Work");
        if ui.small_button("PNG").on_hover_text("Save a picture of these plots").clicked() {
            wanted = Some(Wanted::Picture(all(view, left, shown)));
        }
    });
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let mut draw = |ui: &mut Ui, mut figures: Vec<Figure>| {
            scale(&mut figures, left);
            for figure in figures {
                if figure.show(ui) {
                    let name = figure.title.to_lowercase().replace(' ', "-");
                    wanted = Some(Wanted::Table { name, csv: figure.to_csv() });
                }
            }
        };
        draw(ui, over_time(view, shown));
        if shown.gas {
            draw(ui, gas(view));
        }
        if shown.picked {
            if view.picked.is_none() {
                let press = press_word(ui);
                ui.weak(format!("{press} on a ball to plot its height and speed."));
            } else {
                draw(ui, picked(view));
                ui.horizontal(|ui| {
                    for (i, name) in DIRECTIONS.iter().enumerate() {
                        ui.selectable_value(&mut shown.direction, i, *name);
                    }
                    ui.weak("phase space");
                });
                draw(ui, vec![phase_space(view, shown.direction)]);
            }
        }
        if shown.work {
            draw(ui, work(view));
        }
    });
    wanted
}

/// Returns the selected figures in order.
fn all(view: &View, left: Option<f64>, shown: &PlotChoice) -> Vec<Figure> {
    let mut figures = over_time(view, shown);
    if shown.gas {
        figures.extend(gas(view));
    }
    if shown.picked && view.picked.is_some() {
        figures.extend(picked(view));
        figures.push(phase_space(view, shown.direction));
    }
    if shown.work {
        figures.extend(work(view));
    }
    scale(&mut figures, left);
    figures
}

/// Excludes the time after some balls have left from the scale.
fn scale(figures: &mut [Figure], left: Option<f64>) {
    for figure in figures.iter_mut().filter(|figure| figure.mark.is_some()) {
        figure.scale_until = left;
    }
}

/// Size of a saved figure with title and margins, in points.
const PRINTED: Vec2 = Vec2::new(480.0, 250.0);

/// Height of the heading above saved figures, in points.
const HEADING: f32 = 40.0;

/// Starts to draw figures below a heading, in two columns if there are several.
pub fn print(figures: &[Figure], heading: &str, context: &Context, studio: &Studio) -> Readback {
    let columns = figures.len().clamp(1, 2);
    let rows = figures.len().div_ceil(columns).max(1);
    let size = PRINTED * Vec2::new(columns as f32, rows as f32) + Vec2::new(0.0, HEADING);
    studio.page(context, size, |ui| {
        let text = RichText::new(heading).size(18.0).strong();
        ui.put(
            Rect::from_min_size(Pos2::new(12.0, 8.0), Vec2::new(size.x - 24.0, 24.0)),
            |ui: &mut Ui| ui.horizontal(|ui| ui.label(text.clone())).response,
        );
        for (i, figure) in figures.iter().enumerate() {
            let place = Vec2::new((i % columns) as f32, (i / columns) as f32) * PRINTED;
            let corner = Pos2::new(0.0, HEADING) + place;
            let part = Rect::from_min_size(corner, PRINTED).shrink(12.0);
            ui.scope_builder(UiBuilder::new().max_rect(part).id_salt(i), |ui| {
                figure.print(ui, part.height() - 28.0);
            });
        }
    })
}

const DIRECTIONS: [&str; 3] = ["x", "y", "z"];

/// Returns the figures of all balls together.
fn over_time(view: &View, shown: &PlotChoice) -> Vec<Figure> {
    let mut figures = Vec::new();
    if view.other.is_some() {
        figures.push(distances(view));
    }
    if shown.energy {
        figures.push(energies(view));
    }
    if shown.momentum {
        figures.push(momenta(view));
    }
    if shown.impacts {
        let rate = Curve::line("all", BLUE, &view.readings, |it| (it.time, it.impact_rate));
        figures.push(Figure::over_time("Impacts per second", "", view.time, vec![rate]));
    }
    figures
}

fn energies(view: &View) -> Figure {
    let readings = &view.readings;
    let mut curves = vec![
        Curve::line("kinetic", RED, readings, |it| (it.time, it.kinetic_energy)),
        Curve::line("potential", GREEN, readings, |it| (it.time, it.potential_energy)),
        Curve::line("total", BLUE, readings, |it| (it.time, it.total_energy())),
    ];
    if let Some(other) = &view.other {
        for curve in &mut curves {
            curve.name = format!("{}, {}", curve.name, view.setup.simulation.rule);
        }
        let name = format!("total, {}", other.setup.simulation.rule);
        curves.push(Curve::line(name, GREY, &other.readings, |it| (it.time, it.total_energy())));
    }
    Figure::over_time("Energy", "J", view.time, curves)
}

/// Returns the table of energies over time.
pub fn energy_table(view: &View) -> Wanted {
    Wanted::Table { name: "energy".to_owned(), csv: energies(view).to_csv() }
}

fn momenta(view: &View) -> Figure {
    let readings = &view.readings;
    let curves = vec![
        Curve::line("x", RED, readings, |it| (it.time, it.momentum.x)),
        Curve::line("y", GREEN, readings, |it| (it.time, it.momentum.y)),
        Curve::line("z", BLUE, readings, |it| (it.time, it.momentum.z)),
        Curve::line("size", GREY, readings, |it| (it.time, it.momentum.length())),
    ];
    Figure::over_time("Momentum", "kg m/s", view.time, curves)
}

/// Returns the figures of the gas: speeds now, and temperature and, if known, pressure until now.
fn gas(view: &View) -> Vec<Figure> {
    let readings = &view.readings;
    let heat = Curve::line("k T", RED, readings, |it| (it.time, it.thermal_energy));
    let mut figures = vec![
        distribution::speeds(view),
        Figure::over_time("Temperature, as k T", "J", view.time, vec![heat]),
    ];
    if view.now.pressure.is_some() {
        let pressure = |it: &carom_session::Reading| (it.time, it.pressure.unwrap_or_default());
        let pressure = vec![Curve::line("p", BLUE, readings, pressure)];
        figures.push(Figure::over_time("Pressure of impacts", "Pa", view.time, pressure));
    }
    figures
}

fn picked(view: &View) -> Vec<Figure> {
    let Some(id) = view.picked else { return Vec::new() };
    let readings = &view.picked_readings;
    let height = vec![Curve::line("height", GREEN, readings, |it| (it.time, it.position.y))];
    let speed = vec![Curve::line("speed", RED, readings, |it| (it.time, it.velocity.length()))];
    vec![
        Figure::over_time(format!("Height of ball {id}"), "m", view.time, height),
        Figure::over_time(format!("Speed of ball {id}"), "m/s", view.time, speed),
    ]
}

/// Returns the path of the picked ball in phase space along one direction.
fn phase_space(view: &View, direction: usize) -> Figure {
    // A stored value may be out of range.
    let direction = direction.min(DIRECTIONS.len() - 1);
    let point = |it: &carom_session::PickedReading| {
        (it.position.to_array()[direction], it.velocity.to_array()[direction])
    };
    let path = vec![Curve::line("path", BLUE, &view.picked_readings, point)];
    let name = DIRECTIONS[direction];
    Figure::over(format!("Velocity along {name}"), "m/s", (format!("position {name}"), "m"), path)
}

/// Returns the work of each frame, with a figure for each stage, because the numbers differ by
/// orders of magnitude.
fn work(view: &View) -> Vec<Figure> {
    let figure = |title, color, count: fn(&StageCounts) -> u64| {
        let curve =
            Curve::line("all", color, &view.readings, |it| (it.time, count(&it.work) as f64));
        Figure::over_time(title, "", view.time, vec![curve])
    };
    vec![
        figure("Pair tests per frame", BLUE, |it| it.pair_tests),
        figure("Events per frame", GREEN, |it| it.events),
        figure("Solver iterations per frame", RED, |it| it.solver_iterations),
    ]
}

fn distances(view: &View) -> Figure {
    let curves = vec![
        Curve::line("largest", RED, &view.distances, |it| (it.time, it.largest)),
        Curve::line("root mean square", BLUE, &view.distances, |it| (it.time, it.root_mean_square)),
    ];
    Figure::over_time("Distance of the two", "m", view.time, curves)
}
