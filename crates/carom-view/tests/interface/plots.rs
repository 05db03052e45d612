//! Plots show and save the right numbers.

use carom_render::Picture;
use carom_scene::{Library, Source};
use carom_session::Command;
use carom_view::{Desktop, Setup, Start};
use egui::Key;
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, desk, go_to, press, scene, setup};

/// Opens a built-in scene with its plots; files go to a folder.
fn plotting(name: &str, folder: &std::path::Path) -> Desk {
    let (scene, _) = Library::new().find(name, &[]).expect("a built-in scene");
    let start = Some(Start::Scene(Box::new(scene), Source::BuiltIn));
    let host = Box::new(Desktop::new(folder.to_owned()));
    let mut desk = desk(Setup { start, host, ..setup() });
    press(&mut desk, Key::G);
    desk
}

fn saved(folder: &std::path::Path, part: &str) -> Vec<u8> {
    let files = std::fs::read_dir(folder).expect("the folder was made");
    let mut paths = files.map(|it| it.expect("readable").path());
    let path = paths.find(|it| it.to_string_lossy().contains(part)).expect("a file was saved");
    std::fs::read(path).expect("readable")
}

#[test]
fn numbers_of_a_figure_are_saved_with_their_units() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = plotting("tutorial1", folder.path());
    go_to(&mut desk, 1.0);
    desk.get_by_label("Save the numbers of Energy").click();
    desk.run_steps(4);
    let text = String::from_utf8(saved(folder.path(), "-energy.csv")).expect("text");
    let mut lines = text.lines();
    let names = "\"time, s\",\"kinetic, J\",\"potential, J\",\"total, J\"";
    assert_eq!(lines.next(), Some(names));
    let view = scene(&desk).view();
    assert_eq!(lines.clone().count(), view.readings.len());
    let last = view.readings.last().expect("measured");
    let expected = [last.time, last.kinetic_energy, last.potential_energy, last.total_energy()];
    let found: Vec<f64> =
        lines.last().expect("rows").split(',').map(|it| it.parse().expect("a number")).collect();
    assert_eq!(found, expected);
}

#[test]
fn a_picture_of_the_plots_is_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = plotting("tutorial1", folder.path());
    go_to(&mut desk, 3.0);
    desk.get_by_label("PNG").click();
    desk.run_steps(8);
    let picture = Picture::from_png(&saved(folder.path(), "-plots.png")).expect("a picture");
    // Three plots in two columns, at twice the resolution of the window.
    assert!(picture.width >= 1600 && picture.height >= 900, "{} {}", picture.width, picture.height);
    let colors: std::collections::BTreeSet<_> = picture.pixels.chunks(4).collect();
    assert!(colors.len() > 20, "text and curves have many colours");
}

#[test]
fn a_gas_has_a_histogram_a_temperature_and_a_pressure() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = plotting("gas", folder.path());
    for shown in ["Energy", "Momentum"] {
        desk.get_by_label(shown).click();
    }
    desk.get_by_label("Gas").click();
    go_to(&mut desk, 0.6);
    desk.run_steps(3);
    desk.get_by_label("Save the numbers of Balls by speed").click();
    desk.run_steps(4);
    let text = String::from_utf8(saved(folder.path(), "balls-by-speed.csv")).expect("text");
    let rows = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    let counted: f64 = rows.map(|row| row[1].parse::<f64>().unwrap_or(0.0)).sum();
    assert_eq!(counted, scene(&desk).view().spheres.ids.len() as f64);
    assert!(desk.query_by_label_contains("Temperature, as k T, J").is_some());
    assert!(scene(&desk).view().now.pressure.is_some_and(|pressure| pressure > 0.0));
}

#[test]
fn a_picked_ball_is_plotted_from_the_start_and_through_phase_space() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut desk = plotting("tutorial1", folder.path());
    go_to(&mut desk, 1.0);
    let ball = scene(&desk).view().spheres.ids[0];
    desk.state_mut().command(Command::Pick(Some(ball)));
    desk.run_steps(4);
    let view = scene(&desk).view();
    assert_eq!(view.picked_readings.len() as u64, view.frame + 1);
    desk.get_by_label_contains("phase space");
    desk.get_by_label("Velocity along y, m/s");
}
