//! The transport bar: play, step, and move through time.

use carom_session::{Command, FASTEST, SLOWEST, View};
use egui::{
    Align, Button, DragValue, Layout, Rangef, Rect, RichText, Slider, Stroke, Ui, Vec2, Widget,
};

use crate::action::Action;
use crate::layout::{has_sheets, is_compact, is_narrow};

/// Speeds that the keys select.
const SPEEDS: [f64; 9] = [SLOWEST, 0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 5.0, FASTEST];

/// Size of the button that plays and pauses, in points: the largest control.
const PLAY: Vec2 = Vec2::new(92.0, 32.0);

/// Shows the bar below the picture. Returns the actions of the pressed buttons.
pub fn show(
    ui: &mut Ui,
    view: &View,
    is_recording: bool,
    commands: &mut Vec<Command>,
) -> Vec<Action> {
    let mut actions = Vec::new();
    let is_narrow = is_narrow(ui);
    // An embedded window has no room for a large button.
    let has_large = !is_compact(ui);
    ui.horizontal(|ui| {
        let (symbol, text) = if view.playback.playing { ("⏸", "Pause") } else { ("▶", "Play") };
        if has_large && large_play_button(ui, symbol, text) {
            actions.push(Action::PlayOrPause);
        }
        let mut button = |ui: &mut Ui, symbol: &str, text: &str, action: Action| {
            if small_button(ui, symbol, text, action) {
                actions.push(action);
            }
        };
        button(ui, "⏮", "Restart", Action::Restart);
        button(ui, "⏴", "Step back", Action::StepBack);
        if !has_large {
            button(ui, symbol, text, Action::PlayOrPause);
        }
        button(ui, "⏵", "Step", Action::Step);
        for (symbol, text, action, count) in
            [("↩", "Undo", Action::Undo, view.undoable), ("↪", "Redo", Action::Redo, view.redoable)]
        {
            ui.add_enabled_ui(count > 0, |ui| button(ui, symbol, text, action));
        }
        if !is_narrow {
            speed(ui, view, commands);
            ui.separator();
            clock(ui, view);
            // What comes and goes is at the far end, so that time and time line keep their places.
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                recording(ui, is_recording);
                pace(ui, view);
                way(ui, view, commands);
            });
        }
    });
    if is_narrow {
        ui.horizontal(|ui| {
            speed(ui, view, commands);
            clock(ui, view);
            recording(ui, is_recording);
            pace(ui, view);
        });
        ui.horizontal(|ui| way(ui, view, commands));
    }
    actions
}

/// Shows the button that plays and pauses; returns whether it was pressed.
fn large_play_button(ui: &mut Ui, symbol: &str, text: &str) -> bool {
    let selection = ui.visuals().selection;
    let label = RichText::new(format!("{symbol}  {text}")).size(15.0).color(selection.stroke.color);
    let size = PLAY.max(ui.spacing().interact_size);
    let button = Button::new(label).fill(selection.bg_fill).min_size(size);
    let response = ui.add(button);
    let hint = Action::PlayOrPause.hint();
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, text));
    response.on_hover_text(hint).clicked()
}

/// Shows a button with a symbol; returns whether it was pressed.
fn small_button(ui: &mut Ui, symbol: &str, text: &str, action: Action) -> bool {
    let response = ui.button(RichText::new(symbol).size(15.0));
    let response = response.on_hover_text(format!("{text} ({})", action.keys()));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, text));
    response.clicked()
}

/// Shows the time.
fn clock(ui: &mut Ui, view: &View) {
    ui.monospace(format!("t = {:9.4} s", view.time)).on_hover_text(format!(
        "frame {} of {} s each",
        view.frame, view.setup.simulation.frame_time
    ));
}

/// Shows that a film is being recorded.
fn recording(ui: &mut Ui, is_recording: bool) {
    if is_recording {
        ui.colored_label(ui.visuals().error_fg_color, "⏺ recording");
    }
}

/// Shows the time line in the rest of the line.
fn way(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if view.seeking.is_some() && ui.button("Stop").clicked() {
            commands.push(Command::StopSeeking);
        }
        time_line(ui, view, commands);
    });
}

/// Returns the next faster or slower speed of the list.
pub fn next_speed(speed: f64, faster: bool) -> f64 {
    // Relative difference below which two speeds count as equal.
    const SAME: f64 = 1e-6;
    let mut found = SPEEDS
        .iter()
        .copied()
        .filter(|it| if faster { *it > speed * (1.0 + SAME) } else { *it < speed * (1.0 - SAME) });
    let next = if faster { found.next() } else { found.next_back() };
    next.unwrap_or(speed)
}

fn speed(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    let mut speed = view.playback.speed;
    ui.spacing_mut().slider_width = 90.0;
    let text = |speed: f64, _| {
        if speed < 0.995 {
            format!("1/{:.3}", 1.0 / speed).trim_end_matches('0').trim_end_matches('.').to_owned()
                + "x"
        } else {
            format!("{speed:.1}x")
        }
    };
    let response = if has_sheets(ui) && !is_narrow(ui) {
        // The time line needs the room of the slider.
        let number = DragValue::new(&mut speed).range(SLOWEST..=FASTEST).speed(0.01);
        number.custom_formatter(text).custom_parser(parse_speed).ui(ui)
    } else {
        let slider = Slider::new(&mut speed, SLOWEST..=FASTEST).logarithmic(true);
        slider.custom_formatter(text).custom_parser(parse_speed).ui(ui)
    };
    let response = response.on_hover_text("Speed");
    if response.changed() {
        commands.push(Command::Speed(speed));
    }
    if response.double_clicked() {
        commands.push(Command::Speed(1.0));
    }
}

/// Parses `1/20x`, `0.05` or `2x`.
fn parse_speed(text: &str) -> Option<f64> {
    let text = text.trim().trim_end_matches('x').trim();
    match text.split_once('/') {
        Some((above, below)) => {
            Some(above.trim().parse::<f64>().ok()? / below.trim().parse::<f64>().ok()?)
        }
        None => text.parse().ok(),
    }
}

/// Shows a warning if the machine cannot keep up.
fn pace(ui: &mut Ui, view: &View) {
    let playback = &view.playback;
    if playback.playing && !playback.keeps_up {
        let reached = playback.realtime_factor.unwrap_or_default();
        let word = if has_sheets(ui) { "only" } else { "slower than chosen:" };
        let text = format!("{word} {reached:.2}x");
        ui.colored_label(ui.visuals().warn_fg_color, text)
            .on_hover_text("This machine cannot keep up. Nothing is left out: time goes slower.");
    }
}

fn time_line(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    let end = view.furthest.max(view.setup.simulation.frame_time);
    let shown = match view.seeking {
        Some(frame) => frame as f64 * view.setup.simulation.frame_time,
        None => view.time,
    };
    let mut time = shown.min(end);
    ui.spacing_mut().slider_width = (ui.available_width() - 90.0).max(60.0);
    let slider = Slider::new(&mut time, 0.0..=end).show_value(false);
    ui.label(RichText::new(format!("{end:.1} s")).weak());
    let response = slider.ui(ui).on_hover_text(if view.edits.is_empty() {
        "Time line: go to another time"
    } else {
        "Time line: go to another time. The marks are edits."
    });
    marks(ui, view, response.rect, end);
    response.widget_info(|| egui::WidgetInfo::slider(true, time, "Time line"));
    if response.changed() {
        commands.push(Command::Seek(time));
    }
}

/// Marks the times of edits on the time line, which fills `line` and ends at `end` \[s\].
fn marks(ui: &Ui, view: &View, line: Rect, end: f64) {
    // The middle of the knob is at the present time, so the line is shorter by its width.
    let along = line.x_range().shrink(line.height() / 2.5);
    let painter = ui.painter_at(line);
    let color = ui.visuals().warn_fg_color;
    for time in view.edits.iter().filter(|time| **time <= end) {
        let x = along.min + (*time / end) as f32 * along.span();
        let upper = Rangef::new(line.top(), line.top() + 0.35 * line.height());
        painter.vline(x, upper, Stroke::new(2.0, color));
    }
}
