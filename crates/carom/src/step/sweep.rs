//! Sensors under rules with frames only: paths of spheres are straight between known places.

use glam::DVec3;

use super::attempt::Attempt;
use crate::flight::Flight;
use crate::sensor::{FlightSegment, Sensors};

/// Reports which triggers the spheres entered and left in a frame, along the tracks that were noted, or straight
/// to where they are now.
pub(super) fn report(attempt: &mut Attempt) {
    let Attempt { scratch, state, .. } = &mut *attempt;
    let Some(places) = scratch.tracks.end(state.spheres.positions()) else {
        return attempt.report_sensors(None);
    };
    let mut sensors = Sensors::with(attempt.state.presence.clone());
    let (start, part) = (attempt.start, attempt.length / (places.len() - 1) as f64);
    let (system, _) = attempt.state.split();
    let boundary = system.settings.boundary;
    for (index, &sphere) in system.spheres.id.iter().enumerate() {
        let radius = system.spheres.radius[index];
        for (number, two) in places.windows(2).enumerate() {
            let (from, to) = (two[0][index], two[1][index]);
            let flight = Flight {
                position: from,
                velocity: boundary.nearest_image(to - from) / part,
                acceleration: DVec3::ZERO,
                drag_rate: 0.0,
            };
            let flight_start = start + number as f64 * part;
            let end = start + (number + 1) as f64 * part;
            let segment = FlightSegment {
                sphere,
                index: index as u32,
                radius,
                flight,
                curve: None,
                flight_start,
                from: flight_start,
                to: end,
            };
            sensors.watch(&segment, &system, start);
        }
    }
    attempt.report_sensors(Some(sensors));
}
