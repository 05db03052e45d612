//! The mark of the picked ball: a ring in two contrasting lines, a label, and the last part of its
//! path. It lies over the picture, so that no other ball hides it.

use carom::DVec3;
use carom_session::View;
use egui::{Align2, FontId, Painter, Stroke, Vec2};

use crate::look;
use crate::projection::Projection;
use crate::ring::{self, DARK, LIGHT};

/// Number of frames of the path.
const TRAIL: usize = 40;

/// Returns the text of the label; `None` without a picked ball.
pub(super) fn label(view: &View) -> Option<String> {
    let id = view.picked?;
    let speed = view.spheres.velocities[view.spheres.index_of(id)?].length();
    Some(format!("ball {id}, {} m/s", three_digits(speed)))
}

/// Formats a speed so that the label keeps its width.
pub fn three_digits(speed: f64) -> String {
    match speed {
        s if s != 0.0 && !(1e-2..1e4).contains(&s) => format!("{s:.1e}"),
        s if s < 10.0 => format!("{s:.2}"),
        s if s < 100.0 => format!("{s:.1}"),
        s => format!("{s:.0}"),
    }
}

/// Draws the mark of the picked ball of a view. Balls are drawn a part `blend` of the way from their
/// previous positions.
pub(super) fn draw(painter: &Painter, view: &View, blend: f64, projection: &Projection) {
    let Some(index) = view.picked.and_then(|id| view.spheres.index_of(id)) else { return };
    let center = look::place(view, index, blend);
    trail(painter, view, center, projection);
    let radius = view.spheres.radii[index];
    let Some((place, radius)) = projection.place(center).zip(projection.radius(center, radius))
    else {
        return;
    };
    let radius = ring::draw(painter, place, radius);
    let Some(text) = label(view) else { return };
    let galley = painter.layout_no_wrap(text, FontId::proportional(13.0), LIGHT);
    let corner = place + Vec2::new(0.72 * radius + 4.0, -0.72 * radius - 4.0);
    let size = galley.size() + Vec2::new(10.0, 4.0);
    let back = Align2::LEFT_BOTTOM.anchor_size(corner, size);
    // Within the picture also where the ball is at its edge.
    let inside = projection.rect.shrink(2.0);
    let back = back.translate((inside.min - back.min).max(Vec2::ZERO));
    let back = back.translate((inside.max - back.max).min(Vec2::ZERO));
    painter.rect_filled(back, 4.0, DARK.gamma_multiply(0.85));
    painter.galley(back.min + Vec2::new(5.0, 2.0), galley, LIGHT);
}

/// Draws the last part of the path, which fades towards its beginning.
fn trail(painter: &Painter, view: &View, now: DVec3, projection: &Projection) {
    let readings = &view.picked_readings;
    let last = &readings[readings.len().saturating_sub(TRAIL)..];
    // The drawn ball may be before the last reading.
    let points = last.iter().filter(|it| it.time < view.time).map(|it| it.position);
    let points: Vec<DVec3> = points.chain([now]).collect();
    let steps = points.windows(2).map(|pair| pair[0].distance(pair[1]));
    let usual = steps.clone().sum::<f64>() / points.len() as f64;
    for (i, (pair, step)) in points.windows(2).zip(steps).enumerate() {
        let ends = projection.place(pair[0]).zip(projection.place(pair[1]));
        // A jump through the edge of a periodic box is no path.
        let Some((from, to)) = ends.filter(|_| step < 8.0 * usual) else { continue };
        let strength = (i + 1) as f32 / points.len() as f32;
        painter.line_segment([from, to], Stroke::new(3.5, DARK.gamma_multiply(0.7 * strength)));
        painter.line_segment([from, to], Stroke::new(1.5, LIGHT.gamma_multiply(strength)));
    }
}
