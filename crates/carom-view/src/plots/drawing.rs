//! Draws figures.

use carom_session::figures::{Figure, Form, Hue, Marks, Scale};
use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, RichText, TextStyle, Ui};
use egui_plot::{AxisHints, Bar, BarChart, GridInput, GridMark, Line, Plot, PlotPoints, VLine};

const HEIGHT: f32 = 132.0;

/// Draws a figure and its title. Returns whether the user wants to save its numbers.
pub fn show(figure: &Figure, ui: &mut Ui) -> bool {
    let is_wanted = ui.horizontal(|ui| {
        ui.strong(figure.heading());
        let save = ui.small_button(RichText::new("CSV").size(9.0));
        let save = save.on_hover_text("Save the numbers of this figure");
        save.widget_info(|| {
            let text = format!("Save the numbers of {}", figure.title);
            egui::WidgetInfo::labeled(egui::Role::Button, true, text)
        });
        save.clicked()
    });
    // Names on a line of their own: in a narrow panel they would wrap onto the plot.
    if figure.curves.len() > 1 {
        ui.horizontal_wrapped(|ui| name_curves(figure, ui));
    }
    plot(figure, ui, if figure.mark.is_some() { HEIGHT } else { 1.5 * HEIGHT });
    is_wanted.inner
}

/// Draws a figure without controls, with this height in points below its title.
pub fn print(figure: &Figure, ui: &mut Ui, height: f32) {
    ui.horizontal_wrapped(|ui| {
        ui.strong(figure.heading());
        name_curves(figure, ui);
    });
    plot(figure, ui, height);
}

/// Shows the names of the curves if there are several. A legend inside the plot would cover them.
fn name_curves(figure: &Figure, ui: &mut Ui) {
    if figure.curves.len() > 1 {
        for curve in &figure.curves {
            ui.label(legend(ui, &curve.name, color_of(curve.hue)));
        }
    }
}

fn plot(figure: &Figure, ui: &mut Ui, height: f32) {
    let scale = figure.scale;
    let text = |scale: Scale| {
        move |mark: GridMark, _: &_| scale.text(scale.value(mark.value), mark.step_size)
    };
    let across = AxisHints::new_x().label_spacing(1.0..=2.0).formatter(text(Scale::Linear));
    let across = across.label(figure.axis());
    let up = AxisHints::new_y().label_spacing(1.0..=2.0).min_thickness(46.0);
    let mut plot = Plot::new(&figure.title)
        .height(height)
        .allow_scroll(false)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_boxed_zoom(false)
        .custom_x_axes(vec![across])
        .x_grid_spacer(|axis| marks(Scale::Linear, axis))
        .y_grid_spacer(move |axis| marks(scale, axis))
        .custom_y_axes(vec![up.formatter(text(scale))]);
    if figure.mark.is_some() {
        plot = plot.include_x(0.0);
    }
    if figure.curves.iter().all(|curve| curve.points.len() < 2) {
        // A single value has no range.
        plot = plot.include_x(0.0).include_x(1.0);
    }
    plot.show(ui, |plot| {
        for curve in &figure.curves {
            let color = color_of(curve.hue);
            if let Form::Bars(width) = curve.form {
                let bar = |[x, y]: &[f64; 2]| Bar::new(*x, *y).width(width);
                let bars = curve.points.iter().map(bar).collect();
                plot.bar_chart(BarChart::new(&curve.name, bars).color(color.gamma_multiply(0.7)));
            } else {
                let places = curve.points.iter().map(|[x, y]| [*x, scale.place(*y)]);
                let points = PlotPoints::from_iter(places.filter(|[_, y]| y.is_finite()));
                plot.line(Line::new(&curve.name, points).color(color));
            }
        }
        if let Some(mark) = figure.mark {
            let color = color_of(Hue::Grey).gamma_multiply(0.6);
            plot.vline(VLine::new("", mark).color(color).width(1.0));
        }
        if let Some((low, high)) = figure.bounds() {
            plot.set_plot_bounds_y(low..=high);
        }
    });
}

fn color_of(hue: Hue) -> Color32 {
    let [red, green, blue] = hue.rgb();
    Color32::from_rgb(red, green, blue)
}

/// Returns the marks of an axis.
fn marks(scale: Scale, axis: GridInput) -> Vec<GridMark> {
    let Marks { values, step } = scale.marks(axis.bounds.0, axis.bounds.1);
    let mark = |value| GridMark { value: scale.place(value), step_size: step };
    values.into_iter().map(mark).collect()
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
