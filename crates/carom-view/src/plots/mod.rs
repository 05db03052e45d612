//! Plots of measured quantities.

mod drawing;

use carom_render::Readback;
use carom_session::View;
use carom_session::figures::{self, DIRECTIONS, Figure};
use egui::{Context, Pos2, Rect, RichText, ScrollArea, Ui, UiBuilder, Vec2};
use serde::{Deserialize, Serialize};

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
                if drawing::show(&figure, ui) {
                    let name = figure.title.to_lowercase().replace(' ', "-");
                    wanted = Some(Wanted::Table { name, csv: figure.to_csv() });
                }
            }
        };
        draw(ui, over_time(view, shown));
        if shown.gas {
            draw(ui, figures::gas(view));
        }
        if shown.picked {
            if view.picked.is_none() {
                let press = press_word(ui);
                ui.weak(format!("{press} on a ball to plot its height and speed."));
            } else {
                draw(ui, figures::picked(view));
                ui.horizontal(|ui| {
                    for (i, name) in DIRECTIONS.iter().enumerate() {
                        ui.selectable_value(&mut shown.direction, i, *name);
                    }
                    ui.weak("phase space");
                });
                draw(ui, vec![figures::phase_space(view, shown.direction)]);
            }
        }
        if shown.work {
            draw(ui, figures::work(view));
        }
    });
    wanted
}

/// Returns the selected figures in order.
fn all(view: &View, left: Option<f64>, shown: &PlotChoice) -> Vec<Figure> {
    let mut figures = over_time(view, shown);
    if shown.gas {
        figures.extend(figures::gas(view));
    }
    if shown.picked && view.picked.is_some() {
        figures.extend(figures::picked(view));
        figures.push(figures::phase_space(view, shown.direction));
    }
    if shown.work {
        figures.extend(figures::work(view));
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
                drawing::print(figure, ui, part.height() - 28.0);
            });
        }
    })
}

/// Returns the figures of all balls together.
fn over_time(view: &View, shown: &PlotChoice) -> Vec<Figure> {
    let mut figures = Vec::new();
    if view.other.is_some() {
        figures.push(figures::distances(view));
    }
    if shown.energy {
        figures.push(figures::energies(view));
    }
    if shown.momentum {
        figures.push(figures::momenta(view));
    }
    if shown.impacts {
        figures.push(figures::impact_rate(view));
    }
    figures
}

/// Returns the table of energies over time.
pub fn energy_table(view: &View) -> Wanted {
    Wanted::Table { name: "energy".to_owned(), csv: figures::energies(view).to_csv() }
}
