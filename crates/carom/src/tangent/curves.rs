//! The curved flights of a step, by sphere.

use std::collections::BTreeMap;

use crate::rule::exact::JointFlight;

/// The curved flights of a step.
pub(super) struct Curves {
    /// In order of their starts.
    pub joints: Vec<JointFlight>,
    /// Start of each since the start of the step \[s\].
    starts: Vec<f64>,
    /// Numbers of the flights of each sphere, by index of the sphere.
    of_spheres: BTreeMap<usize, Vec<usize>>,
}

impl Curves {
    /// Takes the flights of a step that lasts from `start` to `end` \[s\].
    pub fn new(joints: Vec<JointFlight>, [start, end]: [f64; 2]) -> Self {
        let starts = joints.iter().map(|it| (it.time - start).clamp(0.0, end - start)).collect();
        let mut of_spheres: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (number, joint) in joints.iter().enumerate() {
            for &(index, _) in &joint.flights {
                of_spheres.entry(index as usize).or_default().push(number);
            }
        }
        Self { joints, starts, of_spheres }
    }

    /// Returns the number of the flight of a sphere from a time since the start of the step on, and its end there
    /// \[s\]: the start of the next one, or infinity.
    pub fn at(&self, place: usize, since: f64) -> Option<(usize, f64)> {
        let numbers = self.of_spheres.get(&place)?;
        let next = numbers.partition_point(|&number| self.starts[number] <= since);
        let number = *numbers.get(next.checked_sub(1)?)?;
        let end = numbers.get(next).map_or(f64::INFINITY, |&number| self.starts[number]);
        Some((number, end))
    }

    /// Returns the indices of the spheres that fly together with one, itself included, at a time since the start of the
    /// step \[s\].
    pub fn companions(&self, place: usize, since: f64) -> Vec<usize> {
        let joint = self.at(place, since).map(|(number, _)| &self.joints[number]);
        joint.map_or(vec![place], places_of)
    }
}

/// Returns the indices of the spheres of a flight in the arrays of the world.
pub(super) fn places_of(joint: &JointFlight) -> Vec<usize> {
    joint.flights.iter().map(|&(index, _)| index as usize).collect()
}
