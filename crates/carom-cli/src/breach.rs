//! Checks whether a run kept what its rule guarantees.

use carom_scene::scene::Rule;

/// Largest overlap under `exact` as a fraction of the smallest radius: curved surfaces are followed
/// in pieces.
const OVERLAP: f64 = 1e-6;

/// Largest change of momentum by a group of impacts, relative to the momenta involved: many times
/// the rounding error.
const MOMENTUM: f64 = 1e-6;

/// Largest deviation of the energy from the change that restitution requires, relative to the
/// energy involved.
const ENERGY: f64 = 1e-6;

/// Results of a run that are checked.
#[derive(Debug, Clone, Copy)]
pub struct Course {
    pub rule: Rule,
    /// Largest overlap at the end of a frame, as a fraction of the smallest radius.
    pub overlap: f64,
    /// Whether overlaps are allowed: by the scene, or because zones were stepped, which leaves
    /// small ones.
    pub may_overlap: bool,
    /// Largest errors of a group of impacts.
    pub momentum_error: f64,
    pub energy_error: f64,
    pub unfinished_islands: u64,
    /// How often a ball was pressed into a surface by half its radius, if the scene starts without
    /// overlaps.
    pub squeezed: u64,
}

/// Describes each violated guarantee in a line.
pub fn breaches(course: Course) -> Vec<String> {
    let Course { rule, overlap, may_overlap, momentum_error, energy_error, .. } = course;
    let Course { unfinished_islands, squeezed, .. } = course;
    let is_exact = rule == Rule::Exact;
    let mut breaches = Vec::new();
    if is_exact && !may_overlap && overlap > OVERLAP {
        breaches.push(format!("balls overlap by {overlap:.1e} of the smallest radius"));
    }
    if is_exact && momentum_error > MOMENTUM {
        breaches.push(format!("an impact changes the momentum by {momentum_error:.1e} of itself"));
    }
    if is_exact && energy_error > ENERGY {
        breaches.push(format!("an impact changes the energy by {energy_error:.1e} too much"));
    }
    if unfinished_islands > 0 {
        breaches.push(format!("{unfinished_islands} islands were left before they were settled"));
    }
    if squeezed > 0 {
        breaches.push(format!(
            "{squeezed} times, counted in each sub-step, a ball was pressed into a surface by half its radius: \
             what presses leaves it no way out"
        ));
    }
    breaches
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEPT: Course = Course {
        rule: Rule::Exact,
        overlap: 1e-9,
        may_overlap: false,
        momentum_error: 1e-15,
        energy_error: 1e-8,
        unfinished_islands: 0,
        squeezed: 0,
    };

    #[test]
    fn only_what_a_rule_keeps_can_be_broken() {
        assert!(breaches(KEPT).is_empty());
        let overlapping = Course { overlap: 1e-3, ..KEPT };
        assert_eq!(breaches(overlapping).len(), 1);
        assert!(breaches(Course { may_overlap: true, ..overlapping }).is_empty());
        assert!(breaches(Course { rule: Rule::Discrete, ..overlapping }).is_empty());
        let lossy = Course { momentum_error: 1e-3, energy_error: 1e-3, ..KEPT };
        assert_eq!(breaches(lossy).len(), 2);
        let unsettled = Course { rule: Rule::Bisect, unfinished_islands: 2, ..KEPT };
        assert_eq!(breaches(unsettled).len(), 1);
        for rule in [Rule::Exact, Rule::Contact] {
            let squeezed = Course { rule, squeezed: 3, may_overlap: true, ..KEPT };
            assert_eq!(breaches(squeezed).len(), 1);
        }
    }
}
