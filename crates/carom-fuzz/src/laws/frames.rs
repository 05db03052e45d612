//! The same world in frames of a third of the length: under `exact` a frame only says when to look.

use carom_scene::Scene;
use carom_scene::scene::{Boundary, Rule};

use super::keeps::is_driven;
use super::pair::{Agreement, Law, Pair};
use super::trace::Trace;

pub const LAW: Law = Law { name: "in other frames", pair };

fn pair(scene: &Scene, _: &Trace) -> Option<Pair> {
    // In a periodic box what moves has no images: it is met in the box in which a flight began, and one that
    // reaches over a face on one side of it.
    let is_periodic = scene.simulation.boundary != Boundary::Open;
    if scene.simulation.rule != Rule::Exact || is_periodic && is_driven(scene) {
        return None;
    }
    let length = scene.simulation.frame_time;
    // Frames that meet the times of the others to the bit.
    let meets = |count: &u32| {
        let part = length / f64::from(*count);
        part * f64::from(count - 1) + part == length
    };
    let count = [3, 2].into_iter().find(meets)?;
    let mut other = scene.clone();
    other.simulation.frame_time /= f64::from(count);
    let frames = count as usize;
    Some(if is_driven(scene) {
        // Each frame computes the places of surfaces again.
        let pair = Pair::new(other, Agreement::Rounding, |_| ());
        Pair { frames, ends: |frame| frame.in_zone || frame.in_contact, ..pair }
    } else {
        Pair { frames, ..Pair::new(other, Agreement::Bits, |_| ()) }
    })
}
