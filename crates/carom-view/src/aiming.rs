//! A drag from a ball as a blow of a cue: its direction, its speed, and the path as dots.

use carom::DVec3;
use egui::{Align2, Color32, FontId, Painter, Pos2, Vec2};

use crate::projection::Projection;
use crate::watching::three_digits;

/// Time in which a ball covers the drag that strikes it \[s\]: a drag over a billiard table breaks.
const DRAG_SECS: f64 = 0.25;

/// Radius of a dot of the path, in points.
const DOT: f32 = 2.0;

/// Colours of dots and text, and of their borders.
const INK: [Color32; 2] = [Color32::WHITE, Color32::from_black_alpha(200)];

/// Returns the velocity of a blow \[m/s\] on a ball towards the point of the table under the pointer; `None` on the ball.
pub fn blow(projection: &Projection, pointer: Pos2, center: DVec3, radius: f64) -> Option<DVec3> {
    let way = (projection.on_level(pointer, center.y)? - center).with_y(0.0);
    (way.length() > radius).then(|| way / DRAG_SECS)
}

/// Draws the path of a ball that is aimed, and the speed of the blow \[m/s\] at its beginning.
pub fn draw_path(painter: &Painter, projection: &Projection, path: &[DVec3], speed: Option<f64>) {
    let places = path.iter().filter_map(|point| projection.place(*point));
    for place in places {
        painter.circle_filled(place, DOT + 1.0, INK[1]);
        painter.circle_filled(place, DOT, INK[0]);
    }
    let Some((start, speed)) = path.first().zip(speed) else { return };
    let Some(place) = projection.place(*start) else { return };
    let text = format!("{} m/s", three_digits(speed));
    let galley = painter.layout_no_wrap(text, FontId::proportional(14.0), INK[0]);
    let size = galley.size() + Vec2::new(10.0, 4.0);
    let back = Align2::LEFT_TOP.anchor_size(place + Vec2::splat(12.0), size);
    painter.rect_filled(back, 4.0, INK[1]);
    painter.galley(back.min + Vec2::new(5.0, 2.0), galley, INK[0]);
}
