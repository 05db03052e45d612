//! Figures of everything that is measured during a run: what the window plots and what the command line
//! draws.

mod axis;
mod distribution;
mod figure;

use carom::{DVec3, StageCounts};

pub use axis::{Marks, Scale};
pub use distribution::speeds;
pub use figure::{Curve, Figure, Form, Hue, TableStyle, table};

use crate::readings::{PickedReading, Reading};
use crate::view::View;

/// Names of the directions of space.
pub const DIRECTIONS: [&str; 3] = ["x", "y", "z"];

/// Returns the kinetic, the potential and the total energy, with the total of the other rule where two
/// are compared.
pub fn energies(view: &View) -> Figure {
    let readings = &view.readings;
    let mut curves = vec![
        Curve::line("kinetic", Hue::Red, readings, |it| (it.time, it.kinetic_energy)),
        Curve::line("potential", Hue::Green, readings, |it| (it.time, it.potential_energy)),
        Curve::line("total", Hue::Blue, readings, |it| (it.time, it.total_energy())),
    ];
    if let Some(other) = &view.other {
        for curve in &mut curves {
            curve.name = format!("{}, {}", curve.name, view.setup.simulation.rule);
        }
        let rule = other.setup.simulation.rule;
        let side = if rule == view.setup.simulation.rule { ", right" } else { "" };
        let name = format!("total, {rule}{side}");
        curves
            .push(Curve::line(name, Hue::Grey, &other.readings, |it| (it.time, it.total_energy())));
    }
    Figure::over_time("Energy", "J", view.time, curves)
}

/// Returns the components and the size of the momentum.
pub fn momenta(view: &View) -> Figure {
    let readings = &view.readings;
    let curves = vec![
        Curve::line("x", Hue::Red, readings, |it| (it.time, it.momentum.x)),
        Curve::line("y", Hue::Green, readings, |it| (it.time, it.momentum.y)),
        Curve::line("z", Hue::Blue, readings, |it| (it.time, it.momentum.z)),
        Curve::line("size", Hue::Grey, readings, |it| (it.time, it.momentum.length())),
    ];
    Figure::over_time("Momentum", "kg m/s", view.time, curves)
}

/// Returns the impacts per second of all balls.
pub fn impact_rate(view: &View) -> Figure {
    let rate = Curve::line("all", Hue::Blue, &view.readings, |it| (it.time, it.impact_rate));
    Figure::over_time("Impacts per second", "", view.time, vec![rate])
}

/// Returns the figures of the gas: speeds now, and temperature and, if known, pressure until now.
pub fn gas(view: &View) -> Vec<Figure> {
    let mut figures = vec![speeds(view)];
    figures.extend(thermodynamics(view));
    figures
}

/// Returns the temperature of the gas and, if known, its pressure.
pub fn thermodynamics(view: &View) -> Vec<Figure> {
    let readings = &view.readings;
    let heat = Curve::line("k T", Hue::Red, readings, |it| (it.time, it.thermal_energy));
    let mut figures = vec![Figure::over_time("Temperature, as k T", "J", view.time, vec![heat])];
    if view.now.pressure.is_some() {
        let pressure = |it: &Reading| (it.time, it.pressure.unwrap_or_default());
        let pressure = vec![Curve::line("p", Hue::Blue, readings, pressure)];
        figures.push(Figure::over_time("Pressure of impacts", "Pa", view.time, pressure));
    }
    figures
}

/// Returns the height and the speed of the picked ball; nothing while none is picked.
pub fn picked(view: &View) -> Vec<Figure> {
    if view.picked.is_none() { Vec::new() } else { vec![height(view), speed(view)] }
}

/// Returns the height of the picked ball.
pub fn height(view: &View) -> Figure {
    let at = |it: &PickedReading| (it.time, it.position.y);
    of_picked(
        view,
        "Height",
        "m",
        vec![Curve::line("height", Hue::Green, &view.picked_readings, at)],
    )
}

/// Returns the speed of the picked ball.
pub fn speed(view: &View) -> Figure {
    let at = |it: &PickedReading| (it.time, it.velocity.length());
    of_picked(view, "Speed", "m/s", vec![Curve::line("speed", Hue::Red, &view.picked_readings, at)])
}

/// Returns the coordinates of the picked ball.
pub fn position(view: &View) -> Figure {
    of_picked(view, "Position", "m", components(view, |it| it.position))
}

/// Returns the components of the velocity of the picked ball.
pub fn velocity(view: &View) -> Figure {
    of_picked(view, "Velocity", "m/s", components(view, |it| it.velocity))
}

/// Returns a curve for each component of a vector of the picked ball.
fn components(view: &View, of: impl Fn(&PickedReading) -> DVec3) -> Vec<Curve> {
    let hues = [Hue::Red, Hue::Green, Hue::Blue];
    let curve = |axis: usize| {
        let at = |it: &PickedReading| (it.time, of(it)[axis]);
        Curve::line(DIRECTIONS[axis], hues[axis], &view.picked_readings, at)
    };
    (0..DIRECTIONS.len()).map(curve).collect()
}

/// Returns a figure over time that the picked ball is named in.
fn of_picked(view: &View, quantity: &str, unit: &'static str, curves: Vec<Curve>) -> Figure {
    let ball = view.picked.map(|id| format!(" of ball {id}")).unwrap_or_default();
    Figure::over_time(format!("{quantity}{ball}"), unit, view.time, curves)
}

/// Returns the path of the picked ball in phase space along a direction: 0, 1, 2 for x, y, z.
pub fn phase_space(view: &View, direction: usize) -> Figure {
    // A stored value may be out of range.
    let direction = direction.min(DIRECTIONS.len() - 1);
    let point =
        |it: &PickedReading| (it.position.to_array()[direction], it.velocity.to_array()[direction]);
    let path = vec![Curve::line("path", Hue::Blue, &view.picked_readings, point)];
    let name = DIRECTIONS[direction];
    Figure::over(format!("Velocity along {name}"), "m/s", (format!("position {name}"), "m"), path)
}

/// Returns the work of each frame, with a figure for each stage, because the numbers differ by
/// orders of magnitude.
pub fn work(view: &View) -> Vec<Figure> {
    let figure = |title, color, count: fn(&StageCounts) -> u64| {
        let curve =
            Curve::line("all", color, &view.readings, |it| (it.time, count(&it.work) as f64));
        Figure::over_time(title, "", view.time, vec![curve])
    };
    vec![
        figure("Pair tests per frame", Hue::Blue, |it| it.pair_tests),
        figure("Events per frame", Hue::Green, |it| it.events),
        figure("Solver iterations per frame", Hue::Red, |it| it.solver_iterations),
    ]
}

/// Returns the distances of the balls under the two rules that are compared.
pub fn distances(view: &View) -> Figure {
    let curves = vec![
        Curve::line("largest", Hue::Red, &view.distances, |it| (it.time, it.largest)),
        Curve::line("root mean square", Hue::Blue, &view.distances, |it| {
            (it.time, it.root_mean_square)
        }),
    ];
    let figure = Figure::over_time("Distance of the two", "m", view.time, curves);
    // What differs a little grows exponentially where balls meet.
    Figure { scale: Scale::Logarithmic, ..figure }
}
