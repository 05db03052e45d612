//! The log of persistent contacts and curved flights during a step, for derivatives.

use super::flights::{Arrival, FlightLog};
use super::timeline::Timeline;

impl Timeline {
    /// Starts a log of persistent contacts and curved flights at `now` \[s\].
    pub fn begin_log(&mut self, now: f64) {
        self.flights.begin_log(now);
    }

    /// Continues a log after spheres were added at `now` \[s\].
    pub fn resume_log(&mut self, before: FlightLog, arrivals: Vec<Arrival>, now: f64) {
        self.flights.resume_log(before, arrivals, now);
    }

    /// Ends and returns the log.
    pub fn end_log(&mut self) -> FlightLog {
        self.flights.end_log()
    }
}
