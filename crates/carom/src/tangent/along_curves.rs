//! Reconstruction of the flights of a step that follow curves.

use glam::DVec3;

use super::curve_section::{Section, add_parts};
use super::curves::places_of;
use super::edge_passage::{Passage, Side};
use super::error::DerivativeError;
use super::linearized::Companions;
use super::replay::{Piece, Replay};
use super::start::ROUNDING;
use crate::rule::periodic;

/// A thread becomes taut where its length is off its rest length by at most this part.
const TAUT: f64 = 1e-9;
/// Largest change of an acceleration at an edge that is rounding, as a part of it.
const NO_JUMP: f64 = 1e-11;

impl Replay<'_> {
    /// Advances a sphere on a curve, and all that fly with it, to a time since the start of the step \[s\].
    pub fn fly_on_curve(&mut self, place: usize, time: f64) -> Result<(), DerivativeError> {
        while self.start.bodies[place].since < time {
            let since = self.start.bodies[place].since;
            let (number, end) = self.curves.at(place, since).ok_or_else(|| self.lost(place))?;
            self.fly_together(number, end.min(time)).ok_or_else(|| self.lost(place))?;
        }
        Ok(())
    }

    /// Advances spheres on one of the curved flights to a time since the start of the step \[s\]; `None` if the flight
    /// does not continue the motion so far, or has no known derivative.
    fn fly_together(&mut self, number: usize, time: f64) -> Option<()> {
        let joint = &self.curves.joints[number];
        let places = places_of(joint);
        let since = self.start.bodies[*places.first()?].since;
        let ages = [since, time].map(|at| self.start.time + at - joint.time);
        let section = Section { joint, ages: [ages[0].max(0.0), ages[1]] };
        let mut companions = Companions::of(self.system, &places)?;
        let is_one = |place: &usize| {
            let body = &self.start.bodies[*place];
            body.since == since && body.held.is_none() && body.is_curved
        };
        (joint.is_complete && places.iter().all(is_one)).then_some(())?;
        let [starts, ends] = section.ages.map(|age| section.at(age));
        let taut_or_slack = companions.clone();
        let [positions, velocities, _] = section.at(0.5 * (section.ages[0] + section.ages[1]));
        companions.fix_threads([&positions, &velocities]);
        companions.fix_sides([&positions, &velocities]);
        let passage = self.pass_edges(&companions, [&starts[0], &starts[1]], since)?;
        if let Some(Passage { place, lost, .. }) = passage {
            let body = &mut self.start.bodies[place];
            body.acceleration = body.acceleration.map(|it| it - lost);
        }
        let first = section.linearized(&companions, section.ages[0])?;
        let tolerance = section.tolerance(&first, section.ages[0]);
        let jumps = self.jumps(&places, &starts[2], tolerance);
        let tightening = match jumps.is_empty() {
            true => None,
            false => Some(taut_or_slack.tightening([&starts[0], &starts[1]], (TAUT, &jumps))?),
        };
        let mut parts = Vec::new();
        add_parts(&section, &companions, &places, &mut parts)?;
        let period = self.system.settings.boundary.period();
        for (at, &place) in places.iter().enumerate() {
            let body = &mut self.start.bodies[place];
            let off = periodic::wrapped(starts[0][at] - body.position, period);
            let speed = starts[1][at].length() + ends[1][at].length() + body.velocity.length();
            let goes_on = off.length() <= body.tolerance
                && (starts[1][at] - body.velocity).length() <= ROUNDING * speed;
            goes_on.then_some(())?;
            body.tolerance += ROUNDING * (ends[0][at] - starts[0][at]).length();
            (body.position, body.velocity) = (ends[0][at], ends[1][at]);
            (body.acceleration, body.since) = (Some(ends[2][at]), time);
        }
        for (&place, sides) in places.iter().zip(companions.sides) {
            self.sides.insert(place, sides);
        }
        self.pieces.extend(passage.map(|it| Piece::Passage(Box::new(it))));
        self.pieces.extend(tightening.map(|it| Piece::Tightening(Box::new(it))));
        self.pieces.extend(parts.into_iter().map(|it| Piece::Curved(Box::new(it))));
        Some(())
    }

    /// Passes the edges of forces between the last flights of spheres and those that begin in this state \[m\], \[m/s\] and
    /// at this time since the start of the step \[s\]. Returns the derivative of the passage at which an acceleration
    /// jumps; `None` if that is not known.
    fn pass_edges(
        &self,
        companions: &Companions,
        states: [&[DVec3]; 2],
        since: f64,
    ) -> Option<Option<Passage>> {
        let mut before = companions.clone();
        let mut passed: Vec<(usize, Side)> = Vec::new();
        for (number, (&place, now)) in companions.places.iter().zip(&companions.sides).enumerate() {
            let last = self.sides.get(&place).filter(|it| it.len() == now.len());
            let Some(last) = last else { continue };
            before.sides[number].clone_from(last);
            let changed = last.iter().zip(now).filter(|(a, b)| a.is_beyond != b.is_beyond);
            passed.extend(changed.map(|(_, side)| (number, *side)));
        }
        let Some(&(number, side)) = passed.first() else { return Some(None) };
        let place = companions.places[number];
        let [earlier, later] =
            [&before, companions].map(|it| it.accelerations(states, self.start.time + since));
        let lost = |number: usize| earlier[number] - later[number];
        let jumps = |number: usize| lost(number).length() > NO_JUMP * earlier[number].length();
        if !passed.iter().any(|&(number, _)| jumps(number)) {
            return Some(None);
        }
        let is_one = passed.iter().all(|it| it.0 == number && it.1.is_of_same_plane(&side));
        is_one.then_some(())?;
        Some(Some(Passage {
            place,
            id: self.start.ids[place],
            normal: side.edge.normal,
            by_radius: side.by_radius?,
            velocity: states[1][number],
            lost: lost(number),
            time: self.elapsed + since,
        }))
    }

    /// Returns the spheres, by index, whose accelerations \[m/s²\] at the start of a section are off those at the end of
    /// the last one by more than a tolerance, and how much smaller they are.
    fn jumps(&self, places: &[usize], starts: &[DVec3], tolerance: f64) -> Vec<(usize, DVec3)> {
        let lost = |(&place, start): (&usize, &DVec3)| {
            let lost = self.start.bodies[place].acceleration? - *start;
            (lost.length() > tolerance).then_some((place, lost))
        };
        places.iter().zip(starts).filter_map(lost).collect()
    }

    /// Returns the accelerations \[m/s²\] of spheres on curves, by index, and of those that fly with them.
    pub fn accelerations_on_curves(&self, struck: [Option<usize>; 2]) -> Vec<(usize, DVec3)> {
        let bodies = &self.start.bodies;
        let mut all: Vec<(usize, DVec3)> = Vec::new();
        for place in struck.into_iter().flatten().filter(|&place| bodies[place].is_curved) {
            if all.iter().any(|it| it.0 == place) {
                continue;
            }
            let since = bodies[place].since;
            let places = self.curves.companions(place, since);
            let Some(companions) = Companions::of(self.system, &places) else { continue };
            let positions: Vec<DVec3> = places.iter().map(|&it| bodies[it].position).collect();
            let velocities: Vec<DVec3> = places.iter().map(|&it| bodies[it].velocity).collect();
            let time = self.start.time + since;
            let accelerations = companions.accelerations([&positions, &velocities], time);
            all.extend(places.iter().copied().zip(accelerations));
        }
        all
    }
}
