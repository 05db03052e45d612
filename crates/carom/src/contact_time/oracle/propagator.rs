//! The closed form of flights against the same with 77 digits.

use super::generate::Numbers;
use super::number::{Big, Number};
use crate::flight::{Propagator, time_of_drift};

/// The largest error, relative, in units of rounding: half a unit for each of the few operations
/// after a function of `libm`, which is good to one.
const ROUNDINGS: f64 = 4.0;

#[test]
fn flights_lose_no_digits_at_any_drag() {
    let mut numbers = Numbers(30);
    let mut worst = [0.0_f64; 3];
    let near_switch = (0..200).map(|i| 0.9 + 0.001 * f64::from(i));
    let anywhere: Vec<f64> = (0..4000).map(|_| numbers.decade(-25.0, 4.0)).collect();
    for z in near_switch.chain(anywhere) {
        let t = numbers.decade(-3.0, 3.0);
        let drag_rate = z / t;
        let Propagator { decay, drift, fall } = Propagator::over(t, drag_rate);
        let (exact_drift, exact_fall) = Big::drift_and_fall(&Big::of(t), drag_rate);
        let exact_decay = Big::of(1.0) - Big::of(drag_rate) * exact_drift.clone();
        let off = |value: f64, exact: &Big| {
            let difference = (Big::of(value) - exact.clone()) / exact.clone();
            difference.to_f64().value().abs() / f64::EPSILON
        };
        let mut offs = vec![off(drift, &exact_drift), off(fall, &exact_fall)];
        // Further on, 77 digits do not show e^-z; the rounding of z times z is in it.
        if z < 30.0 {
            offs.push(off(decay, &exact_decay) / z.max(1.0));
        }
        for (worst, off) in worst.iter_mut().zip(&offs) {
            *worst = worst.max(*off);
        }
        assert!(offs.iter().all(|&off| off <= ROUNDINGS), "{offs:?} at z = {z:e}, t = {t:e}");
    }
    println!("drift, fall and decay are off by at most {worst:?} roundings");
}

#[test]
fn the_time_of_a_drift_drifts_so_far() {
    let mut numbers = Numbers(31);
    for _ in 0..4000 {
        let drag_rate = numbers.decade(-300.0, 3.0);
        let s = numbers.between(0.0, 1.0) * numbers.decade(-20.0, 0.0).min(1.0) / drag_rate;
        let t = time_of_drift(s, drag_rate).unwrap();
        let back = Propagator::over(t, drag_rate).drift;
        assert!((back - s).abs() <= ROUNDINGS * f64::EPSILON * s, "{s:e} {t:e} {back:e}");
    }
    assert_eq!(time_of_drift(0.5, 2.0), None);
}
