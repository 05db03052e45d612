//! Assigns the labels of a table to balls of the course.

use crate::recorded::{Recorded, whole};
use crate::tracks::{Key, Tracks};

/// Finds the meaning of labels by comparison with the run of the course's rule. Labels may be
/// numbers in the order of emission, from 0 or from the smallest label, or names in the order of
/// appearance. If no label exceeds the `capacity` of slots, they may also be slots, whose balls
/// change. The meaning with the fewest rows without a ball counts; among equal ones, that with the
/// nearest first positions.
pub(crate) fn keys(recorded: &Recorded, reference: &Tracks, capacity: Option<usize>) -> Vec<Key> {
    let mut best: Option<(Cost, Vec<Key>)> = None;
    for places in places(recorded) {
        let largest = places.iter().copied().max().unwrap_or(0);
        let fits_slots = capacity.is_some_and(|capacity| largest < capacity);
        for slots in [false, true] {
            if slots && !fits_slots {
                continue;
            }
            let key = |&place: &usize| if slots { Key::Slot(place) } else { Key::Number(place) };
            let keys: Vec<Key> = places.iter().map(key).collect();
            let cost = Cost::of(recorded, reference, &keys);
            if best.as_ref().is_none_or(|(least, _)| cost.is_less(least)) {
                best = Some((cost, keys));
            }
        }
    }
    best.map(|(_, keys)| keys).unwrap_or_default()
}

/// Possible meanings of the labels: lists with a place for each label.
fn places(recorded: &Recorded) -> Vec<Vec<usize>> {
    let numbers: Option<Vec<i64>> = recorded.labels.iter().map(|label| whole(label)).collect();
    let mut places = Vec::new();
    if let Some(numbers) = numbers {
        let least = numbers.iter().copied().min().unwrap_or(0);
        if least >= 0 {
            places.push(numbers.iter().map(|it| *it as usize).collect());
        }
        places.push(numbers.iter().map(|it| it.abs_diff(least) as usize).collect());
    }
    places.push((0..recorded.labels.len()).collect());
    places
}

/// Cost of a meaning: the smaller, the better.
struct Cost {
    /// Number of rows of balls that do not exist.
    missing: usize,
    /// Sum of the distances \[m\] in the first row of each ball, each limited to 1 m.
    distance: f64,
}

impl Cost {
    fn of(recorded: &Recorded, reference: &Tracks, keys: &[Key]) -> Self {
        let mut cost = Self { missing: 0, distance: 0.0 };
        let mut is_new = vec![true; keys.len()];
        for row in &recorded.rows {
            let Some(state) = reference.sample(keys[row.label], row.time) else {
                cost.missing += 1;
                continue;
            };
            if std::mem::take(&mut is_new[row.label]) {
                cost.distance += state.position.distance(row.position).min(1.0);
            }
        }
        cost
    }

    fn is_less(&self, other: &Self) -> bool {
        // A difference of a micrometre is noise.
        self.missing < other.missing
            || self.missing == other.missing && self.distance < other.distance - 1e-6
    }
}
