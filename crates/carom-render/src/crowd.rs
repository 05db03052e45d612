//! The part of a drawing that a picture must show: all of it but balls far from the others.

use carom::DVec3;

use crate::bounds::Bounds;
use crate::drawing::{Drawing, Panel};
use crate::framing::Framing;

/// Free space around balls in a drawing without surfaces, in ball radii.
const ALONE: f64 = 0.8;

impl Framing {
    /// Returns the boxes around the surfaces of a drawing and its balls, without balls that are far
    /// from the others; `None` for an empty drawing.
    pub fn of_drawing(drawing: &Drawing) -> Option<Self> {
        let surfaces = Bounds::around(drawing.panels.iter().filter_map(Panel::bounds));
        let balls = crowd(drawing).or(surfaces)?;
        let radii = drawing.balls.iter().map(|ball| ball.radius);
        let radius = radii.sum::<f64>() / drawing.balls.len().max(1) as f64;
        let alone = surfaces.is_none().then(|| balls.grown(ALONE * radius));
        let whole = Bounds::around([Some(balls), surfaces, alone].into_iter().flatten());
        Some(Self { whole: whole.unwrap_or(balls), balls })
    }

    /// Returns the framing of a running scene: `first`, which its first seconds sweep, joined with
    /// what is drawn now. Balls that have left `first` count only once no ball is left in it: then
    /// only what is drawn now counts.
    pub fn of_run(first: Option<Self>, drawing: &Drawing) -> Self {
        let now = Self::of_drawing(drawing);
        let (Some(first), Some(now)) = (first, now) else {
            return first.or(now).unwrap_or(Self::UNIT);
        };
        let joined =
            |balls: Bounds| Self { whole: first.whole.with(balls), balls: first.balls.with(balls) };
        if first.whole.holds(&Bounds::at(now.balls.center())) {
            return joined(now.balls);
        }
        let staying = drawing.balls.iter().filter(|it| first.whole.holds(&Bounds::at(it.center)));
        let staying = staying.map(|ball| Bounds::from_sphere(ball.center, ball.radius));
        Bounds::around(staying).map_or(now, joined)
    }
}

/// Returns the box around the balls whose distance from the middle is at most `NEAR` times the
/// median distance.
fn crowd(drawing: &Drawing) -> Option<Bounds> {
    // In units of the median distance.
    const NEAR: f64 = 3.0;
    let balls = &drawing.balls;
    let median = |mut values: Vec<f64>| {
        let middle = values.len() / 2;
        (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
    };
    let along = |axis: usize| median(balls.iter().map(|ball| ball.center[axis]).collect());
    let middle = DVec3::new(along(0)?, along(1)?, along(2)?);
    let reach =
        median(balls.iter().map(|ball| ball.center.distance(middle) + ball.radius).collect())?;
    let near = balls.iter().filter(|ball| ball.center.distance(middle) <= NEAR * reach);
    Bounds::around(near.map(|ball| Bounds::from_sphere(ball.center, ball.radius)))
}
