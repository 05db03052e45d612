//! A ring around a ball, over the picture: nothing hides it.

use egui::{Color32, Painter, Pos2, Stroke};

/// Colours of the two lines: one of them stands out from any picture.
pub const LIGHT: Color32 = Color32::WHITE;
pub const DARK: Color32 = Color32::from_rgb(20, 24, 32);

/// Smallest radius of the ring, in points: a distant ball stays easy to find.
const SMALLEST: f32 = 7.0;

/// Draws a ring around a ball with this radius in points. Returns the radius of the ring.
pub fn draw(painter: &Painter, place: Pos2, radius: f32) -> f32 {
    let radius = radius.max(SMALLEST) + 2.0;
    painter.circle_stroke(place, radius, Stroke::new(4.5, DARK));
    painter.circle_stroke(place, radius, Stroke::new(2.0, LIGHT));
    radius
}
