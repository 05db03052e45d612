//! Claims: names, expected values, tolerances and measurements.

use std::error::Error;
use std::sync::OnceLock;

use carom::{Rule, StateHash, World};

/// A claim about physics that can be false.
pub struct Claim {
    pub name: String,
    pub expected: Expected,
    pub tolerance: Tolerance,
    pub effort: Effort,
    /// The only rule for which it is claimed; `None` for all.
    pub rule: Option<Rule>,
    pub measure: Box<Measure>,
}

/// Measures the value of a claim under a rule.
pub type Measure = dyn Fn(Rule) -> Outcome + Send + Sync;

/// Measured value, or why there is none.
pub type Outcome = Result<Measured, Fault>;

/// Why there is no measured value.
pub type Fault = Box<dyn Error + Send + Sync>;

/// Expected value of a claim.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    pub value: f64,
    /// Source of the value.
    pub source: &'static str,
}

impl Expected {
    /// Creates an expected value with its source.
    pub fn value(value: f64, source: &'static str) -> Self {
        Self { value, source }
    }

    /// Expects an error of zero.
    pub fn no_error(source: &'static str) -> Self {
        Self { value: 0.0, source }
    }
}

/// Largest difference between measured and expected value, with the reason.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    pub bound: f64,
    /// Whether the bound is relative to the expected value.
    pub is_relative: bool,
    pub reason: &'static str,
}

impl Tolerance {
    pub fn absolute(bound: f64, reason: &'static str) -> Self {
        Self { bound, is_relative: false, reason }
    }

    pub fn relative(bound: f64, reason: &'static str) -> Self {
        Self { bound, is_relative: true, reason }
    }

    /// Allows no difference.
    pub fn none(reason: &'static str) -> Self {
        Self::absolute(0.0, reason)
    }

    /// Error of `measured`: absolute or relative, as the bound.
    pub fn error(&self, measured: f64, expected: f64) -> f64 {
        let error = (measured - expected).abs();
        if self.is_relative { error / expected.abs() } else { error }
    }
}

/// Duration of the check of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Effort {
    /// Seconds.
    Quick,
    /// Minutes.
    Full,
    /// Up to an hour.
    Long,
}

/// A measured value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    pub value: f64,
    /// Hash of the worlds at their ends.
    pub state: StateHash,
    /// Whether spheres were stepped in zones, which is not exact.
    pub was_stepped: bool,
}

impl Measured {
    /// Creates a value measured in one world.
    pub fn in_world(world: &World, value: f64) -> Self {
        Self { value, state: world.state_hash(), was_stepped: world.was_stepped() }
    }

    /// Returns the largest of several values.
    pub fn largest(measured: impl IntoIterator<Item = Self>) -> Self {
        Self::folded(measured, f64::max)
    }

    /// Returns the sum of several values.
    pub fn sum(measured: impl IntoIterator<Item = Self>) -> Self {
        Self::folded(measured, |a, b| a + b)
    }

    fn folded(measured: impl IntoIterator<Item = Self>, fold: impl Fn(f64, f64) -> f64) -> Self {
        let none = Self { value: 0.0, state: StateHash(0), was_stepped: false };
        measured.into_iter().fold(none, |all, one| Self {
            // `f64::max` would drop NaN.
            value: if (all.value + one.value).is_nan() {
                f64::NAN
            } else {
                fold(all.value, one.value)
            },
            state: StateHash(all.state.0.rotate_left(1) ^ one.state.0),
            was_stepped: all.was_stepped || one.was_stepped,
        })
    }
}

/// A measurement that several claims are about: it is made once.
pub struct Shared<T>(OnceLock<Result<T, String>>);

impl<T> Shared<T> {
    pub const fn new() -> Self {
        Self(OnceLock::new())
    }

    /// Returns the result of `measure`, which the first call makes.
    ///
    /// # Errors
    /// That of `measure`.
    pub fn get(&self, measure: impl FnOnce() -> Result<T, Fault>) -> Result<&T, Fault> {
        let made = self.0.get_or_init(|| measure().map_err(|fault| fault.to_string()));
        made.as_ref().map_err(|fault| fault.clone().into())
    }
}

impl Claim {
    /// Creates a claim about every rule that takes seconds to check.
    pub fn new(
        name: impl Into<String>,
        expected: Expected,
        tolerance: Tolerance,
        measure: impl Fn(Rule) -> Outcome + Send + Sync + 'static,
    ) -> Self {
        let (effort, rule, measure) = (Effort::Quick, None, Box::new(measure));
        Self { name: name.into(), expected, tolerance, effort, rule, measure }
    }

    /// Restricts the claim to one rule.
    pub fn about(self, rule: Rule) -> Self {
        Self { rule: Some(rule), ..self }
    }

    /// Marks the claim as one that takes minutes.
    pub fn slow(self) -> Self {
        Self { effort: Effort::Full, ..self }
    }

    /// Marks the claim as one that takes up to an hour.
    pub fn long(self) -> Self {
        Self { effort: Effort::Long, ..self }
    }
}
