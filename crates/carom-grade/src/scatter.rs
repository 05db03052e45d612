//! Estimates the scatter of measured positions from the table alone.

use carom::DVec3;
use serde::Serialize;

use crate::recorded::Recorded;

/// Quartile of the normal distribution: the median of |x| is this part of the standard deviation.
const QUARTILE: f64 = 0.674_489_75;

/// Fewest differences that make an estimate.
const FEWEST: usize = 30;

/// Number of standard deviations that the proposed tolerance allows.
const DEVIATIONS: f64 = 6.0;

/// Scatter of the positions of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Scatter {
    /// Standard deviation of each coordinate \[m\].
    pub deviation: f64,
    /// Tolerance that allows it \[m\].
    pub tolerance: f64,
}

/// Standard deviation of the scatter of a coordinate \[m\]; `None` if the table is too short.
///
/// Differences of third to sixth order of the positions of a ball in equal steps of time remove its
/// smooth motion; what is left is scatter. The median does not see the contacts, at which motion is
/// not smooth. The smallest of the four orders counts, because motion that is left makes the
/// others larger.
pub(crate) fn deviation(recorded: &Recorded) -> Option<f64> {
    let paths = paths(recorded);
    let step = usual_step(&paths)?;
    let of_order = |order: usize| of_order(&paths, recorded.seen, step, order);
    let all: Option<Vec<f64>> = (3..=6).map(of_order).collect();
    Some(all?.into_iter().fold(f64::INFINITY, f64::min))
}

/// Tolerance that allows scatter of this standard deviation \[m\], with one significant digit.
pub(crate) fn tolerance(deviation: f64) -> f64 {
    // A hundredth is rounding of the estimate, which must not add a whole digit.
    let least = DEVIATIONS * deviation * 0.96;
    let digit = 10_f64.powi(least.log10().floor() as i32);
    (least / digit).ceil() * digit
}

/// Standard deviation of each coordinate of some differences \[m\], by their median.
pub(crate) fn of_differences(all: impl Iterator<Item = DVec3>, seen: DVec3) -> Option<f64> {
    let axes = (0..3).filter(|axis| seen[*axis] > 0.0);
    let of_axis = |it: DVec3| axes.clone().map(move |axis| it[axis].abs());
    Some(median(all.flat_map(of_axis).collect())? / QUARTILE)
}

/// Times and positions of each ball.
fn paths(recorded: &Recorded) -> Vec<Vec<(f64, DVec3)>> {
    let mut paths = vec![Vec::new(); recorded.labels.len()];
    for row in &recorded.rows {
        paths[row.label].push((row.time, row.position));
    }
    paths
}

/// Median of the steps of time \[s\].
fn usual_step(paths: &[Vec<(f64, DVec3)>]) -> Option<f64> {
    let steps = paths.iter().flat_map(|path| path.windows(2).map(|it| it[1].0 - it[0].0));
    median(steps.collect())
}

/// Estimate from the differences of one order.
fn of_order(paths: &[Vec<(f64, DVec3)>], seen: DVec3, step: f64, order: usize) -> Option<f64> {
    // Binomial coefficients with alternating signs.
    let mut weights = vec![1.0];
    for number in 0..order {
        let last = weights[number];
        weights.push(-last * (order - number) as f64 / (number + 1) as f64);
    }
    let mut all = Vec::new();
    for points in paths.iter().flat_map(|path| path.windows(order + 1)) {
        let is_even = |it: &[(f64, DVec3)]| (it[1].0 - it[0].0 - step).abs() < 0.02 * step;
        if !points.windows(2).all(is_even) {
            continue;
        }
        let sum = points.iter().zip(&weights).fold(DVec3::ZERO, |sum, (it, w)| sum + it.1 * *w);
        all.extend((0..3).filter(|axis| seen[*axis] > 0.0).map(|axis| sum[axis].abs()));
    }
    if all.len() < FEWEST {
        return None;
    }
    let norm = weights.iter().map(|it| it * it).sum::<f64>().sqrt();
    Some(median(all)? / (QUARTILE * norm))
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    let middle = values.len() / 2;
    if values.is_empty() {
        return None;
    }
    Some(*values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tolerance_has_one_digit_and_allows_six_deviations() {
        assert!((tolerance(1e-3) - 6e-3).abs() < 1e-12);
        assert!((tolerance(1.02e-3) - 6e-3).abs() < 1e-12);
        assert!((tolerance(1.2e-3) - 7e-3).abs() < 1e-12);
        assert!((tolerance(1.7e-4) - 1e-3).abs() < 1e-12);
    }
}
